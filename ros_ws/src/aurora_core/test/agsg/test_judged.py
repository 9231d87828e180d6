# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What is stated and judged by nothing is found; what is judged is not called so."""

from __future__ import annotations

import pytest

from aurora_core.agsg.build import build_agsg
from aurora_core.agsg.judged import unjudged
from aurora_core.conditions.derive import derive_conditions
from aurora_core.outcomes.condition import Condition
from aurora_core.outcomes.grounding import Unjudged
from aurora_core.pipeline.functions import ground_stage, parse_stage
from aurora_core.pipeline.knowledge import installed_knowledge
from aurora_core.spec.scenario import Order, ScenarioSpec

_KNOWN = installed_knowledge()


def _unjudged(spec: ScenarioSpec) -> dict[str, Unjudged]:
    outcome = ground_stage(_KNOWN, build_agsg(spec), 1)
    assert outcome.agsg is not None
    return {one.path: one for one in outcome.unjudged}


def _parsed(prompt: str) -> ScenarioSpec:
    spec = parse_stage(_KNOWN, prompt, 'downtown', 1).spec
    assert spec is not None
    return spec


@pytest.mark.parametrize(
    'prompt',
    [
        'A drone hovers over City Hall at 50 m for 20 seconds.',
        'In rain at night a drone tracks a bus from 40 m at 30 m altitude for 30 s.',
        'A drone tracks a bus; after 20 s the bus slows to 5 m/s.',
        'In dense traffic a drone tracks a bus for 30 s.',
        'A van tailgates the ego car closely, closing from 45 meters; a tracking drone alerts the '
        'ego when the van comes within 20 meters.',
    ],
)
def test_ordinary_requests_are_judged_in_everything(prompt: str) -> None:
    assert _unjudged(_parsed(prompt)) == {}


def test_traffic_beside_a_counted_scene_is_found() -> None:
    found = _unjudged(_parsed('In dense traffic a drone tracks a bus; there is exactly one car.'))
    assert found.keys() == {'world/traffic_density'}
    assert found['world/traffic_density'].element == 'world'


def test_a_place_where_something_is_to_be_done_is_judged() -> None:
    paths = _unjudged(_parsed('A drone tracks a bus that stops at the intersection.'))
    assert [path for path in paths if path.endswith('/target')] == []


def test_the_order_of_three_missions_is_judged() -> None:
    spec = _parsed(
        'A drone hovers over City Hall at 50 m for 20 s. Then it hovers over Meadow Park at 40 m '
        'for 10 s. Then it hovers over Ridge School at 40 m for 10 s.'
    )
    one, two, three = (m.id for m in spec.missions)
    orders = (Order(id='o1', first=one, then=two), Order(id='o2', first=two, then=three))
    found = _unjudged(ScenarioSpec.model_validate({**dict(spec), 'orders': orders}))
    assert [path for path in found if path.startswith('orders/')] == []


def test_own_conditions_of_an_agent_find_nothing_that_all_conditions_do_not() -> None:
    spec = _parsed(
        'A drone tracks a bus at 30 m. A red car parks 20 m ahead of the bus, two vans follow it, '
        'and a truck drives at 8 m/s while 4 background cars circulate.'
    )
    outcome = ground_stage(_KNOWN, build_agsg(spec), 1)
    assert outcome.agsg is not None
    grounded, schedule = outcome.agsg.grounding, outcome.agsg.schedule
    assert grounded is not None
    assert schedule is not None
    tables = (schedule.facts, _KNOWN.limits, _KNOWN.tolerances)

    def derive(asked: ScenarioSpec, agent: str | None = None) -> tuple[Condition, ...]:
        made = derive_conditions(asked, *tables, agent).conditions
        # Without those of one agent: nothing depends on what that one is to do.
        return tuple(c for c in made if not c.id.startswith('truck1.'))

    slow = unjudged(spec, derive(spec), derive)
    fast = unjudged(spec, derive(spec), derive, derive)
    assert {one.element for one in slow} >= {'truck1'}
    assert fast == slow
