# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""From drafts to the specification: defaults, scene rules, roles."""

from __future__ import annotations

from aurora_core.parsing import values
from aurora_core.parsing.scene import Entity, LinkDraft, MissionDraft, Scene
from aurora_core.spec.parameter import Parameter, Provenance
from aurora_core.spec.scenario import (
    GroundAgent,
    Link,
    ScenarioSpec,
    Uav,
    UavAction,
    UavMission,
    World,
)
from aurora_core.spec.vocabulary import (
    MissionMode,
    Pattern,
    Role,
    TimeOfDay,
    Weather,
)


def build(scene: Scene) -> ScenarioSpec:
    """Return the specification of a settled scene."""
    targets = {m.target for m in scene.missions if m.mode is MissionMode.TRACK}
    world = scene.world
    spans = [s for s in (world.weather_span, world.time_of_day_span) if s is not None]
    return ScenarioSpec(
        prompt=scene.prompt,
        world=World(
            map_name=scene.context.map_name,
            weather=world.weather or Weather.CLEAR,
            weather_span=world.weather_span,
            time_of_day=world.time_of_day or TimeOfDay.NOON,
            time_of_day_span=world.time_of_day_span,
            traffic_density=world.traffic,
            duration_s=world.duration,
            wind_mps=world.wind_speed,
            gust_mps=world.gust,
            wind_from_deg=world.wind_from,
            wind=world.wind,
            span=spans[0] if spans else None,
        ),
        agents=tuple(_agent(e, targets) for e in scene.agents),
        uavs=tuple(Uav(id=u.id, span=u.span) for u in scene.uavs),
        missions=_missions(scene),
        links=tuple(_link(link) for link in scene.links),
        events=scene.events_as_values(),
        conditions=tuple(scene.conditions),
        orders=tuple(scene.orders),
        counts=tuple(scene.counts),
        prohibitions=tuple(scene.prohibitions),
        clauses=scene.finished_clauses(),
    )


def _agent(entity: Entity, targets: set[str | None]) -> GroundAgent:
    role = entity.role
    if role is Role.OTHER and entity.id in targets:
        role = Role.TARGET
    return GroundAgent(
        id=entity.id,
        type=entity.type,
        role=role,
        group=entity.group,
        placements=tuple(entity.placements),
        behaviors=tuple(entity.behaviors),
        span=entity.span,
    )


def _missions(scene: Scene) -> tuple[UavMission, ...]:
    last_altitude: dict[str, Parameter] = {}
    changed = {e.action.mission for e in scene.events if isinstance(e.action, UavAction)}
    made = []
    for draft in scene.missions:
        altitude = draft.altitude
        before = last_altitude.get(draft.uav.id)
        if altitude is None and before is not None:
            altitude = _same_as_before(before)
        if altitude is None:
            altitude = values.default('altitude')
        last_altitude[draft.uav.id] = altitude
        made.append(_mission(draft, altitude, draft.id in changed))
    return tuple(made)


def _same_as_before(altitude: Parameter) -> Parameter:
    if altitude.provenance is Provenance.DEFAULT:
        return altitude
    if not altitude.low <= altitude.value <= altitude.high:
        return altitude  # outside the limits: refused by the phase that states it
    return values.inferred('altitude', altitude.value, altitude.span)


def _mission(draft: MissionDraft, altitude: Parameter, by_event: bool) -> UavMission:
    navigate = draft.mode is MissionMode.NAVIGATE
    pattern = draft.pattern or Pattern.RECTANGLE if navigate else None
    sized = pattern in (Pattern.RECTANGLE, Pattern.LAWNMOWER, Pattern.LINE, Pattern.WAYPOINTS)
    count = draft.waypoint_count
    if pattern is Pattern.WAYPOINTS and count is not None and count.value == 1:
        sized = False
    if draft.start is not None:
        sized, count = False, None
    elif count is None and pattern is Pattern.WAYPOINTS:
        count = values.default('waypoint_count')
    standoff = draft.standoff
    # `watches the tower` leaves open from where; `hovers over the tower` does not.
    watched = draft.watching and draft.mode is MissionMode.HOVER and draft.bearing is None
    watched = watched and (draft.target or '').startswith('landmark:')
    if standoff is None and (draft.mode is MissionMode.TRACK or watched):
        standoff = values.default('standoff')
    radius = draft.radius
    if radius is None and pattern is Pattern.ORBIT:
        radius = values.default('orbit_radius')
    speed = draft.speed
    if speed is None and navigate:
        speed = values.default('route_speed')
    duration = draft.duration
    if duration is None and not navigate:
        duration = values.default('mission_duration')
    return UavMission(
        id=draft.id,
        uav=draft.uav.id,
        mode=draft.mode,
        target=draft.target,
        target_inferred=draft.target_inferred,
        start=draft.start,
        altitude_m=altitude,
        way_at_altitude=draft.way_at_altitude and draft.mode is MissionMode.HOVER,
        standoff_m=standoff,
        bearing_deg=draft.bearing,
        side=draft.side,
        duration_s=duration,
        pattern=pattern,
        size_m=(draft.size or _size(draft, pattern)) if sized else None,
        radius_m=radius,
        waypoint_count=count,
        turns=draft.turns,
        speed_mps=speed,
        dwell_s=draft.dwell if navigate else None,
        over_streets=draft.over_streets,
        ends_in_flight=draft.ends_in_flight,
        span=draft.span,
    )


def _size(draft: MissionDraft, pattern: Pattern | None) -> tuple[Parameter, Parameter]:
    if draft.square:
        return values.default('square_side'), values.default('square_side')
    if pattern is Pattern.LINE:
        no_width = Parameter(
            value=0.0,
            unit=values.default('pattern_width').unit,
            low=0.0,
            high=0.0,
            provenance=Provenance.INFERRED,
        )
        return values.default('pattern_length'), no_width
    return values.default('pattern_length'), values.default('pattern_width')


def _link(draft: LinkDraft) -> Link:
    assert draft.sender is not None
    assert draft.receiver is not None
    return Link(
        id=draft.id,
        sender=draft.sender,
        receiver=draft.receiver,
        loss=draft.loss or values.default('link_loss'),
        latency_s=draft.latency or values.default('link_latency'),
        range_m=draft.range,
        retransmissions=draft.retransmissions or values.default('link_retransmissions'),
        retransmission_interval_s=draft.interval or values.default('link_retransmission_interval'),
        occlusion=draft.occlusion,
        outage_s=draft.outage,
        rate_hz=draft.rate,
        span=draft.span,
    )
