# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from types import SimpleNamespace

import pytest

from aurora_core.errors import MapError
from aurora_core.outcomes.feasibility import Certificate, Feasibility, FeasibilityVerdict
from aurora_core.outcomes.grounding import GroundingFailure, GroundingOutcome
from aurora_core.outcomes.parse import ParseOutcome
from aurora_core.report.check_report import CheckResult, build_check, check_exit_code
from aurora_core.report.facts import RunFacts

FEASIBLE = FeasibilityVerdict(result=Feasibility.FEASIBLE)


def _facts(make: SimpleNamespace, **changes: object) -> RunFacts:
    values = {'execution': None, 'verdict': None, 'feasibility': FEASIBLE, **changes}
    facts: RunFacts = make.facts(**values)
    return facts


def test_a_placed_request_inside_the_limits_is_feasible(make: SimpleNamespace) -> None:
    report = build_check(_facts(make))
    assert report.result is CheckResult.FEASIBLE
    assert [condition.id for condition in report.conditions] == ['m1.visible']
    assert report.spec == make.spec()


def test_no_place_found_is_unknown_not_infeasible(make: SimpleNamespace) -> None:
    failure = GroundingFailure(reason='no street', tried=3, rejected_by={})
    report = build_check(_facts(make, grounding=GroundingOutcome(failure=failure)))
    assert report.result is CheckResult.UNKNOWN
    assert 'no street' in report.summary


def test_an_undecided_check_is_unknown(make: SimpleNamespace) -> None:
    undecided = FeasibilityVerdict(result=Feasibility.UNKNOWN)
    assert build_check(_facts(make, feasibility=undecided)).result is CheckResult.UNKNOWN


def test_a_missing_capability_is_incomplete(make: SimpleNamespace) -> None:
    grounding = GroundingOutcome(agsg=make.graph(), unsupported=('m1: something',))
    assert build_check(_facts(make, grounding=grounding)).result is CheckResult.INCOMPLETE


def test_a_broken_limit_is_infeasible(make: SimpleNamespace) -> None:
    proof = Certificate(kind='limit_exceeded', reason='r', path='p', sentence='Too high.')
    verdict = FeasibilityVerdict(result=Feasibility.INFEASIBLE, certificates=(proof,))
    report = build_check(_facts(make, feasibility=verdict, grounding=None))
    assert report.result is CheckResult.INFEASIBLE
    assert 'Too high.' in report.summary


def test_a_question_and_an_error_have_their_own_results(make: SimpleNamespace) -> None:
    asked = _facts(make, parse=ParseOutcome(question='Which?'), grounding=None, feasibility=None)
    assert build_check(asked).result is CheckResult.NOT_UNDERSTOOD
    broken = _facts(make, error=MapError('no such map'))
    assert build_check(broken).result is CheckResult.ERROR


@pytest.mark.parametrize(
    ('result', 'code'),
    [
        ('feasible', 0),
        ('unknown', 6),
        ('incomplete', 3),
        ('infeasible', 5),
        ('not_understood', 3),
        ('error', 4),
    ],
)
def test_exit_codes_are_those_of_the_contract(result: str, code: int) -> None:
    assert check_exit_code(CheckResult(result)) == code
