# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Conditions on the scene as a whole: who is in it and how many, which world, how long."""

from __future__ import annotations

from collections.abc import Iterator

from aurora_core.conditions.build import (
    Inputs,
    Source,
    Target,
    condition,
    number,
    number_target,
    stated_by,
)
from aurora_core.knowledge.limits import Tolerance
from aurora_core.outcomes.condition import Condition, Window
from aurora_core.spec.parameter import Parameter, Provenance, Span
from aurora_core.spec.prohibitions import ForbiddenAgent
from aurora_core.spec.quantity import QuantityName
from aurora_core.spec.reference import ENVIRONMENT_ID
from aurora_core.spec.requirements import SceneCount
from aurora_core.spec.scenario import GroundAgent
from aurora_core.spec.scene import World
from aurora_core.spec.vocabulary import AgentType

UAV_TYPE = 'uav'
_EXACT = Tolerance(absolute=0.0, relative=0.0)
_WORLD = World()


def scene_conditions(inputs: Inputs) -> Iterator[Condition]:
    """Yield the conditions on world, duration and numbers of bodies."""
    yield from _world(inputs)
    yield from _numbers(inputs)
    for count in inputs.spec.counts:
        yield _count(inputs, count)
    for prohibition in inputs.spec.prohibitions:
        if isinstance(prohibition, ForbiddenAgent):
            yield _absent(inputs, prohibition)


def _world(inputs: Inputs) -> Iterator[Condition]:
    world = inputs.spec.world
    settings: tuple[tuple[str, str, Span | None], ...] = (
        ('weather', world.weather.value, world.weather_span),
        ('time_of_day', world.time_of_day.value, world.time_of_day_span),
        ('map_name', world.map_name, None),
    )
    for name, asked, span in settings:
        # What the request leaves open may be any.
        if span is None and asked == getattr(_WORLD, name):
            continue
        yield condition(
            id=f'world.{name}',
            sentence=f'the {name.replace("_", " ")} of the run is {asked.replace("_", " ")}',
            quantity=QuantityName.WORLD_SETTING,
            signal=f'{name}_is_{asked}',
            of=(),
            target=Target(op='>=', threshold=1.0, unit='1'),
            arguments=inputs.arguments(Window.RUN, aspect=name, types=(asked,)),
            source=Source(ids=(ENVIRONMENT_ID,), spans=(span,)),
        )
    if world.duration_s is not None and world.duration_s.provenance is Provenance.EXPLICIT:
        yield _duration(inputs, world.duration_s)


def _duration(inputs: Inputs, duration: Parameter) -> Condition:
    return condition(
        id='world.duration',
        sentence=f'the scenario lasts {number(duration.value)} s',
        quantity=QuantityName.RUN_DURATION,
        signal='last_tick_time',
        of=(),
        target=number_target(duration, inputs.tolerances.duration_s),
        arguments=inputs.arguments(Window.RUN),
        source=stated_by(Source(ids=(ENVIRONMENT_ID,)), duration),
        every_sample=False,
    )


def _numbers(inputs: Inputs) -> Iterator[Condition]:
    """Yield how many bodies of each type there are, unasked traffic in the background aside."""
    asked: dict[str, list[GroundAgent]] = {}
    for agent in inputs.spec.agents:
        asked.setdefault(agent.type.value, []).append(agent)
    rows = [
        (kind, tuple(a.id for a in agents), tuple(a.span for a in agents))
        for kind, agents in sorted(asked.items())
    ]
    if inputs.spec.uavs:
        uavs = inputs.spec.uavs
        rows.append((UAV_TYPE, tuple(u.id for u in uavs), tuple(u.span for u in uavs)))
    for kind, ids, spans in rows:
        yield condition(
            id=f'scene.{kind}',
            sentence=f'as many of the type {kind} take part as are asked for: {len(ids)}',
            quantity=QuantityName.COUNT,
            signal=f'count({kind})',
            of=ids,
            target=Target(op='==', threshold=float(len(ids)), unit='1', tolerance=0.0),
            arguments=inputs.arguments(Window.RUN, types=(kind,)),
            source=Source(ids=ids, spans=spans),
        )


def types_counted(kind: str) -> tuple[str, ...]:
    """Return the types of the vocabulary that a stated number is about.

    Args:
        kind: A type, `uav`, `vehicle`, `person` or `body` (all of them).
    """
    walks = AgentType.PEDESTRIAN.value
    stands = AgentType.RSU.value
    drives = tuple(t.value for t in AgentType if t.value not in (walks, stands))
    groups = {'vehicle': drives, 'person': (walks,), 'body': (*drives, walks, UAV_TYPE)}
    return groups.get(kind, (kind,))


def _count(inputs: Inputs, count: SceneCount) -> Condition:
    value = count.value
    return condition(
        id=f'{count.id}.holds',
        sentence=(
            f'{value.bound.value.replace("_", " ")} {number(value.value)} of the kind '
            f'{count.kind} in the whole scene'
        ),
        quantity=QuantityName.COUNT,
        signal=f'count_all({count.kind})',
        of=(),
        target=number_target(value, _EXACT),
        arguments=inputs.arguments(Window.RUN, aspect='all', types=types_counted(count.kind)),
        source=Source(
            ids=(count.id,),
            spans=(count.span, value.span),
            provenance=value.provenance,
            implied=False,
        ),
    )


def _absent(inputs: Inputs, forbidden: ForbiddenAgent) -> Condition:
    return condition(
        id=f'{forbidden.id}.holds',
        sentence=f'there is no {forbidden.type} in the whole scene',
        quantity=QuantityName.COUNT,
        signal=f'count_all({forbidden.type})',
        of=(),
        target=Target(op='==', threshold=0.0, unit='1', tolerance=0.0),
        arguments=inputs.arguments(Window.RUN, aspect='all', types=(str(forbidden.type),)),
        source=Source(
            ids=(forbidden.id,),
            spans=(forbidden.span,),
            provenance=Provenance.EXPLICIT,
            implied=False,
        ),
    )
