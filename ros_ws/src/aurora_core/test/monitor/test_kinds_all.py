# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""No kind of condition without a run that satisfies it, one that violates it, one without it."""

from __future__ import annotations

from collections import defaultdict
from functools import cache
from itertools import pairwise
from pathlib import Path
from typing import get_args

import numpy as np
import pytest
from kind_rows import Outcome, Row, all_rows, kind_of, trace_part

from aurora_core.judging.quantities.placement import Placed
from aurora_core.monitor.online import OnlineMonitor
from aurora_core.outcomes.condition import Condition
from aurora_core.outcomes.verdict import Reason
from aurora_core.spec.quantity import QuantityName
from aurora_core.spec.scenario import AgentAction, ScenarioSpec, SendMessage, UavAction
from aurora_core.spec.vocabulary import BehaviorKind, Relation
from aurora_core.stl.online import OnlineVerdict

FOLDER = Path(__file__).parent
OUTCOMES = frozenset(Outcome)


@cache
def _seen() -> tuple[dict[str, set[Outcome]], set[str]]:
    """Return the outcomes that the tables show of each kind, and all kinds of their requests."""
    shown: dict[str, set[Outcome]] = defaultdict(set)
    asked: set[str] = set()
    for row in all_rows():
        conditions = row.conditions()
        asked.update(kind_of(condition) for condition in conditions)
        mine = next(condition for condition in conditions if condition.id == row.id)
        for kind in _kinds(mine, row.request()[0]):
            shown[kind].add(row.outcome(mine))
    return shown, asked


def _kinds(condition: Condition, spec: ScenarioSpec) -> set[str]:
    what = condition.id.partition('.')[2]
    kinds = {condition.quantity.value, kind_of(condition), f'behaviour {what}'}
    if what == 'placed':
        assert isinstance(condition.arguments, Placed)
        kinds.add(f'relation {condition.arguments.relation}')
    if what == 'within':
        (event,) = (e for e in spec.events if e.id == condition.arguments.event)
        assert event.action is not None
        kinds.add(f'action {event.action.do}')
    return kinds


@pytest.mark.parametrize('quantity', list(QuantityName))
def test_every_quantity_has_its_three_runs(quantity: QuantityName) -> None:
    shown, _ = _seen()
    assert shown[quantity.value] == OUTCOMES


def test_every_reading_of_a_quantity_has_its_three_runs() -> None:
    shown, asked = _seen()
    assert {kind: shown[kind] for kind in asked if shown[kind] != OUTCOMES} == {}


@pytest.mark.parametrize('kind', list(BehaviorKind))
def test_every_behaviour_has_its_three_runs(kind: BehaviorKind) -> None:
    shown, _ = _seen()
    assert shown[f'behaviour {kind.value}'] == OUTCOMES


@pytest.mark.parametrize('relation', list(Relation))
def test_every_placement_has_its_three_runs(relation: Relation) -> None:
    shown, _ = _seen()
    assert shown[f'relation {relation}'] == OUTCOMES


ACTIONS = [
    do
    for action in (SendMessage, AgentAction, UavAction)
    for do in get_args(action.model_fields['do'].annotation)
]


@pytest.mark.parametrize('do', ACTIONS)
def test_every_action_has_its_three_runs(do: str) -> None:
    shown, _ = _seen()
    assert shown[f'action {do}'] == OUTCOMES


def test_the_tables_of_the_stated_quantities_know_their_shares() -> None:
    _, asked = _seen()
    series = ('distance', 'horizontal_distance', 'separation', 'altitude', 'speed')
    assert {f'{quantity}/share' for quantity in series} <= asked


@pytest.mark.parametrize('row', all_rows(), ids=lambda row: row.name)
def test_while_the_run_goes_on_the_margin_stays_inside_its_bounds(row: Row) -> None:
    case = row.make()
    # Beside the condition those that it is about, and those that say which missions and events
    # there are.
    every = row.conditions()
    kept = {k for c in every if c.id == row.id for k in getattr(c.arguments, 'kept', ())}
    conditions = tuple(
        c
        for c in every
        if c.id in {row.id} | kept or c.arguments.event is not None or c.id.endswith('.order')
    )
    trace = case.run.trace()
    end = min(case.run.missing, default=trace.ticks)
    marks = sorted({0, *np.linspace(1, end, 7).astype(int).tolist()})
    monitor: OnlineMonitor | None = None
    for start, stop in pairwise(marks):
        part = trace_part(trace, start, stop)
        if monitor is None:
            monitor = OnlineMonitor(case.world, case.spec, conditions, part)
        else:
            monitor.extend(part)
        (look,) = (o for o in monitor.outlooks() if o.condition_id == row.id)
        if row.margin is None:
            # Of a record that was cut short, "has driven far enough" may be known before.
            known = row.reason is Reason.TRACE_SHORT
            assert known or look.verdict is not OnlineVerdict.TRUE
        else:
            assert look.low - row.within <= row.margin <= look.high + row.within
    if row.margin is not None and not case.run.missing:
        assert look.now == pytest.approx(row.margin, abs=row.within)
