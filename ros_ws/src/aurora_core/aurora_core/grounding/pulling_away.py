# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Targets that drive faster than a UAV flies: from where, and for how long, it stays near them.

Such a target passes: a UAV that begins ahead of it, to the side, falls behind at the difference of
the two speeds, and is inside the ring in which the target counts as tracked for the longest way.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from math import sqrt

from aurora_core.geometry.arrays import FloatArray
from aurora_core.geometry.kernel import norm2
from aurora_core.grounding.pace import stated_speed_mps
from aurora_core.knowledge.limits import Limits, Tolerances
from aurora_core.knowledge.settings import GroundingSettings
from aurora_core.spec.parameter import Bound, Provenance
from aurora_core.spec.scenario import ScenarioSpec, UavMission

# A UAV keeps so much inside the ring (m).
_INSIDE_M = 1.0
# A phase is so much shorter than what is tracked of it would let it be.
_SPARE_SHARE = 0.05


@dataclass(frozen=True, slots=True, kw_only=True)
class PullingAway:
    """A target that drives faster than its UAV flies.

    Attributes:
        gains_mps: By how much.
        heading: Direction in which it sets off (unit vector).
        near_m: Least distance at which it is tracked.
        far_m: Greatest one.
        standoff_m: At which the UAV begins, None where nobody states one.
        top_mps: How fast the UAV flies.
        later_s: So long it keeps up, while the target gets as fast as that.
    """

    gains_mps: float
    heading: tuple[float, float]
    near_m: float
    far_m: float
    standoff_m: float | None
    top_mps: float
    later_s: float = 0.0

    def from_rest(self, accel_mps2: float) -> PullingAway:
        """Return the same of a target that sets off when the UAV is there."""
        gains_s = self.gains_mps / accel_mps2
        # While it gets faster still, it gets away half as fast.
        return replace(self, later_s=self.top_mps / accel_mps2 + gains_s / 2.0)

    def offsets(self) -> Iterator[tuple[float, float]]:
        """Yield vectors from the target to the UAV from which it stays near for long (ENU, m)."""
        away_m = self.far_m - 2.0 * _INSIDE_M if self.standoff_m is None else self.standoff_m
        aside_m = min(away_m, self.near_m + _INSIDE_M) if self.near_m > 0.0 else 0.0
        ahead_m = sqrt(max(0.0, away_m * away_m - aside_m * aside_m))
        hx, hy = self.heading
        for side in (1.0, -1.0) if aside_m > 0.0 else (1.0,):
            left_m = side * aside_m
            yield ahead_m * hx - left_m * hy, ahead_m * hy + left_m * hx

    def kept_s(self, offset: tuple[float, float]) -> float:
        """Return for how long a UAV that begins at an offset (ENU, m) stays near, seconds."""
        hx, hy = self.heading
        ahead_m = offset[0] * hx + offset[1] * hy
        aside_m = abs(offset[1] * hx - offset[0] * hy)
        if not self.near_m <= norm2(ahead_m, aside_m) <= self.far_m:
            return 0.0
        out_m = sqrt(max(0.0, self.far_m * self.far_m - aside_m * aside_m))
        if aside_m < self.near_m and ahead_m > 0.0:
            # It comes too near before it is passed.
            out_m = -sqrt(self.near_m * self.near_m - aside_m * aside_m)
        return self.later_s + (ahead_m + out_m) / self.gains_mps


def pulling_away(
    spec: ScenarioSpec,
    mission: UavMission,
    start: FloatArray,
    limits: Limits,
    tolerances: Tolerances,
    settings: GroundingSettings,
) -> PullingAway | None:
    """Return what is known of a target that drives faster than its UAV flies, None for others.

    Args:
        spec: The request.
        mission: Which tracks; where its side or bearing is stated nothing is left to choose.
        start: Where the target is (x, y) and its heading (unit vector).
        limits: Limits in force.
        tolerances: How far a stated distance may be missed.
        settings: How fast vehicles drive of which only more than a speed is stated.
    """
    agent = next((a for a in spec.agents if a.id == mission.target), None)
    speed_mps = None if agent is None else stated_speed_mps(spec, agent, settings.speeds)
    gains_mps = (speed_mps or 0.0) - limits.uav_speed_max_mps
    standoff = mission.standoff_m
    if gains_mps <= 0.0 or standoff is None or mission.side or mission.bearing_deg:
        return None
    slack_m, stated = limits.tracking_horizontal_m, None
    if standoff.provenance is Provenance.EXPLICIT:
        slack_m = tolerances.standoff_m.of(standoff.value, approximate=standoff.approximate)
        stated = standoff.value
    low_m, high_m = max(0.0, standoff.value - slack_m), standoff.value + slack_m
    if standoff.bound is Bound.AT_LEAST:
        return None
    return PullingAway(
        gains_mps=gains_mps,
        heading=(float(start[2]), float(start[3])),
        near_m=0.0 if standoff.bound is Bound.AT_MOST else low_m,
        far_m=high_m,
        standoff_m=stated,
        top_mps=limits.uav_speed_max_mps,
    )


def phase_s(
    spec: ScenarioSpec, mission: UavMission, kept_s: float, tolerances: Tolerances
) -> float:
    """Return how long to track a target that gets away after a time, seconds.

    A duration that nobody states is as long as the target is tracked for the share that counts,
    where nothing else happens for which the UAV would have to be there longer.
    """
    duration = mission.duration_s
    assert duration is not None
    free = duration.provenance is Provenance.DEFAULT and not spec.events
    if not free or any(mission.uav in c.of for c in spec.conditions):
        return duration.value
    longest_s = kept_s / (tolerances.tracked_fraction + _SPARE_SHARE)
    return min(duration.value, max(duration.low, longest_s))
