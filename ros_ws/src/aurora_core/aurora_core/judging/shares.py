# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Shares of samples: how often, and where it went wrong for longest."""

from __future__ import annotations

import numpy as np

from aurora_core.judging.evaluation import (
    BoolArray,
    Context,
    FloatArray,
    Later,
    Measured,
    TickArray,
)


def share_of(
    context: Context,
    ticks: TickArray,
    good: BoolArray,
    values: FloatArray | None = None,
    what: str = 'it held',
    evidence: tuple[str, ...] = (),
    *,
    growing: bool = True,
) -> Measured:
    """Return the share of ticks at which something holds.

    Args:
        context: The run.
        ticks: (n,) ticks that count, n >= 1.
        good: (T,) where it holds.
        values: (T,) signal behind it, for pictures; default: 1 and 0.
        what: For the story, for example "uav1 tracked bus1".
        evidence: Topics.
        growing: While the run goes on ticks are added and none is taken away.
    """
    inside = good[ticks]
    count = int(np.count_nonzero(inside))
    share = count / len(ticks)
    worst = _longest_outage(ticks, inside)
    first_s, last_s = context.time_s(int(ticks[0])), context.time_s(int(ticks[-1]))
    story = (
        f'{what} in {count} of {len(ticks)} samples ({100.0 * share:.1f} %) from {first_s:.2f} s '
        f'to {last_s:.2f} s'
    )
    if worst is not None:
        begin, length = worst
        lasted_s = length * context.view.dt_s
        story += f', not for {lasted_s:.2f} s from {context.time_s(begin):.2f} s on'
    shown = good.astype(np.float64) if values is None else values
    return Measured(
        ticks=ticks[-1:],
        values=np.array([share]),
        story=story,
        worst_tick=int(ticks[-1]) if worst is None else worst[0],
        plot=(ticks, shown[ticks]),
        evidence=evidence,
        later=Later.COUNTS if growing else Later.ANY,
        held=inside,
    )


def _longest_outage(ticks: TickArray, inside: BoolArray) -> tuple[int, int] | None:
    """Return first tick and length of the longest stretch that does not hold."""
    edges = np.flatnonzero(np.diff(np.concatenate(([True], inside, [True])).astype(np.int8)))
    if len(edges) == 0:
        return None
    starts, stops = edges[0::2], edges[1::2]
    k = int(np.argmax(stops - starts))
    return int(ticks[starts[k]]), int(stops[k] - starts[k])
