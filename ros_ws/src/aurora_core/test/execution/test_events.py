# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Events: each trigger, and when what waits for it begins."""

from __future__ import annotations

import pytest
from events_by_hand import NOW, WALL, Build, Make, distance_event, event_of, triggered

from aurora_core.execution.untold import least_mps
from aurora_core.spec.scenario import (
    AgentAction,
    AltitudeTrigger,
    ArrivalTrigger,
    BatteryTrigger,
    Behavior,
    DistanceTrigger,
    EventDoneTrigger,
    MessageTrigger,
    MissionDoneTrigger,
    SendMessage,
    SpeedTrigger,
    TimeTrigger,
    VisibilityTrigger,
)
from aurora_core.spec.vocabulary import BehaviorKind
from aurora_core.trace.layout import GroundCommandKind
from aurora_core.trace.records import LinkEventKind, ScenarioEventKind


def test_event_of_without_a_trigger_begins_once_the_uavs_watch(stage: Build) -> None:
    scene = stage(events=(event_of(None, AgentAction(do='start', agent='ego')),))
    scene.put('van1', 5.0).step(3)
    assert triggered(scene) == []
    scene.fly('uav1', 0.0, 0.0, 30.0).step()
    assert scene.machines[0].captured
    assert triggered(scene) == [(3, 'e1')]
    assert [t for t, _, _ in scene.notes(ScenarioEventKind.ACTION)] == [3]


def test_without_uavs_event_of_without_a_trigger_begins_at_the_start(stage: Build) -> None:
    scene = stage(tracks={}, events=(event_of(None, AgentAction(do='start', agent='ego')),))
    scene.step()
    assert triggered(scene) == [(0, 'e1')]


def test_who_is_to_brake_some_time_is_on_the_move_first(stage: Build) -> None:
    scene = stage(tracks={}, events=(event_of(None, AgentAction(do='brake', agent='ego')),))
    for speed in (0.0, 4.9, 5.0):
        scene.put('ego', 0.0, speed=speed).step()
    assert triggered(scene) == [(2, 'e1')]


@pytest.mark.parametrize('at_s', [0.0, 0.05, 0.3, 0.35, 2.0])
def test_time(at_s: float, stage: Build, parameter: Make) -> None:
    scene = stage(events=(event_of(TimeTrigger(on='time', at_s=parameter(at_s, 's'))),))
    scene.step(50)
    assert triggered(scene) == [(round(at_s / 0.05), 'e1')]


def test_distance_below(stage: Build, parameter: Make) -> None:
    scene = stage(events=(distance_event('distance_below', parameter),))
    for x in (40.0, 20.001, 20.0, 5.0):
        scene.put('van1', x).step()
    assert triggered(scene) == [(2, 'e1')]


def test_distance_below_holds_from_the_start(stage: Build, parameter: Make) -> None:
    scene = stage(events=(distance_event('distance_below', parameter),))
    scene.put('van1', 5.0).step()
    assert triggered(scene) == [(0, 'e1')]


def test_distance_above_asks_for_a_change(stage: Build, parameter: Make) -> None:
    scene = stage(events=(distance_event('distance_above', parameter),))
    # To a millimetre it is no farther than that.
    for x in (30.0, 30.0, 19.0, 19.9, 20.001, 20.02):
        scene.put('van1', x).step()
    assert triggered(scene) == [(5, 'e1')]


def test_distance_to_a_place(stage: Build, parameter: Make) -> None:
    scene = stage(events=(distance_event('distance_below', parameter, 'intersection'),))
    for x in (250.0, 281.0):
        scene.put('van1', x).step()
    assert triggered(scene) == [(1, 'e1')]


def test_distance_is_in_space(stage: Build, parameter: Make) -> None:
    trigger = DistanceTrigger(on='distance_below', a='uav1', b='van1', value_m=parameter(50.0))
    scene = stage(events=(event_of(trigger),))
    scene.fly('uav1', 0.0, 0.0, 30.0).put('van1', 41.0).step()
    scene.put('van1', 39.0).step()
    assert triggered(scene) == [(1, 'e1')]


def test_a_body_that_is_gone_is_at_no_distance(stage: Build, parameter: Make) -> None:
    scene = stage(events=(distance_event('distance_below', parameter),))
    scene.put('van1', 5.0).remove('van1').step(3)
    assert triggered(scene) == []


def test_altitude(stage: Build, parameter: Make) -> None:
    trigger = AltitudeTrigger(on='altitude_reached', uav='uav1', value_m=parameter(25.0))
    scene = stage(events=(event_of(trigger),))
    for z in (0.0, 23.99, 24.0):  # what it holds there may never quite exceed 25 m
        scene.fly('uav1', 0.0, 0.0, z).step()
    assert triggered(scene) == [(2, 'e1')]


def test_speed_above_and_below(stage: Build, parameter: Make) -> None:
    events = (
        event_of(
            SpeedTrigger(on='speed_above', who='ego', value_mps=parameter(5.0, 'm/s')), id='e1'
        ),
        event_of(
            SpeedTrigger(on='speed_below', who='ego', value_mps=parameter(2.0, 'm/s')), id='e2'
        ),
    )
    scene = stage(events=events)
    for speed in (0.0, 4.9, 5.0, 3.0, 2.0):
        scene.put('ego', 0.0, speed=speed).step()
    # Standing at the start is no slowing down.
    assert triggered(scene) == [(2, 'e1'), (4, 'e2')]


def test_the_speed_of_who_is_gone_counts_for_nothing(stage: Build, parameter: Make) -> None:
    trigger = SpeedTrigger(on='speed_above', who='ego', value_mps=parameter(5.0, 'm/s'))
    scene = stage(events=(event_of(trigger),))
    scene.put('ego', 0.0, speed=9.0).remove('ego').step(3)
    assert triggered(scene) == []


def test_speed_of_a_uav(stage: Build, parameter: Make) -> None:
    trigger = SpeedTrigger(on='speed_above', who='uav1', value_mps=parameter(5.0, 'm/s'))
    scene = stage(events=(event_of(trigger),))
    scene.fly('uav1', 0.0, 0.0, 30.0).step()
    scene.uav[0, 3:6] = (3.0, 0.0, 4.0)
    scene.step()
    assert triggered(scene) == [(1, 'e1')]


def test_a_battery_is_counted_from_take_off(stage: Build, parameter: Make) -> None:
    trigger = BatteryTrigger(on='battery_below', uav='uav1', value=parameter(0.9, '1'))
    scene = stage(events=(event_of(trigger),))
    scene.step(30)  # on the ground it stays full
    scene.fly('uav1', 0.0, 0.0, 5.0).step(40)
    # A full one lasts 10 s here: after 20 ticks of 0.05 s in the air 0.9 is left, then less.
    assert triggered(scene) == [(50, 'e1')]


def test_arrival(stage: Build) -> None:
    scene = stage(
        events=(event_of(ArrivalTrigger(on='arrives', who='ego', place='intersection')),)
    )
    for x in (280.0, 290.0):
        scene.put('ego', x).step()
    assert triggered(scene) == [(1, 'e1')]


def test_arrival_on_a_sidewalk_is_the_one_that_is_stepped_onto(stage: Build) -> None:
    """Who crosses a street stands on the sidewalk at first: that is no arrival."""
    event = event_of(ArrivalTrigger(on='arrives', who='ego', place='sidewalk'))
    scene = stage(events=(event,), sidewalks_x_m=((-10.0, 0.0), (8.0, 12.0)))
    for x in (-2.0, -1.0, 1.0, 7.0, 8.5, 9.0):
        scene.put('ego', x).step()
    assert triggered(scene) == [(4, 'e1')]


def test_visible_counts_from_the_end_of_the_ascent(stage: Build) -> None:
    trigger = VisibilityTrigger(on='visible', observer='uav1', target='van1')
    scene = stage(events=(event_of(trigger),))
    scene.put('van1', 10.0).fly('uav1', 0.0, 0.0, 20.0).step(3)
    scene.fly('uav1', 0.0, 0.0, 29.0).step()
    assert triggered(scene) == [(3, 'e1')]


def test_occluded_asks_for_sight_before(stage: Build) -> None:
    trigger = VisibilityTrigger(on='occluded', observer='uav1', target='van1')
    scene = stage(events=(event_of(trigger),), buildings=(WALL,))
    scene.put('van1', 10.0).fly('uav1', 0.0, 0.0, 30.0).step(2)
    assert triggered(scene) == []
    scene.put('van1', 100.0).step()
    assert triggered(scene) == [(2, 'e1')]


def test_who_was_never_seen_is_not_lost_from_sight(stage: Build) -> None:
    trigger = VisibilityTrigger(on='occluded', observer='uav1', target='van1')
    scene = stage(events=(event_of(trigger),), buildings=(WALL,))
    scene.put('van1', 100.0).step(2)  # on the ground nothing is seen, nor from up there
    scene.fly('uav1', 0.0, 0.0, 30.0).step(3)
    assert triggered(scene) == []
    scene.put('van1', 10.0).step()
    scene.put('van1', 100.0).step()
    assert triggered(scene) == [(6, 'e1')]


@pytest.mark.parametrize(('x', 'seen'), [(30.0, [(0, 'e1')]), (-30.0, []), (100.0, [])])
def test_a_driver_sees_at_once_what_is_ahead_and_not_behind_a_wall(
    stage: Build, x: float, seen: list[tuple[int, str]]
) -> None:
    trigger = VisibilityTrigger(on='visible', observer='ego', target='van1')
    scene = stage(events=(event_of(trigger),), buildings=(WALL,))
    scene.put('ego', 0.0).put('van1', x).step(2)
    assert triggered(scene) == seen


def test_a_driver_loses_sight_of_whom_it_has_passed(stage: Build) -> None:
    trigger = VisibilityTrigger(on='occluded', observer='ego', target='van1')
    scene = stage(events=(event_of(trigger),))
    for x in (-30.0, 30.0, 10.0, -10.0):  # behind it from the start on is no loss
        scene.put('ego', 0.0).put('van1', x).step()
    assert triggered(scene) == [(3, 'e1')]


def test_on_its_way_home_a_uav_loses_nobody_from_sight(stage: Build) -> None:
    trigger = VisibilityTrigger(on='occluded', observer='uav1', target='van1')
    scene = stage(events=(event_of(trigger),), buildings=(WALL,), hold_s=0.2)
    scene.put('van1', 10.0).fly('uav1', 10.0, 0.0, 30.0).step(20)
    assert scene.machines[0].is_landing
    scene.put('van1', 100.0).step(5)
    assert triggered(scene) == []


def test_who_stands_brakes_once_it_drives(stage: Build) -> None:
    scene = stage(events=(event_of(NOW, AgentAction(do='brake', agent='ego')),))
    scene.step(3)
    assert triggered(scene) == [(0, 'e1')]
    assert scene.notes(ScenarioEventKind.ACTION) == []
    scene.put('ego', 0.0, speed=8.0).step()
    assert [t for t, _, _ in scene.notes(ScenarioEventKind.ACTION)] == [3]


def test_a_crossing_is_done_at_the_other_kerb(stage: Build) -> None:
    events = (
        event_of(NOW, AgentAction(do='cross', agent='ego')),
        event_of(EventDoneTrigger(on='event_done', event='e1'), id='e2'),
        event_of(EventDoneTrigger(on='event_begun', event='e1'), id='e3'),
    )
    scene = stage(events=events, tracks={}, street_x_m=(5.0, 15.0))
    # On the way to the crossing it steps over the kerb and back.
    for x in (0.0, 5.1, 4.9, 6.0, 14.0, 16.0, 17.0):
        scene.put('ego', x, speed=1.4).step()
    assert triggered(scene) == [(0, 'e1'), (1, 'e3'), (5, 'e2')]


def test_message_received(stage: Build, parameter: Make) -> None:
    send = SendMessage(do='send_message', sender='van1', receiver='ego')
    events = (
        event_of(TimeTrigger(on='time', at_s=parameter(0.5, 's')), send, id='e1'),
        event_of(MessageTrigger(on='message_received', by='ego'), id='e2'),
        event_of(MessageTrigger(on='message_received', by='ego', sender='van1'), id='e3'),
        event_of(MessageTrigger(on='message_received', by='ego', sender='uav1'), id='e4'),
        event_of(MessageTrigger(on='message_received', by='van1'), id='e5'),
    )
    scene = stage(events=events, links=(('van1', 'ego'),))
    scene.put('ego', 30.0).step(40)
    delivered = [
        r.tick for o in scene.outputs for r in o.links if r.kind is LinkEventKind.DELIVERED
    ]
    assert delivered == [12]
    assert triggered(scene) == [(10, 'e1'), (13, 'e2'), (13, 'e3')]


def test_event_done_with_a_delay(stage: Build, parameter: Make) -> None:
    stop = AgentAction(do='stop', agent='ego')
    events = (
        event_of(
            TimeTrigger(on='time', at_s=parameter(1.0, 's')),
            stop,
            id='e1',
            delay_s=parameter(0.5, 's'),
        ),
        event_of(
            EventDoneTrigger(on='event_done', event='e1', after_s=parameter(2.0, 's')), id='e2'
        ),
        event_of(EventDoneTrigger(on='event_done', event='e1'), id='e3'),
    )
    scene = stage(events=events)
    scene.step(100)
    # The ego stands: at once nothing is left to be done.
    assert triggered(scene) == [(20, 'e1'), (30, 'e3'), (70, 'e2')]
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
        event_of(TimeTrigger(on='time', at_s=parameter(1.0, 's')), action, id='e1'),
        event_of(EventDoneTrigger(on='event_done', event='e1'), id='e2'),
        event_of(EventDoneTrigger(on='event_begun', event='e1'), id='e3'),
    )
    scene = stage(events=events)
    scene.put('ego', 0.0, speed=before_mps).step(40)
    assert triggered(scene) == [(20, 'e1'), (21, 'e3')]
    scene.put('ego', 0.0, speed=done_mps).step(10)
    assert triggered(scene) == [(20, 'e1'), (21, 'e3'), (40, 'e2')]


def test_mission_done(stage: Build) -> None:
    scene = stage(
        events=(event_of(MissionDoneTrigger(on='mission_done', uav='uav1')),), hold_s=1.0
    )
    scene.put('van1', 0.0).fly('uav1', 0.0, 0.0, 30.0).step(40)
    [(tick, _)] = triggered(scene)
    phases = {d: t for t, _, d in scene.notes(ScenarioEventKind.PHASE)}
    assert tick == phases['landing'] + 1  # when the record shows it


def test_event_of_happens_once(stage: Build, parameter: Make) -> None:
    event = distance_event('distance_below', parameter).model_copy(
        update={'action': AgentAction(do='stop', agent='ego')}
    )
    scene = stage(events=(event,))
    for x in (5.0, 50.0, 5.0, 50.0, 5.0):
        scene.put('van1', x).step()
    assert len(triggered(scene)) == 1
    assert [c for c in scene.commands() if c[2] == GroundCommandKind.SET_SPEED] == [
        (0, 'ego', int(GroundCommandKind.SET_SPEED), 0.0)
    ]


@pytest.mark.parametrize('stands_s', [None, 4.0])
def test_a_person_who_stops_on_his_walk_crosses_when_he_has_stood(
    stands_s: float | None, stage: Build, parameter: Make
) -> None:
    """That he halts at the kerb is the stop; a stop that lasts a stated time comes to its end."""
    lasts = None if stands_s is None else parameter(stands_s, 's')
    stop = Behavior(kind=BehaviorKind.STOP, target='crosswalk', duration_s=lasts)
    stops = event_of(None, AgentAction(do='stop', agent='ego'))
    done = EventDoneTrigger(on='event_done', event='e1')
    crosses = event_of(done, AgentAction(do='cross', agent='ego'), id='e2')
    scene = stage(
        tracks={},
        events=(stops, crosses),
        behaviors={'ego': (stop,)},
        halts={'ego': (5.0, 0.0)},
        speeds={'ego': 1.2},
    )
    for x, speed in ((0.0, 1.2), (4.0, 1.2), (4.8, 1.2), (4.9, 0.0)):
        scene.put('ego', x, speed=speed).step()
    scene.step(100)
    stands = 2.0 if stands_s is None else stands_s
    assert triggered(scene)[0] == (3, 'e1')
    ((tick, name),) = triggered(scene)[1:]
    assert name == 'e2'
    assert 0.05 * (tick - 3) == pytest.approx(stands, abs=0.1)
    assert scene.commands()[-1] == (tick, 'ego', int(GroundCommandKind.SET_SPEED), 1.2)


def test_a_person_is_on_the_move_when_he_walks() -> None:
    """Nobody walks at 5 m/s: a stop of which nobody says when would never come."""
    stop = AgentAction(do='stop', agent='ego')
    assert least_mps(stop, is_person=True) < 1.0
    assert least_mps(stop, is_person=False) == pytest.approx(5.0)
