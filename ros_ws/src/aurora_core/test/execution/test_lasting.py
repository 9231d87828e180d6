# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Who stands for a stated time drives on by itself, and a run is long enough for what lasts."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest

from aurora_core.outcomes.grounded import ReleaseOn
from aurora_core.spec.parameter import Bound, Parameter
from aurora_core.spec.scenario import AgentAction, Behavior, Event, SendMessage, TimeTrigger
from aurora_core.spec.vocabulary import BehaviorKind
from aurora_core.trace.layout import GroundCommandKind
from aurora_core.trace.records import ScenarioEventKind

Make = Callable[..., Parameter]
Build = Callable[..., Any]

SET, RELEASE = int(GroundCommandKind.SET_SPEED), int(GroundCommandKind.RELEASE_SPEED)
TICKS_PER_S = 20


def _for(make: Make, kind: BehaviorKind, seconds: float, bound: Bound = Bound.EXACTLY) -> Behavior:
    lasts = make(seconds, 's').model_copy(update={'bound': bound})
    return Behavior(kind=kind, duration_s=lasts)


@pytest.mark.parametrize(
    ('bound', 'until_s'), [(Bound.EXACTLY, 6.0), (Bound.AT_LEAST, 7.0), (Bound.AT_MOST, 5.0)]
)
def test_who_waits_for_a_time_drives_on_then(
    stage: Build, parameter: Make, bound: Bound, until_s: float
) -> None:
    waits = _for(parameter, BehaviorKind.WAIT, 6.0, bound)
    scene = stage(behaviors={'ego': (waits,)}, releases={'ego': (ReleaseOn.NEVER, '')})
    scene.put('van1', 100.0).put('ego', 200.0).step(10 * TICKS_PER_S)
    told = [(t, what, value) for t, agent, what, value in scene.commands() if agent == 'ego']
    assert told == [(0, SET, 0.0), (round(until_s * TICKS_PER_S), RELEASE, 0.0)]


def test_a_person_who_stops_for_a_time_walks_on(stage: Build, parameter: Make) -> None:
    stops = _for(parameter, BehaviorKind.STOP, 4.0)
    scene = stage(
        behaviors={'ego': (stops,)},
        halts={'ego': (15.0, 0.0)},
        stops_s={'ego': 4.0},
        speeds={'ego': 1.5},
    )
    scene.put('ego', 0.0, speed=1.5).step(40)
    scene.put('ego', 15.1, speed=1.5).step(120)
    told = [(t, what, value) for t, agent, what, value in scene.commands() if agent == 'ego']
    assert told == [(0, SET, 1.5), (40, SET, 0.0), (40 + 4 * TICKS_PER_S, SET, 1.5)]


def test_a_run_lasts_until_somebody_has_driven_for_as_long_as_asked(
    stage: Build, parameter: Make
) -> None:
    sent = Event(
        id='e1',
        trigger=TimeTrigger(on='time', at_s=parameter(0.0, 's')),
        action=SendMessage(do='send_message', sender='ego', receiver='van1'),
    )
    drives = _for(parameter, BehaviorKind.DRIVE, 8.0)
    scene = stage(
        tracks={}, links=(('ego', 'van1'),), events=(sent,), behaviors={'ego': (drives,)}
    )
    assert not scene.put('van1', 20.0).step(15 * TICKS_PER_S).finished  # it stands
    assert not scene.put('ego', 0.0, speed=5.0).step(8 * TICKS_PER_S).finished
    assert scene.step(8 * TICKS_PER_S).finished


def test_what_nobody_dates_comes_after_what_lasts(stage: Build, parameter: Make) -> None:
    """`Drives for 4 s and then accelerates to 12 m/s`."""
    faster = AgentAction(do='accelerate', agent='ego', value_mps=parameter(12.0, 'm/s'))
    drives = _for(parameter, BehaviorKind.DRIVE, 4.0)
    events = (Event(id='e1', action=faster),)
    scene = stage(tracks={}, events=events, behaviors={'ego': (drives,)})
    scene.put('van1', 90.0).step(TICKS_PER_S)  # it stands
    scene.put('ego', 0.0, speed=6.0).step(8 * TICKS_PER_S)
    ((tick, _, _),) = scene.notes(ScenarioEventKind.ACTION)
    assert 5 * TICKS_PER_S <= tick <= 6 * TICKS_PER_S + 2
