# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The graph as a message and back; whatever does not match the documents is refused."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import pytest

from aurora_core.agsg.build import build_agsg
from aurora_core.agsg.message import agsg_message, read_agsg
from aurora_core.conditions.derive import derive_conditions
from aurora_core.errors import SpecError
from aurora_core.knowledge.limits import Limits, Tolerances
from aurora_core.outcomes.agsg import Agsg, AgsgTexts, Stage
from aurora_core.outcomes.grounded import GroundedScenario
from aurora_core.spec.scenario import ScenarioSpec
from aurora_core.temporal.schedule import plan_time
from aurora_core.trace.definitions import message_definitions
from aurora_core.trace.messages import MessageBuilder

TYPE = 'aurora_msgs/msg/Agsg'


@pytest.fixture
def agsg(
    read_prompt: Callable[..., ScenarioSpec],
    ground: Callable[..., GroundedScenario],
    limits: Limits,
    tolerances: Tolerances,
) -> Agsg:
    """A grounded graph with everything in it."""
    spec = read_prompt('tailgate')
    grounded = ground(spec)
    schedule = plan_time(spec, grounded, limits, tolerances)
    conditions = derive_conditions(spec, schedule.facts, limits, tolerances).conditions
    return build_agsg(
        spec,
        map_digest=grounded.map_digest,
        stage=Stage.CHECKED,
        iteration=2,
        grounding=grounded,
        schedule=schedule,
        conditions=conditions,
    )


def _message(agsg: Agsg) -> Any:
    """Return the message as it comes off the wire."""
    definitions = message_definitions()
    header = MessageBuilder(definitions, 1, 0.05).header(0)
    message = agsg_message(definitions.create, header, 'r1', agsg)
    return definitions.decode(TYPE, definitions.encode(TYPE, message))


def _stamp(message: Any) -> None:
    """Give a message the digest of its documents."""
    message.sha256 = AgsgTexts(
        spec=message.spec_json,
        grounding=message.grounding_json,
        schedule=message.schedule_json,
        conditions=message.conditions_json,
    ).sha256


def test_the_graph_comes_back_whole(agsg: Agsg) -> None:
    message = _message(agsg)
    assert read_agsg(message) == agsg
    assert message.run_id == 'r1'
    assert message.sha256 == agsg.sha256
    assert (message.iteration, message.stage) == (2, 2)


def test_a_graph_without_grounding_comes_back(read_prompt: Callable[..., ScenarioSpec]) -> None:
    agsg = build_agsg(read_prompt('convoy'), map_digest='ab')
    assert read_agsg(_message(agsg)) == agsg


@pytest.mark.parametrize(
    'field', ['spec_json', 'grounding_json', 'schedule_json', 'conditions_json', 'sha256']
)
def test_a_changed_document_is_refused(agsg: Agsg, field: str) -> None:
    message = _message(agsg)
    text = getattr(message, field)
    place = text.index('1')
    setattr(message, field, text[:place] + '2' + text[place + 1 :])
    with pytest.raises(SpecError):
        read_agsg(message)


def _node(message: Any) -> Any:
    return message.nodes[1]


def _edge(message: Any) -> Any:
    return message.edges[0]


def _parameter(message: Any) -> Any:
    return next(p for p in message.parameters if p.span_start >= 0)


@pytest.mark.parametrize(
    ('part', 'field', 'value'),
    [
        (_node, 'id', 'other'),
        (_node, 'type', 2),
        (_node, 'label', 'truck'),
        (_edge, 'source', 'ego2'),
        (_edge, 'target', 'world'),
        (_edge, 'type', 3),
        (_edge, 'label', 'under'),
        (_parameter, 'path', 'missions/m9/altitude_m'),
        (_parameter, 'owner', 'ego'),
        (_parameter, 'requested', 1.0),
        (_parameter, 'realised', 1.0),
        (_parameter, 'low', -1.0),
        (_parameter, 'high', 1e9),
        (_parameter, 'unit', 'deg'),
        (_parameter, 'provenance', 2),
        (_parameter, 'span_start', 3),
        (_parameter, 'span_end', 999),
    ],
)
def test_a_changed_typed_field_is_refused(
    agsg: Agsg, part: Callable[[Any], Any], field: str, value: Any
) -> None:
    message = _message(agsg)
    element = part(message)
    assert getattr(element, field) != value
    setattr(element, field, value)
    with pytest.raises(SpecError, match='do not match its documents'):
        read_agsg(message)


@pytest.mark.parametrize('field', ['map_name', 'map_digest'])
def test_another_map_than_that_of_the_documents_is_refused(agsg: Agsg, field: str) -> None:
    message = _message(agsg)
    setattr(message, field, 'elsewhere')
    with pytest.raises(SpecError, match='map do not match'):
        read_agsg(message)


@pytest.mark.parametrize('group', ['nodes', 'edges', 'parameters'])
def test_a_lost_element_is_refused(agsg: Agsg, group: str) -> None:
    message = _message(agsg)
    getattr(message, group).pop()
    with pytest.raises(SpecError, match=group):
        read_agsg(message)


@pytest.mark.parametrize(
    ('field', 'value'),
    [('spec_json', '{}'), ('spec_json', 'no JSON'), ('spec_json', ''), ('stage', 200)],
)
def test_what_cannot_be_read_is_refused(agsg: Agsg, field: str, value: Any) -> None:
    message = _message(agsg)
    setattr(message, field, value)
    _stamp(message)
    with pytest.raises(SpecError, match='cannot be read'):
        read_agsg(message)


@pytest.mark.parametrize(
    ('field', 'value'),
    [('grounding_json', '[1]'), ('grounding_json', '{'), ('conditions_json', '{"a": 1}')],
)
def test_signed_nonsense_is_refused(agsg: Agsg, field: str, value: str) -> None:
    """A sender whose documents are nonsense, under a digest that fits."""
    message = _message(agsg)
    setattr(message, field, value)
    _stamp(message)
    with pytest.raises(SpecError, match='cannot be read'):
        read_agsg(message)


def test_a_document_of_another_version_is_told_by_its_own_digest(agsg: Agsg) -> None:
    """Another version writes the same document otherwise; its digest stays what it was."""
    message = _message(agsg)
    texts = replace(agsg.texts, schedule=agsg.texts.schedule.replace(':', ': '))
    message.schedule_json, message.sha256 = texts.schedule, texts.sha256
    read = read_agsg(message)
    assert read.schedule == agsg.schedule
    assert read.sha256 == texts.sha256 != agsg.sha256
