# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""When triggers fire, and when what is told is heard."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from checker_events import AT_20, does, event_of, profile_of


def _talk(stage: Any, sent: float, **more: Any) -> None:
    stage.uav('drone', lambda t: (0, 0, 40))
    stage.ground('car1', 'car', 50.0, 0.0)
    stage.message('drone', 'car1', sent, **more)


SEND = {'do': 'send_message', 'sender': 'drone', 'receiver': 'car1'}


@pytest.mark.parametrize(
    ('sent', 'latency', 'outcome'),
    [(20.0, 0.1, 'holds'), (20.9, 0.1, 'holds'), (21.4, 0.1, 'does_not'), (19.0, 0.1, 'does_not'),
     (20.0, 3.0, 'does_not'), (20.0, None, 'does_not')],
)  # fmt: skip
def test_a_message_is_sent_in_time_and_received(
    stage: Any, sent: float, latency: float | None, outcome: str
) -> None:
    _talk(stage, sent, latency=latency, losses=4 if latency is None else 0)
    assert stage.says(event_of(AT_20, SEND)) == outcome


def test_a_link_without_retransmissions_may_lose_it(stage: Any) -> None:
    _talk(stage, 20.0, latency=None, losses=1)
    link = {
        'kind': 'link', 'sender': 'drone', 'receiver': 'car1', 'loss': 0.5, 'retransmissions': 0,
    }  # fmt: skip
    assert stage.says(event_of(AT_20, SEND), link) == 'holds'
    assert stage.says(event_of(AT_20, SEND)) == 'does_not'


def test_a_message_from_the_ground_does_not_hold(stage: Any) -> None:
    stage.uav('drone', lambda t: (0, 0, 40), start_s=30.0)
    stage.ground('car1', 'car', 50.0, 0.0)
    stage.message('drone', 'car1', 0.1)
    assert stage.says(event_of({'on': 'time', 'at_s': 0}, SEND)) == 'does_not'


def test_distance_fires_when_it_is_crossed(make_stage: Any) -> None:
    on = {'on': 'distance_below', 'a': 'car1', 'b': 'bus1', 'value_m': 30}
    for sent, outcome in ((25.0, 'holds'), (22.0, 'does_not'), (29.0, 'does_not')):
        stage = make_stage()
        stage.drive('car1', 'car', 4.0, x=-130.0)
        stage.ground('bus1', 'bus', 0.0, -1.65)
        stage.ground('rsu1', 'rsu', 0.0, 8.0)
        stage.message('rsu1', 'car1', sent)
        asked = event_of(on, {'do': 'send_message', 'sender': 'rsu1', 'receiver': 'car1'})
        assert stage.says(asked) == outcome


def test_a_landmark_is_as_far_as_it_stands(make_stage: Any) -> None:
    # The road before it is 15 m nearer: who drives by there is 31.7 m from the hall itself.
    for value_m, outcome in ((40, 'holds'), (25, 'does_not')):
        stage = make_stage()
        stage.drive('car1', 'car', 8.0, x=0.0)
        stage.ground('rsu1', 'rsu', 0.0, 8.0)
        stage.message('rsu1', 'car1', (210.0 - np.sqrt(40.0**2 - 31.65**2)) / 8.0 + 0.1)
        near = {'on': 'distance_below', 'a': 'car1', 'b': 'City Hall', 'value_m': value_m}
        asked = event_of(near, {'do': 'send_message', 'sender': 'rsu1', 'receiver': 'car1'})
        assert stage.says(asked) == outcome


@pytest.mark.parametrize(
    ('at', 'sent', 'outcome'),
    [(6, 6.2, 'does_not'), (6, 10.2, 'does_not'), (10, 10.2, 'holds'), (9, 9.2, 'does_not')],
)
def test_a_message_at_a_stated_time_is_sent_then_and_not_in_the_ascent(
    stage: Any, at: float, sent: float, outcome: str
) -> None:
    _talk(stage, sent, latency=0.1)  # it is up at 10 s
    assert stage.says(event_of({'on': 'time', 'at_s': at}, SEND)) == outcome


def test_a_trigger_that_never_fires_does_not_hold(stage: Any) -> None:
    stage.drive('car1', 'car', 4.0)
    stage.ground('bus1', 'bus', -100.0, 20.0)
    on = {'on': 'distance_below', 'a': 'car1', 'b': 'bus1', 'value_m': 30}
    asked = event_of(on, does('brake'))
    assert stage.says(asked) == 'does_not'
    assert stage.says({**asked, 'negate': True}) == 'holds'
    assert stage.says(event_of({**on, 'b': 'Atlantis'}, does('brake'))) == 'cannot_tell'
    assert stage.says(event_of({'on': 'full_moon'}, does('brake'))) == 'cannot_tell'


@pytest.mark.parametrize(
    'trigger',
    [
        {'on': 'distance_above', 'a': 'car1', 'b': 'bus1', 'value_m': 80},
        {'on': 'speed_above', 'who': 'car1', 'value_mps': 8},
        {'on': 'altitude_reached', 'uav': 'drone', 'value_m': 50},
        {'on': 'visible', 'observer': 'drone', 'target': 'bus1'},
        {'on': 'arrives', 'who': 'car1', 'place': 'City Hall'},
        {'on': 'mission_done', 'uav': 'drone'},
        {'on': 'battery_below', 'uav': 'drone', 'value': 0.98},
        {'on': 'message_received', 'by': 'car1', 'from': 'drone'},
    ],
)
def test_every_trigger_fires_at_its_time(stage: Any, trigger: dict[str, Any]) -> None:
    """The bus starts when it happens; the same scene with a bus that starts late does not hold."""
    t = stage.t
    gain = np.interp(t, [29, 31], [4, 12])
    stage.drive('car1', 'car', gain, x=0.0)
    car = np.concatenate([[0.0], np.cumsum(gain[1:] * 0.1)])
    stage.uav(
        'drone',
        lambda t: (210.0, np.where(t < 40, 15.0, -70.0), np.interp(t, [20, 30], [30, 55])),
        ends=(45.0,),
    )
    stage.message('drone', 'car1', 29.9)
    when = {
        'distance_above': float(t[np.flatnonzero(np.hypot(car + 60.0, 40.0) > 80.0)[0]]),
        'speed_above': 30.0,
        'altitude_reached': 27.6,
        'visible': 40.0,
        'arrives': float(t[np.abs(car - 210.0).argmin()]),
        'mission_done': 45.0,
        'battery_below': 30.0,
        'message_received': 30.0,
    }[trigger['on']]
    if trigger['on'] == 'battery_below':
        trigger = {**trigger, 'value': 1.0 - (30.0 - 0.1) / 1500.0}
    x = np.full_like(t, -60.0)
    if trigger['on'] == 'visible':
        # Behind the tower at (40 to 60, 20 to 40) until the UAV has moved.
        x = np.full_like(t, -5.0)
    for late, outcome in ((0.4, 'holds'), (9.0, 'does_not')):
        begun = np.maximum(t - (when + late), 0.0)
        again = type(stage)()
        again._ground, again._uavs, again._ledger = (
            list(stage._ground), list(stage._uavs), list(stage._ledger),
        )  # fmt: skip
        y = 38.35
        if trigger['on'] == 'visible':
            y = 40.0
        again.ground('bus1', 'bus', x - 2.0 * begun, y)
        asked = event_of(trigger, {'do': 'start', 'agent': 'bus1'})
        assert again.says(asked) == outcome, (trigger['on'], again.answer(asked).why)


@pytest.mark.parametrize(('starts_s', 'outcome'), [(5.4, 'does_not'), (10.4, 'holds')])
def test_what_a_uav_passes_in_its_ascent_it_has_not_seen(
    stage: Any, starts_s: float, outcome: str
) -> None:
    """The bus is in sight from the beginning on; the UAV is up at 10 s."""
    t = stage.t
    stage.uav('drone', lambda t: (0.0, 20.0, np.interp(t, [0, 10], [1, 30])))
    stage.ground('bus1', 'bus', -2.0 * np.maximum(t - starts_s, 0.0), 38.0)
    trigger = {'on': 'visible', 'observer': 'drone', 'target': 'bus1'}
    asked = event_of(trigger, {'do': 'start', 'agent': 'bus1'})
    assert stage.says(asked) == outcome, stage.answer(asked).why


@pytest.mark.parametrize(
    ('starts_s', 'outcome'), [(24.4, 'holds'), (14.0, 'does_not'), (0.5, 'does_not')]
)
def test_who_crosses_a_street_arrives_on_its_other_sidewalk(
    stage: Any, starts_s: float, outcome: str
) -> None:
    """He stands on one from t = 0, leaves it at 21 s, is on the other at 24 s, stops at 25 s."""
    t = stage.t
    y = np.interp(t, [20.0, 21.0, 24.0, 25.0], [4.5, 3.3, -6.6, -8.0])
    stage.ground('ped1', 'pedestrian', np.full_like(t, 50.0), y)
    stage.ground('bus1', 'bus', np.full_like(t, -62.0) - 2.0 * np.maximum(t - starts_s, 0.0), 38.0)
    trigger = {'on': 'arrives', 'who': 'ped1', 'place': 'sidewalk'}
    asked = event_of(trigger, {'do': 'start', 'agent': 'bus1'})
    assert stage.says(asked) == outcome, stage.answer(asked).why


def test_occluded_and_slower_than(stage: Any) -> None:
    stage.ground('bus1', 'bus', 50.0, 0.0)
    stage.uav('drone', lambda t: (50, np.where(t < 30, -60, 100), 30))
    stage.drive('car1', 'car', profile_of((0, 8), (29, 8), (32, 0), (60, 0)), x=-200.0)
    lost = {'on': 'occluded', 'observer': 'drone', 'target': 'bus1'}
    assert stage.says(event_of(lost, does('stop'))) == 'holds'
    assert stage.says(event_of(lost, does('accelerate'))) == 'does_not'
    assert (
        stage.says(event_of({'on': 'speed_below', 'who': 'car1', 'value_mps': 7.0}, None))
        == 'holds'
    )
    climb = {'do': 'ascend', 'uav': 'drone', 'altitude_m': 60}
    assert stage.says(event_of(lost, climb)) == 'does_not'


def test_the_time_of_an_event(stage: Any) -> None:
    stage.drive('car1', 'car', profile_of((0, 10), (20, 10), (23, 0), (60, 0)))
    stop = event_of(None, does('stop'))
    early = {'kind': 'condition', 'quantity': 'event_time', 'of': ['e1'], 'op': '<=', 'value': 24}
    assert stage.says(early, stop) == 'holds'
    assert stage.says({**early, 'value': 15}, stop) == 'does_not'
    assert stage.says({**early, 'of': ['e7']}, stop) == 'cannot_tell'


def test_what_is_not_to_arrive_is_sent_all_the_same(stage: Any) -> None:
    stage.ground('car1', 'car', 0.0, 20.0)
    stage.ground('bus1', 'bus', 0.0, 40.0)
    stage.message('car1', 'bus1', 20.0, latency=None, losses=4, reason=2)
    tells = event_of(AT_20, {'do': 'send_message', 'sender': 'car1', 'receiver': 'bus1'})
    kept = {'kind': 'condition', 'quantity': 'delivered', 'of': ['car1', 'bus1'], 'op': '=='}
    assert stage.says(tells) == 'does_not'
    assert stage.says(tells, {**kept, 'value': False}) == 'holds'
    assert stage.says(tells, {**kept, 'value': True}) == 'does_not'


@pytest.mark.parametrize(
    ('sent', 'outcome'), [(5.2, 'holds'), (3.0, 'does_not'), (10.2, 'does_not')]
)
def test_an_altitude_of_the_ascent_is_reported_in_it(
    stage: Any, sent: float, outcome: str
) -> None:
    """It climbs to 40 m in 10 s."""
    stage.uav('drone', lambda t: (0, 0, 40.0))
    stage.ground('car1', 'car', 0.0, 20.0)
    stage.message('drone', 'car1', sent)
    tells = event_of(
        {'on': 'altitude_reached', 'uav': 'drone', 'value_m': 20},
        {'do': 'send_message', 'sender': 'drone', 'receiver': 'car1'},
    )
    assert stage.says(tells) == outcome
