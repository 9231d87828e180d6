# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What bodies do over the run."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest


def _does(behavior: str, target: str | None = None, **more: Any) -> dict[str, Any]:
    found = {'kind': 'behavior', 'agent': 'car1', 'behavior': behavior, **more}
    return found if target is None else {**found, 'target': target}


def test_driving_and_standing(make_stage: Any) -> None:
    moving, still = make_stage(), make_stage()
    moving.drive('car1', 'car', 8.0)
    still.drive('car1', 'car', 0.0)
    for kind in ('drive', 'circulate'):
        assert moving.says(_does(kind)) == 'holds'
        assert still.says(_does(kind)) == 'does_not'
    for kind in ('stop', 'wait', 'park'):
        assert moving.says(_does(kind)) == 'does_not'
        assert still.says(_does(kind)) == 'holds'
    assert moving.says(_does('emergency_run')) == 'cannot_tell'
    assert still.says(_does('emergency_run')) == 'does_not'
    assert still.says(_does('park', 'roadside')) == 'cannot_tell'
    assert still.says(_does('wait', 'intersection')) == 'does_not'
    assert moving.says(_does('fly')) == 'cannot_tell'


@pytest.mark.parametrize(
    ('speed', 'outcome'),
    [
        ([0, 0, 8, 8], 'holds'),
        ([0, 0, 8, 0], 'does_not'),
        ([0, 0, 0, 0], 'does_not'),
    ],
)
def test_who_has_not_set_off_yet_has_not_stopped(
    stage: Any, speed: list[float], outcome: str
) -> None:
    stage.drive('car1', 'car', lambda t: np.interp(t, [0, 10, 12, 40], speed), x=-490.0)
    assert stage.says(_does('stop', negate=True)) == outcome


@pytest.mark.parametrize(
    ('driven', 'asked', 'outcome'),
    [(8.0, 8.0, 'holds'), (8.0, 9.0, 'holds'), (8.0, 9.5, 'does_not'), (20.0, 18.2, 'holds')],
)
def test_a_stated_speed_is_driven_where_the_way_is_free(
    stage: Any, driven: float, asked: float, outcome: str
) -> None:
    stage.drive('car1', 'car', driven, x=-490.0)
    assert stage.says(_does('drive', speed_mps=asked)) == outcome


def test_a_stated_speed_behind_a_leader_cannot_be_told(stage: Any) -> None:
    stage.drive('car1', 'car', 5.0, x=-490.0)
    stage.drive('bus1', 'bus', 5.0, x=-470.0)
    assert stage.says(_does('drive', speed_mps=10)) == 'cannot_tell'


def test_a_stated_speed_holds_until_an_annotated_action(stage: Any) -> None:
    stage.drive('car1', 'car', lambda t: np.interp(t, [25, 27], [8, 3]), x=-490.0)
    slow = {
        'kind': 'event',
        'ref': 'e1',
        'trigger': {'on': 'time', 'at_s': 25},
        'action': {'do': 'slow', 'agent': 'car1', 'value_mps': 3},
    }
    assert stage.says(_does('drive', speed_mps=8)) != 'holds'
    assert stage.says(_does('drive', speed_mps=8), slow) == 'holds'


@pytest.mark.parametrize(
    ('stops_s', 'on_s', 'outcome'),
    [(26.25, 1e3, 'holds'), (26.25, 35.0, 'does_not'), (10.0, 1e3, 'does_not')],
)
def test_who_comes_to_park_stands_there_at_the_end(
    stage: Any, stops_s: float, on_s: float, outcome: str
) -> None:
    def speed(t: Any) -> Any:
        return np.where((t < stops_s) | (t > on_s), 8.0, 0.0)

    stage.drive('car1', 'car', speed, y=10.0)
    arrives = {
        'kind': 'event',
        'ref': 'e1',
        'trigger': {'on': 'arrives', 'who': 'car1', 'place': 'City Hall'},
    }
    assert stage.says(_does('park', 'City Hall'), arrives) == outcome
    # Nothing says that it comes there: then it is parked from the start.
    assert stage.says(_does('park', 'City Hall')) == 'does_not'


@pytest.mark.parametrize(
    ('gap', 'outcome'),
    [(20.0, 'holds'), (3.0, 'does_not'), (60.0, 'does_not'), (-30.0, 'does_not')],
)
def test_following_keeps_a_gap(stage: Any, gap: float, outcome: str) -> None:
    stage.drive('bus1', 'bus', 8.0, x=0.0)
    stage.drive('car1', 'car', 8.0, x=-gap - 8.3)
    assert stage.says(_does('follow', 'bus1')) == outcome


@pytest.mark.parametrize(('ends_s', 'outcome'), [(30.0, 'holds'), (50.0, 'does_not')])
def test_following_is_asked_until_the_last_mission_ends(
    make_stage: Any, ends_s: float, outcome: str
) -> None:
    stage = make_stage(120.0)
    stage.drive('bus1', 'bus', 4.0, x=0.0)
    stage.ground('car1', 'car', -30.0 + 4.0 * np.minimum(stage.t, 32.0), -4.95)
    stage.uav('drone', lambda t: (0.0, 30.0, 50.0), ends=(ends_s,))
    assert stage.says(_does('follow', 'bus1')) == outcome


@pytest.mark.parametrize(
    ('gap', 'seconds', 'outcome'),
    [(7.0, 30, 'holds'), (9.0, 30, 'does_not'), (7.0, 3, 'does_not')],
)
def test_tailgating_is_under_a_second(
    stage: Any, gap: float, seconds: float, outcome: str
) -> None:
    far = np.where((stage.t > 10) & (stage.t < 10 + seconds), gap, 30.0)
    stage.ground('bus1', 'bus', 8.0 * stage.t, -1.65)
    stage.ground('car1', 'car', 8.0 * stage.t - far - 8.3, -1.65)
    assert stage.says(_does('tailgate', 'bus1')) == outcome


def test_overtaking_is_from_behind_to_ahead(make_stage: Any) -> None:
    for start, speed, outcome in (
        (-60.0, 9.0, 'holds'),
        (-60.0, 5.5, 'does_not'),
        (30.0, 9.0, 'does_not'),
    ):
        stage = make_stage()
        stage.drive('bus1', 'bus', 5.0, y=-4.95)
        stage.drive('car1', 'car', speed, x=start)
        assert stage.says(_does('overtake', 'bus1')) == outcome
    assert stage.says(_does('overtake')) == 'cannot_tell'


def test_approaching(make_stage: Any) -> None:
    for back, outcome in ((False, 'holds'), (True, 'does_not')):
        stage = make_stage()
        stage.drive('car1', 'car', 5.0, back=back)
        assert stage.says(_does('approach', 'City Hall')) == outcome
        assert stage.says(_does('drive', 'City Hall')) == outcome


def test_braking_slowing_and_yielding(make_stage: Any) -> None:
    hard, soft = make_stage(), make_stage()
    hard.drive('car1', 'car', lambda t: np.interp(t, [20, 22], [10, 0]))
    soft.drive('car1', 'car', lambda t: np.interp(t, [20, 32], [10, 0]))
    assert hard.says(_does('brake')) == 'holds'
    assert soft.says(_does('brake')) == 'does_not'
    assert soft.says(_does('slow')) == 'holds'
    assert hard.says(_does('yield')) == 'cannot_tell'
    steady = make_stage()
    steady.drive('car1', 'car', 10.0)
    assert steady.says(_does('slow')) == 'does_not'
    assert steady.says(_does('yield')) == 'does_not'


def test_yielding_to_whom(make_stage: Any) -> None:
    for start, outcome in ((20.0, 'does_not'), (4.0, 'holds')):
        stage = make_stage()
        y = np.interp(stage.t, [start, start + 6], [-7.5, 5.0])
        stage.ground('ped1', 'pedestrian', 100.0, y, heading=(0.0, 1.0))
        stage.drive('car1', 'car', lambda t: np.interp(t, [5, 8, 12, 14], [8, 4, 4, 8]))
        assert stage.says(_does('yield', 'ped1')) == outcome


def test_crossing_and_walking(make_stage: Any) -> None:
    stage = make_stage()
    y = np.interp(stage.t, [20, 29], [-7.5, 5.0])
    stage.ground('ped1', 'pedestrian', 100.0, y, heading=(0.0, 1.0))
    cross = {**_does('cross', 'crosswalk'), 'agent': 'ped1'}
    assert stage.says(cross) == 'holds'
    assert stage.says({**cross, 'target': 'intersection'}) == 'does_not'
    away = make_stage()
    away.ground('ped1', 'pedestrian', 10.0, y, heading=(0.0, 1.0))
    assert away.says(cross) == 'does_not'
    walk = {**_does('walk', 'sidewalk'), 'agent': 'ped1'}
    along = make_stage()
    along.ground('ped1', 'pedestrian', 1.4 * along.t, 4.5)
    assert along.says({**walk, 'speed_mps': 1.4}) == 'holds'
    assert along.says({**walk, 'speed_mps': 3}) == 'does_not'
    assert along.says(cross) == 'does_not'
    still = make_stage()
    still.ground('ped1', 'pedestrian', 0.0, 4.5)
    assert still.says(walk) == 'does_not'
    car = make_stage()
    car.drive('car1', 'car', 2.0)
    assert car.says(_does('walk')) == 'does_not'


@pytest.mark.parametrize(
    ('from_x', 'to_x', 'outcome'),
    [(60.0, 98.0, 'holds'), (99.0, 140.0, 'does_not'), (88.0, 95.0, 'cannot_tell'),
     (20.0, 60.0, 'does_not')],
)  # fmt: skip
def test_who_goes_to_a_place_comes_from_elsewhere(
    stage: Any, from_x: float, to_x: float, outcome: str
) -> None:
    """The crosswalk is at x = 100 m; who stands there and leaves has not walked to it."""
    x = np.interp(stage.t, [5.0, 40.0], [from_x, to_x])
    stage.ground('ped1', 'pedestrian', x, 4.5)
    assert stage.says({**_does('walk', 'crosswalk'), 'agent': 'ped1'}) == outcome


def test_changing_lane(make_stage: Any) -> None:
    for end, outcome in ((-4.95, 'holds'), (-1.65, 'does_not')):
        stage = make_stage()
        stage.drive('car1', 'car', 4.0, y=np.interp(stage.t, [20, 22], [-1.65, end]))
        assert stage.says(_does('change_lane')) == outcome
        opposite = {'holds': 'does_not', 'does_not': 'holds'}[outcome]
        assert stage.says(_does('change_lane', negate=True)) == opposite


@pytest.mark.parametrize(
    ('sign', 'kind', 'outcome'),
    [(1, 'turn_left', 'holds'), (1, 'turn_right', 'does_not'), (-1, 'turn_right', 'holds'),
     (0, 'turn_left', 'does_not')],
)  # fmt: skip
def test_turning_at_the_junction(stage: Any, sign: int, kind: str, outcome: str) -> None:
    way = 8.0 * stage.t
    bend = np.clip((way - 290.0) / 15.0, 0.0, 1.0) * np.pi / 2.0 * sign
    step = np.diff(way, prepend=0.0)
    stage.ground(
        'car1', 'car', np.cumsum(step * np.cos(bend)), np.cumsum(step * np.sin(bend)) - 1.65
    )
    assert stage.says(_does(kind, 'intersection')) == outcome


def test_behaviour_of_or_towards_nobody_does_not_hold(stage: Any) -> None:
    stage.drive('car1', 'car', 8.0)
    bus = {'kind': 'agent', 'ref': 'bus1', 'type': 'bus'}
    assert stage.says(_does('follow', 'bus1'), bus) == 'does_not'
    assert stage.says({**_does('drive'), 'agent': 'bus1'}, bus) == 'does_not'
    assert stage.says(_does('drive', 'Atlantis')) == 'cannot_tell'


def _pause(seconds: float, before_s: float = 10.0) -> Any:
    """Speeds of a body that drives, stands for a time and drives on."""
    edges = [before_s - 0.05, before_s, before_s + seconds, before_s + seconds + 0.05]
    return lambda t: np.interp(t, edges, [8.0, 0.0, 0.0, 8.0])


@pytest.mark.parametrize(
    ('stood_s', 'variation', 'outcome'),
    [
        (15.0, None, 'holds'),
        (16.2, None, 'holds'),
        (9.0, None, 'does_not'),
        (25.0, None, 'does_not'),
        (90.0, None, 'does_not'),
        (25.0, [15, 20], 'holds'),
        (14.0, [15, 20], 'does_not'),
        (9.0, [10, 15], 'holds'),
        (90.0, [10, 15], 'does_not'),
    ],
)
def test_who_stops_for_a_time_stands_for_it_and_drives_on(
    stage: Any, stood_s: float, variation: list[float] | None, outcome: str
) -> None:
    stage.drive('car1', 'car', _pause(stood_s), x=-490.0)
    asked = {'b.duration_s': variation} if variation else {}
    assert stage.says({'id': 'b', **_does('stop', duration_s=15)}, variation=asked) == outcome


@pytest.mark.parametrize(('seconds', 'outcome'), [(30, 'holds'), (50, 'does_not')])
def test_who_drives_for_a_time_does_not_stop_in_it(
    stage: Any, seconds: float, outcome: str
) -> None:
    stage.drive('car1', 'car', _pause(3.0, before_s=40.0), x=-490.0)
    assert stage.says(_does('drive', duration_s=seconds)) == outcome


@pytest.mark.parametrize(('seconds', 'outcome'), [(20, 'holds'), (55, 'does_not')])
def test_a_stated_speed_is_driven_for_the_stated_time(
    stage: Any, seconds: float, outcome: str
) -> None:
    stage.drive('car1', 'car', lambda t: np.interp(t, [24.9, 25.0], [5.0, 9.0]), x=-490.0)
    faster = {
        'kind': 'event',
        'ref': 'e1',
        'trigger': {'on': 'time', 'at_s': 25},
        'action': {'do': 'accelerate', 'agent': 'car1', 'value_mps': 9},
    }
    assert stage.says(_does('drive', speed_mps=5, duration_s=seconds), faster) == outcome


@pytest.mark.parametrize(('seconds', 'outcome'), [(20, 'holds'), (45, 'does_not')])
def test_who_tailgates_for_a_time_is_close_for_it(
    stage: Any, seconds: float, outcome: str
) -> None:
    stage.drive('car1', 'car', 8.0, x=-490.0)
    stage.drive('bus1', 'bus', lambda t: np.interp(t, [30.0, 31.0], [8.0, 12.0]), x=-476.0)
    assert stage.says(_does('tailgate', 'bus1', duration_s=seconds)) == outcome
