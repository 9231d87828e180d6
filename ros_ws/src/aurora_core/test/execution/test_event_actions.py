# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Events: alerts and their sight rule, what actions command, what waits for whom."""

from __future__ import annotations

from typing import Any

import pytest
from events_by_hand import NOW, WALL, Build, Make, distance_event, event_of, triggered

from aurora_core.outcomes.grounded import ReleaseOn
from aurora_core.spec.parameter import Provenance, Span
from aurora_core.spec.scenario import (
    AgentAction,
    AltitudeTrigger,
    ArrivalTrigger,
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


def _alert(parameter: Make, **fields: Any) -> Event:
    return distance_event('distance_below', parameter).model_copy(
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
    assert triggered(scene) == [(0, 'e1')]
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
    assert triggered(scene)
    assert _sent(scene) == []
    scene.fly('uav1', 20.0, 0.0, 30.0).step()
    assert _sent(scene) == [5]


def test_a_uav_reports_its_own_altitude_on_its_way_up(stage: Build, parameter: Make) -> None:
    trigger = AltitudeTrigger(on='altitude_reached', uav='uav1', value_m=parameter(15.0))
    event = event_of(trigger, SendMessage(do='send_message', sender='uav1', receiver='ego'))
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
    first = event_of(TimeTrigger(on='time', at_s=parameter(0.0, 's')), told, id='e2')
    after = EventDoneTrigger(on='event_done', event='e2', after_s=at_s)
    handed_on = MessageTrigger(on='message_received', by='uav1')
    for trigger in (timed, after, handed_on):
        events = (first, event_of(trigger, send))
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
    event = event_of(TimeTrigger(on='time', at_s=at_s), send)
    land = event_of(NOW, UavAction(do='land', uav='uav1'), id='e2')
    scene = stage(events=(event, land), links=(('uav1', 'ego'),))
    scene.fly('uav1', 0.0, 0.0, 0.0).step(4100)
    assert _sent(scene) == []


def test_a_vehicle_sends_without_a_sight_rule(stage: Build, parameter: Make) -> None:
    send = SendMessage(do='send_message', sender='ego', receiver='van1')
    event = distance_event('distance_below', parameter).model_copy(update={'action': send})
    scene = stage(events=(event,), links=(('uav1', 'ego'), ('ego', 'van1')))
    scene.put('van1', 5.0).step(5)
    assert [r.link for o in scene.outputs for r in o.links][:1] == ['l1']


def test_a_message_goes_over_one_link_only(stage: Build, parameter: Make) -> None:
    send = SendMessage(do='send_message', sender='ego', receiver='van1')
    event = event_of(TimeTrigger(on='time', at_s=parameter(0.0, 's')), send)
    scene = stage(events=(event,), links=(('ego', 'van1'), ('ego', 'van1')))
    scene.step(10)
    assert len(_sent(scene)) == 1


def test_a_delayed_alert_waits_its_delay(stage: Build, parameter: Make) -> None:
    event = _alert(parameter, delay_s=parameter(1.0, 's'))
    scene = stage(events=(event,), links=(('uav1', 'ego'),))
    scene.put('van1', 5.0).fly('uav1', 5.0, 0.0, 30.0).step(40)
    assert triggered(scene) == [(0, 'e1')]
    assert _sent(scene) == [20]


SET = int(GroundCommandKind.SET_SPEED)
DECELERATION = int(GroundCommandKind.SET_DECELERATION)


def test_who_is_to_start_again_has_stood_for_the_time_of_a_stop(
    stage: Build, parameter: Make
) -> None:
    at = [TimeTrigger(on='time', at_s=parameter(s, 's')) for s in (0.1, 0.5)]
    stop, start = (AgentAction(do=do, agent='ego') for do in ('stop', 'start'))
    scene = stage(events=(event_of(at[0], stop), event_of(at[1], start, id='e2')))
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
    event = event_of(NOW, AgentAction(do=action, agent='ego'))  # type: ignore[arg-type]
    scene = stage(events=(event,), releases={'ego': (ReleaseOn.NEVER, '')})
    scene.put('ego', 0.0, speed=speed).step()
    found = [(kind, value) for _, agent, kind, value in scene.commands() if agent == 'ego']
    assert found[1:] == expected


@pytest.mark.parametrize('action', ['slow', 'accelerate', 'brake'])
def test_a_stated_speed_is_commanded(action: str, stage: Build, parameter: Make) -> None:
    wanted = AgentAction(do=action, agent='ego', value_mps=parameter(3.0, 'm/s'))  # type: ignore[arg-type]
    scene = stage(events=(event_of(NOW, wanted),))
    scene.put('ego', 0.0, speed=10.0).step()
    assert scene.commands()[-1][2:] == (SET, 3.0)


def test_an_action_of_who_is_gone_commands_nothing(stage: Build) -> None:
    scene = stage(events=(event_of(NOW, AgentAction(do='slow', agent='ego')),))
    scene.put('ego', 0.0, speed=10.0).remove('ego').step()
    assert [c for c in scene.commands() if c[2] == SET] == []


def test_land_ends_the_mission(stage: Build, parameter: Make) -> None:
    event = event_of(
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
    event = event_of(at, UavAction(do='land', uav='uav1'))
    scene = stage(hold_s=2.0, hold_said=False, events=(event,))
    scene.follow(450)
    phases = {detail: tick for tick, _, detail in scene.notes(ScenarioEventKind.PHASE)}
    assert phases['landing'] == 20.0 / 0.05 + 1  # the command of tick 400 is flown at 401


def test_who_lands_once_its_missions_are_done_does_not_wait_for_itself(stage: Build) -> None:
    done = MissionDoneTrigger(on='mission_done', uav='uav1')
    start = event_of(done, AgentAction(do='start', agent='ego'))
    after = EventDoneTrigger(on='event_done', event='e1')
    scene = stage(
        hold_s=2.0,
        hold_said=False,
        events=(start, event_of(after, UavAction(do='land', uav='uav1'), id='e2')),
    )
    scene.follow(800)
    assert scene.machines[0].landed


def _land(uav: str, number: int) -> Event:
    return event_of(None, UavAction(do='land', uav=uav), id=f'e{number}')


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


def test_event_of_waits_for_what_comes_before_it(stage: Build, parameter: Make) -> None:
    late = TimeTrigger(on='time', at_s=parameter(0.5, 's'))
    scene = stage(
        events=(
            event_of(NOW, id='e1'),
            event_of(late, AgentAction(do='start', agent='ego'), id='e2'),
        ),
        orders=(Order(id='o1', first='e2', then='e1'),),
    )
    scene.step(20)
    # A trigger is noted when it holds. The ego has not set off yet, though it was told to.
    assert triggered(scene) == [(0, 'e1'), (10, 'e2')]
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
            event_of(SpeedTrigger.model_validate(values), send, id='e1'),
            event_of(None, AgentAction(do='slow', agent='ego'), id='e2'),
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
            event_of(at, send, id='e1'),
            event_of(None, AgentAction(do='stop', agent='ego'), id='e2'),
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
    climb = event_of(
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
    scene = stage(events=(event_of(near, climb if changes else None),))
    scene.put('van1', 10.0).fly('uav1', 90.0, 0.0, 29.0).step(3)
    assert triggered(scene) == ([] if changes else [(0, 'e1')])
    if changes:
        machine = scene.machines[0]
        scene.fly('uav1', 10.0, 0.0, 30.0).step(4)
        assert machine.first_capture_tick is not None
        assert [tick for tick, _ in triggered(scene)] == [machine.first_capture_tick]


def test_who_takes_over_has_done_so_once_it_is_there(stage: Build, parameter: Make) -> None:
    """The first one leaves when the second one tracks, not when that takes off."""
    comes = TimeTrigger(on='time', at_s=parameter(1.0, 's'))
    takes = UavAction(do='change_mission', uav='uav1', mission='m0')
    leaves = EventDoneTrigger(on='event_done', event='e1')
    over = event_of(comes, takes)
    scene = stage(events=(over, event_of(leaves, AgentAction(do='stop', agent='ego'), id='e2')))
    scene.put('van1', 60.0).follow(400)
    machine = scene.machines[0]
    assert machine.first_capture_tick is not None
    assert machine.first_capture_tick > 40
    assert triggered(scene) == [(20, 'e1'), (machine.first_capture_tick, 'e2')]
