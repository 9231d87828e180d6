# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""How a scene may be split over streets and lanes: what is tried next where one way has no place.

First all are on one street, in lanes that are for all of them. Where no street has room for that,
those at places of their own are on roads of their own, and bicycles ride in their own lanes. Last
of all, who crosses does so where no crosswalk is.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import replace

from aurora_core.grounding.convoy import ConvoyMember, SceneSplit, split_scene
from aurora_core.grounding.going import crosses
from aurora_core.grounding.lane_changers import first_side
from aurora_core.grounding.stepping_out import names_crosswalk
from aurora_core.knowledge.agent_types import AgentTypeRecord
from aurora_core.knowledge.limits import Tolerance
from aurora_core.spec.scenario import ScenarioSpec
from aurora_core.spec.vocabulary import LaneSide


def splits(
    spec: ScenarioSpec, tolerance: Tolerance, types: Mapping[str, AgentTypeRecord]
) -> Iterator[SceneSplit]:
    """Yield the splits of a scene in the order in which they are tried.

    Args:
        spec: The request.
        tolerance: Of placement distances.
        types: Agent sizes.
    """
    found = [split_scene(spec, tolerance, types)]
    for apart, bike_lanes in ((True, False), (False, True), (True, True)):
        split = split_scene(spec, tolerance, types, apart=apart, bike_lanes=bike_lanes)
        rides = any(m.bike_lane for group in (split.convoy, *split.groups) for m in group)
        if bool(split.groups) == apart and rides == bike_lanes:
            found.append(split)
    found = [_lifted(spec, split) for split in found]
    yield from found
    if any(crosses(spec, a) and not names_crosswalk(a) for a in found[0].persons):
        yield from (replace(split, anywhere=True) for split in found)


def _lifted(spec: ScenarioSpec, split: SceneSplit) -> SceneSplit:
    """Return a split in which who is to go to the right first has a lane there.

    One drives in the right lane: the whole group is in the next one then, and keeps its relations.
    """

    def lifted(members: tuple[ConvoyMember, ...]) -> tuple[ConvoyMember, ...]:
        if all(first_side(spec, m.agent) is not LaneSide.RIGHT for m in members):
            return members
        return tuple(
            m if m.bike_lane or m.parked else replace(m, lane_shift=m.lane_shift + 1)
            for m in members
        )

    return replace(
        split, convoy=lifted(split.convoy), groups=tuple(lifted(group) for group in split.groups)
    )
