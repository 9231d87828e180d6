# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Campaigns of the rulers: same results however they are run, and nothing finished is lost."""

from __future__ import annotations

import argparse
import json
import multiprocessing
import os
import signal
from collections.abc import Iterator, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
from ruler_work import CheapWork, contradicts_missions

from aurora_bench.outcome.__main__ import OUTCOME
from aurora_bench.progress import Progress
from aurora_bench.realise.__main__ import REALISE
from aurora_bench.rulers.checking import Check
from aurora_bench.rulers.command import Ruler, measure
from aurora_bench.rulers.runs import RunWork
from aurora_bench.rulers.trial import JudgedTrial, Trial
from aurora_cli.main import run_command_line
from aurora_cli.pool import Lost, Work

Doc = dict[str, Any]
PROMPTS = {
    'hover-901': 'A drone hovers.',
    'hover-902': 'A drone fails.',
    'hover-903': 'A drone lies.',
    'hover-904': 'A drone kills its worker.',
    'hover-905': 'Another drone hovers.',
}
LAST = 'realised 2 of 5 feasible  0.400 [0.118, 0.769]  silent failures 1  unchecked 3 of 7'


@pytest.fixture
def cheap() -> Ruler:
    """Return the ruler `realise` without runs."""
    return replace(REALISE, work=lambda _options, folder: CheapWork(folder=folder))


class _Died(Exception):  # noqa: N818  (what a worker's end is to the test)
    """A worker would have ended."""


@pytest.fixture
def here(monkeypatch: pytest.MonkeyPatch) -> None:
    """Start no worker: what is asked is about journal and output, whoever does the work."""

    def end(code: int) -> None:
        raise _Died(f'its worker died with exit code {code}')

    def in_turn(
        work: Work[Trial, JudgedTrial], trials: Sequence[Trial], **_: object
    ) -> Iterator[tuple[int, JudgedTrial | Lost]]:
        work.prepare()
        for index, one in enumerate(trials):
            try:
                yield index, work(one)
            except _Died as died:
                yield index, Lost(why=str(died))

    monkeypatch.setattr(os, '_exit', end)
    monkeypatch.setattr('aurora_bench.rulers.trial.run_tasks', in_turn)


@pytest.fixture
def file(tmp_path: Path) -> Path:
    """Return a prompt file; one prompt of it is to be refused."""
    documents = [
        {
            'id': ident, 'category': 'hover', 'prompt': text, 'feasibility': 'feasible',
            'paraphrase_group': None, 'end_to_end': True,
            'requirements': [{'id': 'r1', 'kind': 'uav', 'ref': 'uav1'}],
        }
        for ident, text in PROMPTS.items()
    ]  # fmt: skip
    refused = {
        **documents[0], 'id': 'infeasible-901', 'category': 'infeasible', 'prompt': 'A cow flies.',
        'feasibility': 'infeasible',
        'requirements': [{'id': 'r1', 'kind': 'reject', 'because': 'unsupported'}],
    }  # fmt: skip
    path = tmp_path / 'mine' / 'own.jsonl'
    path.parent.mkdir()
    path.write_text(''.join(json.dumps(d) + '\n' for d in (*documents, refused)))
    return path


def results(folder: Path) -> Doc:
    """Return the JSON of a campaign without what depends on clock, machine and workers."""
    document: Doc = json.loads((folder / 'realise.json').read_text())
    for trial in document['trials']:
        trial.pop('seconds')
        trial['words'] = [w.partition(' died')[2] or w for w in trial['words']]
        trial['summary'] = trial['summary'].partition(' died')[2]
    for name in ('machine', 'wall_s', 'jobs', 'seconds_mean'):
        document.pop(name)
    return document


def test_the_last_line_and_the_causes_count_every_trial(
    cheap: Ruler, file: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert measure(cheap, [str(file), '--results', str(tmp_path / 'res')]) == 0
    printed = capsys.readouterr()
    *_, repaired, about_file, last = printed.out.splitlines()
    assert last == LAST
    assert repaired == 'realised 2 of 5 without repair, 0 more by it (of 0 tried)'
    assert about_file.startswith('mine/own.jsonl  sha256 ')
    assert '[5/5]' in printed.err
    found = results(tmp_path / 'res')
    causes = {cause: n for cause, n in found['by_cause'].items() if n}
    assert causes == {'condition': 1, 'contradicted': 1, 'error': 1}
    lost = next(t for t in found['trials'] if t['id'] == 'hover-904')
    assert (lost['status'], lost['words']) == ('lost', [' with exit code 9'])
    assert last in (tmp_path / 'res' / 'realise.md').read_text()


def test_jobs_and_order_change_nothing(cheap: Ruler, file: Path, tmp_path: Path) -> None:
    seeds = ['--seeds', '3,1,2']
    for jobs in ('1', '3'):
        place = str(tmp_path / jobs)
        assert measure(cheap, [str(file), *seeds, '--jobs', jobs, '--results', place]) == 0
    assert results(tmp_path / '1') == results(tmp_path / '3')
    keys = [(t['id'], t['seed']) for t in results(tmp_path / '3')['trials']]
    assert keys == [(ident, seed) for ident in PROMPTS for seed in (3, 1, 2)]


def test_ctrl_c_keeps_what_is_finished_and_resume_does_the_rest(
    cheap: Ruler,
    file: Path,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    whole, parts = tmp_path / 'whole', tmp_path / 'parts'
    assert measure(cheap, [str(file), '--results', str(whole)]) == 0
    step = Progress.step

    def step_and_interrupt(self: Progress, text: str) -> None:
        step(self, text)
        if 'hover-902' in text:
            os.kill(os.getpid(), signal.SIGINT)

    temporary = tmp_path / 'temporary'
    temporary.mkdir()
    with monkeypatch.context() as patch:
        patch.setattr('tempfile.tempdir', str(temporary))
        patch.setattr(Progress, 'step', step_and_interrupt)
        # Ignored where the tests run in the background.
        before = signal.signal(signal.SIGINT, signal.default_int_handler)
        assert measure(cheap, [str(file), '--results', str(parts)]) == 130
        signal.signal(signal.SIGINT, before)
    assert not multiprocessing.active_children()
    assert list(temporary.iterdir()) == []
    assert not (parts / 'realise.json').exists()
    assert measure(cheap, [str(file), '--results', str(parts)]) == 64  # it would be lost
    capsys.readouterr()
    again = [str(file), '--results', str(parts), '--resume', str(parts)]
    assert measure(cheap, again) == 0
    printed = capsys.readouterr()
    assert printed.err.count('(from the journal)') == 2
    assert printed.out.splitlines()[-1] == LAST
    assert results(parts) == results(whole)


@pytest.mark.usefixtures('here')
def test_a_changed_file_is_not_resumed(
    cheap: Ruler, file: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    journal = tmp_path / 'own.journal.jsonl'
    begin = [str(file), '--only', 'hover-901', '--resume', str(journal)]
    assert measure(cheap, begin) == 0
    file.write_text(file.read_text().replace('Another', 'Yet another'))
    assert measure(cheap, begin) == 64
    assert 'is of another campaign: its files is mine/own.jsonl' in capsys.readouterr().err


@pytest.mark.usefixtures('here')
def test_totals_show_no_prompt(
    cheap: Ruler, file: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert measure(cheap, [str(file), '--totals', '--results', str(tmp_path / 'res')]) == 0
    printed = capsys.readouterr()
    shown = printed.out + printed.err
    shown += (tmp_path / 'res' / 'realise.json').read_text()
    shown += (tmp_path / 'res' / 'realise.md').read_text()
    assert LAST in shown
    assert not [ident for ident in PROMPTS if ident in shown]


@pytest.mark.usefixtures('here')
def test_json_is_one_document(
    cheap: Ruler, file: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert measure(cheap, [str(file), '--json']) == 0
    document = json.loads(capsys.readouterr().out)
    assert document['last_line'] == LAST
    assert [f['beyond'] for f in document['files']] == [0]


def test_what_a_campaign_leaves_is_kept_only_where_it_is_wanted(
    cheap: Ruler, file: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    temporary, kept = tmp_path / 'temporary', tmp_path / 'kept'
    temporary.mkdir()
    monkeypatch.setattr('tempfile.tempdir', str(temporary))
    assert measure(cheap, [str(file)]) == 0
    assert list(temporary.iterdir()) == []
    assert measure(cheap, [str(file), '--keep', str(kept), '--only', 'hover-901']) == 0
    assert (kept / 'own' / 'hover-901-1').is_dir()


@pytest.mark.parametrize(
    'wrong',
    [['--jobs', '0'], ['--limit-s', '0'], ['--map', 'nowhere'], ['/no/such/file.jsonl']],
)
def test_what_cannot_be_measured_is_a_usage_error(
    cheap: Ruler, file: Path, wrong: list[str]
) -> None:
    assert measure(cheap, [str(file), *wrong]) == 64


@pytest.mark.parametrize('command', ['realise', 'outcome'])
def test_the_command_line_knows_the_rulers(
    command: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run_command_line(['bench', command, '--help']) == 0
    assert f'usage: aurora bench {command}' in capsys.readouterr().out
    assert run_command_line(['bench', command, 'x.jsonl', '--seeds', '2147483648']) == 64
    assert 'from 0 to 2147483647' in capsys.readouterr().err


@pytest.mark.timeout(300)
def test_real_runs_are_judged_by_monitor_and_checker(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    hover: Doc = {
        'id': 'hover-901', 'category': 'hover', 'feasibility': 'feasible',
        'prompt': 'A drone hovers over City Hall at 60 m for 5 seconds.',
        'paraphrase_group': None, 'end_to_end': True, 'requirements': [
            {'id': 'r1', 'kind': 'uav', 'ref': 'uav1'},
            {
                'id': 'r2', 'kind': 'mission', 'ref': 'm1', 'uav': 'uav1', 'mode': 'hover',
                'target': 'City Hall', 'altitude_m': 60, 'duration_s': 5,
            },
            {'id': 'r3', 'kind': 'beyond', 'text': 'quietly'},
        ],
    }  # fmt: skip
    refused: Doc = {
        **hover, 'id': 'infeasible-901', 'category': 'infeasible', 'feasibility': 'infeasible',
        'prompt': 'A drone hovers over City Hall at 500 m.',
        'requirements': [{'id': 'r1', 'kind': 'reject', 'because': 'altitude_limit'}],
    }  # fmt: skip
    path = tmp_path / 'own.jsonl'
    path.write_text(json.dumps(hover) + '\n' + json.dumps(refused) + '\n')

    def last(ruler: Ruler, check: Check) -> str:
        def make(options: argparse.Namespace, folder: Path) -> RunWork:
            work = ruler.work(options, folder)
            assert isinstance(work, RunWork)
            return replace(work, check=check)

        assert measure(replace(ruler, work=make), [str(path)]) == 0
        return capsys.readouterr().out.splitlines()[-1]

    against = last(REALISE, contradicts_missions)
    assert against.startswith('realised 0 of 1 feasible  ')
    assert against.endswith('  silent failures 1  unchecked 0 of 2')
    against = last(OUTCOME, contradicts_missions)
    assert against.startswith('right outcome 1 of 2  0.500 ')  # the refusal is right
    assert against.endswith('  silent failures 1  unchecked 0 of 2')
