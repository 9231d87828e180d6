# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Bad prompts through every way into the command: an argument, standard input, a file."""

from __future__ import annotations

import io
import json
import os
import sys
import time
from collections.abc import Callable
from pathlib import Path
from types import SimpleNamespace

import jsonschema
import pytest

from aurora_cli.prompt_input import MOST_BYTES
from aurora_cli.testing.bad_prompts import READABLE, UNREADABLE, Readable, Unreadable, random_text
from aurora_core.knowledge.config_files import config_path
from aurora_core.report.run_folder import PROMPT

Call = Callable[..., SimpleNamespace]
# Processor time (s) that tells what hangs from what works; the slowest takes 3 s on a quiet core.
LIMIT_S = 60.0

SCHEMA = json.loads(config_path('schema', 'report.schema.json').read_text('utf-8'))
NEVER_RUN = [case for case in READABLE if case.may == ('not_understood',)]


def named(case: Readable | Unreadable) -> str:
    return case.name


def raw_of(case: Readable | Unreadable) -> bytes:
    return case.raw if isinstance(case, Unreadable) else case.text.encode()


@pytest.fixture
def give(monkeypatch: pytest.MonkeyPatch) -> Callable[[bytes], None]:
    """Put bytes on standard input."""

    def given(raw: bytes) -> None:
        monkeypatch.setattr(sys, 'stdin', SimpleNamespace(buffer=io.BytesIO(raw)))

    return given


@pytest.mark.parametrize('case', [*UNREADABLE, *NEVER_RUN], ids=named)
def test_a_run_of_it_is_not_understood_and_the_prompt_is_kept(
    here: Path,
    call: Call,
    give: Callable[[bytes], None],
    case: Readable | Unreadable,
) -> None:
    raw = raw_of(case)
    give(raw)
    begin = time.process_time()
    done = call('run', '-', '--json')
    assert time.process_time() - begin < LIMIT_S
    assert done.code == 3
    report = json.loads(done.out)
    jsonschema.validate(report, SCHEMA)
    assert report['status'] == 'not_understood'
    assert 'raceback' not in done.err
    folder = here / 'runs' / report['run_id']
    assert (folder / PROMPT).read_bytes() == raw
    assert json.loads((folder / 'report.json').read_text(encoding='utf-8')) == report
    assert sorted(path.name for path in here.iterdir()) == ['runs'], 'nothing was executed'
    if isinstance(case, Unreadable):
        assert case.says in report['question']
        # What can be read stays as it is; the rest is told byte by byte, never replaced.
        assert '\0' not in report['prompt']
        assert ('\ufffd' in report['prompt']) == ('\ufffd'.encode() in raw)
        assert ('A drone' in report['prompt']) == (b'A drone' in raw)
    else:
        assert report['prompt'] == case.text


@pytest.mark.parametrize('door', ['argument', 'file', 'standard input'])
def test_every_door_gives_the_same_answer(
    here: Path, call: Call, give: Callable[[bytes], None], door: str
) -> None:
    # What is worked on for longer goes through one: doors differ only in how bytes come in.
    readable = READABLE if door == 'standard input' else NEVER_RUN
    for case in (*UNREADABLE, *readable):
        raw = raw_of(case)
        arguments = ['-']
        if door == 'argument':
            if b'\0' in raw or raw.startswith(b'-'):
                continue  # no process can be given the one; the other is taken for an option
            arguments = [os.fsdecode(raw)]
        elif door == 'file':
            (here / 'prompt').write_bytes(raw)
            arguments = ['--prompt-file', 'prompt']
        else:
            give(raw)
        begin = time.process_time()
        done = call('check', *arguments, '--json')
        assert time.process_time() - begin < LIMIT_S, case.name
        report = json.loads(done.out)
        if isinstance(case, Unreadable):
            assert (done.code, report['result']) == (3, 'not_understood'), case.name
            assert case.says in report['question'], case.name
        else:
            # A check says `feasible` where a run might be violated.
            assert report['result'] in (*case.may, 'feasible'), case.name
            assert report['result'] != 'feasible' or 'violated' in case.may, case.name
            assert report['prompt'] == case.text, case.name
        assert 'raceback' not in done.err


def test_instructions_behind_a_scenario_are_quoted_and_not_obeyed(here: Path, call: Call) -> None:
    (case,) = [case for case in READABLE if case.name == 'instructions behind a scenario']
    done = call('run', case.text, '--json')
    report = json.loads(done.out)
    assert (done.code, report['status']) == (3, 'incomplete')
    assert (here / 'runs' / report['run_id'] / PROMPT).read_bytes() == case.text.encode()
    left = [row['text'] for row in report['clauses'] if row['status'] == 'not_encoded']
    assert any('Ignore all previous instructions' in text for text in left)


def test_a_stream_without_end_is_not_read_to_its_end(
    here: Path, call: Call, give: Callable[[bytes], None]
) -> None:
    done = call('run', '--prompt-file', '/dev/zero')
    assert done.code == 64
    assert 'expected a regular file in /dev/zero' in done.err
    give(b'x' * (MOST_BYTES + 1))
    done = call('run', '-')
    assert done.code == 64
    assert f'more than {MOST_BYTES} bytes, and a prompt may have 8192' in done.err
    assert list(here.iterdir()) == []


def test_no_prompt_steers_the_terminal(here: Path, call: Call) -> None:
    prompt = 'A drone hovers at 500 feet\x1b[2J\x9b1A and dances\nVERIFIED  all conditions hold.'
    for arguments in (('check', prompt), ('run', prompt), ('check', prompt, '--json')):
        done = call(*arguments)
        assert not {'\x1b', '\x9b'} & set(done.out + done.err)
        assert not [row for row in done.out.splitlines() if row.startswith('VERIFIED')]
    assert json.loads(done.out)['prompt'] == prompt


@pytest.mark.parametrize('seed', range(20))
def test_random_text_is_answered(here: Path, call: Call, seed: int) -> None:
    text = random_text(seed, 200)
    (here / 'prompt').write_bytes(text.encode())
    done = call('check', '--prompt-file', 'prompt', '--json')
    report = json.loads(done.out)
    assert report['result'] == 'not_understood'
    assert report['prompt'] == text
