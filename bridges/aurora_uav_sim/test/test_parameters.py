# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The vehicle's file: read whole, a changed number flies, a bad one is named."""

from __future__ import annotations

import json
import shutil
from pathlib import Path
from typing import Any

import pytest

from aurora_core.errors import ConfigError
from aurora_core.knowledge.config_files import ENVIRONMENT_VARIABLE, config_path
from aurora_uav_sim.autopilot import Autopilot
from aurora_uav_sim.parameters import MODEL_FILE, installed_model


@pytest.fixture
def model_file(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    shutil.copy(config_path(MODEL_FILE), tmp_path)
    monkeypatch.setenv(ENVIRONMENT_VARIABLE, str(tmp_path))
    return tmp_path / MODEL_FILE


def _change(path: Path, change: Any) -> None:
    table = json.loads(path.read_text())
    change(table)
    path.write_text(json.dumps(table))


def test_a_changed_number_is_flown_with(model_file: Path) -> None:
    before = Autopilot().body.parameters.mass_kg
    _change(model_file, lambda t: t['body'].update(mass_kg=2.0))
    assert (before, Autopilot().body.parameters.mass_kg) == (1.5, 2.0)


@pytest.mark.parametrize(
    ('change', 'named'),
    [
        (lambda t: t['body'].pop('mass_kg'), 'mass_kg'),
        (lambda t: t['control'].update(wings=2.0), 'wings'),
        (lambda t: t['energy'].update(battery_wh=0.0), 'battery_wh'),
        (lambda t: t['body'].update(mass_kg='heavy'), 'heavy'),
        (lambda t: t['body'].update(mass_kg=float('inf')), 'mass_kg'),
        (lambda t: t.pop('control'), 'control'),
    ],
)
def test_a_bad_number_is_named(model_file: Path, change: Any, named: str) -> None:
    _change(model_file, change)
    with pytest.raises(ConfigError, match=named):
        installed_model()


def test_a_missing_file_is_named(model_file: Path) -> None:
    model_file.unlink()
    with pytest.raises(ConfigError, match=r'multirotor\.json'):
        installed_model()
