# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from collections.abc import Callable, Mapping

import pytest

from aurora_core.outcomes.agsg import Agsg, AgsgParameter
from aurora_core.outcomes.repair import (
    Attempt,
    AttemptOutcome,
    Implicated,
    RepairPlan,
    Step,
    ValueEdit,
)
from aurora_core.outcomes.verdict import Verdict
from aurora_core.repair.attempts import anchor_of
from aurora_core.repair.localize import localize
from aurora_core.repair.objective import objective
from aurora_core.repair.settings import load_repair_settings
from aurora_core.repair.values import one_parameter, searched
from aurora_core.spec.parameter import Provenance

Failing = Callable[..., Verdict]
SETTINGS = load_repair_settings()
ALTITUDE, STANDOFF = 'missions/m1/altitude_m', 'missions/m1/standoff_m'


def row_of(agsg: Agsg, path: str) -> AgsgParameter:
    return next(row for row in agsg.parameters if row.path == path)


def attempt(agsg: Agsg, margins: Mapping[str, float], **values: float) -> Attempt:
    assert agsg.grounding is not None
    paths = {'altitude': ALTITUDE, 'standoff': STANDOFF}
    edits = tuple(
        ValueEdit(
            path=paths[name],
            requested=row_of(agsg, paths[name]).requested,
            realised=value,
            provenance=row_of(agsg, paths[name]).provenance,
        )
        for name, value in values.items()
    )
    return Attempt(
        iteration=0,
        step=Step.ONE if edits else None,
        plan=RepairPlan(values=edits),
        outcome=AttemptOutcome.VIOLATED,
        anchor=anchor_of(agsg.grounding),
        margins=margins,
    )


def test_a_first_edit_goes_the_way_that_helps_and_stays_at_its_place(
    agsg: Agsg, failing: Failing
) -> None:
    implicated = localize(agsg, failing(m1__visible=-0.4))
    higher = next(i for i in implicated if i.field == ALTITUDE and i.direction > 0)
    past = (attempt(agsg, {'m1.visible': -0.4}),)
    found = list(one_parameter(agsg, higher, implicated, past, SETTINGS))
    values = [proposal.plan.values[0].realised for proposal in found]
    # A quarter and more of the room from 30 m to 120 m.
    assert values == [pytest.approx(52.5), pytest.approx(84.0), pytest.approx(111.0)]
    assert agsg.grounding is not None
    assert found[0].plan.kept == anchor_of(agsg.grounding)
    assert found[0].plan.avoided == ()


def test_the_next_edit_goes_where_the_secant_reaches_the_margin_aimed_at(
    agsg: Agsg, failing: Failing
) -> None:
    implicated = localize(agsg, failing(m1__visible=-0.4))
    higher = next(i for i in implicated if i.field == ALTITUDE and i.direction > 0)
    past = (
        attempt(agsg, {'m1.visible': -0.4}),
        attempt(agsg, {'m1.visible': -0.1}, altitude=52.5),
    )
    first = next(one_parameter(agsg, higher, implicated, past, SETTINGS))
    aim = 52.5 + (SETTINGS.epsilon + 0.1) * 22.5 / 0.3
    assert first.plan.values[0].realised == pytest.approx(aim)


def test_several_values_are_moved_as_single_edits_have_shown(agsg: Agsg) -> None:
    implicated = tuple(
        Implicated(field=path, score=1.0, direction=1, conditions=('a', 'b'), reason='r')
        for path in (ALTITUDE, STANDOFF)
    )
    past = (
        attempt(agsg, {'a': -0.2, 'b': -0.2, 'c': 1.0}),
        attempt(agsg, {'a': 0.7, 'b': -0.3, 'c': 1.0}, altitude=52.5),
        attempt(agsg, {'a': -0.3, 'b': 0.5, 'c': 0.9}, standoff=37.5),
    )
    found = list(searched(agsg, implicated, past, SETTINGS))
    assert [proposal.step for proposal in found] == [Step.SEARCH] * 9
    # The smaller steps of both reach the margin; larger ones only change more.
    best = found[0]
    assert {e.path: e.realised for e in best.plan.values} == {ALTITUDE: 52.5, STANDOFF: 37.5}
    assert best.predicted == {
        'a': pytest.approx(0.6),
        'b': pytest.approx(0.4),
        'c': pytest.approx(0.9),
    }


def test_no_edit_weighs_more_than_the_margin_it_mends(agsg: Agsg) -> None:
    row = row_of(agsg, ALTITUDE)
    low = objective([-0.4, 1.0], [(row, 0.0)], SETTINGS)
    assert low == pytest.approx(SETTINGS.epsilon + 0.4)
    moved = objective([0.2, 1.0], [(row, 22.5)], SETTINGS)
    share = 22.5 / (row.high - row.low)
    assert moved == pytest.approx(SETTINGS.lambda_sem * SETTINGS.weights.default * share)
    inferred = row.model_copy(update={'provenance': Provenance.INFERRED})
    assert objective([0.2], [(inferred, 22.5)], SETTINGS) > moved
    assert low > moved
