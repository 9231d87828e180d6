# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Settings: a bad file names its field; flight stays below the limits."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from aurora_core.errors import ConfigError
from aurora_core.knowledge.config_files import config_path
from aurora_core.knowledge.limits import load_limits, load_tolerances
from aurora_core.knowledge.settings import load_settings


def _use(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, change: Any) -> None:
    table = json.loads(config_path('settings.json').read_text(encoding='utf-8'))
    change(table)
    (tmp_path / 'settings.json').write_text(json.dumps(table), encoding='utf-8')
    monkeypatch.setenv('AURORA_CONFIG_DIR', str(tmp_path))


def test_reference_motion_stays_below_the_limits() -> None:
    flight, limits = load_settings().flight, load_limits(config_path('limits.json'))
    assert flight.speed_max_mps < limits.uav_speed_max_mps
    assert flight.climb_mps < limits.uav_climb_max_mps
    assert flight.descent_mps < limits.uav_descent_max_mps
    grounding = load_settings().grounding
    assert grounding.clearance_m > limits.clearance_min_m
    assert 2.0 * grounding.spot_clearance_m > limits.separation_min_m
    tolerances = load_tolerances(config_path('tolerances.json'))
    assert max(abs(s) for s in grounding.pattern_shifts_m) < tolerances.pattern_centre_m
    assert grounding.pattern_shifts_m[0] == 0.0  # the exact centre is preferred
    assert grounding.target_speed_mps < flight.speed_max_mps


@pytest.mark.parametrize(
    ('group', 'field'),
    [
        ('grounding', 'inside_bound_m'),
        ('grounding', 'longest_way_m'),
        ('grounding', 'passing_m'),
        ('grounding', 'persons'),
        ('grounding', 'speeds'),
        ('run', 'driving'),
    ],
)
def test_recordings_from_before_a_setting_are_judged_by_what_held_then(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, group: str, field: str
) -> None:
    shipped = load_settings()
    assert field in json.loads(config_path('settings.json').read_text(encoding='utf-8'))[group]
    _use(tmp_path, monkeypatch, lambda table: table[group].pop(field))
    assert load_settings() == shipped
    assert field not in shipped.model_dump(mode='json')[group]


@pytest.mark.parametrize(
    ('group', 'field', 'value'),
    [
        ('run', 'dt_s', 0.0),
        ('run', 'dt_s', -0.05),
        ('run', 'dt_s', 'fast'),
        ('run', 'convoy_lane_change_mode', 1.5),
        ('flight', 'acceleration_mps2', 0.0),
        ('flight', 'climb_mps', None),
        ('grounding', 'anchor_spacing_m', 0.0),
        ('grounding', 'bearings', 0),
        ('grounding', 'spot_spacing_m', float('nan')),
        ('grounding', 'background_radius_m', [1.0]),
        ('grounding', 'weights', {'road': 0.0, 'air': 0.0, 'sense': 0.0, 'comm': 0.0}),
        ('grounding', 'invented', 1.0),
    ],
)
def test_a_bad_setting_is_named(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, group: str, field: str, value: Any
) -> None:
    _use(tmp_path, monkeypatch, lambda table: table[group].update({field: value}))
    with pytest.raises(ConfigError) as caught:
        load_settings()
    assert group in caught.value.message
    assert field in caught.value.message
    assert str(tmp_path / 'settings.json') in caught.value.message


def test_a_missing_group_is_named(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    _use(tmp_path, monkeypatch, lambda table: table.pop('flight'))
    with pytest.raises(ConfigError, match='flight'):
        load_settings()


@pytest.mark.parametrize('data', [b'', b'[1]', b'\xff'])
def test_what_is_no_table_is_refused(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, data: bytes
) -> None:
    (tmp_path / 'settings.json').write_bytes(data)
    monkeypatch.setenv('AURORA_CONFIG_DIR', str(tmp_path))
    with pytest.raises(ConfigError, match='is not valid'):
        load_settings()


def test_a_file_that_is_not_there(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv('AURORA_CONFIG_DIR', str(tmp_path))
    with pytest.raises(ConfigError, match=r'settings\.json'):
        load_settings()
    (tmp_path / 'settings.json').mkdir()
    with pytest.raises(ConfigError, match='cannot be read'):
        load_settings()
