# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""How far a hover at one landmark is from another one, or from who is parked there."""

from __future__ import annotations

import math

from aurora_core.feasibility.facts import says, tolerance_facts
from aurora_core.feasibility.zones import is_half_read, is_over, place_distances, roof_reach_m
from aurora_core.knowledge.limits import Limits, Tolerances
from aurora_core.knowledge.map_model import MapModel
from aurora_core.knowledge.map_types import Landmark
from aurora_core.outcomes.feasibility import Fact
from aurora_core.spec.reference import LANDMARK
from aurora_core.spec.scenario import AgentAction, ScenarioSpec, UavMission
from aurora_core.spec.vocabulary import BehaviorKind, MissionMode, Relation

# From a landmark to whoever stands where the road leads to it, at most (m): no map comes in with
# a longer way, half a bus included. Who is at the landmark or near it may be `near_m` beside that.
_APPROACH_M = 160.0
_AT = frozenset({Relation.AT, Relation.NEAR, Relation.PARKED_AT})


class Spots:
    """What stays at landmarks of a map: hovers, and who is parked."""

    def __init__(
        self, spec: ScenarioSpec, map_model: MapModel, limits: Limits, tolerances: Tolerances
    ) -> None:
        self._spec = spec
        self._marks = {f'{LANDMARK}{mark.name}': mark for mark in map_model.quotable}
        self._buildings = map_model.buildings
        self._limits = limits
        self._tolerances = tolerances

    def apart_m(self, mission: UavMission, name: str) -> tuple[float, float]:
        """Return the least and greatest way along the ground from a flight to somebody, metres.

        Anything where one of the two has no landmark, or words of the flight were not read.
        """
        mark, (target, aside_m, _) = self._marks.get(mission.target or ''), self._where(name)
        hovers = mission.mode is MissionMode.HOVER and not is_half_read(self._spec, mission)
        if mark is None or target is None or not hovers:
            return 0.0, math.inf
        _, far_m = place_distances(mission, self._limits, self._tolerances)
        if is_over(mission):
            far_m = max(far_m, roof_reach_m(mark, self._buildings))
        apart_m = math.hypot(mark.x_m - target.x_m, mark.y_m - target.y_m)
        return max(0.0, apart_m - far_m - aside_m), apart_m + far_m + aside_m

    def facts(self, mission: UavMission, name: str) -> tuple[Fact, ...]:
        """Return what these ways follow from."""
        base = f'missions/{mission.id}'
        return (
            *says(f'{base}/target', mission.target),
            *says(f'{base}/standoff_m', mission.standoff_m),
            *self._where(name)[2],
            *tolerance_facts(self._tolerances, 'pattern_centre_m', 'hover_drift_wind_m'),
        )

    def _where(self, name: str) -> tuple[Landmark | None, float, tuple[Fact, ...]]:
        """Return the landmark that something is at, and how far from it that may be, metres."""
        if name in self._marks:
            return self._marks[name], 0.0, ()
        agent = next((a for a in self._spec.agents if a.id == name), None)
        events = self._spec.events
        moves = any(isinstance(e.action, AgentAction) and e.action.agent == name for e in events)
        if agent is None or moves or {b.kind for b in agent.behaviors} != {BehaviorKind.PARK}:
            return None, 0.0, ()
        for k, placed in enumerate(agent.placements):
            if placed.relation in _AT and placed.of is not None and placed.of in self._marks:
                base = f'agents/{name}/placements/{k}'
                facts = (
                    *says(f'{base}/relation', placed.relation.value),
                    *says(f'{base}/of', placed.of),
                    *tolerance_facts(self._tolerances, 'near_m'),
                )
                return self._marks[placed.of], self._tolerances.near_m + _APPROACH_M, facts
        return None, 0.0, ()
