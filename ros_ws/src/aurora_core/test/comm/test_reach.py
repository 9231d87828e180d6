# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Received power and loss over distance against the closed form, and what replaces them."""

from __future__ import annotations

from dataclasses import replace
from itertools import count
from math import inf, log10

import pytest
from trace_builder import LIMITS, number
from trace_cases import alert_link

from aurora_core.comm.fading import lost_share
from aurora_core.comm.link import LinkSettings, MessageLink, Path, link_stream
from aurora_core.comm.path_loss import TRANSMITTED_DBM, blockage_db, path_loss_db, received_dbm
from aurora_core.comm.reach import Reach, reach_of
from aurora_core.spec.parameter import Unit
from aurora_core.spec.scene import Link
from aurora_core.trace.records import LinkEventKind, LossReason

SIGHT_M, BLOCKED_M, DECADE_DB = 500.0, 200.0, 1.0
FADING = Reach(sight_m=SIGHT_M, blocked_m=BLOCKED_M, decade_db=DECADE_DB)
SENT = 4000


@pytest.mark.parametrize('distance_m', [1.0, 10.0, 50.0, 100.0, 300.0, 500.0])
def test_received_power_is_that_of_the_report(distance_m: float) -> None:
    loss_db = 38.77 + 16.7 * log10(distance_m) + 18.2 * log10(5.9)
    assert path_loss_db(distance_m) == pytest.approx(loss_db, abs=1e-9)
    assert received_dbm(distance_m, 6.0) == pytest.approx(TRANSMITTED_DBM - loss_db - 6.0)


def test_both_ranges_receive_the_same_least_power() -> None:
    blockage = blockage_db(SIGHT_M, BLOCKED_M)
    assert 5.0 < blockage < 9.0  # the two means of the report
    assert received_dbm(SIGHT_M) == pytest.approx(received_dbm(BLOCKED_M, blockage))
    assert blockage_db(SIGHT_M, 0.0) == inf


def test_the_loss_falls_a_decade_with_every_decade_db() -> None:
    assert [lost_share(m, 2.0) for m in (-1.0, 0.0)] == [1.0, 1.0]
    assert lost_share(2.0, 2.0) == pytest.approx(0.1)
    assert lost_share(6.0, 2.0) == pytest.approx(1e-3)
    assert [lost_share(m, 0.0) for m in (-0.1, 0.0, 5.0)] == [1.0, 0.0, 0.0]


@pytest.mark.parametrize(('sees', 'range_m'), [(True, SIGHT_M), (False, BLOCKED_M)])
def test_the_loss_over_distance_is_a_power_of_the_share_of_the_range(
    sees: bool, range_m: float
) -> None:
    shares = [k / 100 for k in range(1, 101)]
    found = [FADING.faded(share * range_m, sees) for share in shares]
    assert found == pytest.approx([share**16.7 for share in shares], rel=1e-9)
    assert found == sorted(found)
    # Where grounding counts on a link one of fifteen is lost; half way to the range none.
    assert found[84] < 0.07
    assert found[49] < 1e-4


@pytest.mark.parametrize('sees', [True, False])
@pytest.mark.parametrize('share', [0.3, 0.8, 0.9, 0.95, 0.99, 1.01])
def test_so_many_are_lost_as_the_closed_form_says(sees: bool, share: float) -> None:
    away_m = share * FADING.range_m(sees)
    lost, reasons = _lost(away_m, sees)
    p = share**16.7 if share <= 1.0 else 1.0
    assert abs(lost / SENT - p) <= 3.0 * (p * (1.0 - p) / SENT) ** 0.5 + 1e-9
    assert reasons <= ({LossReason.RANDOM} if share <= 1.0 else {LossReason.RANGE})


def _lost(away_m: float, sees: bool) -> tuple[int, set[LossReason]]:
    settings = LinkSettings(
        link_id='l1', sender='a', receiver='b', loss=0.0, latency_s=0.0, retransmissions=0,
        interval_s=1.0, reach=FADING,
    )  # fmt: skip
    link, sequence = MessageLink(settings, 0.05, link_stream(1, 'l1')), count()
    path = Path(distance_m=away_m, line_of_sight=sees)
    found = []
    for tick in range(SENT):
        link.send(tick, tick, 'e')
        found += link.step(tick, lambda: path, lambda: next(sequence))
    lost = [r for r in found if r.kind is LinkEventKind.ATTEMPT_LOST]
    return len(lost), {r.reason for r in lost}


def test_a_stated_loss_and_what_fades_are_lost_independently() -> None:
    p = FADING.faded(450.0, True)
    assert FADING.chance(0.2, 450.0, True) == pytest.approx(1.0 - 0.8 * (1.0 - p))
    assert replace(FADING, decade_db=0.0).chance(0.2, 499.0, True) == 0.2


def _link(**changes: object) -> Link:
    return Link.model_validate(dict(alert_link()) | changes)


def test_what_is_stated_replaces_the_fading() -> None:
    assert reach_of(_link(), LIMITS) == FADING
    stated = _link(range_m=number(300.0, explicit=True))
    assert reach_of(stated, LIMITS) == Reach(sight_m=300.0, blocked_m=300.0)
    for loss in (0.0, 0.2):
        stated = _link(loss=number(loss, Unit.ONE, explicit=True))
        assert reach_of(stated, LIMITS) == Reach(sight_m=SIGHT_M, blocked_m=BLOCKED_M)


def test_what_is_in_between_stops_a_link_or_nothing() -> None:
    stopped, through = (reach_of(_link(occlusion=o), LIMITS) for o in ('blocks', 'ignored'))
    assert [stopped.holds(d, sees) for d, sees in ((499.0, True), (1.0, False))] == [True, False]
    assert through.holds(499.0, line_of_sight=False)
    assert through.faded(450.0, False) == through.faded(450.0, True)
    short = reach_of(_link(occlusion='blocks', range_m=number(80.0, explicit=True)), LIMITS)
    assert (short.holds(79.0, True), short.holds(1.0, False)) == (True, False)
