# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from types import SimpleNamespace

import pytest

from aurora_cli.commands.seeds import worst_exit_code
from aurora_core.report.status import Status

Call = Callable[..., SimpleNamespace]
PROMPT = 'A drone hovers at 20 meters over the ego car for 5 seconds.'


@pytest.mark.parametrize(
    ('statuses', 'code'),
    [
        ([Status.VERIFIED, Status.VERIFIED], 0),
        ([Status.VERIFIED, Status.INCOMPLETE], 3),
        ([Status.INCOMPLETE, Status.INFEASIBLE], 5),
        ([Status.INFEASIBLE, Status.VIOLATED, Status.VERIFIED], 1),
        ([Status.VIOLATED, Status.INCONCLUSIVE], 4),
        ([Status.ERROR, Status.CANCELLED], 130),
    ],
)
def test_the_worst_run_decides_the_exit_code(statuses: list[Status], code: int) -> None:
    assert worst_exit_code(statuses, all_run=True) == code
    assert worst_exit_code(statuses, all_run=False) == 130


def test_every_seed_is_a_run_of_its_own(here: Path, call: Call) -> None:
    done = call('run', PROMPT, '--seed', '7', '--seeds', '2', '--json')
    answer = json.loads(done.out)
    assert done.code == 0, done.err
    assert [row['seed'] for row in answer['runs']] == [7, 8]
    assert (answer['verified'], answer['of'], answer['pass_probability']) == (2, 2, 1.0)
    assert answer['interval_95'][0] == pytest.approx(0.342, abs=0.001)
    for row in answer['runs']:
        report = json.loads((here / 'runs' / row['run_id'] / 'report.json').read_text())
        assert (report['seed'], report['status']) == (row['seed'], row['status'])


def test_a_seed_that_fails_shows_in_table_and_code(here: Path, call: Call) -> None:
    fault = '{"kind": "target_removed", "subject": "ego", "at_s": 2.0}'
    done = call('run', PROMPT, '--seeds', '1', '--fault', fault)
    assert done.code == 1
    assert done.out.startswith('verified 0 of 1 seeds  0.000 [0.000, 0.793], violated 1')


def test_quiet_seeds_say_the_share_alone(here: Path, call: Call) -> None:
    done = call('run', PROMPT, '--seeds', '1', '--quiet')
    assert (done.code, done.err) == (0, '')
    assert done.out.splitlines() == ['verified 1 of 1 seeds  1.000 [0.207, 1.000]']


@pytest.mark.parametrize('seeds', ['0', '-3', '1000000'])
def test_a_number_of_seeds_that_cannot_be(here: Path, call: Call, seeds: str) -> None:
    done = call('run', PROMPT, '--seeds', seeds)
    assert (done.code, done.out) == (64, '')
    assert '--seeds takes 1 to' in done.err
