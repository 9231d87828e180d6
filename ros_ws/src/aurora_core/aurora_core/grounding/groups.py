# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Vehicles at places of their own: on other roads than the convoy, related to nobody in it."""

from __future__ import annotations

import itertools
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace
from functools import partial

from aurora_core.geometry.kernel import norm2
from aurora_core.grounding.convoy import SIDES, ConvoyMember
from aurora_core.grounding.goals import GoalFinder
from aurora_core.grounding.lane_changers import needs_lane
from aurora_core.grounding.pace import fastest_stated_mps
from aurora_core.grounding.places import MapPlaces
from aurora_core.grounding.sites import SeatedAgent, Site, sites
from aurora_core.grounding.ties import BeforePlace
from aurora_core.grounding.ways_round import Point2
from aurora_core.knowledge.agent_types import AgentTypeRecord
from aurora_core.knowledge.map_model import MapModel
from aurora_core.knowledge.map_records import SpawnTable
from aurora_core.knowledge.settings import GroundingSettings
from aurora_core.spec.scenario import ScenarioSpec
from aurora_core.spec.vocabulary import Relation

# Who stands before a place has its middle so near on its way (m).
_THERE_M = 10.0

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
        befores: Of each the member that stands before an intersection or a crosswalk, or None.
        run_m: Length of their routes.
        spawns: What is beside each lane, and where vehicle types were measured to stand.
    """

    def __init__(
        self,
        map_model: MapModel,
        types: Mapping[str, AgentTypeRecord],
        goals: GoalFinder,
        settings: GroundingSettings,
        spec: ScenarioSpec,
        groups: tuple[tuple[ConvoyMember, ...], ...],
        befores: tuple[BeforePlace | None, ...],
        run_m: float,
        spawns: SpawnTable,
    ) -> None:
        self._goals = goals
        self._spec = spec

        def found(
            group: tuple[ConvoyMember, ...],
            before: BeforePlace | None,
            through: tuple[frozenset[str], ...],
            least_mps: float,
        ) -> list[Site]:
            return _best_first(
                sites(
                    map_model,
                    group,
                    types,
                    settings,
                    run_m,
                    goals.spacing_m(spec, settings.anchor_spacing_m),
                    before,
                    least_limit_mps=least_mps,
                    spawns=spawns,
                    several_lanes=any(needs_lane(spec, m.agent) for m in group),
                    goals=through,
                )
            )

        def tiers(
            group: tuple[ConvoyMember, ...], before: BeforePlace | None
        ) -> Iterator[_Candidates]:
            stated_mps = fastest_stated_mps(spec, (m.agent for m in group), settings.speeds)
            way = goals.edges_on_the_way(spec, [m.agent for m in group])
            # Where no street that allows a stated speed leads there, one drives faster than that.
            for least_mps in dict.fromkeys((stated_mps, 0.0)):
                yield _Candidates(found(group, before, (), least_mps), spec, goals)
                # Where no street leads straight on to a place, others do by turns.
                if way:
                    yield _Candidates(found(group, before, way, least_mps), spec, goals, wide=True)

        self._places = MapPlaces(map_model)
        self._tiers = [
            (_Kept(tiers(group, before)), before)
            for group, before in zip(groups, befores, strict=True)
        ]

    def seated(self, site: Site) -> Site | str:
        """Return a site with the further groups at their places, or what it lacks.

        Args:
            site: Where the convoy stands.
        """
        for tiers, before in self._tiers:
            fitting = itertools.chain(
                (one for tier in tiers for one in self._fit(tier, before, site, leading=True)),
                (one for tier in tiers for one in self._fit(tier, before, site)),
            )
            found = next(fitting, None)
            if found is None:
                return 'road'
            site = replace(site, others=(*site.others, *found))
        return site

    def _fit(
        self,
        candidates: _Candidates,
        before: BeforePlace | None,
        site: Site,
        *,
        leading: bool = False,
    ) -> Iterator[tuple[SeatedAgent, ...]]:
        """Yield the places of a group beside a site: `leading` to where an event waits for it."""
        anchor, wide = site.origin()[:2], candidates.wide
        for one in candidates.beside(anchor):
            if (
                _apart(one.seated, site)
                and self._is_before_its_place(one, before, anchor)
                and all(_on_its_side(seat, site) for seat in one.seated)
                and (not leading or self._goals.leads(self._spec, one, anchor, wide=wide))
            ):
                yield one.seated

    def _is_before_its_place(self, one: Site, before: BeforePlace | None, anchor: Point2) -> bool:
        """Tell whether a member stands before the very place that the scene is at."""
        seat = None if before is None else one.seat(before.agent)
        if before is None or seat is None:
            return True
        x, y, _, _ = seat.path.position_at(seat.arc_m + before.distance_m)
        to_x, to_y = self._places.point(before.place, anchor)
        return norm2(x - to_x, y - to_y) <= _THERE_M


class _Kept:
    """What is worked out when it is first asked for, and then kept."""

    def __init__(self, source: Iterator[_Candidates]) -> None:
        self._source = source
        self._known: list[_Candidates] = []

    def __iter__(self) -> Iterator[_Candidates]:
        for k in itertools.count():
            if k == len(self._known):
                more = next(self._source, None)
                if more is None:
                    return
                self._known.append(more)
            yield self._known[k]


class _Candidates:
    """Where one group may be.

    Whether it comes to its places from there is asked once, not of every scene: scenes that have
    the same intersection nearest to them ask for the same.

    Args:
        found: Its sites, best first.
        spec: The request.
        goals: What places ask for.
        wide: A long way does, too.
    """

    def __init__(
        self, found: list[Site], spec: ScenarioSpec, goals: GoalFinder, *, wide: bool = False
    ) -> None:
        self.wide = wide
        self._sites = found
        self._spec = spec
        self._goals = goals
        self._agents = [seat.agent for one in found[:1] for seat in one.seated]
        relations = {p.relation for agent in self._agents for p in agent.placements}
        self._sided = not relations.isdisjoint(SIDES)
        # By the points that count: of each site, whether it fits.
        self._known: dict[tuple[Point2, ...], dict[int, bool]] = {}
        self._origins: dict[int, Point2] = {}

    def beside(self, anchor: Point2) -> Iterator[Site]:
        """Yield what fits a scene in its order, but nearest first where it comes from a side.

        Args:
            anchor: Of the scene (x, y in m).
        """
        points = self._goals.points(self._spec, self._agents, anchor)
        known = self._known.setdefault(points, {})
        fitting = (k for k in range(len(self._sites)) if self._fits(k, anchor, known))
        for k in sorted(fitting, key=partial(self._away_m, anchor)) if self._sided else fitting:
            yield self._sites[k]

    def _fits(self, index: int, anchor: Point2, known: dict[int, bool]) -> bool:
        found = known.get(index)
        if found is None:
            site = self._sites[index]
            found = known[index] = self._goals.fits(self._spec, site, anchor, wide=self.wide)
        return found

    def _away_m(self, anchor: Point2, index: int) -> float:
        origin = self._origins.get(index)
        if origin is None:
            origin = self._origins[index] = self._sites[index].origin()[:2]
        return norm2(origin[0] - anchor[0], origin[1] - anchor[1])


def _best_first(found: Iterable[Site]) -> list[Site]:
    """Return sites by how far one drives there before the first signal."""
    return sorted(found, key=lambda site: -site.free_run_m)


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
