# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""A bag in a run folder is only the one of that run when everything in the folder says so."""

from __future__ import annotations

import json
import re
import shutil
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest
from run_folders import Call, copied, edited, made, said


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
