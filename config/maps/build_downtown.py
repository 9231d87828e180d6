# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Build the map `downtown` (development only: needs eclipse-sumo, shapely and pyproj).

Usage: python build_downtown.py [--out FOLDER]
"""

from __future__ import annotations

import sys
from pathlib import Path

from mapbuild.command import run
from mapbuild.downtown_blocks import DISTRICTS, EXTENT_M, PLACES, SEED, SPECIALS, ZONES
from mapbuild.downtown_streets import PLAN
from mapbuild.write_map import MapPlan

MAP = MapPlan(
    name='downtown',
    version='1.0.0',
    description='An invented downtown of 1.6 km by 0.8 km: parkway, boulevard, old town, park',
    origin_lat_deg=47.397742,
    origin_lon_deg=8.545594,
    extent_m=EXTENT_M,
    streets=PLAN,
    districts=DISTRICTS,
    specials=SPECIALS,
    zones=ZONES,
    places=PLACES,
    seed=SEED,
)

if __name__ == '__main__':
    sys.exit(run(MAP, Path(__file__).parent))
