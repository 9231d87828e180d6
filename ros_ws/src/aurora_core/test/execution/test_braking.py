# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""How hard drivers are told to brake: as stated, else as ever, never harder than is allowed."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest

from aurora_core.spec.parameter import Bound, Parameter
from aurora_core.spec.scenario import (
    AgentAction,
    Event,
    EventDoneTrigger,
    StatedCondition,
    TimeTrigger,
)
from aurora_core.trace.layout import GroundCommandKind

Make = Callable[..., Parameter]
Build = Callable[..., Any]


def _at_once(make: Make, **action: Any) -> Event:
    return Event(
        id='e1',
        trigger=TimeTrigger(on='time', at_s=make(0.0, 's')),
        action=AgentAction(agent='ego', **action),
    )


def _told(scene: Any) -> list[float]:
    hard = int(GroundCommandKind.SET_DECELERATION)
    return [value for _, _, kind, value in scene.commands() if kind == hard]


@pytest.mark.parametrize(
    ('do', 'asked', 'bound', 'told'),
    [
        ('brake', 3.0, Bound.EXACTLY, 3.0),
        ('stop', 2.0, Bound.EXACTLY, 2.0),
        ('slow', 5.0, Bound.AT_LEAST, 5.25),
        ('brake', 3.0, Bound.AT_MOST, 2.85),
    ],
)
def test_a_stated_deceleration_is_commanded(
    do: Any, asked: float, bound: Bound, told: float, stage: Build, parameter: Make
) -> None:
    hard = parameter(asked, 'm/s^2', bound=bound)
    event = _at_once(parameter, do=do, deceleration_mps2=hard)
    scene = stage(tracks={}, events=(event,))
    scene.put('ego', 0.0, speed=12.0).step()
    assert _told(scene) == pytest.approx([told])


def test_what_comes_later_without_a_number_is_as_hard_as_ever(
    stage: Build, parameter: Make
) -> None:
    gently = _at_once(
        parameter,
        do='slow',
        value_mps=parameter(8.0, 'm/s'),
        deceleration_mps2=parameter(1.0, 'm/s^2'),
    )
    stop = Event(
        id='e2',
        trigger=EventDoneTrigger(on='event_done', event='e1'),
        action=AgentAction(do='stop', agent='ego'),
    )
    scene = stage(tracks={}, events=(gently, stop))
    scene.put('ego', 0.0, speed=12.0).step(2)
    scene.put('ego', 0.0, speed=8.0).step(2)
    own = scene.stepper._setup.agents[1].deceleration_mps2
    assert _told(scene) == [1.0, own]


def test_who_must_never_brake_hard_does_not(stage: Build, parameter: Make) -> None:
    never = StatedCondition(
        id='c1', quantity='deceleration', of=('ego',), op='<=', value=parameter(3.0, 'm/s^2')
    )
    event = _at_once(parameter, do='brake')
    scene = stage(tracks={}, events=(event,), conditions=(never,))
    scene.put('ego', 0.0, speed=12.0).step()
    assert _told(scene) == pytest.approx([2.85, 2.85])
