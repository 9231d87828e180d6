# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import itertools
from dataclasses import fields, replace

import pytest

from aurora_core.report.status import ExitCode, Status, StatusFacts, exit_code, status_of

_GOOD = StatusFacts(judged=True)

# In the order of the contract: what makes each status apply.
_LADDER = (
    (Status.ERROR, {'error': True}),
    (Status.CANCELLED, {'cancelled': True}),
    (Status.NOT_UNDERSTOOD, {'understood': False}),
    (Status.INFEASIBLE, {'infeasible': True}),
    (Status.INCONCLUSIVE, {'undecided': True}),
    (Status.VIOLATED, {'violated': True}),
    (Status.INCOMPLETE, {'encoded': False}),
    (Status.VERIFIED_AS_EDITED, {'edited': True}),
)


@pytest.mark.parametrize(('status', 'change'), _LADDER)
def test_each_fact_alone_gives_its_status(status: Status, change: dict[str, bool]) -> None:
    assert status_of(replace(_GOOD, **change)) is status


@pytest.mark.parametrize(('first', 'second'), list(itertools.combinations(range(len(_LADDER)), 2)))
def test_the_first_that_applies_wins(first: int, second: int) -> None:
    facts = replace(_GOOD, **_LADDER[first][1], **_LADDER[second][1])
    assert status_of(facts) is _LADDER[first][0]


def test_verified_needs_a_verdict() -> None:
    assert status_of(_GOOD) is Status.VERIFIED
    assert status_of(StatusFacts()) is Status.INCONCLUSIVE


def test_nothing_but_the_one_combination_is_verified() -> None:
    names = [field.name for field in fields(StatusFacts)]
    verified = [
        values
        for values in itertools.product((False, True), repeat=len(names))
        if status_of(StatusFacts(**dict(zip(names, values, strict=True)))) is Status.VERIFIED
    ]
    assert len(verified) == 1


def test_exit_codes_are_those_of_the_contract() -> None:
    expected = {
        'verified': 0,
        'verified_as_edited': 0,
        'violated': 1,
        'not_understood': 3,
        'incomplete': 3,
        'error': 4,
        'inconclusive': 4,
        'infeasible': 5,
        'cancelled': 130,
    }
    assert {status.value: int(exit_code(status)) for status in Status} == expected
    assert [int(code) for code in ExitCode] == [0, 1, 3, 4, 5, 6, 64, 130]
