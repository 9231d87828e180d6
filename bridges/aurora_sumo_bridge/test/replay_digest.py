# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Runs one busy scene and prints the digest of all its states; also started as a process.

Usage: `python replay_digest.py MAPS_FOLDER`.
"""

from __future__ import annotations

import hashlib
import sys
from pathlib import Path

from aurora_core.ports.simulators import GroundAgentLoad, GroundLoad
from aurora_core.trace.commands import GroundCommand
from aurora_core.trace.layout import GroundCommandKind
from aurora_sumo_bridge.sumo_client import SumoClient

TICKS = 800
AVENUE = tuple(f'meridian_parkway_{i}_eb' for i in range(2, 7))
ACROSS = ('market_street_3_eb', 'market_street_4_eb', 'market_street_5_eb')


def busy_load(maps: Path, *, seed: int = 7) -> GroundLoad:
    """Return cars that meet and change lanes, a truck that is parked, walkers that cross."""

    def car(name: str, type_name: str, place_m: float, **fields: float) -> GroundAgentLoad:
        return GroundAgentLoad(
            agent_id=name,
            type_name=type_name,
            is_person=False,
            edges=AVENUE,
            lane_id=f'{AVENUE[0]}_1',
            lane_position_m=place_m,
            **fields,  # type: ignore[arg-type]
        )

    def walker(name: str, place_m: float) -> GroundAgentLoad:
        return GroundAgentLoad(
            agent_id=name,
            type_name='pedestrian',
            is_person=True,
            edges=ACROSS,
            lane_id='',
            lane_position_m=place_m,
        )

    truck = GroundAgentLoad(
        agent_id='truck',
        type_name='truck',
        is_person=False,
        edges=('cannery_street_6_eb',),
        lane_id='cannery_street_6_eb_1',
        lane_position_m=50.0,
        parked=True,
    )
    return GroundLoad(
        map_name='downtown',
        net_path=maps / 'downtown' / 'net.xml.gz',
        vtypes_path=maps / 'vtypes.add.xml',
        map_digest='',
        dt_s=0.05,
        seed=seed,
        agents=(
            car('bus', 'bus', 60.0),
            car('ego', 'car', 40.0, speed_mps=8.0),
            car('van', 'van', 20.0, speed_factor=1.3),
            car('bike', 'motorcycle', 10.0, time_gap_s=0.5, min_gap_m=1.0),
            truck,
            walker('ann', 60.0),
            walker('bob', 64.0),
        ),
    )


def digest(client: SumoClient, load: GroundLoad, ticks: int = TICKS) -> str:
    """Return the SHA-256 of every state of a run with commands of several kinds."""

    def order(agent: int, kind: str, value: float = 0.0, **fields: float) -> GroundCommand:
        return GroundCommand(
            agent=agent,
            kind=GroundCommandKind[kind],
            value=value,
            **fields,  # type: ignore[arg-type]
        )

    orders = {
        1: (order(0, 'SET_SPEED', 0.0),),
        60: (order(2, 'CHANGE_LANE', 2, value2=4.0), order(5, 'SET_SPEED', 2.0)),
        120: (order(0, 'RELEASE_SPEED'), order(1, 'SET_SPEED_FACTOR', 0.8)),
        300: (order(1, 'SET_DECELERATION', 6.0), order(1, 'SET_SPEED', 3.0)),
        400: (order(1, 'RELEASE_SPEED'), order(3, 'REMOVE')),
    }
    client.load(load)
    hashed = hashlib.sha256(client.state().tobytes())
    for tick in range(1, ticks + 1):
        hashed.update(client.advance(tick, orders.get(tick, ())).tobytes())
    return hashed.hexdigest()


if __name__ == '__main__':
    sys.stdout.write(digest(SumoClient(), busy_load(Path(sys.argv[1]))))
