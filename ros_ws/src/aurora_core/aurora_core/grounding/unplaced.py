# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What to tell a person whose scene found no place: what could not be placed, what would fit.

Looked into after everything has been tried, so it may take as long as the search did.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import replace
from itertools import combinations

from aurora_core.grounding.convoy import ConvoyMember, SceneSplit
from aurora_core.grounding.distances import BUMPERS_M
from aurora_core.grounding.goals import GoalFinder
from aurora_core.grounding.lane_changers import needs_lane
from aurora_core.grounding.sites import sites
from aurora_core.knowledge.agent_types import AgentTypeRecord
from aurora_core.knowledge.map_model import MapModel
from aurora_core.knowledge.map_records import SpawnTable
from aurora_core.knowledge.settings import GroundingSettings
from aurora_core.spec.reference import LANDMARK
from aurora_core.spec.scenario import ScenarioSpec

# What a site lacked, in words; `{who}` are those whom it is about.
_LACKS = {
    'road': 'beside the street of the others there is no second one for those at places of '
    'their own; places nearer to each other, or one place for all, would fit',
    'oncoming': '{who} would have to come along the other direction of the street, but where the '
    'others stand it has none, bends, or is too short; another distance would fit',
    'crosswalk': 'no crosswalk without a traffic light is where {who} crosses: 20 to 120 m ahead '
    'of the vehicles, on their street; without the place or the distance one would fit',
    'far_kerb': 'where {who} is to step out there is no sidewalk on the other side of the street; '
    'beside another vehicle, or at another place, there would be one',
    'away_from_place': 'where {who} is to be beside a vehicle it is not at its landmark; another '
    'distance between them, or one of the two alone, would fit',
    'blocked': 'where {who} is to stand or walk a parked vehicle takes the sidewalk; ahead of it '
    'or behind it there would be room',
    'sidewalk': 'where {who} is to stand or walk there is no sidewalk; beside another vehicle, or '
    'at another distance, there would be one',
    'clearance': 'the UAV would pass too near to buildings on its way; a greater altitude would '
    'fit',
    'pattern': 'the route of the UAV fits nowhere between the buildings; a smaller one, or a '
    'greater altitude, would',
    'sight': 'the UAV would not see what it is to watch; a greater altitude or a smaller '
    'distance would fit',
    'separation': 'the UAVs would come too near to each other; other altitudes would fit',
    'start_spot': 'there is no free spot from which a UAV can start',
    'way_between_missions': 'no way of the UAV from one mission to the next is free of buildings; '
    'a greater altitude would fit',
}


def lacked(reason: str, split: SceneSplit) -> str:
    """Return in words what most of the sites lacked that were tried.

    Args:
        reason: What it is called in a failure.
        split: Who was to be placed.
    """
    about = {'oncoming': split.oncoming}
    about |= dict.fromkeys(
        ('crosswalk', 'far_kerb', 'sidewalk', 'blocked', 'away_from_place'), split.persons
    )
    who = _listed([agent.id for agent in about.get(reason, ())])
    return _LACKS.get(reason, reason.replace('_', ' ')).format(who=who or 'somebody')


def on_no_street(
    spec: ScenarioSpec,
    split: SceneSplit,
    goals: GoalFinder,
    map_model: MapModel,
    types: Mapping[str, AgentTypeRecord],
    settings: GroundingSettings,
    spawns: SpawnTable,
    run_m: float,
) -> str:
    """Return in words why no street has room for the vehicles that belong together.

    Args:
        spec: The request.
        split: Who was to be placed.
        goals: What places ask of a site.
        map_model: Map.
        types: Agent sizes.
        settings: Of the search.
        spawns: What is beside each lane, and where vehicle types were measured to stand.
        run_m: Length of the routes.
    """
    convoy = split.convoy
    crowded = '; '.join(_crowded(convoy, types))
    if crowded:
        return crowded
    passing = [m.agent.id for m in convoy if needs_lane(spec, m.agent)]
    spacing_m = goals.spacing_m(spec, settings.anchor_spacing_m)

    def fits(members: tuple[ConvoyMember, ...]) -> bool:
        where = map_model, members, types, settings
        found = sites(*where, run_m, spacing_m, spawns=spawns)
        return any(goals.fits(spec, site) for site in found)

    if passing and fits(convoy):
        return (
            f'{_listed(passing)} would need a second lane to pass or to change to, and no street '
            'with one is where they are to be; at another place there would be one'
        )
    alone = {m.agent.id: (replace(m, offset_m=0.0, lane_shift=0),) for m in convoy}
    lost = [name for name, member in alone.items() if not fits(member)]
    if lost:
        return '; '.join(_lost(spec, name, goals) for name in lost)
    shifted = [m.agent.id for m in convoy if m.lane_shift != 0]
    if shifted and fits(tuple(replace(m, lane_shift=0) for m in convoy)):
        return (
            f'{_listed(shifted)} would need a lane beside the others, and no street there has '
            'one; in one lane, ahead or behind, they would fit'
        )
    for name in alone:
        others = _from_the_first([m for m in convoy if m.agent.id != name])
        if others and fits(others):
            rest, places = _listed([m.agent.id for m in others]), goals.places_of(spec, name)
            if not places:
                return (
                    f'where {name} is to stand, {rest} leave no room on one street; another '
                    'distance would fit'
                )
            return (
                f'{name} at {_plain(" and ".join(places))} does not fit on one street with {rest};'
                ' without that place, or at another distance, it would'
            )
    offsets_m = [m.offset_m for m in convoy] or [0.0]
    return (
        f'{_listed(list(alone))} would take {max(offsets_m) - min(offsets_m):.0f} m of one '
        'street, and none has all the places that they are to be at; fewer places, or shorter '
        'distances, would fit'
    )


def _crowded(
    convoy: tuple[ConvoyMember, ...], types: Mapping[str, AgentTypeRecord]
) -> Iterator[str]:
    """Yield which two stand in each other: no street has room for them."""
    for one, other in combinations(convoy, 2):
        first, second = (types[m.agent.type.value] for m in (one, other))
        apart_m = abs(one.offset_m - other.offset_m)
        least_m = (first.length_m + second.length_m) / 2.0 + BUMPERS_M
        same = one.lane_shift == other.lane_shift and one.parked == other.parked
        if same and apart_m < least_m - BUMPERS_M:
            yield (
                f'{one.agent.id} ({first.name}, {first.length_m:g} m long) and {other.agent.id} '
                f'({second.name}, {second.length_m:g} m) would stand in each other at '
                f'{apart_m:.3g} m from middle to middle; {least_m:.1f} m would fit'
            )


def _from_the_first(members: list[ConvoyMember]) -> tuple[ConvoyMember, ...]:
    """Return members with their offsets from the first of them, who is the origin now."""
    return tuple(replace(m, offset_m=m.offset_m - members[0].offset_m) for m in members)


def _lost(spec: ScenarioSpec, name: str, goals: GoalFinder) -> str:
    """Return why one vehicle finds no place at all."""
    places = goals.places_of(spec, name)
    kind = next(a.type.value for a in spec.agents if a.id == name)
    if not places:
        return f'no street of the map is one that {name} ({kind}) may stand on and drive along'
    return (
        f'no street leads {name} ({kind}) to {_plain(" and ".join(places))} in one way; another '
        'place, or one place less, would fit'
    )


def _plain(place: str) -> str:
    return place.replace(LANDMARK, '').replace('_', ' ')


def _listed(names: list[str]) -> str:
    return names[0] if len(names) == 1 else ' and '.join((', '.join(names[:-1]), *names[-1:]))
