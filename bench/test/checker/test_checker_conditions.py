# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Conditions: as written, without a tolerance; all along, by a deadline, for a share."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest


def _of(quantity: str, *names: str, **more: Any) -> dict[str, Any]:
    return {'kind': 'condition', 'quantity': quantity, 'of': list(names), **more}


def _two(stage: Any) -> None:
    """Two cars 20 m apart that come to 10 m at 30 s."""
    stage.drive('car1', 'car', 8.0)
    stage.ground(
        'van1', 'van', 8.0 * stage.t + np.interp(stage.t, [0, 30, 60], [20, 10, 20]), -1.65
    )


@pytest.mark.parametrize(
    ('op', 'value', 'outcome'),
    [
        ('>=', 10.0, 'holds'),
        ('>', 10.0, 'does_not'),
        ('>=', 10.01, 'does_not'),
        ('<=', 20.0, 'holds'),
        ('<', 20.0, 'does_not'),
        ('<=', 15.0, 'does_not'),
    ],
)
def test_a_distance_holds_all_along_to_the_last_digit(
    stage: Any, op: str, value: float, outcome: str
) -> None:
    stage.ground('car1', 'car', 0.0, 0.0)
    stage.ground('car2', 'car', np.interp(stage.t, [0, 30, 60], [20, 10, 20]), 0.0)
    assert stage.says(_of('distance', 'car1', 'car2', op=op, value=value)) == outcome


def test_a_deadline_a_stretch_and_a_share(stage: Any) -> None:
    _two(stage)
    near = _of('distance', 'car1', 'van1', op='<', value=15)
    assert stage.says({**near, 'by_s': 20}) == 'holds'
    assert stage.says({**near, 'by_s': 14}) == 'does_not'
    assert stage.says({**near, 'hold_s': 29}) == 'holds'
    assert stage.says({**near, 'hold_s': 31}) == 'does_not'
    assert stage.says({**near, 'fraction': 0.49}) == 'holds'
    assert stage.says({**near, 'fraction': 0.55}) == 'does_not'


def test_a_condition_on_a_uav_counts_in_its_mission(stage: Any) -> None:
    stage.uav('drone', lambda t: (210, 30, 50))
    assert stage.says(_of('altitude', 'drone', op='>=', value=45)) == 'holds'
    assert stage.says(_of('altitude', 'drone', op='>=', value=51)) == 'does_not'
    assert stage.says(_of('altitude', 'drone', op='>', value=45, by_s=20)) == 'holds'
    assert stage.says(_of('altitude', 'drone', op='>', value=45, by_s=5)) == 'does_not'
    assert stage.says(_of('distance', 'drone', 'City Hall', op='<=', value=50)) == 'holds'
    assert stage.says(_of('horizontal_distance', 'drone', 'City Hall', op='<', value=1)) == 'holds'
    assert stage.says(_of('horizontal_distance', 'drone', 'Atlantis', op='<', value=1)) == (
        'cannot_tell'
    )


@pytest.mark.parametrize(
    ('way_m', 'outcome'),
    [
        ((0, 60, 160, 560), 'holds'),
        ((0, 60, 160, 360), 'does_not'),
        ((0, 60, 120, 240), 'does_not'),
    ],
    ids=['faster', 'slower again', 'never so fast'],
)
def test_who_is_never_to_be_slower_is_so_once_it_has_been_as_fast(
    stage: Any, way_m: tuple[float, ...], outcome: str
) -> None:
    stage.ground('car1', 'car', np.interp(stage.t, [0, 10, 20, 60], way_m), 0.0)
    assert stage.says(_of('speed', 'car1', op='>=', value=9.0)) == outcome


def test_speed_and_separation(stage: Any) -> None:
    _two(stage)
    assert stage.says(_of('speed', 'car1', op='<=', value=8.0)) == 'holds'
    assert stage.says(_of('speed', 'car1', op='<', value=8.0)) == 'does_not'
    assert stage.says(_of('speed', 'van1', op='<=', value=8.0)) == 'does_not'
    assert stage.says(_of('separation', 'car1', 'van1', op='>=', value=9)) == 'holds'
    assert stage.says(_of('separation', 'car1', 'van1', op='>=', value=11)) == 'does_not'
    assert stage.says({**_of('speed', 'car1', op='<', value=8.0), 'negate': True}) == 'holds'


def test_tracked_and_visible_shares(stage: Any) -> None:
    stage.drive('car1', 'car', 5.0, x=-50.0)
    stage.uav('drone', lambda t: (5.0 * t - 50.0, np.where(t < 40.0, 0.0, 100.0), 40.0))
    track = {'kind': 'mission', 'ref': 'm1', 'uav': 'drone', 'mode': 'track', 'target': 'car1'}
    tracked = _of('tracked_fraction', 'drone', 'car1', op='>=')
    assert stage.says({**tracked, 'value': 0.74}, track) == 'holds'
    assert stage.says({**tracked, 'value': 0.8}, track) == 'does_not'
    seen = _of('visible_fraction', 'drone', 'car1', op='>=')
    # At (100, 100) to (150, 100) and 40 m the tower of 60 m at x 40 to 60 does not stand between.
    assert stage.says({**seen, 'value': 0.9}, track) == 'holds'


def test_a_tower_a_truck_and_fog_block_the_view(make_stage: Any) -> None:
    seen = _of('visible_time', 'drone', 'car1', op='>=', value=30)
    free = make_stage()
    free.ground('car1', 'car', 50.0, 0.0)
    free.uav('drone', lambda t: (50, -60, 30))
    assert free.says(seen) == 'holds'
    behind = make_stage()
    behind.ground('car1', 'car', 50.0, 0.0)
    behind.uav('drone', lambda t: (50, 100, 30))
    assert behind.says(seen) == 'does_not'
    above = make_stage()
    above.ground('car1', 'car', 50.0, 0.0)
    above.uav('drone', lambda t: (50, 30, 80))
    assert above.says(seen) == 'does_not'
    hidden = make_stage()
    hidden.ground('car1', 'car', 0.0, -1.65)
    hidden.ground('truck1', 'truck', 0.0, -4.95)
    hidden.ground('ped1', 'pedestrian', 0.0, -8.0)
    look = _of('visible_time', 'ped1', 'car1', op='>=', value=1)
    assert hidden.says(look) == 'does_not'
    assert hidden.says(_of('visible_time', 'ped1', 'truck1', op='>=', value=1)) == 'holds'
    far = make_stage()
    far.ground('car1', 'car', 0.0, -1.65)
    far.uav('drone', lambda t: (245, -1.65, 45))
    assert far.says(seen) == 'holds'
    farther = make_stage()
    farther.ground('car1', 'car', 0.0, -1.65)
    farther.uav('drone', lambda t: (248, -1.65, 45))
    assert farther.says(seen) == 'does_not'


def test_a_driver_sees_what_is_in_front(stage: Any) -> None:
    stage.ground('car1', 'car', 0.0, -1.65)
    stage.ground('van1', 'van', 30.0, -1.65)
    assert stage.says(_of('visible_time', 'car1', 'van1', op='>', value=1)) == 'holds'
    assert stage.says(_of('visible_time', 'van1', 'car1', op='>', value=1)) == 'does_not'


def test_sight_without_interruption(stage: Any) -> None:
    stage.ground('car1', 'car', 50.0, 0.0)
    stage.uav('drone', lambda t: (50, np.where((t > 30) & (t < 32), 100, -60), 30))
    seen = _of('visible_time', 'drone', 'car1', op='>=', value=18, hold_s=18)
    assert stage.says(seen) == 'holds'
    assert stage.says({**seen, 'value': 22, 'hold_s': 22}) == 'does_not'


def test_messages(stage: Any) -> None:
    stage.uav('drone', lambda t: (0, 0, 40))
    stage.ground('car1', 'car', 50.0, 0.0)
    for k in range(3):
        stage.message('drone', 'car1', 20.0 + k, latency=0.5)
    stage.message('drone', 'car1', 25.0, latency=None, losses=4)
    latency = _of('delivery_latency', 'drone', 'car1', op='<=')
    assert stage.says({**latency, 'value': 0.4}) == 'does_not'
    ratio = _of('delivery_ratio', 'drone', 'car1', op='>=')
    assert stage.says({**ratio, 'value': 0.75}) == 'holds'
    assert stage.says({**ratio, 'value': 0.76}) == 'does_not'
    assert stage.says(_of('delivered', 'drone', 'car1', op='==', value=True)) == 'does_not'
    assert stage.says(_of('delivered', 'car1', 'drone', op='==', value=True)) == 'does_not'


def test_a_message_under_way_at_the_end_cannot_be_told(stage: Any) -> None:
    stage.uav('drone', lambda t: (0, 0, 40))
    stage.ground('car1', 'car', 50.0, 0.0)
    stage.message('drone', 'car1', 59.9, latency=0.05)
    asked = _of('delivered', 'drone', 'car1', op='==', value=True)
    assert stage.says(asked) == 'holds'
    stage._ledger = [e for e in stage._ledger if e.kind != 3]
    assert stage.says(asked) == 'cannot_tell'


def test_latency_is_the_worst_message(stage: Any) -> None:
    stage.ground('car1', 'car', 0.0, 0.0)
    stage.ground('car2', 'car', 50.0, 0.0)
    stage.message('car1', 'car2', 10.0, latency=0.2)
    stage.message('car1', 'car2', 20.0, latency=0.6)
    latency = _of('delivery_latency', 'car1', 'car2', op='<=')
    assert stage.says({**latency, 'value': 0.7}) == 'holds'
    assert stage.says({**latency, 'value': 0.5}) == 'does_not'


def test_landing_completion_and_drift(make_stage: Any) -> None:
    stage = make_stage(80.0)
    stage.uav('drone', lambda t: (210 + 0.8 * np.sin(t), 30, 50))
    landed = _of('landed', 'drone', op='==', value=True)
    assert stage.says(landed) == 'holds'
    assert stage.says({**landed, 'by_s': 62}) == 'holds'
    assert stage.says({**landed, 'by_s': 58}) == 'does_not'
    assert stage.says(_of('mission_completed', 'drone', op='==', value=True, by_s=51)) == 'holds'
    assert (
        stage.says(_of('mission_completed', 'drone', op='==', value=True, by_s=40)) == 'does_not'
    )
    hover = {'kind': 'mission', 'ref': 'm', 'uav': 'drone', 'mode': 'hover'}
    drift = _of('hover_drift', 'drone', op='<=')
    assert stage.says({**drift, 'value': 1.5}, hover) == 'holds'
    assert stage.says({**drift, 'value': 0.4}, hover) == 'does_not'
    assert stage.says({**drift, 'value': 0.9}, hover) == 'cannot_tell'
    aloft = make_stage()
    aloft.uav('drone', lambda t: (210, 30, 50), lands=False)
    assert aloft.says(landed) == 'does_not'


@pytest.mark.parametrize(('settles_s', 'outcome'), [(1.0, 'cannot_tell'), (8.0, 'does_not')])
def test_a_stated_drift_begins_where_the_hover_is_inside_of_it(
    stage: Any, settles_s: float, outcome: str
) -> None:
    # From 1.4 m away, inside of the default 2 m, to the hover point.
    stage.uav('drone', lambda t: (210 + 1.4 * np.clip(1 - (t - 10) / settles_s, 0, 1), 30, 50))
    hover = {'kind': 'mission', 'ref': 'm', 'uav': 'drone', 'mode': 'hover'}
    assert stage.says(_of('hover_drift', 'drone', op='<=', value=1.0), hover) == outcome


def test_battery_clearance_and_wind(stage: Any) -> None:
    stage.uav('drone', lambda t: (210, 30, 50))
    battery = _of('battery', 'drone', op='>=')
    assert stage.says({**battery, 'value': 0.96}) == 'holds'
    assert stage.says({**battery, 'value': 0.98}) == 'does_not'
    clearance = _of('clearance', 'drone', 'City Hall', op='>=')
    # 5 m south of the outline, and at the very spot that the place's name stands for.
    assert stage.says({**clearance, 'value': 0}) == 'holds'
    assert stage.says({**clearance, 'value': 10}) == 'does_not'
    assert stage.says(_of('wind', op='<=', value=3)) == 'holds'


def test_an_unknown_quantity_cannot_be_told(stage: Any) -> None:
    stage.ground('car1', 'car', 0.0, 0.0)
    assert stage.says(_of('mood', 'car1', op='==', value=1)) == 'cannot_tell'
    assert stage.says(_of('speed', 'car1', op='!=', value=1)) == 'cannot_tell'


def test_what_a_changed_mission_watches_counts_in_it(stage: Any) -> None:
    """The first one, from 10 s to 20 s, sees the car, too: 10 s of the 40 s."""
    stage.drive('car1', 'car', 0.0, x=210.0)
    stage.uav('drone', lambda t: (210, np.interp(t, [20, 24], [30, -1.65]), 40), ends=(20.0, 50.0))
    hover = {'kind': 'mission', 'uav': 'drone', 'mode': 'hover', 'target': 'City Hall'}
    then = {'do': 'change_mission', 'uav': 'drone', 'mode': 'track', 'target': 'car1'}
    event = {'kind': 'event', 'trigger': {'on': 'time', 'at_s': 20}, 'action': then}
    seen = {'kind': 'condition', 'quantity': 'visible_time', 'of': ['drone', 'car1'], 'op': '>='}
    assert stage.says({**seen, 'value': 25}, hover, event) == 'holds'
    assert stage.says({**seen, 'value': 45}, hover, event) == 'does_not'
