# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Every document in a run folder is held against the bag and against the others."""

from __future__ import annotations

import base64
import json
import shutil
from collections.abc import Callable
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest
from run_folders import Call, copied, edited, made, said

from aurora_core.report import run_check

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
