# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Events: when `trigger` then `action`."""

from __future__ import annotations

from typing import Annotated, Literal, Self, get_args

from pydantic import Field, StringConstraints, model_validator

from aurora_core.document import omitted
from aurora_core.spec.parameter import Bound, Element, Parameter, Span
from aurora_core.spec.reference import Id, PlaceRef, is_place
from aurora_core.spec.vocabulary import MOVING, STANDING, BehaviorKind, LaneSide


class DistanceTrigger(Element):
    """3-D distance of two agents crosses a threshold."""

    on: Literal['distance_below', 'distance_above']
    a: Id
    b: Id | PlaceRef
    value_m: Parameter


class HeadwayTrigger(Element):
    """Headway, or time to collision, of `a` behind `b` in its lane falls below a threshold."""

    on: Literal['headway_below', 'ttc_below']
    a: Id
    b: Id
    value_s: Parameter


class TimeTrigger(Element):
    """Scenario time reached."""

    on: Literal['time']
    at_s: Parameter


class AltitudeTrigger(Element):
    """A UAV reaches an altitude."""

    on: Literal['altitude_reached']
    uav: Id
    value_m: Parameter


class VisibilityTrigger(Element):
    """A body sees (or loses sight of) a target."""

    on: Literal['visible', 'occluded']
    observer: Id
    target: Id | PlaceRef


class ArrivalTrigger(Element):
    """An agent arrives at a place."""

    on: Literal['arrives']
    who: Id
    place: PlaceRef


class MessageTrigger(Element):
    """A message is received."""

    on: Literal['message_received']
    by: Id
    sender: Id | None = None


class SpeedTrigger(Element):
    """Speed crosses a threshold."""

    on: Literal['speed_below', 'speed_above']
    who: Id
    value_mps: Parameter


class EventDoneTrigger(Element):
    """Another event is done, or its action has set in (`event_begun`), plus a delay."""

    on: Literal['event_done', 'event_begun']
    event: Id
    after_s: Parameter | None = None


# What a ground agent can be made to do.
AgentDo = Literal['brake', 'stop', 'slow', 'accelerate', 'change_lane', 'yield', 'start', 'cross']


class BehaviorDoneTrigger(Element):
    """The stated time of what an agent does is over: it has stood, or moved, for as long."""

    on: Literal['behavior_done']
    who: Id
    behavior: BehaviorKind

    @model_validator(mode='after')
    def _lasts(self) -> Self:
        if self.behavior not in STANDING | MOVING:
            event = 'make it an event without a trigger, and wait for that one (event_done)'
            told = event if self.behavior in get_args(AgentDo) else 'nobody sees its end'
            raise ValueError(f'{self.behavior} lasts for no stated time: {told}')
        return self


class MissionDoneTrigger(Element):
    """A UAV has finished its missions."""

    on: Literal['mission_done']
    uav: Id


class BatteryTrigger(Element):
    """The battery of a UAV falls below a share of its charge (0..1)."""

    on: Literal['battery_below']
    uav: Id
    value: Parameter


Trigger = Annotated[
    DistanceTrigger
    | HeadwayTrigger
    | TimeTrigger
    | AltitudeTrigger
    | VisibilityTrigger
    | ArrivalTrigger
    | MessageTrigger
    | SpeedTrigger
    | EventDoneTrigger
    | BehaviorDoneTrigger
    | MissionDoneTrigger
    | BatteryTrigger,
    Field(discriminator='on'),
]


class SendMessage(Element):
    """Send a message over the link between the two; what it says is recorded with it."""

    do: Literal['send_message']
    sender: Id
    receiver: Id
    text: Annotated[str, StringConstraints(min_length=1, max_length=200)] | None = omitted(None)


# What takes speed off, and may be told how hard.
BRAKING = frozenset({'brake', 'stop', 'slow'})

# What only who is on the move can do, whether or not it has to brake for it.
SLOWS = BRAKING | {'yield'}


class AgentAction(Element):
    """A ground agent changes what it does.

    Attributes:
        value_mps: Speed that it ends with.
        deceleration_mps2: How hard it brakes for that (mean fully developed deceleration).
        side: Of the lane that it changes to.
    """

    do: AgentDo
    agent: Id
    value_mps: Parameter | None = None
    deceleration_mps2: Parameter | None = omitted(None)
    side: LaneSide | None = omitted(None)

    @model_validator(mode='after')
    def _has_its_fields(self) -> Self:
        if self.side is not None and self.do != 'change_lane':
            raise ValueError(f'a side belongs to change_lane alone, found it with {self.do}')
        if self.deceleration_mps2 is not None and self.do not in BRAKING:
            raise ValueError(f'a deceleration belongs to braking, found it with {self.do}')
        return self


class UavAction(Element):
    """A UAV changes what it does; `return_home` lands it where it started.

    Attributes:
        altitude_m: Where it climbs or descends to (`ascend`).
        vertical_mps: How fast it does that, up or down; above zero.
    """

    do: Literal['land', 'return_home', 'ascend', 'change_mission']
    uav: Id
    altitude_m: Parameter | None = None
    vertical_mps: Parameter | None = omitted(None)
    mission: Id | None = None

    @model_validator(mode='after')
    def _has_its_fields(self) -> Self:
        if (self.do == 'change_mission') is (self.mission is None):
            raise ValueError(f'a mission belongs to change_mission alone, found it with {self.do}')
        if self.do == 'ascend' and self.altitude_m is None:
            raise ValueError('ascend needs altitude_m')
        if self.do != 'ascend' and self.vertical_mps is not None:
            raise ValueError(f'a vertical speed belongs to ascend, found it with {self.do}')
        return self

    @property
    def lands(self) -> bool:
        """Tell whether the UAV comes down for good, here or where it started."""
        return self.do in ('land', 'return_home')


EventAction = Annotated[SendMessage | AgentAction | UavAction, Field(discriminator='do')]


class Event(Element):
    """When `trigger` then `action`, within 1 s plus `delay_s`.

    A delay that is only an upper bound (`within 6 s`) is a deadline: nothing waits for it, and
    what `comes_to_an_end` has to be done by then, the rest to begin.
    Without an action it is a milestone; without a trigger its cause is left open. Events that
    wait for each other (`event_done`) are a chain.
    """

    id: Id
    trigger: Trigger | None = None
    action: EventAction | None = None
    delay_s: Parameter | None = None
    span: Span | None = None

    @property
    def deadline_s(self) -> float | None:
        """Seconds after the trigger by which the action is asked for, None where not stated."""
        late = self.delay_s is not None and self.delay_s.bound is Bound.AT_MOST
        return self.delay_s.value if self.delay_s is not None and late else None

    @property
    def waits_s(self) -> float:
        """Seconds from the trigger to the action."""
        if self.delay_s is None or self.delay_s.bound is Bound.AT_MOST:
            return 0.0
        return self.delay_s.value


# Actions that end with a state of their own, and those that do where a number says with which.
_END = frozenset({'stop', 'change_lane', 'land', 'return_home', 'ascend'})
_END_WITH_A_NUMBER = frozenset({'slow', 'accelerate'})


def comes_to_an_end(action: EventAction | None) -> bool:
    """Tell whether `within 6 s` says when an action is over, not when it sets in."""
    if action is None or action.do in _END:
        return action is not None
    stated = isinstance(action, AgentAction) and action.value_mps is not None
    return stated and action.do in _END_WITH_A_NUMBER


def shows_its_beginning(action: EventAction | None) -> bool:
    """Tell whether the record shows when an action sets in, so that others can wait for that.

    That a lane is changed is known once the vehicle is on the other one.
    """
    if isinstance(action, AgentAction):
        return action.do != 'change_lane'
    return isinstance(action, UavAction) and action.do != 'change_mission'


# After these an agent that is to start again has stood still before.
_STOPS = frozenset({'stop', 'yield', 'brake'})


def sets_off(events: tuple[Event, ...], agent: str) -> Event | None:
    """Return the event that lets an agent set off for the first time, None when none does.

    One that is to start again after it has stopped has set off by itself.
    """
    mine = [e for e in events if isinstance(e.action, AgentAction) and e.action.agent == agent]
    kinds = [e.action.do for e in mine if isinstance(e.action, AgentAction)]
    if 'start' not in kinds or _STOPS & set(kinds[: kinds.index('start')]):
        return None
    first = mine[kinds.index('start')]
    cause = first.trigger.event if isinstance(first.trigger, EventDoneTrigger) else None
    after_stop = any(e.id == cause and k in _STOPS for e, k in zip(mine, kinds, strict=True))
    return None if after_stop else first


def least_due_s(events: tuple[Event, ...], event_id: str) -> float:
    """Return the first scenario time (s) at which an event can act by the times stated.

    0 where its chain begins with what has no stated time.
    """
    by_id = {event.id: event for event in events}
    due_s, seen = 0.0, set[str]()
    event = by_id.get(event_id)
    while event is not None and event.id not in seen:
        seen.add(event.id)
        due_s += event.waits_s
        trigger, event = event.trigger, None
        if isinstance(trigger, TimeTrigger):
            due_s += trigger.at_s.value
        elif isinstance(trigger, EventDoneTrigger):
            due_s += 0.0 if trigger.after_s is None else trigger.after_s.value
            event = by_id.get(trigger.event)
    return due_s


def bodies_of(event: Event) -> frozenset[str]:
    """Return every agent and UAV that an event's trigger and action refer to by id."""
    names = ('a', 'b', 'uav', 'observer', 'target', 'who', 'by', 'sender', 'receiver', 'agent')
    found = {getattr(part, name, None) for part in (event.trigger, event.action) for name in names}
    return frozenset(n for n in found if n is not None and not is_place(n))


def bodies_of_cause(event: Event) -> frozenset[str]:
    """Return every agent and UAV that an event's trigger refers to by id."""
    return bodies_of(event.model_copy(update={'action': None}))


def reports_own_altitude(event: Event) -> bool:
    """Tell whether a UAV sends a message when it has reached an altitude, on its way up, too."""
    action, trigger = event.action, event.trigger
    return (
        isinstance(action, SendMessage)
        and isinstance(trigger, AltitudeTrigger)
        and trigger.uav == action.sender
    )


def actor_of(event: Event) -> str | None:
    """Return the body whose behaviour triggers an event, None when there is no such body.

    Of a distance it is the one that is not told about it.
    """
    trigger = event.trigger
    match trigger:
        case DistanceTrigger():
            told = event.action.receiver if isinstance(event.action, SendMessage) else None
            return trigger.b if trigger.a == told else trigger.a
        case SpeedTrigger() | ArrivalTrigger() | BehaviorDoneTrigger():
            return trigger.who
        case HeadwayTrigger():
            return trigger.a
        case VisibilityTrigger():
            return trigger.target if trigger.on == 'visible' else None
        case _:
            return None
