# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The time that a tick takes: of formulas alone, and of the conditions of a run."""

from __future__ import annotations

import time
from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from aurora_core.knowledge.world import WorldModel
from aurora_core.monitor.online import OnlineMonitor
from aurora_core.monitor.verify import verify
from aurora_core.outcomes.condition import Condition
from aurora_core.spec.scenario import ScenarioSpec
from aurora_core.stl.formula import predicates
from aurora_core.stl.online import OnlineRobustness
from aurora_core.stl.robustness import SampledSignals, robustness
from aurora_core.stl.syntax import parse_formula
from aurora_core.trace.trace import Trace

# What conditions ask for, ten times each: bounds, stretches, deadlines, answers in time, order.
_SHAPES = (
    'always (x >= 3 m)',
    'eventually (always [0, 5] s (x < 8 m))',
    'eventually [0, 30] s (x >= 9 m)',
    'always ((x >= 2 m) or (eventually [0, 5] s (y >= 1 m)))',
    '(x >= 0 m) until [0, 40] s (y >= 6 m)',
)
FORMULAS = 50


@dataclass(frozen=True, slots=True, kw_only=True)
class Cost:
    """What following took.

    Attributes:
        what: What was followed.
        conditions: How many.
        step: Ticks between two looks.
        ticks: Of the run.
        mean_ms: Wall time per tick.
        worst_ms: Of one look.
        equal: Whether the end was that of the offline evaluation, bit by bit.
    """

    what: str
    conditions: int
    step: int
    ticks: int
    mean_ms: float
    worst_ms: float
    equal: bool


def of_formulas(ticks: int, dt_s: float, step: int) -> Cost:
    """Follow 50 formulas over random signals, `step` samples at a time."""
    rng = np.random.default_rng(20_261)
    signals = {name: rng.uniform(0.0, 10.0, ticks) for name in ('x', 'y')}
    formulas = [parse_formula(_SHAPES[k % len(_SHAPES)]) for k in range(FORMULAS)]
    inputs = [{p.signal: signals[p.signal] for p in predicates(f)} for f in formulas]
    followed = [OnlineRobustness(formula, dt_s=dt_s) for formula in formulas]
    looks = []
    for start in range(0, ticks, step):
        begun_s = time.perf_counter()
        for monitor, own in zip(followed, inputs, strict=True):
            monitor.push({name: values[start : start + step] for name, values in own.items()})
            monitor.bounds()
        looks.append(time.perf_counter() - begun_s)
    offline = [
        robustness(formula, SampledSignals(values=own, dt_s=dt_s)).at(0)
        for formula, own in zip(formulas, inputs, strict=True)
    ]
    return Cost(
        what='formulas',
        conditions=FORMULAS,
        step=step,
        ticks=ticks,
        mean_ms=1e3 * sum(looks) / ticks,
        worst_ms=1e3 * max(looks),
        equal=[monitor.close() for monitor in followed] == offline,
    )


def of_run(
    trace: Trace,
    world: WorldModel,
    conditions: tuple[Condition, ...],
    spec: ScenarioSpec,
    step: int,
) -> Cost:
    """Follow the conditions of a recorded run, `step` ticks at a time."""
    parts = _parts(trace, step)
    begun_s = time.perf_counter()
    monitor = OnlineMonitor(world, spec, conditions, next(parts))
    outlooks = monitor.outlooks()
    looks = [time.perf_counter() - begun_s]
    for part in parts:
        begun_s = time.perf_counter()
        monitor.extend(part)
        outlooks = monitor.outlooks()
        looks.append(time.perf_counter() - begun_s)
    margins = [result.margin for result in verify(trace, world, conditions, spec).results]
    return Cost(
        what=f'conditions of a run, {len(trace.roster.agents)} agents',
        conditions=len(conditions),
        step=step,
        ticks=trace.ticks,
        # The first look also prepares the solids of the world.
        mean_ms=1e3 * sum(looks[1:]) / (trace.ticks - step),
        worst_ms=1e3 * max(looks[1:]),
        equal=[outlook.now for outlook in outlooks] == margins,
    )


def _parts(trace: Trace, step: int) -> Iterator[Trace]:
    """Yield the run in parts, each with its claims."""
    for start in range(0, trace.ticks, step):
        stop = start + step
        yield replace(
            trace.states(start, stop),
            links=tuple(record for record in trace.links if start <= record.tick < stop),
            sights=tuple(record for record in trace.sights if start <= record.tick < stop),
            events=tuple(record for record in trace.events if start <= record.tick < stop),
        )
