# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""All signals of a run as tables: states and commands by tick, conditions, messages, events.

Everything is in the ENU map frame (m, z above ground) and SI units; a column's name ends with its
unit. What is not there (a body that has left, a sample that is missing) is empty.
"""

from __future__ import annotations

import csv
import io
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from aurora_core.monitor.signals_for_plot import PlotSignal
from aurora_core.trace.layout import GroundColumn, UavColumn, UavCommandColumn
from aurora_core.trace.trace import FloatArray, Trace

Value = float | int | str | bool | None

_GROUND = {
    GroundColumn.X: 'x_m',
    GroundColumn.Y: 'y_m',
    GroundColumn.HEADING_X: 'heading_x',
    GroundColumn.HEADING_Y: 'heading_y',
    GroundColumn.SPEED: 'speed_mps',
    GroundColumn.ACCELERATION: 'acceleration_mps2',
    GroundColumn.PRESENT: 'present',
}
_UAV = {
    UavColumn.X: 'x_m',
    UavColumn.Y: 'y_m',
    UavColumn.Z: 'z_m',
    UavColumn.VX: 'vx_mps',
    UavColumn.VY: 'vy_mps',
    UavColumn.VZ: 'vz_mps',
    UavColumn.QW: 'qw',
    UavColumn.QX: 'qx',
    UavColumn.QY: 'qy',
    UavColumn.QZ: 'qz',
    UavColumn.P: 'p_radps',
    UavColumn.Q: 'q_radps',
    UavColumn.R: 'r_radps',
    UavColumn.ARMED: 'armed',
    UavColumn.MODE: 'mode',
    UavColumn.LANDED: 'landed',
}
_COMMAND = {
    UavCommandColumn.MODE: 'command_mode',
    UavCommandColumn.X: 'command_x_m',
    UavCommandColumn.Y: 'command_y_m',
    UavCommandColumn.Z: 'command_z_m',
    UavCommandColumn.VX: 'command_vx_mps',
    UavCommandColumn.VY: 'command_vy_mps',
    UavCommandColumn.VZ: 'command_vz_mps',
    UavCommandColumn.YAW: 'command_yaw_rad',
    UavCommandColumn.TAKEOFF_ALTITUDE: 'command_takeoff_m',
    UavCommandColumn.PHASE: 'phase',
}


@dataclass(frozen=True, slots=True, kw_only=True)
class Table:
    """Named columns of equal length.

    Attributes:
        texts: Columns that hold texts; the others hold numbers.
    """

    name: str
    columns: tuple[str, ...]
    rows: Sequence[Sequence[Value]]
    texts: frozenset[str] = frozenset()


def tables_of(trace: Trace, signals: Sequence[PlotSignal]) -> tuple[Table, ...]:
    """Return every table of a run.

    Args:
        trace: The run.
        signals: Its conditions over time, as `signals_for_plot` gives them.
    """
    return (
        _states(trace),
        _conditions(signals),
        _messages(trace),
        _sights(trace),
        _events(trace),
        _bodies(trace),
    )


def csv_text(table: Table) -> str:
    """Return a table as CSV (RFC 4180); numbers read back to the same bits."""
    stream = io.StringIO()
    writer = csv.writer(stream, lineterminator='\r\n')
    writer.writerow(table.columns)
    for row in table.rows:
        writer.writerow([_written(value) for value in row])
    return stream.getvalue()


def _written(value: Value) -> str:
    if value is None or (isinstance(value, float) and not np.isfinite(value)):
        return ''
    if isinstance(value, bool):
        return 'true' if value else 'false'
    return repr(value) if isinstance(value, float) else str(value)


def _states(trace: Trace) -> Table:
    """One row per tick, the columns of each body after its id."""
    columns: list[str] = ['tick', 'time_s']
    ticks = np.arange(trace.ticks)
    parts: list[FloatArray] = [np.column_stack([ticks, ticks * trace.roster.dt_s])]
    for row, entry in enumerate(trace.roster.agents):
        columns += [f'{entry.body_id}.{name}' for name in _GROUND.values()]
        parts.append(trace.ground[:, row, list(_GROUND)])
    for row, entry in enumerate(trace.roster.uavs):
        columns += [f'{entry.body_id}.{name}' for name in (*_UAV.values(), *_COMMAND.values())]
        parts.append(trace.uav[:, row, list(_UAV)])
        parts.append(trace.uav_commands[:, row, list(_COMMAND)])
    rows: list[list[Value]] = [list(row) for row in np.hstack(parts).tolist()]
    for tick, values in enumerate(rows):
        values[0] = tick
    return Table(name='states', columns=tuple(columns), rows=rows)


def _conditions(signals: Sequence[PlotSignal]) -> Table:
    rows: list[Sequence[Value]] = []
    for signal in signals:
        # Of a share the course is the share so far, as the threshold is one.
        values = signal.values
        if signal.held is not None:
            values = np.cumsum(signal.held) / np.arange(1, len(signal.held) + 1)
        rows += [
            (signal.condition_id, time_s, signal.signal_name, signal.unit, value,
             signal.threshold, margin)
            for time_s, value, margin in zip(
                signal.times_s.tolist(), values.tolist(), signal.robustness.tolist(), strict=True
            )
        ]  # fmt: skip
    return Table(
        name='conditions',
        columns=('condition', 'time_s', 'signal', 'unit', 'value', 'threshold', 'margin'),
        rows=rows,
        texts=frozenset({'condition', 'signal', 'unit'}),
    )


def _messages(trace: Trace) -> Table:
    return Table(
        name='messages',
        columns=(
            'time_s', 'message', 'link', 'event', 'sender', 'receiver', 'kind', 'attempt',
            'reason', 'distance_m', 'line_of_sight',
        ),
        rows=[
            (
                trace.time_s(r.tick), r.message, r.link, r.event, r.sender, r.receiver,
                r.kind.name.lower(), r.attempt, r.reason.name.lower(), float(r.distance_m),
                int(r.line_of_sight),
            )
            for r in trace.links
        ],
        texts=frozenset({'link', 'event', 'sender', 'receiver', 'kind', 'reason'}),
    )  # fmt: skip


def _sights(trace: Trace) -> Table:
    return Table(
        name='sights',
        columns=('time_s', 'observer', 'target', 'visible', 'slant_range_m'),
        rows=[
            (trace.time_s(r.tick), r.observer, r.target, int(r.visible), float(r.slant_range_m))
            for r in trace.sights
        ],
        texts=frozenset({'observer', 'target'}),
    )


def _events(trace: Trace) -> Table:
    return Table(
        name='events',
        columns=('time_s', 'kind', 'subject', 'detail'),
        rows=[
            (trace.time_s(r.tick), r.kind.name.lower(), r.subject, r.detail) for r in trace.events
        ],
        texts=frozenset({'kind', 'subject', 'detail'}),
    )


def _bodies(trace: Trace) -> Table:
    return Table(
        name='bodies',
        columns=('body', 'type', 'role', 'length_m', 'width_m', 'height_m'),
        rows=[
            (e.body_id, e.type_name, e.role, e.length_m, e.width_m, e.height_m)
            for e in (*trace.roster.agents, *trace.roster.uavs)
        ],
        texts=frozenset({'body', 'type', 'role'}),
    )
