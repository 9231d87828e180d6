# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""One form for events that are told in several: what sets them off in the end, and how much later.

"15 s after the bus has arrived, land" may be one event (arrival, `delay_s` 15) or two (a
milestone at the arrival, then `event_done` with `after_s` 15). Both become (arrival, 15 s, land)
here. Only milestones are seen through: what follows an action waits until the action is complete.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

from aurora_bench.fidelity.events import action_fields, trigger_fields
from aurora_bench.fidelity.fields import Subject
from aurora_bench.fidelity.numbers import NumberRule
from aurora_bench.prompts.format import EventRequirement, Requirement, Trigger
from aurora_core.spec.parameter import Bound, Parameter
from aurora_core.spec.scenario import (
    AltitudeTrigger,
    Event,
    EventDoneTrigger,
    ScenarioSpec,
    TimeTrigger,
    UavAction,
)
from aurora_core.spec.scenario import Trigger as SpecTrigger

# Sums of seconds round.
_SAME_S = 1e-6


@dataclass(frozen=True, kw_only=True)
class _Seconds:
    """An annotated number of seconds, with the requirement that gives its tolerance."""

    requirement: Requirement
    path: str
    value: float


@dataclass(frozen=True, kw_only=True)
class _Asked:
    """What an annotated event waits for in the end.

    Attributes:
        trigger: Without its seconds.
        of: The requirement that states it.
        seconds: All that is to pass after it; after t = 0 for a time.
    """

    trigger: Trigger
    of: EventRequirement
    seconds: tuple[_Seconds, ...]


@dataclass(frozen=True, kw_only=True)
class _Said:
    """What an event of a specification waits for in the end, and the seconds after it.

    Attributes:
        trigger: None stands for t = 0.
        seconds: That pass from it to the event.
    """

    trigger: SpecTrigger | None
    seconds: float


def is_same_event(
    r: EventRequirement,
    event: Event,
    subject: Subject,
    rule: NumberRule,
    *,
    asked: Sequence[Requirement],
    ascents: bool,
) -> bool:
    """Whether an event has the annotated action, set off by the same, after the same time.

    Args:
        r: With a trigger and an action; another never is.
        event: Of the specification.
        subject: Specification and binding.
        rule: Of the requirement.
        asked: All requirements: which of them are milestones.
        ascents: The end of an ascent to an altitude counts as reaching it.
    """
    if r.trigger is None or r.action is None or event.action is None:
        return False
    if event.action.do != r.action.do:
        return False
    if not all(action_fields(r.action, event.action, subject, rule).values()):
        return False
    said = list(_said(event, subject.spec, ascents=ascents))
    return any(
        _is_same(one, two, subject, rule) for one in _asked(r, r.trigger, asked) for two in said
    )


def is_same_moment(
    r: EventRequirement,
    event: Event,
    subject: Subject,
    rule: NumberRule,
    *,
    asked: Sequence[Requirement],
) -> bool:
    """Whether an annotated milestone is the moment at which an event of any action is set off."""
    if r.trigger is None or r.action is not None:
        return False
    if event.action is not None:  # set off at once, done later
        event = event.model_copy(update={'delay_s': None})
    said = list(_said(event, subject.spec, ascents=False))
    return any(
        _is_same(one, two, subject, rule) for one in _asked(r, r.trigger, asked) for two in said
    )


def is_same_ascent(r: EventRequirement, event: Event, subject: Subject, rule: NumberRule) -> bool:
    """Whether an annotated milestone is an altitude that an event makes a UAV ascend to."""
    if r.trigger is None or r.action is not None or r.trigger.on != 'altitude_reached':
        return False
    reached = _reached(event)
    return reached is not None and all(trigger_fields(r.trigger, reached, subject, rule).values())


def seconds_from_start(event: Event, spec: ScenarioSpec) -> float | None:
    """Return when an event happens, in seconds from t = 0; None when no time sets it off."""
    said = [s for s in _said(event, spec, ascents=False) if s.trigger is None]
    return said[0].seconds if said else None


def _is_same(one: _Asked, two: _Said, subject: Subject, rule: NumberRule) -> bool:
    of_one = replace(rule, requirement=one.of)
    if two.trigger is None:
        is_trigger = one.trigger.on == 'time'
    elif one.trigger.on in ('event_done', 'event_begun'):
        is_trigger = (
            isinstance(two.trigger, EventDoneTrigger)
            and two.trigger.on == one.trigger.on
            and one.trigger.event is not None
            and two.trigger.event in subject.binding.moments_of(one.trigger.event)
        )
    else:
        is_trigger = one.trigger.on == two.trigger.on and all(
            trigger_fields(one.trigger, two.trigger, subject, of_one).values()
        )
    if not is_trigger:
        return False
    if not one.seconds:
        return abs(two.seconds) <= _SAME_S
    # The last number is compared under its own tolerance, the others being taken as they are.
    *others, last = one.seconds
    rest = two.seconds - sum(o.value for o in others)
    return replace(rule, requirement=last.requirement).counts(last.path, last.value, rest)


def _asked(
    r: EventRequirement,
    trigger: Trigger,
    asked: Sequence[Requirement],
    seen: frozenset[str] = frozenset(),
) -> Iterator[_Asked]:
    own: tuple[_Seconds, ...] = ()
    for name in ('at_s', 'after_s'):
        value = getattr(trigger, name)
        if value is not None:
            own = (*own, _Seconds(requirement=r, path=f'trigger.{name}', value=value))
    if trigger.on != 'time' or own:
        bare = trigger.model_copy(update={'at_s': None, 'after_s': None})
        yield _Asked(trigger=bare, of=r, seconds=own)
    if trigger.on != 'event_done' or trigger.event is None or trigger.event in seen:
        return
    for other in asked:
        if not isinstance(other, EventRequirement) or other.ref != trigger.event:
            continue
        if other.trigger is None or other.action is not None or other.negate:
            continue
        for before in _asked(other, other.trigger, asked, seen | {trigger.event}):
            yield replace(before, seconds=(*before.seconds, *own))


def _said(
    event: Event, spec: ScenarioSpec, *, ascents: bool, seen: frozenset[str] = frozenset()
) -> Iterator[_Said]:
    delay_s = _waits(event.delay_s)
    if delay_s is None:
        return
    trigger = event.trigger
    if trigger is None:
        for condition in spec.conditions:
            is_its_time = condition.quantity == 'event_time' and condition.of == (event.id,)
            if is_its_time and condition.op == '==':
                yield _Said(trigger=None, seconds=condition.value.value)
        return
    if isinstance(trigger, TimeTrigger):
        if trigger.at_s.bound is Bound.EXACTLY:
            yield _Said(trigger=None, seconds=trigger.at_s.value + delay_s)
        return
    if not isinstance(trigger, EventDoneTrigger) or trigger.on != 'event_done':
        yield _Said(trigger=trigger, seconds=delay_s)
        if ascents and isinstance(trigger, AltitudeTrigger):
            for other in spec.events:
                reached = _reached(other)
                if reached is not None and _altitude(reached) == _altitude(trigger):
                    done = EventDoneTrigger(on='event_done', event=other.id)
                    yield _Said(trigger=done, seconds=delay_s)
        return
    after_s = _waits(trigger.after_s)
    if after_s is None:
        return
    yield _Said(trigger=trigger, seconds=after_s + delay_s)
    first = next((e for e in spec.events if e.id == trigger.event), None)
    if first is None or first.id in seen:
        return
    reached = _reached(first) if ascents else None
    if reached is not None:
        yield _Said(trigger=reached, seconds=after_s + delay_s)
    if first.action is None and first.trigger is not None:
        for before in _said(first, spec, ascents=ascents, seen=seen | {event.id}):
            yield replace(before, seconds=before.seconds + after_s + delay_s)


def _reached(event: Event) -> AltitudeTrigger | None:
    """Return the altitude at which an ascent ends."""
    action = event.action
    if not isinstance(action, UavAction) or action.do != 'ascend' or action.altitude_m is None:
        return None
    return AltitudeTrigger(on='altitude_reached', uav=action.uav, value_m=action.altitude_m)


def _altitude(trigger: AltitudeTrigger) -> tuple[str, float]:
    return trigger.uav, trigger.value_m.value


def _waits(seconds: Parameter | None) -> float | None:
    """Return the wait of a delay: none for a deadline; None for "at least", which fixes none."""
    if seconds is None or seconds.bound is Bound.AT_MOST:
        return 0.0
    return seconds.value if seconds.bound is Bound.EXACTLY else None
