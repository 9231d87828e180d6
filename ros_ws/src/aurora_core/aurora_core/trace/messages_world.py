# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The World message: the whole measured world of a run, and back."""

from __future__ import annotations

import itertools
import json
from typing import Any

import numpy as np
import numpy.typing as npt

from aurora_core.knowledge.limits import Limits
from aurora_core.knowledge.map_types import Building, NoFlyZone
from aurora_core.knowledge.world import (
    CentreLine,
    NamedPlace,
    SignalPost,
    Surface,
    SurfaceKind,
    Wind,
    WorldModel,
)
from aurora_core.spec.vocabulary import TimeOfDay, Weather
from aurora_core.trace.definitions import MessageDefinitions
from aurora_core.trace.hashing import world_sha256

FloatArray = npt.NDArray[np.float64]


def world_message(definitions: MessageDefinitions, header: Any, run_id: str, w: WorldModel) -> Any:
    """Return a World message."""
    create = definitions.create
    return create(
        'aurora_msgs/msg/World',
        header=header,
        run_id=run_id,
        map_name=w.map_name,
        map_digest=w.map_digest,
        origin_lat_deg=w.origin_lat_deg,
        origin_lon_deg=w.origin_lon_deg,
        weather=w.weather,
        time_of_day=w.time_of_day,
        wind_mean_east_mps=w.wind.mean_east_mps,
        wind_mean_north_mps=w.wind.mean_north_mps,
        wind_gust_mps=w.wind.gust_mps,
        buildings=[
            create(
                'aurora_msgs/msg/Building',
                id=b.id,
                ring_xy_m=_flat(b.ring),
                **_holes(b.holes),
                height_m=b.height_m,
                height_source=b.height_source,
                kind=b.kind,
                name=b.name,
            )
            for b in w.buildings
        ],
        no_fly_zones=[
            create(
                'aurora_msgs/msg/NoFlyZone',
                id=z.id,
                name=z.name,
                ring_xy_m=_flat(z.ring),
                floor_m=z.floor_m,
                ceiling_m=z.ceiling_m,
            )
            for z in w.no_fly_zones
        ],
        surfaces=[
            create(
                'aurora_msgs/msg/Carriageway',
                id=s.surface_id,
                kind=int(s.kind),
                ring_xy_m=_flat(s.ring),
                **_holes(s.holes),
            )
            for s in w.surfaces
        ],
        lanes=[
            create(
                'aurora_msgs/msg/LaneCentreLine',
                lane_id=c.lane_id,
                street_name=c.street_name,
                xy_m=_flat(c.points),
                width_m=c.width_m,
                speed_limit_mps=c.speed_limit_mps,
            )
            for c in w.lanes
        ],
        signals=[
            create('aurora_msgs/msg/Signal', id=p.junction_id, x_m=p.x_m, y_m=p.y_m)
            for p in w.signals
        ],
        places=[
            create('aurora_msgs/msg/NamedPlace', name=p.name, x_m=p.x_m, y_m=p.y_m)
            for p in w.places
        ],
        limits_json=w.limits.canonical_json(),
        conditions_json=w.conditions_json,
        digest=world_sha256(w),
    )


def read_world(m: Any) -> WorldModel:
    """Return the world of a World message.

    Raises:
        ValueError: A field is outside of what the writer can have written.
    """
    return WorldModel(
        map_name=str(m.map_name),
        map_digest=str(m.map_digest),
        origin_lat_deg=float(m.origin_lat_deg),
        origin_lon_deg=float(m.origin_lon_deg),
        weather=Weather(str(m.weather)).value,
        time_of_day=TimeOfDay(str(m.time_of_day)).value,
        wind=Wind(
            mean_east_mps=float(m.wind_mean_east_mps),
            mean_north_mps=float(m.wind_mean_north_mps),
            gust_mps=float(m.wind_gust_mps),
        ),
        buildings=tuple(
            Building(
                id=str(b.id),
                ring=_points(b.ring_xy_m),
                holes=_split(b),
                height_m=float(b.height_m),
                height_source=str(b.height_source),
                kind=str(b.kind),
                name=str(b.name),
            )
            for b in m.buildings
        ),
        no_fly_zones=tuple(
            NoFlyZone(
                id=str(z.id),
                name=str(z.name),
                ring=_points(z.ring_xy_m),
                floor_m=float(z.floor_m),
                ceiling_m=float(z.ceiling_m),
            )
            for z in m.no_fly_zones
        ),
        surfaces=tuple(
            Surface(
                surface_id=str(s.id),
                kind=SurfaceKind(int(s.kind)),
                ring=np.array(_points(s.ring_xy_m)),
                holes=tuple(np.array(h) for h in _split(s)),
            )
            for s in m.surfaces
        ),
        lanes=tuple(
            CentreLine(
                lane_id=str(c.lane_id),
                street_name=str(c.street_name),
                points=np.array(_points(c.xy_m)),
                width_m=float(c.width_m),
                speed_limit_mps=float(c.speed_limit_mps),
            )
            for c in m.lanes
        ),
        signals=tuple(
            SignalPost(junction_id=str(p.id), x_m=float(p.x_m), y_m=float(p.y_m))
            for p in m.signals
        ),
        places=tuple(
            NamedPlace(name=str(p.name), x_m=float(p.x_m), y_m=float(p.y_m)) for p in m.places
        ),
        limits=Limits.model_validate(json.loads(m.limits_json)),
        conditions_json=str(m.conditions_json),
    )


def _flat(points: object) -> FloatArray:
    return np.asarray(points, dtype=np.float64).ravel()


def _points(flat: object) -> tuple[tuple[float, float], ...]:
    rows = np.asarray(flat, dtype=np.float64).reshape(-1, 2).tolist()
    return tuple((x, y) for x, y in rows)


def _holes(holes: tuple[object, ...]) -> dict[str, Any]:
    starts, flat, count = [], [], 0
    for hole in holes:
        starts.append(count)
        points = np.asarray(hole, dtype=np.float64)
        flat.append(points.ravel())
        count += len(points)
    return {
        'hole_starts': np.array(starts, dtype=np.uint32),
        'holes_xy_m': np.concatenate(flat) if flat else np.zeros(0),
    }


def _split(message: Any) -> tuple[tuple[tuple[float, float], ...], ...]:
    points = _points(message.holes_xy_m)
    bounds = [int(i) for i in message.hole_starts] + [len(points)]
    return tuple(points[a:b] for a, b in itertools.pairwise(bounds))
