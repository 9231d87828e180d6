# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""A trigger that had to move is carried out where it was moved; the request stays."""

from __future__ import annotations

from typing import Any

import pytest

from aurora_core.execution.scenario_executor import ExecutionSetup
from aurora_core.judging.codec import conditions_from_json
from aurora_core.monitor.plan_check import Plan
from aurora_core.outcomes.agsg import Agsg
from aurora_core.outcomes.parse import ParseOutcome
from aurora_core.pipeline.functions import execution_stage, ground_stage, parse_stage, understood
from aurora_core.pipeline.knowledge import installed_knowledge
from aurora_core.pipeline.verification import recorded_plan
from aurora_core.spec.scenario import DistanceTrigger, ScenarioSpec

_KNOWN = installed_knowledge()
PATH = 'events/e1/trigger/value_m'
PROMPT = (
    'A van tailgates the ego car closely, closing from 45 meters; a tracking drone alerts the ego '
    'when the van comes within 20 meters.'
)


@pytest.fixture(scope='module')
def graph() -> Agsg:
    """A grounded graph whose trigger is a default that holds from the start on."""
    spec = parse_stage(_KNOWN, PROMPT, 'downtown', 1).spec
    assert spec is not None
    document = spec.model_dump()
    near = {'value': 60.0, 'unit': 'm', 'low': 1.0, 'high': 500.0, 'provenance': 'default'}
    document['events'][0]['trigger']['value_m'] = near
    parsed = understood(_KNOWN, ParseOutcome(spec=ScenarioSpec.model_validate(document))).agsg
    assert parsed is not None
    found = ground_stage(_KNOWN, parsed, 1).agsg
    assert found is not None
    return found


def _value(spec: ScenarioSpec) -> float:
    trigger = spec.events[0].trigger
    assert isinstance(trigger, DistanceTrigger)
    return trigger.value_m.value


def _findings(agsg: Agsg) -> set[tuple[str, str]]:
    world = execution_stage(_KNOWN, agsg, 1, ()).world
    plan = recorded_plan(_KNOWN, world, conditions_from_json(world.conditions_json), agsg)
    assert isinstance(plan, Plan)
    return {(finding.kind, finding.subject) for finding in plan.documents}


def test_the_request_stays_and_the_plan_moves(graph: Agsg) -> None:
    assert _value(graph.spec) == 60.0
    assert _value(graph.realised_spec) == pytest.approx(43.0)
    [parameter] = [p for p in graph.parameters if p.path == PATH]
    assert parameter.requested == 60.0
    assert parameter.realised == pytest.approx(43.0)


def test_the_executor_waits_for_the_moved_trigger(
    graph: Agsg, monkeypatch: pytest.MonkeyPatch
) -> None:
    asked: list[ScenarioSpec] = []

    def setup(**parts: Any) -> ExecutionSetup:
        asked.append(parts['spec'])
        return ExecutionSetup(**parts)

    monkeypatch.setattr('aurora_core.execution.plan.ExecutionSetup', setup)
    execution_stage(_KNOWN, graph, 1, ())
    assert [_value(spec) for spec in asked] == [pytest.approx(43.0)]


def test_a_recording_with_another_value_is_found(graph: Agsg) -> None:
    assert graph.grounding is not None
    assert _findings(graph) == set()
    rows = tuple(
        row.model_copy(update={'realised': 44.0}) if row.path == PATH else row
        for row in graph.grounding.realised
    )
    forged = graph.grounding.model_copy(update={'realised': rows})
    assert ('graph', 'triggers') in _findings(graph.model_copy(update={'grounding': forged}))
