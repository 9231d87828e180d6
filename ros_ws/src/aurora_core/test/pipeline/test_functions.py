# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What a recording is compared with: worked out anew it is the same, on this map and another."""

from __future__ import annotations

import json
from dataclasses import replace
from typing import Any

import pytest

from aurora_core.agsg.build import build_agsg
from aurora_core.errors import VerificationError
from aurora_core.execution.plan import Execution
from aurora_core.judging.codec import conditions_from_json
from aurora_core.knowledge.basis import Basis
from aurora_core.knowledge.world import WorldModel
from aurora_core.monitor.plan_check import Held, NotComparable, Plan, held_against, plan_findings
from aurora_core.outcomes.agsg import Agsg
from aurora_core.outcomes.condition import conditions_to_json
from aurora_core.outcomes.grounded import GroundedScenario
from aurora_core.outcomes.parse import ParseOutcome
from aurora_core.outcomes.schedule import Schedule
from aurora_core.pipeline.functions import execution_stage, ground_stage, parse_stage, understood
from aurora_core.pipeline.knowledge import installed_knowledge
from aurora_core.pipeline.verification import recorded_plan
from aurora_core.spec.scenario import ScenarioSpec

_KNOWN = installed_knowledge()

PROMPT = (
    'A van tailgates the ego car closely, closing from 45 meters; a tracking drone alerts the ego '
    'when the van comes within 20 meters.'
)


@pytest.fixture(scope='module')
def grounded() -> tuple[Agsg, Execution]:
    parsed = parse_stage(_KNOWN, PROMPT, 'downtown', 1).agsg
    assert parsed is not None
    agsg = ground_stage(_KNOWN, parsed, 1).agsg
    assert agsg is not None
    return agsg, execution_stage(_KNOWN, agsg, 1, ())


def altered(agsg: Agsg, **texts: str) -> Agsg:
    """The graph with other documents, given as texts."""
    told = replace(agsg.texts, **texts)
    return build_agsg(
        agsg.spec,
        map_digest=agsg.map_digest,
        stage=agsg.stage,
        grounding=GroundedScenario.model_validate_json(told.grounding) if told.grounding else None,
        schedule=Schedule.model_validate_json(told.schedule),
        conditions=conditions_from_json(told.conditions),
    )


def worked_out(world: WorldModel, agsg: Agsg) -> Plan | NotComparable:
    return recorded_plan(_KNOWN, world, conditions_from_json(world.conditions_json), agsg)


def plan_of(world: WorldModel, agsg: Agsg) -> Plan:
    plan = worked_out(world, agsg)
    assert isinstance(plan, Plan)
    return plan


def test_what_is_recorded_is_what_the_request_gives(grounded: tuple[Agsg, Execution]) -> None:
    agsg, execution = grounded
    plan = plan_of(execution.world, agsg)
    recorded = conditions_from_json(execution.world.conditions_json)
    assert recorded
    assert plan.foreign == ()
    assert plan_findings(recorded, execution.roster, execution.world, plan) == ()


def test_a_forged_grounding_shows_in_the_conditions(grounded: tuple[Agsg, Execution]) -> None:
    agsg, execution = grounded
    # 30 m, the altitude that was chosen, becomes 90 m in the grounding alone.
    forged = altered(
        agsg, grounding=agsg.texts.grounding.replace('"altitude_m":30.0', '"altitude_m":90.0')
    )
    assert forged.texts.grounding != agsg.texts.grounding
    plan = plan_of(execution.world, forged)
    recorded = conditions_from_json(execution.world.conditions_json)
    found = plan_findings(recorded, execution.roster, execution.world, plan)
    assert 'condition' in {finding.kind for finding in found}


def regrounded(agsg: Agsg, **changes: object) -> Agsg:
    """The graph with another grounding, and the digest of its basis in order."""
    document = json.loads(agsg.texts.grounding) | changes
    if isinstance(document['basis'], dict):
        document['configuration'] = Basis.model_validate(document['basis']).sha256
    grounding = GroundedScenario.model_validate_json(json.dumps(document))
    return altered(agsg, grounding=grounding.canonical_json())


def basis_of(agsg: Agsg, table: str, **changes: object) -> dict[str, Any]:
    basis = json.loads(agsg.texts.grounding)['basis']
    if table == 'version':
        return {**basis, **changes}
    return {**basis, table: {**basis[table], **changes}}


def held(execution: Execution, world: WorldModel, agsg: Agsg, *, as_recorded: bool) -> Held:
    conditions = conditions_from_json(world.conditions_json)
    plan = worked_out(world, agsg)
    return held_against(conditions, execution.roster, world, plan, as_recorded=as_recorded)


def names(held: Held) -> set[tuple[str, str]]:
    return {(finding.kind, finding.subject) for finding in held.findings}


def test_limits_of_the_world_alone_are_named(grounded: tuple[Agsg, Execution]) -> None:
    agsg, execution = grounded
    limits = type(execution.world.limits).model_validate(
        dict(execution.world.limits) | {'clearance_min_m': 0.1}
    )
    world = replace(execution.world, limits=limits)
    for as_recorded in (False, True):
        found = held(execution, world, agsg, as_recorded=as_recorded)
        assert names(found) == {('world', 'limits')}


@pytest.mark.parametrize('configuration', ['f' * 64, ''])
def test_a_foreign_digest_does_not_switch_the_derivation_off(
    grounded: tuple[Agsg, Execution], configuration: str
) -> None:
    agsg, execution = grounded
    document = json.loads(agsg.texts.grounding) | {'configuration': configuration}
    conditions = conditions_from_json(agsg.texts.conditions)
    kept = conditions_to_json(conditions[3:])
    forged = altered(agsg, grounding=json.dumps(document), conditions=kept)
    world = replace(execution.world, conditions_json=kept)
    for as_recorded in (False, True):
        found = names(held(execution, world, forged, as_recorded=as_recorded))
        assert ('configuration', 'digest') in found
        assert {('condition', c.id) for c in conditions[:3]} <= found


def test_what_was_loosened_is_derived_as_recorded_and_named(
    grounded: tuple[Agsg, Execution],
) -> None:
    agsg, execution = grounded
    tight = json.loads(agsg.texts.grounding)['basis']['tolerances']['altitude_m']
    loose = tight | {'absolute': 50.0}
    forged = regrounded(agsg, basis=basis_of(agsg, 'tolerances', altitude_m=loose))
    plan = plan_of(execution.world, forged)
    ours = {c.id: c for c in conditions_from_json(agsg.texts.conditions)}
    changed = [c for c in plan.conditions if c != ours[c.id]]
    assert changed
    # With conditions and times that go with it nothing is left but the difference to what is
    # installed.
    text = conditions_to_json(plan.conditions)
    forged = altered(forged, conditions=text)
    world = replace(execution.world, conditions_json=text)
    assert ('graph', 'schedule') in names(held(execution, world, forged, as_recorded=True))
    assert agsg.schedule is not None
    forged = altered(forged, schedule=agsg.schedule.without_times.canonical_json())
    found = held(execution, world, forged, as_recorded=False)
    assert names(found) == {('configuration', 'tolerances.altitude_m.absolute')}
    assert '50.0 (here' in found.findings[0].text
    told = held(execution, world, forged, as_recorded=True)
    assert told.findings == ()
    assert any('tolerances.altitude_m.absolute 50.0 (here' in note for note in told.notes)


def test_a_recording_with_other_limits_is_judged_by_them_when_asked_to(
    grounded: tuple[Agsg, Execution],
) -> None:
    agsg, execution = grounded
    other = regrounded(agsg, basis=basis_of(agsg, 'limits', uav_endurance_s=900.0))
    plan = plan_of(execution.world, other)
    text = conditions_to_json(plan.conditions)
    assert 'at most 900 s' in text
    world = replace(execution.world, limits=plan.world.limits, conditions_json=text)
    recorded = altered(other, conditions=text)
    assert names(held(execution, world, recorded, as_recorded=False)) == {
        ('configuration', 'limits.uav_endurance_s')
    }
    assert held(execution, world, recorded, as_recorded=True).findings == ()


def test_a_setting_that_is_another_here_is_named(grounded: tuple[Agsg, Execution]) -> None:
    agsg, execution = grounded
    run = json.loads(agsg.texts.grounding)['basis']['settings']['run'] | {'settle_s': 9.0}
    other = regrounded(agsg, basis=basis_of(agsg, 'settings', run=run))
    found = held(execution, execution.world, other, as_recorded=False)
    assert names(found) == {('configuration', 'settings.run.settle_s')}


def test_what_another_version_derives_is_only_told_as_recorded(
    grounded: tuple[Agsg, Execution],
) -> None:
    agsg, execution = grounded
    other = regrounded(agsg, basis=basis_of(agsg, 'version', version='0.0.9'))
    kept = conditions_to_json(conditions_from_json(agsg.texts.conditions)[1:])
    other = altered(other, conditions=kept)
    world = replace(execution.world, conditions_json=kept)
    kinds = {kind for kind, _ in names(held(execution, world, other, as_recorded=False))}
    assert kinds == {'configuration', 'condition'}
    told = held(execution, world, other, as_recorded=True)
    assert told.findings == ()
    assert any('derives it otherwise: condition' in note for note in told.notes)


@pytest.mark.parametrize('basis', [None, 'other entries'])
def test_without_a_basis_that_can_be_read_nothing_is_claimed(
    grounded: tuple[Agsg, Execution], basis: str | None
) -> None:
    agsg, execution = grounded
    value = None if basis is None else basis_of(agsg, 'tolerances', of_tomorrow=1.0)
    older = regrounded(agsg, basis=value)
    assert isinstance(worked_out(execution.world, older), NotComparable)
    found = held(execution, execution.world, older, as_recorded=False)
    assert names(found) == {('configuration', 'record')}
    assert 'as recorded' in found.findings[0].text
    assert held(execution, execution.world, older, as_recorded=True).findings == ()


def test_a_map_that_is_not_installed_is_named_and_the_rest_of_the_world_compared(
    grounded: tuple[Agsg, Execution],
) -> None:
    agsg, execution = grounded
    digest = '0' * 64
    elsewhere = regrounded(agsg, map_digest=digest)
    world = replace(execution.world, map_digest=digest)
    assert names(held(execution, world, elsewhere, as_recorded=False)) == {
        ('configuration', 'map')
    }
    assert held(execution, world, elsewhere, as_recorded=True).findings == ()
    foggy = replace(world, weather='fog')
    for as_recorded in (False, True):
        found = names(held(execution, foggy, elsewhere, as_recorded=as_recorded))
        assert ('world', 'weather') in found
    # The digest changed in one place only.
    found = names(held(execution, execution.world, elsewhere, as_recorded=True))
    assert ('world', 'map_digest') in found


def test_graph_and_world_have_to_tell_the_same(grounded: tuple[Agsg, Execution]) -> None:
    agsg, execution = grounded
    conditions = conditions_from_json(agsg.texts.conditions)
    other = altered(agsg, conditions=conditions_to_json(conditions[1:]))
    assert names(held(execution, execution.world, other, as_recorded=True)) == {
        ('graph', 'conditions')
    }
    schedule = json.loads(agsg.texts.schedule)
    schedule['horizon_s'] += 1.0
    other = altered(agsg, schedule=json.dumps(schedule))
    assert ('graph', 'schedule') in names(
        held(execution, execution.world, other, as_recorded=True)
    )


def test_a_graph_without_a_grounding_cannot_be_judged(
    grounded: tuple[Agsg, Execution],
) -> None:
    agsg, execution = grounded
    with pytest.raises(VerificationError, match='does not fit'):
        worked_out(execution.world, altered(agsg, grounding=''))


def test_a_uav_without_a_mission_is_grounded_as_one_that_hovers() -> None:
    spec = parse_stage(_KNOWN, PROMPT, 'downtown', 1).spec
    assert spec is not None
    idle = {'id': 'relay', 'span': None}
    with_relay = ScenarioSpec.model_validate(
        {**spec.model_dump(), 'uavs': [*spec.model_dump()['uavs'], idle]}
    )
    parsed = understood(_KNOWN, ParseOutcome(spec=with_relay)).agsg
    assert parsed is not None
    assert parsed.spec.missions[-1].uav == 'relay'
    agsg = ground_stage(_KNOWN, parsed, 1).agsg
    assert agsg is not None
    assert agsg.grounding is not None
    assert [u.id for u in agsg.grounding.uavs] == ['uav1', 'relay']
    ids = {c.id for c in conditions_from_json(agsg.texts.conditions)}
    assert {'relay.landed', f'{agsg.spec.missions[-1].id}.drift'} <= ids
