# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Conditions on the scene as a whole: who is in it and how many, which world, how long."""

from __future__ import annotations

from collections.abc import Iterator

from aurora_core.grounding.traffic import has_room_for_traffic
from aurora_core.judging.build import Inputs
from aurora_core.judging.quantities import (
    count,
    run_duration,
    traffic,
    wind,
    wind_blown,
    world_setting,
)
from aurora_core.judging.quantities.world_setting import Setting
from aurora_core.outcomes.condition import Condition
from aurora_core.spec.parameter import Provenance, Span
from aurora_core.spec.requirements import UAV_TYPE
from aurora_core.spec.scenario import GroundAgent
from aurora_core.spec.scene import World

_WORLD = World()


def scene_conditions(inputs: Inputs) -> Iterator[Condition]:
    """Yield the conditions on world, duration and numbers of bodies."""
    yield from _world(inputs)
    yield from _numbers(inputs)
    for asked in inputs.spec.counts:
        yield count.stated(inputs, asked)


def _world(inputs: Inputs) -> Iterator[Condition]:
    world = inputs.spec.world
    settings: tuple[tuple[Setting, str, Span | None], ...] = (
        ('weather', world.weather.value, world.weather_span),
        ('time_of_day', world.time_of_day.value, world.time_of_day_span),
        ('map_name', world.map_name, None),
    )
    for name, asked, span in settings:
        # What the request leaves open may be any.
        if span is not None or asked != getattr(_WORLD, name):
            yield world_setting.implied(inputs, name, asked, span)
    yield from _wind(inputs)
    if world.traffic_density is not None and has_room_for_traffic(inputs.spec):
        yield traffic.implied(inputs, world.traffic_density)
    duration = world.duration_s
    if duration is not None and duration.provenance is Provenance.EXPLICIT:
        yield run_duration.implied(inputs, duration)


def _wind(inputs: Inputs) -> Iterator[Condition]:
    """Yield that the wind is the one that is named."""
    world = inputs.spec.world
    speed, origin = world.wind_mps, world.wind_from_deg
    if speed is not None and speed.provenance is Provenance.EXPLICIT:
        yield wind.speed(inputs, speed)
    if world.gust_mps is not None and world.gust_mps.provenance is Provenance.EXPLICIT:
        yield wind.gusts(inputs, world.gust_mps)
    if origin is not None and origin.provenance is Provenance.EXPLICIT:
        yield wind.origin(inputs, origin)
    if world.wind is not None:
        yield wind.course(inputs, world.wind, world.wind_span)
    if not world.names_wind and world.gust_mps is None:
        return
    for uav in inputs.spec.uavs:
        # What is recorded says what was to blow: a flight shows what did.
        yield wind_blown.blown(inputs, uav.id)
        shaken = wind_blown.gusts_blown(inputs, uav.id)
        if shaken is not None:
            yield shaken


def _numbers(inputs: Inputs) -> Iterator[Condition]:
    """Yield how many bodies of each type there are, unasked traffic in the background aside."""
    asked: dict[str, list[GroundAgent]] = {}
    for agent in inputs.spec.agents:
        asked.setdefault(agent.type.value, []).append(agent)
    for kind, agents in sorted(asked.items()):
        ids, spans = tuple(a.id for a in agents), tuple(a.span for a in agents)
        yield count.implied(inputs, kind, ids, spans)
    uavs = inputs.spec.uavs
    if uavs:
        ids, spans = tuple(u.id for u in uavs), tuple(u.span for u in uavs)
        yield count.implied(inputs, UAV_TYPE, ids, spans)
