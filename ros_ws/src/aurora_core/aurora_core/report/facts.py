# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`RunFacts`: everything that the stages of a run left behind, as far as it got."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from aurora_core.errors import AuroraError
from aurora_core.execution.faults import Fault
from aurora_core.knowledge.limits import Limits
from aurora_core.outcomes.agsg import Agsg
from aurora_core.outcomes.feasibility import FeasibilityVerdict
from aurora_core.outcomes.grounding import GroundingOutcome
from aurora_core.outcomes.parse import ParseOutcome
from aurora_core.outcomes.verdict import Verdict
from aurora_core.report.run_report import BagReport, RelaxedReport, RepairReport


@dataclass(frozen=True, slots=True, kw_only=True)
class ExecutionFacts:
    """What the execution left behind.

    Attributes:
        bag: Folder of the bag, relative to the run folder when it is inside.
        ticks: Number of recorded ticks.
        dt_s: Time step.
        trace_sha256: Trace hash (hex).
        motion_sha256: The same without the world and its conditions (hex).
    """

    bag: str
    ticks: int
    dt_s: float
    trace_sha256: str
    motion_sha256: str


@dataclass(frozen=True, slots=True, kw_only=True)
class RunFacts:
    """Facts of one run; a stage that was not reached left None.

    Attributes:
        prompt: As typed.
        versions: Versions of the product and of what decides results.
        map_digest: sha256 of the map, '' when it was not loaded.
        parse: A specification, a question or refusals.
        feasibility: The last verdict of the check.
        grounding: Graph or failure, and what cannot be executed or judged yet.
        agsg: The graph that was executed last; the one of `grounding` when omitted.
        execution: The last one.
        bags: Of all executions.
        verdict: The last verdict.
        cancelled: The user stopped the run.
        error: What broke.
        timing: Wall seconds by stage.
        iterations: Executions made.
        relaxed: The request was changed with the user's leave.
    """

    run_id: str
    prompt: str
    engine: str = 'local'
    model: str = 'offline'
    map_name: str = 'downtown'
    seed: int = 1
    versions: Mapping[str, str] = field(default_factory=dict)
    limits: Limits | None = None
    map_digest: str = ''
    parse: ParseOutcome | None = None
    feasibility: FeasibilityVerdict | None = None
    grounding: GroundingOutcome | None = None
    agsg: Agsg | None = None
    execution: ExecutionFacts | None = None
    bags: tuple[BagReport, ...] = ()
    verdict: Verdict | None = None
    cancelled: bool = False
    error: AuroraError | None = None
    timing: Mapping[str, float] = field(default_factory=dict)
    faults: tuple[Fault, ...] = ()
    iterations: int = 0
    repairs: tuple[RepairReport, ...] = ()
    relaxed: RelaxedReport | None = None

    @property
    def graph(self) -> Agsg | None:
        """The graph that was executed last, else the grounded one."""
        if self.agsg is not None:
            return self.agsg
        return self.grounding.agsg if self.grounding is not None else None
