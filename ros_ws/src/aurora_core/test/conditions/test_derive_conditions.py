# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What a request asks for: every table of the contract, and what cannot be said yet."""

from __future__ import annotations

from types import ModuleType
from typing import Any

import pytest
from pydantic import ValidationError

from aurora_core.conditions.derive import Derivation, derive_conditions
from aurora_core.errors import VerificationError
from aurora_core.judging.build import number_target
from aurora_core.judging.codec import conditions_from_json
from aurora_core.outcomes.condition import Condition, conditions_to_json
from aurora_core.spec.events import actor_of
from aurora_core.spec.parameter import Bound, Provenance, Unit
from aurora_core.spec.scenario import Event
from aurora_core.stl.syntax import format_formula, parse_formula


def _derive(tb: ModuleType, case: Any) -> Derivation:
    return derive_conditions(case.spec, case.facts, tb.LIMITS, tb.TOLERANCES)


def _by_id(derivation: Derivation) -> dict[str, Condition]:
    return {condition.id: condition for condition in derivation.conditions}


def _ids(derivation: Derivation) -> set[str]:
    return {c.id for c in derivation.conditions if not c.id.startswith('safety.')}


def test_the_tailgating_prompt(tb: ModuleType) -> None:
    derivation = _derive(tb, tb.tailgate_case())
    assert derivation.underivable == ()
    assert _ids(derivation) == {
        'm1.order', 'm1.capture', 'm1.completed', 'm1.tracked', 'm1.visible', 'uav1.landed',
        'van1.placed', 'van1.placed.distance', 'van1.tailgate', 'van1.tailgate.from_start',
        'van1.tailgate.from_closing', 'e1.within', 'e1.not_before', 'e1.after_capture',
        'e1.actor_visible', 'e1.delivered', 'scene.car', 'scene.van', 'scene.uav',
    }  # fmt: skip
    found = _by_id(derivation)
    assert found['van1.tailgate'].formula == (
        'eventually (always [0, 5] s (time_gap(van1,ego) < 1 s))'
    )
    assert found['m1.tracked'].formula == 'tracked_fraction(uav1,van1) >= 0.8 1'
    assert found['van1.placed.distance'].formula == 'distance_behind(van1,ego) == 45 +- 1 m'
    assert found['van1.placed.distance'].provenance is Provenance.EXPLICIT


def test_the_survey_prompt(tb: ModuleType) -> None:
    case = tb.survey_case(altitude_m=tb.number(30.0, explicit=True))
    assert _ids(_derive(tb, case)) == {
        'm1.order', 'm1.capture', 'm1.completed', 'm1.altitude', 'm1.waypoints', 'm1.closed',
        'm1.over_streets', 'm1.centre', 'uav1.landed', 'scene.car', 'scene.uav',
    }  # fmt: skip


def test_the_convoy_prompt(tb: ModuleType) -> None:
    derivation = _derive(tb, tb.convoy_case())
    assert derivation.underivable == ()
    assert _ids(derivation) == {
        'm1.order', 'm1.capture', 'm1.completed', 'm1.tracked', 'm1.visible', 'uav1.landed',
        'bus1.placed', 'bus1.placed.distance', 'bus1.placed.distance_kept', 'bus1.placed.kept',
        'bus1.drive', 'ambulance1.placed', 'ambulance1.placed.kept', 'ambulance1.follow',
        'car1.circulate', 'scene.ambulance', 'scene.bus', 'scene.car', 'scene.uav',
    }  # fmt: skip


def test_every_run_is_kept_safe(tb: ModuleType) -> None:
    found = {c.id for c in _derive(tb, tb.convoy_case()).conditions if c.id.startswith('safety.')}
    flights = [
        'clearance',
        'altitude_max',
        'altitude_min',
        'altitude_command',
        'speed',
        'speed_command',
    ]
    flights += ['climb', 'descent', 'no_fly', 'endurance']
    assert found == {
        'safety.collision',
        'safety.presence',
        'safety.jump',
        'safety.vehicle_speed',
    } | {f'safety.{name}.uav1' for name in flights}


def test_a_scene_of_one_body_has_nothing_to_collide_with(tb: ModuleType) -> None:
    case = tb.tailgate_case()
    case.spec = tb.spec(agents=(tb.agent('walker1', 'pedestrian'),))
    assert {c.id for c in _derive(tb, case).conditions} == {
        'scene.pedestrian', 'safety.presence', 'safety.jump', 'safety.pedestrian_speed'
    }  # fmt: skip


def test_a_request_that_ends_in_flight_need_not_land(tb: ModuleType) -> None:
    case = tb.survey_case(ends_in_flight=True)
    assert 'uav1.landed' not in _ids(_derive(tb, case))


@pytest.mark.parametrize(
    ('value', 'tolerance', 'bound', 'approximate', 'text'),
    [
        (40.0, 'placement_vehicle_m', Bound.EXACTLY, False, '== 40 +- 1 m'),
        (80.0, 'placement_vehicle_m', Bound.EXACTLY, False, '== 80 +- 1.6 m'),
        (20.0, 'placement_other_m', Bound.EXACTLY, False, '== 20 +- 2 m'),
        (100.0, 'altitude_m', Bound.EXACTLY, False, '== 100 +- 3 m'),
        (35.0, 'standoff_m', Bound.EXACTLY, False, '== 35 +- 5 m'),
        (40.0, 'placement_vehicle_m', Bound.EXACTLY, True, '== 40 +- 4 m'),
        (40.0, 'altitude_m', Bound.AT_LEAST, False, '>= 40 m'),
        (40.0, 'altitude_m', Bound.AT_MOST, False, '<= 40 m'),
    ],
)
def test_explicit_numbers_get_the_larger_tolerance(
    tb: ModuleType, value: float, tolerance: str, bound: Bound, approximate: bool, text: str
) -> None:
    parameter = tb.number(value, explicit=True, bound=bound)
    parameter = type(parameter).model_validate(dict(parameter) | {'approximate': approximate})
    assert number_target(parameter, getattr(tb.TOLERANCES, tolerance)).text == text


def test_what_cannot_be_said_yet_is_reported(tb: ModuleType) -> None:
    case = tb.tailgate_case()
    spec = case.spec
    agents = (
        tb.agent(
            'ego',
            'car',
            role='ego',
            placements=({'relation': 'on', 'of': 'sidewalk'}, {'relation': 'parked_at'}),
            behaviors=(
                {'kind': 'yield'},
                {'kind': 'follow'},
                {
                    'kind': 'wait',
                    'speed_mps': tb.number(8.0, Unit.METRE_PER_SECOND, explicit=True),
                },
            ),
        ),
        spec.agents[1],
    )
    events = (
        {'id': 'e2', 'action': {'do': 'cross', 'agent': 'ego'}},
        {'id': 'e3'},
        {'id': 'e4', 'action': {'do': 'send_message', 'sender': 'ego', 'receiver': 'van1'}},
    )
    conditions = (
        {
            'id': 'c1',
            'quantity': 'speed',
            'of': ('uav1', 'ego'),
            'op': '<=',
            'value': tb.number(1.0, Unit.METRE_PER_SECOND),
        },
        {
            'id': 'c2',
            'quantity': 'hover_drift',
            'of': ('uav1',),
            'op': '<=',
            'value': tb.number(1.0),
        },
    )
    case.spec = tb.spec(
        **{**dict(spec), 'agents': agents, 'events': events, 'conditions': conditions}
    )
    found = {(u.element, u.what) for u in _derive(tb, case).underivable}
    assert found == {
        ('ego', 'behaviour yield'),
        ('ego', 'behaviour follow'),
        ('ego', 'speed of 8 m/s while it waits'),
        ('e3', 'an event without trigger and action'),
        ('e4', 'message from ego to van1: no link'),
        ('l1', 'a link without a message'),
        ('c2', 'hover_drift without a mission of uav1'),
    }


def test_a_lossy_link_without_retransmissions_asks_for_no_delivery(tb: ModuleType) -> None:
    case = tb.tailgate_case()
    (link,) = case.spec.links
    lossy = dict(link) | {
        'loss': tb.number(0.3, Unit.ONE, explicit=True),
        'retransmissions': tb.number(0.0, Unit.ONE, explicit=True),
    }
    case.spec = tb.spec(**{**dict(case.spec), 'links': (lossy,)})
    derivation = _derive(tb, case)
    assert 'e1.delivered' not in _ids(derivation)
    assert 'l1.ratio' in _ids(derivation)
    assert derivation.underivable == ()


def test_a_message_that_an_event_needs_has_to_arrive_however_lossy_its_link(
    tb: ModuleType,
) -> None:
    case = tb.tailgate_case()
    (link,), (event,) = case.spec.links, case.spec.events
    lossy = dict(link) | {
        'loss': tb.number(0.3, Unit.ONE, explicit=True),
        'retransmissions': tb.number(0.0, Unit.ONE, explicit=True),
    }
    waits = {
        'id': 'e2',
        'trigger': {'on': 'message_received', 'by': 'ego'},
        'action': {'do': 'brake', 'agent': 'ego'},
    }
    case.spec = tb.spec(**{**dict(case.spec), 'links': (lossy,), 'events': (event, waits)})
    assert {'e1.delivered', 'l1.ratio'} <= _ids(_derive(tb, case))


def test_the_actor_is_who_is_not_told(tb: ModuleType) -> None:
    trigger = {'on': 'distance_below', 'a': 'ego', 'b': 'van1', 'value_m': tb.number(20.0)}
    told = {'do': 'send_message', 'sender': 'uav1', 'receiver': 'ego'}
    event = Event.model_validate({'id': 'e1', 'trigger': trigger, 'action': told})
    assert actor_of(event) == 'van1'
    event = Event.model_validate(
        {'id': 'e1', 'trigger': dict(trigger) | {'a': 'van1', 'b': 'ego'}}
    )
    assert actor_of(event) == 'van1'
    time = {'on': 'time', 'at_s': tb.number(3.0, Unit.SECOND)}
    assert actor_of(Event.model_validate({'id': 'e1', 'trigger': time})) is None


def test_a_report_of_ones_own_altitude_need_not_wait_for_the_ascent(tb: ModuleType) -> None:
    case = tb.tailgate_case()
    (event,) = case.spec.events
    own = {'on': 'altitude_reached', 'uav': 'uav1', 'value_m': tb.number(15.0)}
    up = Event.model_validate({**dict(event), 'trigger': own})
    case.spec = case.spec.model_copy(update={'events': (up,)})
    found = _ids(_derive(tb, case))
    assert {'e1.within', 'e1.not_before', 'e1.delivered'} <= found
    assert 'e1.after_capture' not in found


def test_a_message_at_a_stated_time_waits_for_the_ascent(tb: ModuleType) -> None:
    case = tb.tailgate_case()
    (event,) = case.spec.events
    at_s = tb.number(3.0, Unit.SECOND, explicit=True)
    timed = {**dict(event), 'trigger': {'on': 'time', 'at_s': at_s}}
    case.spec = case.spec.model_copy(update={'events': (Event.model_validate(timed),)})
    found = _ids(_derive(tb, case))
    assert {'e1.time', 'e1.within', 'e1.delivered', 'e1.after_capture'} <= found


def test_facts_that_do_not_fit_are_refused(tb: ModuleType) -> None:
    case = tb.survey_case()
    case.facts = case.facts.model_validate({'horizon_s': 90.0})
    with pytest.raises(VerificationError, match='no facts of mission m1'):
        _derive(tb, case)
    case = tb.survey_case()
    (facts,) = case.facts.missions
    short = dict(facts) | {'waypoints': facts.waypoints[:1]}
    case.facts = case.facts.model_validate({'horizon_s': 90.0, 'missions': (short,)})
    with pytest.raises(VerificationError, match='the plan has 1 points of another shape'):
        _derive(tb, case)
    none = dict(facts) | {'waypoints': ()}
    case.facts = case.facts.model_validate({'horizon_s': 90.0, 'missions': (none,)})
    with pytest.raises(VerificationError, match='no waypoints for mission m1'):
        _derive(tb, case)
    case = tb.hover_case()
    (facts,) = case.facts.missions
    nowhere = dict(facts) | {'hover_point': None}
    case.facts = case.facts.model_validate({'horizon_s': 90.0, 'missions': (nowhere,)})
    with pytest.raises(VerificationError, match='no hover point'):
        _derive(tb, case)


@pytest.mark.parametrize('name', ['tailgate_case', 'survey_case', 'convoy_case', 'hover_case'])
def test_conditions_travel_as_one_byte_exact_text(tb: ModuleType, name: str) -> None:
    conditions = _derive(tb, getattr(tb, name)()).conditions
    text = conditions_to_json(conditions)
    assert conditions_from_json(text) == conditions
    assert conditions_to_json(conditions_from_json(text)) == text
    for condition in conditions:
        formula = parse_formula(condition.formula)
        assert parse_formula(format_formula(formula)) == formula


def test_conditions_that_cannot_be_read_are_refused(tb: ModuleType) -> None:
    conditions = _derive(tb, tb.hover_case()).conditions
    with pytest.raises(VerificationError, match='cannot be read'):
        conditions_from_json('[{}]')
    twice = conditions_to_json((conditions[0], conditions[0]))
    with pytest.raises(VerificationError, match='unique'):
        conditions_from_json(twice)


@pytest.mark.parametrize(
    ('values', 'text'),
    [
        ({'formula': 'other(uav1) >= 3 m'}, 'is over'),
        ({'formula': 'not a formula'}, 'expected'),
        ({'scale': 0.0}, 'scale'),
    ],
)
def test_a_condition_fits_its_formula(tb: ModuleType, values: dict[str, Any], text: str) -> None:
    condition = _derive(tb, tb.hover_case()).conditions[0]
    with pytest.raises(ValidationError, match=text):
        Condition.model_validate(dict(condition) | values)


def test_zero_satisfies_unless_the_comparison_is_strict(tb: ModuleType) -> None:
    found = _by_id(_derive(tb, tb.convoy_case()))
    assert found['m1.tracked'].satisfied(0.0)
    assert not found['safety.collision'].satisfied(0.0)
    assert not found['m1.tracked'].satisfied(-1e-300)


def _until(tb: ModuleType, *, explicit: bool) -> set[str]:
    """Return the conditions of a hover until 40 s, with its duration stated or by default."""
    case = tb.hover_case()
    (mission,) = case.spec.missions
    stays = tb.number(20.0, Unit.SECOND, explicit=explicit)
    at = {'on': 'time', 'at_s': tb.number(40.0, Unit.SECOND, explicit=True)}
    event = {'id': 'e1', 'trigger': at, 'action': {'do': 'land', 'uav': mission.uav}}
    case.spec = tb.spec(
        **dict(case.spec)
        | {
            'missions': (mission.model_copy(update={'duration_s': stays}),),
            'events': (Event.model_validate(event),),
        }
    )
    return _ids(_derive(tb, case))


def test_a_mission_until_an_event_has_no_duration_of_its_own(tb: ModuleType) -> None:
    assert 'm1.completed' not in _until(tb, explicit=False)
    assert 'm1.duration' in _until(tb, explicit=True)


def test_going_round_a_place_is_more_than_driving(tb: ModuleType) -> None:
    case = tb.convoy_case()
    round_it = {'kind': 'circulate', 'target': 'landmark:City Hall'}
    agents = [
        dict(a) | ({'behaviors': (round_it,)} if a.id == 'car1' else {}) for a in case.spec.agents
    ]
    case.spec = tb.spec(**dict(case.spec) | {'agents': agents})
    derivation = _derive(tb, case)
    assert ('car1', 'behaviour circulate') in {(u.element, u.what) for u in derivation.underivable}
    assert 'car1.circulate' not in _ids(derivation)


def test_a_pattern_keeps_no_distance_from_its_place(tb: ModuleType) -> None:
    case = tb.survey_case()
    away = tb.number(25.0, explicit=True)
    missions = [dict(m) | {'standoff_m': away} for m in case.spec.missions]
    case.spec = tb.spec(**dict(case.spec) | {'missions': missions})
    found = {(u.element, u.what) for u in _derive(tb, case).underivable}
    assert ('m1', 'a distance of a pattern from its place') in found
