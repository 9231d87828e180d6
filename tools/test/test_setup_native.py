# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What each tick does is compiled when its files change; a failure leaves plain Python."""

from __future__ import annotations

import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from layout import Layout
from native import MODULES, ensure_native

PACKAGE = Path(__file__).resolve().parents[2] / 'bridges' / 'aurora_uav_sim'


@pytest.fixture
def layout(tmp_path: Path) -> Layout:
    place = tmp_path / 'ros_ws' / 'src' / 'aurora_uav_sim'
    for folder in ('native', 'aurora_uav_sim'):
        shutil.copytree(PACKAGE / folder, place / folder)
    shutil.copy(PACKAGE / 'package.xml', place)
    tag = f'{sys.version_info.major}.{sys.version_info.minor}'
    return Layout(root=tmp_path, ros='wheels', python_tag=tag)


MODULE = 'aurora_uav_flight'


def modules(layout: Layout, name: str = '') -> list[Path]:
    return sorted(layout.install.rglob(f'aurora_uav_{name}*'))


def test_it_is_compiled_once_and_again_after_a_change(layout: Layout) -> None:
    ensure_native(layout)
    (made,) = modules(layout, 'flight')
    before = made.stat().st_mtime_ns
    code = f'import {MODULE}; print({MODULE}.SOURCES)'
    command = [sys.executable, '-S', '-c', code]
    told = subprocess.run(command, cwd=made.parent, capture_output=True, text=True, check=True)
    ensure_native(layout)
    assert made.stat().st_mtime_ns == before
    formulas = layout.workspace / 'src' / 'aurora_uav_sim' / 'aurora_uav_sim' / 'control.py'
    formulas.write_text(formulas.read_text() + '# changed\n')
    ensure_native(layout)
    assert made.stat().st_mtime_ns != before
    again = subprocess.run(command, cwd=made.parent, capture_output=True, text=True, check=True)
    assert told.stdout != again.stdout, 'the module names the files that it is equal to'


def test_a_compiler_that_cannot_leaves_nothing_old(
    layout: Layout, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    ensure_native(layout)
    monkeypatch.setenv('CC', 'false')
    ensure_native(layout)
    assert not modules(layout)
    assert 'plain Python' in capsys.readouterr().out
    monkeypatch.delenv('CC')
    ensure_native(layout)
    assert len(modules(layout)) == len(MODULES)
