# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Vehicles at places of their own: on other roads than the convoy, related to nobody in it."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace

from aurora_core.geometry.kernel import norm2
from aurora_core.grounding.convoy import SIDES, ConvoyMember
from aurora_core.grounding.goals import GoalFinder
from aurora_core.grounding.lane_changers import changes_lane
from aurora_core.grounding.pace import fastest_stated_mps
from aurora_core.grounding.sites import SeatedAgent, Site, sites
from aurora_core.knowledge.agent_types import AgentTypeRecord
from aurora_core.knowledge.map_model import MapModel
from aurora_core.knowledge.settings import GroundingSettings
from aurora_core.spec.scenario import ScenarioSpec
from aurora_core.spec.vocabulary import Relation

# Vehicles of two groups start at least so far from each other (m).
_APART_M = 15.0

# Who comes from a side starts at least so far on that side (m).
_ASIDE_M = 10.0


class GroupPlacer:
    """Places further groups beside the convoy; the candidates of each are found once.

    Args:
        map_model: Map.
        types: Agent sizes.
        goals: What places ask for.
        settings: Of the search.
        spec: The request.
        groups: The groups.
        run_m: Length of their routes.
    """

    def __init__(
        self,
        map_model: MapModel,
        types: Mapping[str, AgentTypeRecord],
        goals: GoalFinder,
        settings: GroundingSettings,
        spec: ScenarioSpec,
        groups: tuple[tuple[ConvoyMember, ...], ...],
        run_m: float,
    ) -> None:
        self._goals = goals
        self._spec = spec

        def found(
            group: tuple[ConvoyMember, ...], through: tuple[frozenset[str], ...]
        ) -> list[Site]:
            return _best_first(
                sites(
                    map_model,
                    group,
                    types,
                    settings,
                    run_m,
                    goals.spacing_m(spec, settings.anchor_spacing_m),
                    least_limit_mps=fastest_stated_mps(
                        spec, (m.agent for m in group), settings.speeds
                    ),
                    several_lanes=any(changes_lane(spec, m.agent) for m in group),
                    goals=through,
                )
            )

        self._candidates = [found(group, ()) for group in groups]
        ways = [goals.edges_on_the_way(spec, [m.agent for m in group]) for group in groups]
        # Where no street leads straight on to a place, others do by turns.
        self._turning = [
            found(group, way) if way else [] for group, way in zip(groups, ways, strict=True)
        ]

    def seated(self, site: Site) -> Site | str:
        """Return a site with the further groups at their places, or what it lacks.

        Args:
            site: Where the convoy stands.
        """
        for candidates, turning in zip(self._candidates, self._turning, strict=True):
            found = next(self._fit(candidates, site, leading=True), None)
            found = found or next(self._fit(turning, site, leading=True, wide=True), None)
            found = found or next(self._fit(candidates, site), None)
            if found is None:
                return 'road'
            site = replace(site, others=(*site.others, *found))
        return site

    def _fit(
        self, candidates: list[Site], site: Site, *, leading: bool = False, wide: bool = False
    ) -> Iterator[tuple[SeatedAgent, ...]]:
        """Yield the places of a group beside a site: `leading` to where an event waits for it."""
        anchor = site.origin()[:2]
        for one in _nearest_first(candidates, site):
            if (
                self._goals.fits(self._spec, one, anchor, wide=wide)
                and _apart(one.seated, site)
                and all(_on_its_side(seat, site) for seat in one.seated)
                and (not leading or self._goals.leads(self._spec, one, anchor, wide=wide))
            ):
                yield one.seated


def _best_first(found: Iterable[Site]) -> list[Site]:
    """Return sites by how far one drives there before the first signal."""
    return sorted(found, key=lambda site: -site.free_run_m)


def _nearest_first(candidates: list[Site], site: Site) -> list[Site]:
    """Return candidates in their order, but nearest first where they come from a side."""

    def away_m(candidate: Site) -> float:
        (x, y, _, _), (to_x, to_y, _, _) = candidate.origin(), site.origin()
        return norm2(x - to_x, y - to_y)

    members = (seat.agent for one in candidates[:1] for seat in one.seated)
    sided = any(p.relation in SIDES for agent in members for p in agent.placements)
    return sorted(candidates, key=away_m) if sided else candidates


def _on_its_side(seat: SeatedAgent, site: Site) -> bool:
    """Tell whether a vehicle is on the side of others on which it is to be."""
    x, y, _, _ = seat.path.position_at(seat.arc_m)
    for placement in seat.agent.placements:
        other = site.seat(placement.of or '')
        if other is None or placement.relation not in SIDES:
            continue
        to_x, to_y, hx, hy = other.path.position_at(other.arc_m)
        left_m = (y - to_y) * hx - (x - to_x) * hy
        forward_m = (x - to_x) * hx + (y - to_y) * hy
        side_m = left_m if placement.relation is Relation.LEFT else -left_m
        if side_m < max(_ASIDE_M, abs(forward_m)):
            return False
    return True


def _apart(seats: tuple[SeatedAgent, ...], site: Site) -> bool:
    taken = [s.path.position_at(s.arc_m) for s in (*site.seated, *site.others)]
    wanted = [s.path.position_at(s.arc_m) for s in seats]
    return all(norm2(a[0] - b[0], a[1] - b[1]) >= _APART_M for a in wanted for b in taken)
