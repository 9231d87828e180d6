# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The waypoints of a route in order: how near each was passed, and how many were visited."""

from __future__ import annotations

from math import inf
from typing import Literal

import numpy as np
from pydantic import FiniteFloat

from aurora_core.document import omitted
from aurora_core.judging.build import (
    Inputs,
    Source,
    Target,
    condition,
    number,
    stated_by,
)
from aurora_core.judging.evaluation import Context, Evaluation, Later, Measured, at_tick
from aurora_core.judging.quantity import OfMission
from aurora_core.judging.route import (
    is_broken_off,
    off_leg_m,
    route_flown,
    route_topics,
    visited,
)
from aurora_core.outcomes.condition import Condition, MissionArguments
from aurora_core.quantities.waypoints import Passage
from aurora_core.spec.parameter import Parameter
from aurora_core.spec.quantity import QuantityName


class WaypointDistance(OfMission):
    """Closest approach of each waypoint after the one before it, metres."""

    name = QuantityName.WAYPOINTS_VISITED
    kind: Literal['waypoint_distance'] = 'waypoint_distance'

    def measure(self, context: Context, condition: Condition) -> Evaluation:
        """Return one distance per waypoint."""
        missing = context.phase_missing(condition, self.mission)
        if missing is not None:
            return missing
        flown = route_flown(context, condition, self.mission)
        if is_broken_off(context, condition, self.mission):
            return self._up_to_the_event(context, condition, visited(flown))
        worst = int(np.argmax([passage.nearest_m for passage in flown]))
        story = (
            f'{_visits(self.mission, flown)}'
            f', point {worst + 1} with {flown[worst].nearest_m:.2f} m at '
            f'{context.time_s(flown[worst].nearest_tick):.2f} s as the farthest'
        )
        return Measured(
            ticks=np.array([passage.nearest_tick for passage in flown], dtype=np.intp),
            values=np.array([passage.nearest_m for passage in flown]),
            story=story,
            evidence=route_topics(condition),
            later=Later.ANY,
        )

    def _up_to_the_event(
        self, context: Context, condition: Condition, done: tuple[Passage, ...]
    ) -> Evaluation:
        """Return one distance per waypoint before an event, and the one from the leg at it."""
        off_m = off_leg_m(context, condition, self.mission)
        last_tick = context.phase(self.mission, self.touchdown_m).stop_tick - 1
        story = (
            f'{self.mission.uav} had visited {len(done)} points of its route when '
            f'{self.mission.left_by} ended it, {off_m:.2f} m from the way to the next one'
        )
        return Measured(
            ticks=np.array([*(p.nearest_tick for p in done), last_tick], dtype=np.intp),
            values=np.array([*(p.nearest_m for p in done), off_m]),
            story=story,
            evidence=route_topics(condition),
            later=Later.ANY,
        )


class WaypointsVisited(OfMission):
    """Number of waypoints visited in order.

    Attributes:
        by_s: Only those count that were by then, seconds from scenario start; None: all.
    """

    name = QuantityName.WAYPOINTS_VISITED
    kind: Literal['waypoints_visited'] = 'waypoints_visited'
    by_s: FiniteFloat | None = omitted(None)

    def measure(self, context: Context, condition: Condition) -> Evaluation:
        """Return how many; a closing point is the first one again, not another waypoint."""
        missing = context.phase_missing(condition, self.mission)
        if missing is not None:
            return missing
        flown = route_flown(context, condition, self.mission)
        points = self.mission.waypoints
        by_s = inf if self.by_s is None else self.by_s
        counted = [p.tick is not None and context.time_s(p.tick) <= by_s for p in flown]
        again = points[0] == points[-1] and counted[-1]
        count = float(sum(counted) - 1 if again else sum(counted))
        story, topics = _visits(self.mission, flown), route_topics(condition)
        if self.by_s is not None:
            story += f', {sum(counted)} of them by {number(self.by_s)} s'
        return at_tick(flown[-1].nearest_tick, count, story, topics, later=Later.RISES)


def _visits(mission: MissionArguments, flown: tuple[Passage, ...]) -> str:
    passed = sum(passage.tick is not None for passage in flown)
    return f'{mission.uav} visited {passed} of {len(flown)} route points in order'


def all_points(inputs: Inputs, mission: MissionArguments, source: Source) -> Condition:
    """Return that every point of a route is passed near enough."""
    uav = mission.uav
    until = '' if mission.left_by is None else f', until {mission.left_by}'
    return condition(
        id=f'{mission.mission}.waypoints',
        sentence=f'{uav} visits all {len(mission.waypoints)} points of its route in order{until}',
        signal=f'waypoint_distance({uav})',
        of=(uav,),
        target=Target(op='<=', threshold=inputs.tolerances.waypoint_horizontal_m, unit='m'),
        arguments=WaypointDistance(**inputs.common, mission=mission),
        source=source,
    )


def stated_count(
    inputs: Inputs, mission: MissionArguments, count: Parameter, source: Source
) -> Condition:
    """Return that as many waypoints are visited as the prompt says."""
    return condition(
        id=f'{mission.mission}.count',
        sentence=f'{mission.uav} visits {number(count.value)} waypoints',
        of=(mission.uav,),
        target=Target(op='>=', threshold=count.value, unit='1'),
        arguments=WaypointsVisited(**inputs.common, mission=mission),
        source=stated_by(source, count),
        every_sample=False,
    )
