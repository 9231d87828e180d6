# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Print what a 60 s lockstep flight costs (argument: number of UAVs).

In memory, over UDP, through a proxy that does no harm, and through one that loses 20 % each way,
alone and with 20 % duplication, 20 % reordering and 5 % truncation.
"""

from __future__ import annotations

import os
import subprocess
import sys
import time
from collections.abc import Callable
from contextlib import ExitStack
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np

from aurora_core.ports.simulators import AirLoad, UavHome
from aurora_core.trace.layout import UAV_COMMAND_WIDTH, UavColumn, UavCommandColumn, UavMode
from aurora_uav_bridge.mavlink_client import MavlinkClient
from aurora_uav_bridge.transports import (
    LoopbackTransport,
    SignedTransport,
    Transport,
    UdpTransport,
)
from aurora_uav_sim.mavlink_server import SimServer
from aurora_uav_sim.signing import KEY_BYTES, KEY_FILE_VARIABLE, signer_from

DT_S = 0.05
TICKS = 1200


def fly(transport: Transport, count: int) -> tuple[np.ndarray, bytes]:
    """Take off, fly out at 8 m/s, land; return the wall time of each tick in us and the states."""
    homes = tuple(
        UavHome(uav_id=f'uav_{i}', system_id=i + 1, x_m=10.0 * i, y_m=0.0) for i in range(count)
    )
    client = MavlinkClient(transport)
    client.load(
        AirLoad(
            dt_s=DT_S, seed=1, homes=homes, origin_lat_deg=48.0, origin_lon_deg=11.0,
            wind_mean_east_mps=3.0, wind_gust_mps=2.0,
        )
    )  # fmt: skip
    commands = np.zeros((count, UAV_COMMAND_WIDTH))
    commands[:, UavCommandColumn.TAKEOFF_ALTITUDE] = 30.0
    commands[:, UavCommandColumn.X] = [home.x_m for home in homes]
    states = b''
    took_us = np.zeros(TICKS)
    for tick in range(1, TICKS + 1):
        t_s = tick * DT_S
        if t_s < 15.0:
            commands[:, UavCommandColumn.MODE] = UavMode.TAKEOFF
        elif t_s < 40.0:
            commands[:, UavCommandColumn.MODE] = UavMode.OFFBOARD
            commands[:, UavCommandColumn.Z] = 30.0
            commands[:, UavCommandColumn.Y] = 8.0 * (t_s - 15.0)
            commands[:, UavCommandColumn.VY] = 8.0
        else:
            commands[:, UavCommandColumn.MODE] = UavMode.LAND
        start = time.perf_counter_ns()
        state = client.advance(tick, commands)
        took_us[tick - 1] = (time.perf_counter_ns() - start) / 1e3
        states += state.tobytes()
    assert state[:, UavColumn.LANDED].all()
    client.close()
    return took_us, states


def over_udp(count: int, *bad: str) -> tuple[np.ndarray, bytes]:
    """Fly against a simulator process on a free port.

    Args:
        count: Number of vehicles.
        bad: Options of the proxy in between; none: no proxy.
    """
    with ExitStack() as stack:
        port = started(stack, 'aurora_uav_sim.udp_main', '--port', '0')
        if bad:
            port = started(stack, 'aurora_uav_bridge.testing.udp_proxy', '--to', str(port), *bad)
        return fly(UdpTransport(port), count)


def signed_over_udp(count: int) -> tuple[np.ndarray, bytes]:
    """Fly against a simulator process with a key that both have."""
    with ExitStack() as stack:
        folder = Path(stack.enter_context(TemporaryDirectory()))
        key = folder / 'key'
        key.write_bytes(os.urandom(KEY_BYTES))
        key.chmod(0o600)
        os.environ[KEY_FILE_VARIABLE] = str(key)
        stack.callback(os.environ.pop, KEY_FILE_VARIABLE)
        port = started(stack, 'aurora_uav_sim.udp_main', '--port', '0')
        signer = signer_from()
        assert signer is not None
        return fly(SignedTransport(UdpTransport(port), signer), count)


def started(stack: ExitStack, module: str, *arguments: str) -> int:
    """Start a program that prints its port at the end of its first line; return the port."""
    process = subprocess.Popen(
        [sys.executable, '-m', module, *arguments], stdout=subprocess.PIPE, text=True
    )
    stack.callback(process.communicate, timeout=5.0)
    stack.callback(process.terminate)
    assert process.stdout is not None
    line = process.stdout.readline()
    if not line:
        raise SystemExit(f'{module} did not start')
    return int(line.rpartition(':')[2])


def main() -> None:
    """Print one line per way."""
    count = int(sys.argv[1]) if len(sys.argv) > 1 else 1
    ways: dict[str, Callable[[], tuple[np.ndarray, bytes]]] = {
        'in memory': lambda: fly(LoopbackTransport(SimServer()), count),
        'UDP': lambda: over_udp(count),
        'UDP, signed': lambda: signed_over_udp(count),
        'UDP, harmless proxy': lambda: over_udp(count, '--loss=0'),
        'UDP, 20 % loss': lambda: over_udp(count, '--loss=0.2'),
        'UDP, all faults': lambda: over_udp(
            count, '--loss=0.2', '--duplication=0.2', '--reordering=0.2', '--truncation=0.05'
        ),
    }
    seen = []
    for name, way in ways.items():
        took_us, states = way()
        seen.append(states)
        total_s = took_us.sum() / 1e6
        sys.stdout.write(
            f'{name}: {count} UAV(s), {TICKS} ticks: median {np.median(took_us):.0f} us, '
            f'p99 {np.percentile(took_us, 99):.0f} us, {total_s:.3f} s, '
            f'{TICKS * DT_S / total_s:.0f} times real time\n'
        )
    sys.stdout.write(f'same bits: {len(set(seen)) == 1}\n')


if __name__ == '__main__':
    main()
