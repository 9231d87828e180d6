# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The resolver finds the right configuration folder and says clearly when there is none."""

from __future__ import annotations

from pathlib import Path

import pytest

from aurora_core.errors import ConfigError
from aurora_core.knowledge import config_files
from aurora_core.knowledge.config_files import config_path, config_root


def test_environment_variable_wins(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / 'own').mkdir()
    (tmp_path / 'share' / 'aurora_config').mkdir(parents=True)
    monkeypatch.setenv('AURORA_CONFIG_DIR', str(tmp_path / 'own'))
    monkeypatch.setenv('AMENT_PREFIX_PATH', str(tmp_path))
    assert config_root() == tmp_path / 'own'


def test_environment_variable_without_folder_is_refused(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv('AURORA_CONFIG_DIR', str(tmp_path / 'nowhere'))
    with pytest.raises(ConfigError, match='AURORA_CONFIG_DIR names') as caught:
        config_root()
    assert caught.value.component == 'config'


def test_first_installed_share_is_next(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    share = tmp_path / 'b' / 'share' / 'aurora_config'
    share.mkdir(parents=True)
    monkeypatch.delenv('AURORA_CONFIG_DIR', raising=False)
    monkeypatch.setenv('AMENT_PREFIX_PATH', f'{tmp_path / "a"}:{tmp_path / "b"}')
    assert config_root() == share


def test_source_checkout_is_last(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv('AURORA_CONFIG_DIR', raising=False)
    monkeypatch.delenv('AMENT_PREFIX_PATH', raising=False)
    assert (config_root() / 'maps' / 'downtown' / 'map.json').is_file()


def test_checkout_is_found_through_a_symbolic_link(tmp_path: Path) -> None:
    (tmp_path / 'real' / 'config' / 'maps').mkdir(parents=True)
    file = tmp_path / 'real' / 'package' / 'module.py'
    file.parent.mkdir()
    file.touch()
    link = tmp_path / 'elsewhere.py'
    link.symlink_to(file)
    assert config_files._checkout_config(link) == (tmp_path / 'real' / 'config').resolve()


def test_no_configuration_anywhere(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv('AURORA_CONFIG_DIR', raising=False)
    monkeypatch.delenv('AMENT_PREFIX_PATH', raising=False)
    monkeypatch.setattr(config_files, '_checkout_config', lambda _start: None)
    with pytest.raises(ConfigError, match='found none') as caught:
        config_root()
    assert 'make setup' in caught.value.hint


def test_missing_file_names_file_and_folder(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv('AURORA_CONFIG_DIR', str(tmp_path))
    with pytest.raises(ConfigError, match=r'limits/none\.json') as caught:
        config_path('limits', 'none.json')
    assert str(tmp_path) in caught.value.message
    assert 'make setup' in caught.value.hint
