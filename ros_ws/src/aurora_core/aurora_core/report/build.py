# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Build the report of a run from what its stages left behind."""

from __future__ import annotations

import hashlib

from aurora_core.outcomes.agsg import Agsg
from aurora_core.outcomes.condition import Condition
from aurora_core.outcomes.feasibility import Certificate, Feasibility, FeasibilityVerdict
from aurora_core.outcomes.parse import ParseOutcome, Refusal
from aurora_core.outcomes.verdict import VerdictStatus
from aurora_core.report.clauses import clause_reports
from aurora_core.report.facts import RunFacts
from aurora_core.report.judged import condition_reports, is_undecided
from aurora_core.report.run_report import (
    ClauseReport,
    ConditionReport,
    Cost,
    Digests,
    ErrorReport,
    Metrics,
    RealisedReport,
    RunReport,
    TraceReport,
)
from aurora_core.report.said_back import said_back
from aurora_core.report.status import StatusFacts, status_of
from aurora_core.report.summary import summary_of
from aurora_core.spec.vocabulary import ClauseStatus
from aurora_core.trace.trace import Integrity


def build_report(facts: RunFacts) -> RunReport:
    """Return the report of a run, however far it got."""
    feasibility = _feasibility(facts)
    clauses, rows = _judged(facts)
    graph = facts.graph
    conditions = graph.conditions if graph is not None else ()
    status = status_of(_status_facts(facts, feasibility, clauses, rows, conditions))
    report = RunReport(
        run_id=facts.run_id,
        status=status,
        summary='',
        prompt=facts.prompt,
        engine=facts.engine,
        model=facts.model,
        map=facts.map_name,
        seed=facts.seed,
        versions=dict(sorted(facts.versions.items())),
        digests=_digests(facts, graph),
        limits=facts.limits,
        feasibility=feasibility,
        repairs=facts.repairs,
        relaxed=facts.relaxed,
        timing=dict(facts.timing),
        cost=_cost(facts),
        trace=_trace(facts),
        bags=facts.bags,
        question=facts.parse.question if facts.parse is not None else None,
        error=_error(facts),
        faults=facts.faults,
    )
    return restated(report, facts)


def restated(report: RunReport, facts: RunFacts) -> RunReport:
    """Return a report with all that follows from recording and status worked out anew."""
    clauses, rows = _judged(facts)
    spec = facts.parse.spec if facts.parse is not None else None
    if facts.graph is not None:
        spec = facts.graph.spec  # with what grounding chose where the request leaves it open
    changes: dict[str, object] = {
        'clauses': clauses,
        'elements': () if spec is None else said_back(spec),
        'conditions': rows,
        'metrics': _metrics(facts, clauses, rows),
        'requested_and_realised': _realised(facts.graph),
    }
    whole = report.model_copy(update=changes)
    return whole.model_copy(update={'summary': summary_of(whole, facts.grounding)})


def _judged(facts: RunFacts) -> tuple[tuple[ClauseReport, ...], tuple[ConditionReport, ...]]:
    clauses = clause_reports(facts)
    if facts.verdict is None:
        return clauses, ()
    return clauses, condition_reports(facts.prompt, clauses, facts.verdict)


def _status_facts(
    facts: RunFacts,
    feasibility: FeasibilityVerdict | None,
    clauses: tuple[ClauseReport, ...],
    rows: tuple[ConditionReport, ...],
    conditions: tuple[Condition, ...],
) -> StatusFacts:
    verdict = facts.verdict
    # Without clauses nobody has shown that the whole prompt was read.
    encoded = bool(clauses) and all(not clause.status.is_open for clause in clauses)
    other = facts.relaxed.verdict if facts.relaxed is not None else None
    edited = encoded and other is VerdictStatus.VERIFIED
    judged = verdict is not None and {r.id for r in rows} >= {c.id for c in conditions}
    return StatusFacts(
        error=facts.error is not None,
        cancelled=facts.cancelled,
        understood=_understood(facts.parse),
        infeasible=feasibility is not None and feasibility.result is Feasibility.INFEASIBLE,
        judged=judged and bool(rows),
        undecided=verdict is not None and is_undecided(verdict),
        violated=not edited and not all(row.satisfied and row.exercised for row in rows),
        encoded=encoded,
        edited=edited,
    )


def _understood(parse: ParseOutcome | None) -> bool:
    return parse is not None and (parse.spec is not None or bool(parse.refusals))


def _feasibility(facts: RunFacts) -> FeasibilityVerdict | None:
    """Return the verdict of the check; what the parser refused is a proof as well."""
    if facts.parse is not None and facts.parse.refusals:
        return FeasibilityVerdict(
            result=Feasibility.INFEASIBLE,
            certificates=tuple(refusal_certificate(r) for r in facts.parse.refusals),
        )
    return facts.feasibility


def refusal_certificate(refusal: Refusal) -> Certificate:
    """Return the certificate of something that the closed list of map or vocabulary lacks."""
    return Certificate(
        kind=refusal.kind.value,
        reason=refusal.kind.value,
        path=refusal.list_name,
        word=refusal.word,
        listing=refusal.closed_list,
        span=refusal.span,
        sentence=refusal.sentence(),
    )


def _digests(facts: RunFacts, graph: Agsg | None) -> Digests:
    spec = graph.spec if graph is not None else (facts.parse.spec if facts.parse else None)
    return Digests(
        prompt=_sha256(facts.prompt),
        map=facts.map_digest or (graph.map_digest if graph is not None else ''),
        spec=_sha256(spec.canonical_json()) if spec is not None else '',
        agsg=graph.sha256 if graph is not None else '',
    )


def _sha256(text: str) -> str:
    return hashlib.sha256(text.encode('utf-8', 'surrogatepass')).hexdigest()


def _metrics(
    facts: RunFacts, clauses: tuple[ClauseReport, ...], rows: tuple[ConditionReport, ...]
) -> Metrics:
    worst = facts.verdict.worst if facts.verdict is not None else None
    execution = facts.execution
    return Metrics(
        conditions=len(rows),
        satisfied=sum(row.satisfied for row in rows),
        worst_condition=worst.id if worst is not None else None,
        worst_normalised=worst.normalised if worst is not None else None,
        clauses=len(clauses),
        clauses_encoded=sum(clause.status is ClauseStatus.ENCODED for clause in clauses),
        iterations=facts.iterations,
        simulated_s=max(execution.ticks - 1, 0) * execution.dt_s if execution else None,
    )


def _cost(facts: RunFacts) -> Cost:
    """Add up what language models cost; money is unknown as soon as one price is."""
    calls = facts.parse.model_calls if facts.parse is not None else ()
    prices = [call.cost_usd for call in calls if call.failure is None]
    known = [price for price in prices if price is not None]
    return Cost(
        calls=len(calls),
        tokens_in=sum(call.tokens_in for call in calls),
        tokens_out=sum(call.tokens_out for call in calls),
        money_usd=sum(known) if prices and len(known) == len(prices) else None,
    )


def _trace(facts: RunFacts) -> TraceReport | None:
    execution, verdict = facts.execution, facts.verdict
    if execution is None:
        return None
    return TraceReport(
        bag=execution.bag,
        ticks=execution.ticks,
        sha256=execution.trace_sha256,
        motion_sha256=execution.motion_sha256,
        integrity=verdict.integrity if verdict is not None else Integrity.UNKNOWN,
        notes=verdict.notes if verdict is not None else (),
        cross_check=verdict.cross_check if verdict is not None else (),
        verdict=verdict.status if verdict is not None else None,
        clocks=verdict.clocks if verdict is not None else (),
    )


def _error(facts: RunFacts) -> ErrorReport | None:
    err = facts.error
    if err is None:
        return None
    return ErrorReport(code=err.code, component=err.component, message=err.message, hint=err.hint)


def _realised(graph: Agsg | None) -> tuple[RealisedReport, ...]:
    if graph is None or graph.grounding is None:
        return ()
    units = {parameter.path: parameter.unit.value for parameter in graph.parameters}
    return tuple(
        RealisedReport(
            path=value.path,
            requested=value.requested,
            realised=value.realised,
            unit=units.get(value.path, ''),
            provenance=value.provenance,
        )
        for value in graph.grounding.realised
    )
