# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Refuse stated times that exclude each other: every bound is the earliest that is possible."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

from aurora_core.feasibility.certificates import beyond, contradiction
from aurora_core.feasibility.facts import limit_facts, says, tolerance_facts
from aurora_core.feasibility.stated import is_stated, least, most
from aurora_core.knowledge.limits import Limits, Tolerances
from aurora_core.outcomes.feasibility import Certificate, Fact, Rule
from aurora_core.spec.parameter import Parameter
from aurora_core.spec.quantity import QuantityName
from aurora_core.spec.scenario import (
    AltitudeTrigger,
    Event,
    EventDoneTrigger,
    MessageTrigger,
    MissionDoneTrigger,
    ScenarioSpec,
    SendMessage,
    TimeTrigger,
    UavAction,
    UavMission,
)


class Earliest:
    """The earliest times at which events and flights of a request can happen, in seconds."""

    def __init__(self, spec: ScenarioSpec, limits: Limits, tolerances: Tolerances) -> None:
        self._spec = spec
        self._limits = limits
        self._tolerances = tolerances
        self._events = {e.id: e for e in spec.events}
        self._missions = {m.id: m for m in spec.missions}
        self._redirected = {e.action.uav for e in spec.events if isinstance(e.action, UavAction)}

    def event(self, event_id: str, seen: frozenset[str] = frozenset()) -> float:
        """Return the earliest time of an event; a circle of causes ends the search."""
        event = self._events.get(event_id)
        if event is None or event_id in seen:
            return 0.0
        seen |= {event_id}
        caused = self._trigger(event, seen) + self._soonest(event.delay_s)
        return max([caused, *(self._end(first, seen) for first in self._ahead(event_id))])

    def _ahead(self, event_id: str) -> list[str]:
        return [o.first for o in self._spec.orders if o.then == event_id]

    def _end(self, first: str, seen: frozenset[str]) -> float:
        """Return the earliest end of what an order puts first: an event or a phase."""
        mission = self._missions.get(first)
        if mission is None:
            return self.event(first, seen)
        flown = [m for m in self._spec.missions if m.uav == mission.uav]
        return self._flown(flown[: flown.index(mission) + 1])

    def _soonest(self, stated: Parameter | None) -> float:
        if stated is None:
            return 0.0
        slack = self._tolerances.duration_s.of(stated.value, approximate=stated.approximate)
        return least(stated, slack, 0.0)

    def latest(self, stated: Parameter | None) -> float:
        """Return the greatest number of seconds that still meets a request; None: none."""
        if stated is None:
            return 0.0
        slack = self._tolerances.duration_s.of(stated.value, approximate=stated.approximate)
        return most(stated, slack, math.inf)

    def _trigger(self, event: Event, seen: frozenset[str]) -> float:
        trigger = event.trigger
        if isinstance(trigger, TimeTrigger):
            return self._soonest(trigger.at_s)
        if isinstance(trigger, EventDoneTrigger):
            return self.event(trigger.event, seen) + self._soonest(trigger.after_s)
        if isinstance(trigger, MessageTrigger):
            sent = [
                self.event(e.id, seen)
                for e in self._spec.events
                if isinstance(e.action, SendMessage) and e.action.receiver == trigger.by
            ]
            return min(sent, default=0.0)
        if isinstance(trigger, AltitudeTrigger):
            return self.ascent(least(trigger.value_m, 0.0, 0.0))
        if isinstance(trigger, MissionDoneTrigger):
            return self._flown([m for m in self._spec.missions if m.uav == trigger.uav])
        return 0.0

    def _flown(self, phases: Sequence[UavMission]) -> float:
        """Return the shortest time from t = 0 to the end of the last of a UAV's phases.

        An event that gives the UAV something else to do may end a phase at any time.
        """
        if not phases or phases[0].uav in self._redirected:
            return 0.0
        return self.ascent(self._lowest(phases[0])) + sum(self.phase(m) for m in phases)

    def ascent(self, altitude_m: float) -> float:
        """Return the shortest time from the ground to an altitude."""
        return altitude_m / self._limits.uav_climb_max_mps

    def flight(self, uav: str) -> float:
        """Return the shortest time from t = 0 to touchdown after all phases of a UAV."""
        flown = [m for m in self._spec.missions if m.uav == uav]
        if not flown:
            return 0.0
        return self._flown(flown) + self._lowest(flown[-1]) / self._limits.uav_descent_max_mps

    def phase(self, mission: UavMission) -> float:
        """Return the shortest stated duration of a phase; unstated: none."""
        return self._soonest(mission.duration_s)

    def facts(self) -> tuple[Fact, ...]:
        """Return the stated times and the rates that these times follow from."""
        found: list[Fact] = []
        for e in self._spec.events:
            base = f'events/{e.id}'
            found += says(f'{base}/delay_s', e.delay_s)
            if isinstance(e.trigger, TimeTrigger):
                found += says(f'{base}/trigger/at_s', e.trigger.at_s)
            if isinstance(e.trigger, EventDoneTrigger):
                found += says(f'{base}/trigger/after_s', e.trigger.after_s)
            if isinstance(e.trigger, AltitudeTrigger):
                found += says(f'{base}/trigger/value_m', e.trigger.value_m)
            if isinstance(e.trigger, MissionDoneTrigger):
                found += says(f'{base}/trigger/uav', e.trigger.uav)
        for o in self._spec.orders:
            found += says(f'orders/{o.id}/first', o.first)
            found += says(f'orders/{o.id}/then', o.then)
        for m in self._spec.missions:
            found += says(f'missions/{m.id}/altitude_m', m.altitude_m)
            found += says(f'missions/{m.id}/duration_s', m.duration_s)
        rates = limit_facts(self._limits, 'uav_climb_max_mps', 'uav_descent_max_mps')
        return (*found, *rates, *tolerance_facts(self._tolerances, 'duration_s', 'altitude_m'))

    def _lowest(self, mission: UavMission) -> float:
        stated = mission.altitude_m
        slack = self._tolerances.altitude_m.of(stated.value, approximate=stated.approximate)
        return least(stated, slack, 0.0)


def check_times(
    spec: ScenarioSpec, limits: Limits, tolerances: Tolerances
) -> Iterator[Certificate]:
    """Return what the battery, deadlines, the horizon and stated orders rule out."""
    earliest = Earliest(spec, limits, tolerances)
    yield from _battery(spec, limits)
    yield from _deadlines(spec, earliest)
    yield from _horizon(spec, earliest)
    yield from _orders(spec, earliest)
    yield from _circles(spec)


def _battery(spec: ScenarioSpec, limits: Limits) -> Iterator[Certificate]:
    """The phases of one UAV together; a single one is checked against the limit alone."""
    for uav in spec.uavs:
        flown = [m for m in spec.missions if m.uav == uav.id]
        stated = [m.duration_s for m in flown if m.duration_s and is_stated(m.duration_s)]
        total = sum(least(d, 0.0, 0.0) for d in stated)
        if len(stated) > 1 and total > limits.uav_endurance_s:
            yield beyond(
                Rule.BATTERY,
                'endurance',
                stated[-1],
                f'uavs/{uav.id}',
                ('uav_endurance_s', limits.uav_endurance_s),
                f'the phases of {uav.id} last {total:g} s together; '
                f'at most {limits.uav_endurance_s:g} s are possible (uav_endurance_s).',
                (
                    *(f for m in flown for f in says(f'missions/{m.id}/duration_s', m.duration_s)),
                    *limit_facts(limits, 'uav_endurance_s'),
                ),
            )


def _deadlines(spec: ScenarioSpec, earliest: Earliest) -> Iterator[Certificate]:
    for condition in spec.conditions:
        name = condition.quantity
        of = condition.of[0]
        deadline, needed = condition.by_s, 0.0
        if name == QuantityName.EVENT_TIME and condition.op in ('<', '<='):
            deadline, needed = condition.value, earliest.event(of)
        elif name == QuantityName.ALTITUDE and condition.op in ('>', '>='):
            needed = earliest.ascent(condition.value.value)
        elif name in (QuantityName.LANDED, QuantityName.MISSION_COMPLETED):
            needed = earliest.flight(of) if condition.value.value > 0.0 else 0.0
        elif name in (QuantityName.DELIVERED, QuantityName.DELIVERY_LATENCY):
            needed = _first_sent(spec, earliest, condition.of)
        if deadline is not None and is_stated(deadline) and needed > deadline.value:
            yield contradiction(
                Rule.DEADLINE,
                'temporal_contradiction',
                f'conditions/{condition.id}',
                f'{name} of {", ".join(condition.of)} is due at {deadline.value:g} s; '
                f'it is possible after {needed:.1f} s at the earliest.',
                condition.span,
                (
                    *says(f'conditions/{condition.id}/value', condition.value),
                    *says(f'conditions/{condition.id}/by_s', condition.by_s),
                    *earliest.facts(),
                ),
            )


def _first_sent(spec: ScenarioSpec, earliest: Earliest, of: tuple[str, ...]) -> float:
    sent = [
        earliest.event(e.id)
        for e in spec.events
        if isinstance(e.action, SendMessage) and (e.action.sender, e.action.receiver) == of
    ]
    return min(sent, default=0.0)


def _horizon(spec: ScenarioSpec, earliest: Earliest) -> Iterator[Certificate]:
    """What is stated to happen has to fit into a stated duration of the scenario."""
    horizon = spec.world.duration_s
    if horizon is None or not is_stated(horizon):
        return
    due = [(f'events/{e.id}', earliest.event(e.id), e.span) for e in spec.events]
    for uav in spec.uavs:
        flown = [m for m in spec.missions if m.uav == uav.id]
        total = sum(earliest.phase(m) for m in flown)
        if flown:
            due.append((f'uavs/{uav.id}', total, flown[-1].span))
    for path, needed, span in due:
        if needed > horizon.value:
            yield contradiction(
                Rule.HORIZON,
                'temporal_contradiction',
                path,
                f'{path} needs {needed:.1f} s; the scenario is to last {horizon.value:g} s.',
                span,
                (*says('world/duration_s', horizon), *earliest.facts()),
            )


def _orders(spec: ScenarioSpec, earliest: Earliest) -> Iterator[Certificate]:
    """What is asked to come later may neither be asked to come first nor be set earlier."""
    follows: dict[str, set[str]] = {}
    for order in spec.orders:
        follows.setdefault(order.first, set()).add(order.then)
    fixed = {
        e.id: earliest.latest(e.trigger.at_s) + earliest.latest(e.delay_s)
        for e in spec.events
        if isinstance(e.trigger, TimeTrigger)
    }
    for order in spec.orders:
        late = order.then in fixed and earliest.event(order.first) > fixed[order.then]
        if late or _reaches(follows, order.then, order.first):
            yield contradiction(
                Rule.ORDER,
                'temporal_contradiction',
                f'orders/{order.id}',
                f'{order.first} has to come before {order.then}, and the rest of the request '
                'puts it behind.',
                order.span,
                (
                    *says(f'orders/{order.id}/first', order.first),
                    *says(f'orders/{order.id}/then', order.then),
                    *earliest.facts(),
                ),
            )


def _circles(spec: ScenarioSpec) -> Iterator[Certificate]:
    """Events that wait for each other: none of them can be the first."""
    causes = {
        e.id: e.trigger.event for e in spec.events if isinstance(e.trigger, EventDoneTrigger)
    }
    follows = {cause: {e for e, c in causes.items() if c == cause} for cause in causes.values()}
    for event in spec.events:
        if event.id in causes and _reaches(follows, event.id, causes[event.id]):
            yield contradiction(
                Rule.ORDER,
                'temporal_contradiction',
                f'events/{event.id}',
                f'{event.id} waits for {causes[event.id]}, which itself waits for {event.id}.',
                event.span,
                tuple(
                    fact
                    for e, cause in causes.items()
                    for fact in says(f'events/{e}/trigger/event', cause)
                ),
            )
            return


def _reaches(follows: dict[str, set[str]], start: str, goal: str) -> bool:
    waiting, seen = [start], set[str]()
    while waiting:
        one = waiting.pop()
        if one == goal:
            return True
        if one not in seen:
            seen.add(one)
            waiting += sorted(follows.get(one, ()))
    return False
