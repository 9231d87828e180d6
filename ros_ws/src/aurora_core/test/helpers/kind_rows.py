# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""One row of the tables of condition kinds: a run, a condition, and its margin worked out by hand.

The tables are the `ROWS` of `test_kinds_*.py`; `test_kinds_all.py` asks for three rows per kind.
"""

from __future__ import annotations

import importlib.util
import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from enum import StrEnum
from functools import cache
from pathlib import Path

import numpy as np
import pytest
from trace_builder import LIMITS, TOLERANCES, number
from trace_cases import Case, judge, result, spec

from aurora_core.conditions.derive import derive_conditions
from aurora_core.outcomes.condition import Condition
from aurora_core.outcomes.schedule import PlanFacts
from aurora_core.outcomes.verdict import Reason
from aurora_core.spec.parameter import Unit
from aurora_core.spec.requirements import STATED_QUANTITIES
from aurora_core.spec.scenario import ScenarioSpec
from aurora_core.trace.trace import Trace

_FOLDER = Path(__file__).resolve().parents[1] / 'monitor'
# Fields that say what is measured, not by what it is judged.
_READINGS = ('side', 'part', 'after', 'setting', 'unbroken', 'background')


class Outcome(StrEnum):
    """What a row shows of a kind."""

    SATISFIED = 'satisfied'
    VIOLATED = 'violated'
    UNJUDGED = 'unjudged'  # the premise never happens, the phase is empty, the target is gone, ...


@dataclass(frozen=True, slots=True, kw_only=True)
class Row:
    """A condition on a run.

    Attributes:
        id: Of the condition.
        make: Builds the case.
        what: Tells rows of one condition and outcome apart.
        margin: By hand; None with a reason.
        within: How far a margin may be off: 0.06 where one tick more or less is open.
        reason: Why there is no margin.
    """

    id: str
    make: Callable[[], Case]
    what: str = ''
    margin: float | None = None
    within: float = 1e-6
    reason: Reason | None = None

    @property
    def name(self) -> str:
        """Name of the test."""
        outcome = 'none' if self.margin is None else 'good' if self.margin >= 0.0 else 'bad'
        return '-'.join(part for part in (self.id, outcome, self.what) if part)

    def request(self) -> tuple[ScenarioSpec, PlanFacts]:
        """The row's request and its plan; the run that was built for them is not kept."""
        return _request(self)

    def conditions(self) -> tuple[Condition, ...]:
        """All conditions of the row's request."""
        return _conditions(self)

    def outcome(self, condition: Condition) -> Outcome:
        """What the row shows of its condition."""
        if self.margin is None:
            return Outcome.UNJUDGED
        return Outcome.SATISFIED if condition.satisfied(self.margin) else Outcome.VIOLATED

    @property
    def shows(self) -> Outcome:
        """What the row shows of its condition."""
        return self.outcome(next(c for c in self.conditions() if c.id == self.id))

    def check(self) -> None:
        """Judge the run and compare."""
        found = result(judge(self.make()), self.id)
        assert found.reason is self.reason, found.explanation
        if self.margin is None:
            assert found.margin is None
            assert not found.satisfied
            assert not found.exercised
            return
        assert found.margin is not None
        assert found.margin == pytest.approx(self.margin, abs=self.within), found.explanation
        assert math.isfinite(found.margin)
        condition = next(c for c in self.conditions() if c.id == self.id)
        assert found.satisfied is (self.outcome(condition) is Outcome.SATISFIED)


@cache
def _request(row: Row) -> tuple[ScenarioSpec, PlanFacts]:
    case = row.make()
    return case.spec, case.facts


@cache
def _conditions(row: Row) -> tuple[Condition, ...]:
    return derive_conditions(*row.request(), LIMITS, TOLERANCES).conditions


def kind_of(condition: Condition) -> str:
    """Return the kind of a condition: its arguments, and which reading of them is meant."""
    kind = condition.arguments.kind
    for name, value in condition.arguments:
        if name == 'share' and value is not None:
            kind += '/share'
        elif name in _READINGS and value is not None:
            kind += f'/{value}' if isinstance(value, str) else f'/{name}' * value
    return kind


def trace_part(trace: Trace, start: int, stop: int) -> Trace:
    """Return the ticks [start, stop), which are all there, with their claims."""
    return replace(
        trace.states(start, stop),
        links=tuple(r for r in trace.links if start <= r.tick < stop),
        sights=tuple(r for r in trace.sights if start <= r.tick < stop),
        events=tuple(r for r in trace.events if start <= r.tick < stop),
        missing_ticks=(),
    )


def cut(case: Case, stop: int) -> Case:
    """End the record before a tick, as if the recorder had died."""
    run = case.run
    run.ticks, run.finished = stop, False
    for one in run.agents:
        one.x, one.y, one.speed = one.x[:stop], one.y[:stop], one.speed[:stop]
        one.present = None if one.present is None else one.present[:stop]
    for flown in run.flights:
        flown.states, flown.commands = flown.states[:stop], flown.commands[:stop]
    run.links[:] = [r for r in run.links if r.tick < stop]
    run.events[:] = [e for e in run.events if e.tick < stop]
    return case


def done_at(case: Case, stop: int) -> Case:
    """End the run before a tick: all of it is recorded."""
    cut(case, stop).run.finished = True
    return case


def gone(case: Case, agent: int, start: int, stop: int | None = None) -> Case:
    """Take an agent out of the simulation for the ticks [start, stop)."""
    ticks = np.arange(case.run.ticks)
    away = (ticks >= start) & (ticks < (case.run.ticks if stop is None else stop))
    case.run.agents[agent].present = np.where(away, 0.0, 1.0)
    return case


def grounded(case: Case) -> Case:
    """Leave all UAVs on the ground, without a command."""
    for one in case.run.flights:
        one.states[:] = one.states[0]
        one.commands[:] = 0.0
    return case


def stated(
    case: Case, quantity: str, of: tuple[str, ...], op: str, value: float, **more: float
) -> Case:
    """Add the stated condition c1; `hold_s`, `by_s` and `fraction` may follow."""
    unit = STATED_QUANTITIES[quantity]
    numbers = {
        name: number(x, Unit.ONE if name == 'fraction' else Unit.SECOND)
        for name, x in more.items()
    }
    one = {'id': 'c1', 'quantity': quantity, 'of': of, 'op': op, 'value': number(value, unit)}
    case.spec = spec(**{**dict(case.spec), 'conditions': (one | numbers,)})
    return case


def _rows(path: Path) -> tuple[Row, ...]:
    spec = importlib.util.spec_from_file_location(f'rows_of_{path.stem}', path)
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    rows: tuple[Row, ...] = module.ROWS
    return rows


@cache
def all_rows() -> tuple[Row, ...]:
    """Return the rows of all tables."""
    paths = sorted(p for p in _FOLDER.glob('test_kinds_*.py') if p.stem != 'test_kinds_all')
    return tuple(row for path in paths for row in _rows(path))
