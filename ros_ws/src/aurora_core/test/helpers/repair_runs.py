# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Runs for tests of repair: parsing and grounding are real, flights and verdicts not."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any

from aurora_core.errors import SimulatorError
from aurora_core.outcomes.agsg import Agsg
from aurora_core.outcomes.feasibility import FeasibilityVerdict
from aurora_core.outcomes.grounding import GroundingFailure, GroundingOutcome
from aurora_core.outcomes.parse import ParseOutcome
from aurora_core.outcomes.repair import (
    Attempt,
    Proposal,
    RepairPlan,
)
from aurora_core.outcomes.verdict import ConditionResult, Verdict, VerdictStatus
from aurora_core.pipeline import functions
from aurora_core.pipeline.beside import Beside, Candidate, Pending, Recorded
from aurora_core.pipeline.knowledge import installed_knowledge
from aurora_core.pipeline.run import run
from aurora_core.pipeline.stages import ExecutionResult, RunControl, RunRequest
from aurora_core.report.outputs import write_report
from aurora_core.report.run_folder import RunFolder
from aurora_core.report.run_report import RunReport
from aurora_core.trace.trace import Integrity

KNOWN = installed_knowledge()
PROMPT = 'A drone hovers at 20 meters over the ego car for 5 seconds.'
RUN_ID = '20260131T120000Z-0a1b2c'
HELD = 1.0


_FOUND: dict[tuple[str, int, int, str], GroundingOutcome] = {}


def _grounded(agsg: Agsg, seed: int, plan: RepairPlan | None) -> GroundingOutcome:
    """Ground a graph once in a process: the tests run the same prompt with other margins."""
    planned = '' if plan is None else plan.model_dump_json()
    key = agsg.sha256, agsg.iteration, seed, planned
    if key not in _FOUND:
        _FOUND[key] = functions.ground_stage(KNOWN, agsg, seed, plan)
    return _FOUND[key]


class FakeStages:
    """Flies nothing; execution k has the margin `margins[k]` on its first condition."""

    def __init__(self, *margins: float, cancel_at: int | None = None) -> None:
        self.margins = margins
        self.cancel_at = cancel_at
        self.plans: list[RepairPlan | None] = []
        self.no_place = 0
        self.proposal: Proposal | None = None

    def parse(self, request: RunRequest) -> ParseOutcome:
        return functions.parse_stage(KNOWN, request.prompt, request.map_name, request.seed)

    def check(self, agsg: Agsg, request: RunRequest) -> FeasibilityVerdict:
        return functions.check_stage(KNOWN, agsg)

    def ground(
        self, agsg: Agsg, request: RunRequest, plan: RepairPlan | None = None
    ) -> GroundingOutcome:
        self.plans.append(plan)
        if plan is not None and self.no_place:
            self.no_place -= 1
            failure = GroundingFailure(reason='road', tried=1, rejected_by={'road': 1})
            return GroundingOutcome(failure=failure)
        return _grounded(agsg, request.seed, plan)

    def execute(
        self, agsg: Agsg, bag_directory: Path, request: RunRequest, control: RunControl
    ) -> ExecutionResult:
        bag_directory.mkdir()
        cancelled = agsg.iteration == self.cancel_at
        return ExecutionResult(
            bag=bag_directory,
            ticks=3,
            trace_sha256=f'{agsg.iteration}',
            motion_sha256='',
            outcome='cancelled' if cancelled else 'finished',
        )

    def verify(self, agsg: Agsg, bag: Path) -> Verdict:
        margins = [HELD] * len(agsg.conditions)
        # The second one: it always hangs on the place.
        margins[1] = self.margins[agsg.iteration]
        rows = tuple(
            ConditionResult(
                id=condition.id,
                sentence=condition.sentence,
                explanation='',
                formula=condition.formula,
                spec_ids=condition.spec_ids,
                op=condition.op,
                threshold=condition.threshold,
                margin=margin,
                unit=condition.unit,
                normalised=margin,
                satisfied=margin >= 0.0,
                exercised=True,
                provenance=condition.provenance,
            )
            for condition, margin in zip(agsg.conditions, margins, strict=True)
        )
        status = VerdictStatus.VERIFIED if min(margins) >= 0.0 else VerdictStatus.VIOLATED
        return Verdict(status=status, results=rows, integrity=Integrity.INTACT)

    def propose(
        self, agsg: Agsg, verdict: Verdict, bag: Path, past: tuple[Attempt, ...]
    ) -> Proposal:
        return self.proposal or functions.repair_stage(KNOWN, agsg, verdict, past)


class Clock:
    def seconds(self) -> float:
        return 0.0


def ran(
    stages: FakeStages,
    root: Path,
    repair: int | None = 5,
    beside: Beside | None = None,
    **more: Any,
) -> RunReport:
    return run(
        RunRequest(**{'prompt': PROMPT, 'repair': repair, **more}),
        stages,
        KNOWN,
        RunFolder(root, RUN_ID),
        RunControl(),
        Clock(),
        outputs=write_report,
        beside=beside,
    )


def names(root: Path) -> set[str]:
    return {path.name for path in (root / RUN_ID).iterdir()}


class Traced(FakeStages):
    """Its trace is that of the graph, whoever executes; counts what it executes itself."""

    def __init__(self, *margins: float) -> None:
        super().__init__(*margins)
        self.executed: list[int] = []

    def execute(
        self, agsg: Agsg, bag_directory: Path, request: RunRequest, control: RunControl
    ) -> ExecutionResult:
        self.executed.append(agsg.iteration)
        found = super().execute(agsg, bag_directory, request, control)
        return found.model_copy(update={'trace_sha256': agsg.sha256})


class Workers:
    """Execute beside a run, each one as long as nobody waits for it."""

    def __init__(self, places: int, broken: bool = False) -> None:
        self.places = places
        self.broken = broken
        self.given: list[Agsg] = []
        self.dropped: list[int] = []
        self.most = 0
        self._at_work = 0

    def prepare(self) -> None:
        assert not self.given

    def begin(self, candidate: Candidate) -> Pending | None:
        self.given.append(candidate.graph)
        self._at_work += 1
        self.most = max(self.most, self._at_work)
        return Handed(self, candidate)

    def done(self) -> None:
        self._at_work -= 1
        if self.broken:
            raise SimulatorError('the worker died')


@dataclass
class Handed:
    workers: Workers
    candidate: Candidate

    def wait(self, seconds: float) -> Recorded | None:
        if not seconds:
            return None
        self.workers.done()
        graph = self.candidate.graph
        result = ExecutionResult(
            bag=Path('/elsewhere'),
            ticks=3,
            trace_sha256=graph.sha256,
            motion_sha256='',
            outcome='finished',
        )
        return Recorded(result=result, files={f'bag.{graph.iteration}_0.mcap': b'recorded'})

    def drop(self) -> None:
        self.workers._at_work -= 1
        self.workers.dropped.append(self.candidate.graph.iteration)


def told(report: RunReport) -> dict[str, Any]:
    """Return what a report says of the run, without what it took."""
    return report.model_dump(mode='json', exclude={'timing'})
