# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Reference specifications say exactly what the annotations say."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from aurora_bench.fidelity.answer import Answer
from aurora_bench.fidelity.score import score
from aurora_bench.prompts.format import AnnotatedPrompt
from aurora_bench.prompts.reading import read_prompts
from aurora_bench.prompts.reference_names import NotExpressibleError
from aurora_bench.prompts.reference_spec import main, reference_spec
from aurora_bench.prompts.shipped import Split, prompt_file
from aurora_cli.installed import installed
from aurora_core.agsg.build import build_agsg
from aurora_core.outcomes.feasibility import Feasibility
from aurora_core.pipeline.functions import check_stage
from aurora_core.spec.prohibitions import ForbiddenAgent, ForbiddenBehavior, ForbiddenEvent
from aurora_core.spec.scenario import ScenarioSpec, UavAction

Doc = dict[str, Any]


def prompt(*requirements: Doc, **fields: Any) -> AnnotatedPrompt:
    """Return an annotated prompt."""
    return AnnotatedPrompt.model_validate(
        {
            'id': 'track-1', 'category': 'track', 'prompt': 'any', 'feasibility': 'feasible',
            'paraphrase_group': None, 'end_to_end': False, 'requirements': requirements, **fields,
        }
    )  # fmt: skip


CAR: Doc = {'id': 'r1', 'kind': 'agent', 'ref': 'car1', 'type': 'car'}
UAV: Doc = {'id': 'r2', 'kind': 'uav', 'ref': 'uav1'}
HOVER: Doc = {
    'id': 'r3', 'kind': 'mission', 'ref': 'm1', 'uav': 'uav1', 'mode': 'hover', 'altitude_m': 50,
}  # fmt: skip


@pytest.mark.parametrize('split', ['tune', 'held_out'])
@pytest.mark.parametrize('part', ['bench', 'multi_uav'])
def test_every_shipped_reference_scores_one_and_is_feasible(split: Split, part: str) -> None:
    digest = installed().map('downtown').digest
    asked = [p for p in read_prompts(prompt_file(split, part)) if p.feasibility != 'infeasible']
    for p in asked:
        spec = ScenarioSpec.model_validate(p.reference)
        assert spec == reference_spec(p), p.id
        result = score(p, Answer(spec=spec))
        assert [r.id for r in result.requirements if not r.is_met] == [], p.id
        assert result.extra == (), p.id
        verdict = check_stage(installed(), build_agsg(spec, map_digest=digest))
        assert verdict.result is Feasibility.FEASIBLE, p.id


def test_a_range_is_the_domain_and_a_number_is_one_point() -> None:
    spec = reference_spec(prompt(UAV, {**HOVER, 'duration_s': 20},
                                 variation={'r3.altitude_m': [45, 55]}))  # fmt: skip
    altitude, duration = spec.missions[0].altitude_m, spec.missions[0].duration_s
    assert (altitude.low, altitude.value, altitude.high) == (45, 50, 55)
    assert duration is not None
    assert (duration.low, duration.value, duration.high) == (20, 20, 20)


def test_a_group_becomes_its_members_and_each_flies() -> None:
    spec = reference_spec(prompt({**UAV, 'count': 3}, HOVER))
    assert [u.id for u in spec.uavs] == ['uav1_1', 'uav1_2', 'uav1_3']
    assert [m.uav for m in spec.missions] == ['uav1_1', 'uav1_2', 'uav1_3']
    assert len({u.group for u in spec.uavs}) == 1


def test_what_must_not_be_becomes_a_prohibition() -> None:
    spec = reference_spec(
        prompt(
            CAR,
            {'id': 'r5', 'kind': 'agent', 'ref': 'none', 'type': 'pedestrian', 'count': 0},
            {'id': 'r6', 'kind': 'behavior', 'agent': 'car1', 'behavior': 'stop', 'negate': True},
            {
                'id': 'r7', 'kind': 'event', 'ref': 'e1', 'negate': True,
                'action': {'do': 'brake', 'agent': 'car1'},
            },
        )
    )  # fmt: skip
    assert [a.id for a in spec.agents] == ['car1']
    assert spec.agents[0].behaviors == ()
    kinds = {type(p) for p in spec.prohibitions}
    assert kinds == {ForbiddenAgent, ForbiddenBehavior, ForbiddenEvent}
    assert spec.events == ()


def test_a_change_of_mission_flies_a_mission_of_its_own() -> None:
    event = {
        'id': 'r7', 'kind': 'event', 'ref': 'e1', 'trigger': {'on': 'time', 'at_s': 20},
        'action': {'do': 'change_mission', 'uav': 'uav1', 'mode': 'track', 'target': 'car1'},
    }  # fmt: skip
    spec = reference_spec(prompt(CAR, UAV, HOVER, event))
    action = spec.events[0].action
    assert isinstance(action, UavAction)
    changed = next(m for m in spec.missions if m.id == action.mission)
    assert (changed.mode, changed.target) == ('track', 'car1')


def test_a_message_without_an_annotated_link_has_a_default_one() -> None:
    event = {
        'id': 'r7', 'kind': 'event', 'ref': 'e1', 'trigger': {'on': 'time', 'at_s': 20},
        'action': {'do': 'send_message', 'sender': 'uav1', 'receiver': 'car1'},
    }  # fmt: skip
    link = {'id': 'r8', 'kind': 'link', 'sender': 'uav1', 'receiver': 'car1', 'loss': 0.2}
    ends = [('uav1', 'car1')]
    silent, stated = (
        reference_spec(prompt(CAR, UAV, event)),
        reference_spec(prompt(CAR, UAV, event, link)),
    )
    assert [(found.sender, found.receiver) for found in silent.links] == ends
    assert [(found.sender, found.receiver) for found in stated.links] == ends
    assert [silent.links[0].loss.value, stated.links[0].loss.value] == [0.0, 0.2]


def test_the_first_reading_that_can_be_said_is_taken() -> None:
    readings: Doc = {
        'id': 'r8', 'kind': 'any_of', 'any_of': [
            {'id': 'r9', 'kind': 'behavior', 'agent': 'uav1', 'behavior': 'follow'},
            {**HOVER, 'id': 'r10', 'altitude_m': 70},
        ],
    }  # fmt: skip
    spec = reference_spec(prompt(UAV, readings))
    assert [m.altitude_m.value for m in spec.missions] == [70]


@pytest.mark.parametrize('field', ['target', 'end'])
def test_a_flight_to_a_place_ends_over_it(field: str) -> None:
    """Nothing of a pattern is annotated: "flies to the market" is no rectangle about it."""
    flies: Doc = {**HOVER, 'mode': 'navigate', field: 'Harbor Market'}
    (mission,) = reference_spec(prompt(UAV, flies)).missions
    assert (mission.target, mission.pattern) == ('landmark:Harbor Market', 'waypoints')
    assert mission.waypoint_count is not None
    assert mission.waypoint_count.value == 1
    sized = reference_spec(prompt(UAV, {**flies, 'target': 'Harbor Market', 'size_m': [80, 50]}))
    assert sized.missions[0].pattern == 'rectangle' or field == 'end'


def test_what_cannot_be_said_is_told() -> None:
    up = {
        'id': 'r7', 'kind': 'event', 'ref': 'e1',
        'trigger': {'on': 'altitude_reached', 'uav': 'car1', 'value_m': 20},
    }  # fmt: skip
    with pytest.raises(NotExpressibleError, match="'car1' is no UAV"):
        reference_spec(prompt(CAR, UAV, up))
    refusal = {'id': 'r1', 'kind': 'reject', 'because': 'count'}
    with pytest.raises(NotExpressibleError, match='refusal'):
        reference_spec(prompt(refusal, category='infeasible', feasibility='infeasible'))


def test_written_into_a_file_everything_else_stays(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / 'own.jsonl'
    behavior = {'id': 'r5', 'kind': 'behavior', 'agent': 'uav1', 'behavior': 'stop'}
    lines = [
        prompt(UAV, HOVER).model_dump(mode='json', exclude_unset=True),
        prompt(UAV, behavior, id='track-2').model_dump(mode='json', exclude_unset=True),
    ]
    path.write_text('\n'.join(json.dumps(line) for line in lines), encoding='utf-8')
    assert main([str(path)]) == 0
    assert capsys.readouterr().out == "track-2: 'uav1' is no ground agent\n"
    written = [json.loads(line) for line in path.read_text('utf-8').splitlines()]
    assert written[0].pop('reference')['uavs'] == [{'id': 'uav1'}]
    assert written == lines
