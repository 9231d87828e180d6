# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Conditions implied by missions: order, capture, tracking, route, altitude, landing."""

from __future__ import annotations

from collections.abc import Iterator

from aurora_core.conditions.routes import route_conditions
from aurora_core.judging.build import Inputs, Source, Underivable, stated_by
from aurora_core.judging.mission import mission_arguments, missions_of_uav
from aurora_core.judging.quantities import (
    altitude,
    altitude_fraction,
    capture_time,
    horizontal_distance,
    hover_drift,
    landed,
    mission_completed,
    pattern_centre,
    phase_duration,
    relation_fraction,
    side_fraction,
    tracked_fraction,
    visible_fraction,
)
from aurora_core.outcomes.condition import Condition, MissionArguments
from aurora_core.spec.parameter import Parameter, Provenance
from aurora_core.spec.scenario import UavMission
from aurora_core.spec.vocabulary import MissionMode


def mission_conditions(inputs: Inputs) -> Iterator[Condition | Underivable]:
    """Yield the conditions of all missions and the landings of their UAVs."""
    for mission in inputs.spec.missions:
        arguments = mission_arguments(inputs, mission)
        source = Source(ids=(mission.id,), spans=(mission.span,))
        yield from _course(inputs, mission, arguments, source)
        yield from _numbers(inputs, mission, arguments, source)
        if mission.mode is MissionMode.TRACK:
            yield from _track(inputs, mission, arguments, source)
        elif mission.mode is MissionMode.HOVER:
            yield from _hover(inputs, mission, arguments, source)
        else:
            yield from route_conditions(inputs, mission, arguments, source)
    for uav in inputs.spec.uavs:
        missions = [m for m in inputs.spec.missions if m.uav == uav.id]
        if not missions:
            continue
        flown = missions_of_uav(inputs, uav.id)
        source = Source(ids=tuple(m.id for m in missions), spans=tuple(m.span for m in missions))
        if missions[-1].ends_in_flight:
            yield altitude.stays_up(inputs, flown, source)
        else:
            yield landed.by_deadline(inputs, flown, id=f'{uav.id}.landed', source=source)


def _stated(parameter: Parameter | None) -> Parameter | None:
    """Return a number that the prompt states, None for all others."""
    explicit = parameter is not None and parameter.provenance is Provenance.EXPLICIT
    return parameter if explicit else None


def _course(
    inputs: Inputs, mission: UavMission, arguments: MissionArguments, source: Source
) -> Iterator[Condition]:
    facts = inputs.mission_facts(mission.id)
    assert facts is not None  # `arguments` was made from them
    sentence = f'{mission.uav} flies {mission.id} in order, after its ascent and before it lands'
    yield mission_completed.in_order(
        inputs, arguments, source, id=f'{mission.id}.order', sentence=sentence
    )
    yield capture_time.implied(inputs, arguments, facts, source)
    # What an event may end is as long as it is; a stated length is a number like others.
    if arguments.left_by is None or mission.mode is MissionMode.NAVIGATE:
        yield mission_completed.completed(
            inputs, arguments, id=f'{mission.id}.completed', source=source
        )


def _numbers(
    inputs: Inputs, mission: UavMission, arguments: MissionArguments, source: Source
) -> Iterator[Condition | Underivable]:
    """Yield the conditions that explicit altitude, duration and bearing imply.

    No route is flown at a distance from what it is about, nor in a direction from it.
    """
    if altitude := _stated(mission.altitude_m):
        yield altitude_fraction.implied(inputs, arguments, altitude, source)
        if mission.has_a_level_way:
            yield altitude_fraction.on_the_way(inputs, arguments, altitude, source)
    if duration := _stated(mission.duration_s):
        yield phase_duration.implied(inputs, arguments, duration, source)
    standoff = _stated(mission.standoff_m)
    if standoff is not None and mission.mode is MissionMode.NAVIGATE:
        what = 'a distance of a pattern from its place'
        yield Underivable(element=mission.id, what=what, span=standoff.span)
    bearing = _stated(mission.bearing_deg)
    if bearing is None:
        return
    if mission.target is None or mission.mode is MissionMode.NAVIGATE:
        what = 'a bearing without a target'
        yield Underivable(element=mission.id, what=what, span=bearing.span)
        return
    yield relation_fraction.bearing_kept(inputs, arguments, bearing, mission.target, source)


def _track(
    inputs: Inputs, mission: UavMission, arguments: MissionArguments, source: Source
) -> Iterator[Condition]:
    target = mission.target
    assert target is not None  # the specification refuses a track without one
    if standoff := _stated(mission.standoff_m):
        source = stated_by(source, standoff)
    yield tracked_fraction.implied(inputs, arguments, target, source)
    if mission.side is not None:
        told = Source(ids=(mission.id,), spans=(mission.span,))
        yield side_fraction.implied(inputs, arguments, mission.side, target, told)
    yield visible_fraction.implied(inputs, arguments, target, source)


def _hover(
    inputs: Inputs, mission: UavMission, arguments: MissionArguments, source: Source
) -> Iterator[Condition | Underivable]:
    yield hover_drift.implied(inputs, arguments, source)
    target = mission.target
    if target is not None:
        yield visible_fraction.implied(inputs, arguments, target, source)
    standoff = _stated(mission.standoff_m)
    if standoff is None:
        if target is not None and mission.bearing_deg is None:
            yield pattern_centre.of_hover(inputs, arguments, target, source)
        return
    if target is None:
        what = 'a standoff without a target'
        yield Underivable(element=mission.id, what=what, span=standoff.span)
        return
    yield horizontal_distance.of_hover(inputs, arguments, standoff, target, source)
