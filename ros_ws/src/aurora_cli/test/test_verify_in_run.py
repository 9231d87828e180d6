# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""A bag in a run folder is only the one of that run when everything in the folder says so."""

from __future__ import annotations

import base64
import hashlib
import io
import json
import re
import shutil
from collections.abc import Callable, Iterator
from contextlib import chdir, contextmanager, redirect_stdout
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest

from aurora_cli import installed
from aurora_cli.commands import verify
from aurora_cli.main import run_command_line
from aurora_core.knowledge.config_files import ENVIRONMENT_VARIABLE, config_path
from aurora_core.outcomes.agsg import Agsg
from aurora_core.pipeline import verify_run
from aurora_core.pipeline.knowledge import Knowledge
from aurora_core.pipeline.verification import Judged, judge_content, load_bag
from aurora_core.report import run_check
from aurora_core.trace.bag_content import BagContent

Call = Callable[..., SimpleNamespace]


@pytest.fixture(scope='session')
def failed(finished: SimpleNamespace, shell: SimpleNamespace) -> Path:
    """A violated run of the same prompt, map and seed."""
    fault = '{"kind": "target_removed", "subject": "ego", "at_s": 3.0}'
    return made(finished, shell.prompt, '--fault', fault, status='violated')


@pytest.fixture(scope='session')
def other_seed(finished: SimpleNamespace, shell: SimpleNamespace) -> Path:
    """A verified run of the same prompt with another seed."""
    return made(finished, shell.prompt, '--seed', '2')


@pytest.fixture(scope='session')
def other_prompt(finished: SimpleNamespace, shell: SimpleNamespace) -> Path:
    """A verified run of another prompt."""
    return made(finished, shell.prompt.replace('20 meters', '30 meters'))


def made(finished: SimpleNamespace, prompt: str, *options: str, status: str = 'verified') -> Path:
    answer = io.StringIO()
    with chdir(finished.home), redirect_stdout(answer):
        run_command_line(['run', prompt, '--json', *options])
    report = json.loads(answer.getvalue())
    assert report['status'] == status
    folder: Path = finished.home / 'runs' / report['run_id']
    return folder


@pytest.fixture
def run(here: Path, finished: SimpleNamespace) -> Path:
    """A copy of the verified run."""
    return copied(here, finished.folder)


def copied(here: Path, folder: Path) -> Path:
    target = here / 'runs' / folder.name
    shutil.copytree(folder, target)
    return target


def edited(path: Path, change: Callable[[dict[str, Any]], Any]) -> None:
    document = json.loads(path.read_text())
    change(document)
    path.write_text(json.dumps(document))


@contextmanager
def judged_once() -> Iterator[None]:
    """Have the same bag judged once, however often it is told and whatever lies beside it."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(verify, 'load_bag', lambda bag: loaded(bag, bytes_of(bag)))
        patch.setattr(verify_run, 'judge_content', judged)
        patch.setattr(verify, 'verify_found', first_answer(verify.verify_found))
        yield


def bytes_of(bag: Path) -> str:
    """Return a digest of a bag's name, of what lies in it and of every byte there."""
    files = sorted(path for path in (bag.rglob('*') if bag.is_dir() else (bag,)) if path.is_file())
    named = (f'{path.relative_to(bag.parent)}\0'.encode() + path.read_bytes() for path in files)
    return hashlib.sha256(b'\0'.join(hashlib.sha256(data).digest() for data in named)).hexdigest()


READ: dict[str, tuple[BagContent, Agsg]] = {}
JUDGED: dict[int, Judged] = {}


def loaded(bag: Path, digest: str) -> tuple[BagContent, Agsg]:
    if digest not in READ:
        READ[digest] = load_bag(bag)
    return READ[digest]


def judged(known: Knowledge, content: BagContent, agsg: Agsg, *, as_recorded: bool) -> Judged:
    assert not as_recorded
    if id(content) not in JUDGED:
        JUDGED[id(content)] = judge_content(known, content, agsg)
    return JUDGED[id(content)]


def first_answer(function: Callable[..., Any]) -> Callable[..., Any]:
    answers: list[Any] = []

    def answer(*arguments: object, **options: object) -> Any:
        if not answers:
            answers.append(function(*arguments, **options))
        return answers[0]

    return answer


def said(call: Call, *arguments: str) -> SimpleNamespace:
    """What is said about a bag: code and heading are held to belong together, in text and JSON."""
    with judged_once():
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


def test_each_run_is_the_one_of_its_own_folder(
    finished: SimpleNamespace, failed: Path, other_seed: Path, call: Call
) -> None:
    for folder, code in ((finished.folder, 0), (failed, 1), (other_seed, 0)):
        found = said(call, str(folder))
        assert (found.code, found.integrity, found.doubts) == (code, 'intact', [])


@pytest.mark.parametrize(
    'prompt',
    [
        'A drone tracks a van. After 10 s the van changes to the left lane.',
        'A car overtakes a truck. A drone tracks the truck.',
    ],
)
def test_a_run_with_changes_of_lane_is_the_one_of_its_bag(
    prompt: str, finished: SimpleNamespace, call: Call
) -> None:
    answer = said(call, str(made(finished, prompt)))
    assert (answer.code, answer.doubts) == (0, [])


def test_what_grounding_chose_is_said_back_as_it_is_in_the_bag(
    finished: SimpleNamespace, call: Call
) -> None:
    prompt = (
        'A drone flies from Union Station to Harbor Market at 80 m. Its speed is at least 10 m/s.'
    )
    answer = said(call, str(made(finished, prompt, '--no-repair', status='violated')))
    assert (answer.code, answer.doubts) == (1, [])


@pytest.mark.parametrize('name', ['bag.1', 'bag.0'])
def test_a_verified_bag_in_the_folder_of_a_failed_run_is_no_pass(
    here: Path, finished: SimpleNamespace, failed: Path, call: Call, name: str
) -> None:
    folder = copied(here, failed)
    shutil.rmtree(folder / name, ignore_errors=True)
    shutil.copytree(finished.folder / 'bag.0', folder / name)
    found = said(call, str(folder))
    assert (found.code, found.integrity) == (4, 'altered')
    assert finished.folder.name in found.first
    told = 'report.json lists no bag.1' if name == 'bag.1' else 'the trace is not the one of'
    assert any(told in text for text in found.doubts)
    # The failed run's own bag is judged as before.
    if name == 'bag.1':
        assert said(call, str(folder), '--iteration', '0').code == 1


def test_a_verified_bag_with_its_record_in_the_folder_of_a_failed_run_is_no_pass(
    here: Path, finished: SimpleNamespace, failed: Path, call: Call
) -> None:
    swaps = ['report.json', 'manifest.json', 'verdict.0.json', 'agsg.0.json', 'grounding.0.json']
    for count in range(len(swaps) + 1):
        folder = copied(here / str(count), failed)
        shutil.rmtree(folder / 'bag.0')
        shutil.copytree(finished.folder / 'bag.0', folder / 'bag.0')
        for name in swaps[:count]:
            shutil.copyfile(finished.folder / name, folder / name)
        found = said(call, str(folder))
        assert (found.code, found.integrity) == (4, 'altered')


def test_a_bag_of_another_seed_or_prompt_is_no_pass(
    here: Path, run: Path, other_seed: Path, other_prompt: Path, call: Call
) -> None:
    for folder, word in ((other_seed, 'the seed'), (other_prompt, 'the prompt')):
        target = copied(here / word, run)
        shutil.rmtree(target / 'bag.0')
        shutil.copytree(folder / 'bag.0', target / 'bag.0')
        # The report is made to name the trace of the bag.
        theirs = json.loads((folder / 'report.json').read_text())

        def forge(report: dict[str, Any], theirs: dict[str, Any] = theirs) -> None:
            report['trace'], report['bags'] = theirs['trace'], theirs['bags']

        edited(target / 'report.json', forge)
        shutil.copyfile(folder / 'verdict.0.json', target / 'verdict.0.json')
        found = said(call, str(target))
        assert (found.code, found.integrity) == (4, 'altered')
        assert any(word in text for text in found.doubts)


@pytest.mark.parametrize('content', [None, 'null', '{}', '[' * 100_000, '{"schema_version": 99}'])
def test_a_report_that_is_missing_or_broken_is_said(
    run: Path, call: Call, content: str | None
) -> None:
    if content is None:
        (run / 'report.json').unlink()
    else:
        (run / 'report.json').write_text(content)
    found = said(call, str(run))
    assert (found.code, found.integrity) == (4, 'unknown')
    assert 'report.json' in found.first
    # Whoever names the bag gets the same answer.
    assert said(call, str(run / 'bag.0')).code == 4
    assert said(call, str(next((run / 'bag.0').glob('*.mcap')))).code == 4


def test_a_report_of_another_run_is_said(run: Path, other_seed: Path, call: Call) -> None:
    shutil.copyfile(other_seed / 'report.json', run / 'report.json')
    found = said(call, str(run))
    assert (found.code, found.integrity) == (4, 'unknown')
    assert f'report.json is of run {other_seed.name}' in found.first


def test_the_prompt_of_the_folder_is_the_one_in_the_bag(run: Path, call: Call) -> None:
    prompt = (run / 'prompt.txt').read_bytes()
    (run / 'prompt.txt').write_bytes(prompt + b'\n')
    found = said(call, str(run))
    assert (found.code, found.integrity) == (4, 'altered')
    assert 'prompt.txt has the prompt' in found.first
    (run / 'prompt.txt').unlink()
    assert said(call, str(run)).integrity == 'unknown'
    (run / 'prompt.txt').write_bytes(prompt)
    assert said(call, str(run)).code == 0
    for name, change in (
        ('report.json', lambda report: report.update(prompt='A drone flies to Jupiter.')),
        ('manifest.json', lambda manifest: manifest['request'].update(prompt='Nothing.')),
    ):
        stored = (run / name).read_bytes()
        edited(run / name, change)
        found = said(call, str(run))
        assert (found.code, found.integrity) == (4, 'altered')
        assert f'{name} has the prompt' in found.first
        (run / name).write_bytes(stored)


FAULT = {'kind': 'link_loss', 'subject': '*', 'value': 1.0}
ERROR = {'code': 1, 'component': 'recorder', 'message': 'disk full'}
REPAIR = {'iteration': 1, 'kind': 'single', 'bag': 'bag.1'}
CHANGES: dict[str, tuple[str, Callable[[dict[str, Any]], Any]]] = {
    'seed': ('report.json', lambda d: d.update(seed=7)),
    'map': ('report.json', lambda d: d.update(map='midtown')),
    'engine': ('report.json', lambda d: d.update(engine='ros')),
    'model': ('report.json', lambda d: d.update(model='openai/other')),
    'model asked for': ('manifest.json', lambda d: d['request'].update(model='openai/other')),
    'faults': ('manifest.json', lambda d: d['request'].update(faults=[FAULT])),
    'seed asked for': ('manifest.json', lambda d: d['request'].update(seed=7)),
    'seed not told': ('manifest.json', lambda d: d['request'].pop('seed')),
    'request not told': ('manifest.json', lambda d: d.pop('request')),
    'run id': ('manifest.json', lambda d: d.update(run_id='20260131T120000Z-0a1b2c')),
    'limits': ('report.json', lambda d: d['limits'].update(clearance_min_m=0.1)),
    'version': ('report.json', lambda d: d['versions'].update(aurora='0.0.9')),
    'no verdict of the trace': ('report.json', lambda d: d['trace'].update(verdict=None)),
    'bags not told': ('report.json', lambda d: d.update(bags=None)),
    'version not told': ('report.json', lambda d: d['versions'].pop('aurora')),
    'ticks of the bag': ('report.json', lambda d: d['bags'][0].update(ticks=7)),
    'digest': ('report.json', lambda d: d['digests'].update(spec='0' * 64)),
    'digest of the graph': ('report.json', lambda d: d['bags'][0].update(graph_sha256='0' * 64)),
    'trace': ('report.json', lambda d: d['bags'][0].update(trace_sha256='0' * 64)),
    'no trace': ('report.json', lambda d: d.update(trace=None)),
    'ticks': ('report.json', lambda d: d['trace'].update(ticks=7)),
    'motion': ('report.json', lambda d: d['trace'].update(motion_sha256='0' * 64)),
    'integrity': ('report.json', lambda d: d['trace'].update(integrity='altered')),
    'verdict of the trace': ('report.json', lambda d: d['trace'].update(verdict='violated')),
    'notes of the trace': ('report.json', lambda d: d['trace'].update(notes=['uav1 crashed'])),
    'question': ('report.json', lambda d: d.update(question='Which bus?')),
    'error': ('report.json', lambda d: d.update(error=ERROR)),
    'relaxed': ('report.json', lambda d: d.update(relaxed={'changes': [], 'verdict': 'verified'})),
    'attempt': ('report.json', lambda d: d['bags'][0].update(iteration=1)),
    'attempt more': ('report.json', lambda d: d['bags'].append({**d['bags'][0], 'bag': 'bag.1'})),
    'repair': ('report.json', lambda d: d['repairs'].append(REPAIR)),
    'no bags': ('report.json', lambda d: d.update(bags=[])),
    'status': ('report.json', lambda d: d.update(status='violated')),
    'refused': ('report.json', lambda d: d.update(status='infeasible')),
    'margin': ('report.json', lambda d: d['conditions'][0].update(margin=1e9)),
    'conditions': ('report.json', lambda d: d['conditions'].pop()),
    'clauses': ('report.json', lambda d: d['clauses'].pop()),
    'sentence': ('report.json', lambda d: d['conditions'][0].update(sentence='It flew to 90 m.')),
    'summary': ('report.json', lambda d: d.update(summary='Two cars crashed.')),
    'realised': ('report.json', lambda d: d['requested_and_realised'][0].update(realised=90.0)),
    'metrics': ('report.json', lambda d: d['metrics'].update(satisfied=1)),
    'note of a clause': ('report.json', lambda d: d['clauses'][0].update(note='90 m')),
    'feasibility': ('feasibility.0.json', lambda d: d.update(result='infeasible')),
    'verdict': ('verdict.0.json', lambda d: d['results'].pop()),
    'graph': ('agsg.0.json', lambda d: d.update(iteration=1)),
    'request': ('spec.0.json', lambda d: d.update(clauses=[])),
    'grounding': ('grounding.0.json', lambda d: d.update(seed=2)),
    'schedule': ('schedule.0.json', lambda d: d.update(horizon_s=1.0)),
}  # fmt: skip


@pytest.mark.parametrize('name', CHANGES)
def test_one_document_that_tells_otherwise_is_enough(run: Path, call: Call, name: str) -> None:
    file, change = CHANGES[name]
    edited(run / file, change)
    found = said(call, str(run))
    assert (found.code, found.integrity == 'intact') == (4, name == 'verdict')
    assert file in found.first


def test_what_two_documents_agree_on_is_held_against_the_bag(run: Path, call: Call) -> None:
    for names, change, why in (
        (
            ('report.json', 'manifest.json'),
            lambda d: d.get('request', d).update(faults=[FAULT]),
            'the bag of none',
        ),
        (
            ('report.json', 'feasibility.0.json'),
            lambda d: d.get('feasibility', d).update(result='infeasible'),
            'infeasible of what was executed',
        ),
    ):
        stored = {name: (run / name).read_bytes() for name in names}
        for name in names:
            edited(run / name, change)
        found = said(call, str(run))
        assert (found.code, found.integrity) == (4, 'altered')
        assert why in found.first
        for name, data in stored.items():
            (run / name).write_bytes(data)


def test_edits_that_nobody_made_are_found(run: Path, call: Call) -> None:
    (run / 'edits.0.json').write_text(json.dumps({**REPAIR, 'iteration': 0, 'bag': 'bag.0'}))
    found = said(call, str(run))
    assert (found.code, found.integrity) == (4, 'altered')
    assert 'edits.0.json is not what report.json tells' in found.first


def test_an_attempt_that_was_taken_away_is_said(run: Path, call: Call) -> None:
    def two(report: dict[str, Any]) -> None:
        report['bags'].append({**report['bags'][0], 'bag': 'bag.1', 'iteration': 1})
        report['repairs'].append(REPAIR)

    edited(run / 'report.json', two)
    assert 'bag.1, which report.json lists, is missing' in call('verify', str(run), '--json').out


def test_another_attempt_is_the_one_that_is_listed(run: Path, call: Call) -> None:
    def two(report: dict[str, Any]) -> None:
        another = {'bag': 'bag.1', 'iteration': 1, 'trace_sha256': '0' * 64}
        report['bags'].append({**report['bags'][0], **another})
        report['repairs'].append(REPAIR)

    shutil.copytree(run / 'bag.0', run / 'bag.1')
    edited(run / 'report.json', two)
    found = call('verify', str(run / 'bag.0'), '--json').out
    assert 'bag.1 is not the attempt that report.json lists' in found
    assert 'edits.1.json' in found
    (run / 'bag.1' / 'bag.1_0.mcap').unlink(missing_ok=True)
    for file in (run / 'bag.1').glob('*.mcap'):
        file.write_bytes(b'')
    assert 'bag.1: ' in call('verify', str(run / 'bag.0'), '--json').out


def test_a_document_that_tells_something_twice_is_none(run: Path, call: Call) -> None:
    for name, once in (('report.json', '"seed": 1'), ('manifest.json', '"seed": 1')):
        stored = (run / name).read_text()
        (run / name).write_text(stored.replace(once, f'{once}, {once}', 1))
        found = said(call, str(run))
        assert (found.code, found.integrity) == (4, 'unknown')
        assert 'twice' in found.first
        (run / name).write_text(stored)
    metadata = run / 'bag.0' / 'metadata.yaml'
    metadata.write_text(f'{metadata.read_text()}rosbag2_bagfile_information: {{version: 9}}\n')
    found = said(call, str(run))
    assert (found.code, found.integrity == 'intact') == (4, False)


def test_what_nobody_can_read_again_was_not_read_by_the_offline_parser(
    finished: SimpleNamespace,
    shell: SimpleNamespace,
    here: Path,
    call: Call,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Whoever cuts a clause out of a run takes away who has read it, too."""
    monkeypatch.setattr('aurora_core.pipeline.functions.parser_digest', lambda: '')
    folder = copied(here, made(finished, shell.prompt))
    found = said(call, str(folder))
    assert (found.code, found.integrity) == (4, 'altered')
    assert 'offline parser' in found.first


@pytest.mark.parametrize(
    'name',
    [
        'manifest.json',
        'feasibility.0.json',
        'spec.0.json',
        'agsg.0.json',
        'grounding.0.json',
        'verdict.0.json',
    ],
)
def test_a_document_that_is_missing_is_said(run: Path, call: Call, name: str) -> None:
    (run / name).unlink()
    found = said(call, str(run))
    assert (found.code, found.integrity) == (4, 'unknown')
    assert f'{name} is missing' in found.first


def test_a_page_that_tells_otherwise_is_found(run: Path, call: Call) -> None:
    page = run / 'report.html'
    shown = page.read_text()
    page.write_text(shown.replace('20 m', '90 m'))
    found = said(call, str(run))
    assert (found.code, found.integrity) == (4, 'altered')
    assert 'report.html is not the page' in found.first
    page.write_text(shown)
    # Who looks has the picture drawn, and the page made again with it.
    assert call('open', str(run), '--json').code == 0
    drawn = (run / 'picture.png').read_bytes()
    assert base64.b64encode(drawn).decode() in page.read_text()
    assert said(call, str(run)).code == 0
    (run / 'picture.png').write_bytes(b'\x89PNG of another run')
    assert 'report.html is not the page' in said(call, str(run)).first
    # A picture beside the page that the run left changes nothing.
    page.write_text(shown)
    assert said(call, str(run)).code == 0
    # What nobody was shown tells nothing wrong; what cannot be compared may.
    page.unlink()
    assert said(call, str(run)).code == 0
    page.mkdir()
    found = said(call, str(run))
    assert (found.code, found.integrity) == (4, 'unknown')
    assert 'report.html cannot be read' in found.first


def test_a_report_of_an_older_version_is_judged_by_what_it_tells(
    run: Path, call: Call, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(run_check, 'AURORA_VERSION', '9.0.0')
    edited(run / 'report.json', lambda report: report.pop('bags'))
    edited(run / 'manifest.json', lambda manifest: manifest.pop('run_id'))
    assert said(call, str(run)).code == 0
    shutil.copytree(run / 'bag.0', run / 'bag.1')
    found = said(call, str(run))
    assert (found.code, found.integrity) == (4, 'altered')
    assert any('of an older version and tells nothing of bag.1' in text for text in found.doubts)
    edited(run / 'report.json', lambda report: report['trace'].update(sha256='0' * 64))
    assert said(call, str(run), '--iteration', '0').integrity == 'altered'


def test_a_bag_that_lies_alone_is_judged_by_itself_and_says_so(
    here: Path, run: Path, call: Call
) -> None:
    shutil.copytree(run / 'bag.0', here / 'alone')
    shutil.copytree(run / 'bag.0', here / 'elsewhere' / 'bag.0')
    for name in ('alone', 'elsewhere/bag.0'):
        found = said(call, name)
        assert (found.code, found.integrity) == (0, 'intact')
        assert 'No run folder: the bag was judged by itself.' in found.first
    # Named as a run it lacks everything that makes one.
    assert said(call, 'elsewhere').integrity == 'unknown'


@pytest.mark.parametrize('name', ['bag.01', 'Bag.0', 'bag.0.recovered', 'bag.١'])
def test_a_bag_under_another_name_in_a_run_folder_is_none_of_the_run(
    run: Path, call: Call, name: str
) -> None:
    shutil.copytree(run / 'bag.0', run / name)
    found = said(call, str(run / name))
    assert (found.code, found.integrity) == (4, 'altered')
    assert any('not the name of a bag of the run' in text for text in found.doubts)


def test_what_is_left_of_a_run_folder_still_is_one(
    here: Path, finished: SimpleNamespace, failed: Path, call: Call
) -> None:
    folder = copied(here, failed)
    for path in folder.iterdir():
        if path.is_file():
            path.unlink()
    shutil.copytree(finished.folder / 'bag.0', folder / 'bag.1')
    for name in (folder, folder / 'bag.1'):
        assert said(call, str(name)).code == 4


def test_a_folder_that_was_renamed_is_still_that_of_its_run(run: Path, call: Call) -> None:
    assert said(call, str(run.rename(run.with_name('kept')))).code == 0
    moved = run.with_name('kept').rename(run.with_name('20260131T120000Z-0a1b2c'))
    found = said(call, str(moved))
    assert found.code == 4
    assert any('manifest.json is of run' in text for text in found.doubts)


def test_links_lead_to_no_other_answer(
    here: Path, run: Path, finished: SimpleNamespace, failed: Path, call: Call
) -> None:
    (here / 'latest').symlink_to(run, target_is_directory=True)
    assert said(call, 'latest').code == 0
    folder = copied(here, failed)
    (folder / 'bag.1').symlink_to(finished.folder / 'bag.0', target_is_directory=True)
    assert said(call, str(folder)).code == 4
    (folder / 'report.json').unlink()
    (folder / 'report.json').symlink_to(finished.folder / 'report.json')
    assert said(call, str(folder)).code == 4


def test_two_files_in_one_bag_are_no_bag_of_a_run(run: Path, other_seed: Path, call: Call) -> None:
    mcap = next((other_seed / 'bag.0').glob('*.mcap'))
    for name in ('a.mcap', 'z.mcap'):
        shutil.copyfile(mcap, run / 'bag.0' / name)
        assert said(call, str(run)).code == 4
        (run / 'bag.0' / name).unlink()
    assert said(call, str(run)).code == 0


def test_a_run_that_was_closed_later_vouches_for_no_bag(
    here: Path, run: Path, finished: SimpleNamespace, call: Call
) -> None:
    def closed(report: dict[str, Any]) -> None:
        error = {'code': 1, 'component': 'report', 'message': 'gone', 'hint': ''}
        report.update(status='error', trace=None, bags=[], conditions=[], error=error)

    edited(run / 'report.json', closed)
    found = said(call, str(run))
    assert (found.code, found.integrity) == (4, 'unknown')
    assert 'report.json tells of no bag' in found.first


def test_an_incomplete_run_holds_its_margins_and_is_not_called_verified(
    finished: SimpleNamespace, shell: SimpleNamespace, call: Call
) -> None:
    prompt = f'{shell.prompt} Then the ego car turns left.'
    folder = made(finished, prompt, status='incomplete')
    found = said(call, str(folder))
    assert found.code == 0
    assert found.first.startswith('MARGINS HOLD  ')
    assert 'The run itself ended incomplete.' in found.first
    assert re.search('Not all of the prompt is encoded and judged: “.*turns left', found.first)
    # A report that forgets the clause is not believed.
    target = copied(finished.home / 'forged', folder)

    def forget(report: dict[str, Any]) -> None:
        report['status'] = 'verified'
        for clause in report['clauses']:
            clause['status'] = 'encoded'

    edited(target / 'report.json', forget)
    assert said(call, str(target)).integrity == 'altered'
    # Alone the bag tells of it, too.
    shutil.copytree(folder / 'bag.0', finished.home / 'lonely')
    found = said(call, str(finished.home / 'lonely'))
    assert found.first.startswith('MARGINS HOLD  ')


def test_a_picture_claims_no_more_than_the_bag(
    here: Path, run: Path, failed: Path, call: Call, monkeypatch: pytest.MonkeyPatch
) -> None:
    from aurora_cli.commands import picture

    captions: list[Any] = []

    def caption(*arguments: Any) -> Any:
        captions.append(original(*arguments))
        return captions[-1]

    original = picture._caption
    monkeypatch.setattr(picture, '_caption', caption)
    assert call('picture', str(run), '-o', 'a.png').code == 0
    folder = copied(here, failed)
    shutil.rmtree(folder / 'bag.0')
    shutil.copytree(run / 'bag.0', folder / 'bag.0')
    shutil.copyfile(run / 'report.json', folder / 'report.json')
    assert call('picture', str(folder), '-o', 'b.png').code == 0
    assert [c.status.value for c in captions] == ['verified', 'inconclusive']


def test_a_comparison_says_that_a_bag_is_not_that_of_its_folder(
    here: Path, run: Path, failed: Path, call: Call
) -> None:
    folder = copied(here, failed)
    shutil.rmtree(folder / 'bag.0')
    shutil.copytree(run / 'bag.0', folder / 'bag.0')
    done = call('diff', str(run), str(folder), '--json')
    sides = json.loads(done.out)
    assert sides['first']['integrity'] == 'intact'
    assert sides['second']['integrity'] == 'altered'
    assert f'the bag is of run {run.name}' in sides['second']['note']


def test_the_certificate_of_another_run_is_not_checked_beside_this_request(
    here: Path, call: Call
) -> None:
    for prompt, name in (('A drone hovers at 400 meters.', 'a'), ('A drone hovers.', 'b')):
        assert call('run', prompt, '--out', name, '--json').code in (0, 5)
    refused, other = (next((here / name).iterdir()) for name in ('a', 'b'))
    assert call('certificate', 'check', str(refused)).code == 0
    shutil.copyfile(refused / 'report.json', other / 'report.json')
    done = call('certificate', 'check', str(other))
    assert done.code == 4
    assert 'is not the one of its folder' in done.err


@pytest.fixture
def configuration(here: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A configuration folder of its own, in force."""
    folder = here / 'config'
    folder.mkdir()
    for path in config_path().iterdir():
        (folder / path.name).symlink_to(path)
    monkeypatch.setenv(ENVIRONMENT_VARIABLE, str(folder))
    return folder


def configured(folder: Path, file: str, change: Callable[[dict[str, Any]], Any]) -> None:
    target = (folder / file).resolve()
    (folder / file).unlink()
    shutil.copyfile(target, folder / file)
    edited(folder / file, change)
    installed.forget()


def verified(call: Call, *arguments: str) -> tuple[int, str]:
    done = call('verify', *arguments)
    return done.code, done.out.splitlines()[0]


@pytest.mark.parametrize(
    ('file', 'change', 'name'),
    [
        ('limits.json', lambda d: d.update(clearance_min_m=4.0), 'limits.clearance_min_m'),
        ('tolerances.json', lambda d: d.update(stop_speed_mps=0.3), 'tolerances.stop_speed_mps'),
    ],
)
def test_limits_that_were_changed_after_the_run_are_named(
    run: Path,
    failed: Path,
    call: Call,
    configuration: Path,
    file: str,
    change: Callable[[dict[str, Any]], Any],
    name: str,
) -> None:
    configured(configuration, file, change)
    code, first = verified(call, str(run))
    assert (code, first.startswith('INCONCLUSIVE  Nothing is claimed: ')) == (4, True)
    assert name in first
    code, first = verified(call, str(run), '--as-recorded')
    assert code == 0
    assert first.startswith('AS RECORDED: MARGINS HOLD  Judged under version ')
    assert name in first
    code, first = verified(call, str(failed), '--as-recorded')
    assert code == 1
    assert first.startswith('AS RECORDED: VIOLATED  ')


def test_as_recorded_changes_nothing_where_nothing_differs(run: Path, call: Call) -> None:
    done = call('verify', str(run), '--as-recorded', '--json')
    assert done.code == 0
    document = json.loads(done.out)
    assert (document['outcome'], document['as_recorded']) == ('verified', None)
    # Nor does it help a bag that is not the one of the run.
    (run / 'report.json').unlink()
    assert call('verify', str(run), '--as-recorded').code == 4
