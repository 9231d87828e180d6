# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""A campaign gives the same table whoever dies on the way."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import time
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import duckdb
import pytest
from campaign_work import cheap
from distributed import Client

from aurora_bench.campaign import command
from aurora_bench.campaign.__main__ import main
from aurora_bench.campaign.plan import PlanError, Task
from aurora_bench.campaign.record import CampaignRun
from aurora_cli.pool import Work

HELPERS = Path(__file__).parents[1] / 'helpers'
ONE = 'configurations: [B4]\n'
PROMPTS = ('one', 'two fails', 'three', 'four', 'five')


def plan_file(folder: Path, prompts: tuple[str, ...] = PROMPTS, more: str = ONE) -> Path:
    """Write a campaign of some prompts into a folder and return its file."""
    folder.mkdir(parents=True, exist_ok=True)
    lines = [
        json.dumps(
            {
                'id': f'hover-{900 + k}', 'category': 'hover', 'prompt': text,
                'feasibility': 'feasible', 'paraphrase_group': None, 'end_to_end': True,
                'requirements': [{'id': 'r1', 'kind': 'uav', 'ref': 'uav1'}],
            }
        )
        for k, text in enumerate(prompts)
    ]  # fmt: skip
    (folder / 'own.jsonl').write_text('\n'.join(lines) + '\n')
    path = folder / 'plan.yaml'
    path.write_text(f'name: small\nprompts: [own.jsonl]\n{more}')
    return path


@pytest.fixture
def here(monkeypatch: pytest.MonkeyPatch) -> None:
    """Start no worker: what is asked is about plan, journal and table, whoever does the work."""

    def in_turn(work: Work[Task, CampaignRun], left: Sequence[Task], **_: object) -> Any:
        work.prepare()
        yield from enumerate(map(work, left))

    monkeypatch.setattr(command, 'on_pool', in_turn)


def run(file: Path, out: Path, **options: Any) -> int:
    """Run a campaign of cheap work."""
    given = {'jobs': 1, 'dask': None, 'so_far': False, **options}
    asked: Any = SimpleNamespace(file=file, out=out, **given)
    return command.run_campaign(asked, cheap)


def table(out: Path) -> tuple[bytes, bytes]:
    """Return what was found, as bytes."""
    return (out / 'runs.json').read_bytes(), (out / 'runs.parquet').read_bytes()


def test_a_killed_runner_goes_on_to_the_same_table(tmp_path: Path) -> None:
    file = plan_file(tmp_path / 'in')
    assert run(file, tmp_path / 'whole') == 0
    code = (
        'import sys, time; from types import SimpleNamespace as N; from pathlib import Path\n'
        f'sys.path.insert(0, {str(HELPERS)!r})\n'
        'from aurora_bench.campaign.command import run_campaign; from campaign_work import cheap\n'
        'import aurora_bench.campaign.command as c\n'
        'add = c.Journal.add\n'
        # The third run is never written: it waits there to be killed.
        'n = []\n'
        'c.Journal.add = lambda *a: (n.append(1), time.sleep(600 if len(n) > 2 else 0), add(*a))\n'
        f'run_campaign(N(file=Path({str(file)!r}), out=Path({str(tmp_path / "cut")!r}), jobs=1,'
        ' dask=None, so_far=False), cheap)\n'
    )
    script = tmp_path / 'runner.py'
    script.write_text("if __name__ == '__main__':\n    exec(" + repr(code) + ')\n')
    runner = subprocess.Popen([sys.executable, str(script)], stderr=subprocess.DEVNULL)
    journal = tmp_path / 'cut' / 'small.journal.jsonl'
    while not journal.exists() or journal.read_bytes().count(b'\n') < 3:
        assert runner.poll() is None
        time.sleep(0.05)
    runner.send_signal(signal.SIGKILL)
    runner.wait()
    assert not (tmp_path / 'cut' / 'runs.json').exists()
    with journal.open('ab') as stream:
        stream.write(b'{"key": "half a li')
    assert run(file, tmp_path / 'cut', jobs=1) == 0
    assert table(tmp_path / 'cut') == table(tmp_path / 'whole')


@pytest.mark.parametrize('dask', [None, 'local'])
def test_a_killed_worker_costs_nothing(
    tmp_path: Path, dask: str | None, capsys: pytest.CaptureFixture[str]
) -> None:
    """Its run is tried again; one that kills twice is named, and the others are there."""
    file = plan_file(tmp_path / 'in', ('one', 'dies once', 'three', 'dies always', 'five'))
    assert run(file, tmp_path / 'out', dask=dask, jobs=2) == 1
    assert '5 runs  quarantined 1' in capsys.readouterr().out
    found = json.loads((tmp_path / 'out' / 'runs.json').read_text())
    assert [k.split(':')[1] for k in found['quarantined']] == ['hover-903']
    endings = [r['ending'] for r in found['runs']]
    assert endings == ['completed', 'completed', 'completed', 'failed', 'completed']


@contextmanager
def started_as_users_do(folder: Path, workers: int) -> Iterator[str]:
    """Start a Dask scheduler and workers as processes of their own; give the address."""
    place = folder / 'scheduler.json'
    environment = {
        **os.environ,
        'PYTHONPATH': os.pathsep.join([str(HELPERS), os.environ.get('PYTHONPATH', '')]),
    }
    scheduler = ['scheduler', '--host', '127.0.0.1', '--port', '0', '--no-dashboard']
    worker = ['worker', '--nthreads', '1', '--no-dashboard', '--host', '127.0.0.1']
    processes = [
        subprocess.Popen(
            [sys.executable, '-m', 'dask', *command, '--scheduler-file', str(place)],
            env=environment,
            cwd=folder,
            stderr=subprocess.DEVNULL,
        )
        for command in (scheduler, *(worker for _ in range(workers)))
    ]
    try:
        while not (place.exists() and place.read_text().endswith('}')):
            assert processes[0].poll() is None
            time.sleep(0.05)
        address = str(json.loads(place.read_text())['address'])
        with Client(address) as client:
            client.wait_for_workers(workers, timeout=240)
        yield address
    finally:
        # The workers first: without their scheduler they would look for it.
        for process in reversed(processes):
            process.terminate()
            try:
                process.wait(timeout=20)
            except subprocess.TimeoutExpired:
                process.kill()
                process.wait()


def test_workers_that_users_started_give_the_same_table(tmp_path: Path) -> None:
    """One of the two dies over a run; the table is that of the processes of this machine."""
    prompts = ('one', 'two fails', 'dies once', 'four')
    assert run(plan_file(tmp_path / 'here' / 'in', prompts), tmp_path / 'whole') == 0
    file = plan_file(tmp_path / 'there' / 'in', prompts)
    with started_as_users_do(tmp_path, 2) as address:
        assert run(file, tmp_path / 'out', dask=address) == 0
    assert table(tmp_path / 'out') == table(tmp_path / 'whole')


@pytest.mark.usefixtures('here')
def test_the_parquet_file_holds_every_run(tmp_path: Path) -> None:
    file = plan_file(tmp_path / 'in', more='seeds: [1, 2]\n')
    assert run(file, tmp_path / 'out') == 0
    found = duckdb.sql(
        "SELECT configuration, count(*), sum(CAST(final = 'verified' AS INT)), min(margin) "
        f"FROM '{tmp_path / 'out' / 'runs.parquet'}' GROUP BY ALL ORDER BY 1"
    )
    assert found is not None
    rows = found.fetchall()
    assert rows == [('AURORA', 10, 8, 1.1), ('B4', 10, 8, 1.1), ('B5', 10, 8, 1.1)]


@pytest.mark.usefixtures('here')
def test_more_seeds_go_on_with_what_is_there(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """The table is the one of a campaign that had all seeds from the beginning."""
    assert run(plan_file(tmp_path / 'in', more=f'{ONE}seeds: [1]\n'), tmp_path / 'out') == 0
    more = plan_file(tmp_path / 'in', more=f'{ONE}seeds: [1, 2, 3]\n')
    capsys.readouterr()
    assert run(more, tmp_path / 'out') == 0
    assert capsys.readouterr().err.count('from the journal') == len(PROMPTS)
    assert run(more, tmp_path / 'whole') == 0
    assert table(tmp_path / 'out') == table(tmp_path / 'whole')


@pytest.mark.usefixtures('here')
def test_what_is_there_so_far_is_a_table_of_its_own(tmp_path: Path) -> None:
    """Of two seeds one was run: its table holds it alone, and names the others."""
    one = plan_file(tmp_path / 'in', more=f'{ONE}seeds: [1]\n')
    assert run(one, tmp_path / 'out') == 0
    both = plan_file(tmp_path / 'in', more=f'{ONE}seeds: [1, 2]\n')
    assert run(both, tmp_path / 'out', so_far=True) == 1
    found = json.loads((tmp_path / 'out' / 'runs.json').read_text())
    assert [r['seed'] for r in found['runs']] == [1] * len(PROMPTS)
    assert set(found['quarantined'].values()) == {'not run yet'}
    assert len(found['quarantined']) == len(PROMPTS)
    # It is no end: the same campaign goes on.
    assert run(both, tmp_path / 'out') == 0


@pytest.mark.usefixtures('here')
def test_another_campaign_is_not_mixed_in(tmp_path: Path) -> None:
    assert run(plan_file(tmp_path / 'in'), tmp_path / 'out') == 0
    other = plan_file(tmp_path / 'in', more=f'{ONE}repair: 3\n')
    with pytest.raises(Exception, match='of another campaign: its options'):
        run(other, tmp_path / 'out')


@pytest.mark.parametrize(
    ('more', 'told'),
    [
        ('colour: red\n', 'colour: Extra inputs'),
        ('configurations: [B4, B4]\n', 'configurations: at least one, and each once'),
        ('configurations: [B6]\n', 'configurations.0'),
        ('map: atlantis\n', "there is no map 'atlantis'"),
        ('seed: [\n', 'is no YAML'),
    ],
)
def test_a_wrong_plan_is_refused_in_one_line(
    tmp_path: Path, more: str, told: str, capsys: pytest.CaptureFixture[str]
) -> None:
    file = plan_file(tmp_path / 'in', more=more)
    assert main(['run', str(file), '--out', str(tmp_path / 'out')]) == 64
    assert told in capsys.readouterr().err


def test_a_report_needs_a_campaign(tmp_path: Path) -> None:
    from aurora_bench.campaign.results import read_campaign

    with pytest.raises(PlanError, match='holds no finished campaign'):
        read_campaign(tmp_path)
