# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import json
import shutil
from collections.abc import Callable
from pathlib import Path
from types import SimpleNamespace

import pytest

Call = Callable[..., SimpleNamespace]


@pytest.fixture
def cut(here: Path, finished: SimpleNamespace) -> Path:
    """The run as a kill of its recorder would have left it."""
    folder: Path = here / 'runs' / finished.folder.name
    shutil.copytree(finished.folder, folder)
    (folder / 'bag.0' / 'metadata.yaml').unlink()
    file = folder / 'bag.0' / 'bag.0_0.mcap'
    file.write_bytes(file.read_bytes()[: file.stat().st_size * 2 // 3])
    return folder


def test_a_run_that_was_cut_is_recovered_beside_its_bag(cut: Path, call: Call) -> None:
    done = call('bag', 'recover', cut.name, '--json')
    report = json.loads(done.out)
    assert done.code == 0
    assert (report['outcome'], report['integrity']) == ('recovered', 'truncated')
    assert report['complete_s'] > 20.0
    assert Path(report['bag']).name == 'bag.0.recovered'
    verdict = json.loads(call('verify', report['bag'], '--json').out)['verdict']
    assert verdict['status'] == 'inconclusive'
    assert any(row['margin'] is not None for row in verdict['results'])
    again = call('bag', 'recover', str(cut / 'bag.0'))
    assert again.code == 0
    assert again.out.startswith('RECOVERED ALREADY')
    # The run still means its own bag.
    assert json.loads(call('verify', str(cut), '--json').out)['bag'].endswith('bag.0')


def test_the_folder_can_be_chosen(cut: Path, here: Path, call: Call) -> None:
    done = call('bag', 'recover', str(cut / 'bag.0' / 'bag.0_0.mcap'), '--out', 'mine')
    assert done.code == 0
    assert 'complete up to tick' in done.out
    assert (here / 'mine' / 'metadata.yaml').is_file()
    (here / 'full').mkdir()
    assert call('bag', 'recover', str(cut), '--out', 'full').code == 4


def test_what_cannot_be_recovered(here: Path, call: Call) -> None:
    (here / 'b').mkdir()
    (here / 'b' / 'b_0.mcap').write_bytes(b'')
    done = call('bag', 'recover', 'b', '--json')
    assert done.code == 4
    assert 'the file is empty' in json.loads(done.out)['error']['message']
    assert call('bag', 'recover', 'nothing').code == 64
    assert sorted(path.name for path in here.iterdir()) == ['b']
