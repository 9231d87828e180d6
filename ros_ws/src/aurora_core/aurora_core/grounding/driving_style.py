# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""How the members of a convoy drive: at its pace, close up, past each other, in an emergency."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping

from aurora_core.grounding.headways import headway_style, stated_headway
from aurora_core.grounding.kept_gaps import KeptGap, kept_gaps, led
from aurora_core.grounding.lane_changers import changes_lane
from aurora_core.grounding.pace import (
    PACED,
    Encounter,
    approaches,
    convoy_pace_mps,
    encounters,
    fastest_stated_mps,
    in_emergency,
    own_speed_mps,
    partings,
    stated_speed_mps,
    tracked,
)
from aurora_core.grounding.sites import SeatedAgent, Site, tied_way_m
from aurora_core.knowledge.agent_types import AgentTypeRecord
from aurora_core.knowledge.limits import Limits, Tolerances
from aurora_core.knowledge.road_network import RoadNetwork
from aurora_core.knowledge.settings import Settings, SpeedSettings
from aurora_core.spec.own_events import let_cross, overtakings
from aurora_core.spec.parking import stands
from aurora_core.spec.quantity import QuantityName
from aurora_core.spec.scenario import GroundAgent, ScenarioSpec
from aurora_core.spec.vocabulary import BehaviorKind, MissionMode

# Speed limit of the slowest streets (m/s).
_SLOWEST_MPS = 8.0

# Time gap of each of several that follow one: the last one has to be near it, too (s).
_IN_LINE_S = 0.6

# Behind somebody slow who follows keeps so much more than the least gap (m).
_BEHIND_SLOW_M = 0.5

# Share of a stated speed that is driven ahead of who drives it and is to be let pass.
_LETS_PASS = 0.7

# Who overtakes is so much faster (m/s).
_PASSES_BY_MPS = 4.0

# Who has somebody with a stated speed behind hurries by so much at most.
_BRISK = 1.6

# Share of a stated speed that is driven ahead of who drives it at a distance: the one behind can
# make up for what it loses, and is not too slow for it.
_AHEAD_OF_STATED = 0.95


class ConvoyStyles:
    """The styles of driving of those who stand at one site.

    Args:
        spec: The request.
        site: Where they stand.
        types: Agent sizes and dynamics.
        network: With the speed limits.
        settings: Styles of driving.
        limits: In force.
        tolerances: In force.
    """

    def __init__(
        self,
        spec: ScenarioSpec,
        site: Site,
        types: Mapping[str, AgentTypeRecord],
        network: RoadNetwork,
        settings: Settings,
        limits: Limits,
        tolerances: Tolerances,
    ) -> None:
        self._spec = spec
        self._tolerances = tolerances
        self._types = types
        self._settings = settings
        self._seats = {s.agent.id: s for s in (*site.seated, *site.others)}
        self._limit_mps = site.fastest_mps(network, tied_way_m(spec, settings.grounding))
        self._factor = self._pace_factor(site, limits)
        self._meetings = encounters(spec)
        self._gaps = kept_gaps(spec, self._seats, types)
        self._led = led(self._gaps)
        self._in_line = _in_line(spec)
        self._tracked = tracked(spec)
        self._front_m = max((s.arc_m for s in site.seated), default=0.0)
        # Who is slower would be passed once one of them has another lane.
        self._parting = any(changes_lane(spec, s.agent) for s in site.seated)

    def of(self, seat: SeatedAgent) -> dict[str, float]:
        """Return how one of them drives."""
        agent = seat.agent
        is_front = seat.arc_m >= self._front_m or self._parting
        on_mps = self._limit_mps if agent.id in self._tracked else None
        style = self._style(agent, on_mps, is_front=is_front) | self._headway_style(agent)
        style |= self._passing_style(agent)
        style |= self._paced_style(seat, style['speed_factor'])
        return style | self._gentle_style(agent, style)

    def leads_mps(self, agent: GroundAgent) -> float | None:
        """Return how fast one without a stated speed drives ahead of who has one (m/s).

        So it does ahead of who is slower by himself, a cyclist. None where nobody of the kind
        keeps an exact distance behind it.
        """
        agents = {a.id: a for a in self._spec.agents}
        followers = [agents[name] for name in self._led.get(agent.id, ())]
        spec, settings = self._spec, self._settings.grounding.speeds
        speeds = [stated_speed_mps(spec, other, settings) for other in followers]
        desired = (self._types[other.type.value].desired_speed_mps for other in followers)
        pace_mps = self._factor * self._limit_mps
        speeds += [speed for speed in desired if speed is not None and speed < pace_mps]
        stated = [speed for speed in speeds if speed is not None]
        if not stated or own_speed_mps(agent) is not None:
            return None
        return _AHEAD_OF_STATED * min(stated)

    def _gentle_style(self, agent: GroundAgent, style: Mapping[str, float]) -> dict[str, float]:
        """Return what lets who follows one keep up: a start no harder than it can do.

        Of whom a speed is stated reaches that as fast as it can.
        """
        if own_speed_mps(agent) is not None or in_emergency(agent):
            return {}
        following = [
            self._types[other.type.value].accel_mps2
            for other in self._spec.agents
            if other.id in self._seats
            and any(b.kind in PACED and b.target == agent.id for b in other.behaviors)
        ]
        own_mps2 = style.get('gentle_mps2', self._types[agent.type.value].accel_mps2)
        if following and min(following) < own_mps2:
            return {'gentle_mps2': min(following)}
        return {}

    def _pace_factor(self, site: Site, limits: Limits) -> float:
        """Slow a tracked, observed or tied convoy to its pace."""
        spec = self._spec
        watched = any(
            m.mode is not MissionMode.NAVIGATE and site.seat(m.target or '') is not None
            for m in spec.missions
        )
        waits = any(site.seat(vehicle) is not None for vehicle, _ in let_cross(spec))
        if not watched and not waits and len(site.seated) < 2:
            return 1.0
        stated = fastest_stated_mps(
            spec, (s.agent for s in site.seated), self._settings.grounding.speeds
        )
        pace = max(stated, convoy_pace_mps(spec, limits, self._settings.grounding))
        return min(1.0, pace / self._limit_mps)

    def _style(
        self, agent: GroundAgent, watched_on_mps: float | None, *, is_front: bool
    ) -> dict[str, float]:
        run = self._settings.run
        chased = self._settings.grounding.chased_speed_factor
        factor, close = self._factor, False
        for meeting in self._meetings:
            if agent.id not in (meeting.actor, meeting.other):
                continue
            front = self._to_catch_up_with(meeting)
            if front is None:
                continue
            # A stated speed stays: who comes up behind has to be faster then.
            bound = own_speed_mps(front.member.agent) is not None
            if front.member.agent.id == agent.id:
                if not bound:
                    factor = chased * min(factor, self._top_share(meeting, agent.id))
            else:
                factor /= chased if bound and own_speed_mps(agent) is None else 1.0
                close = meeting.within_m <= self._settings.grounding.close_encounter_m
        if close or any(b.kind is BehaviorKind.TAILGATE for b in agent.behaviors):
            return {
                'speed_factor': factor * run.tailgate_speed_factor,
                'time_gap_s': run.tailgate_time_gap_s,
                'min_gap_m': run.tailgate_min_gap_m,
            }
        if in_emergency(agent):
            return emergency_style(agent, self._settings.grounding.speeds, watched_on_mps)
        behind = self._settings.grounding.convoy_speed_factor_behind
        style = {'speed_factor': factor if is_front else factor * behind}
        if any(b.kind is BehaviorKind.FOLLOW for b in agent.behaviors):
            style['min_gap_m'] = self._follow_gap_m(agent)
        if agent.id in self._in_line:
            style |= {'time_gap_s': _IN_LINE_S}
        for gap in self._gaps:
            if gap.follower == agent.id:
                least_m = gap.least_m(self._pace_mps(gap), run.dt_s)
                style |= {'min_gap_m': least_m, 'time_gap_s': run.dt_s}
            elif gap.leader == agent.id:
                style['gentle_mps2'] = min(
                    gap.acceleration_mps2, style.get('gentle_mps2', gap.acceleration_mps2)
                )
        return style

    def _headway_style(self, agent: GroundAgent) -> dict[str, float]:
        """Return what keeps a stated headway at the pace of whom it is kept behind."""
        stated = stated_headway(self._spec, agent)
        ahead = None if stated is None else self._seats.get(stated[0])
        if stated is None or ahead is None:
            return {}
        pace_mps = own_speed_mps(ahead.agent) or self._factor * self._limit_mps
        types = self._types[agent.type.value], self._types[ahead.agent.type.value]
        return headway_style(stated[1], *types, pace_mps)

    def _follow_gap_m(self, agent: GroundAgent) -> float:
        """Return the gap at standstill of who follows: behind a slow one it is far enough, too."""
        record, least_m = self._types[agent.type.value], self._tolerances.follow_gap_moving_m[0]
        gap_s = _IN_LINE_S if agent.id in self._in_line else record.headway_s
        slow_m = least_m + _BEHIND_SLOW_M - gap_s * self._tolerances.follow_slow_mps
        return max(record.min_gap_m, slow_m)

    def _pace_mps(self, gap: KeptGap) -> float:
        """Return how fast the line is in which two keep their distance (m/s)."""
        front = next((f for f, others in self._led.items() if gap.follower in others), gap.leader)
        agent = self._seats[front].agent
        stated = own_speed_mps(agent) or self.leads_mps(agent)
        free_mps = self._factor * self._limit_mps * self._settings.grounding.chased_speed_factor
        return free_mps if stated is None else stated

    def _to_catch_up_with(self, meeting: Encounter) -> SeatedAgent | None:
        """Return the front one of two that are to meet, None where nobody flees from the other."""
        one, other = self._seats.get(meeting.actor), self._seats.get(meeting.other)
        if one is None or other is None or one.path.edge_ids != other.path.edge_ids:
            return None
        front = max(one, other, key=lambda seat: seat.arc_m)
        return None if front.member.parked or stands(front.agent) else front

    def _top_share(self, meeting: Encounter, front: str) -> float:
        """Return the share of the limit that whoever comes up behind drives of its own accord."""
        behind = meeting.other if meeting.actor == front else meeting.actor
        record = self._types[self._seats[behind].agent.type.value]
        return min(1.0, (record.desired_speed_mps or self._limit_mps) / self._limit_mps)

    def _passing_style(self, agent: GroundAgent) -> dict[str, float]:
        """Return what lets those who overtake be faster than those who are overtaken.

        So it is with those who approach somebody, and who are to get away from each other.
        """
        pairs, grounding = overtakings(self._spec), self._settings.grounding
        agents = {a.id: a for a in self._spec.agents}
        passed = [other for one, other in pairs if one == agent.id]
        if passed and in_emergency(agent):
            return {}  # which makes it faster than anybody else
        if passed:
            speeds = [own_speed_mps(agents[other]) or 0.0 for other in passed]
            brisk = max(speeds) + _PASSES_BY_MPS > grounding.target_speed_mps
            return {'speed_factor': 1.0 if brisk else self._factor}
        comes_up_mps = self._slowest_that_passes_mps(agent)
        if comes_up_mps is not None:
            return {'speed_factor': min(self._factor, _LETS_PASS * comes_up_mps / self._limit_mps)}
        slow = [other for _, other in pairs]
        # Whom they follow is as slow as they are.
        for name in slow:
            slow += [
                b.target
                for b in agents[name].behaviors
                if b.target in agents and b.kind in PACED and b.target not in slow
            ]
        lasts = (_last(pair, self._seats) for pair in partings(self._spec))
        slow += [name for name in lasts if name is not None]
        slow += [other for _, other in approaches(self._spec)]
        hurried = _hurried(self._spec)
        slow += [f for f, others in self._led.items() if hurried.isdisjoint((f, *others))]
        slowed = agent.id in slow and own_speed_mps(agent) is None
        return {'speed_factor': self._factor * grounding.chased_speed_factor} if slowed else {}

    def _slowest_that_passes_mps(self, agent: GroundAgent) -> float | None:
        """Return the least stated speed of those behind that an agent is to let pass, m/s.

        None where there are none, or its own speed is stated.
        """
        own = self._seats[agent.id]
        behind = [
            self._seats[b.target]
            for b in agent.behaviors
            if b.kind is BehaviorKind.YIELD and b.target in self._seats
        ]
        speeds = [
            own_speed_mps(seat.agent)
            for seat in behind
            if seat.arc_m < own.arc_m and own.path.edge_ids[0] in seat.path.edge_ids
        ]
        stated = [mps for mps in speeds if mps]
        return min(stated) if stated and own_speed_mps(agent) is None else None

    def _paced_style(self, seat: SeatedAgent, factor: float) -> dict[str, float]:
        """Return what gives the pace to a type that wants to be slower than the road allows.

        The factor of a convoy is meant of the limit of its road; the simulator applies it to what
        the type wants, too. Who has a stated speed behind does not hold it up, and who follows
        somebody keeps up.
        """
        desired_mps = self._types[seat.agent.type.value].desired_speed_mps
        if desired_mps is None:
            return {}
        behind_mps = [
            own_speed_mps(other.agent) or 0.0
            for other in self._seats.values()
            if other.arc_m < seat.arc_m and other.path.edge_ids == seat.path.edge_ids
        ]
        paced = {b.target for b in seat.agent.behaviors if b.kind in PACED}
        paced |= {gap.leader for gap in self._gaps if gap.exact and gap.follower == seat.agent.id}
        ahead_mps = [own_speed_mps(a) or 0.0 for a in self._spec.agents if a.id in paced]
        most = min(_BRISK, max([desired_mps, *behind_mps, *ahead_mps]) / desired_mps)
        return {'speed_factor': max(factor, min(most, factor * self._limit_mps / desired_mps))}


def emergency_style(
    agent: GroundAgent, speeds: SpeedSettings, watched_on_mps: float | None = None
) -> dict[str, float]:
    """Return what an emergency run makes of limits: enough for a stated speed anywhere.

    Where a UAV is to keep up with it, it is no faster than it has to be on streets that allow
    `watched_on_mps`.
    """
    stated = own_speed_mps(agent)
    least = speeds.emergency_factor
    if watched_on_mps is not None and stated is None:
        return {'speed_factor': min(least, 1.0 + speeds.emergency_over_mps / watched_on_mps)}
    return {'speed_factor': least if stated is None else max(least, stated / _SLOWEST_MPS)}


def free_style(agent: GroundAgent, speeds: SpeedSettings) -> dict[str, float]:
    """Return how somebody drives who is related to nobody."""
    return emergency_style(agent, speeds) if in_emergency(agent) else {}


def urged_factor(record: AgentTypeRecord, speed_mps: float | None) -> float:
    """Return the least factor with which a type drives a stated speed, 0 where none is stated.

    The speed itself is commanded; this keeps neither the pace of the convoy nor the type's own
    desire below it, up to the limit of the road.
    """
    if speed_mps is None:
        return 0.0
    desired_mps = record.desired_speed_mps
    return 1.0 if desired_mps is None else max(1.0, speed_mps / desired_mps)


def _hurried(spec: ScenarioSpec) -> frozenset[str]:
    """Return whose speed is to be at least some number."""
    return frozenset(
        name
        for one in spec.conditions
        if one.quantity == QuantityName.SPEED and one.op in ('>=', '>')
        for name in one.of
    )


def _in_line(spec: ScenarioSpec) -> frozenset[str]:
    """Return the vehicles of which several follow one: they keep together."""
    followed = [
        (b.target, agent.id)
        for agent in spec.agents
        for b in agent.behaviors
        if b.kind is BehaviorKind.FOLLOW
    ]
    count = Counter(target for target, _ in followed)
    return frozenset(agent for target, agent in followed if count[target] > 1)


def _last(pair: frozenset[str], seats: Mapping[str, SeatedAgent]) -> str | None:
    """Return which of two vehicles on one road is behind, None where they are on two."""
    if not pair <= seats.keys():
        return None
    return min(sorted(pair), key=lambda name: seats[name].arc_m)
