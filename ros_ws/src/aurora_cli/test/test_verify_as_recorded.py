# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Limits and tolerances that were changed after a run: named, and judged as recorded."""

from __future__ import annotations

import json
import shutil
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from run_folders import Call, edited

from aurora_cli import installed
from aurora_core.knowledge.config_files import ENVIRONMENT_VARIABLE, config_path


@pytest.fixture
def configuration(here: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A configuration folder of its own, in force."""
    folder = here / 'config'
    folder.mkdir()
    for path in config_path().iterdir():
        (folder / path.name).symlink_to(path)
    monkeypatch.setenv(ENVIRONMENT_VARIABLE, str(folder))
    return folder


def configured(folder: Path, file: str, change: Callable[[dict[str, Any]], Any]) -> None:
    target = (folder / file).resolve()
    (folder / file).unlink()
    shutil.copyfile(target, folder / file)
    edited(folder / file, change)
    installed.forget()


def verified(call: Call, *arguments: str) -> tuple[int, str]:
    done = call('verify', *arguments)
    return done.code, done.out.splitlines()[0]


@pytest.mark.parametrize(
    ('file', 'change', 'name'),
    [
        ('limits.json', lambda d: d.update(clearance_min_m=4.0), 'limits.clearance_min_m'),
        ('tolerances.json', lambda d: d.update(stop_speed_mps=0.3), 'tolerances.stop_speed_mps'),
    ],
)
def test_limits_that_were_changed_after_the_run_are_named(
    run: Path,
    failed: Path,
    call: Call,
    configuration: Path,
    file: str,
    change: Callable[[dict[str, Any]], Any],
    name: str,
) -> None:
    configured(configuration, file, change)
    code, first = verified(call, str(run))
    assert (code, first.startswith('INCONCLUSIVE  Nothing is claimed: ')) == (4, True)
    assert name in first
    code, first = verified(call, str(run), '--as-recorded')
    assert code == 0
    assert first.startswith('AS RECORDED: MARGINS HOLD  Judged under version ')
    assert name in first
    code, first = verified(call, str(failed), '--as-recorded')
    assert code == 1
    assert first.startswith('AS RECORDED: VIOLATED  ')


def test_as_recorded_changes_nothing_where_nothing_differs(run: Path, call: Call) -> None:
    done = call('verify', str(run), '--as-recorded', '--json')
    assert done.code == 0
    document = json.loads(done.out)
    assert (document['outcome'], document['as_recorded']) == ('verified', None)
    # Nor does it help a bag that is not the one of the run.
    (run / 'report.json').unlink()
    assert call('verify', str(run), '--as-recorded').code == 4
