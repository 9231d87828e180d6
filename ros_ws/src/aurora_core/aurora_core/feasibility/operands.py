# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What a condition is about: whether its operands are of the kinds that its quantity is of.

The altitude of a car is a fault of the reader. Nothing is proven from it.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from aurora_core.spec.quantity import QuantityName
from aurora_core.spec.reference import is_place
from aurora_core.spec.scenario import AgentAction, ScenarioSpec, StatedCondition, UavAction
from aurora_core.spec.stated import is_stated
from aurora_core.spec.vocabulary import BehaviorKind

AT_LEAST = ('>', '>=')
AT_MOST = ('<', '<=')

_OF_UAV = (
    QuantityName.ALTITUDE,
    QuantityName.HOVER_DRIFT,
    QuantityName.WAYPOINTS_VISITED,
    QuantityName.MISSION_COMPLETED,
    QuantityName.LANDED,
    QuantityName.BATTERY,
)
_BETWEEN = (QuantityName.DISTANCE, QuantityName.HORIZONTAL_DISTANCE)
_SEEN = (QuantityName.VISIBLE_TIME, QuantityName.VISIBLE_FRACTION)
_SENT = (
    QuantityName.DELIVERED,
    QuantityName.DELIVERY_LATENCY,
    QuantityName.DELIVERY_RATIO,
)

# What a vehicle does beside driving that takes its speed from it.
SLOWING = frozenset(
    {
        BehaviorKind.STOP,
        BehaviorKind.BRAKE,
        BehaviorKind.SLOW,
        BehaviorKind.YIELD,
        BehaviorKind.WAIT,
        BehaviorKind.PARK,
    }
)


def members_fit(spec: ScenarioSpec, condition: StatedCondition) -> bool:
    """Tell whether a condition is about things that have its quantity, one by one or several.

    "None of the trucks", "each of the cars": it is asked of all of them.
    """
    of, quantity = condition.of, condition.quantity
    if quantity in _SENT:
        rest = tuple(name for name in of[1:] if name != of[0])
        return bool(rest) and all(_fits(spec, quantity, (of[0], name)) for name in rest)
    if quantity in (*_OF_UAV, QuantityName.SPEED):
        return all(_fits(spec, quantity, (name,)) for name in of)
    return operands_fit(spec, condition)


def operands_fit(spec: ScenarioSpec, condition: StatedCondition) -> bool:
    """Tell whether a condition is about one thing, or one pair, that has its quantity."""
    return _fits(spec, condition.quantity, condition.of)


def _fits(spec: ScenarioSpec, quantity: str, of: tuple[str, ...]) -> bool:
    flying = {name for uav in spec.uavs for name in (uav.id, uav.group) if name is not None}
    bodies = flying | {n for a in spec.agents for n in (a.id, a.group) if n is not None}
    if quantity in _OF_UAV:
        return len(of) == 1 and of[0] in flying
    if quantity == QuantityName.SPEED:
        return len(of) == 1 and of[0] in bodies
    if quantity == QuantityName.SEPARATION:
        groups = {name for _, name in _grouped(spec)}
        several = len(of) > 1 and len(set(of)) == len(of)
        return bodies.issuperset(of) and (several or of[0] in groups)
    if quantity == QuantityName.EVENT_TIME:
        return len(of) == 1 and of[0] in {e.id for e in spec.events}
    if len(of) != 2 or of[0] == of[1]:
        return False
    first, second = of
    second_fits = second in bodies or is_place(second)
    if quantity in _BETWEEN:
        first_fits = first in bodies or is_place(first)
        return first_fits and second_fits and not (is_place(first) and is_place(second))
    if quantity in _SEEN:
        return first in bodies and second_fits
    if quantity in (QuantityName.TRACKED_FRACTION, QuantityName.CLEARANCE):
        return first in flying and second_fits
    if quantity in _SENT:
        return first in bodies and second in bodies
    return True


def _grouped(spec: ScenarioSpec) -> list[tuple[str, str]]:
    """Return the bodies that are members of groups, each with its group."""
    uavs = [(u.id, u.group) for u in spec.uavs if u.group is not None]
    return uavs + [(a.id, a.group) for a in spec.agents if a.group is not None]


def whole(condition: StatedCondition) -> bool:
    """Return whether a condition is asked of all the time, not of a share, stretch or moment."""
    return condition.fraction is None and condition.hold_s is None and condition.by_s is None


def in_parts(spec: ScenarioSpec, names: Iterable[str]) -> bool:
    """Tell whether what holds for a body may be asked of a part of its time only.

    Whoever flies several missions, or does something else when an event happens, may be asked one
    thing before and another one after that; a condition does not say when.
    """
    flown = [m.uav for m in spec.missions]
    acting = {
        e.action.uav if isinstance(e.action, UavAction) else e.action.agent
        for e in spec.events
        if isinstance(e.action, UavAction | AgentAction) and not _begins_all(e.action, flown)
    }
    several = {uav for uav in flown if flown.count(uav) > 1}
    parts = acting | several
    grouped = {name for body, name in _grouped(spec) if body in parts}
    return not (parts | grouped).isdisjoint(names)


def _begins_all(action: UavAction | AgentAction, flown: Sequence[str]) -> bool:
    """Tell whether an action begins the one mission that its UAV flies: nothing was before."""
    if not isinstance(action, UavAction) or action.mission is None:
        return False
    return flown.count(action.uav) == 1


def upward(condition: StatedCondition) -> bool:
    """Tell whether a condition asks for its stated value or more."""
    return condition.op in (*AT_LEAST, '==') and is_stated(condition.value)
