# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The campaign of trust: it finds what it looks for, resumes, and its table claims no more."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest

from aurora_bench.machine import machine_facts
from aurora_bench.trust import __main__ as campaign
from aurora_bench.trust import (
    clocks,
    documents,
    machinery,
    mavlink,
    model,
    orders,
    surroundings,
)
from aurora_bench.trust.counted import COUNTED
from aurora_bench.trust.part import NEVER, NOTHING, Counter, Found, Part
from aurora_bench.trust.table import PROMISES, Entry, write_table
from aurora_core.outcomes.repair import Proposal, ProposalOutcome, RepairPlan, ValueEdit
from aurora_core.spec.parameter import Provenance
from aurora_uav_sim.mavlink_server import SimServer
from aurora_uav_sim.pilot import Pilot
from aurora_uav_sim.plan_items import Item, Refusal

ROOT = Path(__file__).resolve().parents[3]
# Campaigns that take hours: nothing is claimed for them before they were run whole.
_NEW = ('deaths', 'guided')


def entry(tried: int, held: int, **changes: Any) -> Entry:
    found = Found(tried=tried, held=held, figures=changes.pop('figures', {}))
    values = {'ident': 'R10', 'name': 'x', 'wanted': 10, 'when': '', 'how': '', **changes}
    return Entry(found=found, **values)


@pytest.mark.parametrize(
    ('line', 'result'),
    [
        (entry(0, 0), 'not tried'),
        (entry(10, 10), 'met'),
        (entry(9, 9), 'held, fewer tried'),
        (entry(10, 9), 'NOT HELD'),
        (entry(40, 40, name='clocks, as tests'), 'held, in part'),
        (entry(1000, 970, least=0.97), 'met'),
        (entry(1000, 969, least=0.97), 'NOT HELD'),
        (entry(1000, 999, least=0.97, figures={NEVER: 1.0}), 'NOT HELD'),
    ],
)
def test_a_line_claims_no_more_than_was_counted(line: Entry, result: str) -> None:
    assert line.result == result


def test_the_table_has_a_line_for_every_promise_and_says_what_did_not_hold(
    tmp_path: Path,
) -> None:
    bad = Found(tried=3, held=2, failures=('the third one',))
    lines = [Entry(ident='R10', name='frames', wanted=3, found=bad, when='now', how='')]
    assert write_table(tmp_path, lines, {}, machine_facts()) == 1
    text = (tmp_path / 'trust.md').read_text()
    assert all(f'| {ident} ' in text for ident in PROMISES)
    assert 'NOT HELD' in text
    assert 'the third one' in text
    # What no benchmark has left is not claimed.
    assert 'held, fewer' not in text


def test_what_other_benchmarks_left_is_counted_from_their_files() -> None:
    read = [(one, *one.found(ROOT / 'docs' / 'bench')) for one in COUNTED]
    assert len([when for _, _, when in read if when]) >= 11
    for one, found, when in read:
        if one.bench in _NEW and not when:
            continue
        assert found.tried >= 30, one.name
        assert found.held == found.tried, one.name
        assert 'version' in when
    assert COUNTED[0].found(ROOT / 'nowhere') == (NOTHING, '')


def test_a_part_goes_on_where_it_was_broken_off(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    called: list[int] = []

    def run(first: int, count: int, _: Path) -> Found:
        called.append(first)
        if first == 4 and called.count(4) == 1:
            raise KeyboardInterrupt
        return Found(tried=count, held=count)

    part = Part(ident='R10', name='frames', wanted=7, usual=7, chunk=2, run=run)
    monkeypatch.setattr(campaign, 'PARTS', (part,))
    with pytest.raises(KeyboardInterrupt):
        campaign.main(['--results', str(tmp_path)])
    assert campaign.main(['--results', str(tmp_path)]) == 0
    assert called == [0, 2, 4, 4, 6]
    lines = json.loads((tmp_path / 'trust.json').read_text())['lines']
    assert [line['found']['tried'] for line in lines if line['ident'] == 'R10'] == [7]
    # The next call does not lose what this one found.
    monkeypatch.setattr(campaign, 'PARTS', (part,))
    assert campaign.main(['--results', str(tmp_path), '--table']) == 0
    assert '| R10 ' in (tmp_path / 'trust.md').read_text()
    assert not list(tmp_path.glob('*.journal.jsonl'))


def test_frames_without_the_key_change_nothing_and_would_be_seen_if_they_did(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    assert mavlink.frames(1, 400, tmp_path) == Found(tried=400, held=400)

    class Open:
        """A simulator that trusts everybody."""

        def __init__(self, server: SimServer, _: object) -> None:
            self._server = server

        def handle(self, datagram: bytes, source: object) -> list[bytes]:
            return self._server.handle(datagram, source)

    monkeypatch.setattr(mavlink, 'SignedServer', Open)
    found = mavlink.frames(1, 400, tmp_path)
    assert found.held < found.tried
    assert 'something changed' in found.failures[0]


def test_uploads_arrive_whole_over_bad_links(tmp_path: Path) -> None:
    for uploads in (mavlink.uploads_10, mavlink.uploads_cut):
        found = uploads(0, 3, tmp_path)
        assert (found.held, found.figures) == (3, {NEVER: 0.0})


def test_a_plan_that_is_taken_in_part_is_never_allowed(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    take = Pilot.take_mission

    def take_most(pilot: Pilot, items: tuple[Item, ...]) -> Refusal | None:
        return take(pilot, items if len(items) == 3 else items[:-1])

    monkeypatch.setattr(Pilot, 'take_mission', take_most)
    found = mavlink.uploads_10(0, 2, tmp_path)
    assert found.figures == {NEVER: 1.0}


def test_damaged_documents_are_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    original = {'run_id': 'r', 'files': [1, {'a': None}], 'x': 'y'}
    monkeypatch.setattr(
        documents, '_originals', lambda _: dict.fromkeys(documents._KINDS, original)
    )
    found = documents.documents(0, 200, tmp_path)
    assert found.held == 200, found.failures


def test_orders_in_prompts_do_nothing_and_would_be_seen(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    found = orders.injections(0, 2, tmp_path)
    assert found.held == 2, found.failures

    def obeys(prompt: str) -> tuple[int, str]:
        (tmp_path / 'written').write_text(prompt)
        return 3, '{"conditions": []}'

    monkeypatch.setattr(orders, '_check', obeys)
    found = orders.injections(0, 1, tmp_path)
    assert 'open for writing' in found.failures[0]


def test_hostile_servers_get_no_specification_through(tmp_path: Path) -> None:
    found = model.model_servers(4, 3, tmp_path)
    assert found.held == 3, found.failures


def test_hostile_servers_move_nothing_in_repair(tmp_path: Path) -> None:
    # As for a prompt: 500, then answers with the form of a revision.
    found = model.revisions(4, 8, tmp_path)
    assert found.held == 8, found.failures


def test_a_revision_that_moves_what_is_not_open_would_be_seen(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    edit = ValueEdit(
        path='events/e1/trigger/value_m',
        requested=20.0,
        realised=90.0,
        provenance=Provenance.DEFAULT,
    )
    plan = RepairPlan(values=(edit,))
    wide = Proposal(outcome=ProposalOutcome.EXHAUSTED, plan=plan, reason='')
    monkeypatch.setattr(orders, 'revise', lambda *_, **__: wide)
    found = orders.repairs(0, 2, tmp_path)
    assert found.held == 0
    assert 'is moved, which is not open' in found.failures[0]


@pytest.mark.parametrize('way', [orders.model_replies, orders.past_episodes, orders.repairs])
def test_orders_do_nothing_whichever_way_they_come(way: Any, tmp_path: Path) -> None:
    found = way(0, 12, tmp_path)
    assert found.held == 12, found.failures


def test_a_model_that_is_obeyed_would_be_seen(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    specs = iter(range(100))
    monkeypatch.setattr(orders, '_read', lambda *_: SimpleNamespace(spec=next(specs)))
    found = orders.model_replies(0, 3, tmp_path)
    assert found.held == 0
    assert 'another request came of' in found.failures[0]


def test_without_libfaketime_no_clock_is_said_to_have_been_moved(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv('AURORA_FAKETIME', str(tmp_path / 'nowhere'))
    assert clocks.moved(0, 1, tmp_path) == NOTHING


@pytest.mark.parametrize(
    ('code', 'said', 'problem'),
    [
        (0, b'{}', ''),
        (4, b'{"hint": "raise ulimit -n"}', ''),
        (4, b'it broke', 'what there is too little of is not said'),
        (4, b'Traceback (most recent call last): ulimit', 'a traceback is shown'),
        (1, b'ulimit', 'exit code 1'),
        (-11, b'aurora: execute', 'exit code -11'),
    ],
)
def test_an_end_without_a_word_is_none(code: int, said: bytes, problem: str) -> None:
    done = subprocess.CompletedProcess[bytes]((), code, said, b'')
    assert surroundings.told_badly(done).startswith(problem)
    assert bool(surroundings.told_badly(done)) is bool(problem)


def test_a_run_that_hangs_with_its_clock_is_ended_and_told(tmp_path: Path) -> None:
    process = subprocess.Popen(
        [sys.executable, '-c', 'import time; time.sleep(60)'],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
    )
    assert not clocks.came_about(tmp_path, 'prompt.txt', process, 0.05)
    assert clocks.end_of(process, 0.05)[1].endswith(b'it did not end in 0.05 s')
    assert process.returncode != 0


def test_a_duration_of_another_day_is_seen() -> None:
    assert clocks.impossible_duration({'timing': {'parse': 0.1, 'execute': 5.0}}) == ''
    assert clocks.impossible_duration({'timing': {'parse': -3600.0}}) == 'parse took -3600.0 s'


def test_every_error_code_is_counted_and_a_part_that_no_test_provokes_is_told(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    every = machinery.codes()
    assert {1, 100, 200, 421, 425, 510, 800} <= every
    assert len(every) == next(p.wanted for p in campaign.PARTS if p.run is machinery.provoked)
    (tmp_path / 'codes').mkdir()
    (tmp_path / 'codes' / '1.json').write_text(json.dumps(sorted(every - {421})))
    totals = {
        'covered_lines': 96, 'num_statements': 100, 'covered_branches': 8, 'num_branches': 10,
    }  # fmt: skip
    (tmp_path / 'coverage.json').write_text(json.dumps({'totals': totals}))
    monkeypatch.setattr(machinery, '_tested', lambda _: tmp_path)
    assert machinery.provoked(0, 1, tmp_path).failures == ('no test provokes 421',)
    covered = machinery.coverage(0, 1, tmp_path)
    assert covered.figures == {'lines [%]': 96.0, 'branches [%]': 80.0}
    assert (covered.tried, covered.held) == (2, 1)


def test_the_largest_of_a_figure_is_kept() -> None:
    counter = Counter()
    for value in (1.0, 3.0, 2.0):
        counter.figure('slowest [s]', value)
        counter.add('')
    both = counter.found().plus(
        Found(tried=1, held=0, failures=('x',), figures={'slowest [s]': 5.0})
    )
    assert both == Found(tried=4, held=3, failures=('x',), figures={'slowest [s]': 5.0})
