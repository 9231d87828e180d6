# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The safety conditions of every run.

Limits hold for commanded values as they are; realised values have 1 % or the tolerance of their
kind.
"""

from __future__ import annotations

from collections.abc import Iterator
from itertools import combinations

from aurora_core.judging.build import Inputs
from aurora_core.judging.mission import missions_of_uav
from aurora_core.judging.quantities import (
    altitude,
    climb_rate,
    collision_clearance,
    endurance,
    jump,
    no_fly_distance,
    obstacle_clearance,
    presence,
    separation,
    speed,
)
from aurora_core.outcomes.condition import Condition
from aurora_core.spec.vocabulary import AgentType


def safety_conditions(inputs: Inputs) -> Iterator[Condition]:
    """Yield the conditions that every run has to keep."""
    agents = tuple(agent.id for agent in inputs.spec.agents)
    uavs = tuple(uav.id for uav in inputs.spec.uavs)
    bodies = agents + uavs
    if agents and len(bodies) > 1:
        yield collision_clearance.implied(inputs, bodies)
    if agents:
        yield presence.implied(inputs, agents)
    if bodies:
        yield jump.implied(inputs, bodies)
    persons = tuple(a.id for a in inputs.spec.agents if a.type is AgentType.PEDESTRIAN)
    vehicles = tuple(a for a in agents if a not in persons)
    yield from speed.ground_limits(inputs, persons, vehicles)
    for uav in uavs:
        yield obstacle_clearance.implied(inputs, uav)
        yield from altitude.limits(inputs, uav, missions_of_uav(inputs, uav))
        yield from speed.flight_limits(inputs, uav)
        yield from climb_rate.implied(inputs, uav)
        yield no_fly_distance.implied(inputs, uav)
        yield endurance.implied(inputs, uav)
    for a, b in combinations(uavs, 2):
        yield separation.implied(inputs, a, b)
