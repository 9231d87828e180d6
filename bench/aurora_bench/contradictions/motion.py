# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Other motions for the bodies of a recording: ways, speeds and claims stay true of each other."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import numpy.typing as npt

from aurora_bench.mutation.recording import Recording, Span
from aurora_bench.mutation.states import told
from aurora_core.trace.layout import GroundColumn, UavColumn
from aurora_core.trace.trace import Trace

FloatArray = npt.NDArray[np.float64]

# A UAV changes its height with less than any limit (m/s).
_CLIMB_MPS = 2.0
_XY = slice(int(GroundColumn.X), int(GroundColumn.Y) + 1)
_HEADING = slice(int(GroundColumn.HEADING_X), int(GroundColumn.HEADING_Y) + 1)
_UAV_XY = slice(int(UavColumn.X), int(UavColumn.Y) + 1)
_VELOCITY = slice(int(UavColumn.VX), int(UavColumn.VZ) + 1)


def row_of(base: Recording, agent: str) -> int:
    """Return the row of a ground agent that must be there."""
    row = base.trace.roster.agent_index(agent)
    assert row is not None, f'{base.name} has no {agent}'
    return row


def ticks_of(base: Recording, seconds: float) -> int:
    """Return the ticks that a time lasts."""
    return round(seconds / base.trace.roster.dt_s)


def speed_of(base: Recording, agent: str) -> FloatArray:
    """Return (T,) recorded speeds of a ground agent, a copy."""
    return base.trace.ground[:, row_of(base, agent), GroundColumn.SPEED].copy()


def eased(
    base: Recording, speed: FloatArray, tick: int, goal_mps: float, rate_mps2: float
) -> FloatArray:
    """Return the speeds of a driver who from a tick on goes for a speed and stays there."""
    other = speed.copy()
    step = rate_mps2 * base.trace.roster.dt_s
    for k in range(tick, len(speed)):
        off = goal_mps - other[k - 1]
        other[k] = other[k - 1] + np.clip(off, -step, step)
    return other


def delayed(speed: FloatArray, ticks: int) -> FloatArray:
    """Return speeds that are what they were so many ticks before; below zero: after."""
    source = np.clip(np.arange(len(speed)) - ticks, 0, len(speed) - 1)
    return np.asarray(speed[source])


def driven(base: Recording, agent: str, speed: FloatArray) -> Trace:
    """Return the trace in which an agent drives its own way with other speeds (T,).

    Beyond the end of its way it goes on straight.
    """
    row, dt_s = row_of(base, agent), base.trace.roster.dt_s
    ground = base.trace.ground.copy()
    path, heading = ground[:, row, _XY].copy(), ground[:, row, _HEADING].copy()
    ahead_m = float(speed.sum()) * dt_s + 1.0
    path = np.vstack([path, path[-1] + ahead_m * heading[-1]])
    heading = np.vstack([heading, heading[-1]])
    way = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(path, axis=0), axis=1))])
    there = np.concatenate([[0.0], np.cumsum(speed[1:] * dt_s)])
    keep = np.concatenate([[True], np.diff(way) > 1e-9])
    for columns, known in ((_XY, path), (_HEADING, heading)):
        ground[:, row, columns] = np.column_stack(
            [np.interp(there, way[keep], known[keep, k]) for k in range(2)]
        )
    ground[:, row, _HEADING] /= np.linalg.norm(ground[:, row, _HEADING], axis=1)[:, None]
    ground[:, row, GroundColumn.SPEED] = speed
    gained = np.diff(speed, prepend=speed[0]) / dt_s
    ground[:, row, GroundColumn.ACCELERATION] = gained
    return told(base, ground=ground)


def shifted_agent(base: Recording, agent: str, along_m: float) -> Trace:
    """Return the trace in which an agent is elsewhere all along, ahead of where it was."""
    row = row_of(base, agent)
    ground = base.trace.ground.copy()
    ground[:, row, _XY] += along_m * ground[0, row, _HEADING]
    return told(base, ground=ground)


def swapped_agents(base: Recording, one: str, other: str) -> Trace:
    """Return the trace in which two agents have each other's motion."""
    rows = [row_of(base, one), row_of(base, other)]
    ground = base.trace.ground.copy()
    ground[:, rows] = ground[:, rows[::-1]]
    return told(base, ground=ground)


def _ramp(
    base: Recording, span: Span, metres: float, last_s: float, rate_mps: float
) -> FloatArray:
    """Return (T,) metres that grow in the last seconds of a mission, and are gone at its end."""
    rate = rate_mps * base.trace.roster.dt_s
    index = np.arange(base.trace.ticks, dtype=np.float64)
    since = index - (span.stop - ticks_of(base, last_s))
    shape = rate * np.minimum(np.clip(since, 0.0, None), np.clip(span.stop - index, 0.0, None))
    return np.asarray(np.sign(metres) * np.minimum(shape, abs(metres)))


def raised(base: Recording, span: Span, metres: float, last_s: float) -> Trace:
    """Return the trace in which a UAV gets so much higher in the last seconds of a mission."""
    shift = _ramp(base, span, metres, last_s, _CLIMB_MPS)
    uav = base.trace.uav.copy()
    uav[:, span.row, UavColumn.Z] += shift
    uav[:, span.row, UavColumn.VZ] += np.gradient(shift, base.trace.roster.dt_s)
    return told(base, uav=uav)


def aside(base: Recording, span: Span, metres: float, last_s: float, rate_mps: float) -> Trace:
    """Return the trace in which a UAV gets so far east in the last seconds of a mission."""
    shift = _ramp(base, span, metres, last_s, rate_mps)
    uav = base.trace.uav.copy()
    uav[:, span.row, UavColumn.X] += shift
    uav[:, span.row, UavColumn.VX] += np.gradient(shift, base.trace.roster.dt_s)
    return told(base, uav=uav)


def elsewhere(base: Recording, span: Span, east_m: float, north_m: float) -> Trace:
    """Return the trace in which the whole flight of a UAV is displaced."""
    uav = base.trace.uav.copy()
    uav[:, span.row, _UAV_XY] += (east_m, north_m)
    return told(base, uav=uav)


def drawn(base: Recording, span: Span, first: int, last: int) -> Trace:
    """Return the trace in which a UAV flies straight from one tick to another."""
    uav = base.trace.uav.copy()
    share = np.linspace(0.0, 1.0, last - first + 1)[:, None]
    a, b = uav[first, span.row, _UAV_XY].copy(), uav[last, span.row, _UAV_XY].copy()
    uav[first : last + 1, span.row, _UAV_XY] = a + (b - a) * share
    velocity = (b - a) / ((last - first) * base.trace.roster.dt_s)
    uav[first : last + 1, span.row, UavColumn.VX : UavColumn.VY + 1] = velocity
    return told(base, uav=uav)


def scaled(base: Recording, span: Span, share: float) -> Trace:
    """Return the trace in which a UAV flies its mission drawn together round its middle.

    The ways to and from it are bent into it.
    """
    uav = base.trace.uav.copy()
    flown = uav[span.first : span.stop, span.row, _UAV_XY]
    middle = (flown.min(axis=0) + flown.max(axis=0)) / 2.0
    uav[:, span.row, _UAV_XY] = middle + share * (uav[:, span.row, _UAV_XY] - middle)
    uav[:, span.row, UavColumn.VX : UavColumn.VY + 1] *= share
    return told(base, uav=uav)


def aloft(base: Recording, span: Span) -> Trace:
    """Return the trace in which a UAV stands in the air where its mission ended."""
    uav = base.trace.uav.copy()
    uav[span.stop :, span.row] = uav[span.stop - 1, span.row]
    uav[span.stop :, span.row, _VELOCITY] = 0.0
    return told(base, uav=uav)


def in_order(base: Recording, order: Sequence[int], speed_up: float = 1.0) -> Trace:
    """Return the trace whose tick k is what tick `order[k]` was; records go with their ticks.

    Args:
        base: The run.
        order: Ticks, of which some may be left out or come again.
        speed_up: Factor on the velocities of UAVs where ticks are left out.
    """
    trace, ticks = base.trace, np.asarray(order)
    reached = np.maximum.accumulate(ticks)

    def moved(tick: int) -> int:
        return min(int(np.searchsorted(reached, tick)), len(ticks) - 1)

    uav = trace.uav[ticks].copy()
    if speed_up != 1.0:
        faster = np.diff(ticks, append=ticks[-1] + 1) > 1
        uav[faster, :, _VELOCITY] *= speed_up
    return replace(
        trace,
        ground=trace.ground[ticks],
        uav=uav,
        uav_commands=trace.uav_commands[ticks],
        ground_commands=tuple(trace.ground_commands[k] for k in ticks.tolist()),
        links=tuple(replace(r, tick=moved(r.tick)) for r in trace.links),
        sights=tuple(replace(r, tick=moved(r.tick)) for r in trace.sights),
        events=tuple(replace(r, tick=moved(r.tick)) for r in trace.events),
    )


def without(base: Recording, first: int, stop: int) -> Trace:
    """Return the trace without the ticks [first, stop)."""
    return in_order(base, [*range(first), *range(stop, base.trace.ticks)])


def again(base: Recording, first: int, stop: int) -> Trace:
    """Return the trace in which the ticks [first, stop) come twice."""
    return in_order(base, [*range(stop), *range(first, base.trace.ticks)])


def faster(base: Recording, span: Span) -> Trace:
    """Return the trace in which a mission is flown at twice its speed."""
    inside = range(span.first, span.stop, 2)
    order = [*range(span.first), *inside, *range(span.stop, base.trace.ticks)]
    return in_order(base, order, speed_up=2.0)
