# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Areas and bus stops of a map are places that a prompt can name."""

from __future__ import annotations

import shapely

from aurora_core.knowledge.grounds import BUS_STOP, grounds_of, stop_name
from aurora_core.knowledge.map_model import MapModel
from aurora_core.knowledge.map_types import Area, BusStop


def test_the_downtown_has_its_areas_and_stops(downtown: MapModel) -> None:
    kinds = {mark.name: mark.kind for mark in downtown.grounds}
    assert kinds['Tower Plaza'] == 'plaza'
    assert kinds['City Hall bus stop'] == BUS_STOP
    # The park is a landmark already, and no stop is there twice.
    assert 'Meadow Park' not in kinds
    assert len(kinds) == len(downtown.grounds)
    outlines = {area.name: shapely.Polygon(area.ring) for area in downtown.areas}
    for mark in downtown.grounds:
        downtown.network.position_on_lane(mark.approach_lane_id, mark.approach_pos_m)
        if mark.kind != BUS_STOP:
            assert outlines[mark.name].contains(shapely.Point(mark.x_m, mark.y_m)), mark.name
    assert downtown.landmark('Waterfront') in downtown.grounds
    assert {mark.kind for mark in downtown.quotable} & {BUS_STOP} == set()


def test_what_has_no_name_or_a_landmark_s_is_left_out(downtown: MapModel) -> None:
    ring = ((0.0, 0.0), (20.0, 0.0), (20.0, 20.0), (0.0, 20.0))
    areas = [
        Area(id=str(k), name=name, kind='plaza', ring=ring)
        for k, name in enumerate(('', 'city hall', 'Old Yard', 'old yard'))
    ]
    (stop, *_) = downtown.bus_stops
    stops = [
        BusStop(id=str(k), name=name, lane_id=stop.lane_id, start_pos_m=1.0, end_pos_m=11.0)
        for k, name in enumerate(('', 'Mint (north)', 'Mint (south)'))
    ]
    found = grounds_of(areas, stops, downtown.landmarks, downtown.network)
    assert [mark.name for mark in found] == ['Mint bus stop', 'Old Yard']


def test_a_stop_is_called_without_its_direction() -> None:
    assert stop_name('City Hall (northbound)') == 'City Hall bus stop'
    assert stop_name('') == stop_name('(west)') == ''
