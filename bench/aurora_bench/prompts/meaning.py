# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Annotations that have the right form and names, and still mean nothing."""

from __future__ import annotations

from collections.abc import Iterator

from aurora_bench.prompts.findings import Finding, Rule
from aurora_bench.prompts.format import (
    AnnotatedPrompt,
    ConditionRequirement,
    Requirement,
    WorldRequirement,
    everything,
    flat,
)
from aurora_bench.prompts.numbers import field_of, numbers_at
from aurora_core.spec.vocabulary import MissionMode, TimeOfDay, TrafficDensity, Weather

_NUMBERS_OF_WORLD = frozenset({'duration_s', 'wind_mps', 'gust_mps', 'wind_from_deg'})
_WORDS: dict[str, frozenset[str]] = {
    'wind': frozenset({'crosswind', 'headwind', 'tailwind'}),
    'weather': frozenset(Weather),
    'time_of_day': frozenset(TimeOfDay),
    'traffic_density': frozenset(TrafficDensity),
}
# How many bodies (or events) a quantity is of; the others take any number of them.
_OF_ONE = frozenset(
    {'altitude', 'speed', 'hover_drift', 'waypoints_visited', 'event_time', 'battery'}
)
_OF_TWO = frozenset(
    {'distance', 'horizontal_distance', 'tracked_fraction', 'visible_time', 'visible_fraction',
     'delivery_latency', 'delivered', 'delivery_ratio', 'clearance'}
)  # fmt: skip
_YES_OR_NO = frozenset({'delivered', 'mission_completed', 'landed'})
_SHARES = frozenset({'loss', 'fraction'})


def check_meaning(prompt: AnnotatedPrompt) -> Iterator[Finding]:
    """Find values that nothing can have, and requirements that nothing can meet or run."""
    requirements = flat(prompt.requirements)
    texts = [text for r in everything(prompt.requirements) for text in _of_one(r)]
    egos = [r for r in prompt.requirements if r.kind == 'agent' and r.role == 'ego']
    if len(egos) > 1:
        texts.append('there can be one ego only')
    moments = [r.ref for r in prompt.requirements if r.kind == 'mission' or r.kind == 'event']
    texts += [f'{ref!r} names two moments' for ref in sorted(_repeated(moments))]
    if prompt.end_to_end and not any(r.kind in ('agent', 'uav', 'reject') for r in requirements):
        texts.append('is marked end_to_end, but there is nobody to run and nothing to refuse')
    for text in texts:
        yield Finding(where=prompt.id, rule=Rule.MEANING, text=text)


def _repeated(names: list[str]) -> set[str]:
    return {name for name in names if names.count(name) > 1}


def _of_one(r: Requirement) -> Iterator[str]:
    if r.kind == 'any_of':
        if any(reading.kind == 'any_of' for reading in r.any_of):
            yield f'{r.id}: a reading cannot have readings itself'
        if any(reading.kind == 'beyond' for reading in r.any_of):
            yield f'{r.id}: what no field holds is no reading'
        return
    yield from _numbers(r)
    if r.kind == 'world':
        yield from _world(r)
    elif r.kind == 'condition':
        yield from _condition(r)
    elif r.kind == 'mission':
        if r.pattern is not None and r.mode is not MissionMode.NAVIGATE:
            yield f'{r.id}: a pattern is flown by navigate, not by {r.mode}'
        if r.target == r.uav:
            yield f'{r.id}: {r.uav!r} cannot be its own target'
        yield from _pair_of_altitudes(r.id, r.altitude_m, r.pattern)
    elif r.kind == 'event' and r.action is not None:
        yield from _pair_of_altitudes(r.id, r.action.altitude_m, r.action.pattern)
    elif r.kind == 'link' and r.outage_s is not None and r.outage_s[0] >= r.outage_s[1]:
        yield f'{r.id}: an outage ends after it begins'
    elif r.kind == 'count' and (r.type is None) is (r.of is None):
        yield f'{r.id}: a count is of a type or of names, one of the two'
    for one, other in _pairs(r):
        if one == other:
            yield f'{r.id}: {one!r} cannot stand in relation to itself'


def _pair_of_altitudes(
    ident: str, altitude_m: float | tuple[float, float] | None, pattern: str | None
) -> Iterator[str]:
    if isinstance(altitude_m, tuple):
        if pattern != 'facade':
            yield f'{ident}: two altitudes belong to a facade'
        if altitude_m[0] >= altitude_m[1]:
            yield f'{ident}: the first altitude is the lower one'


def _pairs(r: Requirement) -> Iterator[tuple[str, str | None]]:
    if r.kind == 'placement':
        yield r.agent, r.of
    elif r.kind == 'link':
        yield r.sender, r.receiver
    elif r.kind == 'order':
        yield r.first, r.then


def _numbers(r: Requirement) -> Iterator[str]:
    for path, value in numbers_at(r):
        field = field_of(path)
        if field == 'bearing_deg':
            continue
        if value < 0.0:
            yield f'{path} = {value:g} is below zero'
        elif (field in _SHARES or path.endswith('.trigger.value')) and value > 1.0:
            yield f'{path} = {value:g} is no share between 0 and 1'
    if isinstance(r.tol, dict):
        held = {path.split('.')[-1] for path, _ in numbers_at(r) if '.tol.' not in path}
        for name in sorted(set(r.tol) - held - {'size_m'}):
            yield f'{r.id}.tol gives a tolerance to {name!r}, which has no number'


def _world(r: WorldRequirement) -> Iterator[str]:
    if (r.field in _NUMBERS_OF_WORLD) is isinstance(r.value, str):
        yield f'{r.id}: {r.field} cannot be {r.value!r}'
    elif r.field in _WORDS and r.value not in _WORDS[r.field]:
        yield f'{r.id}: {r.field} is one of {", ".join(sorted(_WORDS[r.field]))}, not {r.value!r}'


def _condition(r: ConditionRequirement) -> Iterator[str]:
    number = len(r.of)
    wanted = 1 if r.quantity in _OF_ONE else 2 if r.quantity in _OF_TWO else None
    is_of_scene = r.quantity == 'wind' and number == 0
    if (number == 0 and not is_of_scene) or (wanted is not None and number != wanted):
        yield f'{r.id}: {r.quantity} is of {wanted or "at least 1"}, not of {number}'
    if (r.quantity in _YES_OR_NO) is not isinstance(r.value, bool):
        yield f'{r.id}: {r.quantity} cannot be {r.value!r}'
