# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Vehicles at places of their own: on other roads than the convoy, related to nobody in it."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import replace

from aurora_core.geometry.kernel import norm2
from aurora_core.grounding.convoy import ConvoyMember
from aurora_core.grounding.goals import GoalFinder
from aurora_core.grounding.lane_changers import changes_lane
from aurora_core.grounding.pace import fastest_stated_mps
from aurora_core.grounding.sites import SeatedAgent, Site, sites
from aurora_core.knowledge.agent_types import AgentTypeRecord
from aurora_core.knowledge.map_model import MapModel
from aurora_core.knowledge.settings import GroundingSettings
from aurora_core.spec.scenario import ScenarioSpec

# Vehicles of two groups start at least so far from each other (m).
_APART_M = 15.0


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
        self._candidates = [
            _best_first(
                sites(
                    map_model,
                    group,
                    types,
                    run_m,
                    goals.spacing_m(spec, settings.anchor_spacing_m),
                    least_limit_mps=fastest_stated_mps(spec, (m.agent for m in group)),
                    several_lanes=any(changes_lane(spec, m.agent) for m in group),
                )
            )
            for group in groups
        ]

    def seated(self, site: Site) -> Site | str:
        """Return a site with the further groups at their places, or what it lacks.

        Args:
            site: Where the convoy stands.
        """
        anchor = site.origin()[:2]
        for candidates in self._candidates:
            found = next(
                (
                    one.seated
                    for one in candidates
                    if self._goals.fits(self._spec, one, anchor) and _apart(one.seated, site)
                ),
                None,
            )
            if found is None:
                return 'road'
            site = replace(site, others=(*site.others, *found))
        return site


def _best_first(found: Iterable[Site]) -> list[Site]:
    """Return sites by how far one drives there before the first signal."""
    return sorted(found, key=lambda site: -site.free_run_m)


def _apart(seats: tuple[SeatedAgent, ...], site: Site) -> bool:
    taken = [s.path.position_at(s.arc_m) for s in (*site.seated, *site.others)]
    wanted = [s.path.position_at(s.arc_m) for s in seats]
    return all(norm2(a[0] - b[0], a[1] - b[1]) >= _APART_M for a in wanted for b in taken)
