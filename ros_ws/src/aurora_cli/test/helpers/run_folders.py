# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Folders of runs that tests make, copy and alter, and what `aurora verify` says of them."""

from __future__ import annotations

import hashlib
import io
import json
import shutil
from collections.abc import Callable, Iterator
from contextlib import chdir, contextmanager, redirect_stdout
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest

from aurora_cli.commands import verify
from aurora_cli.main import run_command_line
from aurora_core.outcomes.agsg import Agsg
from aurora_core.pipeline import verify_run
from aurora_core.pipeline.knowledge import Knowledge
from aurora_core.pipeline.verification import Judged, judge_content, load_bag
from aurora_core.trace.bag_content import BagContent

Call = Callable[..., SimpleNamespace]


def made(finished: SimpleNamespace, prompt: str, *options: str, status: str = 'verified') -> Path:
    """Run a prompt beside the finished run and return its folder."""
    answer = io.StringIO()
    with chdir(finished.home), redirect_stdout(answer):
        run_command_line(['run', prompt, '--json', *options])
    report = json.loads(answer.getvalue())
    assert report['status'] == status
    folder: Path = finished.home / 'runs' / report['run_id']
    return folder


def copied(here: Path, folder: Path) -> Path:
    """Copy the folder of a run into another place's `runs`."""
    target = here / 'runs' / folder.name
    shutil.copytree(folder, target)
    return target


def edited(path: Path, change: Callable[[dict[str, Any]], Any]) -> None:
    """Change a JSON document in place."""
    document = json.loads(path.read_text())
    change(document)
    path.write_text(json.dumps(document))


@contextmanager
def judged_once() -> Iterator[None]:
    """Have the same bytes of a bag judged once, whatever lies beside them."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(verify, 'load_bag', lambda bag: loaded(bag, bytes_of(bag)))
        patch.setattr(verify_run, 'judge_content', judged)
        yield


def bytes_of(bag: Path) -> str:
    """Return a digest of a bag's name, of what lies in it and of every byte there."""
    files = sorted(path for path in (bag.rglob('*') if bag.is_dir() else (bag,)) if path.is_file())
    named = (f'{path.relative_to(bag.parent)}\0'.encode() + path.read_bytes() for path in files)
    return hashlib.sha256(b'\0'.join(hashlib.sha256(data).digest() for data in named)).hexdigest()


READ: dict[str, tuple[BagContent, Agsg]] = {}
JUDGED: dict[int, Judged] = {}


def loaded(bag: Path, digest: str) -> tuple[BagContent, Agsg]:
    """Read a bag, the same bytes once."""
    if digest not in READ:
        READ[digest] = load_bag(bag)
    return READ[digest]


def judged(known: Knowledge, content: BagContent, agsg: Agsg, *, as_recorded: bool) -> Judged:
    """Judge what was read, once."""
    assert not as_recorded
    if id(content) not in JUDGED:
        JUDGED[id(content)] = judge_content(known, content, agsg)
    return JUDGED[id(content)]


def first_answer(function: Callable[..., Any]) -> Callable[..., Any]:
    """Return a function that answers always what it answered first."""
    answers: list[Any] = []

    def answer(*arguments: object, **options: object) -> Any:
        if not answers:
            answers.append(function(*arguments, **options))
        return answers[0]

    return answer


def said(call: Call, *arguments: str) -> SimpleNamespace:
    """What is said about a bag: code and heading are held to belong together, in text and JSON."""
    with judged_once(), pytest.MonkeyPatch.context() as patch:
        patch.setattr(verify, 'verify_found', first_answer(verify_run.verify_found))
        plain = call('verify', *arguments)
        document = json.loads(call('verify', *arguments, '--json').out)
    first = plain.out.splitlines()[0]
    heading = first.partition('  ')[0]
    codes = {'VERIFIED': 0, 'MARGINS HOLD': 0, 'VIOLATED': 1, 'INCONCLUSIVE': 4}
    assert codes[heading.removeprefix('AS RECORDED: ')] == plain.code, first
    assert document['summary'] in first
    outcome = document['outcome'].replace('_', ' ').upper()
    assert outcome == heading or heading.startswith('AS RECORDED: ')
    verdict = document['verdict']
    if plain.code == 4:
        assert verdict['status'] == 'inconclusive' or not document['recorded']['equal']
    return SimpleNamespace(
        code=plain.code,
        first=first,
        text=plain.out,
        integrity=verdict['integrity'],
        doubts=[d['text'] for d in (document['run'] or {'doubts': ()})['doubts']],
    )
