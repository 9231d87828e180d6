# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""One condition over time: its signal with the threshold above, its robustness below."""

from __future__ import annotations

import textwrap
from collections.abc import Iterable
from dataclasses import dataclass

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from aurora_core.judging.evaluation import FloatArray
from aurora_core.monitor.sentences import quantity_text
from aurora_core.monitor.signals_for_plot import PlotSignal
from aurora_core.outcomes.verdict import ConditionResult
from aurora_core.report.picture.strip import shade_phases
from aurora_core.report.scene import style
from aurora_core.report.status import Status
from aurora_core.trace.layout import UavCommandColumn
from aurora_core.trace.trace import Trace

_SIZE_IN = (9.0, 4.8)
_WORDS = 108
# Fewer samples than this are moments, not a course.
_MOMENTS = 12
_SIGNS = {'<=': '≤', '>=': '≥', '==': '='}
_GOOD = style.STATUS_COLOURS[Status.VERIFIED]
_BAD = style.STATUS_COLOURS[Status.VIOLATED]


@dataclass(frozen=True, slots=True, kw_only=True)
class Flight:
    """The phases of the UAV that a condition is about.

    Attributes:
        name: Of the UAV.
        phases: (T,) `UavPhase` by tick.
        dt_s: Time step.
    """

    name: str
    phases: FloatArray
    dt_s: float


def flight_of(trace: Trace, of: Iterable[str]) -> Flight | None:
    """Return the flight of the first UAV among some bodies, None when nobody of them flies."""
    row = next((r for name in of if (r := trace.roster.uav_index(name)) is not None), None)
    if row is None:
        return None
    return Flight(
        name=trace.roster.uavs[row].body_id,
        phases=trace.uav_commands[:, row, UavCommandColumn.PHASE],
        dt_s=trace.roster.dt_s,
    )


def draw_condition(
    signal: PlotSignal, result: ConditionResult, flight: Flight | None = None
) -> Figure:
    """Draw a condition that has samples.

    Args:
        signal: Its course.
        result: What was found, of the same condition.
        flight: Whose phases are shaded, None for none.
    """
    with mpl.rc_context(style.RC):
        figure = Figure(figsize=_SIZE_IN, facecolor=style.PAPER)
        FigureCanvasAgg(figure)
        upper, lower = figure.subplots(
            2,
            1,
            sharex=True,
            gridspec_kw={
                'left': 0.09,
                'right': 0.90,
                'top': 0.80,
                'bottom': 0.10,
                'hspace': 0.24,
            },
        )
        colour = _GOOD if result.satisfied else _BAD
        figure.text(0.02, 0.945, result.id, weight='bold', size=11, color=style.INK)
        figure.text(0.985, 0.945, _outcome(result), ha='right', weight='bold', color=colour)
        words = textwrap.wrap(f'{result.sentence}. {result.explanation}', _WORDS)
        figure.text(0.02, 0.93, '\n'.join(words[:2]), va='top', color=style.FAINT)
        _draw_signal(upper, signal, result)
        _draw_robustness(lower, signal, colour)
        if flight is not None:
            span_s = upper.get_xlim()
            for axes in (upper, lower):
                shade_phases(axes, flight.phases, flight.dt_s, span_s)
            upper.set_xlim(span_s)
            _title(upper, f'{upper.get_title(loc="left")}; shaded: phases of {flight.name}')
        if result.worst_time_s is not None:
            for axes in (upper, lower):
                axes.axvline(result.worst_time_s, color=colour, linewidth=0.8, linestyle=':')
        return figure


def _outcome(result: ConditionResult) -> str:
    word = 'holds' if result.satisfied else 'violated'
    if result.margin is None:
        return word
    return f'{word}, margin {quantity_text(result.margin, result.unit)}'


def _draw_signal(axes: Axes, signal: PlotSignal, result: ConditionResult) -> None:
    _course(axes, signal.times_s, signal.values, style.EGO_COLOUR)
    if signal.held is None:
        _title(axes, signal.signal_name)
        axes.set_ylabel(f'{_quantity(signal)}\n{_unit(signal)}'.rstrip())
        _threshold(axes, signal, result)
        return
    _title(axes, f'what {signal.signal_name} is counted from')
    axes.fill_between(
        signal.times_s,
        0.0,
        1.0,
        where=~signal.held,
        transform=axes.get_xaxis_transform(),
        color=_BAD,
        alpha=0.12,
        step='mid',
        linewidth=0.0,
        label='does not count',
    )
    if not signal.held.all():
        axes.legend(loc='best', frameon=False)


def _threshold(axes: Axes, signal: PlotSignal, result: ConditionResult) -> None:
    """Draw the threshold, with its number and unit at the right end."""
    axes.axhline(signal.threshold, color=style.INK, linewidth=0.9, linestyle='--')
    text = f'{_SIGNS.get(result.op, result.op)} {quantity_text(signal.threshold, signal.unit)}'
    axes.annotate(
        text, (1.0, signal.threshold), xycoords=('axes fraction', 'data'), xytext=(4.0, 0.0),
        textcoords='offset points', va='center', size=7.5, color=style.INK,
        annotation_clip=False,
    )  # fmt: skip
    if signal.tolerance > 0.0:
        low, high = signal.threshold - signal.tolerance, signal.threshold + signal.tolerance
        axes.axhspan(low, high, color=_GOOD, alpha=0.12, linewidth=0.0)


def _draw_robustness(axes: Axes, signal: PlotSignal, colour: str) -> None:
    _title(axes, 'robustness' if signal.held is None else 'robustness of the share so far')
    axes.set_ylabel(f'margin\n{_unit(signal)}'.rstrip())
    axes.set_xlabel('simulated time [s]')
    axes.axhline(0.0, color=style.INK, linewidth=0.9)
    below = np.minimum(signal.robustness, 0.0)
    axes.fill_between(signal.times_s, below, 0.0, color=_BAD, alpha=0.15, linewidth=0.0)
    _course(axes, signal.times_s, signal.robustness, colour)


def _course(axes: Axes, times_s: FloatArray, values: FloatArray, colour: str) -> None:
    marker = 'o' if len(values) <= _MOMENTS else None
    axes.plot(times_s, values, color=colour, linewidth=1.3, marker=marker, markersize=4.5)
    axes.margins(x=0.01, y=0.12)
    axes.spines[['top', 'right']].set_visible(False)


def _title(axes: Axes, text: str) -> None:
    axes.set_title(text, loc='left', size=8.5, color=style.FAINT, pad=4.0)


def _quantity(signal: PlotSignal) -> str:
    """Return what is measured, without of whom: the heading names these."""
    return signal.signal_name.partition('(')[0].replace('_', ' ')


def _unit(signal: PlotSignal) -> str:
    return '' if signal.unit == '1' else f'[{signal.unit}]'
