# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What there is along the lanes of a map, in words: what can be asked there, and seen."""

from __future__ import annotations

import numpy as np

from aurora_core.knowledge.lane_samples import NO_LANE, LaneSamples
from aurora_core.knowledge.map_records import MapRecords

# A crosswalk that is nearer ahead can be part of a scene that begins here (m).
_CROSSWALK_M = 100.0


def along_lanes(samples: LaneSamples) -> list[str]:
    """Return on which share of the places on lanes there is what, and the speed limits.

    Args:
        samples: Lane samples of the map.
    """
    if not len(samples):
        return []
    having = {
        'a second lane': (samples.left != NO_LANE) | (samples.right != NO_LANE),
        'an oncoming lane': samples.opposite != NO_LANE,
        'a walkway beside': np.isfinite(samples.walkway_m),
        'a crosswalk ahead': samples.crossing_m < _CROSSWALK_M,
        'a building near': np.isfinite(samples.building_m),
    }
    low, high = float(samples.limit_mps.min()), float(samples.limit_mps.max())
    shares = [f'{mask.mean():.0%} {name}' for name, mask in having.items()]
    return [*shares, f'limits of {low:.1f} to {high:.1f} m/s']


def seen_from_air(measured: MapRecords) -> list[str]:
    """Return which share of the places on lanes is seen from which height and distance."""
    return [
        f'{row.free_share:.0%} from {row.height_m:.0f} m up and {row.distance_m:.0f} m away'
        for row in measured.sight
    ]


def hidden_at_corners(measured: MapRecords) -> list[str]:
    """Return which share of the crossing streets is hidden so far before their junction."""
    return [f'{row.hidden_share:.0%} at {row.before_m:.0f} m' for row in measured.corners]
