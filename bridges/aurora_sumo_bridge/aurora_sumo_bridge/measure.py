# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What a tick costs: `python -m aurora_sumo_bridge.measure NET VTYPES [AGENTS] [TICKS]`."""

from __future__ import annotations

import sys
import time
from pathlib import Path

from aurora_core.ports.simulators import GroundAgentLoad, GroundLoad
from aurora_sumo_bridge.network import Network
from aurora_sumo_bridge.sumo_client import SumoClient

TYPE_NAME = 'car'
VEHICLE_CLASS = 'passenger'
DT_S = 0.05
WALK_EDGES = 80
SHORTEST_LANE_M = 40.0
RESETS = 10


def main(arguments: list[str]) -> int:
    """Measure on a map and print the figures; return the exit code."""
    if not 2 <= len(arguments) <= 4:
        sys.stderr.write(f'{__doc__}\n')
        return 64
    net_path, vtypes_path = Path(arguments[0]), Path(arguments[1])
    agents = int(arguments[2]) if len(arguments) > 2 else 10
    ticks = int(arguments[3]) if len(arguments) > 3 else 2000
    client = SumoClient()
    try:
        client.load(_load(net_path, vtypes_path, ()))
        placed = _spread(Network(), agents)
        load = _load(net_path, vtypes_path, placed)
        started_s = time.perf_counter()
        for _ in range(RESETS):
            client.load(load)
        reset_ms = (time.perf_counter() - started_s) / RESETS * 1e3
        started_s = time.perf_counter()
        for tick in range(1, ticks + 1):
            state = client.advance(tick, ())
        tick_us = (time.perf_counter() - started_s) / ticks * 1e6
        left = int(state[:, -1].sum())
    finally:
        client.close()
    sys.stdout.write(
        f'{net_path}: {len(placed)} agents, {ticks} ticks: {tick_us:.1f} us per tick, '
        f'state read each time; {reset_ms:.1f} ms per warm reset; {left} agents still present\n'
    )
    return 0


def _load(net_path: Path, vtypes_path: Path, agents: tuple[GroundAgentLoad, ...]) -> GroundLoad:
    return GroundLoad(
        map_name=net_path.parent.name,
        net_path=net_path,
        vtypes_path=vtypes_path,
        map_digest='',
        dt_s=DT_S,
        seed=1,
        agents=agents,
    )


def _spread(network: Network, count: int) -> tuple[GroundAgentLoad, ...]:
    """Return cars on different streets, each with a long route."""
    found: list[GroundAgentLoad] = []
    for edge_id in network.edge_ids():
        lane_id = network.lane_for(edge_id, VEHICLE_CLASS)
        if not lane_id or network.arc_length_m(lane_id) < SHORTEST_LANE_M:
            continue
        edges = [edge_id]
        while len(edges) < WALK_EDGES:
            onward = sorted(network.reachable(edges[-1], VEHICLE_CLASS))
            if not onward:
                break
            edges.append(onward[len(edges) % len(onward)])
        found.append(
            GroundAgentLoad(
                agent_id=f'car_{len(found)}',
                type_name=TYPE_NAME,
                is_person=False,
                edges=tuple(edges),
                lane_id=lane_id,
                lane_position_m=0.5 * network.arc_length_m(lane_id),
            )
        )
        if len(found) == count:
            break
    return tuple(found)


if __name__ == '__main__':
    sys.exit(main(sys.argv[1:]))
