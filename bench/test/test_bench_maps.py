# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The campaign over maps: a file all the way by commands, and answers that refuse nothing."""

from __future__ import annotations

import gzip
from pathlib import Path

import pytest

from aurora_bench.maps import journeys
from aurora_bench.maps.__main__ import PROMPT, goals_of
from aurora_bench.maps.calls import Called
from aurora_bench.maps.hostile import CLASSES
from aurora_bench.maps.journeys import Journey, journey
from aurora_cli.commands.map_import import import_command
from aurora_cli.output import UsageProblem
from aurora_core.errors import AuroraError
from aurora_core.knowledge.config_files import config_path


def _called(code: int, out: str = '', err: str = '') -> Called:
    return Called(code=code, out=out, err=err, seconds=1.0, peak_mib=100.0)


def test_a_network_goes_all_the_way_by_commands(tmp_path: Path) -> None:
    file = tmp_path / 'crossing.net.xml'
    file.write_bytes(gzip.decompress(config_path('maps', 'junction', 'net.xml.gz').read_bytes()))
    done = journey(file, 1, PROMPT, tmp_path)
    assert done.is_whole, done
    assert list(done.seconds) == ['import', 'measure', 'check', 'run', 'verify']
    assert all(seconds > 0.0 for seconds in done.seconds.values())
    assert done.stands[0] == done.stands[1] > 100
    assert done.facts['kind'] == 'SUMO network'
    assert done.trace
    assert done.peak_mib > 50.0


def test_a_file_that_is_none_ends_with_what_the_import_said(tmp_path: Path) -> None:
    file = tmp_path / 'empty.osm'
    file.write_bytes(b'')
    done = journey(file, 1, PROMPT, tmp_path)
    assert not done.is_whole
    assert done.problem.startswith('import: map: ')
    assert 'is empty' in done.problem
    assert list(done.seconds) == ['import']


@pytest.mark.parametrize(
    ('called', 'problem'),
    [
        (_called(4, err='error: it is empty\n'), ''),
        (_called(0, out='x: 1 km\n'), 'exit code 0'),
        (_called(4, err='Traceback (most recent call last):\n'), 'not one clear line'),
        (_called(4, err='a\nb\nc\nd\n'), 'not one clear line'),
        (_called(1, err='this is a defect of AURORA\n'), 'called a defect'),
    ],
)
def test_what_is_no_clear_refusal_is_a_problem(
    called: Called, problem: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(journeys, 'call', lambda *_: called)
    monkeypatch.setattr(journeys, 'CLASSES', {'empty': ('e.osm', lambda path: path.touch())})
    monkeypatch.setattr(journeys, 'NAMES', ())
    (found,) = journeys.refusals(tmp_path, lambda _: None)
    assert (problem in found.problem) if problem else found.problem == ''


def test_something_left_behind_is_a_problem(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def leaves(*_: object) -> Called:
        (tmp_path / 'maps').mkdir()
        (tmp_path / 'maps' / '.importing-x').mkdir()
        return _called(4, err='error: it is empty\n')

    monkeypatch.setattr(journeys, 'call', leaves)
    monkeypatch.setattr(journeys, 'CLASSES', {'empty': ('e.osm', lambda path: path.touch())})
    monkeypatch.setattr(journeys, 'NAMES', ())
    (found,) = journeys.refusals(tmp_path, lambda _: None)
    assert 'left behind' in found.problem
    whole, clear, bounded = goals_of([Journey(file='x')], [found])
    assert (whole.met, clear.met, bounded.met) == (False, False, True)


@pytest.mark.parametrize('kind', CLASSES)
def test_every_class_of_bad_file_is_refused_and_leaves_nothing(
    kind: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    maps = tmp_path / 'maps'
    monkeypatch.setenv('AURORA_MAPS', str(maps))
    name, make = CLASSES[kind]
    make(tmp_path / name)
    with pytest.raises((AuroraError, UsageProblem)) as caught:
        import_command(tmp_path / name, 'x', measured=False)
    said = str(caught.value)
    assert '\n' not in said.split('; hint')[0].strip()
    assert name in said
    assert not maps.exists() or not list(maps.iterdir())
