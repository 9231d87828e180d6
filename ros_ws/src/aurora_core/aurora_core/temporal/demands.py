# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Bounds that a request asks for: orders, deadlines, and that all is done before the end.

Each demand is a group of links: together they are one thing that somebody asked for.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from functools import partial

from aurora_core.outcomes.feasibility import BoundKind
from aurora_core.spec.quantity import QuantityName
from aurora_core.spec.scenario import Order, SendMessage, StatedCondition
from aurora_core.spec.stated import is_stated, most
from aurora_core.temporal.flights import battery_links, captured, flown_by, home_point, over
from aurora_core.temporal.happenings import moment
from aurora_core.temporal.links import END, START, Basis, Link

Demand = tuple[Link, ...]

_AT_MOST = ('<', '<=')
_AT_LEAST = ('>', '>=')


def demands(basis: Basis) -> Iterator[Demand]:
    """Yield all that is asked of times, one demand after the other."""
    for order in basis.spec.orders:
        yield from ((link,) for link in _order(basis, order))
    for condition in basis.spec.conditions:
        yield from _deadline(basis, condition)
    if is_stated(basis.spec.world.duration_s):
        long = {f'uavs/{m.uav}' for m in basis.spec.missions if is_stated(m.duration_s)}
        inside = inside_links(basis)
        # A flight of which nobody says how long it is may end in the air.
        yield from ((a,) for a in inside if a.of in long or a.of.startswith('events/'))
        yield from _doings(basis)
    yield from ((link,) for link in battery_links(basis))


def horizon_link(basis: Basis, horizon_s: float) -> Link:
    """Return when the scenario ends."""
    return Link(
        earlier=START,
        later=END,
        most_s=horizon_s,
        kind=BoundKind.HORIZON,
        of='world/duration_s',
        words=f'the scenario lasts {horizon_s:g} s',
        stated=(('world/duration_s', basis.spec.world.duration_s),),
    )


def inside_links(basis: Basis) -> Iterator[Link]:
    """Yield that every event happens, and every flight is over, before the end."""
    points = [(f'events/{e.id}', moment(e.id)) for e in basis.spec.events]
    for uav in basis.spec.uavs:
        flown = flown_by(basis, uav.id)
        points += [(f'uavs/{uav.id}', home_point(flown[-1]))] if flown else []
    for of, point in points:
        yield Link(
            earlier=point,
            later=END,
            least_s=0.0,
            kind=BoundKind.INSIDE,
            of=of,
            words=f'{of.partition("/")[2]} is done before the end',
        )


def _doings(basis: Basis) -> Iterator[Demand]:
    """Yield that what agents do for a stated time is done before the end."""
    for agent in basis.spec.agents:
        for number, behavior in enumerate(agent.behaviors):
            if behavior.duration_s is None:
                continue
            of = f'agents/{agent.id}/behaviors/{number}'
            least_s, _ = basis.window_s(behavior.duration_s)
            what = f'{agent.id} is to {behavior.kind.value.replace("_", " ")}'
            yield (
                Link(
                    earlier=START,
                    later=of,
                    least_s=least_s,
                    kind=BoundKind.PHASE,
                    of=of,
                    words=f'{what} for {least_s:g} s at least',
                    stated=((f'{of}/duration_s', behavior.duration_s),),
                    tolerances=('duration_s',),
                ),
                Link(
                    earlier=of,
                    later=END,
                    least_s=0.0,
                    kind=BoundKind.INSIDE,
                    of=of,
                    words=f'{of.partition("/")[2]} is done before the end',
                ),
            )


def _order(basis: Basis, order: Order) -> Iterator[Link]:
    """Yield what an order asks of two points.

    The missions of one UAV are flown as they are listed: an order against that list is a fault of
    the list, which is no proof of anything.
    """
    events = {e.id for e in basis.spec.events}
    flying = {m.id: m.uav for m in basis.spec.missions}
    same = flying.get(order.first) is not None
    same = same and flying.get(order.first) == flying.get(order.then)
    if same or not {order.first, order.then} <= events | flying.keys():
        return
    base = f'orders/{order.id}'
    between = partial(
        Link,
        earlier=moment(order.first) if order.first in events else over(order.first),
        later=moment(order.then) if order.then in events else captured(order.then),
        kind=BoundKind.ORDER,
        of=base,
    )
    stated = ((f'{base}/first', order.first), (f'{base}/then', order.then))
    words = f'{order.first} has to come before {order.then}'
    yield between(least_s=0.0, words=words, stated=stated)
    within_s = most(order.within_s, 0.0, math.inf)
    if math.isfinite(within_s) and {order.first, order.then} <= events:
        yield between(
            most_s=within_s,
            words=f'{order.then} has to come within {within_s:g} s of {order.first}',
            stated=(*stated, (f'{base}/within_s', order.within_s)),
        )


def _deadline(basis: Basis, condition: StatedCondition) -> Iterator[Demand]:
    """Yield what a condition asks of a point, with how that point is reached."""
    if condition.quantity == QuantityName.EVENT_TIME:
        yield from _event_time(basis, condition)
        return
    due_s = most(condition.by_s, 0.0, math.inf)
    reached = _reached(basis, condition)
    if reached is None or not math.isfinite(due_s):
        return
    point, way = reached
    of = f'conditions/{condition.id}'
    yield (
        *way,
        Link(
            earlier=START,
            later=point,
            most_s=due_s,
            kind=BoundKind.DEADLINE,
            of=of,
            words=f'{condition.quantity} of {", ".join(condition.of)} is due at {due_s:g} s',
            stated=((f'{of}/by_s', condition.by_s),),
        ),
    )


def _event_time(basis: Basis, condition: StatedCondition) -> Iterator[Demand]:
    value, of = condition.value, f'conditions/{condition.id}'
    known = {e.id for e in basis.spec.events}
    if len(condition.of) != 1 or condition.of[0] not in known or not is_stated(value):
        return
    slack = basis.tolerances.duration_s.of(value.value, approximate=value.approximate)
    slack = slack if condition.op == '==' else 0.0
    asked = f'{condition.of[0]} has to come'
    due = partial(
        Link,
        earlier=START,
        later=moment(condition.of[0]),
        kind=BoundKind.DEADLINE,
        of=of,
        stated=((f'{of}/value', value), (f'{of}/op', condition.op)),
        tolerances=('duration_s',),
    )
    if condition.op not in _AT_LEAST:
        last_s = value.value + slack
        yield (due(most_s=last_s, words=f'{asked} by {last_s:g} s'),)
    if condition.op not in _AT_MOST:
        first_s = max(0.0, value.value - slack)
        yield (due(least_s=first_s, words=f'{asked} at {first_s:g} s or later'),)


def _reached(basis: Basis, condition: StatedCondition) -> tuple[str, Demand] | None:
    """Return the point that a condition's deadline is about; None when it is about none."""
    of, value, quantity = condition.of, condition.value, condition.quantity
    if quantity == QuantityName.ALTITUDE and condition.op in _AT_LEAST:
        flies = len(of) == 1 and of[0] in {uav.id for uav in basis.spec.uavs}
        if not flies or not is_stated(value):
            return None
        rate_mps = basis.limits.uav_climb_max_mps
        base = f'conditions/{condition.id}'
        climb = Link(
            earlier=f'uavs/{of[0]}/takeoff',
            later=base,
            least_s=value.value / rate_mps,
            kind=BoundKind.CLIMB,
            of=base,
            words=f'{of[0]} climbs {value.value:g} m at {rate_mps:g} m/s at most',
            stated=((f'{base}/value', value), (f'{base}/op', condition.op)),
            limits=('uav_climb_max_mps',),
        )
        return base, (climb,)
    latency = quantity == QuantityName.DELIVERY_LATENCY
    if not latency and (condition.op in _AT_MOST or value.value <= 0.0):
        return None  # it is asked not to be so
    if quantity in (QuantityName.LANDED, QuantityName.MISSION_COMPLETED) and len(of) == 1:
        flown = flown_by(basis, of[0])
        if not flown:
            return None
        landed = quantity == QuantityName.LANDED
        # Of several missions the words may mean any; the first one is over first.
        return (f'uavs/{of[0]}/landed' if landed else over(flown[0].id)), ()
    if quantity == QuantityName.DELIVERED or latency:
        sent = [
            e.id
            for e in basis.spec.events
            if isinstance(e.action, SendMessage) and (e.action.sender, e.action.receiver) == of
        ]
        return (moment(sent[0]), ()) if len(sent) == 1 else None
    return None
