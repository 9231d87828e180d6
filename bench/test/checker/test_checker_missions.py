# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Hovering, tracking and routes."""

from __future__ import annotations

import dataclasses
from typing import Any

import numpy as np
import pytest
from checker_missions import RECTANGLE, climb_at, flies
from shapely.geometry import box

from aurora_bench.checker.recording import Prism

HOVER = {
    'kind': 'mission',
    'ref': 'm1',
    'uav': 'drone',
    'mode': 'hover',
    'target': 'City Hall',
    'altitude_m': 50,
    'duration_s': 40,
}

TRACK = {
    'kind': 'mission',
    'ref': 'm1',
    'uav': 'drone',
    'mode': 'track',
    'target': 'car1',
    'altitude_m': 40,
    'standoff_m': 30,
}


@pytest.mark.parametrize(
    ('change', 'outcome'),
    [
        ({}, 'holds'),
        ({'altitude_m': 51.9}, 'holds'),
        ({'altitude_m': 52.1}, 'does_not'),
        ({'duration_s': 40.8}, 'holds'),
        ({'duration_s': 42}, 'does_not'),
        ({'target': 'intersection'}, 'does_not'),
        ({'target': 'Atlantis'}, 'cannot_tell'),
        ({'mode': 'track', 'target': 'City Hall'}, 'cannot_tell'),
    ],
)
def test_a_hover_is_where_as_high_and_as_long_as_asked(
    stage: Any, change: dict[str, Any], outcome: str
) -> None:
    stage.uav('drone', lambda t: (210, 30, 50))
    assert stage.says({**HOVER, **change}) == outcome


@pytest.mark.parametrize(
    ('point', 'change', 'outcome'),
    [
        ((240.0, 30.0), {}, 'holds'),
        ((240.0, 15.0), {}, 'does_not'),  # east of the street before it
        ((210.0, 60.0), {}, 'does_not'),  # north of it
        ((180.0, 30.0), {}, 'cannot_tell'),  # the bearing to it
        ((240.0, 30.0), {'standoff_m': 60}, 'does_not'),
        # The street is said to be the place: its building is where it stands all the same.
        ((240.0, 15.0), {'moved': True}, 'does_not'),
        ((240.0, 30.0), {'moved': True}, 'holds'),
    ],
)
def test_an_offset_is_from_the_landmark_itself(
    stage: Any, point: tuple[float, float], change: dict[str, Any], outcome: str
) -> None:
    asked = {**HOVER, 'standoff_m': 30, 'bearing_deg': 90, **change}
    if asked.pop('moved', False):
        stage.world = dataclasses.replace(
            stage.world, places=(('landmark:City Hall', 210.0, 15.0),)
        )
    stage.uav('drone', lambda t: (*point, 50))
    assert stage.says(asked) == outcome


def test_a_building_does_not_hide_itself(make_stage: Any) -> None:
    for y, outcome in ((90.0, 'holds'), (-60.0, 'does_not')):
        stage = make_stage()
        other = Prism(name='', polygon=box(200, 0, 220, 10), top_m=60.0)
        stage.world = dataclasses.replace(stage.world, buildings=(*stage.world.buildings, other))
        stage.uav('drone', lambda t, y=y: (210, y, 10))
        seen = {'kind': 'condition', 'quantity': 'visible_fraction', 'of': ['drone', 'City Hall']}
        assert stage.says({**seen, 'op': '>=', 'value': 0.5}) == outcome


def test_a_hover_over_a_roof_a_junction_and_its_edge(make_stage: Any) -> None:
    for x, y, target, outcome in (
        (217, 38, 'City Hall', 'holds'),
        (300, 4, 'intersection', 'holds'),
        (312, 4, 'intersection', 'cannot_tell'),
        (330, 4, 'intersection', 'does_not'),
        (100, 0, 'crosswalk', 'holds'),
        (120, 0, 'crosswalk', 'does_not'),
    ):
        stage = make_stage()
        stage.uav('drone', lambda t, x=x, y=y: (x, y, 110))
        assert stage.says({**HOVER, 'target': target, 'altitude_m': 110}) == outcome


def test_a_hover_beside_its_place_does_not_hold(stage: Any) -> None:
    stage.uav('drone', lambda t: (210, -2, 50))
    assert stage.says({**HOVER, 'target': 'City Hall'}) == 'does_not'


@pytest.mark.parametrize(('drift', 'outcome'), [(1.5, 'holds'), (6.0, 'does_not')])
def test_a_hover_stays(stage: Any, drift: float, outcome: str) -> None:
    stage.uav('drone', lambda t: (210 + drift * (np.abs(t - 35) < 2), 30, 50))
    assert stage.says({**HOVER, 'duration_s': 40}) == outcome


@pytest.mark.parametrize(('x', 'outcome'), [(210.0, 'holds'), (260.0, 'does_not')])
def test_a_hover_is_where_it_ends_however_long_the_way_there(
    make_stage: Any, x: float, outcome: str
) -> None:
    # 50 s of way at 16 m/s, then 15 s of hover: most of the second half is way.
    stage = make_stage(90.0)
    stage.uav('drone', lambda t: (x - 16.0 * np.clip(60.0 - t, 0.0, 50.0), 30, 50), ends=(75.0,))
    assert stage.says({**HOVER, 'duration_s': 15}) == outcome


def test_a_hover_that_is_ended_on_its_last_metres_has_shown_no_point(stage: Any) -> None:
    stage.uav(
        'drone', lambda t: (210.0 - 2.0 * np.clip(24.0 - t, 0.0, 12.0), 30, 50), ends=(24.0,)
    )
    assert stage.says({k: v for k, v in HOVER.items() if k != 'duration_s'}) == 'cannot_tell'


def test_altitude_of_a_range_is_judged_by_the_range(stage: Any) -> None:
    stage.uav('drone', lambda t: (210, 30, 43))
    asked = {**HOVER, 'id': 'm', 'altitude_m': 40}
    assert stage.says(asked) == 'does_not'
    assert stage.says(asked, variation={'m.altitude_m': [36, 44]}) == 'holds'
    assert stage.says(asked, variation={'m.altitude_m': [36, 42]}) == 'does_not'


def test_altitude_counts_as_long_as_the_duration_does(stage: Any) -> None:
    """It drifts in slowly, and is high up for half of the time that counts as its hover."""
    stage.uav(
        'drone',
        lambda t: (
            210 + np.interp(t, [10, 30], [2.3, 1.2]) * (t < 30),
            30,
            np.interp(t, [14, 16, 28, 30], [50, 58, 58, 50]),
        ),
    )
    asked = {**HOVER, 'duration_s': 40}
    assert stage.says(asked) == 'does_not'
    assert stage.says({**asked, 'duration_s': 20}) == 'holds'


def test_a_hover_out_of_sight_of_its_target_does_not_hold(stage: Any) -> None:
    stage.uav('drone', lambda t: (210, 30, 80))
    stage.world = type(stage.world)(
        **{
            **{f: getattr(stage.world, f) for f in stage.world.__dataclass_fields__},
            'weather': 'fog',
        }
    )
    assert stage.says({**HOVER, 'altitude_m': 80}) == 'does_not'


def test_a_flight_that_the_recording_cuts_has_no_duration(stage: Any) -> None:
    stage.uav('drone', lambda t: (210, 30, 50), ends=(60.1,), lands=False)
    assert stage.says({**HOVER, 'duration_s': 40}) == 'cannot_tell'
    assert stage.says({**HOVER, 'duration_s': 80}) == 'does_not'


def _tracking(stage: Any, offset: Any, height: Any = 40.0) -> None:
    stage.drive('car1', 'car', 8.0)
    stage.uav('drone', lambda t: (8.0 * t - offset, -1.65, height))


@pytest.mark.parametrize(
    ('offset', 'outcome'),
    [(30.0, 'holds'), (34.9, 'holds'), (35.2, 'does_not'), (24.0, 'does_not')],
)
def test_tracking_keeps_the_asked_standoff(stage: Any, offset: float, outcome: str) -> None:
    _tracking(stage, offset)
    assert stage.says(TRACK) == outcome


@pytest.mark.parametrize(('lost', 'outcome'), [(7.0, 'holds'), (9.0, 'does_not')])
def test_tracking_may_be_lost_for_a_fifth_of_the_time(
    stage: Any, lost: float, outcome: str
) -> None:
    stage.drive('car1', 'car', 8.0)
    away = 30.0 + 30.0 * ((stage.t > 20.0) & (stage.t < 20.0 + lost))
    stage.uav('drone', lambda t: (8.0 * t - away, -1.65, 40.0))
    assert stage.says(TRACK) == outcome


@pytest.mark.parametrize(
    ('hidden_until', 'outcome'), [(112.0, 'holds'), (160.0, 'cannot_tell'), (320.0, 'does_not')]
)
def test_sight_lost_before_an_event_may_come_back_after_it(
    stage: Any, hidden_until: float, outcome: str
) -> None:
    wall = Prism(name='', polygon=box(104, 10, hidden_until, 14), top_m=90.0)
    stage.world = dataclasses.replace(stage.world, buildings=(wall,))
    stage.drive('car1', 'car', 8.0)
    stage.uav('drone', lambda t: (8.0 * t, 28.35, 40.0 + np.clip(3.0 * (t - 20.3), 0.0, 20.0)))
    climb = {'do': 'ascend', 'uav': 'drone', 'altitude_m': 60}
    event = {'kind': 'event', 'ref': 'e1', 'trigger': {'on': 'time', 'at_s': 20}, 'action': climb}
    assert stage.says(TRACK, event) == outcome


def test_tracking_behind_is_not_ahead(stage: Any) -> None:
    _tracking(stage, 30.0)
    assert stage.says({**TRACK, 'side': 'behind'}) == 'holds'
    assert stage.says({**TRACK, 'side': 'ahead'}) == 'does_not'


@pytest.mark.parametrize(('stated_m', 'outcome'), [(None, 'does_not'), (0.4, 'holds')])
def test_a_hover_begins_inside_of_its_stated_drift(
    stage: Any, stated_m: float | None, outcome: str
) -> None:
    """It comes from 1.9 m away at 10 s to its point at 20 s and stays for 30 s."""
    stage.uav('drone', lambda t: (np.interp(t, [10, 20], [1.4, 0.0]), 0, 40.0))
    hover = {
        'kind': 'mission',
        'ref': 'm1',
        'uav': 'drone',
        'mode': 'hover',
        'altitude_m': 40,
        'duration_s': 32,
    }
    drift = {'kind': 'condition', 'quantity': 'hover_drift', 'of': ['drone'], 'op': '<='}
    bound = [] if stated_m is None else [{**drift, 'value': stated_m}]
    assert stage.says(hover, *bound) == outcome


def test_standing_still_is_not_tracking(stage: Any) -> None:
    stage.drive('car1', 'car', 8.0)
    stage.uav('drone', lambda t: (100, 0, 40))
    without = {k: v for k, v in TRACK.items() if k != 'standoff_m'}
    assert stage.says(without) == 'does_not'


def test_a_mission_of_a_uav_that_is_not_there_does_not_hold(stage: Any) -> None:
    stage.drive('car1', 'car', 8.0)
    assert stage.says(TRACK, {'kind': 'uav', 'ref': 'drone'}) == 'does_not'


def test_a_place_to_be_avoided(stage: Any) -> None:
    flies(stage, [(0, 0), (180, 0), (180, 80), (0, 80), (0, 0)], 12.0)
    route = {**RECTANGLE, 'size_m': [180, 80]}
    assert stage.says({**route, 'avoid': ['City Hall'], 'avoid_m': 15}) == 'holds'
    assert stage.says({**route, 'avoid': ['City Hall'], 'avoid_m': 40}) == 'does_not'


def test_two_missions_are_two_flights_in_their_order(stage: Any) -> None:
    def motion(t: Any) -> tuple[Any, Any, Any]:
        return 210, 30, np.where(t < 30.0, 30.0, 60.0)

    stage.uav('drone', motion, ends=(30.0, 50.0))
    low = {**HOVER, 'ref': 'low', 'altitude_m': 30, 'duration_s': 20}
    high = {**HOVER, 'ref': 'high', 'altitude_m': 60, 'duration_s': 20}
    order = {'kind': 'order', 'first': 'low', 'then': 'high'}
    assert stage.says(low, high) == 'holds'
    assert stage.says(high, low) == 'holds'
    assert stage.says(order, low, high) == 'holds'
    assert stage.says({**order, 'first': 'high', 'then': 'low'}, low, high) == 'does_not'
    twice = {**low, 'ref': 'again'}
    assert stage.outcomes(low, twice, high) == ['holds', 'does_not', 'holds']


def test_a_mission_is_judged_until_an_annotated_climb(stage: Any) -> None:
    stage.uav('drone', lambda t: (210, 30, np.interp(t, [30, 35], [50, 70])))
    assert stage.says(HOVER) == 'does_not'
    assert stage.says(HOVER, climb_at(30)) == 'holds'


def test_a_climb_in_one_mission_says_nothing_of_the_next_one(stage: Any) -> None:
    def motion(t: Any) -> tuple[Any, Any, Any]:
        return 210, 30, np.interp(t, [20, 24, 31, 36], [30, 50, 50, 40])

    stage.uav('drone', motion, ends=(30.0, 60.0))
    low = {**HOVER, 'ref': 'low', 'altitude_m': 30, 'duration_s': 20}
    then = {**HOVER, 'ref': 'then', 'altitude_m': 40, 'duration_s': 25}
    climb = {'do': 'ascend', 'uav': 'drone', 'altitude_m': 50}
    for on in ({'on': 'time', 'at_s': 20}, {'on': 'altitude_reached', 'uav': 'drone'}):
        event = {**climb_at(20), 'trigger': {'value_m': 30, **on}, 'action': climb}
        answer = stage.answer(then, low, event)
        assert answer.outcome.value == 'holds', answer.why


def test_a_climb_does_not_end_a_hover_of_any_height(stage: Any) -> None:
    stage.uav('drone', lambda t: (210, 30, np.interp(t, [20, 35], [30, 70])))
    free = {k: v for k, v in HOVER.items() if k != 'altitude_m'}
    assert stage.says(free, climb_at(30)) == 'holds'
    assert stage.says({**free, 'duration_s': 50}, climb_at(30)) == 'does_not'


def test_a_clock_does_not_wait_for_a_mission_to_be_at_its_altitude(stage: Any) -> None:
    """On the way to its point it is told to climb: at 50 m it was on that way alone."""

    def motion(t: Any) -> tuple[Any, Any, Any]:
        return np.interp(t, [10, 14], [240, 210]), 30, np.interp(t, [11, 18], [50, 70])

    stage.uav('drone', motion)
    free = {k: v for k, v in HOVER.items() if k != 'duration_s'}
    assert stage.says(free, climb_at(11)) == 'does_not'
    assert stage.says({**free, 'altitude_m': 70}) == 'holds'


@pytest.mark.parametrize(('aside', 'outcome'), [(5.0, 'holds'), (15.0, 'does_not')])
def test_without_a_standoff_a_uav_may_be_above_its_target(
    stage: Any, aside: float, outcome: str
) -> None:
    """It comes from far away in 40 s; what it keeps then is what counts."""
    stage.drive('car1', 'car', 8.0)
    away = np.interp(stage.t, [0.0, 40.0], [300.0, aside])
    swing = aside * np.sign(np.sin(stage.t))  # no distance of its own that it keeps
    stage.uav('drone', lambda t: (8.0 * t - away + aside + swing, -1.65, 40.0))
    without = {k: v for k, v in TRACK.items() if k not in ('standoff_m', 'duration_s')}
    assert stage.says(without) == outcome


@pytest.mark.parametrize(('at_s', 'outcome'), [(50.0, 'holds'), (30.0, 'does_not')])
def test_an_event_ends_a_mission_before_its_stated_time(
    stage: Any, at_s: float, outcome: str
) -> None:
    """It hovers from 10 to 50 s, of the 80 s that it is to."""
    stage.uav('drone', lambda t: (210, 30, 50))
    land = {
        'kind': 'event',
        'ref': 'e1',
        'trigger': {'on': 'time', 'at_s': at_s},
        'action': {'do': 'land', 'uav': 'drone'},
    }
    assert stage.says({**HOVER, 'duration_s': 80}, land) == outcome
    assert stage.says({**HOVER, 'duration_s': 20}, land) == 'does_not'


@pytest.mark.parametrize(('mine', 'outcome'), [((), 'holds'), (('drone',), 'does_not')])
def test_who_flies_nothing_else_waits_for_its_event_on_the_ground(
    stage: Any, mine: tuple[str, ...], outcome: str
) -> None:
    stage.uav('drone', lambda t: (210, 30, 50), ends=(50.0,))
    change = {'do': 'change_mission', 'uav': 'drone', 'mode': 'hover', 'target': 'City Hall'}
    event = {'kind': 'event', 'ref': 'e1', 'trigger': {'on': 'time', 'at_s': 5}, 'action': change}
    others = [{**HOVER, 'uav': uav} for uav in mine]
    assert stage.says(event, *others) == outcome


STAYS = {'kind': 'mission', 'ref': 'm2', 'uav': 'drone', 'mode': 'hover', 'altitude_m': 50}


@pytest.mark.parametrize(
    ('aside_m', 'outcome'),
    # It hovers at (210, 30) at first; at 8 m/s it may brake for 21.3 m, and 5 m more.
    [(0.0, 'holds'), (4.0, 'holds'), (26.0, 'does_not')],
)
def test_a_hover_at_no_place_after_another_mission_is_where_that_has_led(
    stage: Any, aside_m: float, outcome: str
) -> None:
    stage.uav(
        'drone',
        lambda t: (210 + np.clip(8.0 * (t - 30.1), 0.0, aside_m), 30, 50),
        ends=(30.0, 55.0),
    )
    first = {**HOVER, 'duration_s': 20}
    assert stage.outcomes(first, STAYS) == ['holds', outcome]


@pytest.mark.parametrize(('on_m', 'outcome'), [(15.0, 'holds'), (60.0, 'does_not')])
def test_who_hovers_where_it_is_may_brake_and_does_not_fly_on(
    make_stage: Any, on_m: float, outcome: str
) -> None:
    stage = make_stage(90.0)
    stage.drive('car1', 'car', 8.0)
    stage.uav(
        'drone',
        lambda t: (8.0 * np.minimum(t, 45.0) + np.clip(8.0 * (t - 45.0), 0.0, on_m), 28.35, 40),
        ends=(45.0, 80.0),
    )
    assert stage.outcomes(TRACK, {**STAYS, 'altitude_m': 40}) == ['holds', outcome]
