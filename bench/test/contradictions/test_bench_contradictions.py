# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The contradictions are well formed, and two of them are found from end to end."""

from __future__ import annotations

import json
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from aurora_bench.contradictions import motion
from aurora_bench.contradictions.__main__ import _goals, _last_line, _results, _tables
from aurora_bench.contradictions.campaign import ALTERED, Baseline, Campaign, Found
from aurora_bench.contradictions.case import Altered, Case, Planted
from aurora_bench.contradictions.planted import PLANTED
from aurora_bench.contradictions.prompts import REQUESTS
from aurora_bench.mutation.mutant import mutant
from aurora_bench.progress import Progress
from aurora_bench.prompts.validate import validate
from aurora_bench.results import write_results
from aurora_cli.installed import installed
from aurora_core.agsg.build import build_agsg
from aurora_core.pipeline.functions import ground_stage, parse_stage
from aurora_core.trace.layout import GroundColumn
from aurora_core.trace.trace import Trace

CASES: tuple[Case, ...] = (*PLANTED, *ALTERED)


@pytest.fixture(scope='module')
def campaign(tmp_path_factory: pytest.TempPathFactory) -> Campaign:
    return Campaign(tmp_path_factory.mktemp('contradictions'), Progress('test'))


def _named(cases: tuple[Case, ...], name: str) -> Case:
    return next(case for case in cases if case.name == name)


def test_the_annotations_are_those_of_a_prompt_file() -> None:
    text = '\n'.join(json.dumps(annotated) for annotated in REQUESTS.values())
    prompts, findings = validate([text])
    assert not findings
    assert len(prompts) == len(REQUESTS)


def test_every_contradiction_is_one_of_its_own() -> None:
    assert len(PLANTED) >= 12
    assert len(ALTERED) >= 30
    assert len({case.kind for case in ALTERED}) >= 15
    assert len({(case.request, case.kind, case.name) for case in CASES}) == len(CASES)


@pytest.mark.parametrize('request_name', REQUESTS)
def test_requirements_and_conditions_that_are_named_exist(request_name: str) -> None:
    annotated = REQUESTS[request_name]
    requirements = {r['id'] for r in annotated['requirements']}
    spec = parse_stage(installed(), annotated['prompt'], 'downtown', 1).spec
    assert spec is not None
    grounded = ground_stage(installed(), build_agsg(spec), 1).agsg
    assert grounded is not None
    conditions = {row['id'] for row in json.loads(grounded.texts.conditions)}
    for case in CASES:
        if case.request == request_name:
            assert case.requirement in requirements, case.name
            assert case.conditions, case.name
            assert set(case.conditions) <= conditions, case.name


def test_a_planted_bug_is_found_by_both(campaign: Campaign) -> None:
    case = _named(PLANTED, 'sends no message at all')
    assert isinstance(case, Planted)
    found = campaign.judge(case, campaign.planted_bag(case))
    assert found.by_checker
    assert found.by_condition
    honest = campaign.judge(case, campaign.honest(case.request).bag)
    assert honest.outcome == 'holds'
    assert honest.status == 'verified'
    assert not honest.by_condition


def test_an_altered_recording_is_found_by_both(campaign: Campaign) -> None:
    case = _named(ALTERED, 'sent at 18 s, not 15')
    assert isinstance(case, Altered)
    found = campaign.judge(case, campaign.altered_bag(case))
    assert found.by_checker
    assert found.by_condition
    # Another case about the same run: what is not broken is not found.
    other = replace(case, requirement='r3', conditions=('m1.altitude',))
    assert campaign.judge(other, campaign.altered_bag(case)).outcome == 'holds'
    assert not campaign.judge(other, campaign.altered_bag(case)).by_condition


@pytest.mark.parametrize(
    'name',
    [
        'points 40 m beside what they are around',
        'stands 30 m off the middle of the points around it',
    ],
)
def test_points_around_a_body_have_it_in_their_middle(campaign: Campaign, name: str) -> None:
    """Both say so, of the honest run as of one in which the route or the body is elsewhere."""
    case = _named(ALTERED, name)
    assert isinstance(case, Altered)
    found = campaign.judge(case, campaign.altered_bag(case))
    assert found.outcome == 'does_not'
    assert found.by_condition
    honest = campaign.judge(case, campaign.honest(case.request).bag)
    assert (honest.outcome, honest.status) == ('holds', 'verified')


def test_the_same_speeds_give_the_same_way(campaign: Campaign) -> None:
    """Else a condition might fail for what the campaign did wrong."""
    base = campaign.honest('slow and stop')
    row = motion.row_of(base, 'car1')
    way = slice(int(GroundColumn.X), int(GroundColumn.Y) + 1)
    same = motion.driven(base, 'car1', motion.speed_of(base, 'car1'))
    off = np.linalg.norm(same.ground[:, row, way] - base.trace.ground[:, row, way], axis=1)
    assert off.max() < 0.5
    slower = motion.driven(base, 'car1', 0.5 * motion.speed_of(base, 'car1'))
    speeds = np.linalg.norm(np.diff(slower.ground[:, row, way], axis=0), axis=1) / 0.05
    assert np.abs(speeds - slower.ground[1:, row, GroundColumn.SPEED]).max() < 0.5


@pytest.mark.parametrize(
    ('change', 'ticks'), [(motion.without, -40), (motion.again, 40)], ids=['without', 'again']
)
def test_records_go_with_their_ticks(
    campaign: Campaign, change: Callable[..., Trace], ticks: int
) -> None:
    base = campaign.honest('slow and stop')
    before = base.trace.links[0].tick
    altered = change(base, 400, 440)
    assert altered.ticks == base.trace.ticks + ticks
    assert altered.links[0].tick == before + ticks
    assert (altered.uav[before + ticks] == base.trace.uav[before]).all()
    assert mutant('', '', base, (), trace=altered).trace.events[-1].tick == altered.ticks - 1


def _found(case: Case, outcome: str, conditions: tuple[str, ...], status: str) -> Found:
    return Found(
        case=case, outcome=outcome, why='', conditions=conditions, status=status, others=()
    )


def test_the_last_line_counts_and_a_miss_fails() -> None:
    base = Baseline(request='a', prompt='', status='verified', contradicted=(), undecided=())
    hit = [_found(case, 'does_not', case.conditions, 'inconclusive') for case in CASES]
    count = len(CASES)
    assert _last_line([base], hit) == (
        f'contradictions found by the checker {count} of {count}  '
        f'by a condition {count} of {count}  baselines clean 1 of 1\n'
    )
    assert all(goal.met for goal in _goals([base], hit))
    for miss in (
        _found(CASES[0], 'cannot_tell', CASES[0].conditions, 'violated'),
        _found(CASES[0], 'does_not', (), 'inconclusive'),
        _found(CASES[0], 'does_not', CASES[0].conditions, 'verified'),
    ):
        assert not all(goal.met for goal in _goals([base], [miss, *hit[1:]]))
    wrong = replace(base, contradicted=('r1: no',))
    assert not all(goal.met for goal in _goals([wrong], hit))


def test_results_are_written_whole(tmp_path: Path) -> None:
    base = Baseline(request='a', prompt='', status='verified', contradicted=(), undecided=())
    hit = [_found(case, 'does_not', case.conditions, 'violated') for case in CASES]
    _, page = write_results(
        tmp_path, 'contradictions', _results([base], hit), title='x', tables=_tables([base], hit)
    )
    text = page.read_text(encoding='utf-8')
    assert all(case.name in text for case in CASES)
