# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Refuse stated times that exclude each other: every bound is the earliest that is possible."""

from __future__ import annotations

from collections.abc import Iterator

from aurora_core.feasibility.certificates import beyond, contradiction, is_stated, least
from aurora_core.feasibility.verdict import Certificate
from aurora_core.knowledge.limits import Limits, Tolerances
from aurora_core.spec.quantity import QuantityName
from aurora_core.spec.scenario import (
    AltitudeTrigger,
    Event,
    EventDoneTrigger,
    MessageTrigger,
    ScenarioSpec,
    SendMessage,
    TimeTrigger,
    UavMission,
)


class Earliest:
    """The earliest times at which events and flights of a request can happen, in seconds."""

    def __init__(self, spec: ScenarioSpec, limits: Limits, tolerances: Tolerances) -> None:
        self._spec = spec
        self._limits = limits
        self._tolerances = tolerances
        self._events = {e.id: e for e in spec.events}

    def event(self, event_id: str, seen: frozenset[str] = frozenset()) -> float:
        """Return the earliest time of an event; a circle of causes ends the search."""
        event = self._events.get(event_id)
        if event is None or event_id in seen:
            return 0.0
        delay = 0.0 if event.delay_s is None else least(event.delay_s, self._slack(0.0), 0.0)
        return self._trigger(event, seen | {event_id}) + delay

    def _slack(self, seconds: float) -> float:
        return self._tolerances.duration_s.of(seconds)

    def _trigger(self, event: Event, seen: frozenset[str]) -> float:
        trigger = event.trigger
        if isinstance(trigger, TimeTrigger):
            return least(trigger.at_s, self._slack(trigger.at_s.value), 0.0)
        if isinstance(trigger, EventDoneTrigger):
            after = 0.0 if trigger.after_s is None else least(trigger.after_s, 0.5, 0.0)
            return self.event(trigger.event, seen) + after
        if isinstance(trigger, MessageTrigger):
            sent = [
                self.event(e.id, seen)
                for e in self._spec.events
                if isinstance(e.action, SendMessage) and e.action.receiver == trigger.by
            ]
            return min(sent, default=0.0)
        if isinstance(trigger, AltitudeTrigger):
            return self.ascent(least(trigger.value_m, 0.0, 0.0))
        return 0.0

    def ascent(self, altitude_m: float) -> float:
        """Return the shortest time from the ground to an altitude."""
        return altitude_m / self._limits.uav_climb_max_mps

    def flight(self, uav: str) -> float:
        """Return the shortest time from t = 0 to touchdown after all phases of a UAV."""
        flown = [m for m in self._spec.missions if m.uav == uav]
        if not flown:
            return 0.0
        first, last = self._lowest(flown[0]), self._lowest(flown[-1])
        phases = sum(self.phase(m) for m in flown)
        return self.ascent(first) + phases + last / self._limits.uav_descent_max_mps

    def phase(self, mission: UavMission) -> float:
        """Return the shortest stated duration of a phase; unstated: none."""
        stated = mission.duration_s
        return 0.0 if stated is None else least(stated, self._slack(stated.value), 0.0)

    def _lowest(self, mission: UavMission) -> float:
        stated = mission.altitude_m
        return least(stated, self._tolerances.altitude_m.of(stated.value), 0.0)


def check_times(
    spec: ScenarioSpec, limits: Limits, tolerances: Tolerances
) -> Iterator[Certificate]:
    """Return what the battery, deadlines, the horizon and stated orders rule out."""
    earliest = Earliest(spec, limits, tolerances)
    yield from _battery(spec, limits)
    yield from _deadlines(spec, earliest)
    yield from _horizon(spec, earliest)
    yield from _orders(spec, earliest)


def _battery(spec: ScenarioSpec, limits: Limits) -> Iterator[Certificate]:
    """The phases of one UAV together; a single one is checked against the limit alone."""
    for uav in spec.uavs:
        flown = [m.duration_s for m in spec.missions if m.uav == uav.id]
        stated = [d for d in flown if d is not None and is_stated(d)]
        total = sum(least(d, 0.0, 0.0) for d in stated)
        if len(stated) > 1 and total > limits.uav_endurance_s:
            yield beyond(
                'endurance',
                stated[-1],
                f'uavs/{uav.id}',
                ('uav_endurance_s', limits.uav_endurance_s),
                f'the phases of {uav.id} last {total:g} s together; '
                f'at most {limits.uav_endurance_s:g} s are possible (uav_endurance_s).',
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
                'temporal_contradiction',
                f'conditions/{condition.id}',
                f'{name} of {", ".join(condition.of)} is due at {deadline.value:g} s; '
                f'it is possible after {needed:.1f} s at the earliest.',
                condition.span,
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
                'temporal_contradiction',
                path,
                f'{path} needs {needed:.1f} s; the scenario is to last {horizon.value:g} s.',
                span,
            )


def _orders(spec: ScenarioSpec, earliest: Earliest) -> Iterator[Certificate]:
    """What is asked to come later may neither be asked to come first nor be set earlier."""
    follows: dict[str, set[str]] = {}
    for order in spec.orders:
        follows.setdefault(order.first, set()).add(order.then)
    fixed = {e.id: e.trigger.at_s.value for e in spec.events if isinstance(e.trigger, TimeTrigger)}
    for order in spec.orders:
        late = order.then in fixed and earliest.event(order.first) > fixed[order.then]
        if late or _reaches(follows, order.then, order.first):
            yield contradiction(
                'temporal_contradiction',
                f'orders/{order.id}',
                f'{order.first} has to come before {order.then}, and the rest of the request '
                'puts it behind.',
                order.span,
            )


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
