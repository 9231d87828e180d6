# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What a recording is compared with: worked out anew it is the same, on this map and another."""

from __future__ import annotations

import json
from dataclasses import replace

import pytest

from aurora_core.agsg.build import build_agsg
from aurora_core.agsg.graph import Agsg
from aurora_core.conditions.condition import conditions_from_json
from aurora_core.errors import VerificationError
from aurora_core.execution.plan import Execution
from aurora_core.grounding.grounded import GroundedScenario
from aurora_core.knowledge.world import WorldModel
from aurora_core.monitor.plan_check import NotComparable, Plan, plan_findings
from aurora_core.pipeline.functions import (
    execution_stage,
    ground_stage,
    parse_stage,
    recorded_plan,
)
from aurora_core.spec.scenario import ScenarioSpec

PROMPT = (
    'A van tailgates the ego car closely, closing from 45 meters; a tracking drone alerts the ego '
    'when the van comes within 20 meters.'
)


@pytest.fixture(scope='module')
def grounded() -> tuple[Agsg, Execution]:
    spec = parse_stage(PROMPT, 'downtown', 1).spec
    assert spec is not None
    agsg = ground_stage(build_agsg(spec), 1).agsg
    assert agsg is not None
    return agsg, execution_stage(agsg, 1, ())


def altered(agsg: Agsg, **documents: str) -> Agsg:
    return Agsg.model_validate(dict(agsg) | documents)


def plan_of(world: WorldModel, agsg: Agsg) -> Plan:
    plan = recorded_plan(world, agsg)
    assert isinstance(plan, Plan)
    return plan


def test_what_is_recorded_is_what_the_request_gives(grounded: tuple[Agsg, Execution]) -> None:
    agsg, execution = grounded
    plan = plan_of(execution.world, agsg)
    recorded = conditions_from_json(execution.world.conditions_json)
    assert recorded
    assert plan.world is not None
    assert plan_findings(recorded, execution.roster, execution.world, plan) == ()


def test_a_forged_grounding_shows_in_the_conditions(grounded: tuple[Agsg, Execution]) -> None:
    agsg, execution = grounded
    # 30 m, the altitude that was chosen, becomes 90 m in the grounding alone.
    forged = altered(
        agsg, grounding_json=agsg.grounding_json.replace('"altitude_m":30.0', '"altitude_m":90.0')
    )
    assert forged.grounding_json != agsg.grounding_json
    plan = plan_of(execution.world, forged)
    recorded = conditions_from_json(execution.world.conditions_json)
    found = plan_findings(recorded, execution.roster, execution.world, plan)
    assert 'condition' in {finding.kind for finding in found}


def test_limits_of_another_installation_are_named(grounded: tuple[Agsg, Execution]) -> None:
    agsg, execution = grounded
    limits = type(execution.world.limits).model_validate(
        dict(execution.world.limits) | {'clearance_min_m': 0.1}
    )
    world = replace(execution.world, limits=limits)
    plan = plan_of(world, agsg)
    found = plan_findings(plan.conditions, execution.roster, world, plan)
    assert [(finding.kind, finding.subject) for finding in found] == [('world', 'limits')]


def test_with_another_configuration_the_bag_speaks_for_itself(
    grounded: tuple[Agsg, Execution],
) -> None:
    agsg, execution = grounded
    document = json.loads(agsg.grounding_json)
    document['configuration'] = 'f' * 64
    plan = recorded_plan(execution.world, altered(agsg, grounding_json=json.dumps(document)))
    assert isinstance(plan, NotComparable)
    assert 'as recorded' in plan.why


def test_a_map_that_is_not_installed_leaves_the_world_as_recorded(
    grounded: tuple[Agsg, Execution],
) -> None:
    agsg, execution = grounded
    elsewhere = altered(
        agsg, grounding_json=agsg.grounding_json.replace('"downtown"', '"atlantis"')
    )
    assert plan_of(execution.world, elsewhere).world is None
    digest = execution.world.map_digest
    older = altered(agsg, grounding_json=agsg.grounding_json.replace(digest, '0' * 64))
    assert plan_of(execution.world, older).world is None


@pytest.mark.parametrize('grounding', ['', '{}', 'nonsense'])
def test_a_graph_without_a_grounding_cannot_be_judged(
    grounded: tuple[Agsg, Execution], grounding: str
) -> None:
    agsg, execution = grounded
    with pytest.raises(VerificationError, match='does not fit'):
        recorded_plan(execution.world, altered(agsg, grounding_json=grounding))


def test_a_uav_without_a_mission_is_grounded_as_one_that_hovers() -> None:
    spec = parse_stage(PROMPT, 'downtown', 1).spec
    assert spec is not None
    idle = {'id': 'relay', 'span': None}
    with_relay = ScenarioSpec.model_validate(
        {**spec.model_dump(), 'uavs': [*spec.model_dump()['uavs'], idle]}
    )
    agsg = ground_stage(build_agsg(with_relay), 1).agsg
    assert agsg is not None
    assert agsg.spec.missions[-1].uav == 'relay'
    uavs = GroundedScenario.model_validate_json(agsg.grounding_json).uavs
    assert [u.id for u in uavs] == ['uav1', 'relay']
    ids = {c.id for c in conditions_from_json(agsg.conditions_json)}
    assert {'relay.landed', f'{agsg.spec.missions[-1].id}.drift'} <= ids
