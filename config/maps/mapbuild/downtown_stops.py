# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Bus stops and parking rows of the map `downtown`."""

from __future__ import annotations

from mapbuild.streets import KerbPlace

KERB_PLACES = (
    KerbPlace(
        id='stop_market_park_east',
        name='Meadow Park (eastbound)',
        from_node='market_linden',
        to_node='market_orchard',
        start_m=40.0,
        length_m=26.0,
    ),
    KerbPlace(
        id='stop_market_park_west',
        name='Meadow Park (westbound)',
        from_node='market_orchard',
        to_node='market_linden',
        start_m=50.0,
        length_m=26.0,
    ),
    KerbPlace(
        id='stop_market_hall',
        name='Harbor Market',
        from_node='market_quarry',
        to_node='market_tinkers',
        start_m=70.0,
        length_m=26.0,
    ),
    KerbPlace(
        id='stop_tower',
        name='Signal Tower',
        from_node='market_boulevard',
        to_node='market_tinkers',
        start_m=80.0,
        length_m=26.0,
    ),
    KerbPlace(
        id='stop_boulevard_north',
        name='City Hall (northbound)',
        from_node='juniper_boulevard',
        to_node='assembly_boulevard',
        start_m=40.0,
        length_m=26.0,
    ),
    KerbPlace(
        id='stop_boulevard_south',
        name='City Hall (southbound)',
        from_node='assembly_boulevard',
        to_node='juniper_boulevard',
        start_m=40.0,
        length_m=26.0,
    ),
    KerbPlace(
        id='stop_station',
        name='Union Station',
        from_node='northgate_zebra',
        to_node='northgate_quarry',
        start_m=30.0,
        length_m=26.0,
    ),
    KerbPlace(
        id='stop_hospital',
        name='Mercy Hospital',
        from_node='cannery_boulevard',
        to_node='cannery_eastgate',
        start_m=110.0,
        length_m=26.0,
    ),
    KerbPlace(
        id='parking_cannery_north',
        name='Cannery Street parking (north side)',
        from_node='cannery_tinkers',
        to_node='cannery_quarry',
        start_m=25.0,
        length_m=90.0,
        places=9,
    ),
    KerbPlace(
        id='parking_cannery_south',
        name='Cannery Street parking (south side)',
        from_node='cannery_quarry',
        to_node='cannery_tinkers',
        start_m=25.0,
        length_m=90.0,
        places=9,
    ),
    KerbPlace(
        id='parking_boulevard_north',
        name='Cannery Street parking at the boulevard (north side)',
        from_node='cannery_boulevard',
        to_node='cannery_tinkers',
        start_m=40.0,
        length_m=112.0,
        places=8,
    ),
    KerbPlace(
        id='parking_boulevard_south',
        name='Cannery Street parking at the boulevard (south side)',
        from_node='cannery_tinkers',
        to_node='cannery_boulevard',
        start_m=40.0,
        length_m=112.0,
        places=8,
    ),
)
