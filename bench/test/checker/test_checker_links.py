# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Links: what the ledger shows of loss, latency, range and retransmissions."""

from __future__ import annotations

from typing import Any

import pytest

from aurora_bench.checker.links import binomial_tail

LINK = {'kind': 'link', 'sender': 'drone', 'receiver': 'car1'}


def _radio(stage: Any, away: float = 50.0) -> None:
    stage.uav('drone', lambda t: (0, 0, 40))
    stage.ground('car1', 'car', away, 0.0)


def _many(stage: Any, sent: int, lossy: int) -> None:
    _radio(stage)
    for k in range(sent):
        stage.message('drone', 'car1', 12.0 + k, losses=1 if k < lossy else 0)


def test_the_tail_of_the_binomial() -> None:
    assert binomial_tail(2, 10, 0.2) == pytest.approx(0.6242, abs=1e-3)
    assert binomial_tail(0, 5, 1.0) == 0.0
    assert binomial_tail(0, 5, 0.0) == 1.0


@pytest.mark.parametrize(
    ('sent', 'lossy', 'loss', 'outcome'),
    [
        (30, 7, 0.2, 'holds'),
        (30, 0, 0.2, 'does_not'),
        (30, 25, 0.2, 'does_not'),
        (5, 1, 0.2, 'cannot_tell'),
        (30, 1, 0.0, 'does_not'),
        (30, 0, 0.0, 'holds'),
    ],
)
def test_loss_is_that_of_the_draws(
    stage: Any, sent: int, lossy: int, loss: float, outcome: str
) -> None:
    _many(stage, sent, lossy)
    assert stage.says({**LINK, 'loss': loss}) == outcome


def test_losses_beyond_the_range_are_no_draws(stage: Any) -> None:
    _radio(stage, 400.0)
    for k in range(30):
        stage.message('drone', 'car1', 12.0 + k, latency=None, losses=1, reason=2)
    assert stage.says({**LINK, 'loss': 0.1}) == 'cannot_tell'
    assert stage.says({**LINK, 'range_m': 300}) == 'holds'
    assert stage.says({**LINK, 'range_m': 500}) == 'does_not'


def test_messages_that_pass_beyond_the_range_contradict_it(stage: Any) -> None:
    _many(stage, 3, 0)
    assert stage.says({**LINK, 'range_m': 40}) == 'does_not'
    assert stage.says({**LINK, 'range_m': 300}) == 'cannot_tell'


@pytest.mark.parametrize(
    ('latency', 'outcome'), [(0.5, 'holds'), (0.7, 'holds'), (0.75, 'does_not'), (0.2, 'does_not')]
)
def test_latency_is_met_within_two_steps(stage: Any, latency: float, outcome: str) -> None:
    _radio(stage)
    stage.message('drone', 'car1', 20.0, latency=latency)
    assert stage.says({**LINK, 'latency_s': 0.5}) == outcome


def test_latency_without_a_message_cannot_be_told(stage: Any) -> None:
    _radio(stage)
    assert stage.says({**LINK, 'latency_s': 0.5}) == 'cannot_tell'
    car = {'kind': 'agent', 'ref': 'bus1', 'type': 'bus'}
    assert stage.says({**LINK, 'receiver': 'bus1', 'latency_s': 0.5}, car) == 'does_not'


@pytest.mark.parametrize(
    ('losses', 'passes', 'asked', 'outcome'),
    [
        (1, False, 0, 'holds'),
        (2, False, 0, 'does_not'),
        (4, False, 3, 'holds'),
        (2, False, 3, 'does_not'),
        (1, True, 3, 'cannot_tell'),
        (1, True, 0, 'does_not'),
    ],
)
def test_retransmissions(stage: Any, losses: int, passes: bool, asked: int, outcome: str) -> None:
    _radio(stage)
    stage.message('drone', 'car1', 20.0, losses=losses, latency=0.1 if passes else None)
    assert stage.says({**LINK, 'retransmissions': asked}) == outcome


def test_outage_and_rate(stage: Any) -> None:
    _many(stage, 20, 0)
    assert stage.says({**LINK, 'rate_hz': 1}) == 'holds'
    assert stage.says({**LINK, 'rate_hz': 2}) == 'does_not'
    assert stage.says({**LINK, 'outage_s': [15, 20]}) == 'does_not'
    assert stage.says({**LINK, 'outage_s': [40, 50]}) == 'cannot_tell'
