# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Routes: their form, size, speed and place."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from checker_missions import RECTANGLE, Motion, climb_at, flies, fly_route


@pytest.mark.parametrize(
    ('size', 'outcome'),
    [([120, 80], 'holds'), ([80, 120], 'holds'), ([100, 80], 'does_not'), ([140, 80], 'does_not')],
)
def test_a_rectangle_has_its_size(stage: Any, size: list[int], outcome: str) -> None:
    round_trip = [(0, -30), (0, 0), (120, 0), (120, 80), (0, 80), (0, 0)]
    flies(stage, round_trip)
    assert stage.says({**RECTANGLE, 'size_m': size}) == outcome


@pytest.mark.parametrize(('depth', 'outcome'), [(80, 'holds'), (110, 'does_not')])
def test_a_way_in_may_run_on_as_the_first_side(stage: Any, depth: int, outcome: str) -> None:
    flies(stage, [(0, -30), (0, 80), (120, 80), (120, 0), (0, 0)])
    assert stage.says({**RECTANGLE, 'size_m': [120, depth]}) == outcome


def test_a_rectangle_left_open_does_not_hold(stage: Any) -> None:
    flies(stage, [(0, 0), (120, 0), (120, 80), (0, 80)])
    assert stage.says({**RECTANGLE, 'size_m': [120, 80]}) == 'does_not'


@pytest.mark.parametrize(('down_s', 'outcome'), [(28.0, 'holds'), (40.0, 'does_not')])
def test_the_way_to_a_rectangle_may_lead_over_what_stands_in_between(
    stage: Any, down_s: float, outcome: str
) -> None:
    """It leaves its hover at 14 s, through the altitude of the route, which begins at 32 s."""
    corners = [(0, 0), (60, 0), (60, 40), (0, 40), (0, 0)]
    course = fly_route([(-180, 0), *corners], 40.0, 10.0, 14.0)
    levels = ([14, 18, down_s, down_s + 4], [30, 60, 60, 40])
    stage.uav('drone', lambda t: (*course(t)[:2], np.interp(t, *levels)), ends=(14.0, 53.0))
    assert stage.says({**RECTANGLE, 'size_m': [60, 40]}) == outcome


def test_a_rectangle_is_centred_on_its_place(make_stage: Any) -> None:
    for x, outcome in ((150.0, 'holds'), (180.0, 'does_not')):
        stage = make_stage()
        corners = [(x, -10), (x + 120, -10), (x + 120, 70), (x, 70), (x, -10)]
        flies(stage, [(float(a), float(b)) for a, b in corners])
        asked = {**RECTANGLE, 'size_m': [120, 80], 'target': 'City Hall'}
        assert stage.says(asked) == outcome


@pytest.mark.parametrize(('top', 'outcome'), [(17.3, 'holds'), (15.0, 'does_not')])
def test_a_leg_counts_where_the_slowest_speed_can_be_reached(
    stage: Any, top: float, outcome: str
) -> None:
    """200 m at 1.5 m/s^2: 18 m/s are never reached, 16.2 m/s, which count, are for 25 m."""

    def motion(t: Any) -> tuple[Any, Any, Any]:
        gain_s = top / 1.5
        even_s = 200.0 / top - gain_s
        gains = np.full(50, gain_s / 50)
        marks = 15.0 + np.cumsum([0.0, *gains, even_s, *gains])
        speeds = np.interp(marks - 15.0, [0.0, gain_s, gain_s + even_s], [0.0, top, top])
        speeds = np.minimum(speeds, 1.5 * (marks[-1] - marks))
        way = np.concatenate([[0.0], np.cumsum((speeds[1:] + speeds[:-1]) / 2.0 * np.diff(marks))])
        return np.interp(t, marks, way), 0.0 * t, 40.0

    stage.uav('drone', motion, ends=(58.0,))
    line = {**RECTANGLE, 'pattern': 'line', 'size_m': [200, 0], 'speed_mps': 18}
    assert stage.says(line) == outcome


@pytest.mark.parametrize(('speed', 'outcome'), [(9.2, 'holds'), (10.8, 'holds'), (12, 'does_not')])
def test_the_legs_are_flown_at_the_speed(stage: Any, speed: float, outcome: str) -> None:
    flies(stage, [(0, 0), (120, 0), (120, 80), (0, 80), (0, 0)], speed)
    assert stage.says({**RECTANGLE, 'size_m': [120, 80], 'speed_mps': 10}) == outcome


def test_a_line_and_a_lawnmower(make_stage: Any) -> None:
    line = {**RECTANGLE, 'pattern': 'line'}
    stage = make_stage()
    flies(stage, [(0, 30), (0, 0), (300, 0)])
    assert stage.says({**line, 'size_m': [300, 0]}) == 'holds'
    assert stage.says({**line, 'size_m': [270, 0]}) == 'does_not'
    # The way to the first point may lie in line with it; what is too short is too short.
    assert stage.says({**line, 'size_m': [320, 0]}) == 'does_not'
    led_in = make_stage()
    flies(led_in, [(0, 0), (320, 0)])
    assert led_in.says({**line, 'size_m': [300, 0]}) == 'cannot_tell'
    assert led_in.says({**line, 'size_m': [340, 0]}) == 'does_not'
    straight = make_stage()
    flies(straight, [(0, 0), (100, 0)])
    assert straight.says(line) == 'cannot_tell'  # of any length; two corners are enough
    assert straight.says({**RECTANGLE, 'pattern': 'rectangle'}) == 'does_not'
    mower = {**RECTANGLE, 'pattern': 'lawnmower'}
    stage = make_stage()
    legs = [(0, 0), (100, 0), (100, 20), (0, 20), (0, 40), (100, 40)]
    flies(stage, [(float(a), float(b)) for a, b in legs])
    assert stage.says({**mower, 'size_m': [100, 40]}) == 'holds'
    assert stage.says({**mower, 'size_m': [200, 40]}) == 'does_not'


@pytest.mark.parametrize(
    ('turned', 'radius', 'outcome'),
    [(1.0, 60, 'holds'), (0.8, 60, 'does_not'), (1.0, 75, 'does_not'), (1.0, 65, 'holds')],
)
def test_an_orbit(stage: Any, turned: float, radius: float, outcome: str) -> None:
    def motion(t: Any) -> tuple[Any, Any, Any]:
        angle = np.clip((t - 12.0) / 45.0, 0.0, 1.0) * 2.0 * np.pi * turned
        return 210 + 60 * np.cos(angle), 30 + 60 * np.sin(angle), 40.0

    stage.uav('drone', motion, ends=(58.0,))
    asked = {**RECTANGLE, 'pattern': 'orbit', 'radius_m': radius, 'target': 'City Hall'}
    assert stage.says(asked) == outcome


@pytest.mark.parametrize(
    ('flown_s', 'lasts', 'outcome'),
    [(19.0, 25, 'holds'), (10.0, 25, 'does_not'), (19.0, None, 'does_not')],
)
def test_an_orbit_goes_as_far_round_as_there_is_time(
    stage: Any, flown_s: float, lasts: float | None, outcome: str
) -> None:
    """At 8 m/s the lap of 377 m takes 47 s."""

    def motion(t: Any) -> tuple[Any, Any, Any]:
        angle = 8.0 / 60.0 * np.clip(t - 12.0, 0.0, flown_s)
        return 210 + 60 * np.cos(angle), 30 + 60 * np.sin(angle), 40.0

    stage.uav('drone', motion, ends=(36.0,))
    asked = {**RECTANGLE, 'pattern': 'orbit', 'radius_m': 60, 'target': 'City Hall'}
    asked |= {} if lasts is None else {'duration_s': lasts, 'speed_mps': 8}
    assert stage.says(asked) == outcome


@pytest.mark.parametrize(
    ('turned', 'outcome'),
    [(2.0, 'holds'), (1.0, 'does_not'), (2.1, 'cannot_tell'), (3.0, 'does_not')],
)
def test_turns_are_counted(stage: Any, turned: float, outcome: str) -> None:
    def motion(t: Any) -> tuple[Any, Any, Any]:
        angle = np.clip((t - 12.0) / 45.0, 0.0, 1.0) * 2.0 * np.pi * turned
        return 210 + 60 * np.cos(angle), 30 + 60 * np.sin(angle), 40.0

    stage.uav('drone', motion, ends=(58.0,))
    asked = {**RECTANGLE, 'pattern': 'orbit', 'turns': 2, 'target': 'City Hall'}
    assert stage.says(asked) == outcome


def test_the_way_to_an_orbit_takes_nothing_off_it(stage: Any) -> None:
    def motion(t: Any) -> tuple[Any, Any, Any]:
        lap = np.clip((t - 12.0) / 45.0, 0.0, 1.0) * 2.0 * np.pi
        angle = lap + np.clip((12.0 - t) / 12.0, 0.0, 1.0)  # one radian the other way before
        return 210 + 60 * np.cos(angle), 30 + 60 * np.sin(angle), 40.0

    stage.uav('drone', motion, ends=(58.0,))
    asked = {**RECTANGLE, 'pattern': 'orbit', 'radius_m': 60, 'target': 'City Hall'}
    assert stage.says(asked) == 'holds'


@pytest.mark.parametrize(
    ('middle_y', 'outcome'), [(15.0, 'does_not'), (30.0, 'holds'), (60.0, 'does_not')]
)
def test_an_orbit_goes_round_the_place_itself(stage: Any, middle_y: float, outcome: str) -> None:
    def motion(t: Any) -> tuple[Any, Any, Any]:
        angle = np.clip((t - 12.0) / 45.0, 0.0, 1.0) * 2.0 * np.pi
        return 210 + 60 * np.cos(angle), middle_y + 60 * np.sin(angle), 40.0

    stage.uav('drone', motion, ends=(58.0,))
    asked = {**RECTANGLE, 'pattern': 'orbit', 'radius_m': 60, 'target': 'City Hall'}
    assert stage.says(asked) == outcome


@pytest.mark.parametrize(('y', 'outcome'), [(-1.65, 'holds'), (60.0, 'does_not')])
def test_a_line_over_the_main_road_lies_over_a_carriageway(
    stage: Any, y: float, outcome: str
) -> None:
    flies(stage, [(-200, y), (200, y)])
    line = {**RECTANGLE, 'pattern': 'line', 'size_m': [400, 0], 'target': 'main_road'}
    assert stage.says(line) == outcome


def test_the_way_to_a_line_is_no_part_of_its_leg(stage: Any) -> None:
    """The road begins at -500 m; the UAV comes in straight from 90 m beyond it."""
    flies(stage, [(-590, -1.65), (-300, -1.65)])
    line = {**RECTANGLE, 'pattern': 'line', 'target': 'main_road'}
    # Where the line of 200 m begins on the way of 290 m cannot be seen.
    assert stage.says({**line, 'size_m': [200, 0]}) == 'cannot_tell'
    assert stage.says({**line, 'size_m': [290, 0]}) == 'does_not'


def test_waypoints_in_line_cannot_be_told(stage: Any) -> None:
    flies(stage, [(0, 0), (100, 0), (100, 80), (200, 80)])
    asked = {**RECTANGLE, 'pattern': 'waypoints'}
    assert stage.says({**asked, 'waypoint_count': 3}) == 'holds'
    assert stage.says({**asked, 'waypoint_count': 5}) == 'cannot_tell'


@pytest.mark.parametrize(
    ('aside', 'count', 'outcome'),
    [
        (0.0, 3, 'holds'),
        (8.0, 3, 'holds'),
        (30.0, 3, 'does_not'),
        (0.0, None, 'holds'),
        (30.0, None, 'does_not'),
    ],
)
@pytest.mark.parametrize('target', ['City Hall', 'van'])
def test_a_route_of_points_lies_around_its_target(
    stage: Any, target: str, aside: float, count: int | None, outcome: str
) -> None:
    """It need not come near: around is not over."""
    stage.ground('van', 'van', 210.0, 30.0)
    x, y = 210.0 - aside, 30.0
    points = [(x + 50.0 * np.cos(a), y + 50.0 * np.sin(a)) for a in np.radians([0, 120, 240])]
    flies(stage, [(x + 50.0, -90.0), *points])
    asked = {**RECTANGLE, 'pattern': 'waypoints', 'target': target}
    assert stage.says(asked if count is None else {**asked, 'waypoint_count': count}) == outcome


def test_a_single_point_is_at_its_target(make_stage: Any) -> None:
    for x, outcome in ((205.0, 'holds'), (150.0, 'does_not')):
        stage = make_stage()
        flies(stage, [(100.0, -50.0), (x, 30.0)])
        asked = {**RECTANGLE, 'pattern': 'waypoints', 'waypoint_count': 1, 'target': 'City Hall'}
        assert stage.says(asked) == outcome


def test_a_climb_leaves_a_route_its_course(stage: Any) -> None:
    corners = [(0.0, 0.0), (80.0, 0.0), (80.0, 40.0), (0.0, 40.0), (0.0, 0.0)]
    course = fly_route(corners, 50.0, 8.0, 12.0)

    def climbing(at_s: float) -> Motion:
        return lambda t: (*course(t)[:2], np.interp(t, [at_s, at_s + 7], [50, 70]))

    stage.uav('drone', climbing(20))
    stage.uav('early', climbing(10.5))
    asked = {
        'kind': 'mission',
        'uav': 'drone',
        'mode': 'navigate',
        'pattern': 'rectangle',
        'size_m': [80, 40],
        'altitude_m': 50,
    }
    assert stage.says(asked, climb_at(20)) == 'holds'
    assert stage.says(asked, climb_at(40)) == 'does_not'  # not as high as asked until then
    assert stage.says({**asked, 'size_m': [80, 60]}, climb_at(20)) == 'does_not'
    # What lets the other one climb is there before its mission: it had come to its altitude.
    asked, climb = {**asked, 'uav': 'early'}, climb_at(9.9)
    climb['action']['uav'] = 'early'
    climb['trigger'] = {'on': 'distance_below', 'a': 'car1', 'b': 'car2', 'value_m': 20}
    x = np.interp(stage.t, [0.0, 9.9], [0.0, 80.5])
    stage.ground('car1', 'car', x, -1.65)
    stage.ground('car2', 'car', 100.0, -1.65)
    assert stage.says(asked, climb) == 'holds'
    assert stage.says({**asked, 'altitude_m': 40}, climb) == 'does_not'


@pytest.mark.parametrize(
    ('leaves_s', 'down_s', 'outcome'),
    [(24.0, 14.0, 'holds'), (14.0, 25.0, 'does_not'), (14.0, 14.0, 'does_not')],
    ids=['first', 'at the end', 'on the way'],
)
def test_the_height_of_a_flight_to_a_place_is_that_of_the_way(
    stage: Any, leaves_s: float, down_s: float, outcome: str
) -> None:
    """A second mission of 210 m at 10 m/s, sinking from 70 m to 40 m in 10 s."""
    course = fly_route([(0, 30), (210, 30)], 40.0, 10.0, leaves_s)
    levels = ([down_s, down_s + 10.0], [70, 40])
    stage.uav('drone', lambda t: (*course(t)[:2], np.interp(t, *levels)), ends=(14.0, 50.0))
    there = {
        'kind': 'mission',
        'ref': 'm1',
        'uav': 'drone',
        'mode': 'navigate',
        'target': 'City Hall',
        'altitude_m': 40,
    }
    assert stage.says(there) == outcome
    assert stage.says({**there, 'altitude_m': None}) == 'holds'
