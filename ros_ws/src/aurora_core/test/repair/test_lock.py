# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from typing import Any

import pytest

from aurora_core.errors import SpecError
from aurora_core.outcomes.agsg import Agsg
from aurora_core.outcomes.grounding import GroundingOutcome, Unjudged
from aurora_core.outcomes.repair import RepairPlan, ValueEdit, with_values
from aurora_core.repair.lock import changes_of_the_request, locked_edits
from aurora_core.spec.parameter import Provenance

ALTITUDE = 'missions/m1/altitude_m'


def edit(agsg: Agsg, path: str, realised: float) -> ValueEdit:
    row = next(p for p in agsg.parameters if p.path == path)
    return ValueEdit(
        path=path, requested=row.requested, realised=realised, provenance=row.provenance
    )


def plan(*values: ValueEdit) -> RepairPlan:
    return RepairPlan(values=values)


def changes(before: Agsg, after: Agsg, **left_out: Any) -> list[str]:
    return list(
        changes_of_the_request(
            before, after, GroundingOutcome(agsg=before), GroundingOutcome(agsg=after, **left_out)
        )
    )


def test_a_default_may_move_inside_its_domain_alone(agsg: Agsg) -> None:
    assert list(locked_edits(agsg, plan(edit(agsg, ALTITUDE, 55.0)))) == []
    [why] = locked_edits(agsg, plan(edit(agsg, ALTITUDE, 121.0)))
    assert 'outside its domain' in why
    with pytest.raises(SpecError, match='outside'):
        with_values(agsg.spec, (edit(agsg, ALTITUDE, 121.0),))


def test_what_the_prompt_states_and_what_is_a_phase_is_locked(agsg: Agsg) -> None:
    stated = [p.path for p in agsg.parameters if p.provenance is Provenance.EXPLICIT]
    assert len(stated) >= 2
    for path in (*stated, 'missions/m1/duration_s'):
        assert list(locked_edits(agsg, plan(edit(agsg, path, 50.0)))) == [f'{path} is locked']
    for path in stated:
        with pytest.raises(SpecError, match='stated'):
            with_values(agsg.spec, (edit(agsg, path, 50.0),))


def test_an_edit_that_does_not_fit_the_request_is_refused(agsg: Agsg) -> None:
    wrong = edit(agsg, ALTITUDE, 50.0).model_copy(update={'requested': 77.0})
    with pytest.raises(SpecError, match='not what the edit says'):
        with_values(agsg.spec, (wrong,))
    nowhere = wrong.model_copy(update={'path': 'missions/m9/altitude_m'})
    with pytest.raises(SpecError, match='has no missions/m9'):
        with_values(agsg.spec, (nowhere,))


def test_an_edited_value_is_the_only_difference(agsg: Agsg) -> None:
    moved = with_values(agsg.spec, (edit(agsg, ALTITUDE, 55.0),))
    document, other = agsg.spec.model_dump(), moved.model_dump()
    assert other['missions'][0]['altitude_m'].pop('value') == 55.0
    document['missions'][0]['altitude_m'].pop('value')
    assert other == document


def test_a_condition_that_is_gone_or_weaker_is_a_change_of_the_request(agsg: Agsg) -> None:
    assert changes(agsg, agsg) == []
    fewer = agsg.model_copy(update={'conditions': agsg.conditions[1:]})
    assert changes(agsg, fewer) == [f'nothing judges {agsg.conditions[0].id} any more']
    k, stated = next(
        (k, c) for k, c in enumerate(agsg.conditions) if c.provenance is Provenance.EXPLICIT
    )
    easier = stated.model_copy(update={'threshold': stated.threshold + 5.0})
    swapped = (*agsg.conditions[:k], easier, *agsg.conditions[k + 1 :])
    weaker = agsg.model_copy(update={'conditions': swapped})
    assert changes(agsg, weaker) == [f'{stated.id} has another threshold']


def test_another_seed_or_request_and_what_is_left_out_are_changes(agsg: Agsg) -> None:
    assert agsg.grounding is not None
    drawn = agsg.grounding.model_copy(update={'seed': 2})
    assert changes(agsg, agsg.model_copy(update={'grounding': drawn})) == ['seed is another one']
    spec = with_values(agsg.spec, (edit(agsg, ALTITUDE, 55.0),))
    assert changes(agsg, agsg.model_copy(update={'spec': spec})) == ['the request is another one']
    assert changes(agsg, agsg, unsupported=('e1: nobody',)) == [
        'nobody carries out or judges e1: nobody'
    ]
    loose = Unjudged(element='e1', path='events/e1/x', what='x')
    assert changes(agsg, agsg, unjudged=(loose,)) == [
        'no condition depends on events/e1/x any more'
    ]
