# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The schedule of a grounded plan, and its facts that conditions quote.

Grounding fills them in; conditions are derived from the specification and these facts before the
run and travel in the bag, so nothing that happens later can move a threshold.
"""

from __future__ import annotations

from pydantic import FiniteFloat

from aurora_core.document import Document, omitted
from aurora_core.spec.vocabulary import MissionMode

SCHEDULE_VERSION = 1

Point3 = tuple[FiniteFloat, FiniteFloat, FiniteFloat]


class MissionFacts(Document):
    """What a mission was grounded to.

    Attributes:
        altitude_m: Realised altitude above ground.
        standoff_m: Realised horizontal distance from the target (track).
        waypoints: Navigate: route points in order, ENU map frame, z above ground. A closed
            pattern repeats its first point at the end.
        hover_point: Hover: where the UAV holds.
        duration_s: Realised duration of the phase (None: navigate ends with its route).
        transit_m: Length of the way from the end of ascent to the mission's first point.
        transit_speed_mps: Speed of that way.
    """

    mission: str
    uav: str
    mode: MissionMode
    altitude_m: FiniteFloat
    standoff_m: FiniteFloat | None = None
    waypoints: tuple[Point3, ...] = ()
    hover_point: Point3 | None = None
    duration_s: FiniteFloat | None = None
    transit_m: FiniteFloat = 0.0
    transit_speed_mps: FiniteFloat = 8.0


class AgentFacts(Document):
    """What a ground agent can do by its type.

    Attributes:
        acceleration_mps2: From rest.
        deceleration_mps2: Without emergency.
    """

    agent: str
    acceleration_mps2: FiniteFloat
    deceleration_mps2: FiniteFloat


class PlanFacts(Document):
    """Facts of the whole plan.

    Attributes:
        horizon_s: Simulated time by which everything, landing included, has to be done.
        missions: In the order of the specification.
        agents: Ground agents that have a place.
        climb_mps: Mean rate of a climb where the multirotor was measured to do less than the
            limits let expect; None: what these do.
        descent_mps: The same downwards, positive.
    """

    horizon_s: FiniteFloat
    missions: tuple[MissionFacts, ...] = ()
    agents: tuple[AgentFacts, ...] = ()
    climb_mps: FiniteFloat | None = omitted(None)
    descent_mps: FiniteFloat | None = omitted(None)


class PlannedTime(Document):
    """When a time point can be, as the plan leaves it.

    Attributes:
        point: As in a certificate (`outcomes.feasibility.TimeBound`), for example `events/e1`.
        earliest_s: From scenario start, by what is fastest.
        latest_s: The same, by what is asked for and the horizon.
    """

    point: str
    earliest_s: FiniteFloat
    latest_s: FiniteFloat


class Schedule(Document):
    """When things have to be done.

    Attributes:
        horizon_s: Hard end of the run.
        stated_horizon: The prompt states the duration: the run lasts exactly that long.
        facts: What conditions quote.
        times: When events, missions and landings can be; empty when `conflict` says why not.
        conflict: What excludes itself where it was grounded; elsewhere it may be possible.
    """

    schema_version: int = SCHEDULE_VERSION
    horizon_s: FiniteFloat
    stated_horizon: bool
    facts: PlanFacts
    times: tuple[PlannedTime, ...] = omitted(())
    conflict: str = omitted('')

    @property
    def without_times(self) -> Schedule:
        """The same as versions wrote it that did not work the times out."""
        return self.model_copy(update={'times': (), 'conflict': ''})
