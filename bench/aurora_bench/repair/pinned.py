# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The local engine for a fault: its first scene on a street that was drawn, every edit noted."""

from __future__ import annotations

import random
import time
from dataclasses import dataclass
from pathlib import Path

from aurora_bench.rulers.watched import WatchedStages
from aurora_core.outcomes.agsg import Agsg
from aurora_core.outcomes.grounding import GroundingOutcome
from aurora_core.outcomes.repair import Anchor, Attempt, Proposal, RepairPlan
from aurora_core.outcomes.verdict import Verdict
from aurora_core.pipeline.stages import ExecutionResult, RunControl, RunRequest
from aurora_core.repair.attempts import anchor_of
from aurora_core.spec.scenario import ScenarioSpec

# So many streets are looked at until one has room for the scene.
_STREETS = 60


@dataclass(slots=True)
class Asked:
    """A proposal, what it answers to, and what grounding made of it (None: nothing yet).

    Attributes:
        seconds: Wall time of the proposal.
    """

    graph: Agsg
    verdict: Verdict
    proposal: Proposal
    seconds: float
    outcome: GroundingOutcome | None = None


class PinnedStages(WatchedStages):
    """Puts the first realisation on a street that was drawn, and remembers all proposals.

    Args:
        spec: What is run.
        place: Draws the street, in [0, 1); None: where grounding puts it.

    Attributes:
        asked: Every proposal, in order.
    """

    def __init__(self, spec: ScenarioSpec, place: float | None) -> None:
        super().__init__(spec)
        self._place = place
        self._kept: Anchor | None = None
        self._run: set[str] = set()
        self.asked: list[Asked] = []

    def finds_a_place(self, request: RunRequest) -> bool:
        """Look for a drawn street with room for the scene; True when no street is drawn."""
        if self._place is None:
            return True
        graph = self.parse(request).agsg
        if graph is None:
            return False
        lanes = self.known.map(request.map_name).network.lanes
        streets = sorted({lane.edge_id for lane in lanes.values() if lane.id[0] != ':'})
        random.Random(repr(self._place)).shuffle(streets)
        for here in streets[:_STREETS]:
            away = tuple(
                Anchor(lane=name, position_m=0.0)
                for name, lane in sorted(lanes.items())
                if lane.edge_id != here
            )
            outcome = super().ground(graph, request, RepairPlan(avoided=away))
            grounded = None if outcome.agsg is None else outcome.agsg.grounding
            if grounded is not None:
                self._kept = anchor_of(grounded)
                return True
        return False

    def ground(
        self, agsg: Agsg, request: RunRequest, plan: RepairPlan | None = None
    ) -> GroundingOutcome:
        """Ground it; the street as if it were the best one."""
        if plan is None and self._kept is not None:
            self.grounding = super().ground(agsg, request, RepairPlan(kept=self._kept))
            return self.grounding
        outcome = super().ground(agsg, request, plan)
        if plan is not None and self.asked:
            self.asked[-1].outcome = outcome
        return outcome

    def execute(
        self, agsg: Agsg, bag_directory: Path, request: RunRequest, control: RunControl
    ) -> ExecutionResult:
        """Run it, and remember that it was."""
        self._run.add(agsg.sha256)
        return super().execute(agsg, bag_directory, request, control)

    def simulated(self, agsg: Agsg) -> bool:
        """Tell whether a graph was executed."""
        return agsg.sha256 in self._run

    def propose(
        self, agsg: Agsg, verdict: Verdict, bag: Path, past: tuple[Attempt, ...]
    ) -> Proposal:
        """Propose, and remember what was."""
        begin = time.perf_counter()
        proposal = super().propose(agsg, verdict, bag, past)
        self.asked.append(Asked(agsg, verdict, proposal, time.perf_counter() - begin))
        return proposal
