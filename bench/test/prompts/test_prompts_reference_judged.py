# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""A reference that is run is asked for every number that the annotation states."""

from __future__ import annotations

import json
from typing import Any

import pytest

from aurora_bench.prompts.format import AnnotatedPrompt
from aurora_bench.prompts.reference_spec import reference_spec
from aurora_cli.installed import installed
from aurora_core.agsg.build import build_agsg
from aurora_core.pipeline.functions import ground_stage
from aurora_core.spec.parameter import Bound, Provenance
from aurora_core.spec.scenario import ScenarioSpec, SendMessage

Doc = dict[str, Any]
TEXT = 'A drone circles City Hall at 40 m with a radius of 50 m at 8 m/s.'


def asked(*requirements: Doc, text: str = TEXT, **fields: Any) -> AnnotatedPrompt:
    """Return an annotated prompt about one drone."""
    return AnnotatedPrompt.model_validate(
        {
            'id': 'patrol-901', 'category': 'patrol', 'prompt': text, 'feasibility': 'feasible',
            'paraphrase_group': None, 'end_to_end': False,
            'requirements': [{'id': 'r1', 'kind': 'uav', 'ref': 'uav1'}, *requirements], **fields,
        }
    )  # fmt: skip


ORBIT: Doc = {
    'id': 'r2', 'kind': 'mission', 'ref': 'm1', 'uav': 'uav1', 'mode': 'navigate',
    'target': 'City Hall', 'pattern': 'orbit', 'altitude_m': 40, 'radius_m': 50, 'speed_mps': 8,
}  # fmt: skip


def condition_ids(spec: ScenarioSpec) -> set[str]:
    """Return the conditions that a grounded specification is judged by."""
    graph = ground_stage(
        installed(), build_agsg(spec, map_digest=installed().map('downtown').digest), 1
    ).agsg
    assert graph is not None
    return {c['id'] for c in json.loads(graph.texts.conditions)}


def test_annotated_numbers_get_the_conditions_that_a_prompt_would_get() -> None:
    hover: Doc = {
        'id': 'r2', 'kind': 'mission', 'ref': 'm1', 'uav': 'uav1', 'mode': 'hover',
        'target': 'City Hall', 'altitude_m': 40, 'duration_s': 10,
    }  # fmt: skip
    plain, judged = reference_spec(asked(hover)), reference_spec(asked(hover), judged=True)
    assert condition_ids(judged) - condition_ids(plain) == {'m1.altitude', 'm1.duration'}


def test_a_number_has_the_span_that_states_it_and_a_derived_one_the_prompt() -> None:
    mission = reference_spec(asked({**ORBIT, 'duration_s': 25}), judged=True).missions[0]
    assert mission.altitude_m.provenance is Provenance.EXPLICIT
    spans = {}
    for name in ('altitude_m', 'radius_m', 'speed_mps', 'duration_s'):
        span = getattr(mission, name).span
        spans[name] = TEXT[span.start : span.end]
    assert spans == {
        'altitude_m': '40 m', 'radius_m': '50 m', 'speed_mps': '8 m/s', 'duration_s': TEXT,
    }  # fmt: skip


def test_turns_are_asked_for_and_counted() -> None:
    text = 'A drone flies two turns around Harbor Market on an orbit of 50 m radius at 8 m/s.'
    prompt = asked({**ORBIT, 'target': 'Harbor Market', 'turns': 2}, text=text)
    spec = reference_spec(prompt, judged=True)
    turns = spec.missions[0].turns
    assert turns is not None
    assert turns.span is not None
    assert (turns.value, turns.provenance) == (2.0, Provenance.EXPLICIT)
    assert 'two' in text[turns.span.start : turns.span.end]
    assert 'm1.turn' in condition_ids(spec)


def test_what_is_not_annotated_stays_a_default() -> None:
    mission = reference_spec(asked({**ORBIT, 'pattern': 'rectangle'}), judged=True).missions[0]
    assert mission.size_m is not None
    assert {p.provenance for p in mission.size_m} == {Provenance.DEFAULT}


@pytest.mark.parametrize(
    ('ends', 'approximate', 'bound'),
    [
        ((36, 44), True, Bound.EXACTLY),
        ((39, 41), False, Bound.EXACTLY),
        ((40, 120), False, Bound.AT_LEAST),
        ((3, 40), False, Bound.AT_MOST),
        ((38, 40), False, Bound.EXACTLY),
    ],
)
def test_a_range_says_how_a_number_binds(
    ends: tuple[float, float], approximate: bool, bound: Bound
) -> None:
    prompt = asked(ORBIT, variation={'r2.altitude_m': ends})
    altitude = reference_spec(prompt, judged=True).missions[0].altitude_m
    assert (altitude.approximate, altitude.bound) == (approximate, bound)


def test_one_clause_names_every_element() -> None:
    car: Doc = {'id': 'r3', 'kind': 'agent', 'ref': 'car1', 'type': 'car'}
    none: Doc = {'id': 'r4', 'kind': 'agent', 'ref': 'no', 'type': 'bus', 'count': 0}
    (clause,) = reference_spec(asked(ORBIT, car, none), judged=True).clauses
    assert clause.text == TEXT
    assert set(clause.ids) == {'car1', 'uav1', 'm1', 'no1'}


@pytest.mark.parametrize(('away', 'metres', 'stated'), [({'avoid_m': 80}, 80.0, True), ({}, 0, 0)])
def test_a_place_to_keep_off_is_a_clearance_that_is_kept(
    away: Doc, metres: float, stated: bool
) -> None:
    text = 'Fly from Meadow Park to Union Station at 60 m, avoiding Ridge School by 80 m.'
    flight: Doc = {
        'id': 'r2', 'kind': 'mission', 'ref': 'm1', 'uav': 'uav1', 'mode': 'navigate',
        'start': 'Meadow Park', 'end': 'Union Station', 'altitude_m': 60,
        'avoid': ['Ridge School'], **away,
    }  # fmt: skip
    (kept,) = reference_spec(asked(flight, text=text), judged=True).conditions
    assert (kept.quantity, kept.op) == ('clearance', '>=')
    assert kept.of == ('uav1', 'landmark:Ridge School')
    assert kept.value.value == metres
    assert (kept.value.provenance is Provenance.EXPLICIT) is bool(stated)


def test_a_message_to_a_group_goes_to_each_of_its_members() -> None:
    text = 'A drone hovers at 30 m. After 5 s it warns three cars over a link with 20 % loss.'
    parts: tuple[Doc, ...] = (
        {'id': 'r2', 'kind': 'mission', 'ref': 'm1', 'uav': 'uav1', 'mode': 'hover'},
        {'id': 'r3', 'kind': 'agent', 'ref': 'cars', 'type': 'car', 'count': 3},
        {'id': 'r4', 'kind': 'link', 'sender': 'uav1', 'receiver': 'cars', 'loss': 0.2},
        {
            'id': 'r5', 'kind': 'event', 'ref': 'e1', 'trigger': {'on': 'time', 'at_s': 5},
            'action': {'do': 'send_message', 'sender': 'uav1', 'receiver': 'cars'},
        },
    )  # fmt: skip
    spec = reference_spec(asked(*parts, text=text), judged=True)
    told = [e.action.receiver for e in spec.events if isinstance(e.action, SendMessage)]
    assert sorted(told) == ['cars_1', 'cars_2', 'cars_3']
    assert [link.receiver for link in spec.links] == ['cars_1', 'cars_2', 'cars_3']
    assert {link.loss.value for link in spec.links} == {0.2}


def test_a_message_that_nobody_may_send_is_forbidden() -> None:
    text = 'A drone tracks a van at 50 m. It never warns the van.'
    parts: tuple[Doc, ...] = (
        {'id': 'r2', 'kind': 'agent', 'ref': 'van1', 'type': 'van'},
        {
            'id': 'r3', 'kind': 'mission', 'ref': 'm1', 'uav': 'uav1', 'mode': 'track',
            'target': 'van1',
        },
        {
            'id': 'r4', 'kind': 'event', 'ref': 'e1', 'negate': True,
            'action': {'do': 'send_message', 'sender': 'uav1', 'receiver': 'van1'},
        },
    )  # fmt: skip
    spec = reference_spec(asked(*parts, text=text), judged=True)
    (no,) = spec.prohibitions
    assert (no.forbids, no.sender, no.receiver) == ('link', 'uav1', 'van1')  # type: ignore[union-attr]
    assert spec.events == ()
    assert f'{no.id}.holds' in condition_ids(spec)


def test_a_distance_that_is_told_with_motion_is_asked_for_on_the_way() -> None:
    text = 'A car drives 30 m behind a bus. A drone circles City Hall.'
    bodies: tuple[Doc, ...] = (
        {'id': 'r3', 'kind': 'agent', 'ref': 'car1', 'type': 'car'},
        {'id': 'r4', 'kind': 'agent', 'ref': 'bus1', 'type': 'bus'},
    )
    behind: Doc = {
        'id': 'r5', 'kind': 'placement', 'agent': 'car1', 'relation': 'behind', 'of': 'bus1',
        'distance_m': 30,
    }  # fmt: skip
    told = reference_spec(asked(*bodies, {**behind, 'kept': True}, text=text), judged=True)
    start = reference_spec(asked(*bodies, behind, text=text), judged=True)
    assert told.agents[0].placements[0].keeps_distance
    assert not start.agents[0].placements[0].keeps_distance
