# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Writes a stated order into the events: what comes second waits for what comes first."""

from __future__ import annotations

from collections.abc import Sequence

from aurora_core.parsing import values
from aurora_core.parsing.criteria.moments import Moment, Sequel
from aurora_core.parsing.reactions import REACTIONS, reaction
from aurora_core.parsing.scene import Entity, EventDraft, Scene
from aurora_core.spec.parameter import Bound, Parameter, Span
from aurora_core.spec.scenario import (
    AgentAction,
    AltitudeTrigger,
    Behavior,
    EventDoneTrigger,
    MessageTrigger,
    Order,
    SendMessage,
    TimeTrigger,
    UavAction,
    VisibilityTrigger,
)

_WAITS_FOR: dict[str, tuple[type, ...]] = {
    'receive': (MessageTrigger,),
    'see': (VisibilityTrigger,),
    'reach': (AltitudeTrigger,),
    'ascend': (AltitudeTrigger,),
}
_BEHAVIOR = {'drive': 'start'}


def bodies_of_action(event: EventDraft) -> set[str]:
    """Return who does what an event does."""
    names = ('agent', 'uav', 'sender', 'receiver')
    found = {getattr(event.action, name, None) for name in names}
    return {one for one in found if one is not None}


class Sequels:
    """Finds the events of an order and chains them."""

    def __init__(
        self,
        scene: Scene,
        span: Span,
        who: Sequence[Entity] = (),
        first_who: Sequence[Entity] = (),
    ) -> None:
        self._scene = scene
        self._first_who = tuple(first_who)  # who does what comes first, where it is somebody else
        self._who = {e.id for e in who}
        self._span = span

    def state(self, told: Sequel) -> bool:
        """Return whether the order could be written into the scene."""
        then = self._then(told)
        if then is None:
            return False
        limit = self._limit(told)
        if told.first is not None and told.first.key == 'mission':
            return False
        first = self._first(told.first, then)
        if first is None:
            return False
        if first is not then:
            self.chain(first, then)
        then.delay = limit or then.delay
        self._scene.became(then.id)
        return True

    def _then(self, told: Sequel) -> EventDraft | None:
        if told.then is None:
            return self._last(told.first)
        # `the ego shall brake within 2 s of the warning`: told here for the first time
        known = told.first is not None and self._told(told.first)
        return self.event(told.then, new=known)

    def _told(self, moment: Moment) -> bool:
        does = (b.kind.value for e in self._scene.agents for b in e.behaviors)
        told = any(self._is(e, moment.key) for e in self._scene.events)
        return told or bool(self._first_who) or moment.key in does

    def chain(self, first: EventDraft, then: EventDraft) -> None:
        """Let one event wait for another; what is set otherwise stays, with the order stated."""
        if then.trigger is None and not self._waits(first, then):
            then.trigger = EventDoneTrigger(on='event_done', event=first.id)
        elif not self._waits(then, first) or self._waits(first, then):
            self._order(first.id, then.id, None)
            if self._waits(first, then):  # a circle: both orders are what was asked
                self._order(then.id, first.id, None)

    def _limit(self, told: Sequel) -> Parameter | None:
        if told.within is None:
            return None
        return values.rebound(values.explicit('delay', told.within), Bound.AT_MOST)

    def _order(self, first: str, then: str, within: Parameter | None) -> None:
        made = Order(
            id=self._scene.new_id('o'), first=first, then=then, within_s=within, span=self._span
        )
        self._scene.orders.append(made)
        self._scene.became(made.id)

    def _waits(self, event: EventDraft, cause: EventDraft) -> bool:
        """Return whether an event waits for another, through others or at once."""
        by_id = {e.id: e for e in self._scene.events}
        seen: set[str] = set()
        one: EventDraft | None = event
        while one is not None and one.id not in seen:
            if one is cause:
                return True
            seen.add(one.id)
            trigger = one.trigger
            one = by_id.get(trigger.event) if isinstance(trigger, EventDoneTrigger) else None
        return False

    # --- which events -------------------------------------------------------------------------

    def event(self, moment: Moment, *, new: bool = False) -> EventDraft | None:
        """Return the event that a clause refers to, None when there is none of its kind.

        Args:
            moment: What the clause says of the event.
            new: One that nothing told of yet may be added, if it is clear who acts.
        """
        fitting = [e for e in self._scene.events if self._is(e, moment.key) and self._acts(e)]
        if moment.rank is not None and moment.rank < len(fitting):
            return fitting[moment.rank]
        found = fitting[-1] if fitting else self._of_behavior(moment.key)
        acting = [e for e in self._scene.agents if e.id in self._who]
        if found is None and new and len(acting) == 1 and moment.key in REACTIONS:
            found = self._scene.add_event(reaction(moment.key, acting[0].id, None), self._span)
            self._scene.became(found.id)
        return found

    def _acts(self, event: EventDraft) -> bool:
        """Return whether those whom the clause names, if it names any, are those who act."""
        return not self._who or bool(self._who & bodies_of_action(event))

    @staticmethod
    def _is(event: EventDraft, key: str) -> bool:
        action = event.action
        if key == 'send':
            return isinstance(action, SendMessage)
        if isinstance(action, UavAction):
            return action.do == key
        return isinstance(action, AgentAction) and action.do == key

    def _of_behavior(self, key: str, *, anyone: bool = False) -> EventDraft | None:
        """`the van brakes; the braking must …`: what was told without a cause is an event now."""
        everyone = anyone or not self._who
        agents = [e for e in self._scene.agents if everyone or e.id in self._who]
        for entity in reversed(agents):
            for behavior in entity.behaviors:
                do = _BEHAVIOR.get(behavior.kind.value, behavior.kind.value)
                if do != key or do not in REACTIONS or (anyone and key != behavior.kind.value):
                    continue
                return self._made(entity, behavior, do)
        return None

    def _made(self, entity: Entity, behavior: Behavior, do: str) -> EventDraft:
        action = reaction(do, entity.id, behavior.speed_mps)
        made = self._scene.add_event(action, behavior.span or entity.span)
        self._scene.clause.ids[made.id] = None
        return made

    def _last(self, but: Moment | None) -> EventDraft | None:
        """Return what was told last, as an event or as what somebody does."""
        for clause in reversed(self._scene.clauses[:-1]):
            told = [e for e in self._scene.events if e.id in clause.ids and e.action is not None]
            others = [e for e in told if but is None or not self._is(e, but.key)]
            if others:
                return others[-1]
            for entity in clause.subjects:
                for behavior in entity.behaviors:
                    inside = behavior.span is not None and behavior.span.start >= clause.span.start
                    key = behavior.kind.value
                    if inside and key in REACTIONS and (but is None or key != but.key):
                        return self._made(entity, behavior, key)
        return None

    def _first(self, moment: Moment | None, then: EventDraft) -> EventDraft | None:
        if moment is not None and moment.key not in _WAITS_FOR:
            if self._first_who:  # `… of the fire engine's departure`
                return Sequels(self._scene, self._span, self._first_who).event(moment, new=True)
            # `the car shall stop within 4 s of the braking`: that of somebody else
            others = [e for e in self._scene.events if self._is(e, moment.key)]
            found = self.event(moment) or (others[-1] if others else None)
            found = found or self._of_behavior(moment.key, anyone=True)
            return found if found is not then else None
        trigger = then.trigger
        if isinstance(trigger, EventDoneTrigger):
            return next((e for e in self._scene.events if e.id == trigger.event), None)
        kinds = _WAITS_FOR[moment.key] if moment is not None else (object,)
        if trigger is not None and isinstance(trigger, kinds):
            if isinstance(trigger, TimeTrigger):
                return self._before(then)
            return self._milestone(then)
        waiting = [e for e in self._scene.events if isinstance(e.trigger, kinds) and e is not then]
        if moment is not None:
            return waiting[-1] if waiting else None
        return self._before(then)

    def _before(self, then: EventDraft) -> EventDraft | None:
        events = self._scene.events
        place = events.index(then)
        if place:
            return events[place - 1]
        keys = [k for k in REACTIONS if k not in ('start', 'cross') and not self._is(then, k)]
        return next((e for k in keys if (e := self._of_behavior(k)) is not None), None)

    def _milestone(self, then: EventDraft) -> EventDraft:
        """What `then` waits for, as a moment of its own."""
        made = EventDraft(id=self._scene.new_id('e'), trigger=then.trigger, span=then.span)
        self._scene.events.insert(self._scene.events.index(then), made)
        self._scene.clause.ids[made.id] = None
        then.trigger = EventDoneTrigger(on='event_done', event=made.id)
        return made
