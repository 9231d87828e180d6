# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The shipped maps, loaded once."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest

from aurora_core.knowledge.config_files import ENVIRONMENT_VARIABLE, config_root
from aurora_core.knowledge.map_model import MapModel, load_map


@pytest.fixture(scope='session')
def downtown() -> MapModel:
    """The default map."""
    return load_map('downtown')


@pytest.fixture(scope='session')
def junction() -> MapModel:
    """The one-junction map."""
    return load_map('junction')


@pytest.fixture
def config(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A copy of the configuration that a test may change, in force."""
    copy = tmp_path / 'config'
    for folder in ('knowledge', 'maps'):
        shutil.copytree(config_root() / folder, copy / folder, ignore_dangling_symlinks=True)
    for path in config_root().glob('*.json'):
        shutil.copy(path, copy)
    monkeypatch.setenv(ENVIRONMENT_VARIABLE, str(copy))
    return copy
