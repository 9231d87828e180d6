# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Limits and tolerances: the shipped values are the contract's, a bad file names its field."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from aurora_core.errors import ConfigError
from aurora_core.knowledge.config_files import config_path
from aurora_core.knowledge.limits import Limits, Tolerance, load_limits, load_tolerances

CHANGES = [
    ('uav_altitude_max_m', 'high', 'uav_altitude_max_m'),
    ('uav_altitude_max_m', None, 'uav_altitude_max_m'),
    ('uav_altitude_max_m', -1.0, 'uav_altitude_max_m'),
    ('uav_altitude_max_m', float('inf'), 'uav_altitude_max_m'),
    ('uav_altitude_max_m', float('nan'), 'uav_altitude_max_m'),
    ('uav_altitude_max_m', 2.0, 'uav_altitude_min_m is above uav_altitude_max_m'),
    ('duration_min_s', 1e6, 'duration_min_s is above duration_max_s'),
    ('uavs_max', 1.5, 'uavs_max'),
    ('sensing_range_m', {'clear': 250.0}, 'sensing_range_m lacks cloudy'),
    ('sensing_factor', {'noon': 1.0}, 'sensing_factor lacks dawn'),
    ('wind_gust_mps', {}, 'wind_gust_mps lacks clear'),
    ('sensing_factor', {'noon': 0.0}, 'sensing_factor.noon'),
    ('invented', 1.0, 'invented'),
]


def _changed(tmp_path: Path, name: str, field: str, value: Any) -> Path:
    table = json.loads(config_path(name).read_text(encoding='utf-8'))
    table[field] = value
    path = tmp_path / name
    path.write_text(json.dumps(table), encoding='utf-8')
    return path


def test_the_drag_is_that_of_the_multirotor() -> None:
    body = json.loads(config_path('multirotor.json').read_text())['body']
    limits = load_limits(config_path('limits.json'))
    assert limits.uav_drag_hz == pytest.approx(body['drag_linear_nspm'] / body['mass_kg'])
    assert limits.uav_drag_per_m == pytest.approx(body['drag_quadratic_ns2pm2'] / body['mass_kg'])


def test_shipped_limits_are_those_of_the_contract() -> None:
    limits = load_limits(config_path('limits.json'))
    assert (limits.uav_altitude_min_m, limits.uav_altitude_max_m) == (3.0, 120.0)
    assert (limits.uav_speed_max_mps, limits.vehicle_speed_max_mps) == (18.0, 50.0)
    assert (limits.uavs_max, limits.agents_max) == (10, 200)
    assert limits.sensing_range('fog', 'night') == pytest.approx(45.0)
    assert limits.sensing_range('clear', 'noon') == 250.0
    assert limits.sensing_range('heavy_rain', 'dusk') == pytest.approx(80.0)


def test_limits_travel_byte_exact() -> None:
    limits = load_limits(config_path('limits.json'))
    again = Limits.model_validate_json(limits.canonical_json())
    assert again == limits
    assert again.canonical_json() == limits.canonical_json()
    assert ' ' not in limits.canonical_json()


@pytest.mark.parametrize(('field', 'value', 'named'), CHANGES)
def test_a_bad_limit_is_named(tmp_path: Path, field: str, value: Any, named: str) -> None:
    path = _changed(tmp_path, 'limits.json', field, value)
    with pytest.raises(ConfigError) as caught:
        load_limits(path)
    assert named in caught.value.message
    assert str(path) in caught.value.message
    assert '\n' not in caught.value.message
    assert caught.value.hint


def test_a_missing_limit_is_named(tmp_path: Path) -> None:
    table = json.loads(config_path('limits.json').read_text(encoding='utf-8'))
    del table['uav_speed_max_mps']
    (tmp_path / 'limits.json').write_text(json.dumps(table), encoding='utf-8')
    with pytest.raises(ConfigError, match='uav_speed_max_mps'):
        load_limits(tmp_path / 'limits.json')


@pytest.mark.parametrize(
    ('field', 'value', 'named'),
    [
        ('tracked_fraction', 1.1, 'tracked_fraction'),
        ('visible_fraction', 0.0, 'visible_fraction'),
        ('altitude_m', {'absolute': -2.0, 'relative': 0.03}, 'altitude_m.absolute'),
        ('altitude_m', {'absolute': 2.0}, 'altitude_m.relative'),
        ('follow_gap_moving_m', [5.0], 'follow_gap_moving_m'),
        ('latency_steps', -1, 'latency_steps'),
    ],
)
def test_a_bad_tolerance_is_named(tmp_path: Path, field: str, value: Any, named: str) -> None:
    with pytest.raises(ConfigError) as caught:
        load_tolerances(_changed(tmp_path, 'tolerances.json', field, value))
    assert named in caught.value.message


@pytest.mark.parametrize('data', [b'', b'{', b'[]', b'3', b'\xff\xfe{}'])
def test_what_is_no_table_is_refused(tmp_path: Path, data: bytes) -> None:
    (tmp_path / 'limits.json').write_bytes(data)
    with pytest.raises(ConfigError, match='is not valid'):
        load_limits(tmp_path / 'limits.json')


def test_a_file_that_is_not_there(tmp_path: Path) -> None:
    with pytest.raises(ConfigError, match='cannot be read') as caught:
        load_tolerances(tmp_path / 'tolerances.json')
    assert 'make setup' in caught.value.hint


@pytest.mark.parametrize(
    ('value', 'approximate', 'expected'),
    [
        (40.0, False, 2.0),  # the absolute part is larger
        (120.0, False, 3.6),  # 3 %
        (-120.0, False, 3.6),
        (40.0, True, 4.0),  # "about": 10 %
        (5.0, True, 2.0),
    ],
)
def test_the_larger_tolerance_counts(value: float, approximate: bool, expected: float) -> None:
    tolerance = Tolerance(absolute=2.0, relative=0.03)
    assert tolerance.of(value, approximate=approximate) == pytest.approx(expected, abs=1e-12)


def test_about_never_narrows() -> None:
    assert Tolerance(absolute=0.0, relative=0.2).of(10.0, approximate=True) == pytest.approx(2.0)
