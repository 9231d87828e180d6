# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Where a UAV may stand from what it watches: candidates, the preferred ones first."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from math import cos, pi, sin

import numpy as np
import numpy.typing as npt

from aurora_core.geometry.frames import offset_at_bearing
from aurora_core.grounding.beside import side_offsets
from aurora_core.spec.parameter import Provenance
from aurora_core.spec.scenario import ScenarioSpec, UavMission, VisibilityTrigger

FloatArray = npt.NDArray[np.float64]

# Half the distance of neighbours above one target, as a share of that of hovering ones: well
# inside the tracking tolerance.
_SHARED = 0.45

# From so far away a target gets behind buildings, the nearest of these that does it (m).
_FROM_AFAR_M = (15.0, 25.0, 35.0, 50.0, 75.0, 100.0, 130.0)


@dataclass(frozen=True, slots=True, kw_only=True)
class Spread:
    """How UAVs stand round one target.

    Attributes:
        apart_m: Distance of neighbours.
        strict: They stand as far apart as they can, each at the middle of its sector.
        bearings: So many directions are tried.
    """

    apart_m: float
    strict: bool
    bearings: int


def offsets(
    mission: UavMission, start: FloatArray, spread: Spread, share: tuple[int, int] = (0, 1)
) -> Iterator[tuple[float, float]]:
    """Yield vectors from a target to its UAV, ENU metres; the first of equal ones is taken.

    Args:
        mission: Which watches it.
        start: Where the target is (x, y) and its heading (unit vector).
        spread: How several UAVs stand round it.
        share: Which one of how many UAVs this is.
    """
    own, count = share
    standoff = 0.0 if mission.standoff_m is None else mission.standoff_m.value
    if mission.side is not None:
        yield from side_offsets(mission.side, standoff, share)
        return
    if standoff == 0.0:
        # Above the target there is room for one; several stand round it.
        angle = 2.0 * pi * own / count
        radius_m = 0.0 if count == 1 else _SHARED * spread.apart_m / sin(pi / count)
        yield radius_m * cos(angle), radius_m * sin(angle)
        return
    if mission.bearing_deg is not None:
        yield offset_at_bearing(standoff, mission.bearing_deg.value)
        return
    hx, hy = float(start[2]), float(start[3])
    # Behind the target first, then round it. Of several UAVs each has a sector, with a gap to the
    # next one.
    first = own * spread.bearings // count
    last = (own + 1) * spread.bearings // count
    if count > 1:
        first, last = (first, first + 1) if spread.strict else (first + 1, last)
    for k in range(first, last):
        angle = 2.0 * pi * k / spread.bearings
        c, s = cos(angle), sin(angle)
        yield (-standoff * (hx * c - hy * s), -standoff * (hx * s + hy * c))


def loses_sight(spec: ScenarioSpec, mission: UavMission) -> bool:
    """Tell whether something waits for a UAV to lose sight of what it tracks."""
    return any(
        isinstance(e.trigger, VisibilityTrigger)
        and e.trigger.on == 'occluded'
        and (e.trigger.observer, e.trigger.target) == (mission.uav, mission.target)
        for e in spec.events
    )


def from_afar(mission: UavMission, farthest_m: float) -> Iterator[UavMission]:
    """Yield a mission with the standoffs that nobody states, from which buildings get between.

    Args:
        mission: Which tracks; one whose standoff is stated is all there is.
        farthest_m: No standoff is greater.
    """
    yield mission
    standoff = mission.standoff_m
    if standoff is None or standoff.provenance is not Provenance.DEFAULT:
        return
    for value in _FROM_AFAR_M:
        if standoff.value < value <= min(standoff.high, farthest_m):
            yield mission.model_copy(
                update={'standoff_m': standoff.model_copy(update={'value': value})}
            )


def is_lost(seen: npt.NDArray[np.bool_]) -> bool:
    """Tell whether a target that is seen at first gets out of sight for some samples (K,)."""
    hidden = ~seen
    return bool(len(seen) > 3 and seen[:2].all() and (hidden[:-1] & hidden[1:]).any())
