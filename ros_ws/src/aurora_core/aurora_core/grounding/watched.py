# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Where those will be whom a UAV has to see from where it hovers: its target, and others."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from aurora_core.grounding.nearby import ON_SIDEWALKS
from aurora_core.grounding.pace import encounters, moves, moves_during
from aurora_core.grounding.sites import SeatedAgent, SeatedPerson, Site, samples_along
from aurora_core.knowledge.agent_types import AgentTypeRecord
from aurora_core.knowledge.settings import GroundingSettings
from aurora_core.spec.events import SendMessage, actor_of
from aurora_core.spec.parking import stands
from aurora_core.spec.quantity import QuantityName
from aurora_core.spec.scenario import ScenarioSpec, UavMission
from aurora_core.spec.vocabulary import BehaviorKind

FloatArray = npt.NDArray[np.float64]

_SIGHT_HEIGHT_PLACE_M = 1.0
# Two who are to meet do so that near to where they start (m).
_MEET_WITHIN_M = 120.0
_OF_SIGHT = (QuantityName.VISIBLE_FRACTION, QuantityName.VISIBLE_TIME)


@dataclass(frozen=True, slots=True, kw_only=True)
class Watcher:
    """What there is to see from a hover at a site.

    Attributes:
        spec: The request.
        site: Where its bodies stand.
        types: Agent sizes.
        settings: How far apart points of a way are looked at.
    """

    spec: ScenarioSpec
    site: Site
    types: Mapping[str, AgentTypeRecord]
    settings: GroundingSettings

    def target(
        self, mission: UavMission, centre: tuple[float, float, float, float], speed_mps: float
    ) -> FloatArray:
        """Return the points (K, 3) at which the target of a hover will be, its sight point."""
        seat = self.site.seat(mission.target or '')
        if seat is None:
            return np.array([[centre[0], centre[1], _SIGHT_HEIGHT_PLACE_M]])
        return self._way(seat, mission, speed_mps)

    def others(self, mission: UavMission, speed_mps: float) -> Iterator[tuple[FloatArray, bool]]:
        """Yield the points (K, 3) of everybody else who is to be seen, and whether it stays."""
        meeting = {name for m in encounters(self.spec) for name in (m.actor, m.other)}
        meeting -= asked_to_see(self.spec, mission.uav)
        for name in sorted(_to_see(self.spec, mission)):
            seat = self.site.seat(name)
            if seat is not None:
                points = self._way(seat, mission, speed_mps)
                if name in meeting:
                    near = np.hypot(*(points[:, :2] - points[0, :2]).T) <= _MEET_WITHIN_M
                    points = points[near]
                yield points, isinstance(seat, SeatedPerson)
                if isinstance(seat, SeatedPerson) and seat.path.begins_m is not None:
                    # Who has gone straight over the street stands on its other side.
                    x, y = seat.path.polyline[-1]
                    yield np.array([[x, y, points[0, 2]]]), True

    def _way(
        self, seat: SeatedAgent | SeatedPerson, mission: UavMission, speed_mps: float
    ) -> FloatArray:
        assert mission.duration_s is not None
        if isinstance(seat, SeatedPerson):
            walks = any(b.kind is BehaviorKind.WALK for b in seat.agent.behaviors)
            speed_mps = self.settings.persons.walking_mps if walks else 0.0
        goes = moves_during(self.spec, seat.agent, mission)
        way_m = speed_mps * mission.duration_s.value if goes else 0.0
        height_m = self.types[seat.agent.type.value].height_m / 2.0
        samples = samples_along(seat.path, seat.arc_m, way_m, self.settings.sample_spacing_m)
        return np.column_stack((samples[:, :2], np.full(len(samples), height_m)))


def asked_to_see(spec: ScenarioSpec, uav: str) -> set[str]:
    """Return whom a UAV has to see for a time, or a share of it, that a request states."""
    return {
        one.of[1]
        for one in spec.conditions
        if one.quantity in _OF_SIGHT and one.of[:1] == (uav,) and len(one.of) > 1
    }


def looks(spec: ScenarioSpec) -> Iterator[tuple[str, str, float]]:
    """Yield who on the ground has to see what stays where it is, and for how long (s).

    Of who looks no motion is told. What stays is a place, or somebody on foot of whom none is.
    """
    idle = {a.id for a in spec.agents if not moves(spec, a)}
    on_foot = [a for a in spec.agents if a.type in ON_SIDEWALKS]
    staying = {a.id for a in on_foot if a.id in idle or stands(a)}
    bodies = {a.id for a in spec.agents} | {u.id for u in spec.uavs}
    for one in spec.conditions:
        least = one.quantity == QuantityName.VISIBLE_TIME and one.op in ('>', '>=')
        if least and len(one.of) > 1 and one.of[0] in idle:
            observer, target = one.of
            if target not in bodies or target in staying:
                yield observer, target, one.value.value


def _to_see(spec: ScenarioSpec, mission: UavMission) -> set[str]:
    """Return whom a UAV has to see beside its target: by a condition, or to report on."""
    bodies = asked_to_see(spec, mission.uav)
    for event in spec.events:
        if isinstance(event.action, SendMessage) and event.action.sender == mission.uav:
            bodies.add(actor_of(event) or '')
    return bodies - {mission.target, ''}
