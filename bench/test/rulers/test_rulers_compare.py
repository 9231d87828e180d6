# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Two results are compared by how each trial ended and moved."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from aurora_bench.rulers.compare import main


def results(path: Path, *trials: tuple[str, str, str, str]) -> str:
    """Write results: id, status, motion hash, trace hash."""
    names = ('id', 'status', 'motion_sha256', 'trace_sha256')
    rows = [{'seed': 1, **dict(zip(names, trial, strict=True))} for trial in trials]
    path.write_text(json.dumps({'trials': rows}))
    return str(path)


def test_another_text_is_no_other_motion(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    before = results(tmp_path / 'a.json', ('p', 'verified', 'm', 't'), ('q', 'error', '', ''))
    after = results(tmp_path / 'b.json', ('p', 'verified', 'm', 'u'), ('q', 'error', '', ''))
    assert main([before, after]) == 0
    assert '2 trials in both, 1 with a motion hash: 0' in capsys.readouterr().out


@pytest.mark.parametrize('changed', [('p', 'violated', 'm', 't'), ('p', 'verified', 'n', 't')])
def test_what_ended_or_moved_otherwise_is_named(
    changed: tuple[str, str, str, str], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    before = results(tmp_path / 'a.json', ('p', 'verified', 'm', 't'))
    assert main([before, results(tmp_path / 'b.json', changed)]) == 1
    assert capsys.readouterr().out.startswith('p seed 1: ')


def test_results_of_other_prompts_are_not_equal(tmp_path: Path) -> None:
    before = results(tmp_path / 'a.json', ('p', 'verified', 'm', 't'))
    assert main([before, results(tmp_path / 'b.json', ('q', 'verified', 'm', 't'))]) == 1
