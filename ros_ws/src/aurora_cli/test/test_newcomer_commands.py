# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What helps a newcomer: version, examples, a prompt asked for in pieces, the page of a run."""

from __future__ import annotations

import io
import itertools
import json
import os
import shutil
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from types import SimpleNamespace

import pytest
import yaml

import aurora
from aurora_cli.commands.examples import installed_examples
from aurora_cli.commands.new import BODIES, MISSIONS, NONE, OTHERS, PLACES, WEATHERS, Pieces
from aurora_core.report.status import Status
from aurora_core.report.versions import AURORA_VERSION

Call = Callable[..., SimpleNamespace]
EXAMPLES = installed_examples()
# What the page of the vocabulary shows.
_VOCABULARY = Path(__file__).resolve().parents[4] / 'docs' / 'vocabulary.yaml'
PICTURED = [
    p for group in yaml.safe_load(_VOCABULARY.read_text()).values() for p in group.values()
]


def test_the_version_names_what_decides_results(call: Call) -> None:
    done = call('--version')
    assert done.code == 0
    assert done.out.startswith(f'aurora {AURORA_VERSION} (python ')
    assert 'libsumo' in done.out


def test_a_shell_completes_commands_and_options() -> None:
    script = 'from aurora_cli.main import app; app(prog_name="aurora")'
    for words, expected in (('aurora exa', 'examples'), ('aurora run --see', '--seeds')):
        done = subprocess.run(
            [sys.executable, '-c', script],
            env={
                **os.environ,
                '_AURORA_COMPLETE': 'complete_bash',
                'COMP_WORDS': words,
                'COMP_CWORD': str(words.count(' ')),
            },
            capture_output=True,
            text=True,
            timeout=60,
            check=False,
        )
        assert expected in done.stdout.split(), done.stderr


def test_examples_are_listed_by_category_and_one_goes_into_a_pipe(call: Call) -> None:
    rows = json.loads(call('examples', '--json').out)['examples']
    assert [(row['category'], row['prompt']) for row in rows] == EXAMPLES
    assert len(rows) >= 20
    assert call('examples', '3').out == f'{EXAMPLES[2][1]}\n'
    patrols = call('examples', '--category', 'patrol').out
    assert patrols.count('\n') == 1 + sum(name == 'patrol' for name, _ in EXAMPLES)
    for wrong in (('0',), ('99',), ('--category', 'chess')):
        done = call('examples', *wrong)
        assert done.code == 64
        assert 'there are' in done.err


@pytest.mark.parametrize('prompt', dict.fromkeys([*(p for _, p in EXAMPLES), *PICTURED]))
def test_every_example_is_verified(prompt: str, tmp_path: Path) -> None:
    run = aurora.run(prompt, out=tmp_path)
    assert run.status is Status.VERIFIED, run.report.summary


def _pieces(*chosen: str) -> Pieces:
    mission, body, other, place, alert, weather = chosen
    return Pieces(
        mission=mission,
        body=body,
        altitude_m=40.0,
        distance_m=None if mission == 'hover over' else 30.0,
        duration_s=30.0,
        other=other,
        place=place,
        gap_m=30.0,
        alert_m=20.0 if alert == 'yes' and other != NONE else None,
        weather=weather,
    )


def test_what_is_asked_in_pieces_is_read_whole() -> None:
    every = itertools.product(MISSIONS, BODIES, (NONE, *OTHERS), PLACES, ('no', 'yes'), WEATHERS)
    # Every 13th: the numbers of choices have no factor in common with it.
    some = [row for row in itertools.islice(every, 0, None, 13) if row[1] != row[2]]
    some = [row for row in some if row[0] != 'patrol' or row[2] == NONE]
    some = [row for row in some if row[1] != 'pedestrian' or row[2] == NONE]
    assert {value for row in some for value in row} >= {*MISSIONS, *BODIES, *OTHERS, *WEATHERS}
    for row in some:
        outcome = aurora.parse(_pieces(*row).prompt())
        assert outcome.agsg is not None, row
        assert not [c.text for c in outcome.clauses if c.status.is_open], _pieces(*row).prompt()


def test_new_asks_and_writes_a_prompt_that_can_be(
    call: Call, here: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    answers = ['follow', 'boat', 'ego car', '400', '45', '', '20', 'van', '1', '40', 'yes', '', '']
    monkeypatch.setattr(sys, 'stdin', io.StringIO('\n'.join([*answers, ''])))
    done = call('new', '-o', 'prompt.txt')
    assert done.code == 0, done.err
    assert done.out == (
        'A van drives 40 m behind the ego car. A drone follows the ego car at 45 m altitude, '
        'keeping a distance of 30 m, for 20 seconds. When the van comes within 27 m of the ego '
        'car, the drone alerts the ego car.\n'
    )
    assert (here / 'prompt.txt').read_text() == done.out
    assert 'expected one of ego car' in done.err
    assert 'expected a number from 10 to 120' in done.err


def test_new_without_answers_says_so(call: Call, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sys, 'stdin', io.StringIO('circle\n'))
    done = call('new')
    assert (done.code, done.out) == (64, '')
    assert 'the answers ended' in done.err


def test_open_finds_the_last_run_and_makes_its_page(
    here: Path, call: Call, finished: SimpleNamespace, monkeypatch: pytest.MonkeyPatch
) -> None:
    for name in ('DISPLAY', 'WAYLAND_DISPLAY', 'BROWSER'):
        monkeypatch.delenv(name, raising=False)
    done = call('open')
    assert done.code == 64
    assert 'there is no run' in done.err
    copy = here / 'runs' / finished.folder.name
    shutil.copytree(finished.folder, copy)
    (copy / 'report.html').unlink()
    done = call('open')
    assert (done.code, done.out) == (0, f'{(copy / "report.html").as_uri()}\n')
    assert (copy / 'report.html').read_text().startswith('<!')
    assert (copy / 'picture.png').read_bytes().startswith(b'\x89PNG')
    shown = json.loads(call('open', finished.folder.name, '--json').out)
    assert shown['run'] == finished.folder.name
    assert call('open', 'nothing').code == 64
    # Of a run whose bag is gone there is nothing to draw: its page stays.
    (copy / 'picture.png').unlink()
    shutil.rmtree(copy / 'bag.0')
    before = (copy / 'report.html').read_bytes()
    assert call('open').code == 0
    assert (copy / 'report.html').read_bytes() == before
    assert not (copy / 'picture.png').exists()


def test_open_starts_a_browser_where_there_is_a_screen(
    here: Path, call: Call, finished: SimpleNamespace, monkeypatch: pytest.MonkeyPatch
) -> None:
    opened: list[str] = []
    monkeypatch.setenv('DISPLAY', ':0')
    monkeypatch.setattr('webbrowser.open', opened.append)
    copy = here / 'copy'
    shutil.copytree(finished.folder, copy)
    assert call('open', str(copy)).code == 0
    assert opened == [(copy / 'report.html').as_uri()]


def test_a_run_without_a_report_cannot_be_opened(here: Path, call: Call) -> None:
    (here / 'runs' / '20260131T120000Z-0a1b2c').mkdir(parents=True)
    done = call('open', '20260131T120000Z-0a1b2c')
    assert done.code == 4
    assert 'report.json is missing' in done.err
