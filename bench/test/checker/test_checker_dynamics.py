# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Stated decelerations, headways, vertical speeds and gusts: who ignores the number is found."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

AT_20 = {'on': 'time', 'at_s': 20}
STREET_X = -490.0


def _event(action: dict[str, Any], on: dict[str, Any] | None = None) -> dict[str, Any]:
    return {'kind': 'event', 'ref': 'e1', 'trigger': on or AT_20, 'action': action}


def _slows(stage: Any, mps2: float, end: float = 0.0) -> None:
    """From 12 m/s at 20.3 s on."""
    ends_s = 20.3 + (12.0 - end) / mps2
    stage.drive('car1', 'car', lambda t: np.interp(t, [20.3, ends_s], [12.0, end]), x=STREET_X)


@pytest.mark.parametrize('do', ['stop', 'brake'])
@pytest.mark.parametrize(
    ('mps2', 'asked', 'outcome'),
    [(3.0, 3.0, 'holds'), (6.0, 3.0, 'does_not'), (3.0, 5.0, 'does_not')],
)
def test_a_stated_deceleration(
    stage: Any, do: str, mps2: float, asked: float, outcome: str
) -> None:
    _slows(stage, mps2)
    action = {'do': do, 'agent': 'car1', 'deceleration_mps2': asked}
    assert stage.says(_event(action)) == outcome


@pytest.mark.parametrize(
    ('op', 'value', 'outcome'),
    [('<=', 4.0, 'holds'), ('<=', 2.0, 'does_not'), ('>=', 5.0, 'does_not')],
)
def test_the_hardest_braking(stage: Any, op: str, value: float, outcome: str) -> None:
    _slows(stage, 3.0)
    asked = {'kind': 'condition', 'quantity': 'deceleration', 'of': ['car1'], 'op': op}
    assert stage.says({**asked, 'value': value}) == outcome


def _behind(stage: Any, gap_m: float, own: float = 10.0, lead: float = 10.0) -> None:
    """Two cars of 4.6 m in one lane."""
    stage.drive('car1', 'car', own, x=STREET_X)
    stage.drive('van1', 'van', lead, x=STREET_X + gap_m + 4.6)


@pytest.mark.parametrize(('asked', 'outcome'), [(1.5, 'holds'), (0.8, 'does_not')])
def test_a_stated_headway(stage: Any, asked: float, outcome: str) -> None:
    _behind(stage, 15.0)
    follows = {'kind': 'behavior', 'agent': 'car1', 'behavior': 'follow', 'target': 'van1'}
    assert stage.says({**follows, 'headway_s': asked}) == outcome


@pytest.mark.parametrize(
    ('quantity', 'op', 'value', 'outcome'),
    [
        ('time_headway', '>=', 1.2, 'holds'),
        ('time_headway', '>=', 2.0, 'does_not'),
        ('time_headway', '<=', 2.0, 'holds'),
        ('time_headway', '<=', 1.0, 'does_not'),
        ('time_to_collision', '>=', 5.0, 'holds'),
    ],
)
def test_bounds_on_what_is_kept_in_seconds(
    stage: Any, quantity: str, op: str, value: float, outcome: str
) -> None:
    _behind(stage, 15.0)
    asked = {'kind': 'condition', 'quantity': quantity, 'of': ['car1', 'van1'], 'op': op}
    assert stage.says({**asked, 'value': value}) == outcome


@pytest.mark.parametrize(('begins_s', 'outcome'), [(25.2, 'holds'), (15.0, 'does_not')])
def test_a_time_to_collision_that_is_waited_for(stage: Any, begins_s: float, outcome: str) -> None:
    """With 4 m/s over 120 m: 5 s are left at 25 s."""
    speed = np.interp(stage.t, [begins_s, begins_s + 1.0], [10.0, 6.0])
    stage.drive('car1', 'car', speed, x=STREET_X)
    stage.drive('van1', 'van', 6.0, x=STREET_X + 120.0 + 4.6)
    falls = {'on': 'ttc_below', 'a': 'car1', 'b': 'van1', 'value_s': 5}
    slow = {'do': 'slow', 'agent': 'car1', 'value_mps': 6}
    assert stage.says(_event(slow, falls)) == outcome


@pytest.mark.parametrize(('asked', 'outcome'), [(1.5, 'holds'), (3.0, 'does_not')])
def test_a_stated_vertical_speed(stage: Any, asked: float, outcome: str) -> None:
    stage.uav('drone', lambda t: (0, 0, np.interp(t, [20.5, 40.5], [30, 60])))
    climb = {'do': 'ascend', 'uav': 'drone', 'altitude_m': 60, 'vertical_mps': asked}
    assert stage.says(_event(climb)) == outcome


@pytest.mark.parametrize(('value', 'outcome'), [(2.0, 'holds'), (1.0, 'does_not')])
def test_a_bound_on_the_vertical_speed(stage: Any, value: float, outcome: str) -> None:
    stage.uav('drone', lambda t: (0, 0, np.interp(t, [20.5, 40.5], [30, 60])))
    asked = {'kind': 'condition', 'quantity': 'vertical_speed', 'of': ['drone'], 'op': '<='}
    assert stage.says({**asked, 'value': value}) == outcome


@pytest.mark.parametrize(('value', 'outcome'), [(8, 'holds'), (5, 'does_not')])
def test_gusts_as_recorded(stage: Any, value: float, outcome: str) -> None:
    stage.world = type(stage.world)(wind_mps=(3.0, 4.0), gust_mps=3.0)
    stage.uav('drone', lambda t: (4.0 * t, 0.0, 30.0))
    assert stage.says({'kind': 'world', 'field': 'gust_mps', 'value': value}) == outcome


@pytest.mark.parametrize(
    ('kind', 'stands_s', 'sets_off_s', 'outcome'),
    [
        ('stop', 8.0, 18.2, 'holds'),
        ('stop', 8.0, 14.0, 'does_not'),
        ('stop', 8.0, 22.0, 'does_not'),
        ('stop', 4.0, 14.2, 'does_not'),
        ('drive', 0.0, 16.0, 'holds'),
        ('drive', 0.0, 9.0, 'does_not'),
        ('drive', 0.0, 20.0, 'does_not'),
    ],
)
def test_what_follows_a_stated_time(
    stage: Any, kind: str, stands_s: float, sets_off_s: float, outcome: str
) -> None:
    """The bus is to set off 8 s after the car has stopped at 10 s, or is at 8 m/s at 8 s."""
    stops = [(8.0, 8.0), (9.8, 8.0), (10.0, 0.0), (10.0 + stands_s, 0.0), (12.0 + stands_s, 8.0)]
    drives = [(0.0, 2.0), (7.5, 2.0), (8.0, 8.0), (60.0, 8.0)]
    times, speeds = zip(*(stops if kind == 'stop' else drives), strict=True)
    stage.drive('car1', 'car', lambda t: np.interp(t, times, speeds), x=STREET_X)
    begun = np.maximum(stage.t - sets_off_s, 0.0)
    stage.ground('bus1', 'bus', -60.0 - 2.0 * begun, 38.35)
    lasts = {'kind': 'behavior', 'agent': 'car1', 'behavior': kind, 'duration_s': 8.0}
    lasts |= {'speed_mps': 8.0} if kind == 'drive' else {}
    over = {'on': 'behavior_done', 'who': 'car1', 'behavior': kind}
    follows = _event({'do': 'start', 'agent': 'bus1'}, over)
    assert stage.says(follows, lasts) == outcome
    alone = _event({'do': 'start', 'agent': 'bus1'}, {**over, 'behavior': 'wait'})
    assert stage.says(alone, lasts) == 'cannot_tell'
