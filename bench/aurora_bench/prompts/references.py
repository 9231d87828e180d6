# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Every name that a requirement uses must be declared, or be a place of the map."""

from __future__ import annotations

from collections.abc import Iterator

from aurora_bench.prompts.findings import Finding, Rule
from aurora_bench.prompts.format import (
    FIELDS_OF_TRIGGER,
    AgentRequirement,
    AnnotatedPrompt,
    BehaviorRequirement,
    ConditionRequirement,
    CountRequirement,
    EventRequirement,
    LinkRequirement,
    MissionRequirement,
    OrderRequirement,
    PlacementRequirement,
    Requirement,
    UavRequirement,
    everything,
    fields_of_action,
    flat,
    stated_fields,
)
from aurora_core.spec.vocabulary import Place

# A link may name the roadside unit without an agent of its own.
_ALWAYS = frozenset({'rsu', *(place.value for place in Place)})
# Fields of triggers and actions whose values are names.
_NAMES = frozenset(
    {'a', 'b', 'observer', 'target', 'uav', 'who', 'place', 'by', 'from', 'sender', 'receiver',
     'agent', 'to', 'start', 'end', 'avoid'}
)  # fmt: skip


def check_references(
    prompt: AnnotatedPrompt, landmarks: frozenset[str], streets: frozenset[str] = frozenset()
) -> Iterator[Finding]:
    """Find names that nothing declares, repeated ids, and fields that belong to another kind.

    Args:
        prompt: One prompt.
        landmarks: Names of places on the map.
        streets: Names of streets: a flight along a street has one as its target.
    """
    requirements = flat(prompt.requirements)
    ids = [r.id for r in everything(prompt.requirements)]
    for repeated in sorted({i for i in ids if ids.count(i) > 1}):
        yield _error(prompt, Rule.REQUIREMENT_ID, f'id {repeated!r} is there twice')
    bodies = [r.ref for r in requirements if isinstance(r, AgentRequirement | UavRequirement)]
    top = [r.ref for r in prompt.requirements if isinstance(r, AgentRequirement | UavRequirement)]
    for repeated in sorted({ref for ref in top if top.count(ref) > 1}):
        yield _error(prompt, Rule.REFERENCE, f'{repeated!r} is declared twice')
    uavs = {r.ref for r in requirements if isinstance(r, UavRequirement)}
    known = frozenset(bodies) | _ALWAYS | landmarks
    moments = {r.ref for r in requirements if isinstance(r, MissionRequirement | EventRequirement)}
    events = {r.ref for r in requirements if isinstance(r, EventRequirement)}
    for requirement in requirements:
        for name in _bodies_of(requirement):
            if name not in known and not (_is_along_street(requirement) and name in streets):
                yield _error(
                    prompt,
                    Rule.REFERENCE,
                    f'{requirement.id} names {name!r}, which no requirement declares and which '
                    'is no place',
                )
        if isinstance(requirement, MissionRequirement) and requirement.uav not in uavs:
            yield _error(
                prompt, Rule.REFERENCE, f'{requirement.id}: {requirement.uav!r} is no UAV'
            )
        for name in _moments_of(requirement):
            if name not in moments:
                yield _error(
                    prompt,
                    Rule.REFERENCE,
                    f'{requirement.id}: {name!r} is no event and no mission',
                )
        if isinstance(requirement, EventRequirement):
            yield from _event(prompt, requirement, events)
    yield from _variation(prompt, requirements)


def _event(
    prompt: AnnotatedPrompt, requirement: EventRequirement, events: set[str]
) -> Iterator[Finding]:
    if requirement.trigger is None and requirement.action is None:
        yield _error(prompt, Rule.FORMAT, f'{requirement.id} has neither trigger nor action')
    if requirement.trigger is not None:
        trigger = requirement.trigger
        for name in stated_fields(trigger).keys() - FIELDS_OF_TRIGGER[trigger.on] - {'on'}:
            yield _error(prompt, Rule.FORMAT, f'{requirement.id}: {trigger.on} has no {name!r}')
        if trigger.behavior is not None and not any(
            isinstance(r, BehaviorRequirement)
            and (r.agent, r.behavior) == (trigger.who, trigger.behavior)
            and r.duration_s is not None
            for r in flat(prompt.requirements)
        ):
            what = f'{trigger.who} to {trigger.behavior}'
            yield _error(prompt, Rule.REFERENCE, f'nobody says for how long {what}')
        if trigger.event is not None and trigger.event not in events - {requirement.ref}:
            yield _error(
                prompt, Rule.REFERENCE, f'{requirement.id} waits for unknown {trigger.event!r}'
            )
    if requirement.action is not None:
        action = requirement.action
        for name in stated_fields(action).keys() - fields_of_action(action.do) - {'do'}:
            yield _error(prompt, Rule.FORMAT, f'{requirement.id}: {action.do} has no {name!r}')


def _variation(
    prompt: AnnotatedPrompt, requirements: tuple[Requirement, ...]
) -> Iterator[Finding]:
    by_id = {r.id: r for r in requirements}
    for path, (low, high) in prompt.variation.items():
        value = number_at(by_id, path)
        if value is None:
            yield _error(prompt, Rule.VARIATION, f'{path} is no number of a requirement')
        elif not low <= value <= high:
            yield _error(prompt, Rule.VARIATION, f'{path} = {value} is outside [{low}, {high}]')


def number_at(by_id: dict[str, Requirement], path: str) -> float | None:
    """Return the number at `r4.altitude_m`, `r5.trigger.value_m` or `r6.size_m.0`, or None."""
    name, *fields = path.split('.')
    found: object = by_id.get(name)
    for field in fields:
        if isinstance(found, tuple):
            found = found[int(field)] if field.isdigit() and int(field) < len(found) else None
        else:
            found = getattr(found, field, None)
    is_number = isinstance(found, int | float) and not isinstance(found, bool)
    return float(found) if is_number else None  # type: ignore[arg-type]


def _moments_of(requirement: Requirement) -> tuple[str, ...]:
    if isinstance(requirement, OrderRequirement):
        return requirement.first, requirement.then
    if isinstance(requirement, ConditionRequirement) and requirement.quantity == 'event_time':
        return requirement.of
    return ()


def _bodies_of(requirement: Requirement) -> Iterator[str]:
    if isinstance(requirement, PlacementRequirement):
        yield requirement.agent
        yield from [requirement.of] if requirement.of is not None else []
    if isinstance(requirement, BehaviorRequirement):
        yield requirement.agent
        yield from [requirement.target] if requirement.target is not None else []
    if isinstance(requirement, MissionRequirement):
        fields = stated_fields(requirement)
        for name in ('target', 'start', 'end', 'avoid'):
            yield from _names(fields.get(name))
    if isinstance(requirement, CountRequirement):
        yield from _names(requirement.of)
    if isinstance(requirement, LinkRequirement):
        yield from (requirement.sender, requirement.receiver)
    if isinstance(requirement, ConditionRequirement) and requirement.quantity != 'event_time':
        yield from requirement.of
    if isinstance(requirement, EventRequirement):
        for part in (requirement.trigger, requirement.action):
            if part is not None:
                fields = stated_fields(part)
                for name in sorted(fields.keys() & _NAMES):
                    yield from _names(fields[name])


def _names(value: str | tuple[str, ...] | None) -> tuple[str, ...]:
    """Return one name or several as several."""
    return (value,) if isinstance(value, str) else value or ()


def _is_along_street(requirement: Requirement) -> bool:
    part = requirement.action if isinstance(requirement, EventRequirement) else requirement
    return getattr(part, 'pattern', None) == 'street'


def _error(prompt: AnnotatedPrompt, rule: Rule, text: str) -> Finding:
    return Finding(where=prompt.id, rule=rule, text=text)
