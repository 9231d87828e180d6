# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Refuse messages over links that the stated geometry leaves out of range all along.

A UAV sends between its ascent and its touchdown. While it lands it gets nearer to the ground, and
anywhere: a proof needs to know that a message is sent before, or how low it can be by then. What a
UAV receives may come while it stands on the ground.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

from aurora_core.feasibility.certificates import beyond
from aurora_core.feasibility.facts import limit_facts, says, tolerance_facts
from aurora_core.feasibility.geometry import TARGET_HEIGHT_M, Geometry
from aurora_core.feasibility.operands import AT_LEAST, whole
from aurora_core.feasibility.zones import is_redirected
from aurora_core.knowledge.limits import Limits, Tolerances
from aurora_core.outcomes.feasibility import Certificate, Fact, Rule
from aurora_core.spec.events import reports_own_altitude
from aurora_core.spec.parameter import Bound
from aurora_core.spec.quantity import QuantityName
from aurora_core.spec.scenario import (
    Event,
    Link,
    ScenarioSpec,
    SendMessage,
    TimeTrigger,
    UavMission,
)
from aurora_core.spec.stated import is_stated, least, most
from aurora_core.spec.vocabulary import MissionMode

# Quantities that say how far two stay from each other.
_BETWEEN = (QuantityName.DISTANCE, QuantityName.HORIZONTAL_DISTANCE, QuantityName.SEPARATION)


def check_radio(
    spec: ScenarioSpec, limits: Limits, tolerances: Tolerances, *, aloft: bool = False
) -> Iterator[Certificate]:
    """Return links over which a message has to pass and cannot.

    Args:
        spec: The request.
        limits: Limits in force.
        tolerances: How far stated numbers may be missed.
        aloft: As if nothing were sent before or after the missions. That may well be, and proves
            nothing.
    """
    for link in spec.links:
        events = [
            e
            for e in spec.events
            if isinstance(e.action, SendMessage)
            and (e.action.sender, e.action.receiver) == (link.sender, link.receiver)
        ]
        if not events or _is_to_be_lost(spec, link):
            continue
        yield from _kept_out_of_range(spec, link, limits)
        # One message that cannot pass is enough.
        far = (_too_far(spec, link, e, Flight(spec, link, e, limits, tolerances, aloft=aloft))
               for e in events)  # fmt: skip
        yield from [proof for proof in far if proof is not None][:1]


def _is_to_be_lost(spec: ScenarioSpec, link: Link) -> bool:
    """Tell whether the request itself asks that a message does not arrive."""
    return any(
        c.quantity == QuantityName.DELIVERED
        and set(c.of) == {link.sender, link.receiver}
        and c.value.value == 0.0
        for c in spec.conditions
    )


@dataclass(frozen=True)
class Flight:
    """The flight of a UAV that sends a message at an event.

    Attributes:
        aloft: As if nothing were sent before or after the missions.
    """

    spec: ScenarioSpec
    link: Link
    event: Event
    limits: Limits
    tolerances: Tolerances
    aloft: bool

    @property
    def missions(self) -> list[UavMission]:
        """What the sender flies, in this order."""
        return [m for m in self.spec.missions if m.uav == self.link.sender]

    def nearest_m(self) -> float:
        """Return how near the two are at least while the message may pass, metres.

        Who hovers or tracks and sends does so from there: not in its ascent, whatever the time.
        """
        if not self.missions or reports_own_altitude(self.event):
            return 0.0
        geometry = Geometry(self.spec, self.limits, self.tolerances)
        flying = {uav.id for uav in self.spec.uavs}
        left_s = 0.0 if self.aloft else self._after_missions_s()
        found = []
        for mission in self.missions:
            tracked = mission.mode is MissionMode.TRACK and mission.target == self.link.receiver
            if tracked and left_s <= 0.0:
                found.append(geometry.slant(mission)[0])
            elif self.link.receiver in flying:
                found.append(0.0)
            else:
                low_m = geometry.altitude(mission)[0] - self._sunk_m(left_s)
                found.append(max(0.0, low_m - TARGET_HEIGHT_M))
        return min(found)

    def _sunk_m(self, left_s: float) -> float:
        """Return how far the sender may have sunk so long after its last mission, metres."""
        stays_up = self.missions[-1].ends_in_flight and not self._is_redirected()
        if left_s <= 0.0 or stays_up:
            return 0.0
        return left_s * self.limits.uav_descent_max_mps * (1.0 + self.tolerances.limit_margin)

    def _after_missions_s(self) -> float:
        """Return how long after the last mission the message may still be on its way, seconds."""
        if self._is_redirected():
            return math.inf
        first = self.missions[0].altitude_m
        slack = self.tolerances.altitude_m.of(first.value, approximate=first.approximate)
        over_s = least(first, slack, 0.0) / self.limits.uav_climb_max_mps
        for mission in self.missions:
            lasts = mission.duration_s
            if lasts is not None and is_stated(lasts):
                slack = self.tolerances.duration_s.of(lasts.value, approximate=lasts.approximate)
                over_s += least(lasts, slack, 0.0)
            elif lasts is not None:
                over_s += lasts.low
        return self._sent_by_s() - over_s

    def _is_redirected(self) -> bool:
        return any(is_redirected(self.spec, m) for m in self.missions)

    def _sent_by_s(self) -> float:
        """Return when the last attempt is made at the latest, seconds from t = 0."""
        trigger, total_s = self.event.trigger, self.tolerances.event_delay_s
        if not isinstance(trigger, TimeTrigger):
            return math.inf
        for number in (trigger.at_s, self.event.delay_s):
            if number is not None:
                slack = self.tolerances.duration_s.of(number.value, approximate=number.approximate)
                total_s += most(number, slack, math.inf)
        tries, gap = self.link.retransmissions, self.link.retransmission_interval_s
        # What nobody states of them leaves the time in which a message has to arrive.
        again_s = tries.high * gap.high if is_stated(tries) or is_stated(gap) else 0.0
        return total_s + max(self.tolerances.delivery_s, again_s)

    def facts(self) -> tuple[Fact, ...]:
        """Return what these distances follow from."""
        geometry = Geometry(self.spec, self.limits, self.tolerances)
        found = [fact for m in self.missions for fact in geometry.facts(m)]
        trigger, base = self.event.trigger, f'events/{self.event.id}'
        if isinstance(trigger, TimeTrigger):
            found += says(f'{base}/trigger/at_s', trigger.at_s)
            found += says(f'{base}/delay_s', self.event.delay_s)
            for mission in self.missions:
                found += says(f'missions/{mission.id}/duration_s', mission.duration_s)
        found += limit_facts(self.limits, 'uav_climb_max_mps', 'uav_descent_max_mps')
        slack = ('duration_s', 'event_delay_s', 'delivery_s', 'limit_margin')
        return tuple(dict.fromkeys([*found, *tolerance_facts(self.tolerances, *slack)]))


def _too_far(spec: ScenarioSpec, link: Link, event: Event, flight: Flight) -> Certificate | None:
    """Return that the sender is too far or too high while the message may pass."""
    reach = link.range_m
    if reach is None or not is_stated(reach) or reach.bound is Bound.AT_LEAST:
        return None
    near = flight.nearest_m()
    if near <= reach.value:
        return None
    return beyond(
        Rule.RADIO,
        'comm_range',
        reach,
        f'links/{link.id}/range_m',
        ('range_m', reach.value),
        f'{link.sender} and {link.receiver} would be at least {near:.0f} m apart; '
        f'the link reaches {reach.value:g} m.',
        (
            *says(f'links/{link.id}/range_m', reach),
            *says(f'events/{event.id}/action/do', event.action.do if event.action else None),
            *flight.facts(),
        ),
    )


def _kept_out_of_range(spec: ScenarioSpec, link: Link, limits: Limits) -> Iterator[Certificate]:
    """`the two never come nearer than 300 m`, and their link reaches 120 m.

    Of a UAV that is asked of its missions, and it may send while it lands.
    """
    reach = link.range_m
    stated = reach is not None and is_stated(reach)
    flying = {uav.id for uav in spec.uavs}
    if reach is not None and (not stated or reach.bound is Bound.AT_LEAST):
        return
    if not flying.isdisjoint((link.sender, link.receiver)):
        return
    reach_m = limits.link_range_sight_m if reach is None else reach.value
    for condition in spec.conditions:
        apart = condition.quantity in _BETWEEN and condition.op in AT_LEAST
        both = set(condition.of) == {link.sender, link.receiver}
        if not (apart and both and whole(condition) and is_stated(condition.value)):
            continue
        if condition.value.value > reach_m:
            at_limit = () if stated else limit_facts(limits, 'link_range_sight_m')
            yield beyond(
                Rule.RADIO,
                'comm_range',
                reach if reach is not None else condition.value,
                f'links/{link.id}/range_m',
                ('range_m' if stated else 'link_range_sight_m', reach_m),
                f'{link.sender} and {link.receiver} are to stay {condition.value.value:g} m '
                f'apart; the link reaches {reach_m:g} m.',
                (
                    *says(f'links/{link.id}/range_m', reach),
                    *says(f'conditions/{condition.id}/value', condition.value),
                    *at_limit,
                ),
            )
