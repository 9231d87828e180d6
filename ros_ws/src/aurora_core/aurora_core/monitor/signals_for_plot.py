# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Signal, threshold and robustness of a condition over time, for pictures."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from aurora_core.judging.evaluation import BoolArray, Context, FloatArray, Measured
from aurora_core.judging.quantity import measure
from aurora_core.monitor.verify import judged_formula, sampled
from aurora_core.outcomes.condition import Condition
from aurora_core.stl.formula import predicates
from aurora_core.stl.robustness import predicate_robustness, robustness


@dataclass(frozen=True, slots=True, kw_only=True)
class PlotSignal:
    """A condition over time.

    Attributes:
        condition_id: Which condition.
        signal_name: Name in the formula.
        times_s: (n,) simulated time of each sample.
        values: (n,) signal, in `unit`; of a share: what is behind it.
        held: (n,) of a share: where it held.
        unit: Unit of threshold and robustness, and of values unless it is a share.
        threshold: Level that the signal (the share) is compared with.
        tolerance: Half width of the band around the threshold, 0 when there is none.
        robustness: (n,) robustness of the predicate at each sample; of the share of the samples
            up to then.
        margin: Robustness of the whole formula, None when it has none.
    """

    condition_id: str
    signal_name: str
    times_s: FloatArray
    values: FloatArray
    held: BoolArray | None
    unit: str
    threshold: float
    tolerance: float
    robustness: FloatArray
    margin: float | None


def signals_for_plot(context: Context) -> tuple[PlotSignal, ...]:
    """Return what there is to draw, one per condition that has samples.

    Args:
        context: See `monitor.verify.context_of`; what a verdict measured in it is not measured
            again.
    """
    if context.view.ticks == 0:
        return ()
    found = (
        _plot(context, condition, measured)
        for condition in context.conditions
        for measured in (context.kept.get(condition.id) or measure(context, condition),)
        if isinstance(measured, Measured)
    )
    return tuple(found)


def _plot(context: Context, condition: Condition, measured: Measured) -> PlotSignal:
    formula = judged_formula(context, condition, measured)
    margin = robustness(formula, sampled(context, condition, measured)).at(0)
    predicate = next(predicates(formula))
    ticks, values, judged = measured.ticks, measured.values, measured.values
    if measured.plot is not None and measured.held is not None:
        ticks, values = measured.plot
        judged = np.cumsum(measured.held) / np.arange(1, len(measured.held) + 1)
    return PlotSignal(
        condition_id=condition.id,
        signal_name=condition.signal,
        times_s=ticks.astype(np.float64) * context.view.dt_s,
        values=values,
        held=measured.held,
        unit=condition.unit,
        threshold=condition.threshold,
        tolerance=predicate.tolerance,
        robustness=predicate_robustness(predicate, judged),
        margin=margin,
    )
