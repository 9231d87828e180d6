# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`CheckReport`: what `aurora check` says of a prompt without simulating anything."""

from __future__ import annotations

from enum import StrEnum
from typing import Literal

from pydantic import FiniteFloat

from aurora_core.document import Document
from aurora_core.outcomes.feasibility import Feasibility, FeasibilityVerdict
from aurora_core.outcomes.schedule import PlannedTime
from aurora_core.report.build import build_report
from aurora_core.report.facts import RunFacts
from aurora_core.report.run_report import ClauseReport, ErrorReport, RealisedReport
from aurora_core.report.said_back import ElementReport
from aurora_core.report.status import ExitCode, Status
from aurora_core.spec.scenario import ScenarioSpec


class CheckResult(StrEnum):
    """Outcome of a check."""

    FEASIBLE = 'feasible'
    UNKNOWN = 'unknown'
    INCOMPLETE = 'incomplete'
    INFEASIBLE = 'infeasible'
    NOT_UNDERSTOOD = 'not_understood'
    ERROR = 'error'


_EXIT_CODES = {
    CheckResult.FEASIBLE: ExitCode.OK,
    CheckResult.UNKNOWN: ExitCode.UNKNOWN,
    CheckResult.INCOMPLETE: ExitCode.NOT_DONE,
    CheckResult.INFEASIBLE: ExitCode.INFEASIBLE,
    CheckResult.NOT_UNDERSTOOD: ExitCode.NOT_DONE,
    CheckResult.ERROR: ExitCode.BROKEN,
}


class PlannedCondition(Document):
    """A condition that a run would be judged by."""

    id: str
    sentence: str
    formula: str


class CheckReport(Document):
    """The outcome of parse, grounding and feasibility.

    Attributes:
        elements: The request said back, each element in a sentence.
        horizon_s: Simulated time that a run would take at most, None when nothing was grounded.
        times: When events, missions and landings can be at the earliest and at the latest.
        conflict: What excludes itself where it was grounded, in words; '' for nothing.
    """

    schema_version: Literal[1] = 1
    result: CheckResult
    summary: str
    prompt: str
    map: str
    seed: int
    clauses: tuple[ClauseReport, ...] = ()
    elements: tuple[ElementReport, ...] = ()
    feasibility: FeasibilityVerdict | None = None
    conditions: tuple[PlannedCondition, ...] = ()
    horizon_s: FiniteFloat | None = None
    times: tuple[PlannedTime, ...] = ()
    conflict: str = ''
    requested_and_realised: tuple[RealisedReport, ...] = ()
    question: str | None = None
    error: ErrorReport | None = None
    spec: ScenarioSpec | None = None


def build_check(facts: RunFacts) -> CheckReport:
    """Return the report of a check from what parse, check and grounding left behind."""
    report = build_report(facts)
    graph = facts.graph
    result = _result(facts, report.status, report.feasibility, report.clauses)
    conditions = graph.conditions if graph is not None else ()
    schedule = graph.schedule if graph is not None else None
    return CheckReport(
        result=result,
        summary=_summary(result, report.summary, facts),
        prompt=facts.prompt,
        map=facts.map_name,
        seed=facts.seed,
        clauses=report.clauses,
        elements=report.elements,
        feasibility=report.feasibility,
        conditions=tuple(
            PlannedCondition(id=c.id, sentence=c.sentence, formula=c.formula) for c in conditions
        ),
        horizon_s=schedule.horizon_s if schedule is not None else None,
        times=schedule.times if schedule is not None else (),
        conflict=_conflict(facts),
        requested_and_realised=report.requested_and_realised,
        question=report.question,
        error=report.error,
        spec=facts.parse.spec if facts.parse is not None else None,
    )


def check_exit_code(result: CheckResult) -> ExitCode:
    """Return the exit code of `aurora check`."""
    return _EXIT_CODES[result]


def _result(
    facts: RunFacts,
    status: Status,
    feasibility: FeasibilityVerdict | None,
    clauses: tuple[ClauseReport, ...],
) -> CheckResult:
    if status is Status.ERROR:
        return CheckResult.ERROR
    if status is Status.NOT_UNDERSTOOD:
        return CheckResult.NOT_UNDERSTOOD
    if status is Status.INFEASIBLE:
        return CheckResult.INFEASIBLE
    placed = facts.grounding is not None and facts.grounding.agsg is not None
    if not placed or feasibility is None or feasibility.result is not Feasibility.FEASIBLE:
        return CheckResult.UNKNOWN
    if _conflict(facts):
        return CheckResult.UNKNOWN
    if any(clause.status.is_open for clause in clauses):
        return CheckResult.INCOMPLETE
    return CheckResult.FEASIBLE


def _conflict(facts: RunFacts) -> str:
    schedule = facts.graph.schedule if facts.graph is not None else None
    return schedule.conflict if schedule is not None else ''


def _summary(result: CheckResult, run_summary: str, facts: RunFacts) -> str:
    if result is CheckResult.FEASIBLE:
        return 'Inside every limit, and a place for it was found on the map.'
    if result is CheckResult.INCOMPLETE:
        return 'Inside every limit and placed, but a clause of the prompt is not encoded.'
    if result is CheckResult.UNKNOWN:
        failure = facts.grounding.failure if facts.grounding is not None else None
        why = ': its times exclude each other where it was placed' if _conflict(facts) else ''
        if failure is not None:
            why = f': no place was found ({failure.reason}; {failure.tried} tried)'
        return f'Neither proved feasible nor infeasible{why}.'
    return run_summary
