# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Conditions implied by missions: order, capture, tracking, route, altitude, landing."""

from __future__ import annotations

from collections.abc import Iterator

from aurora_core.conditions.build import (
    Inputs,
    Source,
    Target,
    Underivable,
    bound_words,
    condition,
    number,
    number_target,
    stated_by,
)
from aurora_core.conditions.completion import completed_condition, landed_condition
from aurora_core.conditions.routes import route_conditions
from aurora_core.errors import VerificationError
from aurora_core.knowledge.limits import hover_drift_limit_m
from aurora_core.outcomes.condition import Condition, MissionArguments, Window
from aurora_core.outcomes.schedule import MissionFacts
from aurora_core.spec.parameter import Bound, Parameter, Provenance
from aurora_core.spec.quantity import QuantityName
from aurora_core.spec.scenario import UavMission
from aurora_core.spec.vocabulary import MissionMode


def mission_arguments(inputs: Inputs, mission: UavMission) -> MissionArguments:
    """Return a mission as it is measured; grounding takes its capture tolerances from here.

    Raises:
        VerificationError: The plan has no facts of the mission, or facts that do not fit it.
    """
    facts = inputs.mission_facts(mission.id)
    if facts is None:
        raise VerificationError(f'the plan has no facts of mission {mission.id}')
    own = [m for m in inputs.spec.missions if m.uav == mission.uav]
    first_facts = inputs.mission_facts(own[0].id)
    if first_facts is None:
        raise VerificationError(f'the plan has no facts of mission {own[0].id}')
    tolerances = inputs.tolerances
    altitude = _explicit_or(mission.altitude_m, facts.altitude_m)
    altitude_slack = _slack(mission.altitude_m, altitude, inputs)
    standoff = _explicit_or(mission.standoff_m, facts.standoff_m or 0.0)
    standoff_slack = inputs.limits.tracking_horizontal_m
    if mission.standoff_m is not None and mission.standoff_m.provenance is Provenance.EXPLICIT:
        standoff_slack = tolerances.standoff_m.of(
            standoff, approximate=mission.standoff_m.approximate
        )
    first_altitude = _explicit_or(own[0].altitude_m, first_facts.altitude_m)
    point = _first_point(mission, facts)
    track = mission.mode is MissionMode.TRACK
    hover = mission.mode is MissionMode.HOVER
    horizontal = (
        hover_drift_limit_m(inputs.spec.world.weather.value, inputs.limits, tolerances)
        if hover
        else tolerances.waypoint_horizontal_m
    )
    return MissionArguments(
        mission=mission.id,
        uav=mission.uav,
        index=own.index(mission),
        mode=mission.mode,
        target=mission.target,
        altitude_m=altitude,
        altitude_bound=mission.altitude_m.bound,
        altitude_tolerance_m=altitude_slack,
        capture_altitude_m=inputs.limits.tracking_altitude_m if track else altitude_slack,
        capture_horizontal_m=horizontal,
        point_m=point,
        standoff_m=standoff,
        standoff_bound=Bound.EXACTLY if mission.standoff_m is None else mission.standoff_m.bound,
        standoff_tolerance_m=standoff_slack,
        tracking_altitude_m=inputs.limits.tracking_altitude_m,
        first_altitude_m=first_altitude,
        first_altitude_tolerance_m=_slack(own[0].altitude_m, first_altitude, inputs),
        planned_s=facts.duration_s,
        waypoints=facts.waypoints,
        waypoint_horizontal_m=tolerances.waypoint_horizontal_m,
    )


def _explicit_or(parameter: Parameter | None, realised: float) -> float:
    explicit = parameter is not None and parameter.provenance is Provenance.EXPLICIT
    # A one-sided number is a limit, not the value that was chosen inside it.
    if parameter is not None and explicit and parameter.bound is Bound.EXACTLY:
        return parameter.value
    return realised


def _slack(parameter: Parameter, value: float, inputs: Inputs) -> float:
    return inputs.tolerances.altitude_m.of(value, approximate=parameter.approximate)


def _first_point(mission: UavMission, facts: MissionFacts) -> tuple[float, float] | None:
    if mission.mode is MissionMode.HOVER:
        if facts.hover_point is None:
            raise VerificationError(f'the plan has no hover point for mission {mission.id}')
        return facts.hover_point[0], facts.hover_point[1]
    if mission.mode is MissionMode.NAVIGATE:
        if len(facts.waypoints) < 2:
            raise VerificationError(
                f'mission {mission.id} needs at least 2 waypoints, the plan has '
                f'{len(facts.waypoints)}'
            )
        return facts.waypoints[0][0], facts.waypoints[0][1]
    return None


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
        if missions and not missions[-1].ends_in_flight:
            yield landed_condition(
                inputs,
                tuple(mission_arguments(inputs, m) for m in missions),
                id=f'{uav.id}.landed',
                source=Source(
                    ids=tuple(m.id for m in missions), spans=tuple(m.span for m in missions)
                ),
            )


def _course(
    inputs: Inputs, mission: UavMission, arguments: MissionArguments, source: Source
) -> Iterator[Condition]:
    facts = inputs.mission_facts(mission.id)
    assert facts is not None  # `arguments` was made from them
    uav = mission.uav
    yield condition(
        id=f'{mission.id}.order',
        sentence=f'{uav} flies {mission.id} in order, after its ascent and before it lands',
        quantity=QuantityName.MISSION_COMPLETED,
        signal=f'phase_order({uav},{mission.id})',
        of=(uav,),
        target=Target(op='>=', threshold=0.0, unit='s'),
        arguments=inputs.arguments(Window.MOMENT, aspect='order', mission=arguments),
        source=source,
        every_sample=False,
    )
    allowed = inputs.tolerances.capture_s + facts.transit_m / facts.transit_speed_mps
    yield condition(
        id=f'{mission.id}.capture',
        sentence=f'{uav} captures {mission.id} within {number(allowed)} s after its ascent',
        quantity=QuantityName.CAPTURE_TIME,
        of=(uav,),
        target=Target(op='<=', threshold=allowed, unit='s'),
        arguments=inputs.arguments(Window.MOMENT, mission=arguments),
        source=source,
        every_sample=False,
    )
    yield completed_condition(inputs, arguments, id=f'{mission.id}.completed', source=source)


def _numbers(
    inputs: Inputs, mission: UavMission, arguments: MissionArguments, source: Source
) -> Iterator[Condition | Underivable]:
    """Yield the conditions that explicit altitude, duration and bearing imply."""
    uav, altitude = mission.uav, mission.altitude_m
    if altitude.provenance is Provenance.EXPLICIT:
        share = inputs.tolerances.altitude_share
        slack = inputs.tolerances.altitude_m.of(altitude.value, approximate=altitude.approximate)
        yield condition(
            id=f'{mission.id}.altitude',
            sentence=(
                f'{uav} keeps {bound_words(altitude)} {number(altitude.value)} m altitude '
                f'for {number(100 * share)} % of {mission.id}'
            ),
            quantity=QuantityName.ALTITUDE_FRACTION,
            of=(uav,),
            target=Target(op='>=', threshold=share, unit='1'),
            fraction=share,
            arguments=inputs.arguments(
                Window.PHASE,
                mission=arguments,
                bound=altitude.bound,
                wanted=altitude.value,
                sample_tolerance=0.0 if altitude.bound is not Bound.EXACTLY else slack,
            ),
            source=stated_by(source, altitude),
            every_sample=False,
        )
    duration = mission.duration_s
    if duration is not None and duration.provenance is Provenance.EXPLICIT:
        yield condition(
            id=f'{mission.id}.duration',
            sentence=f'{mission.id} lasts {bound_words(duration)} {number(duration.value)} s',
            quantity=QuantityName.PHASE_DURATION,
            of=(uav,),
            target=number_target(duration, inputs.tolerances.duration_s),
            arguments=inputs.arguments(Window.PHASE, mission=arguments),
            source=stated_by(source, duration),
            every_sample=False,
        )
    bearing = mission.bearing_deg
    if bearing is not None and bearing.provenance is Provenance.EXPLICIT:
        if mission.target is None or mission.mode is MissionMode.NAVIGATE:
            yield Underivable(
                element=mission.id, what='a bearing without a target', span=bearing.span
            )
            return
        share = inputs.tolerances.relation_fraction
        yield condition(
            id=f'{mission.id}.bearing',
            sentence=(
                f'{uav} stays at bearing {number(bearing.value)} deg from {mission.target} for '
                f'{number(100 * share)} % of {mission.id}'
            ),
            quantity=QuantityName.RELATION_FRACTION,
            signal=f'bearing_fraction({uav},{mission.target})',
            of=(uav, mission.target),
            target=Target(op='>=', threshold=share, unit='1'),
            fraction=share,
            arguments=inputs.arguments(
                Window.PHASE,
                aspect='bearing',
                mission=arguments,
                wanted=bearing.value,
                sample_tolerance=inputs.tolerances.bearing_deg,
            ),
            source=stated_by(source, bearing),
            every_sample=False,
        )


def _track(
    inputs: Inputs, mission: UavMission, arguments: MissionArguments, source: Source
) -> Iterator[Condition]:
    assert mission.target is not None  # the specification refuses a track without one
    share = inputs.tolerances.tracked_fraction
    standoff = mission.standoff_m
    if standoff is not None and standoff.provenance is Provenance.EXPLICIT:
        source = stated_by(source, standoff)
    yield condition(
        id=f'{mission.id}.tracked',
        sentence=(
            f'{mission.uav} tracks {mission.target} from {number(arguments.standoff_m)} m for '
            f'{number(100 * share)} % of the time after capture'
        ),
        quantity=QuantityName.TRACKED_FRACTION,
        of=(mission.uav, mission.target),
        target=Target(op='>=', threshold=share, unit='1'),
        fraction=share,
        arguments=inputs.arguments(Window.PHASE, mission=arguments),
        source=source,
        every_sample=False,
    )
    yield _visible(inputs, mission, arguments, source)


def _visible(
    inputs: Inputs, mission: UavMission, arguments: MissionArguments, source: Source
) -> Condition:
    assert mission.target is not None
    share = inputs.tolerances.visible_fraction
    return condition(
        id=f'{mission.id}.visible',
        sentence=(
            f'{mission.uav} sees {mission.target} for {number(100 * share)} % of {mission.id}'
        ),
        quantity=QuantityName.VISIBLE_FRACTION,
        of=(mission.uav, mission.target),
        target=Target(op='>=', threshold=share, unit='1'),
        fraction=share,
        arguments=inputs.arguments(Window.PHASE, mission=arguments),
        source=Source(ids=source.ids, spans=source.spans),
        every_sample=False,
    )


def _hover(
    inputs: Inputs, mission: UavMission, arguments: MissionArguments, source: Source
) -> Iterator[Condition | Underivable]:
    limit = hover_drift_limit_m(inputs.spec.world.weather.value, inputs.limits, inputs.tolerances)
    yield condition(
        id=f'{mission.id}.drift',
        sentence=f'{mission.uav} stays within {number(limit)} m of its hover point',
        quantity=QuantityName.HOVER_DRIFT,
        of=(mission.uav,),
        target=Target(op='<=', threshold=limit, unit='m'),
        arguments=inputs.arguments(Window.PHASE, mission=arguments),
        source=source,
    )
    if mission.target is not None:
        yield _visible(inputs, mission, arguments, source)
    standoff = mission.standoff_m
    if standoff is not None and standoff.provenance is Provenance.EXPLICIT:
        if mission.target is None:
            yield Underivable(
                element=mission.id, what='a standoff without a target', span=standoff.span
            )
            return
        yield condition(
            id=f'{mission.id}.standoff',
            sentence=(
                f'{mission.uav} hovers {bound_words(standoff)} {number(standoff.value)} m '
                f'from {mission.target}'
            ),
            quantity=QuantityName.HORIZONTAL_DISTANCE,
            of=(mission.uav, mission.target),
            target=number_target(standoff, inputs.tolerances.standoff_m),
            arguments=inputs.arguments(Window.PHASE, mission=arguments),
            source=stated_by(source, standoff),
        )
