# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""UAVs that land at the same time do not get into each other's way."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from aurora_core.execution.landing import landing_spot, ways_apart_m
from aurora_core.grounding.airspace import Airspace
from aurora_core.knowledge.map_types import Building
from aurora_core.spec.scenario import Event, TimeTrigger, UavAction
from aurora_core.trace.layout import UavColumn

Point = tuple[float, float]


@pytest.mark.parametrize(
    ('a', 'b', 'c', 'd', 'apart_m'),
    [
        ((0.0, 0.0), (10.0, 0.0), (5.0, -5.0), (5.0, 5.0), 0.0),  # they cross
        ((0.0, 0.0), (10.0, 0.0), (0.0, 3.0), (10.0, 3.0), 3.0),
        ((0.0, 0.0), (10.0, 0.0), (14.0, 3.0), (30.0, 3.0), 5.0),  # one after the other
        ((0.0, 0.0), (10.0, 0.0), (5.0, 4.0), (5.0, 4.0), 4.0),  # one stays where it is
    ],
)
def test_the_distance_of_two_ways(a: Point, b: Point, c: Point, d: Point, apart_m: float) -> None:
    assert ways_apart_m(a, b, c, d) == pytest.approx(apart_m)
    assert ways_apart_m(d, c, b, a) == pytest.approx(apart_m)


def test_a_uav_waits_until_the_other_one_is_out_of_its_way(stage: Callable[..., Any]) -> None:
    # The first one's ways to both spots lead past the second one, which hovers at (10, 0).
    scene = stage(
        tracks={'uav1': 'van1', 'uav2': 'ego'},
        landing_spots=((30.0, 0.0), (60.0, 20.0)),
        hold_s=5.0,
    )
    scene.put('van1', 0.0).put('ego', 10.0)
    apart = []
    for _ in range(1500):
        scene.follow()
        flying = scene.uav[:, UavColumn.Z] > 29.0
        delta = scene.uav[0] - scene.uav[1]
        if flying.all():
            apart.append(float(np.hypot(delta[UavColumn.X], delta[UavColumn.Y])))
    assert [m.landing_spot for m in scene.machines] == [(60.0, 20.0), (30.0, 0.0)]
    assert all(m.landed for m in scene.machines)
    assert min(apart) >= 5.0


def test_nobody_comes_down_on_a_lower_one_that_stays_with_its_target(
    stage: Callable[..., Any],
) -> None:
    scene = stage(tracks={'uav1': 'van1', 'uav2': 'ego'}, landing_spots=((60.0, 0.0),))
    for machine in scene.machines:
        machine.start()

    def chosen(other_x_m: float) -> object:
        scene.fly('uav1', 0.0, 0.0, 50.0).fly('uav2', other_x_m, 0.0, 30.0)
        sky = Airspace((), ())
        return landing_spot(0, scene.machines, scene.uav, sky, 3.0, patient=True)

    assert scene.machines[1].followed == 'ego'
    assert chosen(61.0) is None
    assert chosen(90.0) == ((60.0, 0.0), 50.0)


def test_the_start_of_a_uav_that_still_flies_is_kept_for_it(stage: Callable[..., Any]) -> None:
    # (0, 22) is nearest to the first one, and next to where the second one has started.
    scene = stage(
        tracks={'uav1': 'van1', 'uav2': 'ego'},
        landing_spots=((0.0, 22.0), (0.0, -40.0)),
        hold_s=5.0,
    )
    scene.put('van1', -20.0, 10.0).put('ego', 40.0, 10.0).follow(1500)
    assert [m.landing_spot for m in scene.machines] == [(0.0, -40.0), (0.0, 22.0)]
    assert all(m.landed for m in scene.machines)


def test_nobody_waits_for_ever(stage: Callable[..., Any]) -> None:
    # Both above one car: each is in the way of the other.
    scene = stage(
        tracks={'uav1': 'van1', 'uav2': 'van1'},
        landing_spots=((30.0, 0.0), (0.0, 60.0)),
        hold_s=1.0,
    )
    scene.put('van1', 10.0).follow(1500)
    assert all(m.landed for m in scene.machines)


def test_the_first_of_a_column_does_not_brake_in_front_of_the_next(
    stage: Callable[..., Any],
) -> None:
    scene = stage(
        tracks={'uav1': 'van1', 'uav2': 'ego'},
        landing_spots=((0.0, 0.0), (0.0, 60.0)),
        hold_s=15.0,
    )
    apart = []
    for k in range(3000):
        x = 0.4 * k - 20.0
        scene.put('van1', x, speed=8.0).put('ego', x - 10.0, speed=8.0).follow()
        flying = scene.uav[:, UavColumn.Z] > 20.0
        if k > 200 and flying.all():
            delta = scene.uav[0] - scene.uav[1]
            apart.append(float(np.hypot(delta[UavColumn.X], delta[UavColumn.Y])))
    assert all(m.landed for m in scene.machines)
    assert min(apart) >= 7.0


def _landing_of_a_fast_one(
    stage: Callable[..., Any], spots: tuple[tuple[float, float], ...], *buildings: Building
) -> tuple[float, Any]:
    """Follow a van east with 9.3 m/s at y = 0; return x (m) of the landing, and the scene."""
    scene = stage(
        agents=('van1',), tracks={'uav1': 'van1'}, landing_spots=spots, buildings=buildings,
        hold_s=6.0,
    )  # fmt: skip
    machine = scene.machines[0]
    for k in range(2000):
        scene.put('van1', 0.465 * k - 60.0, speed=9.3).follow()
        if machine.missions_done:
            return float(scene.uav[0, UavColumn.X]), scene
    raise AssertionError(f'it never began to land: {machine.phase_name}')


def test_who_turns_wide_keeps_clear_of_what_is_beside_the_spot(
    stage: Callable[..., Any],
) -> None:
    begin_m, _ = _landing_of_a_fast_one(stage, ((0.0, 0.0),))
    # Just passed and 10 m to the right: it comes back over (begin + 6, -7.6).
    near, far = (begin_m - 3.5, -10.0), (begin_m + 60.0, 10.0)
    x0, x1 = begin_m + 6.0, begin_m + 26.0
    # 2.9 m beside that way back, but 5.3 m from the straight way: braking, then to the spot.
    house = Building(
        id='house',
        ring=((x0, -40.0), (x1, -40.0), (x1, -10.5), (x0, -10.5)),
        holes=(),
        height_m=60.0,
        height_source='',
        kind='block',
        name='',
    )
    chosen = []
    for buildings in ((), (house,)):
        _, scene = _landing_of_a_fast_one(stage, (near, far), *buildings)
        scene.follow(5)
        chosen.append(scene.machines[0].landing_spot)
    assert chosen == [near, far]


@pytest.mark.parametrize(('do', 'spot'), [('land', (60.0, 0.0)), ('return_home', (0.0, 0.0))])
def test_who_returns_lands_where_it_started_and_not_at_the_nearest_spot(
    stage: Callable[..., Any], parameter: Callable[..., Any], do: Any, spot: Point
) -> None:
    at = TimeTrigger(on='time', at_s=parameter(30.0, 's'))
    event = Event(id='e1', trigger=at, action=UavAction(do=do, uav='uav1'))
    scene = stage(events=(event,), landing_spots=((60.0, 0.0), (0.0, 0.0)))
    scene.put('van1', 55.0).follow(2400)
    (machine,) = scene.machines
    assert machine.landed
    assert machine.landing_spot == spot
    where = scene.uav[0, UavColumn.X : UavColumn.Y + 1]
    assert np.hypot(*(where - np.array(spot))) <= 1.0
