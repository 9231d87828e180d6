# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The landing that ends every mission and what no field holds are not scored; all else is."""

from __future__ import annotations

from typing import Any, Literal

import pytest

from aurora_bench.fidelity.answer import Answer
from aurora_bench.fidelity.denominator import beyond, final_landings
from aurora_bench.fidelity.score import score
from aurora_bench.prompts.format import AnnotatedPrompt, MissionRequirement
from aurora_core.document import Document
from aurora_core.spec.scenario import ScenarioSpec

Doc = dict[str, Any]

SCENE: list[Doc] = [
    {'id': 'r1', 'kind': 'uav', 'ref': 'uav1'},
    {'id': 'r2', 'kind': 'mission', 'ref': 'm1', 'uav': 'uav1', 'mode': 'hover'},
    {'id': 'r3', 'kind': 'mission', 'ref': 'm2', 'uav': 'uav2', 'mode': 'hover'},
    {'id': 'r4', 'kind': 'event', 'ref': 'e1', 'action': {'do': 'brake', 'agent': 'car1'}},
]
LAND: Doc = {'id': 'r5', 'kind': 'event', 'ref': 'e5', 'action': {'do': 'land', 'uav': 'uav1'}}
LANDED: Doc = {
    'id': 'r6', 'kind': 'condition', 'quantity': 'landed', 'of': ['uav1'], 'op': '==',
    'value': True,
}  # fmt: skip
DONE: Doc = {'on': 'mission_done', 'uav': 'uav1'}


def order(first: str, then: str, **more: float) -> Doc:
    return {'id': 'r7', 'kind': 'order', 'first': first, 'then': then, **more}


def prompt(*requirements: Doc) -> AnnotatedPrompt:
    return AnnotatedPrompt.model_validate(
        {
            'id': 'hover-1', 'category': 'hover', 'prompt': 'any', 'feasibility': 'feasible',
            'paraphrase_group': None, 'end_to_end': False,
            'requirements': [*SCENE, *requirements],
        }
    )  # fmt: skip


@pytest.mark.parametrize(
    ('told', 'left_out'),
    [
        ((LAND,), {'r5'}),
        ((LAND | {'trigger': DONE},), {'r5'}),
        ((LANDED,), {'r6'}),
        ((LAND, order('m1', 'e5')), {'r5', 'r7'}),
        (({'id': 'r8', 'kind': 'any_of', 'any_of': [LAND, LANDED]},), {'r8'}),
        # A time, another cause, an altitude, a deadline, a place among other events; forbidden.
        ((LAND | {'trigger': {'on': 'time', 'at_s': 40}},), set()),
        ((LAND | {'trigger': {'on': 'event_done', 'event': 'e1'}},), set()),
        ((LAND | {'trigger': {'on': 'mission_done', 'uav': 'uav2'}},), set()),
        ((LAND | {'action': {'do': 'land', 'uav': 'uav1', 'altitude_m': 2}},), set()),
        ((LANDED | {'by_s': 90},), set()),
        ((LANDED | {'value': False},), set()),
        ((LAND, order('e1', 'e5')), set()),
        ((LAND, order('m2', 'e5')), set()),
        ((LAND, order('e5', 'e1')), set()),
        ((LAND, order('m1', 'e5', within_s=5)), set()),
        (
            (LAND, LANDED | {'quantity': 'event_time', 'of': ['e5'], 'op': '<=', 'value': 90}),
            set(),
        ),
        ((LAND | {'negate': True},), set()),
        ((LANDED | {'negate': True},), set()),
        (
            (
                {
                    'id': 'r8',
                    'kind': 'any_of',
                    'any_of': [LAND, LANDED | {'by_s': 90}],
                },
            ),
            set(),
        ),
    ],
)
def test_only_the_landing_that_every_mission_ends_with_leaves(
    told: tuple[Doc, ...], left_out: set[str]
) -> None:
    whole = prompt(*told)
    assert final_landings(whole) == left_out
    for answer in (Answer(spec=ScenarioSpec(prompt='any')), Answer(reasons=('count',))):
        counted = [r.id for r in score(whole, answer).requirements]
        assert counted == [r.id for r in whole.requirements if r.id not in left_out]
        assert len(score(whole, answer, is_fair=False).requirements) == len(whole.requirements)


class _Beyond(Document):
    """A requirement of a kind that is listed, never scored."""

    kind: Literal['beyond'] = 'beyond'
    id: str
    text: str
    negate: bool = False
    tol: None = None


class _Count(Document):
    """A requirement of a kind that the scorer does not know."""

    kind: Literal['counted'] = 'counted'
    id: str
    value: float
    negate: bool = False
    tol: None = None


def with_requirements(*requirements: Document) -> AnnotatedPrompt:
    """Return a prompt with requirements that the format may not have."""
    plain = prompt()
    return plain.model_copy(update={'requirements': (plain.requirements[0], *requirements)})


@pytest.mark.parametrize('is_fair', [True, False])
def test_what_no_field_holds_is_listed_and_never_scored(is_fair: bool) -> None:
    asked = with_requirements(_Beyond(id='r9', text='in red'))
    assert beyond(asked) == {'r9'}
    for answer in (
        Answer(spec=ScenarioSpec.model_validate({'prompt': 'any', 'uavs': [{'id': 'u'}]})),
        Answer(question='Which?'),
    ):
        result = score(asked, answer, is_fair=is_fair)
        assert [r.id for r in result.requirements] == ['r1']
        assert result.beyond == ('r9',)


def test_a_field_or_kind_that_the_scorer_does_not_know_is_missed() -> None:
    mission = MissionRequirement.model_validate(SCENE[1] | {'side': 'left'})
    asked = with_requirements(mission, _Count(id='r9', value=2))
    hover = {
        'id': 'm', 'uav': 'u', 'mode': 'hover',
        **{
            name: {'value': 30, 'unit': unit, 'low': 30, 'high': 30, 'provenance': 'inferred'}
            for name, unit in (('altitude_m', 'm'), ('duration_s', 's'))
        },
    }  # fmt: skip
    spec = ScenarioSpec.model_validate(
        {'prompt': 'any', 'uavs': [{'id': 'u'}], 'missions': [hover]}
    )
    held = {r.id: r.fields for r in score(asked, Answer(spec=spec)).requirements}
    assert held == {
        'r1': {'count': True},
        'r2': {'uav': True, 'mode': True, 'side': False},
        'r9': {'value': False},
    }
