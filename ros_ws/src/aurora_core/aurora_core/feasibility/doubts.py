# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What may well be impossible, and is not proven to be: it is run, and flagged."""

from __future__ import annotations

from collections.abc import Collection, Iterator
from math import ceil, hypot, inf, isfinite

from aurora_core.feasibility.bounds import exclusive
from aurora_core.feasibility.geometry import check_geometry
from aurora_core.feasibility.operands import AT_LEAST, whole
from aurora_core.feasibility.radio import check_radio
from aurora_core.feasibility.rounds import check_rounds
from aurora_core.feasibility.scene import check_scene
from aurora_core.feasibility.sight import check_sight
from aurora_core.feasibility.times import check_times
from aurora_core.feasibility.zones import place_distances
from aurora_core.knowledge.limits import (
    EXACT,
    Limits,
    Tolerances,
    ascent_s,
    hover_drift_limit_m,
)
from aurora_core.knowledge.map_model import MapModel
from aurora_core.knowledge.uav_record import RESERVE, UavRecord
from aurora_core.spec.events import TimeTrigger, reports_own_altitude
from aurora_core.spec.parameter import Bound
from aurora_core.spec.quantity import QuantityName
from aurora_core.spec.reference import LANDMARK
from aurora_core.spec.scenario import DistanceTrigger, ScenarioSpec, SendMessage, UavMission
from aurora_core.spec.stated import is_stated, least, most
from aurora_core.spec.vocabulary import AgentType, MissionMode, Pattern

# Streets that these may not use nobody drives on.
_ANY_CAR = 'passenger'


def nominal(limits: Limits, tolerances: Tolerances) -> tuple[Limits, Tolerances]:
    """Return limits and tolerances with which a flight is to be met just as it is stated."""
    exact = {
        'altitude_m': EXACT,
        'standoff_m': EXACT,
        'duration_s': EXACT,
        'pattern_centre_m': 0.0,
    }
    close = limits.model_copy(update={'tracking_horizontal_m': 0.0})
    return close, tolerances.model_copy(update=exact)


def doubts(
    spec: ScenarioSpec,
    map_model: MapModel,
    limits: Limits,
    tolerances: Tolerances,
    uav: UavRecord | None = None,
    *,
    known: Collection[str] = (),
) -> Iterator[str]:
    """Yield, in sentences, why a request may be impossible that nothing proves to be so.

    Args:
        spec: The request, of which nothing is proven.
        map_model: Its map.
        limits: Limits in force.
        tolerances: How far stated numbers may be missed.
        uav: What the multirotor was measured to do; None: that is not asked.
        known: Sentences of what is told of already: it does not hang on the tolerances.
    """
    close, exact = nominal(limits, tolerances)
    told = {c.sentence for c in exclusive(spec, split=True)}
    yield from (f'{s} They may be meant for different parts of the run.' for s in sorted(told))
    strained = (
        *check_sight(spec, map_model, close, exact),
        *check_radio(spec, close, exact),
        *check_geometry(spec, map_model, close, exact),
        *check_times(spec, limits, exact, map_model),
        *check_rounds(spec, map_model.buildings, map_model.quotable, close, exact),
    )
    near = [c.sentence for c in strained if c.sentence not in known]
    yield from (f'{sentence} Only inside the tolerances it can be.' for sentence in near)
    for far in check_radio(spec, close, exact, aloft=True):
        if far.sentence not in known and far.sentence not in near:
            yield f'{far.sentence} Only before and after its missions it may be nearer.'
    for closed in check_scene(spec, own=True):
        yield f'{closed.sentence} Some of them may be the same.'
    yield from _off_the_streets(spec, map_model)
    yield from _far_hovers(spec, map_model, limits, tolerances)
    yield from _fast_targets(spec, limits, uav)
    yield from _early_messages(spec, limits, tolerances)
    yield from _short_legs(spec, tolerances, uav)
    yield from _never_slow(spec)
    if uav is not None:
        yield from _strong_wind(spec, limits, tolerances, uav)
        yield from _empty_batteries(spec, limits, uav)


def _off_the_streets(spec: ScenarioSpec, map_model: MapModel) -> Iterator[str]:
    """Events that wait for a vehicle nearer to a landmark than any street leads."""
    marks = {f'{LANDMARK}{mark.name}': mark for mark in map_model.places}
    vehicles = {a.id for a in spec.agents if a.type not in (AgentType.PEDESTRIAN, AgentType.RSU)}
    for trigger in (event.trigger for event in spec.events):
        if not isinstance(trigger, DistanceTrigger) or trigger.on != 'distance_below':
            continue
        for body, place in ((trigger.a, trigger.b), (trigger.b, trigger.a)):
            if body not in vehicles or place not in marks:
                continue
            mark = marks[place]
            lane_id, _, away_m = map_model.network.nearest_lane(mark.x_m, mark.y_m, _ANY_CAR)
            away_m -= map_model.network.lane(lane_id).width_m / 2.0
            asked_m = trigger.value_m.value
            if asked_m < away_m:
                yield (
                    f'{body} drives on streets, and none is nearer to {mark.name} than '
                    f'{ceil(away_m)} m: it may never come within {asked_m:g} m of it.'
                )


def _far_hovers(
    spec: ScenarioSpec, map_model: MapModel, limits: Limits, tolerances: Tolerances
) -> Iterator[str]:
    """Messages between UAVs whose hovers are out of reach of each other; their ways may not be."""
    marks = {f'{LANDMARK}{mark.name}': mark for mark in map_model.places}
    sent = [e.action for e in spec.events if isinstance(e.action, SendMessage)]
    flown = {u.id: [m for m in spec.missions if m.uav == u.id] for u in spec.uavs}
    links = {(link.sender, link.receiver): link.range_m for link in spec.links}
    for ends in dict.fromkeys((a.sender, a.receiver) for a in sent):
        one, other = (flown.get(name, []) for name in ends)
        hovers = all(m.mode is MissionMode.HOVER and m.target in marks for m in (*one, *other))
        if not (one and other and hovers):
            continue
        reach = links.get(ends)
        reach_m = limits.link_range_sight_m if reach is None else reach.value
        apart_m = min(
            hypot(marks[a.target].x_m - marks[b.target].x_m,
                  marks[a.target].y_m - marks[b.target].y_m)
            - place_distances(a, limits, tolerances)[1] - place_distances(b, limits, tolerances)[1]
            for a in one for b in other
            if a.target is not None and b.target is not None
        )  # fmt: skip
        if apart_m > reach_m:
            yield (
                f'{ends[0]} and {ends[1]} hover at least {apart_m:.0f} m apart, and their link '
                f'reaches {reach_m:g} m: only on its way one may be near the other.'
            )


def _early_messages(spec: ScenarioSpec, limits: Limits, tolerances: Tolerances) -> Iterator[str]:
    """Messages that are due before their UAV is up, at the rate at which ascents are flown."""
    for event in spec.events:
        action, trigger = event.action, event.trigger
        if not isinstance(action, SendMessage) or not isinstance(trigger, TimeTrigger):
            continue
        first = next((m for m in spec.missions if m.uav == action.sender), None)
        at = trigger.at_s
        if first is None or not is_stated(at) or reports_own_altitude(event):
            continue
        due_s = at.value + event.waits_s
        slack = tolerances.duration_s.of(due_s, approximate=at.approximate)
        up_s = ascent_s(first.altitude_m.value, limits)
        if up_s > most(at, event.waits_s + slack, inf):
            yield (
                f'{action.sender} is up at about {up_s:.1f} s, and sends nothing before; '
                f'{event.id} is set to {due_s:g} s.'
            )


def _fast_targets(spec: ScenarioSpec, limits: Limits, uav: UavRecord | None) -> Iterator[str]:
    top = limits.uav_speed_max_mps
    for mission in (m for m in spec.missions if m.mode is MissionMode.TRACK):
        agent = next((a for a in spec.agents if a.id == mission.target), None)
        for behavior in agent.behaviors if agent is not None else ():
            speed = behavior.speed_mps
            fast = speed is not None and is_stated(speed) and speed.bound is not Bound.AT_MOST
            if speed is not None and fast and speed.value > top:
                yield (
                    f'{mission.target} drives at {speed.value:g} m/s, {mission.uav} flies at most '
                    f'{top:g} m/s: it may lose it.'
                )
            elif speed is not None and fast and uav is not None:
                lag_m, allowed_m = uav.lag_m(speed.value), limits.tracking_horizontal_m
                if lag_m > allowed_m:
                    yield (
                        f'{mission.target} drives at {speed.value:g} m/s, at which '
                        f'{mission.uav} was measured to stay {lag_m:.1f} m behind; it tracks '
                        f'within {allowed_m:g} m.'
                    )


def _strong_wind(
    spec: ScenarioSpec, limits: Limits, tolerances: Tolerances, uav: UavRecord
) -> Iterator[str]:
    """A hover in wind that was measured to push the multirotor farther than it may drift."""
    mean_mps, gust_mps = _wind_mps(spec, limits)
    drift_m = uav.drift_m(mean_mps, gust_mps)
    allowed_m = hover_drift_limit_m(spec.world, limits, tolerances)
    if drift_m <= allowed_m:
        return
    known = f'to drift {drift_m:.1f} m' if isfinite(drift_m) else 'in no such gusts'
    for mission in (m for m in spec.missions if m.mode is MissionMode.HOVER):
        yield (
            f'{mission.uav} was measured {known} in a wind of {mean_mps:g} m/s; it hovers within '
            f'{allowed_m:g} m.'
        )


def _wind_mps(spec: ScenarioSpec, limits: Limits) -> tuple[float, float]:
    """Return the mean wind and the gusts that a request asks for at least."""
    world = spec.world
    mean_mps = limits.wind_mean_mps[world.weather.value]
    if world.wind_mps is not None:
        mean_mps = least(world.wind_mps, 0.0, 0.0)
    if world.gust_mps is not None:
        return mean_mps, max(0.0, world.gust_mps.value - mean_mps)
    return mean_mps, limits.wind_gust_mps[world.weather.value]


def _empty_batteries(spec: ScenarioSpec, limits: Limits, uav: UavRecord) -> Iterator[str]:
    """Phases of one UAV that last longer than a battery did at their speeds in that wind."""
    wind = _wind_mps(spec, limits)
    for flown in spec.uavs:
        asked_s, share = 0.0, 0.0
        for mission in (m for m in spec.missions if m.uav == flown.id):
            lasts_s = least(mission.duration_s, 0.0, 0.0)
            asked_s += lasts_s
            battery_s = uav.endurance_s(_asked_mps(spec, mission, limits), *wind) / RESERVE
            share += lasts_s / battery_s if battery_s > 0.0 else inf if lasts_s > 0.0 else 0.0
        if share > 1.0:
            known_s = asked_s / share
            yield (
                f'{flown.id} flies for {asked_s:g} s at least; by what was measured its battery '
                f'is good for {known_s:.0f} s at such speeds in such a wind.'
            )


def _asked_mps(spec: ScenarioSpec, mission: UavMission, limits: Limits) -> float:
    """Return the speed at which a mission is flown as stated: its own, or of whom it tracks."""
    speeds = [mission.speed_mps]
    if mission.mode is MissionMode.TRACK:
        tracked = next((a for a in spec.agents if a.id == mission.target), None)
        speeds += [b.speed_mps for b in tracked.behaviors] if tracked is not None else []
    asked_mps = max((least(speed, 0.0, 0.0) for speed in speeds), default=0.0)
    return min(asked_mps, limits.uav_speed_max_mps)


def _short_legs(
    spec: ScenarioSpec, tolerances: Tolerances, uav: UavRecord | None
) -> Iterator[str]:
    """A stated speed for which the legs are too short at the acceleration of most flights."""
    for mission in spec.missions:
        speed, size = mission.speed_mps, mission.size_m
        if mission.pattern not in (Pattern.RECTANGLE, Pattern.LINE) or size is None:
            continue
        if speed is None or not is_stated(speed) or speed.bound is Bound.AT_MOST:
            continue
        sides = size if mission.pattern is Pattern.RECTANGLE else size[:1]
        if not all(is_stated(side) for side in sides):
            continue
        exact = speed.bound is Bound.EXACTLY
        slack = tolerances.route_speed_mps.of(speed.value, approximate=speed.approximate)
        slowest_mps = max(0.0, speed.value - slack) if exact else speed.value
        needed_m = slowest_mps * slowest_mps / tolerances.route_acceleration_mps2
        if uav is not None:
            needed_m = max(needed_m, uav.start_m(speed.value) + uav.stop_m(speed.value))
        longest_m = max(most(side, 0.0, 1e9) for side in sides)
        if longest_m < needed_m:
            yield (
                f'{mission.uav} needs {needed_m:.0f} m to get to {speed.value:g} m/s and to '
                f'brake; no leg of {mission.id} is longer than {longest_m:g} m.'
            )


def _never_slow(spec: ScenarioSpec) -> Iterator[str]:
    """A least speed for all of a route: it begins and ends at rest, and slows down for corners."""
    for condition in spec.conditions:
        flown = [m for m in spec.missions if condition.of == (m.uav,)]
        asked = condition.quantity == QuantityName.SPEED and condition.op in AT_LEAST
        if not asked or not whole(condition) or condition.value.value <= 0.0:
            continue
        if flown and all(m.mode is MissionMode.NAVIGATE for m in flown):
            yield (
                f'{flown[0].uav} begins and ends its route at rest and slows down for sharp '
                f'corners: there it is slower than {condition.value.value:g} m/s.'
            )
