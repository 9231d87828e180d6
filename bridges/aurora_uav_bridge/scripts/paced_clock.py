# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Print what is estimated of a drifting clock behind a late link, beside the truth, over a minute.

The simulator runs as a process of its own, in real time; both read the machine's steady clock, so
the truth is known. Run it on a machine that does nothing else.
"""

from __future__ import annotations

import argparse
import subprocess
import sys
import time

import numpy as np

from aurora_core.ports.simulators import AirLoad, UavHome
from aurora_core.trace.layout import UAV_COMMAND_WIDTH, UavCommandColumn, UavMode
from aurora_uav_bridge.paced_client import PacedClient
from aurora_uav_bridge.transports import UdpTransport

_DT_S = 0.05
_HOME = UavHome(uav_id='uav1', system_id=1, x_m=0.0, y_m=0.0)
_SHOWN_S = (0.05, 5.0, 10.0, 20.0, 40.0, 60.0)


def main() -> int:
    """Measure and print a table in Markdown."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument('--drift', type=float, default=200.0, metavar='PPM')
    parser.add_argument('--jitter', type=float, default=30.0, metavar='MS')
    parser.add_argument('--seed', type=int, default=1)
    options = parser.parse_args()
    with subprocess.Popen(
        [
            sys.executable, '-m', 'aurora_uav_sim.udp_main', '--port', '0',
            '--clock-drift', str(options.drift), '--jitter', str(options.jitter),
            '--jitter-seed', str(options.seed),
        ],
        stdout=subprocess.PIPE,
        text=True,
    ) as process:  # fmt: skip
        assert process.stdout is not None
        start_s = float(process.stdout.readline().split('CLOCK_MONOTONIC ')[1].split(',')[0])
        port = int(process.stdout.readline().rpartition(':')[2])
        try:
            _measure(PacedClient(UdpTransport(port)), start_s, options.drift)
        finally:
            process.terminate()
    return 0


def _measure(client: PacedClient, start_s: float, drift_ppm: float) -> None:
    client.load(
        AirLoad(dt_s=_DT_S, seed=1, homes=(_HOME,), origin_lat_deg=48.0, origin_lon_deg=11.0)
    )
    commands = np.zeros((1, UAV_COMMAND_WIDTH))
    commands[0, UavCommandColumn.Z] = commands[0, UavCommandColumn.TAKEOFF_ALTITUDE] = 10.0
    commands[0, UavCommandColumn.MODE] = UavMode.TAKEOFF
    _say('| after | error of the offset | stated | drift | stated | round trips |')
    _say('|---|---|---|---|---|---|')
    shown = {round(s / _DT_S): s for s in _SHOWN_S}
    for tick in range(1, max(shown) + 1):
        client.advance(tick, commands)
        if tick in shown:
            (clock,) = client.clocks()
            now_s = time.monotonic()
            true_s = (1.0 + 1e-6 * drift_ppm) * (now_s - start_s) - now_s
            _say(
                f'| {shown[tick]:g} s | {1e3 * (clock.offset_s - true_s):+.2f} ms | '
                f'±{1e3 * clock.uncertainty_s:.1f} ms | {clock.drift_ppm:+.0f} ppm | '
                f'±{2.0 * clock.drift_sigma_ppm:.0f} ppm | {clock.round_trips} |'
            )
    _say(f'\nstates complete at most {1e3 * clock.latest_s:.0f} ms after their tick')
    client.close()


def _say(line: str) -> None:
    sys.stdout.write(f'{line}\n')
    sys.stdout.flush()


if __name__ == '__main__':
    sys.exit(main())
