# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""One function per tool: what it needs before the clock starts, and what is timed.

Formulas are parsed, and traces brought into the tool's own form, before the clock starts. Each
function returns what is timed: it gives the robustness at every sample from 0 on, or only its
first value where the tool has no more. Imports stand in the functions, because no environment
has all tools.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from typing import Any

import numpy as np
import numpy.typing as npt

from aurora_bench.stl.cells import Cell, Kind

Floats = npt.NDArray[np.float64]
Timed = Callable[[], Any]


class NotInToolError(Exception):
    """The tool has no such formula."""


def aurora(cell: Cell, x: Floats, y: Floats) -> Timed:
    """AURORA's core: checks the samples, then the whole signal."""
    from aurora_core.stl.robustness import SampledSignals, robustness
    from aurora_core.stl.syntax import parse_formula

    x_holds, y_holds = '(x >= 0)', '(y >= 0)'
    w, (low, high) = cell.window, cell.until
    formula = parse_formula(
        {
            Kind.ALWAYS: f'always [0, {w}] s {x_holds}',
            Kind.EVENTUALLY: f'eventually [0, {w}] s {x_holds}',
            Kind.UNTIL: f'{x_holds} until [{low}, {high}] s {y_holds}',
            Kind.NESTED: f'eventually [0, {2 * w}] s (always [0, {w}] s {x_holds})',
            Kind.ALWAYS_END: f'always {x_holds}',
            Kind.UNTIL_END: f'{x_holds} until {y_holds}',
        }[cell.kind]
    )
    values = {'x': x, 'y': y}
    return lambda: robustness(formula, SampledSignals(values=values, dt_s=1.0)).values


def rtamt(cell: Cell, x: Floats, y: Floats) -> Timed:
    """RTAMT, discrete time, offline."""
    import rtamt

    specification = rtamt.StlDiscreteTimeOfflineSpecification()
    _rtamt_parse(specification, cell)
    dataset = {'time': list(range(len(x))), 'x': x.tolist(), 'y': y.tolist()}
    return lambda: [value for _, value in specification.evaluate(dataset)]


def rtamt_online(cell: Cell, x: Floats, y: Floats) -> Timed:
    """RTAMT, discrete time, sample by sample; its values come `reach` samples late."""
    import rtamt

    if cell.kind in (Kind.ALWAYS_END, Kind.UNTIL_END):
        raise NotInToolError('no future without end')
    rows = [[('x', a), ('y', b)] for a, b in zip(x.tolist(), y.tolist(), strict=True)]

    def run() -> list[float]:
        # Made anew each time: its reset() fails in 0.4.10. That takes some milliseconds.
        specification = rtamt.StlDiscreteTimeOnlineSpecification()
        _rtamt_parse(specification, cell)
        specification.pastify()
        return [specification.update(k, row) for k, row in enumerate(rows)][cell.reach :]

    return run


def _rtamt_parse(specification: Any, cell: Cell) -> None:
    for name in ('x', 'y'):
        specification.declare_var(name, 'float')
    specification.spec = cell.text()
    specification.parse()


def sentil(cell: Cell, x: Floats, y: Floats) -> Timed:
    """The signal over a trace; Rust."""
    import sentil

    formula = sentil.Formula.parse(cell.text())
    trace = sentil.Trace(np.arange(len(x), dtype=float), {'x': x, 'y': y})
    return lambda: formula.robustness_signal(trace)


def mstlo(cell: Cell, x: Floats, y: Floats) -> Timed:
    """Online monitor, all samples in one batch, delayed quantitative semantics; Rust."""
    import mstlo_python

    if cell.kind in (Kind.ALWAYS_END, Kind.UNTIL_END):
        raise NotInToolError('no future without end')
    formula = mstlo_python.parse_formula(cell.text())
    times = np.arange(len(x), dtype=float).tolist()
    batch = {'x': list(zip(x.tolist(), times, strict=True))}
    if cell.kind is Kind.UNTIL:
        batch['y'] = list(zip(y.tolist(), times, strict=True))

    def run() -> list[float]:
        monitor = mstlo_python.Monitor(formula, semantics='DelayedQuantitative')
        return [value for _, value in monitor.update_batch(batch).verdicts()]

    return run


def tidystl(cell: Cell, x: Floats, y: Floats) -> Timed:
    """Native backend on one trace; numpy."""
    import tidystl

    last = len(x) - 1  # a window has to have an end
    text = {
        Kind.ALWAYS_END: f'G[0,{last}](x >= 0)',
        Kind.UNTIL_END: f'(x >= 0) U[0,{last}] (y >= 0)',
    }.get(cell.kind, cell.text())
    formula = tidystl.parse(text)
    times = np.arange(len(x), dtype=float)
    signal = tidystl.Signal.from_dict(times=times, values={'x': x[None], 'y': y[None]})
    return lambda: tidystl.robustness(formula, signal)[0]


def pybanquo(cell: Cell, x: Floats, y: Floats) -> Timed:
    """First value only, no until; Rust."""
    import banquo
    from banquo.operators import Always, Eventually

    predicate = banquo.Predicate({'x': -1.0}, 0.0)  # -x <= 0
    inner = Always.with_bounds((0.0, float(cell.window)), predicate)
    makers: dict[Kind, Callable[[], Any]] = {
        Kind.ALWAYS: lambda: inner,
        Kind.EVENTUALLY: lambda: Eventually.with_bounds((0.0, float(cell.window)), predicate),
        Kind.NESTED: lambda: Eventually.with_bounds((0.0, 2.0 * cell.window), inner),
        Kind.ALWAYS_END: lambda: Always(predicate),
    }
    if cell.kind not in makers:
        raise NotInToolError('no until')
    formula = makers[cell.kind]()
    states = [{'x': a, 'y': b} for a, b in zip(x.tolist(), y.tolist(), strict=True)]
    trace = banquo.Trace({float(k): state for k, state in enumerate(states)})
    return lambda: [banquo.evaluate(formula, trace)]


def stlpy(cell: Cell, x: Floats, y: Floats) -> Timed:
    """First value only; a tree of one node per sample of a window."""
    from stlpy.STL import LinearPredicate

    holds_x, holds_y = LinearPredicate([1, 0], [0]), LinearPredicate([0, 1], [0])
    signal = np.vstack((x, y))
    w, (low, high) = cell.window, cell.until
    formula = {
        Kind.ALWAYS: lambda: holds_x.always(0, w),
        Kind.EVENTUALLY: lambda: holds_x.eventually(0, w),
        Kind.UNTIL: lambda: holds_x.until(holds_y, low, high),
        Kind.NESTED: lambda: holds_x.always(0, w).eventually(0, 2 * w),
        Kind.ALWAYS_END: lambda: holds_x.always(0, len(x) - 1),
        Kind.UNTIL_END: lambda: holds_x.until(holds_y, 0, len(x) - 1),
    }[cell.kind]()
    return lambda: [formula.robustness(signal, 0)[0]]


def pystlogic(cell: Cell, x: Floats, y: Floats) -> Timed:
    """C++, a fork of signal-temporal-logic; the whole signal."""
    import signal_tl

    times = np.arange(len(x), dtype=float).tolist()
    trace = {'x': signal_tl.Signal(x.tolist(), times), 'y': signal_tl.Signal(y.tolist(), times)}
    above_x, above_y = signal_tl.Predicate('x') > 0, signal_tl.Predicate('y') > 0
    w, (low, high) = float(cell.window), cell.until
    formula = {
        Kind.ALWAYS: lambda: signal_tl.Always(above_x, (0.0, w)),
        Kind.EVENTUALLY: lambda: signal_tl.Eventually(above_x, (0.0, w)),
        Kind.UNTIL: lambda: signal_tl.Until(above_x, above_y, (float(low), float(high))),
        Kind.NESTED: lambda: signal_tl.Eventually(
            signal_tl.Always(above_x, (0.0, w)), (0.0, 2.0 * w)
        ),
        Kind.ALWAYS_END: lambda: signal_tl.Always(above_x),
        Kind.UNTIL_END: lambda: signal_tl.Until(above_x, above_y),
    }[cell.kind]()
    return lambda: [sample.value for sample in signal_tl.compute_robustness(formula, trace)]


def metric_temporal_logic(cell: Cell, x: Floats, y: Floats) -> Timed:
    """The whole signal, at times of its own making, of which the whole numbers are taken."""
    import mtl

    formula = mtl.parse(_mtl_text(cell, 'x', 'y'))
    data = {'x': list(enumerate(x.tolist())), 'y': list(enumerate(y.tolist()))}

    def run() -> list[float]:
        found = dict(formula(data, time=None, quantitative=True))
        return [float(found[k]) for k in range(len(x) - cell.reach)]

    return run


def py_signal_temporal_logic(cell: Cell, x: Floats, y: Floats) -> Timed:
    """First value only; metric-temporal-logic with sympy's predicates."""
    import stl

    formula = stl.parse(_mtl_text(cell, '{x > 0}', '{y > 0}'))
    data = {'x': list(enumerate(x.tolist())), 'y': list(enumerate(y.tolist()))}
    return lambda: [float(formula(data, time=0, quantitative=True))]


def _mtl_text(cell: Cell, x: str, y: str) -> str:
    """Return the formula in mtl's grammar; its intervals lack their end, so it is one later."""
    text = re.sub(r',(\d+)\]', lambda found: f',{int(found[1]) + 1}]', cell.text())
    text = text.replace('(x >= 0)', x).replace('(y >= 0)', y)
    text = text.replace(']' + x, '] ' + x)  # an operator and a name need a blank between them
    return f'({text})' if cell.kind in (Kind.UNTIL, Kind.UNTIL_END) else text


def reelay(cell: Cell, x: Floats, y: Floats) -> Timed:
    """Past operators, sample by sample: it gets the trace backwards; C++."""
    import reelay

    w, (low, high) = cell.window, cell.until
    holds_x, holds_y = '{x >= 0}', '{y >= 0}'
    pattern = {
        Kind.ALWAYS: f'historically[0:{w}]{holds_x}',
        Kind.EVENTUALLY: f'once[0:{w}]{holds_x}',
        Kind.UNTIL: f'{holds_x} since[{low}:{high}] {holds_y}',
        Kind.NESTED: f'once[0:{2 * w}](historically[0:{w}]{holds_x})',
        Kind.ALWAYS_END: f'historically{holds_x}',
        Kind.UNTIL_END: f'{holds_x} since {holds_y}',
    }[cell.kind]
    backwards = zip(x[::-1].tolist(), y[::-1].tolist(), strict=True)
    rows = [{'x': a, 'y': b} for a, b in backwards]

    def run() -> list[float]:
        monitor = reelay.discrete_timed_monitor(
            pattern=pattern, semantics='robustness', condense=False
        )
        return [monitor.update(row)['value'] for row in rows][::-1]

    return run


OURS = 'AURORA'
# Name in the results: the distribution whose version is quoted, and the function.
TOOLS: dict[str, tuple[str, Callable[[Cell, Floats, Floats], Timed]]] = {
    OURS: ('aurora_core', aurora),
    'RTAMT': ('rtamt', rtamt),
    'RTAMT online': ('rtamt', rtamt_online),
    'sentil': ('sentil', sentil),
    'mstlo': ('mstlo-python', mstlo),
    'tidystl': ('tidystl', tidystl),
    'pybanquo': ('pybanquo', pybanquo),
    'stlpy': ('stlpy', stlpy),
    'pystlogic': ('pystlogic', pystlogic),
    'reelay': ('reelay', reelay),
    'metric-temporal-logic': ('metric-temporal-logic', metric_temporal_logic),
    'py-signal-temporal-logic': ('py-signal-temporal-logic', py_signal_temporal_logic),
}
