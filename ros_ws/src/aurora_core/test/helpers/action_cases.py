# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Runs in which an event tells somebody to do something, at 15 s where nothing else is said."""

from __future__ import annotations

import numpy as np
from trace_builder import Flight, FloatArray, flight, number
from trace_cases import Case, facts_of, ground_case, hover_case, mission, spec

from aurora_core.outcomes.schedule import MissionFacts
from aurora_core.spec.parameter import Unit
from aurora_core.spec.scenario import Behavior
from aurora_core.spec.vocabulary import BehaviorKind, MissionMode

T = 401
TICK = np.arange(T)
AT_S = 15.0
HOME = (100.0, 20.0)


def with_event(case: Case, action: dict[str, object], at_s: float) -> Case:
    trigger = {'on': 'time', 'at_s': number(at_s, Unit.SECOND)}
    event = {'id': 'e1', 'trigger': trigger, 'action': action}
    case.spec = spec(**{**dict(case.spec), 'events': (event,)})
    return case


def told_car(do: str, speed: FloatArray, at_s: float) -> Case:
    case = ground_case(Behavior(kind=BehaviorKind.DRIVE), speed)
    return with_event(case, {'do': do, 'agent': 'car1'}, at_s)


def told_uav(action: dict[str, object], one: Flight, at_s: float, *more: str) -> Case:
    case = hover_case()
    case.run.flights[:] = [one]
    missions = [mission(name, MissionMode.HOVER, target='ego') for name in ('m1', *more)]
    case.spec = spec(**{**dict(case.spec), 'missions': missions})
    case.facts = facts_of(
        *(
            MissionFacts(
                mission=m.id,
                uav='uav1',
                mode=MissionMode.HOVER,
                altitude_m=30.0,
                hover_point=(100.0, 0.0, 30.0),
                duration_s=30.0,
            )
            for m in missions
        ),
        horizon_s=70.0,
    )
    return with_event(case, {'uav': 'uav1'} | action, at_s)


def lands(tick: int, at_s: float) -> Case:
    return told_uav({'do': 'land'}, flight(1401, HOME, 30.0, landing=tick), at_s)


def ascends(tick: int, at_s: float, asked_m: float = 60.0, to_m: float = 60.0) -> Case:
    """It climbs to 30 m, and at the tick goes on to 60 m or another altitude."""

    def path(k: int) -> tuple[float, float, float]:
        return (100.0, 0.0, to_m if k >= tick else 30.0)

    one = flight(1401, HOME, 30.0, path, landing=900)
    return told_uav({'do': 'ascend', 'altitude_m': number(asked_m)}, one, at_s)


def to_speed(
    do: str,
    end_mps: float,
    value_mps: float | None = None,
    *,
    from_mps: float = 10.0,
    rate: float = 5.0,
) -> Case:
    """From one speed to another with `rate` m/s^2 from tick 301 on, which is asked for."""
    change = rate * 0.05 * np.maximum(TICK - 300, 0)
    speed = np.maximum(from_mps - change, end_mps)
    if end_mps > from_mps:
        speed = np.minimum(from_mps + change, end_mps)
    case = told_car(do, speed, AT_S)
    (event,) = case.spec.events
    if value_mps is not None:
        assert event.action is not None
        value = number(value_mps, Unit.METRE_PER_SECOND, explicit=True)
        action = {**dict(event.action), 'value_mps': value}
        case.spec = spec(**{**dict(case.spec), 'events': ({**dict(event), 'action': action},)})
    return case


def changed(case: Case, **changes: object) -> Case:
    """Change the event."""
    (event,) = case.spec.events
    case.spec = spec(**{**dict(case.spec), 'events': ({**dict(event), **changes},)})
    return case


def never_due(do: str, end_mps: float, value_mps: float | None = None) -> Case:
    at_s = number(99.0, Unit.SECOND)
    return changed(to_speed(do, end_mps, value_mps), trigger={'on': 'time', 'at_s': at_s})
