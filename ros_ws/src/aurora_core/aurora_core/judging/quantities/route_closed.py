# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""How near a closed route ends to where it began."""

from __future__ import annotations

from typing import Literal

from aurora_core.judging.build import Inputs, Source, Target, condition
from aurora_core.judging.evaluation import Context, Evaluation, at_tick
from aurora_core.judging.quantity import OfMission
from aurora_core.judging.route import route_flown, route_topics
from aurora_core.outcomes.condition import Condition, MissionArguments
from aurora_core.quantities.waypoints import approach
from aurora_core.spec.quantity import QuantityName


class RouteClosed(OfMission):
    """Closest approach of the first point again, after the others, metres.

    While another point is missed the route cannot be closed on the way: then the place at the end
    of the phase counts.
    """

    name = QuantityName.ROUTE_CLOSED
    kind: Literal['route_closed'] = 'route_closed'

    def measure(self, context: Context, condition: Condition) -> Evaluation:
        """Return that distance."""
        mission = self.mission
        missing = context.phase_missing(condition, mission)
        if missing is not None:
            return missing
        flown = route_flown(context, condition, mission)
        tick, off_m = flown[-1].nearest_tick, flown[-1].nearest_m
        if any(passage.tick is None for passage in flown[:-1]):
            tick = context.phase(mission, self.touchdown_m).stop_tick - 1
            end = context.position(mission)[tick : tick + 1]
            tolerances_m = (mission.waypoint_horizontal_m, mission.altitude_tolerance_m)
            off_m = float(approach(end, mission.waypoints[-1], *tolerances_m)[0])
        story = f'{mission.uav} came within {off_m:.2f} m of where its route began'
        return at_tick(tick, off_m, story, route_topics(condition))


def implied(inputs: Inputs, mission: MissionArguments, source: Source) -> Condition:
    """Return that a route ends where it began."""
    return condition(
        id=f'{mission.mission}.closed',
        sentence=f'{mission.uav} closes its route where it began',
        of=(mission.uav,),
        target=Target(op='<=', threshold=inputs.tolerances.waypoint_horizontal_m, unit='m'),
        arguments=RouteClosed(**inputs.common, mission=mission),
        source=source,
        every_sample=False,
    )
