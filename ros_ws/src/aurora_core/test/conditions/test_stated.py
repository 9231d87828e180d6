# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Stated conditions: what each becomes, and what cannot be said of them yet."""

from __future__ import annotations

from types import ModuleType
from typing import Any

import pytest

from aurora_core.conditions.derive import Derivation, derive_conditions
from aurora_core.judging.quantities.speed import Speed, SpeedAfterMoving
from aurora_core.judging.quantities.visible_time import VisibleTime
from aurora_core.outcomes.condition import Condition, Window
from aurora_core.spec.parameter import Span, Unit
from aurora_core.spec.requirements import STATED_QUANTITIES


def _derive(
    tb: ModuleType, case: Any, quantity: str, of: tuple[str, ...], **more: Any
) -> Derivation:
    values = {'op': '<=', 'value': tb.number(10.0, STATED_QUANTITIES[quantity])} | more
    stated = {'id': 'c1', 'quantity': quantity, 'of': of} | values
    case.spec = tb.spec(**{**dict(case.spec), 'conditions': (stated,)})
    return derive_conditions(case.spec, case.facts, tb.LIMITS, tb.TOLERANCES)


def _stated(derivation: Derivation) -> list[Condition]:
    return [c for c in derivation.conditions if not c.implied]


def _two_hovers(tb: ModuleType) -> Any:
    """uav1 hovers twice; the missions are said in clauses of their own."""
    case = tb.hover_case()
    (one,), (facts,) = case.spec.missions, case.facts.missions
    spans = (Span(start=0, end=9), Span(start=10, end=19))
    missions = [dict(one) | {'id': f'm{k}', 'span': spans[k - 1]} for k in (1, 2)]
    case.spec = tb.spec(**{**dict(case.spec), 'missions': tuple(missions)})
    case.facts = tb.facts_of(
        facts, facts.model_validate(dict(facts) | {'mission': 'm2'}), horizon_s=70.0
    )
    return case


def test_a_limit_on_a_flight_counts_in_every_mission(tb: ModuleType) -> None:
    (one,) = _stated(_derive(tb, _two_hovers(tb), 'altitude', ('uav1',)))
    assert one.arguments.window is Window.ON_MISSION
    assert [m.mission for m in one.arguments.missions] == ['m1', 'm2']


def test_a_limit_in_the_clause_of_a_mission_counts_there(tb: ModuleType) -> None:
    said = Span(start=12, end=15)
    (one,) = _stated(_derive(tb, _two_hovers(tb), 'altitude', ('uav1',), span=said))
    assert one.arguments.window is Window.PHASE
    assert one.arguments.mission is not None
    assert one.arguments.mission.mission == 'm2'


def test_a_limit_on_drift_is_one_condition_per_hover(tb: ModuleType) -> None:
    made = _stated(_derive(tb, _two_hovers(tb), 'hover_drift', ('uav1',)))
    assert [c.id for c in made] == ['c1.holds.m1', 'c1.holds.m2']


@pytest.mark.parametrize(
    ('quantity', 'of', 'extra', 'what'),
    [
        ('altitude', ('uav1',), 'hold_s', 'a stretch over several missions'),
        ('hover_drift', ('uav1',), 'hold_s', 'stretch of hover_drift'),
        ('visible_fraction', ('uav1', 'ego'), 'fraction', 'share of visible_fraction'),
        ('visible_time', ('uav1', 'ego'), 'by_s', 'deadline of visible_time'),
        (
            'tracked_fraction',
            ('uav1', 'ego'),
            '',
            'tracked_fraction without a mission of uav1, ego',
        ),
        ('speed', ('intersection',), '', 'condition on speed of intersection'),
        ('distance', ('uav1',), '', 'condition on distance of uav1'),
        ('separation', ('uav1', 'uav1'), '', 'condition on separation of uav1, uav1'),
        ('delivered', ('uav1', 'ego'), '', 'delivered without a link of uav1, ego'),
        ('waypoints_visited', ('uav1',), '', 'waypoints_visited without a mission of uav1'),
        ('landed', ('ego',), '', 'landed without a mission of ego'),
        ('landed', ('uav1',), 'hold_s', 'stretch of landed'),
        ('mission_completed', ('uav1',), '', 'mission_completed <= 10'),
    ],
)
def test_what_cannot_be_said_is_never_left_out(
    tb: ModuleType, quantity: str, of: tuple[str, ...], extra: str, what: str
) -> None:
    unit = Unit.ONE if extra == 'fraction' else Unit.SECOND
    more = {extra: tb.number(0.5, unit)} if extra else {}
    derivation = _derive(tb, _two_hovers(tb), quantity, of, **more)
    assert _stated(derivation) == []
    assert [(u.element, u.what) for u in derivation.underivable] == [('c1', what)]


@pytest.mark.parametrize(('op', 'least_s'), [('>=', 30.0), ('<=', 20.0)])
def test_a_stretch_of_sight_is_as_long_as_either_number_asks(
    tb: ModuleType, op: str, least_s: float
) -> None:
    second = {k: tb.number(v, Unit.SECOND) for k, v in (('value', 20.0), ('hold_s', 30.0))}
    made = _derive(tb, tb.convoy_case(), 'visible_time', ('uav1', 'bus1'), op=op, **second)
    (one,) = _stated(made)
    assert isinstance(one.arguments, VisibleTime)
    assert (one.arguments.unbroken, one.threshold) == (True, least_s)


def test_a_stretch_and_a_deadline_are_in_the_sentence(tb: ModuleType) -> None:
    more = {'hold_s': tb.number(4.0, Unit.SECOND), 'by_s': tb.number(9.0, Unit.SECOND)}
    (one,) = _stated(_derive(tb, tb.hover_case(), 'distance', ('uav1', 'ego'), **more))
    assert one.sentence == (
        'distance of uav1 and ego is at most 10 m for 4 s without a break by 9 s'
    )
    assert one.formula == ('eventually [0, 9] s (always [0, 4] s (distance(uav1,ego) <= 10 m))')


def test_a_share_is_told_as_people_say_it(tb: ModuleType) -> None:
    share = {'value': tb.number(0.99, Unit.ONE)}
    made = _derive(tb, tb.convoy_case(), 'visible_fraction', ('uav1', 'bus1'), op='>=', **share)
    (one,) = _stated(made)
    assert one.sentence == 'uav1 sees bus1 for at least 99 % of the time'


@pytest.mark.parametrize(
    ('quantity', 'op', 'value', 'what'),
    [
        ('delivered', '==', 0.0, ''),
        ('delivered', '==', 0.5, 'delivered == 0.5'),
        ('delivery_latency', '>=', 1.0, 'delivery_latency >='),
        ('delivery_ratio', '>=', 0.5, ''),
    ],
)
def test_what_a_link_can_be_asked(
    tb: ModuleType, quantity: str, op: str, value: float, what: str
) -> None:
    pair, number = ('uav1', 'ego'), tb.number(value, STATED_QUANTITIES[quantity])
    derivation = _derive(tb, tb.tailgate_case(), quantity, pair, op=op, value=number)
    assert [u.what for u in derivation.underivable] == ([what] if what else [])
    assert len(_stated(derivation)) == (0 if what else 1)


def test_of_what_is_not_to_arrive_no_arrival_is_asked(tb: ModuleType) -> None:
    pair, case = ('uav1', 'ego'), tb.tailgate_case()
    none, all_ = (tb.number(value, STATED_QUANTITIES['delivered']) for value in (0.0, 1.0))
    asked = {c.id for c in _derive(tb, case, 'delivered', pair, op='==', value=none).conditions}
    assert {i for i in asked if i.endswith('.delivered')} == set()
    (event,) = case.spec.events
    said = _derive(tb, tb.tailgate_case(), 'delivered', pair, op='==', value=all_)
    assert f'{event.id}.delivered' in {c.id for c in said.conditions}


def test_a_latency_to_several_is_asked_of_each_link(tb: ModuleType) -> None:
    case = tb.tailgate_case()
    (link,) = case.spec.links
    links = (dict(link), dict(link) | {'id': 'l2', 'receiver': 'bus1'})
    (event,) = case.spec.events
    told = dict(event) | {
        'id': 'e9',
        'action': {'do': 'send_message', 'sender': 'uav1', 'receiver': 'bus1'},
    }
    agents = (*case.spec.agents, {'id': 'bus1', 'type': 'bus'})
    changed = {'links': links, 'events': (event, told), 'agents': agents}
    case.spec = tb.spec(**{**dict(case.spec), **changed})
    made = _stated(_derive(tb, case, 'delivery_latency', ('uav1', 'ego', 'bus1')))
    assert [(c.id, c.of) for c in made] == [
        ('c1.holds.ego', ('uav1', 'ego')),
        ('c1.holds.bus1', ('uav1', 'bus1')),
    ]


def test_a_share_that_is_asked_exactly_has_no_tolerance(tb: ModuleType) -> None:
    value = tb.number(0.9, Unit.ONE)
    case = tb.convoy_case()
    made = _derive(tb, case, 'visible_fraction', ('uav1', 'bus1'), op='==', value=value)
    (one,) = _stated(made)
    assert one.formula == 'visible_fraction(uav1,bus1) == 0.9 +- 0 1'
    assert one.scale == pytest.approx(0.09)


def test_what_is_asked_of_several_is_asked_of_each_all_along(tb: ModuleType) -> None:
    mps = {'value': tb.number(12.0, Unit.METRE_PER_SECOND)}
    made = _stated(_derive(tb, tb.tailgate_case(), 'speed', ('van1', 'ego'), op='<=', **mps))
    assert [(c.id, c.of) for c in made] == [
        ('c1.holds.van1', ('van1',)),
        ('c1.holds.ego', ('ego',)),
    ]
    assert {c.arguments.window for c in made} == {Window.RUN}


def test_who_is_never_to_be_slower_is_so_once_it_has_been_as_fast(tb: ModuleType) -> None:
    mps = {'value': tb.number(9.0, Unit.METRE_PER_SECOND)}
    (made,) = _stated(_derive(tb, tb.tailgate_case(), 'speed', ('van1',), op='>=', **mps))
    assert isinstance(made.arguments, SpeedAfterMoving)
    assert made.arguments.moving_mps == 9.0
    assert 'from when it is first driven on' in made.sentence
    (held,) = _stated(
        _derive(
            tb,
            tb.tailgate_case(),
            'speed',
            ('van1',),
            op='>=',
            hold_s=tb.number(5.0, Unit.SECOND),
            **mps,
        )
    )
    assert isinstance(held.arguments, Speed)
