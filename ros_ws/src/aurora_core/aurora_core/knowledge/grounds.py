# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Named areas and bus stops of a map as places that a prompt can name, beside its landmarks.

An area is where its inside is, a stop where its middle is on its lane. A stop is called after its
name (`City Hall bus stop`); of several with one name, on both sides of a street, the first counts.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator

import shapely

from aurora_core.knowledge.map_types import Area, BusStop, Landmark
from aurora_core.knowledge.reach import Reach
from aurora_core.knowledge.road_network import RoadNetwork

BUS_STOP = 'bus_stop'


def grounds_of(
    areas: Iterable[Area],
    stops: Iterable[BusStop],
    landmarks: Iterable[Landmark],
    network: RoadNetwork,
) -> tuple[Landmark, ...]:
    """Return the areas and stops that are no landmark already, sorted by name.

    What has no name is left out, and so is an area that is called after a landmark (`Ridge School
    zone`): who names it is there already.

    Args:
        areas: Of the map, no-fly zones aside.
        stops: Of the map, sorted by id.
        landmarks: Of the map.
        network: Its streets.
    """
    taken = {mark.name.casefold() for mark in landmarks}
    called = tuple(name + ' ' for name in taken)
    named = [
        area for area in areas if area.name and not f'{area.name.casefold()} '.startswith(called)
    ]
    found = {}
    # Without a new name nothing has to be looked up.
    if named:
        found = {mark.name.casefold(): mark for mark in reversed([*_areas(named, network)])}
    for mark in _stops(stops, network):
        if mark.name.casefold() not in taken:
            found.setdefault(mark.name.casefold(), mark)
    return tuple(sorted(found.values(), key=lambda mark: mark.name))


def stop_name(name: str) -> str:
    """Return what people call a bus stop: without its direction; empty where it has no name."""
    plain = name.partition('(')[0].strip()
    return f'{plain} bus stop' if plain else ''


def _areas(areas: Iterable[Area], network: RoadNetwork) -> Iterator[Landmark]:
    reach = Reach(network)
    for area in areas:
        point = shapely.point_on_surface(shapely.Polygon(area.ring))
        nearest = reach.nearest(point.x, point.y)
        if nearest is not None:
            yield Landmark(
                name=area.name,
                kind=area.kind,
                x_m=round(point.x, 1),
                y_m=round(point.y, 1),
                approach_lane_id=nearest.lane_id,
                approach_pos_m=math.floor(nearest.pos_m * 10.0) / 10.0,
            )


def _stops(stops: Iterable[BusStop], network: RoadNetwork) -> Iterator[Landmark]:
    for stop in stops:
        name = stop_name(stop.name)
        if not name:
            continue
        pos_m = (stop.start_pos_m + stop.end_pos_m) / 2.0
        x_m, y_m, _, _ = network.position_on_lane(stop.lane_id, pos_m)
        yield Landmark(
            name=name,
            kind=BUS_STOP,
            x_m=round(x_m, 1),
            y_m=round(y_m, 1),
            approach_lane_id=stop.lane_id,
            approach_pos_m=pos_m,
        )
