# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Agents, counts, world fields, and how names find their bodies."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from aurora_bench.checker import CheckerError, check_recording


def _cars(stage: Any, count: int, role: str = 'other', first: int = 1) -> None:
    for k in range(first, first + count):
        stage.drive(f'car{k}', 'car', 8.0, x=-40.0 * k, role=role)


def _says(stage: Any, *requirements: dict[str, Any]) -> list[str]:
    listed = [{'id': f'r{k}', **r} for k, r in enumerate(requirements)]
    checked = check_recording(stage.recording(), {'requirements': listed})
    return [a.outcome.value for a in checked.answers]


@pytest.mark.parametrize(
    ('there', 'asked', 'outcome'),
    [(2, 2, 'holds'), (1, 2, 'does_not'), (3, 2, 'does_not'), (0, 1, 'does_not')],
)
def test_an_agent_is_there_in_the_asked_number(
    stage: Any, there: int, asked: int, outcome: str
) -> None:
    _cars(stage, there)
    assert _says(stage, {'kind': 'agent', 'ref': 'a', 'type': 'car', 'count': asked}) == [outcome]


def test_background_traffic_is_none_too_many_but_counts_in_the_scene(stage: Any) -> None:
    _cars(stage, 1)
    _cars(stage, 4, role='background', first=2)
    agent = {'kind': 'agent', 'ref': 'a', 'type': 'car'}
    scene = {'kind': 'count', 'type': 'car', 'scope': 'scene'}
    assert _says(stage, agent, {**scene, 'value': 5}) == ['holds', 'holds']
    assert _says(stage, agent, {**scene, 'value': 1}) == ['holds', 'does_not']
    assert _says(stage, {'kind': 'agent', 'ref': 'b', 'type': 'bus', 'count': 0}) == ['holds']
    assert _says(stage, {'kind': 'agent', 'ref': 'c', 'type': 'car', 'count': 0}) == ['does_not']


def test_uavs_are_counted_and_roles_are_not_judged(stage: Any) -> None:
    stage.uav('drone', lambda t: (0, 0, 30))
    assert _says(stage, {'kind': 'uav', 'ref': 'u'}) == ['holds']
    assert _says(stage, {'kind': 'uav', 'ref': 'u', 'count': 2}) == ['does_not']
    _cars(stage, 1)
    ego = {'kind': 'agent', 'ref': 'ego', 'type': 'car', 'role': 'ego'}
    assert _says(stage, {'kind': 'uav', 'ref': 'u'}, ego) == ['holds', 'holds']


def test_names_go_to_the_bodies_that_satisfy_most(stage: Any) -> None:
    stage.drive('car1', 'car', 8.0, x=40.0)
    stage.drive('car2', 'car', 8.0, x=0.0)
    listed = [
        {'id': 'r1', 'kind': 'agent', 'ref': 'a', 'type': 'car'},
        {'id': 'r2', 'kind': 'agent', 'ref': 'b', 'type': 'car'},
        {'id': 'r3', 'kind': 'placement', 'agent': 'b', 'relation': 'ahead', 'of': 'a',
         'distance_m': 40},
    ]  # fmt: skip
    checked = check_recording(stage.recording(), {'requirements': listed})
    assert checked.binding == {'a': ('car2',), 'b': ('car1',)}
    assert [a.outcome.value for a in checked.answers] == ['holds'] * 3


def test_a_body_of_another_type_is_not_taken(stage: Any) -> None:
    stage.drive('van1', 'van', 8.0)
    drive = {'kind': 'behavior', 'agent': 'a', 'behavior': 'drive'}
    assert _says(stage, {'kind': 'agent', 'ref': 'a', 'type': 'car'}, drive) == ['does_not'] * 2


@pytest.mark.parametrize(
    ('field', 'right', 'wrong'),
    [
        ('weather', 'clear', 'rain'),
        ('time_of_day', 'noon', 'night'),
        ('map', 'street', 'downtown'),
        ('duration_s', 60.4, 58.0),
    ],
)
def test_a_field_of_the_world(stage: Any, field: str, right: object, wrong: object) -> None:
    asked = {'kind': 'world', 'field': field}
    assert stage.says({**asked, 'value': right}) == 'holds'
    assert stage.says({**asked, 'value': wrong}) == 'does_not'
    assert stage.says({**asked, 'value': wrong, 'negate': True}) == 'holds'


def test_traffic_without_a_vehicle_is_no_traffic(make_stage: Any) -> None:
    dense = {'kind': 'world', 'field': 'traffic_density', 'value': 'high'}
    low = {**dense, 'value': 'low'}

    def with_background(count: int) -> Any:
        stage = make_stage(20.0)
        stage.drive('bus1', 'bus', 0.0, x=0.0)
        for k in range(count):
            stage.drive(f'b{k}', 'car', 2.0, x=-200.0 + 20.0 * k, role='background')
        return stage

    assert with_background(0).says(low) == 'does_not'
    assert with_background(1).says(low) == 'does_not'
    # 585 m of street lie within 300 m of the bus: 12 vehicles are high, 2 are low.
    assert with_background(12).says(dense) == 'holds'
    assert with_background(12).says(low) == 'does_not'
    assert with_background(2).says(low) == 'holds'
    assert with_background(2).says(dense) == 'does_not'


@pytest.mark.parametrize(
    ('wind_mps', 'names'),
    [((8.0, 0.0), {'tailwind'}), ((-8.0, 1.0), {'headwind'}), ((0.0, 8.0), {'crosswind'})],
)
def test_wind_and_the_heading_of_who_is_tracked(
    stage: Any, wind_mps: tuple[float, float], names: set[str]
) -> None:
    stage.world = type(stage.world)(wind_mps=wind_mps)
    stage.drive('bus1', 'bus', 10.0)
    stage.uav('drone', lambda t: (10.0 * t, 0.0, 40.0), ends=(58.0,))
    track = {
        'kind': 'mission', 'uav': 'drone', 'mode': 'track', 'target': 'bus1',
    }  # fmt: skip
    held = {
        name
        for name in ('tailwind', 'headwind', 'crosswind')
        if _says(stage, {'kind': 'world', 'field': 'wind', 'value': name}, track)[0] == 'holds'
    }
    assert held == names


def test_a_hover_and_an_orbit_have_any_wind(stage: Any) -> None:
    stage.world = type(stage.world)(wind_mps=(8.0, 0.0))
    stage.uav('drone', lambda t: (0.0, 0.0, 40.0), ends=(58.0,))
    flown: list[dict[str, Any]] = [{'mode': 'hover'}, {'mode': 'navigate', 'pattern': 'orbit'}]
    for mission in flown:
        asked = {'kind': 'mission', 'uav': 'drone', **mission}
        for name in ('tailwind', 'headwind', 'crosswind'):
            wind = {'kind': 'world', 'field': 'wind', 'value': name}
            assert _says(stage, wind, asked)[0] == 'holds'


def test_wind_as_recorded(stage: Any) -> None:
    stage.world = type(stage.world)(wind_mps=(0.0, -8.0))
    stage.uav('drone', lambda t: (4.0 * t, 0.0, 30.0))
    speed = {'kind': 'world', 'field': 'wind_mps', 'value': 8}
    assert stage.says(speed) == 'holds'
    assert stage.says({**speed, 'value': 6}) == 'does_not'
    assert stage.says({'kind': 'world', 'field': 'wind_from_deg', 'value': 10}) == 'holds'
    assert stage.says({'kind': 'world', 'field': 'wind_from_deg', 'value': 90}) == 'does_not'
    assert stage.says({'kind': 'world', 'field': 'wind', 'value': 'crosswind'}) == 'holds'
    assert stage.says({'kind': 'world', 'field': 'wind', 'value': 'tailwind'}) == 'does_not'


@pytest.mark.parametrize(
    ('mps', 'outcome'), [(8.0, 'holds'), (7.5, 'holds'), (0.0, 'does_not'), (-8.0, 'does_not')]
)
def test_a_wind_shows_in_how_a_flight_leans(stage: Any, mps: float, outcome: str) -> None:
    """Who hovers leans west by what 8 m/s to the east, or less, take."""
    stage.world = type(stage.world)(wind_mps=(8.0, 0.0))
    stage.uav('drone', lambda _t: (0.0, 0.0, 40.0), ends=(58.0,))
    tangent = -(0.1 + 0.008 * abs(mps)) * mps / 9.80665
    half = np.arctan(tangent) / 2.0
    _, rows, _ = stage._uavs[0]
    rows[:, 6:10] = (np.cos(half), 0.0, np.sin(half), 0.0)
    assert stage.says({'kind': 'world', 'field': 'wind_mps', 'value': 8}) == outcome


def test_what_cannot_be_seen_is_said_so(stage: Any) -> None:
    assert stage.says({'kind': 'beyond', 'text': 'a rainbow'}) == 'cannot_tell'
    assert stage.says({'kind': 'reject', 'because': 'count'}) == 'cannot_tell'
    assert stage.says({'kind': 'something', 'x': 1}) == 'cannot_tell'
    assert stage.says({'kind': 'world', 'field': 'moon', 'value': 'full'}) == 'cannot_tell'


def test_one_of_several_readings_suffices(stage: Any) -> None:
    rain = {'id': 'a', 'kind': 'world', 'field': 'weather', 'value': 'rain'}
    clear = {**rain, 'value': 'clear'}
    open_ = {'id': 'b', 'kind': 'beyond', 'text': ''}
    assert stage.says({'kind': 'any_of', 'any_of': [rain, open_, clear]}) == 'holds'
    assert stage.says({'kind': 'any_of', 'any_of': [rain, open_]}) == 'cannot_tell'
    assert stage.says({'kind': 'any_of', 'any_of': [rain, rain]}) == 'does_not'


def test_a_prompt_without_requirements_is_refused(stage: Any) -> None:
    with pytest.raises(CheckerError, match='requirements'):
        check_recording(stage.recording(), {'id': 'x'})
    with pytest.raises(CheckerError, match='kind'):
        check_recording(stage.recording(), {'requirements': [{'id': 'r1'}]})
    half = {'id': 'r1', 'kind': 'condition', 'quantity': 'speed', 'of': ['car1']}
    with pytest.raises(CheckerError, match='no op'):
        check_recording(stage.recording(), {'requirements': [half]})
