# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Which requirements of a prompt are not scored. It depends on the annotation alone.

Else an answer could choose what it is measured by.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import TypeGuard

from aurora_bench.prompts.format import (
    AnnotatedPrompt,
    AnyOfRequirement,
    ConditionRequirement,
    EventRequirement,
    MissionRequirement,
    OrderRequirement,
    Requirement,
    flat,
    stated_fields,
)

# Something asked that no field of the format holds; the format calls the kind so.
_BEYOND = 'beyond'


def beyond(prompt: AnnotatedPrompt) -> frozenset[str]:
    """Return the ids of requirements that no field holds: they are counted, never scored."""
    return frozenset(r.id for r in prompt.requirements if _is_beyond(r))


def final_landings(prompt: AnnotatedPrompt) -> frozenset[str]:
    """Return the ids of what asks for no more than the landing that ends every mission.

    That is a landing without a cause or after the UAV's missions, the order of the two, and
    `landed` without a deadline. A landing stays when it has a time or an altitude, another cause,
    when an order places it among other events, or when it must not be.
    """
    requirements = flat(prompt.requirements)
    landings = {r.ref: r for r in requirements if _is_plain_landing(r)}
    missions = dict(_missions(requirements))
    for r in requirements:
        for name in _placed(r):
            lands = landings.get(name)
            if lands is not None and not _is_after_own_mission(r, lands, missions):
                del landings[name]

    def says_no_more(r: Requirement) -> bool:
        if isinstance(r, AnyOfRequirement):
            return not r.negate and all(says_no_more(reading) for reading in r.any_of)
        if isinstance(r, EventRequirement):
            return landings.get(r.ref) == r
        if isinstance(r, OrderRequirement):
            return r.then in landings
        return _is_plain_landed(r)

    return frozenset(r.id for r in prompt.requirements if says_no_more(r))


def _is_beyond(r: Requirement) -> bool:
    if isinstance(r, AnyOfRequirement):
        return all(_is_beyond(reading) for reading in r.any_of)
    return str(r.kind) == _BEYOND


def _is_plain_landing(r: Requirement) -> TypeGuard[EventRequirement]:
    if not isinstance(r, EventRequirement) or r.negate or r.action is None:
        return False
    if r.action.do != 'land' or not stated_fields(r.action).keys() <= {'do', 'uav'}:
        return False
    trigger = r.trigger
    return trigger is None or (
        trigger.on == 'mission_done' and trigger.uav in (None, r.action.uav)
    )


def _is_plain_landed(r: Requirement) -> bool:
    return (
        isinstance(r, ConditionRequirement)
        and not r.negate
        and (r.quantity, r.op, r.value) == ('landed', '==', True)
        and (r.hold_s, r.by_s, r.fraction) == (None, None, None)
    )


def _placed(r: Requirement) -> Iterator[str]:
    """Return the events that a requirement gives a time or a place among others."""
    if isinstance(r, OrderRequirement):
        yield from (r.first, r.then)
    elif isinstance(r, ConditionRequirement) and r.quantity == 'event_time':
        yield from r.of
    elif isinstance(r, EventRequirement) and r.trigger is not None and r.trigger.event is not None:
        yield r.trigger.event


def _missions(requirements: tuple[Requirement, ...]) -> Iterator[tuple[str, str | None]]:
    """Return all that begins a mission, with its UAV."""
    for r in requirements:
        if isinstance(r, MissionRequirement):
            yield r.ref, r.uav
        elif isinstance(r, EventRequirement) and getattr(r.action, 'do', '') == 'change_mission':
            yield r.ref, getattr(r.action, 'uav', None)


def _is_after_own_mission(
    r: Requirement, lands: EventRequirement, missions: dict[str, str | None]
) -> bool:
    return (
        isinstance(r, OrderRequirement)
        and not r.negate
        and r.within_s is None
        and r.then == lands.ref
        and lands.action is not None
        and lands.action.uav is not None
        and missions.get(r.first) == lands.action.uav
    )
