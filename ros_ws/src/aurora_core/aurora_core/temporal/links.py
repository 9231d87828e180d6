# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""A bound on two time points with what it rests on, and the numbers of a request inside it."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property

from aurora_core.knowledge.limits import Limits, Tolerances
from aurora_core.outcomes.feasibility import BoundKind
from aurora_core.outcomes.schedule import MissionFacts
from aurora_core.spec.parameter import Parameter
from aurora_core.spec.scenario import ScenarioSpec, UavAction, UavMission
from aurora_core.spec.stated import least, most
from aurora_core.temporal.stn import Edge, microseconds

START = 'start'
END = 'end'


@dataclass(frozen=True, kw_only=True)
class Link:
    """A bound between two time points; least or most is given, never both.

    Attributes:
        earlier: Time point, named as in a certificate (`outcomes.feasibility.TimeBound`).
        later: Another one.
        least_s: Seconds by which `later` comes after `earlier` at least.
        most_s: The same, at most.
        kind: Why.
        of: Path of the element that it comes from.
        words: The same for people.
        stated: Paths of the specification that it rests on, with what stands there.
        limits: Names in limits.json.
        tolerances: Names in tolerances.json.
    """

    earlier: str
    later: str
    least_s: float | None = None
    most_s: float | None = None
    kind: BoundKind
    of: str
    words: str
    stated: tuple[tuple[str, Parameter | str | None], ...] = ()
    limits: tuple[str, ...] = ()
    tolerances: tuple[str, ...] = ()

    @cached_property
    def edge(self) -> Edge[Link]:
        """It as an edge of the network, rounded to its looser side."""
        if self.most_s is not None:
            return Edge(self.earlier, self.later, microseconds(self.most_s), self)
        assert self.least_s is not None  # one of the two is given
        return Edge(self.later, self.earlier, microseconds(-self.least_s), self)


@dataclass(frozen=True, slots=True, kw_only=True)
class Spot:
    """A landmark on the map, and how far from it the roof of its building reaches, metres."""

    x_m: float
    y_m: float
    roof_m: float


@dataclass(frozen=True, slots=True, kw_only=True)
class Basis:
    """What bounds are worked out from.

    Attributes:
        spec: The request.
        limits: Limits in force: what is fastest.
        tolerances: How far stated numbers may be missed.
        plan: What grounding made of the missions, by id; empty before it. A number of the plan
            stands in the place of one that nobody states.
        landmarks: Where the landmarks of the map are, by their references; only before grounding.
    """

    spec: ScenarioSpec
    limits: Limits
    tolerances: Tolerances
    plan: Mapping[str, MissionFacts] = field(default_factory=dict)
    landmarks: Mapping[str, Spot] = field(default_factory=dict)

    @property
    def redirected(self) -> frozenset[str]:
        """UAVs that an event gives something else to do: it may end a phase at any time.

        What an event begins with is no such thing: before its first mission there is no phase.
        """
        first = {m.uav: m.id for m in reversed(self.spec.missions)}
        actions = (e.action for e in self.spec.events)
        return frozenset(
            a.uav
            for a in actions
            if isinstance(a, UavAction)
            and not (a.do == 'change_mission' and a.mission == first.get(a.uav))
        )

    def window_s(self, stated: Parameter | None) -> tuple[float, float]:
        """Return the least and greatest number of seconds that meet a request; None asks for 0."""
        if stated is None:
            return 0.0, 0.0
        slack = self.tolerances.duration_s.of(stated.value, approximate=stated.approximate)
        return least(stated, slack, 0.0), most(stated, slack, math.inf)

    def phase_s(self, mission: UavMission) -> tuple[float, float]:
        """Return how long a mission lasts at least and at most after its capture."""
        facts = self.plan.get(mission.id)
        if facts is not None and facts.duration_s is not None:
            slack = self.tolerances.duration_s.of(facts.duration_s)
            return max(0.0, facts.duration_s - slack), facts.duration_s + slack
        if mission.duration_s is None:
            return 0.0, math.inf
        return self.window_s(mission.duration_s)

    def lowest_m(self, mission: UavMission) -> float:
        """Return the lowest altitude at which a mission may be flown."""
        facts = self.plan.get(mission.id)
        asked = mission.altitude_m
        if facts is not None:
            slack = self.tolerances.altitude_m.of(facts.altitude_m)
            return max(0.0, facts.altitude_m - slack)
        slack = self.tolerances.altitude_m.of(asked.value, approximate=asked.approximate)
        return least(asked, slack, 0.0)
