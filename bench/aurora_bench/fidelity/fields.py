# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Which annotated fields of one requirement hold, under a binding: worlds, bodies, places, links.

Every function returns one entry per annotated field: True when it holds. Of several elements that
could be meant, the one that holds most counts.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

from aurora_bench.fidelity.binding import Binding
from aurora_bench.fidelity.carriers import BehaviorFact, PlacementFact
from aurora_bench.fidelity.numbers import NumberRule
from aurora_bench.prompts.format import (
    AgentRequirement,
    BehaviorRequirement,
    CountRequirement,
    LinkRequirement,
    MissionRequirement,
    PlacementRequirement,
    Requirement,
    UavRequirement,
    WorldRequirement,
    stated_fields,
)
from aurora_core.spec.parameter import Parameter
from aurora_core.spec.scenario import Link, ScenarioSpec, UavMission

Fields = dict[str, bool]


@dataclass(frozen=True, kw_only=True)
class Subject:
    """What a comparison needs besides the requirement."""

    spec: ScenarioSpec
    binding: Binding
    placements: tuple[PlacementFact, ...]
    behaviors: tuple[BehaviorFact, ...]
    before: frozenset[tuple[str, str]]


@dataclass(frozen=True, kw_only=True)
class Case:
    """A requirement and what it is looked for in.

    Attributes:
        requirement: One of the prompt, or one reading of an `any_of`.
        asked: All requirements of the prompt, readings included.
        subject: Specification and binding.
        rule: Tolerances of the requirement.
        is_reading: It is one of several readings: it may share elements with other requirements.
    """

    requirement: Requirement
    asked: tuple[Requirement, ...]
    subject: Subject
    rule: NumberRule
    is_reading: bool


def best(candidates: Iterable[Fields], names: Iterable[str]) -> Fields:
    """Return the candidate with most fields held; none of them without a candidate."""
    found = list(candidates)
    return max(found, key=lambda f: sum(f.values())) if found else dict.fromkeys(names, False)


def for_all(parts: list[Fields], names: Iterable[str]) -> Fields:
    """Return what holds for every member of a group; nothing for an empty one."""
    return {name: bool(parts) and all(part[name] for part in parts) for name in names}


def world_fields(r: WorldRequirement, subject: Subject, rule: NumberRule) -> Fields:
    """Compare one field of the world; an unstated one has its default."""
    world = subject.spec.world
    if r.field in ('duration_s', 'wind_mps', 'gust_mps', 'wind_from_deg'):
        return {'value': rule.counts('value', float(r.value), getattr(world, r.field))}
    found = {
        'weather': world.weather,
        'time_of_day': world.time_of_day,
        'map': world.map_name,
        'traffic_density': world.traffic_density or '',
        'wind': world.wind or '',
    }.get(r.field)
    return {'value': found is not None and str(found) == str(r.value)}


def agent_fields(r: AgentRequirement, subject: Subject) -> Fields:
    """Compare type, count and role of an agent or group."""
    members = [a for a in subject.spec.agents if a.id in subject.binding.bodies.get(r.ref, ())]
    if r.count == 0:
        return {'count': not any(a.type is r.type for a in subject.spec.agents)}
    fields = {'type': bool(members) and all(a.type is r.type for a in members)}
    if r.count > 1:
        fields['count'] = len(members) == r.count
    if r.role is not None:
        fields['role'] = bool(members) and all(a.role.value == r.role for a in members)
    return fields


def uav_fields(r: UavRequirement, subject: Subject) -> Fields:
    """Compare the number of UAVs of a name."""
    if r.count == 0:
        return {'count': not subject.spec.uavs}
    return {'count': len(subject.binding.bodies.get(r.ref, ())) == r.count}


def placement_fields(r: PlacementRequirement, subject: Subject, rule: NumberRule) -> Fields:
    """Compare a placement with all places that the specification gives the agent."""
    names = ['relation', *_named(r.of, 'of'), *_numbers(r, 'distance_m', 'bearing_deg')]

    def compare(fact: PlacementFact) -> Fields:
        fields = {'relation': fact.relation is r.relation}
        if r.of is not None:
            fields['of'] = subject.binding.means(r.of, fact.of)
        for name in names[len(fields) :]:
            fields[name] = rule.counts(name, getattr(r, name), getattr(fact, name))
        return fields

    return for_all(
        [
            best((compare(f) for f in subject.placements if f.agent == member), names)
            for member in subject.binding.of(r.agent)
        ],
        names,
    )


def behavior_fields(r: BehaviorRequirement, subject: Subject, rule: NumberRule) -> Fields:
    """Compare a behaviour with everything that the agent does."""
    names = ['behavior', *_named(r.target, 'target')]
    names += _numbers(r, 'speed_mps', 'headway_s', 'duration_s')
    names += _named(r.side, 'side')

    def compare(fact: BehaviorFact) -> Fields:
        fields = {'behavior': fact.kind is r.behavior}
        if r.target is not None:
            fields['target'] = subject.binding.means(r.target, fact.target)
        if r.speed_mps is not None:
            fields['speed_mps'] = rule.counts('speed_mps', r.speed_mps, fact.speed_mps)
        if r.headway_s is not None:
            fields['headway_s'] = rule.counts('headway_s', r.headway_s, fact.headway_s)
        if r.duration_s is not None:
            fields['duration_s'] = rule.counts('duration_s', r.duration_s, fact.duration_s)
        if r.side is not None:
            fields['side'] = fact.side == r.side
        return fields

    return for_all(
        [
            best((compare(f) for f in subject.behaviors if f.agent == member), names)
            for member in subject.binding.of(r.agent)
        ],
        names,
    )


_MISSION_NUMBERS = (
    'altitude_m', 'standoff_m', 'bearing_deg', 'duration_s', 'radius_m', 'waypoint_count',
    'turns', 'speed_mps',
)  # fmt: skip


def mission_names(r: MissionRequirement) -> list[str]:
    """Return the annotated fields of a mission."""
    names = [
        'uav',
        'mode',
        *_named(r.target, 'target'),
        *_named(r.pattern, 'pattern'),
        *_named(r.side, 'side'),
        *_named(r.start, 'start'),
        *_named(r.end, 'end'),
    ]
    return [*names, *_numbers(r, *_MISSION_NUMBERS), *_numbers(r, 'size_m')]


def mission_fields(
    r: MissionRequirement, mission: UavMission, subject: Subject, rule: NumberRule
) -> Fields:
    """Compare a mission with one mission of the specification."""
    fields: Fields = {'uav': subject.binding.means(r.uav, mission.uav)}
    fields['mode'] = mission.mode is r.mode
    if r.target is not None:
        fields['target'] = subject.binding.means(r.target, mission.target)
    if r.pattern is not None:
        fields['pattern'] = mission.pattern is r.pattern
    if r.side is not None:
        fields['side'] = mission.side is not None and mission.side.value == r.side
    if r.start is not None:
        fields['start'] = subject.binding.means(r.start, mission.start)
    if r.end is not None:
        fields['end'] = subject.binding.means(r.end, mission.target)
    for name in _numbers(r, *_MISSION_NUMBERS):
        fields[name] = rule.counts(name, getattr(r, name), getattr(mission, name))
    if r.size_m is not None:
        fields['size_m'] = size_counts(r.size_m, mission.size_m, rule, 'size_m')
    return fields


def size_counts(
    wanted: tuple[float, float],
    found: tuple[Parameter, Parameter] | None,
    rule: NumberRule,
    path: str,
) -> bool:
    """Whether a pattern has the wanted size; which side is called the length does not matter."""
    if found is None:
        return False
    if wanted[1] == 0.0:  # a line has no width
        return rule.counts(f'{path}.0', wanted[0], found[0])
    return any(
        rule.counts(f'{path}.0', wanted[0], one) and rule.counts(f'{path}.1', wanted[1], two)
        for one, two in (found, found[::-1])
    )


def link_fields(r: LinkRequirement, subject: Subject, rule: NumberRule) -> Fields:
    """Compare a link with the links of the specification."""
    numbers = _numbers(r, 'loss', 'latency_s', 'range_m', 'retransmissions', 'rate_hz')
    outage = _numbers(r, 'outage_s')

    def compare(link: Link) -> Fields:
        fields = {
            'sender': subject.binding.means(r.sender, link.sender),
            'receiver': subject.binding.means(r.receiver, link.receiver),
            **{n: rule.counts(n, getattr(r, n), getattr(link, n)) for n in numbers},
        }
        if r.outage_s is not None:
            ends = link.outage_s or (None, None)
            fields['outage_s'] = all(
                rule.counts(f'outage_s.{k}', wanted, ends[k])
                for k, wanted in enumerate(r.outage_s)
            )
        return fields

    return best(
        (compare(link) for link in subject.spec.links),
        ['sender', 'receiver', *numbers, *outage],
    )


def count_fields(r: CountRequirement, subject: Subject, rule: NumberRule) -> Fields:
    """Compare a number of bodies in the whole scene with the numbers that close the scene."""
    names = [*_named(r.type, 'type'), *_named(r.of, 'of'), *_named(r.scope, 'scope'), 'value']
    return best(
        (
            {
                name: {
                    'type': count.kind == r.type,
                    'of': False,  # a specification counts kinds, nobody by name
                    'scope': r.scope == 'scene',
                    'value': rule.counts('value', r.value, count.value),
                }[name]
                for name in names
            }
            for count in subject.spec.counts
        ),
        names,
    )


# What `world_fields` to `condition_fields` look at; the annotation format may have grown.
_READ: dict[str, frozenset[str]] = {
    'world': frozenset({'field', 'value'}),
    'agent': frozenset({'ref', 'type', 'count', 'role'}),
    'uav': frozenset({'ref', 'count'}),
    'placement': frozenset({'agent', 'relation', 'of', 'distance_m', 'bearing_deg'}),
    'behavior': frozenset(
        {'agent', 'behavior', 'target', 'speed_mps', 'headway_s', 'side', 'duration_s'}
    ),
    'mission': frozenset(
        {'ref', 'uav', 'mode', 'target', 'pattern', 'side', 'size_m', *_MISSION_NUMBERS}
    ),
    'link': frozenset(
        {'sender', 'receiver', 'loss', 'latency_s', 'range_m', 'retransmissions', 'rate_hz'}
        | {'outage_s'}
    ),
    'event': frozenset({'ref', 'trigger', 'action', 'within_s'}),
    'count': frozenset({'type', 'of', 'value', 'scope'}),
    'order': frozenset({'first', 'then', 'within_s'}),
    'condition': frozenset({'quantity', 'of', 'op', 'value', 'hold_s', 'by_s', 'fraction'}),
    'reject': frozenset({'because'}),
}
_OF_EVERY_KIND = frozenset({'id', 'kind', 'negate', 'tol'})


def unread_fields(r: Requirement) -> Fields:
    """Return the annotated fields that no comparison knows: a specification cannot say them yet.

    Each counts as not held, so that an extension of the format is never met by being overlooked.
    """
    read = _READ.get(r.kind)
    names = [n for n in stated_fields(r) if n not in _OF_EVERY_KIND | (read or frozenset())]
    return dict.fromkeys(names or ['kind'], False) if read is None or names else {}


def _named(value: object, name: str) -> list[str]:
    return [] if value is None else [name]


def _numbers(requirement: object, *names: str) -> list[str]:
    return [name for name in names if getattr(requirement, name) is not None]
