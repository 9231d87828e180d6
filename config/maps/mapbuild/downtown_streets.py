# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The street plan of the map `downtown`: an invented city on PX4's default home.

South to north: Meridian Parkway along the water, a low district, Market Street, the old town with
its narrow lanes, the high-rise core in the east, the park in the west, Northgate with the station.
"""

from __future__ import annotations

import math

from mapbuild.curves import arc, bezier
from mapbuild.downtown_nodes import CIRCLE_CENTRE, CIRCLE_RADIUS_M, NODES, TYPES
from mapbuild.downtown_stops import KERB_PLACES
from mapbuild.streets import Point, Street, StreetPlan, Zebra


def _circle_quarter(from_deg: float) -> tuple[Point, ...]:
    return arc(CIRCLE_CENTRE, CIRCLE_RADIUS_M, from_deg, from_deg + 90.0, 9)[1:-1]


# The parkway's turning loops: a teardrop of 24 m radius, driven counter-clockwise.
_LOOP_RADIUS_M = 24.0
_LOOP_OFFSET_M = 776.0 - _LOOP_RADIUS_M
_TANGENT_DEG = 180.0 - math.degrees(math.acos(_LOOP_RADIUS_M / (_LOOP_OFFSET_M - 710.0)))
_EAST_OUT = arc((_LOOP_OFFSET_M, -340.0), _LOOP_RADIUS_M, -_TANGENT_DEG, 0.0, 12)[:-1]
_EAST_BACK = arc((_LOOP_OFFSET_M, -340.0), _LOOP_RADIUS_M, 0.0, _TANGENT_DEG, 12)[1:]
_WEST_OUT = arc((-_LOOP_OFFSET_M, -340.0), _LOOP_RADIUS_M, 180.0 - _TANGENT_DEG, 180.0, 12)[:-1]
_WEST_BACK = arc((-_LOOP_OFFSET_M, -340.0), _LOOP_RADIUS_M, 180.0, 180.0 + _TANGENT_DEG, 12)[1:]

_RIDGE = bezier(((-560.0, 178.0), (-560.0, 285.0), (-430.0, 325.0), (-240.0, 325.0)), 16)

STREETS = (
    Street(
        name='Meridian Parkway',
        kind='parkway',
        nodes=(
            'parkway_west',
            'parkway_westgate',
            'parkway_orchard',
            'parkway_foundry',
            'parkway_quarry',
            'parkway_boulevard',
            'parkway_eastgate',
            'parkway_east',
        ),
    ),
    Street(
        name='East Loop',
        kind='loop',
        nodes=('parkway_east', 'east_loop', 'parkway_east'),
        oneway=True,
        curves={0: _EAST_OUT, 1: _EAST_BACK},
    ),
    Street(
        name='West Loop',
        kind='loop',
        nodes=('parkway_west', 'west_loop', 'parkway_west'),
        oneway=True,
        curves={0: _WEST_OUT, 1: _WEST_BACK},
    ),
    Street(
        name='Cannery Street',
        kind='street',
        nodes=('cannery_westgate', 'cannery_linden', 'circle_west'),
    ),
    Street(
        name='Cannery Street',
        kind='street',
        first_block=3,
        kinds={2: 'parking_street', 3: 'parking_street', 4: 'parking_street'},
        nodes=(
            'circle_east',
            'cannery_foundry',
            'cannery_smithy',
            'cannery_quarry',
            'cannery_tinkers',
            'cannery_boulevard',
            'cannery_eastgate',
        ),
    ),
    Street(
        name='Founders Circle',
        kind='circle',
        nodes=('circle_east', 'circle_north', 'circle_west', 'circle_south', 'circle_east'),
        oneway=True,
        curves={
            0: _circle_quarter(0.0),
            1: _circle_quarter(90.0),
            2: _circle_quarter(180.0),
            3: _circle_quarter(270.0),
        },
    ),
    Street(
        name='Market Street',
        kind='main',
        nodes=(
            'market_westgate',
            'market_linden',
            'market_orchard',
            'market_foundry',
            'market_quarry',
            'market_tinkers',
            'market_boulevard',
            'market_eastgate',
        ),
    ),
    Street(
        name='Glass Lane',
        kind='lane',
        nodes=('glass_foundry', 'glass_needle', 'glass_quarry', 'glass_tinkers'),
    ),
    Street(
        name='Juniper Street',
        kind='street',
        nodes=(
            'juniper_orchard',
            'juniper_foundry',
            'juniper_needle',
            'juniper_quarry',
            'juniper_tinkers',
            'juniper_boulevard',
            'juniper_eastgate',
        ),
        kinds={1: 'lane', 2: 'lane', 3: 'lane'},
    ),
    Street(
        name='Copper Lane',
        kind='lane',
        nodes=('copper_foundry', 'copper_needle', 'copper_quarry', 'copper_tinkers'),
    ),
    Street(
        name='Assembly Street',
        kind='street',
        nodes=(
            'assembly_westgate',
            'assembly_zebra',
            'assembly_orchard',
            'assembly_foundry',
            'assembly_quarry',
            'assembly_tinkers',
            'assembly_boulevard',
            'assembly_eastgate',
        ),
        kinds={0: 'school_street', 1: 'school_street'},
    ),
    Street(
        name='Northgate Street',
        kind='cycle_street',
        nodes=(
            'northgate_orchard',
            'northgate_foundry',
            'northgate_quarry',
            'northgate_zebra',
            'northgate_boulevard',
            'northgate_eastgate',
        ),
    ),
    Street(
        name='Ridge Road',
        kind='street',
        nodes=('assembly_westgate', 'northgate_orchard'),
        curves={0: _RIDGE},
    ),
    Street(
        name='Westgate Drive',
        kind='street',
        nodes=('parkway_westgate', 'cannery_westgate', 'market_westgate', 'assembly_westgate'),
    ),
    Street(name='Linden Street', kind='street', nodes=('cannery_linden', 'market_linden')),
    Street(name='Orchard Street', kind='street', nodes=('parkway_orchard', 'circle_south')),
    Street(
        name='Orchard Street',
        kind='street',
        first_block=2,
        nodes=(
            'circle_north',
            'market_orchard',
            'juniper_orchard',
            'assembly_orchard',
            'northgate_orchard',
        ),
    ),
    Street(
        name='Foundry Avenue',
        kind='oneway',
        oneway=True,
        spread='center',
        nodes=(
            'parkway_foundry',
            'cannery_foundry',
            'market_foundry',
            'glass_foundry',
            'juniper_foundry',
            'copper_foundry',
            'assembly_foundry',
            'northgate_foundry',
        ),
    ),
    Street(
        name='Quarry Avenue',
        kind='oneway',
        oneway=True,
        spread='center',
        nodes=(
            'northgate_quarry',
            'assembly_quarry',
            'copper_quarry',
            'juniper_quarry',
            'glass_quarry',
            'market_quarry',
            'cannery_quarry',
            'parkway_quarry',
        ),
    ),
    Street(name='Smithy Court', kind='court', nodes=('cannery_smithy', 'smithy_end')),
    Street(
        name='Needle Lane', kind='lane', nodes=('glass_needle', 'juniper_needle', 'copper_needle')
    ),
    Street(
        name="Tinker's Lane",
        kind='lane',
        nodes=(
            'cannery_tinkers',
            'market_tinkers',
            'glass_tinkers',
            'juniper_tinkers',
            'copper_tinkers',
            'assembly_tinkers',
        ),
    ),
    Street(
        name='Observatory Avenue', kind='street', nodes=('assembly_tinkers', 'northgate_boulevard')
    ),
    Street(
        name='Grand Boulevard',
        kind='boulevard',
        nodes=(
            'parkway_boulevard',
            'cannery_boulevard',
            'market_boulevard',
            'juniper_boulevard',
            'assembly_boulevard',
            'northgate_boulevard',
        ),
    ),
    Street(
        name='Eastgate Drive',
        kind='street',
        nodes=(
            'parkway_eastgate',
            'cannery_eastgate',
            'market_eastgate',
            'juniper_eastgate',
            'assembly_eastgate',
            'northgate_eastgate',
        ),
    ),
)

# On the parkway's unsignalled stretch side streets are right-in, right-out: nobody waits in a
# 70 km/h lane to turn left. The loops bring everyone round.
FORBIDDEN_TURNS = (
    (('parkway_westgate', 'parkway_orchard'), ('parkway_orchard', 'circle_south')),
    (('circle_south', 'parkway_orchard'), ('parkway_orchard', 'parkway_foundry')),
    (('parkway_orchard', 'parkway_foundry'), ('parkway_foundry', 'cannery_foundry')),
    (('cannery_quarry', 'parkway_quarry'), ('parkway_quarry', 'parkway_boulevard')),
    # Inside the loops' throats only straight on.
    (('east_loop', 'parkway_east'), ('parkway_east', 'east_loop')),
    (('west_loop', 'parkway_west'), ('parkway_west', 'west_loop')),
)

PLAN = StreetPlan(
    nodes=NODES,
    types=TYPES,
    streets=STREETS,
    zebras=(Zebra(node='assembly_zebra'), Zebra(node='northgate_zebra')),
    roundabouts=(('circle_east', 'circle_north', 'circle_west', 'circle_south'),),
    forbidden_turns=FORBIDDEN_TURNS,
    kerb_places=KERB_PLACES,
)
