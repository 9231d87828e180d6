# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The message ledger against its model: only chance is taken from the record."""

from __future__ import annotations

from dataclasses import replace
from types import ModuleType
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.stats import binom

from aurora_core.quantities.ledger import (
    LinkModel,
    binomial_interval,
    ledger_disagreements,
    messages,
)
from aurora_core.quantities.view import RunView
from aurora_core.trace.records import LinkEventKind, LinkRecord, LossReason

MODEL = LinkModel(
    link_id='l1',
    sender='uav1',
    receiver='ego',
    loss=0.0,
    latency_s=0.1,
    retransmissions=3,
    interval_s=0.2,
    range_sight_m=500.0,
    range_blocked_m=200.0,
)


@pytest.fixture(name='case')
def _case(tb: ModuleType) -> Any:
    return tb.tailgate_case(lost=2)


def _view(case: Any, records: list[LinkRecord] | None = None) -> RunView:
    if records is not None:
        case.run.links[:] = records
    return RunView(case.run.trace(), case.world)


def _texts(case: Any, model: LinkModel = MODEL, statistics_from: int = 30) -> list[str]:
    return [item.text for item in ledger_disagreements(_view(case), (model,), statistics_from)]


def _change(case: Any, kind: LinkEventKind, **values: Any) -> None:
    case.run.links[:] = [replace(r, **values) if r.kind is kind else r for r in case.run.links]


def test_delivery_is_the_passed_attempt_plus_the_latency(case: Any) -> None:
    (message,) = messages(_view(case), (MODEL,))
    sent = message.sent_tick
    assert [a.tick - sent for a in message.attempts] == [0, 4, 8]
    assert [a.passed for a in message.attempts] == [False, False, True]
    assert message.delivered_tick == sent + 8 + 2


def test_an_honest_ledger_agrees(case: Any) -> None:
    assert _texts(case) == []


def test_a_message_that_never_passes_is_not_delivered(tb: ModuleType) -> None:
    case = tb.tailgate_case(lost=9)
    (message,) = messages(_view(case), (MODEL,))
    assert message.delivered_tick is None
    assert len(message.attempts) == 4
    assert _texts(case) == []


def test_a_forged_receipt_is_found(case: Any) -> None:
    delivered = next(r for r in case.run.links if r.kind is LinkEventKind.DELIVERED)
    _change(case, LinkEventKind.DELIVERED, tick=delivered.tick - 1)
    assert any(f'due at tick {delivered.tick}' in text for text in _texts(case))


def test_a_receipt_without_a_passed_attempt_is_found(case: Any) -> None:
    case.run.links[:] = [r for r in case.run.links if r.kind is not LinkEventKind.ATTEMPT_PASSED]
    assert any('no attempt passed' in text for text in _texts(case))


def test_a_missing_receipt_is_found(case: Any) -> None:
    case.run.links[:] = [r for r in case.run.links if r.kind is not LinkEventKind.DELIVERED]
    assert any('no receipt is recorded' in text for text in _texts(case))


def test_a_wrong_retransmission_time_is_found(case: Any) -> None:
    case.run.links[:] = [
        replace(r, tick=r.tick + 1) if r.attempt == 1 else r for r in case.run.links
    ]
    assert any('attempt 1 at tick' in text for text in _texts(case))


def test_too_many_attempts_are_found(case: Any) -> None:
    assert any(
        '3 attempts, the link allows 2' in t
        for t in _texts(case, replace(MODEL, retransmissions=1))
    )


def test_giving_up_too_early_is_found(tb: ModuleType) -> None:
    case = tb.tailgate_case(lost=9)
    assert any('could still arrive' in t for t in _texts(case, replace(MODEL, retransmissions=5)))


def test_passing_out_of_range_is_found(case: Any) -> None:
    texts = _texts(case, replace(MODEL, range_sight_m=10.0))
    assert any('passed out of range' in text for text in texts)
    assert any('lost for RANDOM while out of range' in text for text in texts)


def test_losing_for_range_while_in_range_is_found(case: Any) -> None:
    _change(case, LinkEventKind.ATTEMPT_LOST, reason=LossReason.RANGE)
    assert any('lost for RANGE while in range' in text for text in _texts(case))


def test_false_geometry_is_found(case: Any) -> None:
    _change(case, LinkEventKind.SENT, distance_m=5.0, line_of_sight=False)
    texts = _texts(case)
    assert any('claims 5.0 m' in text for text in texts)
    assert any('claims line of sight False' in text for text in texts)


@pytest.mark.parametrize(
    ('values', 'text'),
    [
        ({'link': 'l9'}, 'belongs to no link'),
        ({'receiver': 'van1'}, 'another sender or receiver'),
        ({'tick': 99999}, 'outside the recorded ticks'),
        ({'message': 7}, 'of a message that was never sent'),
    ],
)
def test_entries_that_do_not_belong_are_found(
    case: Any, values: dict[str, Any], text: str
) -> None:
    _change(case, LinkEventKind.DELIVERED, **values)
    assert any(text in found for found in _texts(case))


def test_losses_are_compared_with_the_model_once_there_are_enough(case: Any) -> None:
    assert any('99 % interval' in text for text in _texts(case, statistics_from=3))
    assert _texts(case, replace(MODEL, loss=0.5), statistics_from=3) == []


@settings(max_examples=60, deadline=None, derandomize=True)
@given(st.integers(1, 80), st.floats(0.01, 0.99))
def test_the_interval_is_the_central_one(attempts: int, probability: float) -> None:
    low, high = binomial_interval(attempts, probability)
    below = binom.cdf(low - 1, attempts, probability)
    above = binom.sf(high, attempts, probability)
    assert below <= 0.005 + 1e-12
    assert above <= 0.005 + 1e-12
    assert binom.cdf(low, attempts, probability) > 0.005 - 1e-12
    assert binom.sf(high - 1, attempts, probability) > 0.005 - 1e-12


def test_certain_links_leave_no_room() -> None:
    assert binomial_interval(50, 0.0) == (0, 0)
    assert binomial_interval(50, 1.0) == (50, 50)
    assert np.diff(binomial_interval(100, 0.5))[0] < 30
