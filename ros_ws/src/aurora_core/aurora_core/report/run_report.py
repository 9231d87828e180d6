# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`RunReport`: everything that is said about a run, the document `report.json`."""

from __future__ import annotations

from enum import StrEnum
from typing import Literal

from pydantic import Field, FiniteFloat

from aurora_core.document import Document, omitted
from aurora_core.execution.faults import Fault
from aurora_core.knowledge.limits import Limits
from aurora_core.outcomes.feasibility import FeasibilityVerdict
from aurora_core.outcomes.repair import Implicated
from aurora_core.outcomes.verdict import Finding, Reason, VerdictStatus
from aurora_core.report.said_back import ElementReport
from aurora_core.report.status import Status
from aurora_core.spec.parameter import Provenance, Span
from aurora_core.spec.vocabulary import ClauseStatus
from aurora_core.trace.air_clock import AirClock
from aurora_core.trace.trace import Integrity


class ClauseReport(Document):
    """A piece of the prompt and what became of it.

    Attributes:
        ids: Elements of the specification that it became.
        note: Why it is not encoded (the capability that is missing), or what was read from it.
    """

    text: str
    span: Span
    status: ClauseStatus
    ids: tuple[str, ...] = ()
    note: str = ''


class ConditionReport(Document):
    """One success condition and its margin.

    Attributes:
        sentence: English.
        formula: STL text.
        source: What the prompt says about it, quoted; () when it holds in every run.
        spec_ids: Elements of the specification.
        margin: Signed robustness in `unit`, None with a `reason`.
        normalised: Margin divided by the scale of the threshold.
        exercised: False when the premise never occurred.
        reason: Why there is no margin.
        worst_time_s: Simulated time of the sample that decides.
        worst_place_m: Position of the body concerned at that time, ENU metres.
        explanation: What happened, with numbers.
        evidence: Topics and ticks that were used.
    """

    id: str
    sentence: str
    formula: str
    source: tuple[str, ...] = ()
    spec_ids: tuple[str, ...] = ()
    implied: bool
    provenance: Provenance
    op: str
    threshold: FiniteFloat
    tolerance: FiniteFloat | None = None
    unit: str
    margin: FiniteFloat | None = None
    normalised: FiniteFloat | None = None
    satisfied: bool
    exercised: bool
    reason: Reason | None = None
    worst_time_s: FiniteFloat | None = None
    worst_place_m: tuple[FiniteFloat, FiniteFloat, FiniteFloat] | None = None
    explanation: str = ''
    evidence: tuple[str, ...] = ()


class ChangeKind(StrEnum):
    """What an edit changes: how the request is realised, or the request itself."""

    REALIZATION = 'realization'
    CONDITION = 'condition'


class EditReport(Document):
    """One changed value."""

    path: str
    old: FiniteFloat | str | None
    new: FiniteFloat | str | None
    provenance: Provenance
    change: ChangeKind


class MarginChange(Document):
    """Normalised margin of a condition as repair expected it and as it came out.

    Attributes:
        before: In the realisation that the edit answers to.
    """

    condition: str
    before: FiniteFloat | None = None
    predicted: FiniteFloat | None = None
    realised: FiniteFloat | None = None


class RepairReport(Document):
    """One attempt of repair.

    Attributes:
        iteration: Whose files it is in; of an attempt without a simulation, the next one's.
        kind: Step of the escalation.
        edits: What was realised otherwise than in the realisation before.
        margins: Of every condition, where it was simulated.
        reason: Why it was tried, or why nothing was simulated.
        outcome: What came of it, see `outcomes.repair.AttemptOutcome`.
        bag: Folder of its bag, None where nothing was simulated.
        implicated: What the fault localization put first.
        engine: Who executed it, where that is not the engine of the run: a candidate.
        confirms: Number of the candidate that the engine of the run executed again.
    """

    iteration: int
    kind: str
    edits: tuple[EditReport, ...] = ()
    margins: tuple[MarginChange, ...] = ()
    reason: str = ''
    outcome: str = ''
    bag: str | None = None
    implicated: tuple[Implicated, ...] = ()
    engine: str = omitted('')
    confirms: int | None = omitted(None)


class StatedChange(Document):
    """A stated number with which a condition would hold on the recorded trace.

    Attributes:
        path: Of the number in the specification.
        stated: As the prompt has it.
        relaxed: As it would have to be.
        condition: That would hold.
        sentence: What that would then say.
    """

    path: str
    stated: FiniteFloat
    relaxed: FiniteFloat
    unit: str = ''
    condition: str
    sentence: str


class RelaxedReport(Document):
    """Another request, which the recorded run would satisfy better than the one that was asked.

    Attributes:
        changes: What of the request would be another number.
        verdict: On the request with all changes, from the same trace.
    """

    changes: tuple[StatedChange, ...]
    verdict: VerdictStatus


class RealisedReport(Document):
    """A number of the request and what grounding made of it."""

    path: str
    requested: FiniteFloat
    realised: FiniteFloat
    unit: str = ''
    provenance: Provenance


class Metrics(Document):
    """Figures over the whole run; None where there was nothing to measure.

    Attributes:
        worst_condition: Condition with the least normalised margin; one without a margin comes
            first, then `worst_normalised` is None.
    """

    conditions: int = 0
    satisfied: int = 0
    worst_condition: str | None = None
    worst_normalised: FiniteFloat | None = None
    clauses: int = 0
    clauses_encoded: int = 0
    iterations: int = 0
    simulated_s: FiniteFloat | None = None


class Cost(Document):
    """What language models cost (the offline parser calls none)."""

    calls: int = 0
    tokens_in: int = 0
    tokens_out: int = 0
    money_usd: FiniteFloat | None = None


class TraceReport(Document):
    """The recording that the verdict is about.

    Attributes:
        bag: Folder of the bag, relative to the run folder when it is inside.
        ticks: Number of recorded ticks.
        sha256: Trace hash (hex).
        motion_sha256: Hash (hex) of roster, states, commands, links, sight and events alone; '' in
            reports of older versions.
        integrity: State of the recording, apart from the margins.
        notes: What is damaged, for people.
        cross_check: Where the executor's record and the recomputation disagree.
        verdict: What the trace alone shows, apart from the prompt's clauses; None when it was not
            judged (cancelled, broken).
        clocks: Of autopilots that kept their own time; () of a run in lockstep.
    """

    bag: str
    ticks: int
    sha256: str
    motion_sha256: str = ''
    integrity: Integrity
    notes: tuple[str, ...] = ()
    cross_check: tuple[Finding, ...] = ()
    verdict: VerdictStatus | None = None
    clocks: tuple[AirClock, ...] = omitted(())


class BagReport(Document):
    """One of the bags of a run, by which it is told from every other.

    Attributes:
        bag: Folder of the bag, relative to the run folder when it is inside.
        iteration: Repair iteration.
        trace_sha256: Trace hash (hex).
        graph_sha256: Digest (hex) of the graph that was executed.
    """

    bag: str
    iteration: int
    ticks: int
    trace_sha256: str
    graph_sha256: str


class Digests(Document):
    """sha256 (hex) of what the run was made from; '' for what it did not reach."""

    prompt: str
    map: str = ''
    spec: str = ''
    agsg: str = ''


class ErrorReport(Document):
    """What broke, where, and what to do."""

    code: int
    component: str
    message: str
    hint: str = ''


class RunReport(Document):
    """The report of one run.

    Attributes:
        summary: Why the status is what it is, one or two sentences.
        bags: Every bag of the run in the order of the iterations; None in reports of older
            versions.
        clauses: Every clause of the prompt.
        elements: The request said back, each element in a sentence.
        conditions: Every success condition with its margin.
        relaxed: What of the request would have to be another for the run to hold, where that was
            asked for; the status is that of the request as it is.
        timing: Wall seconds by stage.
        question: What was missing (status `not_understood`).
    """

    schema_version: Literal[1] = 1
    run_id: str
    status: Status
    summary: str
    prompt: str
    engine: str
    model: str
    map: str
    seed: int
    versions: dict[str, str] = Field(default_factory=dict)
    digests: Digests
    limits: Limits | None = None
    clauses: tuple[ClauseReport, ...] = ()
    elements: tuple[ElementReport, ...] = ()
    conditions: tuple[ConditionReport, ...] = ()
    feasibility: FeasibilityVerdict | None = None
    repairs: tuple[RepairReport, ...] = ()
    relaxed: RelaxedReport | None = omitted(None)
    metrics: Metrics = Metrics()
    timing: dict[str, FiniteFloat] = Field(default_factory=dict)
    cost: Cost = Cost()
    trace: TraceReport | None = None
    bags: tuple[BagReport, ...] | None = None
    question: str | None = None
    error: ErrorReport | None = None
    faults: tuple[Fault, ...] = ()
    requested_and_realised: tuple[RealisedReport, ...] = ()
