# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The engine of a campaign's run: what repair took, and how each realisation came out."""

from __future__ import annotations

import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from aurora_bench.campaign.measured import Measured, measured
from aurora_bench.rulers.watched import WatchedStages
from aurora_core.outcomes.agsg import Agsg
from aurora_core.outcomes.feasibility import CheckStage
from aurora_core.outcomes.grounding import GroundingOutcome
from aurora_core.outcomes.repair import Attempt, Proposal, RepairPlan
from aurora_core.outcomes.verdict import Verdict
from aurora_core.pipeline.stages import ExecutionResult, RunControl, RunRequest


class EpisodeStages(WatchedStages):
    """The ruler's engine; it takes down what is lost with the next realisation.

    Attributes:
        again_s: Wall seconds by stage after the first verdict: the repair episode.
        measured: What came out, by the name of the bag.
    """

    def __init__(self, without: frozenset[CheckStage] = frozenset()) -> None:
        super().__init__(without=without)
        self.again_s: dict[str, float] = {}
        self.measured: dict[str, Measured] = {}

    def ground(
        self, agsg: Agsg, request: RunRequest, plan: RepairPlan | None = None
    ) -> GroundingOutcome:
        """Ground the graph."""
        with self._again('ground'):
            return super().ground(agsg, request, plan)

    def execute(
        self, agsg: Agsg, bag_directory: Path, request: RunRequest, control: RunControl
    ) -> ExecutionResult:
        """Run in lockstep and record."""
        with self._again('execute'):
            return super().execute(agsg, bag_directory, request, control)

    def verify(self, agsg: Agsg, bag: Path) -> Verdict:
        """Judge, and measure what was judged."""
        with self._again('verify'):
            verdict = super().verify(agsg, bag)
        assert self.judged is not None  # it has just been judged
        self.measured[bag.name] = measured(self.judged)
        return verdict

    def propose(
        self, agsg: Agsg, verdict: Verdict, bag: Path, past: tuple[Attempt, ...]
    ) -> Proposal:
        """Propose how to realise a violated request otherwise."""
        with self._again('repair'):
            return super().propose(agsg, verdict, bag, past)

    @contextmanager
    def _again(self, stage: str) -> Iterator[None]:
        begin, repaired = time.perf_counter(), bool(self.measured)
        try:
            yield
        finally:
            if repaired:
                spent = time.perf_counter() - begin
                self.again_s[stage] = self.again_s.get(stage, 0.0) + spent
