# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import json
from types import SimpleNamespace
from typing import Any

import pytest
from pydantic import ValidationError

from aurora_core.errors import ExecutionError
from aurora_core.outcomes.feasibility import Certificate, Feasibility, FeasibilityVerdict
from aurora_core.outcomes.grounding import GroundingFailure, GroundingOutcome
from aurora_core.outcomes.parse import ParseOutcome, Refusal, RefusalKind
from aurora_core.outcomes.verdict import Finding, Reason, VerdictStatus
from aurora_core.report.build import build_report
from aurora_core.report.run_report import RelaxedReport, RunReport, StatedChange
from aurora_core.report.status import Status
from aurora_core.report.summary import margin_value
from aurora_core.spec.parameter import Span
from aurora_core.trace.trace import Integrity


def test_a_run_in_which_everything_holds_is_verified(make: SimpleNamespace) -> None:
    report = build_report(make.facts())
    assert report.status is Status.VERIFIED
    assert '1 of 1 conditions hold' in report.summary
    assert report.metrics.simulated_s == pytest.approx(60.0)
    assert report.metrics.worst_condition == 'm1.visible'
    assert report.conditions[0].source == ('A drone follows a motorcycle', 'at 40 meters')
    assert report.requested_and_realised[0].unit == 'm'
    assert report.digests.agsg == make.graph().sha256


def test_the_report_survives_a_round_trip_through_json(make: SimpleNamespace) -> None:
    report = build_report(make.facts())
    text = json.dumps(report.model_dump(mode='json'), allow_nan=False)
    assert RunReport.model_validate_json(text) == report


def test_a_condition_that_fails_is_violated_and_told(make: SimpleNamespace) -> None:
    report = build_report(make.facts(verdict=make.verdict(make.result(margin=-0.3))))
    assert report.status is Status.VIOLATED
    assert 'margin -0.3 at 12.50 s' in report.summary
    assert report.metrics.satisfied == 0


@pytest.mark.parametrize('reason', [Reason.PREMISE_NEVER, Reason.EMPTY_PHASE, Reason.TARGET_GONE])
def test_a_null_margin_that_shows_a_failure_is_violated(
    make: SimpleNamespace, reason: Reason
) -> None:
    verdict = make.verdict(make.result(margin=None, reason=reason))
    report = build_report(make.facts(verdict=verdict))
    assert report.status is Status.VIOLATED
    assert report.conditions[0].margin is None
    assert margin_value(None, '', reason) in report.summary


@pytest.mark.parametrize('reason', [Reason.SAMPLES_MISSING, Reason.TRACE_SHORT])
def test_a_null_margin_of_a_poor_trace_is_inconclusive(
    make: SimpleNamespace, reason: Reason
) -> None:
    verdict = make.verdict(make.result(margin=None, reason=reason))
    report = build_report(make.facts(verdict=verdict))
    assert report.status is Status.INCONCLUSIVE
    assert 'm1.visible' in report.summary


@pytest.mark.parametrize('integrity', [Integrity.ALTERED, Integrity.TRUNCATED, Integrity.UNKNOWN])
def test_a_bag_that_is_not_intact_never_passes(
    make: SimpleNamespace, integrity: Integrity
) -> None:
    # Even when the monitor forgot to say so in its status.
    verdict = make.verdict(integrity=integrity, notes=('the end is missing',))
    report = build_report(make.facts(verdict=verdict))
    assert report.status is Status.INCONCLUSIVE
    assert 'the end is missing' in report.summary


def test_record_and_recomputation_that_disagree_never_pass(make: SimpleNamespace) -> None:
    finding = Finding(kind='sight', subject='uav1', tick=20, time_s=1.0, text='claimed in sight')
    report = build_report(make.facts(verdict=make.verdict(cross_check=(finding,))))
    assert report.status is Status.INCONCLUSIVE
    assert 'claimed in sight' in report.summary


def test_a_condition_that_nobody_judged_is_not_passed_over(make: SimpleNamespace) -> None:
    graph = make.graph(make.condition(), make.condition('m1.tracked'))
    report = build_report(make.facts(grounding=GroundingOutcome(agsg=graph)))
    assert report.status is Status.INCONCLUSIVE


def test_a_capability_that_is_missing_makes_the_run_incomplete(make: SimpleNamespace) -> None:
    grounding = GroundingOutcome(
        agsg=make.graph(), unsupported=('motorcycle1: placement oncoming',)
    )
    report = build_report(make.facts(grounding=grounding))
    assert report.status is Status.INCOMPLETE
    assert '“A drone follows a motorcycle” (placement oncoming)' in report.summary


def test_a_prompt_that_was_not_divided_into_clauses_is_incomplete(make: SimpleNamespace) -> None:
    spec = make.spec(clauses=())
    report = build_report(make.facts(parse=ParseOutcome(spec=spec)))
    assert report.status is Status.INCOMPLETE


def test_a_question_is_not_understood(make: SimpleNamespace) -> None:
    report = build_report(
        make.facts(
            parse=ParseOutcome(question='Which car is the ego?'),
            grounding=None,
            execution=None,
            verdict=None,
        )
    )
    assert report.status is Status.NOT_UNDERSTOOD
    assert report.question == report.summary == 'Which car is the ego?'


def test_a_refusal_of_the_parser_is_infeasible_with_a_certificate(make: SimpleNamespace) -> None:
    refusal = Refusal(
        kind=RefusalKind.MISSING_ELEMENT,
        word='harbour',
        span=Span(start=0, end=7),
        list_name='landmarks of downtown',
        closed_list=('City Hall', 'Union Station'),
    )
    report = build_report(
        make.facts(
            parse=ParseOutcome(refusals=(refusal,)), grounding=None, execution=None, verdict=None
        )
    )
    assert report.status is Status.INFEASIBLE
    assert report.feasibility is not None
    proof = report.feasibility.certificates[0]
    assert (proof.kind, proof.word) == ('missing_element', 'harbour')
    assert proof.listing == ('City Hall', 'Union Station')


def test_a_limit_is_infeasible(make: SimpleNamespace) -> None:
    proof = Certificate(
        kind='limit_exceeded', reason='altitude_limit', path='p', sentence='Too high by far.'
    )
    verdict = FeasibilityVerdict(result=Feasibility.INFEASIBLE, certificates=(proof,))
    report = build_report(
        make.facts(feasibility=verdict, grounding=None, execution=None, verdict=None)
    )
    assert report.status is Status.INFEASIBLE
    assert 'Too high by far.' in report.summary


def test_a_place_that_was_not_found_is_no_proof(make: SimpleNamespace) -> None:
    failure = GroundingFailure(reason='no straight street', tried=40, rejected_by={'length': 40})
    report = build_report(
        make.facts(grounding=GroundingOutcome(failure=failure), execution=None, verdict=None)
    )
    assert report.status is Status.INCONCLUSIVE
    assert 'not proven' in report.summary
    assert 'no straight street' in report.summary


def test_what_broke_is_told_and_comes_first(make: SimpleNamespace) -> None:
    err = ExecutionError('the barrier stood still', hint='see the log', component='sync', code=510)
    report = build_report(make.facts(error=err, cancelled=True))
    assert report.status is Status.ERROR
    assert report.error is not None
    assert (report.error.code, report.error.component) == (510, 'sync')
    assert report.error.hint == 'see the log'


def test_a_cancelled_run_keeps_its_trace_but_claims_nothing(make: SimpleNamespace) -> None:
    report = build_report(make.facts(cancelled=True, verdict=None))
    assert report.status is Status.CANCELLED
    assert report.trace is not None
    assert report.trace.integrity is Integrity.UNKNOWN
    assert report.trace.verdict is None


@pytest.mark.parametrize(
    ('other', 'status'),
    [
        (VerdictStatus.VERIFIED, Status.VERIFIED_AS_EDITED),
        (VerdictStatus.VIOLATED, Status.VIOLATED),
    ],
)
def test_a_change_of_the_request_is_told_in_the_status(
    make: SimpleNamespace, other: VerdictStatus, status: Status
) -> None:
    change = StatedChange(
        path='conditions/c1/value',
        stated=20.0,
        relaxed=23.5,
        unit='m',
        condition='c1',
        sentence='d <= 23.5 m',
    )
    relaxed = RelaxedReport(changes=(change,), verdict=other)
    report = build_report(
        make.facts(verdict=make.verdict(make.result(margin=-0.3)), relaxed=relaxed)
    )
    assert report.status is status
    assert report.relaxed == relaxed
    assert report.trace is not None
    assert report.trace.verdict is VerdictStatus.VIOLATED
    assert ('23.5 m instead of 20 m' in report.summary) is (status is Status.VERIFIED_AS_EDITED)


def test_the_monitor_can_be_more_careful_than_its_margins(make: SimpleNamespace) -> None:
    verdict = make.verdict(status=VerdictStatus.INCONCLUSIVE)
    assert build_report(make.facts(verdict=verdict)).status is Status.INCONCLUSIVE


@pytest.mark.parametrize('change', [{'unheard_of': 1}, {'seed': float('nan')}, {'status': 'fine'}])
def test_the_document_is_closed(make: SimpleNamespace, change: dict[str, Any]) -> None:
    values = build_report(make.facts()).model_dump()
    with pytest.raises(ValidationError):
        RunReport.model_validate({**values, **change})
