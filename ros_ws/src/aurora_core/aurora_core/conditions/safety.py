# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The safety conditions of every run.

Limits hold for commanded values as they are; realised values have 1 % or the tolerance of their
kind.
"""

from __future__ import annotations

from collections.abc import Iterator
from itertools import combinations

from aurora_core.conditions.build import Inputs, Source, Target, condition, number
from aurora_core.conditions.missions import mission_arguments
from aurora_core.outcomes.condition import Condition, Window
from aurora_core.spec.quantity import QuantityName
from aurora_core.spec.vocabulary import AgentType

_SOURCE = Source(ids=())


def safety_conditions(inputs: Inputs) -> Iterator[Condition]:
    """Yield the conditions that every run has to keep."""
    agents = tuple(agent.id for agent in inputs.spec.agents)
    uavs = tuple(uav.id for uav in inputs.spec.uavs)
    bodies = agents + uavs
    run = inputs.arguments(Window.RUN)
    if agents and len(bodies) > 1:
        yield condition(
            id='safety.collision',
            sentence='no two bodies overlap',
            quantity=QuantityName.COLLISION_CLEARANCE,
            signal='gap(all)',
            of=bodies,
            target=Target(op='>', threshold=0.0, unit='m'),
            arguments=run,
            source=_SOURCE,
        )
    if agents:
        yield condition(
            id='safety.presence',
            sentence='every ground agent is there from t = 0 to the end',
            quantity=QuantityName.PRESENCE,
            signal='present(all)',
            of=agents,
            target=Target(op='>=', threshold=0.5, unit='1'),
            arguments=run,
            source=_SOURCE,
        )
    if bodies:
        limit = inputs.tolerances.jump_speed_mps
        yield condition(
            id='safety.jump',
            sentence=f'no body jumps: at most {number(limit)} m/s from tick to tick',
            quantity=QuantityName.JUMP,
            signal='jump(all)',
            of=bodies,
            target=Target(op='<=', threshold=limit, unit='m/s'),
            arguments=run,
            source=_SOURCE,
        )
    yield from _ground_speeds(inputs)
    for uav in uavs:
        yield from _flight(inputs, uav)
    for a, b in combinations(uavs, 2):
        limit = inputs.limits.separation_min_m
        yield condition(
            id=f'safety.separation.{a}.{b}',
            sentence=f'{a} and {b} keep {number(limit)} m apart while one of them flies',
            quantity=QuantityName.SEPARATION,
            of=(a, b),
            target=Target(op='>=', threshold=limit, unit='m'),
            arguments=inputs.arguments(Window.AIRBORNE),
            source=_SOURCE,
        )


def _ground_speeds(inputs: Inputs) -> Iterator[Condition]:
    persons = tuple(a.id for a in inputs.spec.agents if a.type is AgentType.PEDESTRIAN)
    vehicles = tuple(a.id for a in inputs.spec.agents if a.id not in persons)
    for name, of, limit in (
        ('vehicle_speed', vehicles, inputs.limits.vehicle_speed_max_mps),
        ('pedestrian_speed', persons, inputs.limits.pedestrian_speed_max_mps),
    ):
        if of:
            bound = limit * (1.0 + inputs.tolerances.limit_margin)
            yield condition(
                id=f'safety.{name}',
                sentence=f'{name.replace("_", " ")} at most {number(limit)} m/s',
                quantity=QuantityName.SPEED,
                signal=f'greatest_{name}(all)',
                of=of,
                target=Target(op='<=', threshold=bound, unit='m/s'),
                arguments=inputs.arguments(Window.RUN, aspect='greatest'),
                source=_SOURCE,
            )


def _flight(inputs: Inputs, uav: str) -> Iterator[Condition]:
    limits, tolerances = inputs.limits, inputs.tolerances
    missions = tuple(mission_arguments(inputs, m) for m in inputs.spec.missions if m.uav == uav)
    airborne = inputs.arguments(Window.AIRBORNE)
    yield condition(
        id=f'safety.clearance.{uav}',
        sentence=(
            f'{uav} keeps {number(limits.clearance_min_m)} m from buildings, vehicles and persons'
        ),
        quantity=QuantityName.OBSTACLE_CLEARANCE,
        of=(uav,),
        target=Target(op='>=', threshold=limits.clearance_min_m, unit='m'),
        arguments=airborne,
        source=_SOURCE,
    )
    high = limits.uav_altitude_max_m
    yield condition(
        id=f'safety.altitude_max.{uav}',
        sentence=f'{uav} flies at most {number(high)} m high',
        quantity=QuantityName.ALTITUDE,
        of=(uav,),
        target=Target(op='<=', threshold=high + tolerances.altitude_m.of(high), unit='m'),
        arguments=airborne,
        source=_SOURCE,
    )
    if missions:
        low = limits.uav_altitude_min_m
        yield condition(
            id=f'safety.altitude_min.{uav}',
            sentence=f'{uav} flies at least {number(low)} m high while on mission',
            quantity=QuantityName.ALTITUDE,
            of=(uav,),
            target=Target(
                op='>=', threshold=max(0.0, low - tolerances.altitude_m.of(low)), unit='m'
            ),
            arguments=inputs.arguments(Window.ON_MISSION, missions=missions),
            source=_SOURCE,
        )
        yield condition(
            id=f'safety.altitude_command.{uav}',
            sentence=(
                f'{uav} is commanded to between {number(low)} m and {number(high)} m while on '
                'mission'
            ),
            quantity=QuantityName.ALTITUDE,
            signal=f'commanded_altitude({uav})',
            of=(uav,),
            target=Target(
                op='==', threshold=(low + high) / 2.0, unit='m', tolerance=(high - low) / 2.0
            ),
            arguments=inputs.arguments(Window.ON_MISSION, aspect='commanded', missions=missions),
            source=_SOURCE,
        )
    yield from _speeds(inputs, uav)
    yield condition(
        id=f'safety.no_fly.{uav}',
        sentence=f'{uav} enters no no-fly zone',
        quantity=QuantityName.NO_FLY_DISTANCE,
        of=(uav,),
        target=Target(op='>=', threshold=0.0, unit='m'),
        arguments=airborne,
        source=_SOURCE,
    )
    yield condition(
        id=f'safety.endurance.{uav}',
        sentence=f'{uav} flies at most {number(limits.uav_endurance_s)} s',
        quantity=QuantityName.ENDURANCE,
        of=(uav,),
        target=Target(
            op='<=', threshold=limits.uav_endurance_s * (1.0 + tolerances.limit_margin), unit='s'
        ),
        arguments=airborne,
        source=_SOURCE,
        every_sample=False,
    )


def _speeds(inputs: Inputs, uav: str) -> Iterator[Condition]:
    limits, tolerances = inputs.limits, inputs.tolerances
    margin = 1.0 + tolerances.limit_margin
    top = limits.uav_speed_max_mps
    airborne = Window.AIRBORNE
    yield condition(
        id=f'safety.speed.{uav}',
        sentence=f'{uav} flies at most {number(top)} m/s over ground',
        quantity=QuantityName.SPEED,
        signal=f'horizontal_speed({uav})',
        of=(uav,),
        target=Target(op='<=', threshold=top + tolerances.route_speed_mps.of(top), unit='m/s'),
        arguments=inputs.arguments(airborne, aspect='horizontal'),
        source=_SOURCE,
    )
    yield condition(
        id=f'safety.speed_command.{uav}',
        sentence=f'{uav} is commanded to at most {number(top)} m/s over ground',
        quantity=QuantityName.SPEED,
        signal=f'commanded_speed({uav})',
        of=(uav,),
        # The length of a vector scaled to the limit may exceed it in the last bit.
        target=Target(op='<=', threshold=top * (1.0 + _ROUNDING), unit='m/s'),
        arguments=inputs.arguments(airborne, aspect='commanded'),
        source=_SOURCE,
    )
    yield condition(
        id=f'safety.climb.{uav}',
        sentence=f'{uav} climbs with at most {number(limits.uav_climb_max_mps)} m/s',
        quantity=QuantityName.CLIMB_RATE,
        of=(uav,),
        target=Target(op='<=', threshold=limits.uav_climb_max_mps * margin, unit='m/s'),
        arguments=inputs.arguments(airborne),
        source=_SOURCE,
    )
    yield condition(
        id=f'safety.descent.{uav}',
        sentence=f'{uav} descends with at most {number(limits.uav_descent_max_mps)} m/s',
        quantity=QuantityName.CLIMB_RATE,
        of=(uav,),
        target=Target(op='>=', threshold=-limits.uav_descent_max_mps * margin, unit='m/s'),
        arguments=inputs.arguments(airborne),
        source=_SOURCE,
    )


_ROUNDING = 1e-9
