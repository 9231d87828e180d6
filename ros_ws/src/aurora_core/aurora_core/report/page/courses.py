# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Margins over time: each condition that has a course, thinned so that its extremes stay."""

from __future__ import annotations

from itertools import pairwise
from typing import Any

import numpy as np
import numpy.typing as npt

from aurora_core.judging.evaluation import BoolArray, Context
from aurora_core.monitor.signals_for_plot import PlotSignal, signals_for_plot
from aurora_core.report.page.numbers import FloatArray, rounded

_BUCKETS = 150


def courses_of(context: Context) -> dict[str, dict[str, Any]]:
    """Return the courses by condition; one sample alone is no course.

    Each has times in seconds, the signal (of a share: the share so far), its margin at each of
    them, and of a share the stretches in which it held.
    """
    ops = {condition.id: condition.op for condition in context.conditions}
    return {
        signal.condition_id: _course(signal, ops[signal.condition_id])
        for signal in signals_for_plot(context)
        if len(signal.values) > 1
    }


def _course(signal: PlotSignal, op: str) -> dict[str, Any]:
    kept = _kept(signal.robustness)
    times, values = signal.times_s, signal.values
    found: dict[str, Any] = {
        'signal': signal.signal_name,
        'op': op,
        'unit': '' if signal.unit == '1' else signal.unit,
        'threshold': signal.threshold,
        'tolerance': signal.tolerance,
    }
    if signal.held is not None:
        values = np.cumsum(signal.held) / np.arange(1, len(signal.held) + 1)
        found['held'] = _stretches(signal.held, times)
    return {
        **found,
        't': np.round(times[kept], 3).tolist(),
        'v': rounded(values[kept]),
        'm': rounded(signal.robustness[kept]),
    }


def _kept(robustness: FloatArray) -> npt.NDArray[np.intp]:
    """Return the samples to show: of each stretch the first, the least and the greatest."""
    count = len(robustness)
    if count <= 3 * _BUCKETS:
        return np.arange(count, dtype=np.intp)
    edges = np.linspace(0, count, _BUCKETS + 1).astype(int)
    found = {count - 1}
    for start, end in pairwise(edges.tolist()):
        part = robustness[start:end]
        found |= {int(start), int(start + part.argmin()), int(start + part.argmax())}
    return np.array(sorted(found), dtype=np.intp)


def _stretches(held: BoolArray, times_s: FloatArray) -> list[tuple[float, float]]:
    edges = np.flatnonzero(np.diff(np.concatenate(([0], held.astype(np.int8), [0]))))
    return [
        (round(float(times_s[a]), 3), round(float(times_s[b - 1]), 3))
        for a, b in edges.reshape(-1, 2)
    ]
