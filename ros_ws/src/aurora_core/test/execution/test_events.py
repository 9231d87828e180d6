# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Events: each trigger, delays, the sight rule of alerts, and what actions command."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest

from aurora_core.knowledge.map_types import Building
from aurora_core.outcomes.grounded import ReleaseOn
from aurora_core.spec.parameter import Parameter, Provenance, Span, Unit
from aurora_core.spec.scenario import (
    AgentAction,
    AltitudeTrigger,
    ArrivalTrigger,
    BatteryTrigger,
    DistanceTrigger,
    Event,
    EventDoneTrigger,
    MessageTrigger,
    MissionDoneTrigger,
    Order,
    SendMessage,
    SpeedTrigger,
    TimeTrigger,
    UavAction,
    VisibilityTrigger,
)
from aurora_core.trace.layout import GroundCommandKind, UavCommandColumn, UavMode
from aurora_core.trace.records import LinkEventKind, ScenarioEventKind

Make = Callable[..., Parameter]
Build = Callable[..., Any]

WALL = Building(
    id='wall',
    ring=((40.0, -50.0), (60.0, -50.0), (60.0, 50.0), (40.0, 50.0)),
    holes=(),
    height_m=100.0,
    height_source='',
    kind='block',
    name='',
)


def _event(trigger: Any, action: Any = None, **fields: Any) -> Event:
    return Event(id=fields.pop('id', 'e1'), trigger=trigger, action=action, **fields)


def _triggered(scene: Any) -> list[tuple[int, str]]:
    return [(tick, subject) for tick, subject, _ in scene.notes(ScenarioEventKind.TRIGGERED)]


NOW = TimeTrigger(
    on='time',
    at_s=Parameter(value=0.0, unit=Unit.SECOND, low=0.0, high=9.0, provenance=Provenance.DEFAULT),
)


def test_an_event_without_a_trigger_begins_once_the_uavs_watch(stage: Build) -> None:
    scene = stage(events=(_event(None, AgentAction(do='start', agent='ego')),))
    scene.put('van1', 5.0).step(3)
    assert _triggered(scene) == []
    scene.fly('uav1', 0.0, 0.0, 30.0).step()
    assert scene.machines[0].captured
    assert _triggered(scene) == [(3, 'e1')]
    assert [t for t, _, _ in scene.notes(ScenarioEventKind.ACTION)] == [3]


def test_without_uavs_an_event_without_a_trigger_begins_at_the_start(stage: Build) -> None:
    scene = stage(tracks={}, events=(_event(None, AgentAction(do='start', agent='ego')),))
    scene.step()
    assert _triggered(scene) == [(0, 'e1')]


def test_who_is_to_brake_some_time_is_on_the_move_first(stage: Build) -> None:
    scene = stage(tracks={}, events=(_event(None, AgentAction(do='brake', agent='ego')),))
    for speed in (0.0, 4.9, 5.0):
        scene.put('ego', 0.0, speed=speed).step()
    assert _triggered(scene) == [(2, 'e1')]


@pytest.mark.parametrize('at_s', [0.0, 0.05, 0.3, 0.35, 2.0])
def test_time(at_s: float, stage: Build, parameter: Make) -> None:
    scene = stage(events=(_event(TimeTrigger(on='time', at_s=parameter(at_s, 's'))),))
    scene.step(50)
    assert _triggered(scene) == [(round(at_s / 0.05), 'e1')]


def _distance(kind: str, parameter: Make, other: str = 'ego') -> Event:
    return _event(DistanceTrigger(on=kind, a='van1', b=other, value_m=parameter(20.0)))  # type: ignore[arg-type]


def test_distance_below(stage: Build, parameter: Make) -> None:
    scene = stage(events=(_distance('distance_below', parameter),))
    for x in (40.0, 20.001, 20.0, 5.0):
        scene.put('van1', x).step()
    assert _triggered(scene) == [(2, 'e1')]


def test_distance_below_holds_from_the_start(stage: Build, parameter: Make) -> None:
    scene = stage(events=(_distance('distance_below', parameter),))
    scene.put('van1', 5.0).step()
    assert _triggered(scene) == [(0, 'e1')]


def test_distance_above_asks_for_a_change(stage: Build, parameter: Make) -> None:
    scene = stage(events=(_distance('distance_above', parameter),))
    # To a millimetre it is no farther than that.
    for x in (30.0, 30.0, 19.0, 19.9, 20.001, 20.02):
        scene.put('van1', x).step()
    assert _triggered(scene) == [(5, 'e1')]


def test_distance_to_a_place(stage: Build, parameter: Make) -> None:
    scene = stage(events=(_distance('distance_below', parameter, 'intersection'),))
    for x in (250.0, 281.0):
        scene.put('van1', x).step()
    assert _triggered(scene) == [(1, 'e1')]


def test_distance_is_in_space(stage: Build, parameter: Make) -> None:
    trigger = DistanceTrigger(on='distance_below', a='uav1', b='van1', value_m=parameter(50.0))
    scene = stage(events=(_event(trigger),))
    scene.fly('uav1', 0.0, 0.0, 30.0).put('van1', 41.0).step()
    scene.put('van1', 39.0).step()
    assert _triggered(scene) == [(1, 'e1')]


def test_a_body_that_is_gone_is_at_no_distance(stage: Build, parameter: Make) -> None:
    scene = stage(events=(_distance('distance_below', parameter),))
    scene.put('van1', 5.0).remove('van1').step(3)
    assert _triggered(scene) == []


def test_altitude(stage: Build, parameter: Make) -> None:
    trigger = AltitudeTrigger(on='altitude_reached', uav='uav1', value_m=parameter(25.0))
    scene = stage(events=(_event(trigger),))
    for z in (0.0, 23.99, 24.0):  # what it holds there may never quite exceed 25 m
        scene.fly('uav1', 0.0, 0.0, z).step()
    assert _triggered(scene) == [(2, 'e1')]


def test_speed_above_and_below(stage: Build, parameter: Make) -> None:
    events = (
        _event(
            SpeedTrigger(on='speed_above', who='ego', value_mps=parameter(5.0, 'm/s')), id='e1'
        ),
        _event(
            SpeedTrigger(on='speed_below', who='ego', value_mps=parameter(2.0, 'm/s')), id='e2'
        ),
    )
    scene = stage(events=events)
    for speed in (0.0, 4.9, 5.0, 3.0, 2.0):
        scene.put('ego', 0.0, speed=speed).step()
    # Standing at the start is no slowing down.
    assert _triggered(scene) == [(2, 'e1'), (4, 'e2')]


def test_the_speed_of_who_is_gone_counts_for_nothing(stage: Build, parameter: Make) -> None:
    trigger = SpeedTrigger(on='speed_above', who='ego', value_mps=parameter(5.0, 'm/s'))
    scene = stage(events=(_event(trigger),))
    scene.put('ego', 0.0, speed=9.0).remove('ego').step(3)
    assert _triggered(scene) == []


def test_speed_of_a_uav(stage: Build, parameter: Make) -> None:
    trigger = SpeedTrigger(on='speed_above', who='uav1', value_mps=parameter(5.0, 'm/s'))
    scene = stage(events=(_event(trigger),))
    scene.fly('uav1', 0.0, 0.0, 30.0).step()
    scene.uav[0, 3:6] = (3.0, 0.0, 4.0)
    scene.step()
    assert _triggered(scene) == [(1, 'e1')]


def test_a_battery_is_counted_from_take_off(stage: Build, parameter: Make) -> None:
    trigger = BatteryTrigger(on='battery_below', uav='uav1', value=parameter(0.9, '1'))
    scene = stage(events=(_event(trigger),))
    scene.step(30)  # on the ground it stays full
    scene.fly('uav1', 0.0, 0.0, 5.0).step(40)
    # A full one lasts 10 s here: after 20 ticks of 0.05 s in the air 0.9 is left, then less.
    assert _triggered(scene) == [(50, 'e1')]


def test_arrival(stage: Build) -> None:
    scene = stage(events=(_event(ArrivalTrigger(on='arrives', who='ego', place='intersection')),))
    for x in (280.0, 290.0):
        scene.put('ego', x).step()
    assert _triggered(scene) == [(1, 'e1')]


def test_arrival_on_a_sidewalk_is_the_one_that_is_stepped_onto(stage: Build) -> None:
    """Who crosses a street stands on the sidewalk at first: that is no arrival."""
    event = _event(ArrivalTrigger(on='arrives', who='ego', place='sidewalk'))
    scene = stage(events=(event,), sidewalks_x_m=((-10.0, 0.0), (8.0, 12.0)))
    for x in (-2.0, -1.0, 1.0, 7.0, 8.5, 9.0):
        scene.put('ego', x).step()
    assert _triggered(scene) == [(4, 'e1')]


def test_visible_counts_from_the_end_of_the_ascent(stage: Build) -> None:
    trigger = VisibilityTrigger(on='visible', observer='uav1', target='van1')
    scene = stage(events=(_event(trigger),))
    scene.put('van1', 10.0).fly('uav1', 0.0, 0.0, 20.0).step(3)
    scene.fly('uav1', 0.0, 0.0, 29.0).step()
    assert _triggered(scene) == [(3, 'e1')]


def test_occluded_asks_for_sight_before(stage: Build) -> None:
    trigger = VisibilityTrigger(on='occluded', observer='uav1', target='van1')
    scene = stage(events=(_event(trigger),), buildings=(WALL,))
    scene.put('van1', 10.0).fly('uav1', 0.0, 0.0, 30.0).step(2)
    assert _triggered(scene) == []
    scene.put('van1', 100.0).step()
    assert _triggered(scene) == [(2, 'e1')]


def test_who_was_never_seen_is_not_lost_from_sight(stage: Build) -> None:
    trigger = VisibilityTrigger(on='occluded', observer='uav1', target='van1')
    scene = stage(events=(_event(trigger),), buildings=(WALL,))
    scene.put('van1', 100.0).step(2)  # on the ground nothing is seen, nor from up there
    scene.fly('uav1', 0.0, 0.0, 30.0).step(3)
    assert _triggered(scene) == []
    scene.put('van1', 10.0).step()
    scene.put('van1', 100.0).step()
    assert _triggered(scene) == [(6, 'e1')]


@pytest.mark.parametrize(('x', 'seen'), [(30.0, [(0, 'e1')]), (-30.0, []), (100.0, [])])
def test_a_driver_sees_at_once_what_is_ahead_and_not_behind_a_wall(
    stage: Build, x: float, seen: list[tuple[int, str]]
) -> None:
    trigger = VisibilityTrigger(on='visible', observer='ego', target='van1')
    scene = stage(events=(_event(trigger),), buildings=(WALL,))
    scene.put('ego', 0.0).put('van1', x).step(2)
    assert _triggered(scene) == seen


def test_a_driver_loses_sight_of_whom_it_has_passed(stage: Build) -> None:
    trigger = VisibilityTrigger(on='occluded', observer='ego', target='van1')
    scene = stage(events=(_event(trigger),))
    for x in (-30.0, 30.0, 10.0, -10.0):  # behind it from the start on is no loss
        scene.put('ego', 0.0).put('van1', x).step()
    assert _triggered(scene) == [(3, 'e1')]


def test_on_its_way_home_a_uav_loses_nobody_from_sight(stage: Build) -> None:
    trigger = VisibilityTrigger(on='occluded', observer='uav1', target='van1')
    scene = stage(events=(_event(trigger),), buildings=(WALL,), hold_s=0.2)
    scene.put('van1', 10.0).fly('uav1', 10.0, 0.0, 30.0).step(20)
    assert scene.machines[0].is_landing
    scene.put('van1', 100.0).step(5)
    assert _triggered(scene) == []


def test_who_stands_brakes_once_it_drives(stage: Build) -> None:
    scene = stage(events=(_event(NOW, AgentAction(do='brake', agent='ego')),))
    scene.step(3)
    assert _triggered(scene) == [(0, 'e1')]
    assert scene.notes(ScenarioEventKind.ACTION) == []
    scene.put('ego', 0.0, speed=8.0).step()
    assert [t for t, _, _ in scene.notes(ScenarioEventKind.ACTION)] == [3]


def test_a_crossing_is_done_at_the_other_kerb(stage: Build) -> None:
    events = (
        _event(NOW, AgentAction(do='cross', agent='ego')),
        _event(EventDoneTrigger(on='event_done', event='e1'), id='e2'),
    )
    scene = stage(events=events, tracks={}, street_x_m=(5.0, 15.0))
    # On the way to the crossing it steps over the kerb and back.
    for x in (0.0, 5.1, 4.9, 6.0, 14.0, 16.0, 17.0):
        scene.put('ego', x, speed=1.4).step()
    assert _triggered(scene) == [(0, 'e1'), (5, 'e2')]


def test_message_received(stage: Build, parameter: Make) -> None:
    send = SendMessage(do='send_message', sender='van1', receiver='ego')
    events = (
        _event(TimeTrigger(on='time', at_s=parameter(0.5, 's')), send, id='e1'),
        _event(MessageTrigger(on='message_received', by='ego'), id='e2'),
        _event(MessageTrigger(on='message_received', by='ego', sender='van1'), id='e3'),
        _event(MessageTrigger(on='message_received', by='ego', sender='uav1'), id='e4'),
        _event(MessageTrigger(on='message_received', by='van1'), id='e5'),
    )
    scene = stage(events=events, links=(('van1', 'ego'),))
    scene.put('ego', 30.0).step(40)
    delivered = [
        r.tick for o in scene.outputs for r in o.links if r.kind is LinkEventKind.DELIVERED
    ]
    assert delivered == [12]
    assert _triggered(scene) == [(10, 'e1'), (13, 'e2'), (13, 'e3')]


def test_event_done_with_a_delay(stage: Build, parameter: Make) -> None:
    stop = AgentAction(do='stop', agent='ego')
    events = (
        _event(
            TimeTrigger(on='time', at_s=parameter(1.0, 's')),
            stop,
            id='e1',
            delay_s=parameter(0.5, 's'),
        ),
        _event(
            EventDoneTrigger(on='event_done', event='e1', after_s=parameter(2.0, 's')), id='e2'
        ),
        _event(EventDoneTrigger(on='event_done', event='e1'), id='e3'),
    )
    scene = stage(events=events)
    scene.step(100)
    # The ego stands: at once nothing is left to be done.
    assert _triggered(scene) == [(20, 'e1'), (30, 'e3'), (70, 'e2')]
    actions = [(t, s) for t, s, _ in scene.notes(ScenarioEventKind.ACTION)]
    assert actions == [(30, 'e1'), (30, 'e3'), (70, 'e2')]


@pytest.mark.parametrize(
    ('do', 'value_mps', 'before_mps', 'done_mps'),
    [('stop', None, 10.0, 0.0), ('slow', 4.0, 10.0, 4.9), ('accelerate', None, 5.0, 9.0)],
)
def test_a_chain_goes_on_once_the_action_is_complete(
    do: str,
    value_mps: float | None,
    before_mps: float,
    done_mps: float,
    stage: Build,
    parameter: Make,
) -> None:
    value = None if value_mps is None else parameter(value_mps, 'm/s')
    action = AgentAction.model_validate({'do': do, 'agent': 'ego', 'value_mps': value})
    events = (
        _event(TimeTrigger(on='time', at_s=parameter(1.0, 's')), action, id='e1'),
        _event(EventDoneTrigger(on='event_done', event='e1'), id='e2'),
    )
    scene = stage(events=events)
    scene.put('ego', 0.0, speed=before_mps).step(40)
    assert _triggered(scene) == [(20, 'e1')]
    scene.put('ego', 0.0, speed=done_mps).step(10)
    assert _triggered(scene) == [(20, 'e1'), (40, 'e2')]


def test_mission_done(stage: Build) -> None:
    scene = stage(events=(_event(MissionDoneTrigger(on='mission_done', uav='uav1')),), hold_s=1.0)
    scene.put('van1', 0.0).fly('uav1', 0.0, 0.0, 30.0).step(40)
    [(tick, _)] = _triggered(scene)
    phases = {d: t for t, _, d in scene.notes(ScenarioEventKind.PHASE)}
    assert tick == phases['landing'] + 1  # when the record shows it


def test_an_event_happens_once(stage: Build, parameter: Make) -> None:
    event = _distance('distance_below', parameter).model_copy(
        update={'action': AgentAction(do='stop', agent='ego')}
    )
    scene = stage(events=(event,))
    for x in (5.0, 50.0, 5.0, 50.0, 5.0):
        scene.put('van1', x).step()
    assert len(_triggered(scene)) == 1
    assert [c for c in scene.commands() if c[2] == GroundCommandKind.SET_SPEED] == [
        (0, 'ego', int(GroundCommandKind.SET_SPEED), 0.0)
    ]


def _alert(parameter: Make, **fields: Any) -> Event:
    return _distance('distance_below', parameter).model_copy(
        update={
            'action': SendMessage(do='send_message', sender='uav1', receiver='ego'),
            **fields,
        }
    )


def _sent(scene: Any) -> list[int]:
    return [r.tick for o in scene.outputs for r in o.links if r.kind is LinkEventKind.SENT]


def test_an_alert_waits_for_ascent_capture_and_sight(stage: Build, parameter: Make) -> None:
    scene = stage(events=(_alert(parameter),), links=(('uav1', 'ego'),), buildings=(WALL,))
    scene.put('van1', 10.0).step(5)
    assert _triggered(scene) == [(0, 'e1')]
    scene.fly('uav1', 100.0, 0.0, 30.0).step(5)  # ascended; behind the wall, far away
    assert _sent(scene) == []
    scene.fly('uav1', 25.0, 0.0, 30.0).step(5)  # sees the van, but has not captured it
    assert _sent(scene) == []
    scene.fly('uav1', 15.0, 0.0, 30.0).step(5)
    assert _sent(scene) == [15]
    assert [t for t, _, _ in scene.notes(ScenarioEventKind.ACTION)] == [15]


def test_an_alert_is_not_sent_while_the_actor_is_hidden(stage: Build, parameter: Make) -> None:
    scene = stage(events=(_alert(parameter),), links=(('uav1', 'ego'),), buildings=(WALL,))
    scene.put('ego', 10.0).put('van1', 100.0).fly('uav1', 100.0, 0.0, 30.0).step(2)
    assert scene.machines[0].captured
    scene.fly('uav1', 100.0, 0.0, 30.0).put('van1', 20.0).step(3)
    assert _triggered(scene)
    assert _sent(scene) == []
    scene.fly('uav1', 20.0, 0.0, 30.0).step()
    assert _sent(scene) == [5]


def test_a_uav_reports_its_own_altitude_on_its_way_up(stage: Build, parameter: Make) -> None:
    trigger = AltitudeTrigger(on='altitude_reached', uav='uav1', value_m=parameter(15.0))
    event = _event(trigger, SendMessage(do='send_message', sender='uav1', receiver='ego'))
    scene = stage(events=(event,), links=(('uav1', 'ego'),))
    for z in (5.0, 14.5, 20.0, 30.0):  # it is to ascend to 30 m
        scene.fly('uav1', 0.0, 0.0, z).step()
    assert _sent(scene) == [1]


def test_what_is_due_while_the_uav_climbs_is_not_sent_before_it_is_up(
    stage: Build, parameter: Make
) -> None:
    send = SendMessage(do='send_message', sender='uav1', receiver='ego')
    told = SendMessage(do='send_message', sender='van1', receiver='uav1')
    stated = {'provenance': Provenance.EXPLICIT, 'span': Span(start=0, end=1)}
    at_s = parameter(0.1, 's').model_copy(update=stated)
    timed = TimeTrigger(on='time', at_s=at_s)
    first = _event(TimeTrigger(on='time', at_s=parameter(0.0, 's')), told, id='e2')
    after = EventDoneTrigger(on='event_done', event='e2', after_s=at_s)
    handed_on = MessageTrigger(on='message_received', by='uav1')
    for trigger in (timed, after, handed_on):
        events = (first, _event(trigger, send))
        scene = stage(events=events, links=(('uav1', 'ego'), ('van1', 'uav1')))
        for z in (1.0, 5.0, 10.0, 14.5):  # it is to ascend to 30 m, and to track the van
            scene.fly('uav1', 15.0, 0.0, z).step()
        scene.fly('uav1', 15.0, 0.0, 30.0).put('van1', 15.0).step()
        own = [r.tick for o in scene.outputs for r in o.links if r.link == 'l0']
        assert own[:1] == [4], trigger


def test_who_has_landed_sends_nothing_at_a_stated_time(stage: Build, parameter: Make) -> None:
    stated = {'provenance': Provenance.EXPLICIT, 'span': Span(start=0, end=1)}
    at_s = parameter(200.0, 's').model_copy(update=stated)
    send = SendMessage(do='send_message', sender='uav1', receiver='ego')
    event = _event(TimeTrigger(on='time', at_s=at_s), send)
    land = _event(NOW, UavAction(do='land', uav='uav1'), id='e2')
    scene = stage(events=(event, land), links=(('uav1', 'ego'),))
    scene.fly('uav1', 0.0, 0.0, 0.0).step(4100)
    assert _sent(scene) == []


def test_a_vehicle_sends_without_a_sight_rule(stage: Build, parameter: Make) -> None:
    send = SendMessage(do='send_message', sender='ego', receiver='van1')
    event = _distance('distance_below', parameter).model_copy(update={'action': send})
    scene = stage(events=(event,), links=(('uav1', 'ego'), ('ego', 'van1')))
    scene.put('van1', 5.0).step(5)
    assert [r.link for o in scene.outputs for r in o.links][:1] == ['l1']


def test_a_message_goes_over_one_link_only(stage: Build, parameter: Make) -> None:
    send = SendMessage(do='send_message', sender='ego', receiver='van1')
    event = _event(TimeTrigger(on='time', at_s=parameter(0.0, 's')), send)
    scene = stage(events=(event,), links=(('ego', 'van1'), ('ego', 'van1')))
    scene.step(10)
    assert len(_sent(scene)) == 1


def test_a_delayed_alert_waits_its_delay(stage: Build, parameter: Make) -> None:
    event = _alert(parameter, delay_s=parameter(1.0, 's'))
    scene = stage(events=(event,), links=(('uav1', 'ego'),))
    scene.put('van1', 5.0).fly('uav1', 5.0, 0.0, 30.0).step(40)
    assert _triggered(scene) == [(0, 'e1')]
    assert _sent(scene) == [20]


SET = int(GroundCommandKind.SET_SPEED)
DECELERATION = int(GroundCommandKind.SET_DECELERATION)


def test_who_is_to_start_again_has_stood_for_the_time_of_a_stop(
    stage: Build, parameter: Make
) -> None:
    at = [TimeTrigger(on='time', at_s=parameter(s, 's')) for s in (0.1, 0.5)]
    stop, start = (AgentAction(do=do, agent='ego') for do in ('stop', 'start'))
    scene = stage(events=(_event(at[0], stop), _event(at[1], start, id='e2')))
    scene.put('ego', 0.0, speed=10.0).step(4)
    scene.put('ego', 1.0, speed=0.0).step(60)
    # It stands from tick 4 on, and 2 s are 40 ticks.
    assert [(t, s) for t, s, _ in scene.notes(ScenarioEventKind.ACTION)] == [(2, 'e1'), (44, 'e2')]


@pytest.mark.parametrize(
    ('action', 'speed', 'expected'),
    [
        ('stop', 10.0, [(SET, 0.0)]),
        ('yield', 10.0, [(SET, 0.0)]),
        ('brake', 10.0, [(DECELERATION, 6.0), (SET, 0.0)]),
        ('slow', 10.0, [(SET, 4.5)]),
        ('accelerate', 10.0, [(SET, 14.4)]),
        ('accelerate', 0.0, [(SET, 4.4)]),
        ('start', 0.0, [(int(GroundCommandKind.RELEASE_SPEED), 0.0)]),
    ],
)
def test_what_actions_command(
    action: str, speed: float, expected: list[tuple[int, float]], stage: Build
) -> None:
    event = _event(NOW, AgentAction(do=action, agent='ego'))  # type: ignore[arg-type]
    scene = stage(events=(event,), releases={'ego': (ReleaseOn.NEVER, '')})
    scene.put('ego', 0.0, speed=speed).step()
    found = [(kind, value) for _, agent, kind, value in scene.commands() if agent == 'ego']
    assert found[1:] == expected


@pytest.mark.parametrize('action', ['slow', 'accelerate', 'brake'])
def test_a_stated_speed_is_commanded(action: str, stage: Build, parameter: Make) -> None:
    wanted = AgentAction(do=action, agent='ego', value_mps=parameter(3.0, 'm/s'))  # type: ignore[arg-type]
    scene = stage(events=(_event(NOW, wanted),))
    scene.put('ego', 0.0, speed=10.0).step()
    assert scene.commands()[-1][2:] == (SET, 3.0)


def test_an_action_of_who_is_gone_commands_nothing(stage: Build) -> None:
    scene = stage(events=(_event(NOW, AgentAction(do='slow', agent='ego')),))
    scene.put('ego', 0.0, speed=10.0).remove('ego').step()
    assert [c for c in scene.commands() if c[2] == SET] == []


def test_land_ends_the_mission(stage: Build, parameter: Make) -> None:
    event = _event(
        TimeTrigger(on='time', at_s=parameter(1.0, 's')), UavAction(do='land', uav='uav1')
    )
    scene = stage(events=(event,))
    scene.put('van1', 0.0).fly('uav1', 0.0, 0.0, 30.0).follow(21)
    assert scene.machines[0].missions_done
    scene.follow(400)
    assert scene.outputs[-1].uav_commands[0, UavCommandColumn.MODE] == UavMode.IDLE
    assert scene.machines[0].landed


def test_who_hovers_until_something_happens_does_not_land_before(
    stage: Build, parameter: Make
) -> None:
    at = TimeTrigger(on='time', at_s=parameter(20.0, 's'))
    event = _event(at, UavAction(do='land', uav='uav1'))
    scene = stage(hold_s=2.0, hold_said=False, events=(event,))
    scene.follow(450)
    phases = {detail: tick for tick, _, detail in scene.notes(ScenarioEventKind.PHASE)}
    assert phases['landing'] == 20.0 / 0.05 + 1  # the command of tick 400 is flown at 401


def test_who_lands_once_its_missions_are_done_does_not_wait_for_itself(stage: Build) -> None:
    done = MissionDoneTrigger(on='mission_done', uav='uav1')
    start = _event(done, AgentAction(do='start', agent='ego'))
    after = EventDoneTrigger(on='event_done', event='e1')
    scene = stage(
        hold_s=2.0,
        hold_said=False,
        events=(start, _event(after, UavAction(do='land', uav='uav1'), id='e2')),
    )
    scene.follow(800)
    assert scene.machines[0].landed


def _land(uav: str, number: int) -> Event:
    return _event(None, UavAction(do='land', uav=uav), id=f'e{number}')


def test_a_landing_of_which_nobody_says_when_comes_after_the_missions(stage: Build) -> None:
    scene = stage(hold_s=2.0, events=(_land('uav1', 1),))
    scene.follow(4000 // 5)
    phases = {detail: tick for tick, _, detail in scene.notes(ScenarioEventKind.PHASE)}
    assert [t for t, _, _ in scene.notes(ScenarioEventKind.ACTION)] == [phases['landing']]
    assert phases['landing'] - scene.machines[0].first_capture_tick >= 2.0 / 0.05 - 1


def test_who_lands_second_stays_up_until_the_first_has_begun_to_land(stage: Build) -> None:
    scene = stage(
        tracks={'uav1': 'van1', 'uav2': 'ego'},
        hold_s=2.0,
        landing_spots=((0.0, 0.0), (60.0, 0.0)),
        events=(_land('uav1', 1), _land('uav2', 2)),
        orders=(Order(id='o1', first='e2', then='e1'),),
    )
    # The van is near and the ego far: the first one is ready long before the second one.
    scene.put('ego', 200.0).follow(1200)
    landed = {
        uav: tick for tick, uav, to in scene.notes(ScenarioEventKind.PHASE) if to == 'landing'
    }
    captured = {m.plan.id: m.first_capture_tick for m in scene.machines}
    assert captured['uav1'] + 2.0 / 0.05 < landed['uav2'] < landed['uav1'] <= landed['uav2'] + 3
    assert all(m.landed for m in scene.machines)


def test_an_event_waits_for_what_comes_before_it(stage: Build, parameter: Make) -> None:
    late = TimeTrigger(on='time', at_s=parameter(0.5, 's'))
    scene = stage(
        events=(
            _event(NOW, id='e1'),
            _event(late, AgentAction(do='start', agent='ego'), id='e2'),
        ),
        orders=(Order(id='o1', first='e2', then='e1'),),
    )
    scene.step(20)
    # A trigger is noted when it holds. The ego has not set off yet, though it was told to.
    assert _triggered(scene) == [(0, 'e1'), (10, 'e2')]
    assert [(t, name) for t, name, _ in scene.notes(ScenarioEventKind.ACTION)] == [(10, 'e2')]
    scene.put('ego', 0.0, speed=0.6).step(2)
    done = [(tick, name) for tick, name, _ in scene.notes(ScenarioEventKind.ACTION)]
    assert done == [(10, 'e2'), (21, 'e1')]


@pytest.mark.parametrize(('on', 'waits'), [('speed_above', True), ('speed_below', False)])
def test_a_message_about_who_is_told_is_awaited_unless_it_waits_for_him(
    stage: Build, parameter: Make, on: str, waits: bool
) -> None:
    values = {'on': on, 'who': 'ego', 'value_mps': parameter(15.0, 'm/s')}
    send = SendMessage(do='send_message', sender='van1', receiver='ego')
    scene = stage(
        events=(
            _event(SpeedTrigger.model_validate(values), send, id='e1'),
            _event(None, AgentAction(do='slow', agent='ego'), id='e2'),
        ),
        links=(('van1', 'ego'),),
    )
    # Just at the number nothing is triggered by getting slower, and nothing is faster.
    scene.put('ego', 0.0, speed=14.9 if waits else 15.1).put('van1', 30.0, speed=10.0).follow(500)
    acted = {name for _, name, _ in scene.notes(ScenarioEventKind.ACTION)}
    assert acted == (set() if waits else {'e2'})


@pytest.mark.parametrize('told', ['van1', 'ego'])
def test_who_is_told_something_and_does_something_does_it_upon_that(
    stage: Build, parameter: Make, told: str
) -> None:
    at = TimeTrigger(on='time', at_s=parameter(20.0, 's'))
    sender = 'ego' if told == 'van1' else 'van1'
    send = SendMessage(do='send_message', sender=sender, receiver=told)
    scene = stage(
        events=(
            _event(at, send, id='e1'),
            _event(None, AgentAction(do='stop', agent='ego'), id='e2'),
        ),
        links=((sender, told),),
    )
    scene.put('ego', 0.0, speed=10.0).put('van1', 30.0, speed=10.0).follow(500)
    acted = {name: tick for tick, name, _ in scene.notes(ScenarioEventKind.ACTION)}
    assert acted['e1'] == 400
    assert (acted['e2'] > 400) is (told == 'ego')


def test_who_is_to_climb_after_its_missions_lands_from_there(
    stage: Build, parameter: Make
) -> None:
    climb = _event(
        MissionDoneTrigger(on='mission_done', uav='uav1'),
        UavAction(do='ascend', uav='uav1', altitude_m=parameter(45.0)),
    )
    scene = stage(hold_s=2.0, landing_spots=((60.0, 0.0),), events=(climb,))
    track = []
    for _ in range(1500):
        scene.follow()
        track.append(scene.uav[0, :3].tolist())
    top = max(range(len(track)), key=lambda k: track[k][2])
    assert track[top][2] == pytest.approx(45.0, abs=1.0)
    assert abs(track[top][0]) < 1.0  # above where its mission ended
    across = [z for x, _, z in track[top:] if 5.0 < x < 55.0]
    assert min(across) >= 43.9  # the way to the spot is flown up there
    assert scene.machines[0].landed


def _brakes(event_id: str, trigger: Any, agent: str = 'ego') -> Event:
    return Event(id=event_id, trigger=trigger, action=AgentAction(do='brake', agent=agent))


def test_what_waits_for_a_body_that_nobody_placed_never_happens(
    stage: Build, parameter: Make
) -> None:
    """Pedestrians are not placed yet: their events are told as not carried out, nothing breaks."""
    near, fast, sight = parameter(10.0), parameter(1.0, 'm/s'), {'observer': 'uav1'}
    events = (
        _brakes('speed', SpeedTrigger(on='speed_above', who='walker', value_mps=fast)),
        _brakes('near', DistanceTrigger(on='distance_below', a='walker', b='ego', value_m=near)),
        _brakes('far', DistanceTrigger(on='distance_above', a='ego', b='walker', value_m=near)),
        _brakes('seen', VisibilityTrigger(on='visible', target='walker', **sight)),
        _brakes('lost', VisibilityTrigger(on='occluded', target='walker', **sight)),
        _brakes('there', ArrivalTrigger(on='arrives', who='walker', place='intersection')),
        _brakes('told', MessageTrigger(on='message_received', by='walker')),
        _brakes('own', None, agent='walker'),
        Event(id='send', action=SendMessage(do='send_message', sender='walker', receiver='ego')),
        _brakes('after', EventDoneTrigger(on='event_done', event='own')),
    )
    made = stage(events=events, absent=('walker',), links=(('walker', 'ego'),))
    made.put('van1', 0.0, speed=8.0).put('ego', 20.0, speed=8.0)
    made.follow(600)
    assert made.notes(ScenarioEventKind.TRIGGERED) == []
    assert made.notes(ScenarioEventKind.ACTION) == []


def test_a_run_does_not_wait_for_what_cannot_happen(stage: Build) -> None:
    events = (_brakes('own', None, agent='walker'),)
    made = stage(events=events, absent=('walker',), hold_s=2.0, horizon_ticks=4000)
    made.put('van1', 0.0).put('ego', 20.0)
    made.follow(1500)
    assert next(detail for _, _, detail in made.notes(ScenarioEventKind.FINISHED)) == 'finished'


@pytest.mark.parametrize('changes', [True, False])
def test_what_changes_a_flight_waits_until_that_has_begun(
    stage: Build, parameter: Make, changes: bool
) -> None:
    """A UAV that sees the van on its way to its place: no reason to leave that yet."""
    near = DistanceTrigger(on='distance_below', a='uav1', b='van1', value_m=parameter(200.0))
    climb = UavAction(do='ascend', uav='uav1', altitude_m=parameter(50.0))
    scene = stage(events=(_event(near, climb if changes else None),))
    scene.put('van1', 10.0).fly('uav1', 90.0, 0.0, 29.0).step(3)
    assert _triggered(scene) == ([] if changes else [(0, 'e1')])
    if changes:
        machine = scene.machines[0]
        scene.fly('uav1', 10.0, 0.0, 30.0).step(4)
        assert machine.first_capture_tick is not None
        assert [tick for tick, _ in _triggered(scene)] == [machine.first_capture_tick]


def test_who_takes_over_has_done_so_once_it_is_there(stage: Build, parameter: Make) -> None:
    """The first one leaves when the second one tracks, not when that takes off."""
    comes = TimeTrigger(on='time', at_s=parameter(1.0, 's'))
    takes = UavAction(do='change_mission', uav='uav1', mission='m0')
    leaves = EventDoneTrigger(on='event_done', event='e1')
    over = _event(comes, takes)
    scene = stage(events=(over, _event(leaves, AgentAction(do='stop', agent='ego'), id='e2')))
    scene.put('van1', 60.0).follow(400)
    machine = scene.machines[0]
    assert machine.first_capture_tick is not None
    assert machine.first_capture_tick > 40
    assert _triggered(scene) == [(20, 'e1'), (machine.first_capture_tick, 'e2')]
