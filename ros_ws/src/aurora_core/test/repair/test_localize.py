# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from collections.abc import Callable

from aurora_core.outcomes.agsg import Agsg
from aurora_core.outcomes.verdict import Verdict
from aurora_core.repair.helps import ANCHOR, HELPS, helps
from aurora_core.repair.localize import localize
from aurora_core.repair.lock import is_movable
from aurora_core.spec.quantity import QuantityName

Failing = Callable[..., Verdict]
# What no realisation changes, and what has directions of its own.
_NOT_HELPED = {
    QuantityName.MESSAGE_TEXT,
    QuantityName.RUN_DURATION,
    QuantityName.WORLD_SETTING,
}
_BY_OPERATOR = {QuantityName.DISTANCE, QuantityName.HORIZONTAL_DISTANCE}


def test_every_quantity_says_what_helps_it() -> None:
    assert {*QuantityName} == {*HELPS} | _NOT_HELPED | _BY_OPERATOR


def test_a_height_helps_distances_that_count_it_alone() -> None:
    for op in ('<=', '>='):
        straight, level = (
            {item.name for item in helps(quantity, op)}
            for quantity in (QuantityName.DISTANCE, QuantityName.HORIZONTAL_DISTANCE)
        )
        assert straight - level == {'altitude_m'}


def test_what_comes_too_early_is_helped_by_what_takes_longer() -> None:
    early, late = (
        {(item.name, item.direction) for item in helps(QuantityName.EVENT_TIME, op)}
        for op in ('>=', '<=')
    )
    assert {('speed_mps', -1), ('distance_m', 1), ('altitude_m', 1)} <= early
    assert ('distance_m', -1) in late - early


def test_lost_sight_implicates_the_own_flight_with_a_reason(agsg: Agsg, failing: Failing) -> None:
    found = localize(agsg, failing(m1__visible=-0.4))
    first = [item.field for item in found][:3]
    assert 'missions/m1/altitude_m' in first
    assert ANCHOR in first
    best = found[0]
    assert best.conditions == ('m1.visible',)
    assert best.reason.startswith('m1.visible misses by 0.4 at 12.0 s: ')
    higher = [i for i in found if i.field == 'missions/m1/altitude_m' and i.direction > 0]
    lower = [i for i in found if i.field == 'missions/m1/altitude_m' and i.direction < 0]
    assert higher[0].score > lower[0].score


def test_only_what_is_open_is_ever_in_it(agsg: Agsg, failing: Failing) -> None:
    everything = {c.id.replace('.', '__'): -1.0 for c in agsg.conditions}
    fields = {item.field for item in localize(agsg, failing(**everything))}
    movable = {row.path for row in agsg.parameters if is_movable(row)}
    assert fields <= movable | {ANCHOR}
    # The prompt states the 45 m and the 20 m.
    assert not any('trigger' in name or 'distance_m' in name for name in fields)


def test_a_consequence_counts_less_than_what_was_measured(agsg: Agsg, failing: Failing) -> None:
    alone = localize(agsg, failing(e1__within=None))
    beside = localize(agsg, failing(e1__within=None, m1__tracked=-1.0))
    of_event = {i.field: i.score for i in alone}
    assert {c for i in beside for c in i.conditions} == {'e1.within', 'm1.tracked'}
    shared = next(i for i in beside if i.field == 'missions/m1/altitude_m')
    assert shared.score < of_event['missions/m1/altitude_m']


def test_nothing_is_implicated_where_all_holds(agsg: Agsg, failing: Failing) -> None:
    assert localize(agsg, failing()) == ()
