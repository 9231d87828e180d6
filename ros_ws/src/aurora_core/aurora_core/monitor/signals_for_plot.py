# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Signal, threshold and robustness of a condition over time, for pictures."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from aurora_core.conditions.condition import Condition
from aurora_core.knowledge.world import WorldModel
from aurora_core.monitor.evaluation import Context, FloatArray, Measured
from aurora_core.monitor.measure import measure
from aurora_core.monitor.verify import sampled
from aurora_core.quantities.view import RunView
from aurora_core.spec.scenario import ScenarioSpec
from aurora_core.stl.formula import predicates
from aurora_core.stl.robustness import predicate_robustness, robustness
from aurora_core.stl.syntax import parse_formula
from aurora_core.trace.trace import Trace


@dataclass(frozen=True, slots=True, kw_only=True)
class PlotSignal:
    """A condition over time.

    Attributes:
        condition_id: Which condition.
        signal_name: What `values` are.
        times_s: (n,) simulated time of each sample.
        values: (n,) signal, in `unit`; of a share: the signal behind it.
        unit: Unit of values, threshold and robustness.
        threshold: Level that the values are compared with; None where the values are the signal
            behind a share.
        tolerance: Half width of the band around the threshold, 0 when there is none.
        robustness: (n,) robustness of the predicate at each sample; empty for a share.
        margin: Robustness of the whole formula, None when it has none.
    """

    condition_id: str
    signal_name: str
    times_s: FloatArray
    values: FloatArray
    unit: str
    threshold: float | None
    tolerance: float
    robustness: FloatArray
    margin: float | None


def signals_for_plot(
    trace: Trace, world: WorldModel, conditions: Sequence[Condition], spec: ScenarioSpec
) -> tuple[PlotSignal, ...]:
    """Return what there is to draw, one per condition that has samples."""
    view = RunView(trace, world)
    if view.first_missing_tick is not None:
        view = view.up_to(view.first_missing_tick)
    if view.ticks == 0:
        return ()
    context = Context(view, spec, tuple(conditions))
    found = (
        _plot(context, condition, measured)
        for condition in conditions
        for measured in (measure(context, condition),)
        if isinstance(measured, Measured)
    )
    return tuple(found)


def _plot(context: Context, condition: Condition, measured: Measured) -> PlotSignal:
    formula = parse_formula(condition.formula)
    margin = robustness(formula, sampled(context, condition, measured)).at(0)
    dt_s = context.view.dt_s
    if measured.plot is not None:
        ticks, values = measured.plot
        return PlotSignal(
            condition_id=condition.id,
            signal_name=condition.signal,
            times_s=ticks.astype(np.float64) * dt_s,
            values=values,
            unit='',
            threshold=None,
            tolerance=0.0,
            robustness=values[:0],
            margin=margin,
        )
    predicate = next(predicates(formula))
    return PlotSignal(
        condition_id=condition.id,
        signal_name=condition.signal,
        times_s=measured.ticks.astype(np.float64) * dt_s,
        values=measured.values,
        unit=condition.unit,
        threshold=condition.threshold,
        tolerance=predicate.tolerance,
        robustness=predicate_robustness(predicate, measured.values),
        margin=margin,
    )
