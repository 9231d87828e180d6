# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Each fault bends what the simulators get, is announced once, and hits nothing else."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from pydantic import ValidationError

from aurora_core.errors import ExecutionError
from aurora_core.execution.fault_port import loss_with_faults
from aurora_core.execution.faults import Fault
from aurora_core.outcomes.grounded import ReleaseOn
from aurora_core.spec.parameter import Parameter
from aurora_core.spec.scenario import AgentAction, Event, SendMessage, TimeTrigger
from aurora_core.trace.layout import GroundCommandKind, UavCommandColumn, UavMode
from aurora_core.trace.records import LinkEventKind, LossReason, ScenarioEventKind

Build = Callable[..., Any]
Make = Callable[..., Parameter]

SET, FREE = int(GroundCommandKind.SET_SPEED), int(GroundCommandKind.RELEASE_SPEED)
REMOVE = int(GroundCommandKind.REMOVE)


def _of(scene: Any, agent: str) -> list[tuple[int, int, float]]:
    return [(t, kind, value) for t, who, kind, value in scene.commands() if who == agent]


def test_target_removed_once_and_nothing_follows(stage: Build, parameter: Make) -> None:
    later = Event(
        id='e1',
        trigger=TimeTrigger(on='time', at_s=parameter(2.0, 's')),
        action=AgentAction(do='stop', agent='van1'),
    )
    fault = Fault(kind='target_removed', subject='van1', at_s=1.0)
    scene = stage(faults=(fault,), events=(later,))
    scene.step(60)
    assert _of(scene, 'van1') == [(0, FREE, 0.0), (20, REMOVE, 0.0)]
    assert _of(scene, 'ego') == [(0, FREE, 0.0)]
    assert scene.notes(ScenarioEventKind.FAULT) == [(20, 'van1', fault.told())]


def test_route_blocked_stops_an_agent_for_good(stage: Build, parameter: Make) -> None:
    start = Event(
        id='e1',
        trigger=TimeTrigger(on='time', at_s=parameter(2.0, 's')),
        action=AgentAction(do='start', agent='van1'),
    )
    scene = stage(faults=(Fault(kind='route_blocked', subject='van1', at_s=1.0),), events=(start,))
    scene.step(60)
    assert _of(scene, 'van1') == [(0, FREE, 0.0), (20, SET, 0.0), (40, SET, 0.0)]
    assert _of(scene, 'ego') == [(0, FREE, 0.0)]


def test_route_blocked_from_the_start(stage: Build) -> None:
    scene = stage(faults=(Fault(kind='route_blocked', subject='van1'),), speeds={'van1': 9.0})
    scene.step(5)
    assert {(kind, value) for _, kind, value in _of(scene, 'van1')} == {(SET, 0.0)}


def test_route_blocked_freezes_a_uav_in_flight(stage: Build) -> None:
    scene = stage(faults=(Fault(kind='route_blocked', subject='uav1', at_s=8.0),), hold_s=5.0)
    scene.put('van1', 100.0).follow(400)
    [(tick, subject, detail)] = scene.notes(ScenarioEventKind.FAULT)
    assert (tick, subject, detail) == (160, 'uav1', 'route_blocked {"at_s":8.0,"value":null}')
    rows = np.array([o.uav_commands[0] for o in scene.outputs])
    frozen = rows[160:, UavCommandColumn.X : UavCommandColumn.Z + 1]
    assert np.ptp(frozen, axis=0).tolist() == [0.0, 0.0, 0.0]
    assert not rows[160:, UavCommandColumn.VX : UavCommandColumn.VZ + 1].any()
    # The phases go on: the mission machine does not know.
    assert rows[-1, UavCommandColumn.MODE] == UavMode.OFFBOARD
    assert rows[159, UavCommandColumn.X] != rows[158, UavCommandColumn.X]


def test_keep_away_caps_a_release(stage: Build) -> None:
    scene = stage(
        faults=(Fault(kind='keep_away', subject='van1', value=2.0),),
        releases={'van1': (ReleaseOn.CAPTURED, 'uav1')},
    )
    scene.put('van1', 5.0).step(3)
    # Still held: the fault does not make it start.
    assert _of(scene, 'van1') == [(0, SET, 0.0)]
    scene.fly('uav1', 5.0, 0.0, 30.0).step()
    assert _of(scene, 'van1') == [(0, SET, 0.0), (3, SET, 2.0)]
    assert scene.notes(ScenarioEventKind.RELEASED) == [(3, 'van1', '')]


def test_keep_away_slows_an_agent_that_drives_already(stage: Build) -> None:
    scene = stage(faults=(Fault(kind='keep_away', subject='van1', at_s=1.0),))
    scene.step(40)
    assert _of(scene, 'van1') == [(0, FREE, 0.0), (20, SET, 3.0)]
    slow = stage(faults=(Fault(kind='keep_away', subject='van1', at_s=1.0),), speeds={'van1': 2.0})
    slow.step(40)
    assert _of(slow, 'van1') == [(0, SET, 2.0)]


def test_keep_away_lets_an_agent_stop(stage: Build, parameter: Make) -> None:
    stop = Event(
        id='e1',
        trigger=TimeTrigger(on='time', at_s=parameter(2.0, 's')),
        action=AgentAction(do='stop', agent='van1'),
    )
    scene = stage(faults=(Fault(kind='keep_away', subject='van1'),), events=(stop,))
    scene.step(60)
    assert _of(scene, 'van1')[-1] == (40, SET, 0.0)


@pytest.mark.parametrize(('subject', 'lost'), [('*', True), ('l0', True), ('l1', False)])
def test_link_loss(subject: str, lost: bool, stage: Build, parameter: Make) -> None:
    send = Event(
        id='e1',
        trigger=TimeTrigger(on='time', at_s=parameter(1.0, 's')),
        action=SendMessage(do='send_message', sender='van1', receiver='ego'),
    )
    fault = Fault(kind='link_loss', subject=subject, at_s=0.5)
    scene = stage(faults=(fault,), events=(send,), links=(('van1', 'ego'), ('ego', 'van1')))
    scene.step(60)
    records = [r for o in scene.outputs for r in o.links]
    assert records[-1].kind is (LinkEventKind.FAILED if lost else LinkEventKind.DELIVERED)
    assert {r.reason for r in records if r.kind is LinkEventKind.ATTEMPT_LOST} == (
        {LossReason.RANDOM} if lost else set()
    )
    assert scene.notes(ScenarioEventKind.FAULT) == [(10, subject, fault.told())]


def test_loss_by_time() -> None:
    faults = (
        Fault(kind='link_loss', subject='l1', at_s=1.0, value=0.4),
        Fault(kind='link_loss', subject='*', at_s=2.0),
        Fault(kind='route_blocked', subject='l1'),
    )
    loss_at = loss_with_faults('l1', 0.1, faults, 0.05)
    assert [loss_at(t) for t in (0, 19, 20, 39, 40, 1000)] == [0.1, 0.1, 0.4, 0.4, 1.0, 1.0]
    assert loss_with_faults('l2', 0.1, faults, 0.05)(20) == 0.1


@pytest.mark.parametrize(
    ('kind', 'subject'),
    [
        ('target_removed', 'nobody'),
        ('target_removed', 'uav1'),
        ('target_removed', '*'),
        ('keep_away', 'uav1'),
        ('keep_away', 'l0'),
        ('route_blocked', 'l0'),
        ('route_blocked', ''),
        ('link_loss', 'van1'),
        ('link_loss', 'l9'),
    ],
)
def test_a_fault_that_can_hit_nothing_is_refused(kind: str, subject: str, stage: Build) -> None:
    with pytest.raises(ExecutionError, match='fault') as caught:
        stage(faults=(Fault(kind=kind, subject=subject),), links=(('van1', 'ego'),))  # type: ignore[arg-type]
    assert repr(subject) in caught.value.message
    assert 'use one of' in caught.value.hint


@pytest.mark.parametrize(
    'fields',
    [
        {'kind': 'explosion', 'subject': 'van1'},
        {'kind': 'link_loss', 'subject': '*', 'value': 1.5},
        {'kind': 'link_loss', 'subject': '*', 'value': -0.1},
        {'kind': 'keep_away', 'subject': 'van1', 'value': -1.0},
        {'kind': 'keep_away', 'subject': 'van1', 'at_s': -1.0},
        {'kind': 'keep_away', 'subject': 'van1', 'at_s': float('nan')},
        {'kind': 'keep_away'},
        {'kind': 'keep_away', 'subject': 'van1', 'when': 3.0},
    ],
)
def test_a_fault_that_makes_no_sense_is_refused(fields: dict[str, Any]) -> None:
    with pytest.raises(ValidationError):
        Fault.model_validate(fields)


def test_numbers_of_events_have_no_gap_with_faults(stage: Build) -> None:
    faults = (
        Fault(kind='keep_away', subject='van1', at_s=1.0),
        Fault(kind='target_removed', subject='ego', at_s=1.0),
    )
    scene = stage(faults=faults)
    scene.put('van1', 5.0).follow(100)
    numbers = [e.sequence for o in scene.outputs for e in o.events]
    assert numbers == list(range(len(numbers)))
    assert len(scene.notes(ScenarioEventKind.FAULT)) == 2
