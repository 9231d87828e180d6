# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Events: when a trigger fires, and what has to follow."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from checker_events import AT_20, does, event_of, profile_of


@pytest.mark.parametrize(
    ('profile', 'outcome'),
    [
        ([(0, 10), (20.3, 10), (23, 0), (60, 0)], 'holds'),
        ([(0, 10), (20.3, 10), (23, 0), (24, 0), (30, 8)], 'does_not'),
        ([(0, 10), (20.3, 10), (23, 2), (60, 2)], 'does_not'),
        ([(0, 10), (22.5, 10), (25, 0), (60, 0)], 'does_not'),
        ([(0, 10), (10, 10), (13, 0), (60, 0)], 'holds'),
        ([(0, 10), (60, 10)], 'does_not'),
        ([(0, 10), (20.3, 10), (60, 0)], 'cannot_tell'),
        ([(0, 10), (20.3, 10), (23, 2), (24.5, 2), (25, 0), (60, 0)], 'holds'),
        ([(0, 10), (20.3, 10), (23, 2), (50, 2), (51, 0), (60, 0)], 'does_not'),
    ],
)
def test_stop_is_rest_for_two_seconds(stage: Any, profile: Any, outcome: str) -> None:
    stage.drive('car1', 'car', profile_of(*profile))
    assert stage.says(event_of(AT_20, does('stop'))) == outcome


@pytest.mark.parametrize(
    ('value', 'end', 'outcome'),
    [(5.0, 5.0, 'holds'), (5.0, 5.9, 'holds'), (5.0, 6.2, 'does_not'), (None, 6.2, 'does_not'),
     (None, 4.9, 'holds'), (12.0, 10.0, 'holds')],
)  # fmt: skip
def test_slow_to_a_speed_or_to_half(
    stage: Any, value: float | None, end: float, outcome: str
) -> None:
    stage.drive('car1', 'car', profile_of((0, 10), (20.3, 10), (23, end), (60, end)))
    more = {} if value is None else {'value_mps': value}
    assert stage.says(event_of(AT_20, does('slow', **more))) == outcome


@pytest.mark.parametrize('do', [{'do': 'slow', 'value_mps': 4.0}, {'do': 'stop'}])
def test_who_has_never_moved_does_not_slow_down(stage: Any, do: dict[str, Any]) -> None:
    stage.drive('car1', 'car', profile_of((0, 0), (30, 0), (34, 8), (60, 8)))
    assert stage.says(event_of(AT_20, {**do, 'agent': 'car1'})) == 'does_not'


@pytest.mark.parametrize('do', [{'do': 'slow', 'value_mps': 4.0}, {'do': 'slow'}])
def test_slow_is_not_done_by_what_comes_long_after(stage: Any, do: dict[str, Any]) -> None:
    """Half way at first, and there only twenty seconds later."""
    stage.drive('car1', 'car', profile_of((0, 10), (20.3, 10), (22, 7), (42, 7), (44, 4), (60, 4)))
    assert stage.says(event_of(AT_20, {**do, 'agent': 'car1'})) == 'does_not'


@pytest.mark.parametrize(
    ('value', 'end', 'outcome'),
    [(14.0, 13.0, 'holds'), (14.0, 12.0, 'does_not'), (None, 14.1, 'holds'),
     (None, 12.0, 'does_not')],
)  # fmt: skip
def test_accelerate(stage: Any, value: float | None, end: float, outcome: str) -> None:
    stage.drive('car1', 'car', profile_of((0, 10), (20.3, 10), (23, end), (60, end)))
    more = {} if value is None else {'value_mps': value}
    assert stage.says(event_of(AT_20, does('accelerate', **more))) == outcome


@pytest.mark.parametrize(
    ('seconds', 'outcome'), [(2.0, 'holds'), (4.0, 'cannot_tell'), (12.0, 'does_not')]
)
def test_brake_is_hard(stage: Any, seconds: float, outcome: str) -> None:
    stage.drive('car1', 'car', profile_of((0, 10), (20.3, 10), (20.3 + seconds, 0), (60, 0)))
    assert stage.says(event_of(AT_20, does('brake'))) == outcome


@pytest.mark.parametrize(
    ('profile', 'outcome'),
    [
        # Begun before, and only goes on when it is due.
        ([(0, 15), (18.5, 15), (21.5, 0), (60, 0)], 'does_not'),
        # Slower already for the traffic, and harder from then on.
        ([(0, 15), (18.5, 15), (20.3, 13), (22.5, 0), (60, 0)], 'holds'),
        # Twice: the later one is meant.
        ([(0, 15), (16, 15), (17, 10), (20.3, 10), (22.0, 0), (60, 0)], 'holds'),
    ],
)
def test_brake_begins_when_it_is_due(stage: Any, profile: Any, outcome: str) -> None:
    stage.drive('car1', 'car', profile_of(*profile))
    assert stage.says(event_of(AT_20, does('brake'))) == outcome


@pytest.mark.parametrize('do', ['stop', 'brake', 'slow'])
@pytest.mark.parametrize(
    ('begins_s', 'x', 'outcome'),
    [
        (28.1, -400.0, 'holds'),
        (21.0, -400.0, 'does_not'),
        (21.0, -20.0, 'either'),  # before the junction
    ],
)
def test_a_stated_wait_is_kept(
    stage: Any, do: str, begins_s: float, x: float, outcome: str
) -> None:
    speed = profile_of((0, 15), (begins_s, 15), (begins_s + 3, 0), (60, 0))
    stage.drive('car1', 'car', speed, x=x)
    asked = {
        **event_of(AT_20, does(do, **({'value_mps': 5} if do == 'slow' else {}))),
        'delay_s': 8,
    }
    if outcome == 'either':
        assert stage.says(asked) == ('does_not' if do == 'brake' else 'holds')
    else:
        assert stage.says(asked) == outcome


@pytest.mark.parametrize(
    ('start', 'value', 'end', 'outcome'),
    [
        (20.2, None, 8.0, 'holds'),
        (22.0, None, 8.0, 'does_not'),
        (15.0, None, 8.0, 'does_not'),
        (20.2, 8.0, 8.0, 'holds'),
        (20.2, 14.0, 8.0, 'does_not'),
    ],
)
def test_start_is_neither_early_nor_late_nor_slow(
    stage: Any, start: float, value: float | None, end: float, outcome: str
) -> None:
    stage.drive('car1', 'car', profile_of((0, 0), (start, 0), (start + 4, end), (60, end)))
    more = {} if value is None else {'value_mps': value}
    assert stage.says(event_of(AT_20, does('start', **more))) == outcome


def test_start_that_moved_from_the_beginning_does_not_hold(stage: Any) -> None:
    stage.drive('car1', 'car', 8.0)
    assert stage.says(event_of(AT_20, does('start'))) == 'does_not'
    assert stage.says(event_of(None, does('start'))) == 'does_not'


@pytest.mark.parametrize(
    ('at', 'back', 'outcome'),
    [(20.5, None, 'holds'), (None, None, 'does_not'), (35.0, None, 'does_not'),
     (10.0, None, 'does_not'), (20.5, 22.6, 'does_not')],
)  # fmt: skip
def test_change_of_lane_is_held(
    stage: Any, at: float | None, back: float | None, outcome: str
) -> None:
    lateral = np.full_like(stage.t, -1.65)
    if at is not None:
        lateral = np.interp(stage.t, [at, at + 2.0], [-1.65, -4.95])
    if back is not None:
        lateral = np.where(
            stage.t > back, np.interp(stage.t, [back, back + 1], [-4.95, -1.65]), lateral
        )
    stage.drive('car1', 'car', 4.0, y=lateral)
    assert stage.says(event_of(AT_20, does('change_lane'))) == outcome
    assert stage.says(event_of(AT_20, does('change_lane', side='right'))) == outcome
    to_left = 'does_not' if back is None else 'holds'  # it goes back to the left, and stays
    assert stage.says(event_of(AT_20, does('change_lane', side='left'))) == to_left


def _walker(stage: Any, start: float, end_y: float = 5.0) -> None:
    y = np.interp(stage.t, [start, start + 9.0], [-7.5, end_y])
    stage.ground('ped1', 'pedestrian', 100.0, y, heading=(0.0, 1.0))


@pytest.mark.parametrize(
    ('start', 'end_y', 'outcome'),
    [(19.5, 5.0, 'holds'), (15.0, 5.0, 'does_not'), (26.0, 5.0, 'does_not'),
     (19.5, -7.0, 'does_not'), (19.5, 0.0, 'cannot_tell'), (21.0, 5.0, 'does_not'),
     (20.05, 5.0, 'cannot_tell')],
)  # fmt: skip
def test_crossing_is_from_kerb_to_kerb(
    stage: Any, start: float, end_y: float, outcome: str
) -> None:
    """He is on the road 0.65 s after he sets off: what counts is the step onto it."""
    _walker(stage, start, end_y)
    assert stage.says(event_of(AT_20, {'do': 'cross', 'agent': 'ped1'})) == outcome


def test_who_has_waited_sets_off_from_where_he_has(make_stage: Any) -> None:
    waits = {'id': 'r1', 'kind': 'behavior', 'agent': 'ped1', 'behavior': 'wait', 'duration_s': 20}
    own = {'on': 'behavior_done', 'who': 'ped1', 'behavior': 'wait'}
    for trigger, outcome in ((own, 'holds'), (AT_20, 'does_not')):
        stage = make_stage()
        stage.ground(
            'ped1', 'pedestrian', 100.0, np.interp(stage.t, [20, 30], [-9.6, 5.0]),
            heading=(0.0, 1.0),
        )  # fmt: skip
        crosses = event_of(trigger, {'do': 'cross', 'agent': 'ped1'})
        assert stage.says(crosses, waits) == outcome


@pytest.mark.parametrize(('brakes', 'outcome'), [(22.0, 'holds'), (28.8, 'does_not')])
def test_who_brakes_when_somebody_begins_to_cross(stage: Any, brakes: float, outcome: str) -> None:
    """A person leaves the kerb at 21.5 s and is across at 28.7 s."""
    _walker(stage, 20.3)
    stage.drive('car1', 'car', profile_of((0, 15), (brakes, 15), (brakes + 3.0, 0), (60, 0)))
    crosses = {'id': 'r1', **event_of(AT_20, {'do': 'cross', 'agent': 'ped1'}), 'ref': 'e1'}
    begun = event_of({'on': 'event_begun', 'event': 'e1'}, does('brake'), ref='e2')
    assert stage.says(begun, crosses) == outcome
    done = {**begun, 'trigger': {'on': 'event_done', 'event': 'e1'}}
    assert stage.says(done, crosses) == ('does_not' if outcome == 'holds' else 'holds')


def test_yield_lets_the_other_pass_first(make_stage: Any) -> None:
    near = {'on': 'distance_below', 'a': 'car1', 'b': 'ped1', 'value_m': 30}
    for wait, outcome in ((True, 'holds'), (False, 'does_not')):
        stage = make_stage()
        _walker(stage, 10.0)
        slow = profile_of((0, 8), (8, 8), (10, 0), (22, 0), (24, 8), (60, 8))
        stage.drive('car1', 'car', slow if wait else 8.0, x=10.0 if wait else 0.0)
        asked = event_of(near, does('yield'))
        assert stage.says(asked) == outcome


def test_who_is_overtaken_has_let_the_other_pass(make_stage: Any) -> None:
    """Later the ambulance comes back over the other's lane, where the other has been before."""
    stage = make_stage()
    slow = profile_of((0, 8), (4.5, 8), (6, 4), (20, 4), (22, 8), (60, 8))
    stage.drive('car1', 'car', slow, x=60.0)
    x = np.interp(stage.t, [0.0, 20.0, 60.0], [0.0, 300.0, 0.0])
    y = np.interp(stage.t, [20.0, 22.0, 30.0, 40.0], [1.65, 12.0, 12.0, -8.0])
    stage.ground('ambulance1', 'ambulance', x, y)
    near = {'on': 'distance_below', 'a': 'car1', 'b': 'ambulance1', 'value_m': 30}
    assert stage.says(event_of(near, does('yield'))) == 'holds'


@pytest.mark.parametrize(('top', 'outcome'), [(60.0, 'holds'), (55.0, 'does_not')])
def test_ascend(stage: Any, top: float, outcome: str) -> None:
    stage.uav('drone', lambda t: (0, 0, np.interp(t, [20.5, 28], [40, top])))
    climb = {'do': 'ascend', 'uav': 'drone', 'altitude_m': 60}
    assert stage.says(event_of(AT_20, climb)) == outcome
    assert stage.says(event_of({'on': 'time', 'at_s': 40}, climb)) == (
        'holds' if top == 60.0 else 'does_not'
    )


@pytest.mark.parametrize(
    ('bottom', 'outcome'), [(20.0, 'holds'), (26.0, 'does_not'), (60.0, 'does_not')]
)
def test_to_a_lower_altitude_it_sinks(stage: Any, bottom: float, outcome: str) -> None:
    stage.uav('drone', lambda t: (0, 0, np.interp(t, [20.5, 32], [40, bottom])))
    sink = {'do': 'ascend', 'uav': 'drone', 'altitude_m': 20}
    assert stage.says(event_of(AT_20, sink)) == outcome


@pytest.mark.parametrize(('starts_s', 'outcome'), [(40.0, 'holds'), (33.0, 'does_not')])
def test_who_starts_again_has_driven_before_its_stop(
    stage: Any, starts_s: float, outcome: str
) -> None:
    """It stops at 20 s, stands from 22 s on, and is to start 18 s after that."""
    stage.drive(
        'car1',
        'car',
        lambda t: np.interp(t, [20, 22, starts_s, starts_s + 4], [8, 0, 0, 8]),
        x=-490.0,
    )
    stop = {**event_of(AT_20, does('stop')), 'ref': 'e1'}
    again = {
        'kind': 'event',
        'ref': 'e2',
        'trigger': {'on': 'event_done', 'event': 'e1', 'after_s': 18},
        'action': {'do': 'start', 'agent': 'car1'},
    }
    assert stage.says(again, stop) == outcome


def test_a_track_is_captured_at_the_altitude_with_which_it_begins(stage: Any) -> None:
    """It loses sight at 20 s and climbs then; it has not to wait until it is up."""
    stage.ground('bus1', 'bus', 50.0, 0.0)
    hidden = (stage.t > 20) & (stage.t < 22)
    height_m = 30.0 + np.clip(3.0 * (stage.t - 20.3), 0.0, 30.0)
    stage.uav('drone', lambda _: (50, np.where(hidden, 100, -10), height_m))
    track = {'kind': 'mission', 'ref': 'm1', 'uav': 'drone', 'mode': 'track', 'target': 'bus1'}
    lost = {'on': 'occluded', 'observer': 'drone', 'target': 'bus1'}
    climb = event_of(lost, {'do': 'ascend', 'uav': 'drone', 'altitude_m': 60})
    assert 'climbs from 20' in stage.answer(climb, track).why


def test_land_return_and_change_of_mission(stage: Any) -> None:
    stage.uav('drone', lambda t: (np.where(t < 30, 210, 0), np.where(t < 30, 15, 0), 40),
              ends=(30.0, 45.0))  # fmt: skip
    land = {'do': 'land', 'uav': 'drone'}
    assert stage.says(event_of({'on': 'mission_done', 'uav': 'drone'}, land)) == 'holds'
    assert stage.says(event_of({'on': 'time', 'at_s': 45}, land)) == 'holds'
    assert stage.says(event_of({'on': 'time', 'at_s': 30}, land)) == 'does_not'
    home = {'do': 'return_home', 'uav': 'drone'}
    assert stage.says(event_of({'on': 'time', 'at_s': 45}, home)) == 'does_not'
    change = {'do': 'change_mission', 'uav': 'drone', 'mode': 'hover', 'altitude_m': 40}
    at_30 = {'on': 'time', 'at_s': 30}
    assert stage.says(event_of(at_30, change)) == 'holds'
    assert stage.says(event_of(at_30, {**change, 'altitude_m': 60})) == 'does_not'
    assert stage.says(event_of(AT_20, change)) == 'does_not'


def test_a_delay_and_a_chain_count_from_completion(make_stage: Any) -> None:
    first = event_of(AT_20, does('stop'))
    then = event_of(
        {'on': 'event_done', 'event': 'e1', 'after_s': 5},
        {'do': 'start', 'agent': 'bus1'},
        ref='e2',
    )
    order = {'kind': 'order', 'first': 'e1', 'then': 'e2'}

    def played(start: float) -> Any:
        stage = make_stage()
        stage.drive('car1', 'car', profile_of((0, 10), (20, 10), (23, 0), (60, 0)))
        stage.drive('bus1', 'bus', profile_of((0, 0), (start, 0), (start + 4, 8)), x=-100)
        return stage

    delayed = {**event_of(AT_20, {'do': 'start', 'agent': 'bus1'}, ref='e3'), 'delay_s': 8}
    for start, outcome in ((28.3, 'holds'), (25.0, 'does_not'), (33.0, 'does_not')):
        assert played(start).says(then, first) == outcome
        assert played(start).says(delayed, first) == outcome
    stage = played(28.3)
    assert stage.says(order, first, then) == 'holds'
    assert stage.says({**order, 'within_s': 3}, first, then) == 'does_not'
    assert stage.says({**order, 'first': 'e2', 'then': 'e1'}, first, then) == 'does_not'
    assert stage.says({**order, 'then': 'e9'}, first, then) == 'cannot_tell'


def test_events_that_wait_for_each_other_end(stage: Any) -> None:
    stage.drive('car1', 'car', 5.0)
    one = event_of({'on': 'event_done', 'event': 'e2'}, does('stop'))
    two = event_of({'on': 'event_done', 'event': 'e1'}, does('brake'), ref='e2')
    assert stage.says(one, two) == 'cannot_tell'


def test_an_event_of_a_body_that_is_not_there_does_not_hold(stage: Any) -> None:
    bus = {'kind': 'agent', 'ref': 'bus1', 'type': 'bus'}
    assert stage.says(event_of(AT_20, {'do': 'stop', 'agent': 'bus1'}), bus) == 'does_not'


@pytest.mark.parametrize(
    ('sent', 'outcome'), [(22.0, 'holds'), (23.5, 'holds'), (27.0, 'does_not')]
)
def test_braking_is_done_once_it_is_hard_or_when_it_ends(
    stage: Any, sent: float, outcome: str
) -> None:
    stage.drive('car1', 'car', profile_of((0, 15), (20.5, 15), (23.5, 0), (60, 0)), x=-200.0)
    stage.ground('van1', 'van', 0.0, 20.0)
    stage.message('car1', 'van1', sent)
    brake = {'id': 'r1', **event_of(None, does('brake')), 'ref': 'e1'}
    tells = {
        **event_of({'on': 'event_done', 'event': 'e1'}, None), 'id': 'r2', 'ref': 'e2',
        'action': {'do': 'send_message', 'sender': 'car1', 'receiver': 'van1'},
    }  # fmt: skip
    answer = stage.answer(tells, brake)
    assert answer.outcome.value == outcome, answer.why


@pytest.mark.parametrize(
    ('sent', 'outcome'), [(21.5, 'holds'), (23.6, 'holds'), (12.0, 'does_not')]
)
def test_when_somebody_stops_is_from_where_it_slows_down(
    stage: Any, sent: float, outcome: str
) -> None:
    stage.drive('car1', 'car', profile_of((0, 15), (20.5, 15), (23.5, 0), (60, 0)), x=-200.0)
    stage.ground('van1', 'van', 0.0, 20.0)
    stage.message('car1', 'van1', sent)
    tells = event_of(
        {'on': 'speed_below', 'who': 'car1'},
        {'do': 'send_message', 'sender': 'car1', 'receiver': 'van1'},
    )
    assert stage.says(tells) == outcome


def test_the_end_of_an_ascent_is_no_climb_of_its_own(stage: Any) -> None:
    """It comes up to 40 m at 21 s and goes on to 60 m at 30 s: not what was due at 20 s."""
    stage.uav('drone', lambda t: (0, 0, np.interp(t, [19, 21, 30, 38], [36, 40, 40, 60])))
    climb = {'do': 'ascend', 'uav': 'drone', 'altitude_m': 60}
    assert stage.says(event_of(AT_20, climb)) == 'does_not'
    assert stage.says(event_of({'on': 'time', 'at_s': 29.8}, climb)) == 'holds'


@pytest.mark.parametrize(
    ('start', 'outcome'), [(27.0, 'holds'), (29.0, 'holds'), (33, 'does_not')]
)
def test_a_lane_is_changed_when_it_is_there_or_has_been_kept(
    stage: Any, start: float, outcome: str
) -> None:
    """On the other lane from about 21.5 s on: a chain counts from then to 2 s later."""
    stage.drive('car1', 'car', 4.0, y=np.interp(stage.t, [20.5, 22.5], [-1.65, -4.95]))
    stage.drive('bus1', 'bus', profile_of((0, 0), (start, 0), (start + 4, 8)), x=-100)
    then = event_of(
        {'on': 'event_done', 'event': 'e1', 'after_s': 5},
        {'do': 'start', 'agent': 'bus1'},
        ref='e2',
    )
    assert stage.says(then, event_of(AT_20, does('change_lane'))) == outcome


@pytest.mark.parametrize(
    ('starts_s', 'outcome'), [(30.0, 'holds'), (26.0, 'does_not'), (55.0, 'does_not')]
)
def test_who_stops_before_a_place_waits_from_its_standstill_on(
    stage: Any, starts_s: float, outcome: str
) -> None:
    """It stands 12 m before the crosswalk from 20 s on, and drives over it later."""
    back = starts_s + 4.0
    stage.drive(
        'car1', 'car', profile_of((0, 5), (16, 5), (20, 0), (starts_s, 0), (back, 8)), x=-2.0
    )
    stops = event_of({'on': 'arrives', 'who': 'car1', 'place': 'crosswalk'}, does('stop'))
    goes = event_of({'on': 'event_done', 'event': 'e1', 'after_s': 10}, does('start'), ref='e2')
    assert stage.outcomes(stops, goes) == ['holds', outcome]


@pytest.mark.parametrize(
    ('stands_s', 'starts_s', 'outcome'),
    [(23.0, 30.2, 'holds'), (23.0, 26.0, 'does_not'), (40.0, 42.0, 'does_not')],
)
def test_who_brakes_comes_to_rest_before_it_starts_again(
    stage: Any, stands_s: float, starts_s: float, outcome: str
) -> None:
    back = starts_s + 4.0
    stage.drive(
        'car1',
        'car',
        profile_of((0, 10), (20, 10), (22, 1), (stands_s, 0), (starts_s, 0), (back, 8)),
    )
    brakes = event_of(AT_20, does('brake'))
    goes = event_of({'on': 'event_done', 'event': 'e1', 'after_s': 10}, does('start'), ref='e2')
    assert stage.outcomes(brakes, goes) == ['holds', outcome]


@pytest.mark.parametrize(
    ('starts_s', 'outcome'), [(24.0, 'holds'), (25.1, 'holds'), (27.0, 'does_not')]
)
def test_who_stops_and_then_drives_on_stands_for_two_seconds_first(
    stage: Any, starts_s: float, outcome: str
) -> None:
    back = starts_s + 4.0
    stage.drive('car1', 'car', profile_of((0, 8), (20, 8), (22, 0), (starts_s, 0), (back, 8)))
    stops = event_of(AT_20, does('stop'))
    goes = event_of({'on': 'event_done', 'event': 'e1'}, does('start'), ref='e2')
    assert stage.outcomes(stops, goes) == ['holds', outcome]
