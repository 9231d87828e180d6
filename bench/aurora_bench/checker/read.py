# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""A bag to a `Recording`, by the message definitions that the bag itself carries."""

from __future__ import annotations

import itertools
import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
from mcap.exceptions import McapError
from mcap.reader import make_reader
from rosbags.serde import SerdeError
from rosbags.typesys import Stores, TypesysError, get_types_from_msg, get_typestore
from shapely.geometry import Polygon

from aurora_bench.checker.answers import CheckerError
from aurora_bench.checker.recording import (
    GROUND_WIDTH,
    UAV_WIDTH,
    Body,
    FloatArray,
    Lane,
    LinkEntry,
    LinkKind,
    Prism,
    Recording,
    World,
)

ROSTER = '/aurora/roster'
WORLD = '/aurora/world'
GROUND = '/aurora/ground/state'
UAV = '/aurora/uav/state'
UAV_COMMAND = '/aurora/uav/command'
COMM = '/aurora/comm'
TOPICS = (ROSTER, WORLD, GROUND, UAV, UAV_COMMAND, COMM)
COMMAND_WIDTH = 10
PHASE_COLUMN = 9
HINT = 'is it a bag folder of a finished run, such as RUN/bag.0?'


def read_bag(bag: Path) -> Recording:
    """Return what a bag holds of roster, world, states, phases and messages.

    Args:
        bag: Folder of a bag, or its .mcap file.

    Raises:
        CheckerError: It is missing, damaged, or lacks a topic or a tick.
    """
    files = [bag] if bag.is_file() else sorted(bag.glob('*.mcap'))
    if not files:
        raise CheckerError(f'{bag}: no .mcap file; {HINT}')
    messages: dict[str, list[Any]] = {topic: [] for topic in TOPICS}
    try:
        for file in files:
            for topic, message in _messages(file):
                messages[topic].append(message)
        return _recording(messages)
    except (
        McapError,
        SerdeError,
        TypesysError,
        OSError,
        ValueError,
        KeyError,
        IndexError,
        AttributeError,
    ) as error:
        raise CheckerError(
            f'{bag}: cannot be read ({type(error).__name__}: {error}); {HINT}'
        ) from error


def _messages(file: Path) -> Iterator[tuple[str, Any]]:
    store = get_typestore(Stores.EMPTY)
    with file.open('rb') as stream:
        for schema, channel, message in make_reader(stream).iter_messages(topics=list(TOPICS)):
            if schema is None:
                raise ValueError(f'{channel.topic} has no message definition')
            if schema.name not in store.fielddefs:
                types = get_types_from_msg(schema.data.decode(), schema.name)
                store.register({k: v for k, v in types.items() if k not in store.fielddefs})
            yield channel.topic, store.deserialize_cdr(message.data, schema.name)


def _recording(messages: dict[str, list[Any]]) -> Recording:
    for topic in (ROSTER, WORLD):
        if not messages[topic]:
            raise ValueError(f'{topic} is missing')
    roster = messages[ROSTER][-1]
    bodies = tuple(
        _body(entry, row, uav)
        for uav, entries in ((False, roster.agents), (True, roster.uavs))
        for row, entry in enumerate(entries)
    )
    agents, uavs = len(roster.agents), len(roster.uavs)
    dt_s = float(roster.dt_s)
    ticks = max(len(messages[GROUND]), len(messages[UAV]))
    if not dt_s > 0.0 or ticks < 2:
        raise ValueError(f'{ticks} ticks with a time step of {dt_s:g} s')
    ground = _rows(messages[GROUND], agents, GROUND_WIDTH, ticks, 'ground states')
    uav = _rows(messages[UAV], uavs, UAV_WIDTH, ticks, 'UAV states')
    return Recording(
        dt_s=dt_s,
        bodies=bodies,
        world=_world(messages[WORLD][-1]),
        ground=ground,
        uav=uav,
        phase=_phases(messages[UAV_COMMAND], uavs, ticks),
        ledger=tuple(_entry(m, dt_s) for m in messages[COMM]),
    )


def _rows(messages: list[Any], bodies: int, width: int, ticks: int, what: str) -> FloatArray:
    if not bodies:
        return np.zeros((ticks, 0, width))
    numbers = [int(m.tick) for m in messages]
    if numbers != list(range(ticks)):
        raise ValueError(f'{what} are not one per tick: {len(numbers)} of {ticks}')
    rows = np.stack([np.asarray(m.data, dtype=np.float64) for m in messages])
    rows = rows.reshape(ticks, bodies, width)
    if not np.isfinite(rows).all():
        raise ValueError(f'{what} hold numbers that are not finite')
    return rows


def _phases(commands: list[Any], uavs: int, ticks: int) -> FloatArray:
    phase = np.zeros((ticks, uavs))
    last = 0
    current = np.zeros(uavs)
    for command in commands:
        tick = int(command.tick)
        phase[last : min(tick, ticks)] = current
        current = np.asarray(command.data, dtype=np.float64).reshape(uavs, COMMAND_WIDTH)[
            :, PHASE_COLUMN
        ]
        last = min(tick, ticks)
    phase[last:] = current
    return phase


def _entry(m: Any, dt_s: float) -> LinkEntry:
    return LinkEntry(
        time_s=int(m.tick) * dt_s,
        message=int(m.message),
        sender=str(m.sender),
        receiver=str(m.receiver),
        kind=LinkKind(int(m.kind)),
        attempt=int(m.attempt),
        reason=int(m.reason),
    )


def _points(flat: Any) -> FloatArray:
    return np.asarray(flat, dtype=np.float64).reshape(-1, 2)


def _body(entry: Any, row: int, is_uav: bool) -> Body:
    return Body(
        body_id=str(entry.id),
        type_name='uav' if is_uav else str(entry.type),
        row=row,
        is_uav=is_uav,
        is_person=bool(entry.is_person),
        role=str(entry.role),
        length_m=float(entry.length_m),
        width_m=float(entry.width_m),
        height_m=float(entry.height_m),
        route_xy_m=_points(entry.route_xy_m),
    )


def _polygon(m: Any) -> Any:
    holes = []
    if hasattr(m, 'hole_starts'):
        points = _points(m.holes_xy_m)
        bounds = [int(i) for i in m.hole_starts] + [len(points)]
        holes = [points[a:b] for a, b in itertools.pairwise(bounds)]
    polygon = Polygon(_points(m.ring_xy_m), holes)
    return polygon if polygon.is_valid else polygon.buffer(0)


def _world(m: Any) -> World:
    surfaces: tuple[list[tuple[str, Any]], ...] = ([], [], [])
    for surface in m.surfaces:
        surfaces[int(surface.kind)].append((str(surface.id), _polygon(surface)))
    return World(
        map_name=str(m.map_name),
        weather=str(m.weather),
        time_of_day=str(m.time_of_day),
        wind_mps=(float(m.wind_mean_east_mps), float(m.wind_mean_north_mps)),
        gust_mps=float(m.wind_gust_mps),
        buildings=tuple(
            Prism(name=str(b.name), polygon=_polygon(b), top_m=float(b.height_m))
            for b in m.buildings
        ),
        zones=tuple(
            Prism(
                name=str(z.name),
                polygon=_polygon(z),
                floor_m=float(z.floor_m),
                top_m=float(z.ceiling_m),
            )
            for z in m.no_fly_zones
        ),
        driving=tuple(surfaces[0]),
        crossings=tuple(surfaces[1]),
        sidewalks=tuple(surfaces[2]),
        lanes=tuple(
            Lane(
                lane_id=str(c.lane_id),
                street=str(c.street_name),
                xy_m=_points(c.xy_m),
                width_m=float(c.width_m),
                limit_mps=float(c.speed_limit_mps),
            )
            for c in m.lanes
        ),
        signals=tuple((str(s.id), float(s.x_m), float(s.y_m)) for s in m.signals),
        places=tuple((str(p.name), float(p.x_m), float(p.y_m)) for p in m.places),
        limits=json.loads(m.limits_json),
    )
