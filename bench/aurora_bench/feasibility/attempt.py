# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""One attempt to realise what was proven impossible, in the real simulators.

What is run need not be what was asked: the checker holds the recording against the annotation, and
so any plan at all may be tried. Values that nobody states are drawn from their domains, stated
numbers are bent, conditions are left out, the scene goes where none was yet, and where no place is
found the plan is made as if nothing stood in its way: no building, no zone, no limit. Runs last no
longer than they need: what has to hold throughout is the easier for it. The world in which a plan
is flown, and the limits it is judged by, stay as they are.
"""

from __future__ import annotations

import random
import shutil
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from aurora_bench.feasibility.families import Case
from aurora_bench.rulers.checking import Check, asked_of
from aurora_bench.rulers.runs import on_map
from aurora_cli.local_engine import LocalStages
from aurora_core.errors import AuroraError
from aurora_core.execution.plan import EXECUTOR_VERSION
from aurora_core.grounding.airspace import Airspace
from aurora_core.grounding.ground import Grounder
from aurora_core.outcomes.grounding import GroundingOutcome
from aurora_core.outcomes.parse import ParseOutcome
from aurora_core.outcomes.repair import Anchor, RepairPlan
from aurora_core.pipeline.functions import understood
from aurora_core.pipeline.knowledge import Knowledge
from aurora_core.pipeline.stages import RunControl, RunRequest
from aurora_core.spec.scenario import ScenarioSpec
from aurora_core.spec.vocabulary import MissionMode

# A plan is flown so often, each time with another seed: planning costs as much as flying.
SEEDS = 4
# How often a number that nobody states is drawn anew.
_DRAWN = 0.5
# How often a place of an earlier run is avoided, and then its whole road.
_AVOIDED = 0.8
_WHOLE_ROAD = 0.5
# Where planning as usual has found no place it is tried again so often.
_AGAIN = 0.1
# How often a run may break what is stated, and then how often each number and condition is broken.
_BENDING = 0.5
_BENT = 0.4
# An unstated duration is drawn from the shortest part of its domain below what it was.
_SHORT = 0.4
# Of a bent number.
_FACTORS = (0.6, 1.4)
# What every run has to keep and no annotation says: clearance, separation, no-fly zones.
_SAFETY = 'safety.'
# Beyond all that is flown here (m).
_UNLIMITED_M = 5000.0
# How an attempt can end; only the first one refutes a certificate.
REALISED = 'realised'
DENIED = 'denied'  # the checker denies a requirement
UNSAFE = 'unsafe'  # nothing is denied, but the run broke what every run has to keep
UNDECIDED = 'undecided'  # nothing is denied, and something cannot be told
NO_PLACE = 'no place'
ERROR = 'error'
ENDS = (REALISED, DENIED, UNSAFE, UNDECIDED, NO_PLACE, ERROR)


class Hurried(Knowledge):
    """What is installed, but for runs that may end as soon as all is done."""

    def __init__(self, known: Knowledge) -> None:
        """Take over what is installed.

        Args:
            known: What runs here are made with.
        """
        super().__init__(
            limits=known.limits.model_copy(
                update={'horizon_inferred_min_s': known.limits.duration_min_s}
            ),
            tolerances=known.tolerances,
            settings=known.settings,
            types=known.types,
            uav=known.uav,
        )


class Unhindered(Hurried):
    """That, with a grounder for which nothing stands in the way of a flight."""

    def grounder(self, name: str) -> Grounder:
        """Return a grounder that sees no building and no zone, and knows wide limits."""
        if name not in self._grounders:
            limits = self.limits.model_copy(
                update={
                    'clearance_min_m': 0.0,
                    'separation_min_m': 0.1,
                    'uav_standoff_max_m': _UNLIMITED_M,
                    'sensing_range_m': dict.fromkeys(self.limits.sensing_range_m, _UNLIMITED_M),
                    'link_range_sight_m': _UNLIMITED_M,
                    'link_range_blocked_m': _UNLIMITED_M,
                }
            )
            measured = self.measured(name)
            self._grounders[name] = Grounder(
                self.map(name),
                self.types,
                limits,
                self.tolerances,
                self.settings,
                self.basis,
                EXECUTOR_VERSION,
                None if measured is None else measured.spawns,
                Airspace((), ()),
            )
        return self._grounders[name]


@dataclass
class Attempts:
    """Attempts in one place, with all that they share.

    Args:
        stages: Of the local engine.
        check: The independent checker.
        map_name: Where requests lie that name no map.
        place: Folder for the recordings, which go when they are judged.
    """

    stages: LocalStages
    check: Check
    map_name: str
    place: Path
    _usual: LocalStages = field(init=False)
    _free: LocalStages = field(init=False)
    _planned: tuple[str, GroundingOutcome, bool] | None = field(default=None, init=False)

    def __post_init__(self) -> None:
        """Prepare both ways of planning."""
        self._usual = LocalStages(Hurried(self.stages.known))
        self._free = LocalStages(Unhindered(self.stages.known))

    def once(
        self, case: Case, index: int, draw: random.Random, earlier: Sequence[Mapping[str, Any]]
    ) -> dict[str, Any]:
        """Run a request once; the first plan is of it as it is, later ones are varied.

        Args:
            case: The request, with its specification.
            index: Of the run; the seed is one more.
            draw: Draws the plan: the same for all runs of one plan.
            earlier: What became of the runs of the plans before.
        """
        request = RunRequest(prompt=case.prompt, seed=index + 1, map_name=self.map_name)
        name = f'{case.source}/{case.id}/{index // SEEDS}'
        try:
            if self._planned is None or self._planned[0] != name:
                self._planned = (name, *self._plan(case, request, index < SEEDS, draw, earlier))
            return self._run(case, request, self._planned[1], freely=self._planned[2])
        except (AuroraError, ValueError, ArithmeticError) as err:
            # A plan that asks for nonsense may break anything on its way.
            return {'ended': ERROR, 'why': [f'{type(err).__name__}: {err}'], 'place': None}
        finally:
            shutil.rmtree(self.place / 'bag', ignore_errors=True)

    def _plan(
        self,
        case: Case,
        request: RunRequest,
        first: bool,
        draw: random.Random,
        earlier: Sequence[Mapping[str, Any]],
    ) -> tuple[GroundingOutcome, bool]:
        """Return where and how a request is to be run, and whether nothing stood in its way."""
        assert case.spec is not None
        asked = on_map(case.spec, self.map_name)
        spec = asked if first else varied(asked, draw)
        places = {r['place']['lane']: r['place'] for r in earlier if r['place']}
        avoided = tuple(
            Anchor(**place, whole_road=draw.random() < _WHOLE_ROAD)
            for place in places.values()
            if draw.random() < _AVOIDED
        )
        hindered = bool(earlier) and bool(earlier[0].get('freely'))
        if not hindered or draw.random() < _AGAIN:
            found = self._grounded(self._usual, spec, request, avoided)
            if found.agsg is not None:
                return found, False
        return self._grounded(self._free, beside_each_other(spec), request, avoided), True

    def _run(
        self, case: Case, request: RunRequest, grounding: GroundingOutcome, *, freely: bool
    ) -> dict[str, Any]:
        if grounding.agsg is None or grounding.agsg.grounding is None:
            why = [] if grounding.failure is None else [str(grounding.failure.reason)]
            return {'ended': NO_PLACE, 'why': why, 'place': None, 'freely': freely}
        at = grounding.agsg.grounding
        place = {'lane': at.anchor_lane, 'position_m': at.anchor_position_m}
        told = {'place': place, 'freely': freely}
        result = self._usual.execute(grounding.agsg, self.place / 'bag', request, RunControl())
        said = asked_of(self.check, result.bag, dict(case.document))
        denied = sorted({s.kind for s in said if s.outcome == 'does_not'})
        if denied:
            return {'ended': DENIED, 'why': denied, **told}
        # Only what nothing is denied of is worth all the margins.
        verdict = self._usual.verify(grounding.agsg, result.bag)
        broken = [c.id for c in verdict.results if not c.satisfied]
        unsafe = [ident for ident in broken if ident.startswith(_SAFETY)]
        open_ = sorted({s.kind for s in said if s.outcome != 'holds'})
        ended = UNSAFE if unsafe else UNDECIDED if open_ or not said else REALISED
        return {'ended': ended, 'why': [*open_, *broken], **told}

    def _grounded(
        self,
        stages: LocalStages,
        spec: ScenarioSpec,
        request: RunRequest,
        avoided: tuple[Anchor, ...],
    ) -> GroundingOutcome:
        """Ground a request elsewhere than before, or anywhere where that is not possible."""
        outcome = understood(stages.known, ParseOutcome(spec=spec))
        assert outcome.agsg is not None
        if avoided:
            found = stages.ground(outcome.agsg, request, RepairPlan(avoided=avoided))
            if found.agsg is not None:
                return found
        return stages.ground(outcome.agsg, request)


def beside_each_other(spec: ScenarioSpec) -> ScenarioSpec:
    """Return a request in which who hovers over a UAV hovers where that one is."""
    where = {m.uav: m.target for m in reversed(spec.missions)}
    missions = [
        m.model_copy(update={'target': where[m.target]})
        if m.mode is MissionMode.HOVER and m.target in where
        else m
        for m in spec.missions
    ]
    return spec.model_copy(update={'missions': tuple(missions)})


def varied(spec: ScenarioSpec, draw: random.Random) -> ScenarioSpec:
    """Return another request that may be realised in the place of one.

    What nobody states is drawn from its domain, durations are short. In every second request
    stated numbers are bent, too, and conditions are left out.
    """
    bends = draw.random() < _BENDING

    def number(value: dict[str, Any]) -> dict[str, Any]:
        if value['provenance'] == 'explicit':
            if bends and draw.random() < _BENT:
                bent = round(value['value'] * draw.uniform(*_FACTORS), 2)
                return {**value, 'value': bent, 'low': bent, 'high': bent}
            return value
        low, high = value['low'], value['high']
        if value['unit'] == 's':
            high = low + _SHORT * (value['value'] - low)
        if low < high and draw.random() < _DRAWN:
            return {**value, 'value': round(draw.uniform(low, high), 1)}
        return value

    def change(value: Any) -> Any:
        if isinstance(value, list):
            return [change(inner) for inner in value]
        if not isinstance(value, dict):
            return value
        if 'provenance' in value:
            return number(value)
        return {name: change(inner) for name, inner in value.items()}

    changed = change(spec.model_dump(mode='json'))
    if bends:
        changed['conditions'] = [c for c in changed['conditions'] if draw.random() >= _BENT]
    try:
        return ScenarioSpec.model_validate(changed)
    except ValueError:  # something else rests on what was bent
        return spec
