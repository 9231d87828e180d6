# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Districts, special buildings, zones and landmarks of the map `downtown`."""

from __future__ import annotations

import math

import shapely

from mapbuild.buildings import District, Special, Style
from mapbuild.places import Place, Zone

EXTENT_M = (-800.0, -410.0, 800.0, 405.0)
SEED = 20260

HOUSES = Style(
    kind='house', lot_m2=560.0, gap_m=9.0, depth_m=26.0, height_m=(6.0, 10.0), filled=0.9
)
LOW = Style(kind='workshop', lot_m2=1500.0, gap_m=9.0, depth_m=45.0, height_m=(6.0, 12.0))
SHEDS = Style(
    kind='workshop', lot_m2=1300.0, gap_m=12.0, depth_m=40.0, height_m=(5.0, 9.0), filled=0.12
)
OLD_TOWN = Style(kind='old_town', lot_m2=520.0, gap_m=0.0, depth_m=15.0, height_m=(8.0, 16.0))
BLOCKS = Style(kind='block', lot_m2=1300.0, gap_m=3.0, depth_m=17.0, height_m=(12.0, 24.0))
OFFICES = Style(kind='block', lot_m2=1500.0, gap_m=6.0, depth_m=36.0, height_m=(12.0, 24.0))
HIGH_RISE = Style(kind='high_rise', lot_m2=2600.0, gap_m=14.0, depth_m=80.0, height_m=(35.0, 75.0))

# East of Grand Boulevard the blocks follow the bend of Eastgate Drive.
_EAST_SOUTH = shapely.Polygon([(420.0, -340.0), (645.0, -340.0), (672.0, -195.0), (420.0, -205.0)])
_EAST_HOSPITAL = shapely.Polygon(
    [(420.0, -205.0), (672.0, -195.0), (690.0, -70.0), (420.0, -75.0)]
)
_EAST_CORE = shapely.Polygon(
    [(420.0, -75.0), (690.0, -70.0), (690.0, 55.0), (676.0, 178.0), (420.0, 178.0)]
)
_EAST_NORTH = shapely.Polygon([(420.0, 178.0), (676.0, 178.0), (645.0, 325.0), (420.0, 325.0)])

DISTRICTS = (
    # Open ground: loops, circle, park, tower plaza, stadium.
    District(area=shapely.box(-800.0, -380.0, -690.0, -300.0), style=None),
    District(area=shapely.box(690.0, -380.0, 800.0, -300.0), style=None),
    District(area=shapely.box(-265.0, -230.0, -215.0, -180.0), style=None),
    District(area=shapely.box(-560.0, -75.0, -240.0, 178.0), style=None),
    District(area=shapely.box(215.0, -75.0, 420.0, 50.0), style=None),
    District(area=_EAST_NORTH, style=None),
    # Waterfront, low-rise south, houses west.
    District(area=shapely.box(-800.0, -410.0, 800.0, -340.0), style=SHEDS),
    District(area=shapely.box(-560.0, -340.0, 420.0, -205.0), style=LOW),
    District(area=_EAST_SOUTH, style=LOW),
    District(area=shapely.box(-800.0, -340.0, -240.0, -75.0), style=HOUSES),
    District(area=shapely.box(-800.0, -75.0, -240.0, 405.0), style=HOUSES),
    # Middle.
    District(area=shapely.box(-240.0, -205.0, -90.0, 325.0), style=BLOCKS),
    District(area=shapely.box(-90.0, -75.0, 215.0, 178.0), style=OLD_TOWN),
    District(area=shapely.box(-90.0, -205.0, 215.0, -75.0), style=BLOCKS),
    District(area=shapely.box(-90.0, 178.0, 215.0, 325.0), style=BLOCKS),
    # The high-rise core.
    District(area=shapely.box(215.0, -205.0, 420.0, -75.0), style=HIGH_RISE),
    District(area=shapely.box(215.0, 50.0, 420.0, 178.0), style=HIGH_RISE),
    District(area=_EAST_CORE, style=HIGH_RISE),
    # Around it.
    District(area=shapely.box(215.0, 178.0, 420.0, 325.0), style=BLOCKS),
    District(area=_EAST_HOSPITAL, style=OFFICES),
    District(area=shapely.box(-240.0, 325.0, 800.0, 405.0), style=OFFICES),
    District(area=shapely.box(640.0, -340.0, 800.0, 325.0), style=OFFICES),
)


def _rectangle(x_m: float, y_m: float, width_m: float, depth_m: float) -> shapely.Polygon:
    half_x, half_y = width_m / 2.0, depth_m / 2.0
    return shapely.box(x_m - half_x, y_m - half_y, x_m + half_x, y_m + half_y)


def _disc(x_m: float, y_m: float, radius_m: float, corners: int) -> shapely.Polygon:
    points = []
    for i in range(corners):
        angle = 2.0 * math.pi * (i + 0.5) / corners
        x, y = x_m + radius_m * math.cos(angle), y_m + radius_m * math.sin(angle)
        points.append((round(x, 1), round(y, 1)))
    return shapely.Polygon(points)


def _stadium() -> shapely.Polygon:
    outer, field = _rectangle(545.0, 252.0, 172.0, 112.0), _rectangle(545.0, 252.0, 106.0, 66.0)
    bowl = outer.buffer(-30.0).buffer(30.0, quad_segs=5)
    return shapely.set_precision(bowl.difference(field), 0.1)


TOWER = (318.0, -12.0)
HELIPAD = (628.0, -136.0)

SPECIALS = (
    Special(
        id='signal_tower',
        name='Signal Tower',
        kind='tower',
        shape=_disc(*TOWER, 14.0, 8),
        height_m=135.0,
        clearance_m=40.0,
    ),
    Special(
        id='tower_pavilion',
        name='Tower Pavilion',
        kind='civic',
        shape=_rectangle(248.0, -14.0, 24.0, 60.0),
        height_m=8.0,
        clearance_m=6.0,
    ),
    Special(
        id='city_hall',
        name='City Hall',
        kind='civic',
        shape=_rectangle(318.0, 118.0, 76.0, 34.0),
        height_m=22.0,
        clearance_m=16.0,
    ),
    Special(
        id='mercy_hospital',
        name='Mercy Hospital',
        kind='hospital',
        shape=shapely.union_all(
            [
                _rectangle(520.0, -136.0, 110.0, 22.0),
                _rectangle(474.0, -136.0, 18.0, 74.0),
                _rectangle(566.0, -136.0, 18.0, 74.0),
            ]
        ),
        height_m=31.0,
        clearance_m=70.0,
    ),
    Special(
        id='union_station',
        name='Union Station',
        kind='civic',
        shape=_rectangle(160.0, 366.0, 130.0, 34.0),
        height_m=14.0,
        clearance_m=12.0,
    ),
    Special(
        id='eastgate_stadium',
        name='Eastgate Stadium',
        kind='stadium',
        shape=_stadium(),
        height_m=26.0,
        clearance_m=12.0,
    ),
    Special(
        id='harbor_market',
        name='Harbor Market',
        kind='civic',
        shape=_rectangle(132.0, -138.0, 96.0, 54.0),
        height_m=12.0,
        clearance_m=40.0,
    ),
    Special(
        id='fire_station',
        name='Foundry Fire Station',
        kind='civic',
        shape=_rectangle(-162.0, -184.0, 40.0, 22.0),
        height_m=9.0,
        clearance_m=8.0,
    ),
    Special(
        id='police_station',
        name='Assembly Police Station',
        kind='civic',
        shape=_rectangle(-20.0, 200.0, 36.0, 24.0),
        height_m=12.0,
        clearance_m=8.0,
    ),
    Special(
        id='linden_school',
        name='Ridge School',
        kind='school',
        shape=shapely.union_all(
            [_rectangle(-395.0, 210.0, 84.0, 18.0), _rectangle(-428.0, 232.0, 18.0, 40.0)]
        ),
        height_m=9.5,
        clearance_m=30.0,
    ),
)

ZONES = (
    Zone(
        id='nofly_signal_tower',
        name='Signal Tower no-fly zone',
        kind='no_fly',
        shape=_disc(*TOWER, 50.0, 32),
        floor_m=0.0,
        ceiling_m=200.0,
    ),
    Zone(
        id='nofly_helipad',
        name='Mercy Hospital helipad no-fly zone',
        kind='no_fly',
        shape=_disc(*HELIPAD, 28.0, 24),
        floor_m=0.0,
        ceiling_m=150.0,
    ),
    Zone(
        id='helipad',
        name='Mercy Hospital helipad',
        kind='helipad',
        shape=_disc(*HELIPAD, 12.0, 16),
    ),
    Zone(
        id='meadow_park',
        name='Meadow Park',
        kind='park',
        shape=shapely.box(-550.0, -56.0, -250.0, 164.0),
    ),
    Zone(
        id='school_zone',
        name='Ridge School zone',
        kind='school_zone',
        shape=shapely.box(-550.0, 170.0, -250.0, 240.0),
    ),
    Zone(
        id='tower_plaza',
        name='Tower Plaza',
        kind='plaza',
        shape=shapely.box(224.0, -62.0, 400.0, 42.0),
    ),
    Zone(
        id='waterfront',
        name='Waterfront',
        kind='waterfront',
        shape=shapely.box(-790.0, -405.0, 790.0, -352.0),
    ),
)

PLACES = (
    Place(name='Mercy Hospital', kind='hospital', at=(520.0, -136.0), door=(520.0, -190.0)),
    Place(
        name='Foundry Fire Station',
        kind='fire_station',
        at=(-162.0, -184.0),
        door=(-162.0, -202.0),
    ),
    Place(
        name='Assembly Police Station',
        kind='police_station',
        at=(-20.0, 200.0),
        door=(-20.0, 181.0),
    ),
    Place(name='City Hall', kind='city_hall', at=(318.0, 118.0), door=(318.0, 52.0)),
    Place(name='Ridge School', kind='school', at=(-395.0, 210.0), door=(-370.0, 181.0)),
    Place(name='Meadow Park', kind='park', at=(-400.0, 54.0), door=(-330.0, -70.0)),
    Place(name='Signal Tower', kind='tower', at=TOWER, door=(318.0, -68.0)),
    Place(name='Eastgate Stadium', kind='stadium', at=(545.0, 252.0), door=(545.0, 181.0)),
    Place(name='Harbor Market', kind='market', at=(132.0, -138.0), door=(132.0, -83.0)),
    Place(name='Union Station', kind='station', at=(160.0, 366.0), door=(110.0, 328.0)),
)
