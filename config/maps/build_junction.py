# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Build the tiny test map `junction` (development only: needs eclipse-sumo, shapely and pyproj).

One signalised crossing of a 2+2 and a 1+1 street, arms of 150 m, four buildings, one no-fly zone.

Usage: python build_junction.py [--out FOLDER]
"""

from __future__ import annotations

import sys
from pathlib import Path

import shapely
from mapbuild.buildings import Special
from mapbuild.command import run
from mapbuild.places import Place, Zone
from mapbuild.streets import KerbPlace, Node, Street, StreetPlan, StreetType
from mapbuild.write_map import MapPlan

ARM_M = 150.0

STREETS = StreetPlan(
    nodes={
        'centre': Node(x_m=0.0, y_m=0.0, kind='traffic_light', radius_m=5.0),
        'west': Node(x_m=-ARM_M, y_m=0.0),
        'east': Node(x_m=ARM_M, y_m=0.0),
        'south': Node(x_m=0.0, y_m=-ARM_M),
        'north': Node(x_m=0.0, y_m=ARM_M),
    },
    types={
        'main': StreetType(
            lanes=2,
            speed_mps=13.89,
            priority=9,
            lane_width_m=3.3,
            sidewalk_m=3.0,
            setback_m=3.0,
        ),
        'street': StreetType(
            lanes=1,
            speed_mps=13.89,
            priority=6,
            lane_width_m=3.3,
            sidewalk_m=2.5,
            setback_m=3.0,
        ),
    },
    streets=(
        Street(name='Long Street', kind='main', nodes=('west', 'centre', 'east')),
        Street(name='Cross Street', kind='street', nodes=('south', 'centre', 'north')),
    ),
    kerb_places=(
        KerbPlace(
            id='stop_long',
            name='Long Street',
            from_node='west',
            to_node='centre',
            start_m=60.0,
            length_m=26.0,
        ),
    ),
)


def _special(name: str, west_m: float, south_m: float, side_m: float, height_m: float) -> Special:
    return Special(
        id=name.lower().replace(' ', '_'),
        name=name,
        kind='block',
        shape=shapely.box(west_m, south_m, west_m + side_m, south_m + side_m),
        height_m=height_m,
        clearance_m=0.0,
    )


MAP = MapPlan(
    name='junction',
    version='1.0.0',
    description='One signalised junction with arms of 150 m, for tests',
    origin_lat_deg=47.397742,
    origin_lon_deg=8.545594,
    extent_m=(-170.0, -170.0, 170.0, 170.0),
    streets=STREETS,
    districts=(),
    specials=(
        _special('South West House', -40.0, -40.0, 24.0, 8.0),
        _special('South East House', 16.0, -40.0, 24.0, 15.0),
        _special('North West House', -46.0, 16.0, 30.0, 30.0),
        _special('North East House', 40.0, 40.0, 20.0, 60.0),
    ),
    zones=(
        Zone(
            id='nofly_north_east',
            name='North East no-fly zone',
            kind='no_fly',
            shape=shapely.box(30.0, 30.0, 70.0, 70.0),
            floor_m=0.0,
            ceiling_m=120.0,
        ),
    ),
    places=(
        Place(name='South East House', kind='city_hall', at=(28.0, -28.0), door=(28.0, -3.0)),
    ),
    seed=1,
)

if __name__ == '__main__':
    sys.exit(run(MAP, Path(__file__).parent))
