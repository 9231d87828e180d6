# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""A condition over time: what is drawn of it, and in which words."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np
import pytest
from matplotlib.collections import PolyCollection
from matplotlib.figure import Figure

from aurora_core.judging.evaluation import FloatArray
from aurora_core.monitor.signals_for_plot import PlotSignal
from aurora_core.outcomes.verdict import ConditionResult
from aurora_core.report.picture.condition_plot import Flight, draw_condition, flight_of
from aurora_core.report.picture.draw import png_bytes, svg_bytes
from aurora_core.spec.parameter import Provenance

PHASES = ('ascent', 'mission', 'landing')
TIMES_S: FloatArray = np.linspace(0.0, 1.95, 40)


def _signal(held: bool = False, tolerance: float = 0.0) -> PlotSignal:
    values: FloatArray = np.asarray(5.0 - TIMES_S, dtype=np.float64)
    return PlotSignal(
        condition_id='m1.drift',
        signal_name='hover_drift(uav1)',
        times_s=TIMES_S,
        values=values,
        held=values > 4.0 if held else None,
        unit='m',
        threshold=4.0,
        tolerance=tolerance,
        robustness=np.asarray(values - 4.0, dtype=np.float64),
        margin=-0.95,
    )


def _result() -> ConditionResult:
    return ConditionResult(
        id='m1.drift',
        sentence='uav1 stays at its point',
        explanation='It was 3.05 m at 1.95 s; margin -0.95 m.',
        formula='always (hover_drift(uav1) >= 4 m)',
        source_spans=(),
        spec_ids=('m1',),
        op='>=',
        threshold=4.0,
        tolerance=None,
        margin=-0.95,
        unit='m',
        normalised=-2.4,
        satisfied=False,
        exercised=True,
        worst_time_s=1.95,
        provenance=Provenance.DEFAULT,
        implied=True,
    )


def _words(figure: Figure) -> str:
    titles = [axes.get_title(loc='left') for axes in figure.axes]
    return '\n'.join([*titles, *(text.get_text() for text in figure.texts)])


def test_signal_threshold_robustness_and_the_outcome_are_there() -> None:
    figure = draw_condition(_signal(), _result())
    upper, lower = figure.axes
    for word in ('m1.drift', 'violated, margin -0.95 m', 'hover_drift(uav1)', 'robustness'):
        assert word in _words(figure)
    course, threshold, worst = upper.get_lines()
    assert np.asarray(course.get_ydata()).tolist() == (5.0 - TIMES_S).tolist()
    assert set(np.asarray(threshold.get_ydata()).tolist()) == {4.0}
    assert set(np.asarray(worst.get_xdata()).tolist()) == {1.95}
    drawn = [np.asarray(line.get_ydata()).tolist() for line in lower.get_lines()]
    assert (1.0 - TIMES_S).tolist() == pytest.approx(drawn[1])


def test_a_reader_sees_quantity_unit_threshold_and_phases() -> None:
    phases: FloatArray = np.repeat([1.0, 2.0, 100.0], [10, 20, 30])
    flight = Flight(name='uav1', phases=phases, dt_s=0.05)
    figure = draw_condition(_signal(), _result(), flight)
    upper, lower = figure.axes
    assert upper.get_ylabel() == 'hover drift\n[m]'
    assert lower.get_ylabel() == 'margin\n[m]'
    assert '≥ 4.00 m' in [text.get_text() for text in upper.texts]
    named = [text.get_text() for text in upper.texts if text.get_text() in PHASES]
    assert named == ['ascent', 'mission', 'landing']
    assert 'phases of uav1' in upper.get_title(loc='left')
    # The last phase goes on after the last sample: the axes do not.
    assert upper.get_xlim()[1] < 2.1


def test_the_flight_is_that_of_who_the_condition_is_about(make: SimpleNamespace) -> None:
    flight = flight_of(make.trace(), ('motorcycle1', 'uav1'))
    assert flight is not None
    assert flight.name == 'uav1'
    assert flight_of(make.trace(), ('motorcycle1',)) is None


def test_samples_that_do_not_count_for_a_share_are_marked() -> None:
    figure = draw_condition(_signal(held=True), _result())
    upper = figure.axes[0]
    marked = [c for c in upper.collections if isinstance(c, PolyCollection)]
    assert len(marked) == 1
    corners = np.asarray(marked[0].get_paths()[0].vertices)
    assert corners[:, 0].min() >= TIMES_S[20] - 0.05


def test_the_same_condition_gives_the_same_bytes() -> None:
    first, second = (draw_condition(_signal(tolerance=0.5), _result()) for _ in range(2))
    assert png_bytes(first) == png_bytes(second)
    assert svg_bytes(first) == svg_bytes(second)
