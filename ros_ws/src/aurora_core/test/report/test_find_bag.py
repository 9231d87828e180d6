# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Which bag is meant, and whether it lies in a run folder, however it is called."""

from __future__ import annotations

from pathlib import Path

import pytest

from aurora_core.errors import BagError
from aurora_core.report.find_bag import find_bag

RUN_ID = '20260131T120000Z-0a1b2c'


def bag(folder: Path) -> Path:
    folder.mkdir(parents=True)
    (folder / 'x.mcap').write_bytes(b'')
    return folder


@pytest.fixture
def run(tmp_path: Path) -> Path:
    """What is left of a run folder: its name and bags."""
    folder = tmp_path / RUN_ID
    bag(folder / 'bag.0')
    return folder


def test_the_last_bag_of_a_run_is_meant(run: Path) -> None:
    bag(run / 'bag.2')
    bag(run / 'bag.10')
    found = find_bag(str(run), None)
    assert (found.bag, found.run, found.iteration) == (run / 'bag.10', run, 10)
    assert find_bag(str(run), 2).iteration == 2
    with pytest.raises(BagError, match='it has 0, 2, 10'):
        find_bag(str(run), 1)


@pytest.mark.parametrize('name', ['.', '../bag.0', 'x.mcap', './x.mcap', '../../*/bag.0/x.mcap'])
def test_a_bag_is_that_of_its_run_however_it_is_called(
    run: Path, monkeypatch: pytest.MonkeyPatch, name: str
) -> None:
    monkeypatch.chdir(run / 'bag.0')
    found = find_bag(name.replace('*', RUN_ID), None)
    assert (found.run, found.iteration) == (run, 0)


@pytest.mark.parametrize('name', ['bag.01', 'bag.00', 'BAG.0', 'bag.٣', f'bag.{"9" * 5000}'[:200]])
def test_a_name_that_no_bag_of_a_run_has_is_no_iteration(run: Path, name: str) -> None:
    found = find_bag(str(bag(run / name)), None)
    assert (found.run, found.iteration) == (run, None)
    assert find_bag(str(run), None).iteration == 0


@pytest.mark.parametrize('left', ['manifest.json', 'prompt.txt', 'report.json', 'agsg.0.json'])
def test_what_is_left_of_a_renamed_run_makes_it_one(tmp_path: Path, left: str) -> None:
    folder = tmp_path / 'kept'
    bag(folder / 'bag.0')
    assert find_bag(str(folder / 'bag.0'), None).run is None
    (folder / left).write_text('')
    assert find_bag(str(folder / 'bag.0'), None).run == folder


def test_another_name_is_answered_with_the_last_runs(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    with pytest.raises(BagError, match='there is no run in runs/ here'):
        find_bag('typo', None)
    ids = [f'2026013{day}T120000Z-0a1b2c' for day in (0, 1)]
    for name in (*ids, 'notes'):
        (tmp_path / 'runs' / name).mkdir(parents=True)
    with pytest.raises(BagError, match=f'the last in runs/: {ids[1]}, {ids[0]}$'):
        find_bag('typo', None)
