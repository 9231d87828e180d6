# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`import aurora`: the same answers as the command, without what a library must not do."""

from __future__ import annotations

import base64
import gc
import json
import os
import re
import signal
import subprocess
import sys
from pathlib import Path
from types import SimpleNamespace

import pytest

import aurora
from aurora_cli.main import run_command_line
from aurora_core.errors import BagError, ConfigError, ExecutionError, MapError, PromptError
from aurora_core.report.run_report import RunReport

ROOT = Path(__file__).resolve().parents[4]
NOTEBOOK, SWEEP, IN_PYTEST = re.findall(
    r'```python\n(.*?)```', (ROOT / 'docs' / 'library.md').read_text(encoding='utf-8'), re.DOTALL
)
HEAVY = ('numpy', 'pydantic', 'typer', 'rich', 'libsumo', 'rclpy', 'yaml', 'aurora_core')


def python(*arguments: str, cwd: Path, **environment: str) -> str:
    done = subprocess.run(
        [sys.executable, *arguments],
        cwd=cwd,
        env={**os.environ, **environment},
        capture_output=True,
        text=True,
        timeout=120,
        check=False,
    )
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


def test_the_import_loads_nothing(tmp_path: Path) -> None:
    code = f'import sys, aurora; print([m for m in {HEAVY} if m in sys.modules], dir(aurora))'
    shown = python('-c', code, cwd=tmp_path)
    assert shown.startswith('[] ')
    assert all(name in shown for name in aurora.__all__)


def test_a_run_answers_as_the_command_does(
    finished: SimpleNamespace,
    shell: SimpleNamespace,
    here: Path,
    capfd: pytest.CaptureFixture[str],
) -> None:
    handlers = [signal.getsignal(n) for n in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)]
    collector = gc.get_threshold()
    with aurora.Session(out='sweep') as session:
        done = session.run(shell.prompt)
    assert capfd.readouterr() == ('', '')
    assert Path.cwd() == here
    assert handlers == [
        signal.getsignal(n) for n in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)
    ]
    assert collector == gc.get_threshold()
    theirs = RunReport.model_validate_json(json.dumps(finished.report))
    assert (done.status, done.clauses) == (theirs.status, theirs.clauses)
    assert done.conditions == theirs.conditions
    assert done.trace == theirs.trace
    assert done.folder.parent == here / 'sweep'
    assert RunReport.model_validate_json((done.folder / 'report.json').read_bytes()) == done.report
    assert done.content is not None
    assert done.trace is not None
    assert done.content.trace.ticks == done.trace.ticks
    assert not done.has_page
    done.write_page(picture=True)
    drawn = (done.folder / 'picture.png').read_bytes()
    assert drawn.startswith(b'\x89PNG')
    assert base64.b64encode(drawn).decode() in (done.folder / 'report.html').read_text()
    assert (
        aurora.verify(done.folder).verdict.results
        == aurora.verify(finished.folder).verdict.results
    )


def test_what_is_asked_for_reaches_the_run(tmp_path: Path, shell: SimpleNamespace) -> None:
    fault = {'kind': 'target_removed', 'subject': 'ego', 'at_s': 3.0}
    done = aurora.run(shell.prompt, out=tmp_path, seed=2, map='junction', faults=[fault])
    assert (done.status, done.report.seed, done.report.map) == ('violated', 2, 'junction')
    assert done.report.faults == (aurora.Fault.model_validate(fault),)


def test_what_cannot_be_is_a_result() -> None:
    refused = 'A drone hovers at 500 meters altitude over the ego car.'
    assert aurora.check(refused).result == 'infeasible'
    assert aurora.parse(refused).agsg is not None
    assert aurora.parse('Make it nice.').question


@pytest.mark.parametrize(
    ('changed', 'kind'),
    [
        ({'prompt': ' '}, PromptError),
        ({'map': 'atlantis'}, MapError),
        ({'seed': -1}, aurora.AuroraError),
        ({'model': 'some-model'}, ConfigError),
        ({'engine': 'gazebo'}, aurora.AuroraError),
        ({'faults': [{'kind': 'meteor'}]}, aurora.AuroraError),
    ],
)
def test_what_cannot_be_used_raises_with_a_hint(
    here: Path, shell: SimpleNamespace, changed: dict[str, object], kind: type[Exception]
) -> None:
    with pytest.raises(kind) as caught:
        aurora.run(**{'prompt': shell.prompt, **changed})
    assert isinstance(caught.value, aurora.AuroraError)
    assert caught.value.hint
    assert list(here.iterdir()) == []


def test_a_bag_that_is_not_there_raises(here: Path) -> None:
    with pytest.raises(BagError):
        aurora.verify(here / 'nothing')


def test_a_run_that_breaks_raises_its_own_error_and_leaves_its_report(
    tmp_path: Path, shell: SimpleNamespace, monkeypatch: pytest.MonkeyPatch
) -> None:
    def broken(*_: object) -> None:
        raise ExecutionError('it broke', hint='mend it', component='somewhere')

    monkeypatch.setattr('aurora_cli.local_engine.LocalStages.execute', broken)
    with pytest.raises(ExecutionError, match='it broke') as caught:
        aurora.run(shell.prompt, out=tmp_path)
    assert (caught.value.hint, caught.value.component) == ('mend it', 'somewhere')
    (folder,) = tmp_path.iterdir()
    assert caught.value.__notes__ == [f'run folder: {folder}']
    assert json.loads((folder / 'report.json').read_text())['status'] == 'error'


def test_ctrl_c_ends_a_sweep_and_a_cancel_only_its_run(
    tmp_path: Path, shell: SimpleNamespace
) -> None:
    def interrupt(stage: str, _share: float, now_s: float) -> None:
        if stage == 'execute' and now_s > 1.0:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        aurora.run(shell.prompt, out=tmp_path, control=aurora.RunControl(progress=interrupt))
    (folder,) = tmp_path.iterdir()
    assert json.loads((folder / 'report.json').read_text())['status'] == 'cancelled'
    done = aurora.run(
        shell.prompt, out=tmp_path, control=aurora.RunControl(cancelled=lambda: True)
    )
    assert done.status == 'cancelled'


def test_the_check_of_the_page(tmp_path: Path) -> None:
    shown = python('-c', NOTEBOOK, cwd=tmp_path)
    assert shown.startswith('infeasible - ')
    assert 'It could be: 120 m' in shown


def test_the_sweep_of_the_page(tmp_path: Path) -> None:
    lines = python('-c', SWEEP, cwd=tmp_path).splitlines()
    assert [line.split()[:2] for line in lines] == [
        [altitude, seed] for altitude in ('20', '40') for seed in ('1', '2')
    ]
    assert {line.split()[2] for line in lines} == {'verified'}
    assert all(Path(line.split()[-1], 'report.json').is_file() for line in lines)


def test_the_pytest_of_the_page(tmp_path: Path, finished: SimpleNamespace) -> None:
    file = tmp_path / 'test_recording.py'
    file.write_text(IN_PYTEST)
    options = ('-q', '-p', 'no:cacheprovider', '-c', os.devnull, str(file))
    shown = python('-m', 'pytest', *options, cwd=tmp_path, RECORDING=str(finished.folder))
    assert f'{len(finished.report["conditions"]) + 1} passed' in shown


_NO_TEXT = 'Input should be a valid string'
_NO_NAME = 'the name of a file or folder is not empty and has no NUL'


@pytest.mark.parametrize(
    ('function', 'arguments', 'said'),
    [
        ('run', {'prompt': None}, f'the argument prompt of run: {_NO_TEXT}'),
        ('parse', {'prompt': b'a drone'}, f'the argument prompt of parse: {_NO_TEXT}'),
        ('check', {'prompt': ['a drone']}, f'the argument prompt of check: {_NO_TEXT}'),
        ('check', {'model': 5}, f'the argument model of check: {_NO_TEXT}'),
        ('run', {'faults': None}, 'the argument faults of run: faults are a list'),
        ('run', {'faults': 'late'}, 'the argument faults of run: faults are a list'),
        ('run', {'out': 5}, f'the argument out of run: {_NO_TEXT}'),
        ('run', {'out': b''}, f'the argument out of run: {_NO_TEXT}'),
        ('run', {'out': ''}, f'the argument out of run: {_NO_NAME}'),
        ('run', {'out': 'a\0b'}, f'the argument out of run: {_NO_NAME}'),
        ('run', {'control': 'x'}, 'the argument control of run: Input should be an instance of'),
        ('run', {'repair': True}, 'the argument repair of run: Input should be a valid integer'),
        ('run', {'engine': 1}, 'the argument engine of run: '),
        ('run', {'sed': 1}, 'the argument sed of run: '),
        ('verify', {'path': ''}, f'the argument path of verify: {_NO_NAME}'),
        ('verify', {'path': '.', 'as_recorded': 'no'}, 'the argument as_recorded of verify: '),
        ('Session', {'out': ''}, f'the argument out of Session: {_NO_NAME}'),
    ],
)
def test_an_argument_of_another_kind_is_named_and_nothing_is_written(
    here: Path,
    capfd: pytest.CaptureFixture[str],
    function: str,
    arguments: dict[str, object],
    said: str,
) -> None:
    prompt = {'prompt': 'A drone hovers.'} if function in ('run', 'check', 'parse') else {}
    with pytest.raises(ConfigError) as caught:
        getattr(aurora, function)(**{**prompt, **arguments})
    assert caught.value.message.startswith(said)
    assert caught.value.hint
    assert capfd.readouterr() == ('', '')
    assert list(here.iterdir()) == []


def test_an_argument_without_its_name_is_named_too() -> None:
    with pytest.raises(ConfigError, match='the argument path of verify'):
        aurora.verify(5)  # type: ignore[arg-type]


def test_a_current_folder_that_was_deleted_is_said_plainly(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capfd: pytest.CaptureFixture[str]
) -> None:
    gone = tmp_path / 'gone'
    gone.mkdir()
    monkeypatch.chdir(gone)
    gone.rmdir()
    prompt = 'A drone hovers over the ego car for 5 seconds.'
    with pytest.raises(aurora.AuroraError, match='the current folder was deleted'):
        aurora.run(prompt)
    assert run_command_line(['run', prompt]) == 4
    told = capfd.readouterr().err
    assert 'the current folder was deleted' in told
    assert 'defect' not in told
