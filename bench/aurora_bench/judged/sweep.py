# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Read and ground a prompt, and ask what of it no condition depends on."""

from __future__ import annotations

from aurora_cli.installed import installed
from aurora_core.agsg.build import build_agsg
from aurora_core.agsg.judged import paths_stated, unjudged
from aurora_core.conditions.capabilities import judgeable
from aurora_core.conditions.derive import derive_conditions
from aurora_core.document import Document
from aurora_core.outcomes.condition import Condition
from aurora_core.outcomes.grounded import GroundedScenario
from aurora_core.outcomes.schedule import Schedule
from aurora_core.pipeline.functions import ground_stage, parse_stage
from aurora_core.spec.scenario import ScenarioSpec


class Asked(Document):
    """A prompt of a file."""

    id: str
    prompt: str


class Found(Document):
    """What became of a prompt.

    Attributes:
        outcome: `grounded`, `no place`, or `no specification`.
        stated: How many explicit numbers and stated choices there are.
        open: Of these the fields that no condition depends on and nothing else is said of.
        admitted: Fields that no condition depends on, of elements that nobody carries out.
    """

    outcome: str
    stated: int = 0
    open: tuple[str, ...] = ()
    admitted: tuple[str, ...] = ()


class Sweep:
    """Reads, grounds and asks of every prompt."""

    def __init__(self, map_name: str, seed: int) -> None:
        self._map_name = map_name
        self._seed = seed

    def prepare(self) -> None:
        """Load the map."""
        installed().grounder(self._map_name)

    def __call__(self, task: Asked) -> Found:
        """Return what a prompt states and nothing judges."""
        spec = parse_stage(installed(), task.prompt, self._map_name, self._seed).spec
        if spec is None:
            return Found(outcome='no specification')
        outcome = ground_stage(installed(), build_agsg(spec), self._seed)
        if outcome.agsg is None:
            return Found(outcome='no place')
        graph = outcome.agsg
        known = installed()
        facts = Schedule.model_validate_json(graph.texts.schedule).facts
        grounded = GroundedScenario.model_validate_json(graph.texts.grounding)

        def derive(asked: ScenarioSpec) -> tuple[Condition, ...]:
            made = derive_conditions(asked, facts, known.limits, known.tolerances)
            return judgeable(made.conditions, asked, grounded)

        conditions = derive(graph.spec)
        said = {text.partition(': ')[0] for text in outcome.unsupported}
        found = unjudged(graph.spec, conditions, derive)
        if said:
            # Events and links of a body that has no place have no condition for its sake.
            judged = {name for c in conditions for name in c.spec_ids}
            said |= {u.element for u in found} - judged
        return Found(
            outcome='grounded',
            stated=len(paths_stated(graph.spec)),
            open=tuple(_field(u.path) for u in found if u.element not in said),
            admitted=tuple(_field(u.path) for u in found if u.element in said),
        )


def _field(path: str) -> str:
    """Return what a path is about, without ids and numbers: `missions/altitude_m`."""
    parts = path.split('/')
    kept = [p for k, p in enumerate(parts) if k != 1 or parts[0] == 'world']
    return '/'.join(p for p in kept if not p.isdigit())
