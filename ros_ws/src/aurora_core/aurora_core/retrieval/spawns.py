# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Spawn examples: measured spots of the active map where a scenario can begin.

Every spot is on a lane of the network, or a place of a parking row; grounding reads the same map.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from math import degrees

from pydantic import JsonValue

from aurora_core.geometry.frames import heading_to_yaw_enu
from aurora_core.knowledge.map_model import MapModel
from aurora_core.knowledge.net_types import Crossing, Junction, Lane
from aurora_core.outcomes.retrieval import RecordKind
from aurora_core.retrieval.record import Record

_CAR = 'passenger'
_MAP_FILES = 'maps'
Data = dict[str, JsonValue]


def spawn_records(map_model: MapModel) -> tuple[Record, ...]:
    """Return the spawn examples of a map, in a fixed order."""
    return (
        *_streets(map_model),
        *_intersections(map_model),
        *_landmarks(map_model),
        *_stops(map_model),
        *_parking(map_model),
        *_crossings(map_model),
    )


def _record(
    map_model: MapModel, kind: str, name: str, file: str, about: str, data: Data
) -> Record:
    return Record(
        kind=RecordKind.SPAWN,
        id=f'{kind}:{name}',
        text=f'{name}: {about}',
        source=f'{_MAP_FILES}/{map_model.name}/{file}',
        data={'map': map_model.name, **data},
    )


def _on_lane(map_model: MapModel, lane_id: str, pos_m: float) -> Data:
    """Describe a spot on a lane; the heading is counter-clockwise from east."""
    lane = map_model.network.lane(lane_id)
    x, y, east, north = map_model.network.position_on_lane(lane_id, pos_m)
    return {
        'lane': lane_id,
        'pos_m': round(pos_m, 2),
        'x_m': round(x, 2),
        'y_m': round(y, 2),
        'yaw_enu_deg': round(degrees(heading_to_yaw_enu(east, north)), 1),
        'speed_limit_mps': round(lane.speed_limit_mps, 2),
    }


def _streets(map_model: MapModel) -> Iterator[Record]:
    """Yield the middle of the longest block of every street that cars may use."""
    network = map_model.network
    by_street: dict[str, list[Lane]] = {}
    for lane in network.driving_lanes(_CAR):
        by_street.setdefault(network.edge(lane.edge_id).street_name, []).append(lane)
    for street in network.street_names:
        lanes = by_street.get(street)
        if not lanes:
            continue
        lane = min(lanes, key=lambda one: (-one.length_m, one.id))
        edge = network.edge(lane.edge_id)
        abreast = sum(1 for one in lanes if one.edge_id == edge.id)
        one_way = network.opposite_edge(edge.id) is None
        lanes_each = f'{abreast} {"lane" if abreast == 1 else "lanes"}'
        about = (
            f'street, road, {f"one way, {lanes_each}" if one_way else f"{lanes_each} each way"}, '
            f'longest block {lane.length_m:.0f} m, limit {lane.speed_limit_mps * 3.6:.0f} km/h'
        )
        data = _on_lane(map_model, lane.id, lane.length_m / 2.0)
        more: Data = {'block_m': round(lane.length_m, 1), 'lanes': abreast, 'one_way': one_way}
        yield _record(map_model, 'street', street, 'net.xml.gz', about, {**data, **more})


def _intersections(map_model: MapModel) -> Iterator[Record]:
    """Yield every junction where two named streets meet."""
    for junction in sorted(map_model.network.junctions.values(), key=lambda j: j.id):
        streets = _streets_at(map_model, junction)
        if len(streets) < 2:
            continue
        control = (
            'with traffic lights, signalised'
            if junction.has_signal
            else 'without signals, ' + junction.kind.replace('allway_stop', 'all way stop signs')
        )
        about = f'intersection, junction, corner, crossroads {control}'
        name = ' and '.join(streets)
        data: Data = {
            'junction': junction.id,
            'x_m': round(junction.x_m, 2),
            'y_m': round(junction.y_m, 2),
            'has_signal': junction.has_signal,
        }
        # Several junctions may join the same streets.
        yield _record(
            map_model, 'intersection', f'{name} ({junction.id})', 'net.xml.gz', about, data
        )


def _streets_at(map_model: MapModel, junction: Junction) -> tuple[str, ...]:
    return tuple(
        sorted(
            {
                edge.street_name
                for edge in map_model.network.edges.values()
                if edge.street_name and junction.id in (edge.from_junction, edge.to_junction)
            }
        )
    )


def _landmarks(map_model: MapModel) -> Iterator[Record]:
    for mark in map_model.landmarks:
        lane = _on_lane(map_model, mark.approach_lane_id, mark.approach_pos_m)
        street = map_model.network.edge(
            map_model.network.lane(mark.approach_lane_id).edge_id
        ).street_name
        about = f'landmark, {mark.kind.replace("_", " ")}, reached from {street}'
        data: Data = {
            'reference': f'landmark:{mark.name}',
            'place_x_m': round(mark.x_m, 2),
            'place_y_m': round(mark.y_m, 2),
            **lane,
        }
        yield _record(map_model, 'landmark', mark.name, 'landmarks.geojson', about, data)


def _stops(map_model: MapModel) -> Iterator[Record]:
    # In foreign data many stops have no name, and two of one street often the same.
    count = Counter(stop.name for stop in map_model.bus_stops)
    for stop in map_model.bus_stops:
        lane = map_model.network.lane(stop.lane_id)
        street = map_model.network.edge(lane.edge_id).street_name
        data = _on_lane(map_model, stop.lane_id, (stop.start_pos_m + stop.end_pos_m) / 2.0)
        about = f'bus stop on {street}'
        name = stop.name if count[stop.name] == 1 else f'{stop.name} ({stop.id})'.strip()
        yield _record(map_model, 'bus_stop', name or stop.id, 'stops.add.xml', about, data)


def _parking(map_model: MapModel) -> Iterator[Record]:
    for row in map_model.parking_areas:
        place = row.places[0]
        yaw_rad = heading_to_yaw_enu(place.heading_east, place.heading_north)
        data: Data = {
            'parking': row.id,
            'places': len(row.places),
            'x_m': round(place.x_m, 2),
            'y_m': round(place.y_m, 2),
            'yaw_enu_deg': round(degrees(yaw_rad), 1),
            'place_length_m': place.length_m,
        }
        about = f'parked, kerbside parking row with {len(row.places)} places at the roadside'
        yield _record(map_model, 'parking', row.name, 'stops.add.xml', about, data)


def _crossings(map_model: MapModel) -> Iterator[Record]:
    """Yield the first crossing of every street, for walkers."""
    seen: set[tuple[str, bool]] = set()
    for crossing in map_model.network.crossings:
        street = _crossed(map_model, crossing)
        if not street or (street, crossing.has_signal) in seen:
            continue
        seen.add((street, crossing.has_signal))
        (ax, ay), (bx, by) = crossing.centre_line[0], crossing.centre_line[-1]
        control = 'with a pedestrian signal' if crossing.has_signal else 'without a signal, zebra'
        about = f'crosswalk, pedestrian crossing over {street} {control}'
        data: Data = {
            'crossing': crossing.id,
            'from_m': [round(ax, 2), round(ay, 2)],
            'to_m': [round(bx, 2), round(by, 2)],
            'has_signal': crossing.has_signal,
        }
        name = f'{street} ({"signal" if crossing.has_signal else "no signal"})'
        yield _record(map_model, 'crosswalk', name, 'net.xml.gz', about, data)


def _crossed(map_model: MapModel, crossing: Crossing) -> str:
    names = {map_model.network.edge(edge).street_name for edge in crossing.edge_ids}
    return ' and '.join(sorted(name for name in names if name))
