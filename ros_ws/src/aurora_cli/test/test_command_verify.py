# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import json
import shutil
from collections.abc import Callable
from pathlib import Path
from types import SimpleNamespace

import pytest

from aurora_core.outcomes.verdict import VerdictStatus
from aurora_core.pipeline.knowledge import installed_knowledge
from aurora_core.pipeline.verification import load_bag, verify_content
from aurora_core.trace.bag_content import BagContent
from aurora_core.trace.bag_reader import read_bag
from aurora_core.trace.definitions import message_definitions

Call = Callable[..., SimpleNamespace]


@pytest.fixture
def copy(here: Path, finished: SimpleNamespace) -> Path:
    folder: Path = here / 'runs' / finished.folder.name
    shutil.copytree(finished.folder, folder)
    return folder


def test_margins_are_those_of_the_run_to_the_last_bit(
    copy: Path, finished: SimpleNamespace, call: Call
) -> None:
    done = call('verify', copy.name, '--json')
    report = json.loads(done.out)
    assert done.code == 0
    assert report['recorded']['equal'] is True
    assert report['trace_sha256'] == finished.report['trace']['sha256']
    ours = {row['id']: row['margin'] for row in report['verdict']['results']}
    assert ours == {row['id']: row['margin'] for row in finished.report['conditions']}


def test_a_bag_alone_is_enough(copy: Path, here: Path, call: Call) -> None:
    (copy / 'bag.0').rename(here / 'alone')
    done = call('verify', 'alone')
    assert done.code == 0
    assert 'verified by itself' in done.out


def test_a_record_that_was_changed_is_found(copy: Path, call: Call) -> None:
    path = copy / 'verdict.0.json'
    verdict = json.loads(path.read_text())
    verdict['results'][0]['margin'] += 1e-12
    path.write_text(json.dumps(verdict))
    done = call('verify', str(copy))
    assert done.code == 4
    assert 'DIFFERS' in done.out
    assert verdict['results'][0]['id'] in done.out


def test_a_bag_that_was_cut_short_never_passes(copy: Path, call: Call) -> None:
    bag = next((copy / 'bag.0').glob('*.mcap'))
    data = bag.read_bytes()
    bag.write_bytes(data[: len(data) * 9 // 10])
    done = call('verify', str(copy), '--json')
    assert done.code == 4
    assert json.loads(done.out)['verdict']['integrity'] in ('altered', 'truncated')


def test_what_is_not_there_is_a_usage_error(copy: Path, call: Call) -> None:
    assert call('verify', 'nothing').code == 64
    done = call('verify', str(copy), '--iteration', '3')
    assert done.code == 64
    assert 'it has 0' in done.err
    assert call('verify', str(copy / 'bag.0'), '--iteration', '3').code == 64


def test_a_run_without_a_bag_is_a_usage_error(here: Path, call: Call) -> None:
    (here / 'refused').mkdir()
    done = call('verify', 'refused')
    assert done.code == 64
    assert 'nothing was executed' in done.err


def test_a_run_can_be_drawn_again(copy: Path, here: Path, call: Call) -> None:
    assert call('picture', str(copy)).code == 0
    assert call('picture', str(copy), '-o', 'again.png').code == 0
    assert (here / 'again.png').read_bytes() == (copy / 'picture.png').read_bytes()
    done = call('picture', str(copy / 'bag.0'), '-o', 'p.svg', '--json')
    assert json.loads(done.out)['picture'] == 'p.svg'
    assert b'<svg' in (here / 'p.svg').read_bytes()


def test_a_bag_without_its_run_is_drawn_with_a_recomputed_verdict(
    copy: Path, here: Path, call: Call
) -> None:
    assert call('picture', str(copy)).code == 0
    (copy / 'bag.0').rename(here / 'alone')
    assert call('picture', 'alone', '-o', 'p.png').code == 0
    assert (here / 'p.png').read_bytes() == (copy / 'picture.png').read_bytes()


def test_a_figure_for_a_paper_comes_with_the_words_for_its_caption(
    copy: Path, here: Path, call: Call
) -> None:
    done = call('picture', str(copy), '--style', 'paper', '--json')
    answer = json.loads(done.out)
    assert Path(answer['picture']) == copy / 'figure.pdf'
    assert (copy / 'figure.pdf').read_bytes().startswith(b'%PDF')
    assert answer['caption'][0].startswith('1  ')
    assert call('picture', str(copy), '--style', 'paper', '-o', 'p.svg').code == 0
    assert b'<svg' in (here / 'p.svg').read_bytes()
    assert call('picture', str(copy), '--style', 'poster').code == 64


def test_a_video_moves(copy: Path, here: Path, call: Call) -> None:
    assert call('picture', str(copy), '--video', '-o', 'v.gif').code == 0
    assert (here / 'v.gif').read_bytes().startswith(b'GIF89a')
    assert call('picture', str(copy), '--video', '-o', 'v.mp4').code == 64


@pytest.mark.parametrize(('name', 'code'), [('p.gif', 64), ('none/p.png', 4)])
def test_a_picture_goes_only_where_it_can(
    copy: Path, here: Path, call: Call, name: str, code: int
) -> None:
    assert call('picture', str(copy), '-o', name).code == code
    assert sorted(path.name for path in here.iterdir()) == ['runs']


def test_a_bag_without_a_report_of_its_own_needs_a_name_for_its_picture(
    copy: Path, here: Path, call: Call
) -> None:
    assert call('picture', str(copy), '--iteration', '0').code == 64
    (copy / 'bag.0').rename(here / 'alone')
    assert call('picture', 'alone').code == 64


def test_each_condition_with_samples_is_drawn(copy: Path, here: Path, call: Call) -> None:
    done = call('verify', str(copy), '--plots', 'drawn', '--json')
    report = json.loads(done.out)
    measured = [row['id'] for row in report['verdict']['results'] if row['margin'] is not None]
    for kind, begin in (('png', b'\x89PNG'), ('svg', b'<?xml')):
        files = sorted((here / 'drawn').glob(f'*.{kind}'))
        assert [file.stem.partition('_')[2] for file in files] == measured
        assert all(file.read_bytes().startswith(begin) for file in files)
    assert call('verify', str(copy), '--plots', str(copy / 'report.json')).code == 4


def test_a_graph_that_does_not_fit_its_nodes_is_told_on_the_first_line(
    copy: Path, here: Path, call: Call, monkeypatch: pytest.MonkeyPatch
) -> None:
    (copy / 'bag.0').rename(here / 'alone')

    def with_a_node_less(bag: Path) -> BagContent:
        content = read_bag(bag, message_definitions())
        content.agsg_message.nodes.pop()
        return content

    monkeypatch.setattr(
        'aurora_core.trace.bag_reader.read_bag', lambda bag, _known: with_a_node_less(bag)
    )
    done = call('verify', 'alone')
    assert done.code == 4
    first = done.out.splitlines()[0]
    assert first.startswith('INCONCLUSIVE  ')
    assert 'alone cannot be judged: the scenario graph in ' in first
    assert 'parser' not in done.out + done.err
    assert json.loads(call('verify', 'alone', '--json').out)['status'] == 'error'


def test_a_bag_whose_prompt_was_altered_never_passes(finished: SimpleNamespace) -> None:
    known = installed_knowledge()
    content, graph = load_bag(finished.folder / 'bag.0')
    assert verify_content(known, content, graph).status is VerdictStatus.VERIFIED
    for reader in (graph.spec.reader, ''):
        prompt = graph.spec.prompt.replace('20 m', '90 m')
        spec = graph.spec.model_copy(update={'prompt': prompt, 'reader': reader})
        verdict = verify_content(known, content, graph.model_copy(update={'spec': spec}))
        assert verdict.status is VerdictStatus.INCONCLUSIVE
        assert ('graph', 'prompt') in [(f.kind, f.subject) for f in verdict.cross_check]
