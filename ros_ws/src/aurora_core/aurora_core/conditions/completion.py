# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""When a mission is completed and a UAV has landed, be it implied or stated."""

from __future__ import annotations

from aurora_core.conditions.build import Inputs, Source, Target, condition, number
from aurora_core.outcomes.condition import Condition, MissionArguments, Window
from aurora_core.spec.quantity import QuantityName


def completed_condition(
    inputs: Inputs, arguments: MissionArguments, *, id: str, source: Source
) -> Condition:
    """Return that a mission is completed: it lasts as long as planned, or its route is flown."""
    uav, mission = arguments.uav, arguments.mission
    if arguments.planned_s is None:
        return condition(
            id=id,
            sentence=f'{uav} has flown the whole route of {mission} when the phase ends',
            quantity=QuantityName.MISSION_COMPLETED,
            signal=f'time_after_route({uav},{mission})',
            of=(uav,),
            target=Target(op='>=', threshold=0.0, unit='s'),
            arguments=inputs.arguments(Window.PHASE, aspect='route', mission=arguments),
            source=source,
            every_sample=False,
        )
    planned_s = arguments.planned_s
    least_s = max(0.0, planned_s - inputs.tolerances.duration_s.of(planned_s))
    return condition(
        id=id,
        sentence=f'{uav} stays on {mission} for at least {number(least_s)} s',
        quantity=QuantityName.MISSION_COMPLETED,
        signal=f'phase_time({uav},{mission})',
        of=(uav,),
        target=Target(op='>=', threshold=least_s, unit='s'),
        arguments=inputs.arguments(Window.PHASE, aspect='time', mission=arguments),
        source=source,
        every_sample=False,
    )


def deadline_condition(
    inputs: Inputs, arguments: MissionArguments, by_s: float, *, id: str, source: Source
) -> Condition:
    """Return that a mission is over by a time from scenario start, completed or not.

    Args:
        inputs: The request.
        arguments: The mission.
        by_s: Deadline.
        id: Of the condition.
        source: Where it comes from.
    """
    uav, mission = arguments.uav, arguments.mission
    return condition(
        id=id,
        sentence=f'{mission} of {uav} is over by {number(by_s)} s',
        quantity=QuantityName.MISSION_COMPLETED,
        signal=f'end_of_mission({uav},{mission})',
        of=(uav,),
        target=Target(op='<=', threshold=by_s, unit='s'),
        arguments=inputs.arguments(Window.PHASE, aspect='end', mission=arguments),
        source=source,
        every_sample=False,
    )


def landed_condition(
    inputs: Inputs,
    missions: tuple[MissionArguments, ...],
    *,
    id: str,
    source: Source,
    by_s: float | None = None,
) -> Condition:
    """Return that a UAV has landed after its missions.

    Args:
        inputs: The request.
        missions: All missions of the UAV, at least one.
        id: Of the condition.
        source: Where it comes from.
        by_s: Deadline from scenario start; default: the horizon.
    """
    uav = missions[-1].uav
    deadline_s = inputs.facts.horizon_s if by_s is None else by_s
    return condition(
        id=id,
        sentence=f'{uav} has landed by {number(deadline_s)} s',
        quantity=QuantityName.LANDED,
        signal=f'landing_time({uav})',
        of=(uav,),
        target=Target(op='<=', threshold=deadline_s, unit='s'),
        arguments=inputs.arguments(Window.RUN, missions=missions),
        source=source,
        every_sample=False,
    )
