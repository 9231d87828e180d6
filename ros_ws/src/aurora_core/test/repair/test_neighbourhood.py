# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from typing import Any

import pytest

from aurora_core.outcomes.agsg import Agsg
from aurora_core.outcomes.repair import Anchor, RepairPlan, ValueEdit, with_values
from aurora_core.pipeline.functions import ground_stage, parse_stage
from aurora_core.pipeline.knowledge import installed_knowledge
from aurora_core.repair.helps import ANCHOR
from aurora_core.repair.neighbourhood import outside

_KNOWN = installed_knowledge()
ALTITUDE = 'missions/m1/altitude_m'


def edit(agsg: Agsg, path: str, realised: float) -> ValueEdit:
    row = next(p for p in agsg.parameters if p.path == path)
    return ValueEdit(
        path=path, requested=row.requested, realised=realised, provenance=row.provenance
    )


def grounded_so(agsg: Agsg, **plan: Any) -> Agsg:
    found = ground_stage(_KNOWN, agsg, 1, RepairPlan(**plan)).agsg
    assert found is not None
    return found


@pytest.fixture(scope='module')
def here(agsg: Agsg) -> Anchor:
    assert agsg.grounding is not None
    return Anchor(lane=agsg.grounding.anchor_lane, position_m=agsg.grounding.anchor_position_m)


@pytest.fixture(scope='module')
def higher(agsg: Agsg, here: Anchor) -> Agsg:
    return grounded_so(agsg, kept=here, values=(edit(agsg, ALTITUDE, 55.0),))


def without_grounded(agsg: Agsg, **changes: Any) -> Agsg:
    assert agsg.grounding is not None
    return agsg.model_copy(update={'grounding': agsg.grounding.model_copy(update=changes)})


def test_what_follows_from_an_edit_of_the_neighbourhood_is_inside(
    agsg: Agsg, higher: Agsg
) -> None:
    assert higher.grounding != agsg.grounding
    assert list(outside(agsg, higher, {ALTITUDE})) == []


def test_an_edit_that_no_violation_asks_for_is_outside(agsg: Agsg, higher: Agsg) -> None:
    [why] = outside(agsg, higher, {ANCHOR, 'missions/m1/standoff_m'})
    assert why == f'{ALTITUDE} is moved and is not in the neighbourhood'


def test_another_place_is_an_edit_of_its_own(agsg: Agsg, here: Anchor) -> None:
    away = grounded_so(agsg, avoided=(here,))
    assert list(outside(agsg, away, {ANCHOR})) == []
    [why] = outside(agsg, away, {ALTITUDE})
    assert ANCHOR in why


def test_a_body_that_nothing_moved_leads_to_stays_where_it_is(agsg: Agsg) -> None:
    assert agsg.grounding is not None
    first, *rest = agsg.grounding.agents
    shifted = first.model_copy(update={'x_m': first.x_m + 1.0})
    planted = without_grounded(agsg, agents=(shifted, *rest))
    [why] = outside(agsg, planted, {ALTITUDE, ANCHOR})
    assert why.startswith(f'{first.id} is placed otherwise')


def test_every_value_of_the_request_is_compared(agsg: Agsg) -> None:
    other = agsg.model_copy(update={'spec': with_values(agsg.spec, (edit(agsg, ALTITUDE, 50.0),))})
    assert 'the request is another one' in list(outside(agsg, other, {ALTITUDE}))
    for k, row in enumerate(agsg.parameters):
        wider = row.model_copy(update={'high': row.high + 1.0})
        rows = (*agsg.parameters[:k], wider, *agsg.parameters[k + 1 :])
        changed = agsg.model_copy(update={'parameters': rows})
        assert list(outside(agsg, changed, {row.path})) == [f'{row.path} has another high']


def test_a_threshold_moves_with_what_it_hangs_on_alone(agsg: Agsg) -> None:
    k, judged = next((k, c) for k, c in enumerate(agsg.conditions) if c.id == 'van1.tailgate')
    easier = judged.model_copy(update={'threshold': judged.threshold + 1.0})
    conditions = (*agsg.conditions[:k], easier, *agsg.conditions[k + 1 :])
    planted = agsg.model_copy(update={'conditions': conditions})
    [why] = outside(agsg, planted, {ALTITUDE})
    assert why.startswith('van1.tailgate has another threshold')


def test_what_is_to_happen_before_the_run_ends_moves_with_its_end_alone(agsg: Agsg) -> None:
    planned = agsg.schedule
    assert planned is not None
    end_s = planned.horizon_s

    def ending(horizon_s: float, threshold: float) -> Agsg:
        schedule = planned.model_copy(update={'horizon_s': horizon_s})
        rows = tuple(
            c.model_copy(update={'threshold': threshold}) if c.id == 'van1.tailgate' else c
            for c in agsg.conditions
        )
        return agsg.model_copy(update={'schedule': schedule, 'conditions': rows})

    before = ending(end_s, end_s)
    assert list(outside(before, ending(end_s + 9.0, end_s + 9.0), set())) == []
    [why] = outside(before, ending(end_s + 9.0, end_s + 10.0), set())
    assert why.startswith('van1.tailgate has another threshold')


def test_a_request_without_that_element_is_no_realisation_of_it() -> None:
    first = parse_stage(_KNOWN, 'A drone hovers over the ego car.', 'downtown', 1).agsg
    assert first is not None
    assert list(outside(first, first, set())) == ['one of both is not grounded']
