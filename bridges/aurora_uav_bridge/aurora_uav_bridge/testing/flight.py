# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""A short flight of some vehicles, and a simulator process to fly it in."""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager

import numpy as np

from aurora_core.ports.simulators import AirLoad, AirSimulator, FloatArray, UavHome
from aurora_core.trace.layout import UAV_COMMAND_WIDTH, UavCommandColumn, UavMode

_END_LIMIT_S = 10.0


@contextmanager
def simulator_process() -> Iterator[int]:
    """Yield the UDP port of a `uav_sim` process.

    Raises:
        AssertionError: It did not start, or did not end with exit code 0.
    """
    process = subprocess.Popen(
        [sys.executable, '-m', 'aurora_uav_sim.udp_main', '--port', '0'],
        stdout=subprocess.PIPE,
        text=True,
    )
    assert process.stdout is not None
    try:
        line = process.stdout.readline()
        assert line, 'uav_sim did not start'
        yield int(line.rpartition(':')[2])
    finally:
        process.terminate()
        process.communicate(timeout=_END_LIMIT_S)
    assert process.returncode == 0


def load_of(count: int) -> AirLoad:
    """Return a load of vehicles in gusty wind."""
    homes = tuple(
        UavHome(uav_id=f'uav_{i}', system_id=2 * i + 1, x_m=15.0 * i, y_m=0.0)
        for i in range(count)
    )
    return AirLoad(
        dt_s=0.05, seed=7, homes=homes, origin_lat_deg=48.0, origin_lon_deg=11.0,
        wind_mean_east_mps=2.0, wind_gust_mps=3.0,
    )  # fmt: skip


def commands_at(load: AirLoad, tick: int) -> FloatArray:
    """Return the commands of a tick: take off, from tick 40 on fly north."""
    commands = np.zeros((len(load.homes), UAV_COMMAND_WIDTH))
    commands[:, UavCommandColumn.TAKEOFF_ALTITUDE] = 10.0
    commands[:, UavCommandColumn.X] = [home.x_m for home in load.homes]
    commands[:, UavCommandColumn.MODE] = UavMode.TAKEOFF
    if tick >= 40:
        commands[:, UavCommandColumn.MODE] = UavMode.OFFBOARD
        commands[:, UavCommandColumn.Z] = 10.0
        commands[:, UavCommandColumn.Y] = 0.2 * (tick - 40)
    return commands


def fly(client: AirSimulator, load: AirLoad, ticks: int) -> bytes:
    """Load, fly some ticks and return the bits of every state."""
    client.load(load)
    states = [client.state()]
    states += [client.advance(tick, commands_at(load, tick)) for tick in range(1, ticks + 1)]
    return np.array(states).tobytes()
