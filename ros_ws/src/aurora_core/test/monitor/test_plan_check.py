# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Conditions, bodies and world that are not those of the recorded request are found."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from types import ModuleType
from typing import Any

import pytest

from aurora_core.conditions.derive import derive_conditions
from aurora_core.knowledge.limits import Limits
from aurora_core.monitor.plan_check import Plan, plan_findings
from aurora_core.monitor.verify import verify
from aurora_core.outcomes.condition import Condition
from aurora_core.outcomes.verdict import VerdictStatus

Recorded = dict[str, Any]


def _laxer(recorded: Recorded) -> None:
    first, *rest = recorded['conditions']
    values = dict(first) | {'threshold': first.threshold - 1.0}
    recorded['conditions'] = (Condition.model_validate(values), *rest)


def _horizon(recorded: Recorded) -> None:
    first, *rest = recorded['conditions']
    arguments = first.arguments.model_copy(update={'horizon_s': 1.0})
    values = dict(first) | {'arguments': arguments}
    recorded['conditions'] = (Condition.model_validate(values), *rest)


def _dropped(recorded: Recorded) -> None:
    recorded['conditions'] = recorded['conditions'][1:]


def _none(recorded: Recorded) -> None:
    recorded['conditions'] = ()


def _smaller(recorded: Recorded) -> None:
    roster = recorded['roster']
    van = replace(roster.agents[1], length_m=0.5)
    recorded['roster'] = replace(roster, agents=(roster.agents[0], van))


def _stranger(recorded: Recorded) -> None:
    roster = recorded['roster']
    more = replace(roster.agents[0], body_id='car9')
    recorded['roster'] = replace(roster, agents=(*roster.agents, more))


def _slower(recorded: Recorded) -> None:
    recorded['roster'] = replace(recorded['roster'], dt_s=0.1)


def _building_removed(recorded: Recorded) -> None:
    recorded['world'] = replace(recorded['world'], buildings=())


def _building_lower(recorded: Recorded) -> None:
    world = recorded['world']
    low = replace(world.buildings[0], height_m=1.0)
    recorded['world'] = replace(world, buildings=(low, *world.buildings[1:]))


def _weather(recorded: Recorded) -> None:
    recorded['world'] = replace(recorded['world'], weather='fog')


def _limits(recorded: Recorded) -> None:
    limits = Limits.model_validate(dict(recorded['world'].limits) | {'clearance_min_m': 0.5})
    recorded['world'] = replace(recorded['world'], limits=limits)


@pytest.mark.parametrize(
    ('forge', 'kind', 'text'),
    [
        (_laxer, 'condition', 'threshold is recorded as'),
        (_horizon, 'condition', 'arguments: horizon_s is recorded as 1.0'),
        (_dropped, 'condition', 'the request implies it, it is not recorded'),
        (_none, 'condition', 'more'),
        (_smaller, 'roster', 'length_m is recorded as 0.5'),
        (_stranger, 'roster', 'not part of the grounding'),
        (_slower, 'roster', 'time step recorded as 0.1 s'),
        (_building_removed, 'world', '0 recorded, map and grounding give 1'),
        (_building_lower, 'world', 'is recorded otherwise'),
        (_weather, 'world', 'recorded as fog'),
        (_limits, 'world', 'recorded as'),
    ],
)
def test_what_the_request_does_not_give_is_found(
    tb: ModuleType, forge: Callable[[Recorded], None], kind: str, text: str
) -> None:
    case = tb.tailgate_case()
    world = tb.world(buildings=[tb.building(-500.0, 300.0, -480.0, 320.0, 10.0)])
    conditions = derive_conditions(case.spec, case.facts, tb.LIMITS, tb.TOLERANCES).conditions
    trace = case.run.trace()
    plan = Plan(conditions=conditions, roster=trace.roster, world=world, seed=1)
    honest = verify(trace, world, conditions, case.spec, plan)
    assert honest.status is VerdictStatus.VERIFIED
    recorded = {'conditions': conditions, 'roster': trace.roster, 'world': world}
    forge(recorded)
    found = plan_findings(recorded['conditions'], recorded['roster'], recorded['world'], plan)
    assert {f.kind for f in found} == {kind}
    assert any(text in f.text for f in found), [f.text for f in found]


def test_a_laxer_threshold_makes_the_verdict_inconclusive(tb: ModuleType) -> None:
    case = tb.tailgate_case(lost=4)
    conditions = derive_conditions(case.spec, case.facts, tb.LIMITS, tb.TOLERANCES).conditions
    trace = case.run.trace()
    plan = Plan(conditions=conditions, roster=trace.roster, world=case.world, seed=1)
    kept = tuple(c for c in conditions if c.id != 'e1.delivered')
    verdict = verify(trace, case.world, kept, case.spec, plan)
    assert all(r.satisfied for r in verdict.results)
    assert verdict.status is VerdictStatus.INCONCLUSIVE
    found = [f.subject for f in verdict.cross_check if f.kind == 'condition']
    assert found == ['e1.delivered']
