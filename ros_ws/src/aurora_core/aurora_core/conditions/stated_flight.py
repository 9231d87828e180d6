# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Stated conditions on the course of a flight: waypoints, missions completed, landing."""

from __future__ import annotations

from collections.abc import Iterator

from aurora_core.conditions.stated_values import (
    CannotSayError,
    asked_true,
    missions_of,
    only,
    sentence_of,
    source_of,
    target_of,
    value_of,
)
from aurora_core.judging.build import Inputs, Target, condition
from aurora_core.judging.mission import mission_arguments, missions_of_uav
from aurora_core.judging.quantities import landed, mission_completed
from aurora_core.judging.quantities.waypoints_visited import WaypointsVisited
from aurora_core.outcomes.condition import Condition
from aurora_core.spec.scenario import StatedCondition
from aurora_core.spec.vocabulary import MissionMode

FLIGHT_QUANTITIES = frozenset({'waypoints_visited', 'mission_completed', 'landed'})


def stated_flight(inputs: Inputs, stated: StatedCondition) -> Iterator[Condition]:
    """Yield the conditions on the flight of the UAV that a stated one names.

    Raises:
        CannotSayError: It flies no such mission, or the comparison has no meaning.
    """
    mode = MissionMode.NAVIGATE if stated.quantity == 'waypoints_visited' else None
    missions = missions_of(inputs, stated, mode)
    if not missions or len(stated.of) != 1:
        raise CannotSayError(f'{stated.quantity} without a mission of {", ".join(stated.of)}')
    source = source_of(stated)
    if stated.quantity == 'landed':
        only(stated, 'by_s')
        asked_true(stated)
        yield landed.by_deadline(
            inputs,
            missions_of_uav(inputs, missions[0].uav),
            id=f'{stated.id}.holds',
            source=source,
            by_s=value_of(stated.by_s),
        )
        return
    completed = stated.quantity == 'mission_completed'
    only(stated, 'by_s')
    for mission in missions:
        name = f'{stated.id}.holds' + (f'.{mission.id}' if len(missions) > 1 else '')
        arguments = mission_arguments(inputs, mission)
        if completed:
            asked_true(stated)
            yield mission_completed.completed(inputs, arguments, id=name, source=source)
            by_s = value_of(stated.by_s)
            if by_s is not None:
                late = name.replace('.holds', '.deadline', 1)
                yield mission_completed.deadline(inputs, arguments, by_s, id=late, source=source)
            continue
        asked = target_of(inputs.tolerances, stated)
        if asked.op == '==':
            # A pattern that has been flown has no further waypoints (contract: they are the same).
            asked = Target(op='>=', threshold=asked.threshold, unit=asked.unit)
        yield condition(
            id=name,
            sentence=sentence_of(stated),
            of=stated.of,
            target=asked,
            arguments=WaypointsVisited(
                **inputs.common, mission=arguments, by_s=value_of(stated.by_s)
            ),
            source=source,
            every_sample=False,
        )
