# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Street types and junctions of the map `downtown`."""

from __future__ import annotations

from mapbuild.streets import Node, StreetType

TYPES = {
    'parkway': StreetType(
        lanes=2,
        speed_mps=19.44,
        priority=12,
        lane_width_m=3.5,
        sidewalk_m=2.5,
        setback_m=16.0,
    ),
    'boulevard': StreetType(
        lanes=3,
        speed_mps=13.89,
        priority=10,
        lane_width_m=3.3,
        sidewalk_m=4.0,
        setback_m=3.0,
    ),
    'main': StreetType(
        lanes=2,
        speed_mps=13.89,
        priority=9,
        lane_width_m=3.3,
        sidewalk_m=3.5,
        bike_m=1.6,
        setback_m=2.0,
    ),
    'oneway': StreetType(
        lanes=2,
        speed_mps=13.89,
        priority=7,
        lane_width_m=3.2,
        sidewalk_m=3.0,
        setback_m=2.0,
    ),
    'street': StreetType(
        lanes=1,
        speed_mps=13.89,
        priority=6,
        lane_width_m=3.3,
        sidewalk_m=2.5,
        setback_m=3.0,
    ),
    'cycle_street': StreetType(
        lanes=1,
        speed_mps=11.11,
        priority=6,
        lane_width_m=3.3,
        sidewalk_m=3.0,
        bike_m=1.6,
        setback_m=3.0,
    ),
    'parking_street': StreetType(
        lanes=1,
        speed_mps=11.11,
        priority=6,
        lane_width_m=3.3,
        sidewalk_m=2.5,
        parking_m=2.8,
        setback_m=2.0,
    ),
    'school_street': StreetType(
        lanes=1,
        speed_mps=8.33,
        priority=6,
        lane_width_m=3.3,
        sidewalk_m=3.0,
        setback_m=8.0,
    ),
    'lane': StreetType(
        lanes=1,
        speed_mps=8.33,
        priority=3,
        lane_width_m=3.0,
        sidewalk_m=1.8,
        setback_m=0.6,
    ),
    'court': StreetType(
        lanes=1,
        speed_mps=5.56,
        priority=1,
        lane_width_m=3.0,
        sidewalk_m=1.8,
        setback_m=4.0,
    ),
    'circle': StreetType(
        lanes=1,
        speed_mps=8.33,
        priority=8,
        lane_width_m=4.0,
        sidewalk_m=2.5,
        setback_m=3.0,
    ),
    'loop': StreetType(
        lanes=2,
        speed_mps=8.33,
        priority=11,
        lane_width_m=3.5,
        sidewalk_m=2.5,
        setback_m=10.0,
    ),
}


def _signal(x_m: float, y_m: float) -> Node:
    return Node(x_m=x_m, y_m=y_m, kind='traffic_light', radius_m=6.0)


def _stop(x_m: float, y_m: float) -> Node:
    return Node(x_m=x_m, y_m=y_m, kind='allway_stop')


def _plain(x_m: float, y_m: float) -> Node:
    return Node(x_m=x_m, y_m=y_m)


CIRCLE_CENTRE = (-240.0, -205.0)
CIRCLE_RADIUS_M = 18.0

NODES = {
    # Meridian Parkway, west to east; no signal between Westgate and Grand Boulevard (980 m).
    'parkway_west': _plain(-710.0, -340.0),
    'west_loop': _plain(-776.0, -340.0),
    'parkway_westgate': _signal(-560.0, -340.0),
    'parkway_orchard': _plain(-240.0, -340.0),
    'parkway_foundry': _plain(-90.0, -340.0),
    'parkway_quarry': _plain(50.0, -340.0),
    'parkway_boulevard': _signal(420.0, -340.0),
    'parkway_eastgate': _signal(645.0, -340.0),
    'parkway_east': _plain(710.0, -340.0),
    'east_loop': _plain(776.0, -340.0),
    # Cannery Street.
    'cannery_westgate': _plain(-560.0, -205.0),
    'cannery_linden': _stop(-400.0, -205.0),
    'circle_west': _plain(CIRCLE_CENTRE[0] - CIRCLE_RADIUS_M, CIRCLE_CENTRE[1]),
    'circle_south': _plain(CIRCLE_CENTRE[0], CIRCLE_CENTRE[1] - CIRCLE_RADIUS_M),
    'circle_east': _plain(CIRCLE_CENTRE[0] + CIRCLE_RADIUS_M, CIRCLE_CENTRE[1]),
    'circle_north': _plain(CIRCLE_CENTRE[0], CIRCLE_CENTRE[1] + CIRCLE_RADIUS_M),
    'cannery_foundry': _plain(-90.0, -205.0),
    'cannery_smithy': _plain(-20.0, -205.0),
    'cannery_quarry': _plain(50.0, -205.0),
    'cannery_tinkers': _plain(215.0, -205.0),
    'cannery_boulevard': _signal(420.0, -205.0),
    'cannery_eastgate': _plain(672.0, -195.0),
    'smithy_end': _plain(-20.0, -138.0),
    # Market Street.
    'market_westgate': _signal(-560.0, -75.0),
    'market_linden': _plain(-400.0, -75.0),
    'market_orchard': _signal(-240.0, -75.0),
    'market_foundry': _signal(-90.0, -75.0),
    'market_quarry': _signal(50.0, -75.0),
    'market_tinkers': _plain(215.0, -75.0),
    'market_boulevard': _signal(420.0, -75.0),
    'market_eastgate': _signal(690.0, -70.0),
    # Glass Lane, Juniper Street, Copper Lane: the old town.
    'glass_foundry': _plain(-90.0, -12.0),
    'glass_needle': _plain(-22.0, -12.0),
    'glass_quarry': _plain(50.0, -12.0),
    'glass_tinkers': _plain(215.0, -12.0),
    'juniper_orchard': _plain(-240.0, 50.0),
    'juniper_foundry': _plain(-90.0, 50.0),
    'juniper_needle': _plain(-22.0, 50.0),
    'juniper_quarry': _plain(50.0, 50.0),
    'juniper_tinkers': _stop(215.0, 50.0),
    'juniper_boulevard': _signal(420.0, 50.0),
    'juniper_eastgate': _plain(690.0, 55.0),
    'copper_foundry': _plain(-90.0, 114.0),
    'copper_needle': _plain(-22.0, 114.0),
    'copper_quarry': _plain(50.0, 114.0),
    'copper_tinkers': _plain(215.0, 114.0),
    # Assembly Street.
    'assembly_westgate': _plain(-560.0, 178.0),
    'assembly_zebra': _plain(-395.0, 178.0),
    'assembly_orchard': _plain(-240.0, 178.0),
    'assembly_foundry': _signal(-90.0, 178.0),
    'assembly_quarry': _signal(50.0, 178.0),
    'assembly_tinkers': _plain(215.0, 178.0),
    'assembly_boulevard': _signal(420.0, 178.0),
    'assembly_eastgate': _plain(676.0, 178.0),
    # Northgate Street.
    'northgate_orchard': _plain(-240.0, 325.0),
    'northgate_foundry': _signal(-90.0, 325.0),
    'northgate_quarry': _plain(50.0, 325.0),
    'northgate_zebra': _plain(160.0, 325.0),
    'northgate_boulevard': _signal(420.0, 325.0),
    'northgate_eastgate': _plain(645.0, 325.0),
}
