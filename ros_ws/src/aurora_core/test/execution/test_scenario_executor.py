# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Release, flight, links, sight claims and the end of a run."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from pydantic import TypeAdapter

from aurora_core.knowledge.map_types import Building
from aurora_core.outcomes.grounded import ReleaseOn
from aurora_core.spec.parameter import Parameter
from aurora_core.spec.prohibitions import Prohibition
from aurora_core.spec.scenario import AgentAction, Behavior, Event, SendMessage, TimeTrigger
from aurora_core.spec.vocabulary import BehaviorKind
from aurora_core.trace.layout import GroundCommandKind, UavCommandColumn, UavMode, UavPhase
from aurora_core.trace.records import LinkEventKind, LossReason, ScenarioEventKind

SET, RELEASE = int(GroundCommandKind.SET_SPEED), int(GroundCommandKind.RELEASE_SPEED)

# Between x = 40 and 60, far higher than the UAV.
WALL = Building(
    id='wall',
    ring=((40.0, -50.0), (60.0, -50.0), (60.0, 50.0), (40.0, 50.0)),
    holes=(),
    height_m=100.0,
    height_source='',
    kind='block',
    name='',
)


def _message_at(make: Callable[..., Parameter], at_s: float, sender: str, receiver: str) -> Event:
    return Event(
        id='e1',
        trigger=TimeTrigger(on='time', at_s=make(at_s, 's')),
        action=SendMessage(do='send_message', sender=sender, receiver=receiver),
    )


def test_held_agents_stand_and_free_ones_drive_from_the_start(stage: Callable[..., Any]) -> None:
    scene = stage(releases={'van1': (ReleaseOn.CAPTURED, 'uav1')}, speeds={'ego': 7.0})
    scene.put('van1', 100.0).put('ego', 200.0).step()
    assert scene.commands() == [(0, 'van1', SET, 0.0), (0, 'ego', SET, 7.0)]
    scene.step(5)
    assert len(scene.commands()) == 2  # said once


@pytest.mark.parametrize(
    ('kind', 'gently'), [('brake', True), ('stop', True), ('overtake', False)]
)
def test_who_must_not_brake_slows_down_gently_behind_others(
    stage: Callable[..., Any], kind: str, gently: bool
) -> None:
    no = {'forbids': 'behavior', 'id': 'no1', 'agent': 'ego', 'kind': kind, 'target': None}
    no |= {'target': 'van1'} if kind == 'overtake' else {}
    scene = stage(prohibitions=(TypeAdapter(Prohibition).validate_python(no),))
    scene.step(2)
    softer = int(GroundCommandKind.SET_DECELERATION)
    asked = [(agent, value) for _, agent, what, value in scene.commands() if what == softer]
    assert asked == ([('ego', 3.0)] if gently else [])


def test_release_on_capture_not_before(stage: Callable[..., Any]) -> None:
    scene = stage(releases={'van1': (ReleaseOn.CAPTURED, 'uav1')})
    scene.put('van1', 100.0).fly('uav1', 0.0, 0.0, 30.0).step(3)
    assert scene.machines[0].ascended_tick == 0
    assert scene.notes(ScenarioEventKind.RELEASED) == []
    scene.fly('uav1', 91.0, 0.0, 30.0).step()
    assert scene.notes(ScenarioEventKind.RELEASED) == [(3, 'van1', '')]
    assert scene.commands()[-1] == (3, 'van1', RELEASE, 0.0)
    scene.step(5)
    assert len(scene.notes(ScenarioEventKind.RELEASED)) == 1


def test_who_is_told_how_fast_to_drive_is_not_held_nor_slowed_by_its_release(
    stage: Callable[..., Any], parameter: Callable[..., Any]
) -> None:
    faster = AgentAction(do='accelerate', agent='van1', value_mps=parameter(10.0, 'm/s'))
    told = Event(id='e1', trigger=TimeTrigger(on='time', at_s=parameter(0.1, 's')), action=faster)
    scene = stage(releases={'van1': (ReleaseOn.CAPTURED, 'uav1')}, events=(told,))
    scene.put('van1', 100.0).fly('uav1', 0.0, 0.0, 30.0).step(4)
    scene.fly('uav1', 91.0, 0.0, 30.0).step(5)
    speeds = [(tick, kind, v) for tick, who, kind, v in scene.commands() if who == 'van1']
    assert speeds == [(0, SET, 0.0), (2, SET, 10.0)]
    assert scene.notes(ScenarioEventKind.RELEASED) == []


def test_who_walks_up_to_a_kerb_waits_there_until_it_is_time_to_cross(
    stage: Callable[..., Any], parameter: Callable[..., Any]
) -> None:
    at = TimeTrigger(on='time', at_s=parameter(0.5, 's'))
    crosses = Event(id='e1', trigger=at, action=AgentAction(do='cross', agent='ego'))
    scene = stage(events=(crosses,), halts={'ego': (5.0, 0.0)}, speeds={'ego': 1.2})
    for x in (0.0, 2.0, 5.02, 5.08):
        scene.put('ego', x, 0.65, 1.2).step()
    scene.put('ego', 5.14).step(10)
    speeds = [(tick, v) for tick, who, kind, v in scene.commands() if who == 'ego' and kind == SET]
    assert speeds == [(0, 1.2), (2, 0.0), (10, 1.2)]


def test_who_walks_up_to_a_kerb_stands_before_it_wherever_that_is(
    stage: Callable[..., Any],
) -> None:
    """He does not walk as the planned line does; the street begins at 6 m."""
    scene = stage(halts={'ego': (9.0, 3.0)}, speeds={'ego': 1.2}, street_x_m=(6.0, 13.0))
    for x in (5.0, 5.7, 5.79):
        scene.put('ego', x, speed=1.2).step()
    speeds = [(tick, v) for tick, who, kind, v in scene.commands() if who == 'ego' and kind == SET]
    assert speeds == [(0, 1.2), (2, 0.0)]


def test_who_comes_up_behind_one_at_the_kerb_waits_until_that_has_gone(
    stage: Callable[..., Any],
) -> None:
    scene = stage(halts={'van1': (5.0, 0.0), 'ego': (5.0, 0.0)}, speeds={'van1': 1.2, 'ego': 1.2})
    scene.put('van1', 5.02, speed=1.2).put('ego', 2.0, speed=1.2).step()
    scene.put('van1', 5.1).put('ego', 3.4, speed=1.2).step()
    scene.put('ego', 3.6, speed=1.2).step(2)
    scene.put('van1', 5.2, speed=1.2).put('ego', 3.7).step(2)
    scene.put('van1', 9.0).put('ego', 5.02, speed=1.2).step(2)
    speeds = [(tick, v) for tick, who, kind, v in scene.commands() if who == 'ego' and kind == SET]
    assert speeds == [(0, 1.2), (2, 0.0), (4, 1.2), (6, 0.0)]


@pytest.mark.parametrize(
    ('do', 'most', 'told_at_once'), [('stop', 0.0, True), ('slow', 4.0, False)]
)
def test_who_is_told_to_stop_or_slow_down_before_it_may_set_off_keeps_to_that(
    do: str,
    most: float,
    told_at_once: bool,
    stage: Callable[..., Any],
    parameter: Callable[..., Any],
) -> None:
    value = None if do == 'stop' else parameter(most, 'm/s')
    slower = AgentAction(do=do, agent='van1', value_mps=value)  # type: ignore[arg-type]
    told = Event(id='e1', trigger=TimeTrigger(on='time', at_s=parameter(0.1, 's')), action=slower)
    scene = stage(releases={'van1': (ReleaseOn.CAPTURED, 'uav1')}, events=(told,))
    scene.put('van1', 100.0).fly('uav1', 0.0, 0.0, 30.0).step(4)
    scene.fly('uav1', 91.0, 0.0, 30.0).step(5)
    speeds = [(tick, kind, v) for tick, who, kind, v in scene.commands() if who == 'van1']
    assert speeds == [(0, SET, 0.0), *([(2, SET, most)] if told_at_once else []), (4, SET, most)]
    assert [name for _, name, _ in scene.notes(ScenarioEventKind.RELEASED)] == ['van1']


@pytest.mark.parametrize(
    ('release', 'ready_after'), [(ReleaseOn.ASCENDED, 'ascent'), (ReleaseOn.OBSERVED, 'landing')]
)
def test_release_after_a_phase(
    release: ReleaseOn, ready_after: str, stage: Callable[..., Any]
) -> None:
    scene = stage(releases={'ego': (release, 'uav1')}, hold_s=1.0)
    scene.put('van1', 100.0).follow(300)
    [(released, _, _)] = scene.notes(ScenarioEventKind.RELEASED)
    phases = {detail: tick for tick, _, detail in scene.notes(ScenarioEventKind.PHASE)}
    # A phase is noted at the tick of the decision; the ascent ends where the mission begins.
    assert released == (phases['m0'] if ready_after == 'ascent' else phases['landing'])


def test_an_agent_that_stands_still_is_never_released(stage: Callable[..., Any]) -> None:
    scene = stage(releases={'van1': (ReleaseOn.NEVER, '')}, hold_s=1.0)
    scene.put('van1', 100.0).follow(400)
    assert [c for c in scene.commands() if c[1] == 'van1'] == [(0, 'van1', SET, 0.0)]


def test_capture_may_be_the_sample_that_ends_the_ascent(stage: Callable[..., Any]) -> None:
    scene = stage()
    scene.put('van1', 3.0).fly('uav1', 0.0, 0.0, 27.9).step(4)
    scene.fly('uav1', 0.0, 0.0, 28.0).step()
    assert scene.machines[0].ascended_tick == scene.machines[0].capture_tick == 4


def test_phases_are_noted_once_with_their_names(stage: Callable[..., Any]) -> None:
    scene = stage(hold_s=2.0)
    scene.put('van1', 100.0).follow(1500)
    names = [(s, d) for _, s, d in scene.notes(ScenarioEventKind.PHASE)]
    assert names == [('uav1', 'ascent'), ('uav1', 'm0'), ('uav1', 'landing')]
    for tick, _, name in scene.notes(ScenarioEventKind.PHASE):
        # The note is made with the command that begins the phase.
        phase = {'ascent': UavPhase.ASCENT, 'm0': UavPhase.MISSION, 'landing': UavPhase.LANDING}
        assert scene.outputs[tick].uav_commands[0, UavCommandColumn.PHASE] == phase[name]
    assert scene.machines[0].landed


def test_landing_takes_the_nearest_spot_with_a_free_way(stage: Callable[..., Any]) -> None:
    spots = ((70.0, 0.0), (0.0, 30.0), (-90.0, 0.0))
    for buildings, expected in (((), (70.0, 0.0)), ((WALL,), (0.0, 30.0))):
        scene = stage(buildings=buildings, landing_spots=spots, hold_s=10.0)
        scene.put('van1', 30.0).follow(900)
        assert scene.machines[0].landing_spot == expected


def test_landing_climbs_over_what_is_in_the_way_when_no_way_is_free(
    stage: Callable[..., Any],
) -> None:
    scene = stage(buildings=(WALL,), landing_spots=((90.0, 0.0),), hold_s=1.0)
    scene.put('van1', 30.0).follow(600)
    heights = [o.uav_commands[0, UavCommandColumn.Z] for o in scene.outputs]
    assert max(heights) == pytest.approx(60.0, abs=1.1)  # the plan's safe altitude


def test_two_uavs_do_not_land_next_to_each_other(stage: Callable[..., Any]) -> None:
    scene = stage(
        tracks={'uav1': 'van1', 'uav2': 'van1'},
        landing_spots=((0.0, 0.0), (5.0, 0.0), (20.0, 0.0)),
        hold_s=1.0,
    )
    scene.put('van1', 10.0).follow(1200)
    spots = [m.landing_spot for m in scene.machines]
    assert all(s is not None for s in spots)
    (ax, ay), (bx, by) = spots
    assert (ax - bx) ** 2 + (ay - by) ** 2 >= 100.0
    assert all(m.landed for m in scene.machines)


def test_a_link_delivers_after_its_latency(
    stage: Callable[..., Any], parameter: Callable[..., Parameter]
) -> None:
    event = _message_at(parameter, 1.0, 'van1', 'ego')
    scene = stage(links=(('van1', 'ego'),), events=(event,))
    scene.put('van1', 0.0).put('ego', 50.0).step(40)
    records = [(r.tick, r.kind, r.distance_m) for o in scene.outputs for r in o.links]
    assert records == [
        (20, LinkEventKind.SENT, 50.0),
        (20, LinkEventKind.ATTEMPT_PASSED, 50.0),
        (22, LinkEventKind.DELIVERED, 50.0),
    ]
    assert [r.sequence for o in scene.outputs for r in o.links] == [0, 1, 2]


@pytest.mark.parametrize(
    ('receiver_x', 'buildings', 'gone', 'reason'),
    [
        (600.0, (), False, LossReason.RANGE),
        (300.0, (WALL,), False, LossReason.RANGE),
        (300.0, (), False, LossReason.NONE),
        (50.0, (), True, LossReason.RANGE),
    ],
)
def test_range_sight_and_presence_decide_about_a_transmission(
    receiver_x: float,
    buildings: tuple[Building, ...],
    gone: bool,
    reason: LossReason,
    stage: Callable[..., Any],
    parameter: Callable[..., Parameter],
) -> None:
    event = _message_at(parameter, 0.0, 'van1', 'ego')
    scene = stage(links=(('van1', 'ego'),), events=(event,), buildings=buildings)
    scene.put('van1', 0.0).put('ego', receiver_x)
    if gone:
        scene.remove('ego')
    scene.step(30)
    kinds = {r.kind for o in scene.outputs for r in o.links}
    assert (LinkEventKind.DELIVERED in kinds) is (reason is LossReason.NONE)
    lost = {
        r.reason for o in scene.outputs for r in o.links if r.kind is LinkEventKind.ATTEMPT_LOST
    }
    assert lost == ({reason} if reason is not LossReason.NONE else set())


def test_sight_is_claimed_on_change_and_once_a_second(stage: Callable[..., Any]) -> None:
    scene = stage(buildings=(WALL,))
    scene.put('van1', 30.0).fly('uav1', 20.0, 0.0, 30.0).step(30)
    scene.put('van1', 100.0).step(20)
    claims = [(s.tick, s.target, s.visible) for o in scene.outputs for s in o.sights]
    assert claims == [
        (0, 'van1', True),
        (20, 'van1', True),
        (30, 'van1', False),
        (40, 'van1', False),
    ]
    first = scene.outputs[0].sights[0]
    assert first.slant_range_m == pytest.approx(np.sqrt(10.0**2 + (30.0 - 0.75) ** 2))


def test_a_target_that_is_gone_is_not_visible(stage: Callable[..., Any]) -> None:
    scene = stage()
    scene.put('van1', 30.0).fly('uav1', 30.0, 0.0, 30.0).step(3)
    scene.remove('van1').step()
    assert [s.visible for o in scene.outputs for s in o.sights] == [True, False]


def test_a_run_ends_when_everything_is_done_and_settled(stage: Callable[..., Any]) -> None:
    scene = stage(hold_s=1.0, settle_ticks=10)
    scene.put('van1', 20.0)
    while not scene.follow().finished:
        assert scene.tick < 3000
    landed = next(
        k for k, o in enumerate(scene.outputs) if o.uav_commands[0, 0] == UavMode.IDLE and k > 10
    )
    assert scene.tick - 1 == landed + 10
    assert scene.outputs[-1].outcome == 'finished'
    assert scene.notes(ScenarioEventKind.FINISHED) == [(scene.tick - 1, 'run', 'finished')]
    assert not any(o.finished or o.outcome for o in scene.outputs[:-1])


def test_a_run_does_not_end_before_its_least_length(stage: Callable[..., Any]) -> None:
    scene = stage(hold_s=1.0, earliest_end_ticks=2000)
    scene.put('van1', 20.0)
    while not scene.follow().finished:
        pass
    assert scene.tick - 1 == 2000
    assert scene.outputs[-1].outcome == 'finished'


def test_a_stated_horizon_is_kept_exactly(stage: Callable[..., Any]) -> None:
    scene = stage(hold_s=1.0, stated_horizon=True, horizon_ticks=1600)
    scene.put('van1', 20.0)
    while not scene.follow().finished:
        pass
    assert scene.tick - 1 == 1600
    assert scene.outputs[-1].outcome == 'horizon'
    assert scene.machines[0].landed


def test_an_event_still_to_come_keeps_the_run_going_to_its_horizon(
    stage: Callable[..., Any], parameter: Callable[..., Parameter]
) -> None:
    event = Event(id='e1', trigger=TimeTrigger(on='time', at_s=parameter(900.0, 's')))
    scene = stage(hold_s=1.0, events=(event,), horizon_ticks=1500)
    scene.put('van1', 20.0)
    while not scene.follow().finished:
        pass
    assert scene.tick - 1 == 1500
    assert scene.outputs[-1].outcome == 'horizon'


def test_a_message_under_way_keeps_the_run_going(
    stage: Callable[..., Any], parameter: Callable[..., Parameter]
) -> None:
    """No UAV is left flying, the event has happened, but its message is still being sent."""
    event = _message_at(parameter, 0.0, 'van1', 'ego')
    scene = stage(
        links=(('van1', 'ego'),), events=(event,), tracks={'uav1': 'van1'}, settle_ticks=0
    )
    scene.put('ego', 900.0)
    scene.machines[0].done = True
    scene.step(12)
    assert not any(o.finished for o in scene.outputs)  # three retransmissions, 0.2 s apart
    output = scene.step()
    assert output.links[-1].kind is LinkEventKind.FAILED
    assert output.finished


def test_who_waits_for_another_to_draw_away_sets_off_then(stage: Callable[..., Any]) -> None:
    scene = stage(tracks={}, parted={'ego': ('van1', 60.0)})
    for metres, held in ((59.0, True), (60.0, False)):
        scene.put('van1', metres).step()
        assert (scene.notes(ScenarioEventKind.RELEASED) == []) is held
    scene = stage(tracks={}, parted={'ego': ('van1', 60.0)})
    scene.put('van1', 90.0).remove('van1').step()
    assert scene.notes(ScenarioEventKind.RELEASED) == []


def test_a_run_does_not_end_before_who_drives_somewhere_is_there(
    stage: Callable[..., Any],
) -> None:
    goes = (Behavior(kind=BehaviorKind.DRIVE, target='intersection'),)
    scene = stage(hold_s=1.0, behaviors={'ego': goes})
    scene.put('van1', 40.0).put('ego', 0.0)
    scene.follow(1500)
    assert not scene.outputs[-1].finished
    scene.put('ego', 290.0)
    while not scene.follow().finished:
        pass
    assert scene.outputs[-1].outcome == 'finished'
    assert scene.tick < 1520


def test_a_scene_without_uavs_runs_to_its_horizon(stage: Callable[..., Any]) -> None:
    scene = stage(tracks={}, horizon_ticks=30)
    scene.step(30)
    assert not scene.outputs[-1].finished
    assert scene.outputs[-1].uav_commands.shape == (0, 10)
    assert scene.step().outcome == 'horizon'


def test_a_uav_without_a_mission_stays_on_the_ground(stage: Callable[..., Any]) -> None:
    scene = stage(tracks={'uav1': ''})
    scene.step(50)
    assert all(o.uav_commands[0, 0] == UavMode.IDLE for o in scene.outputs)
    assert scene.notes(ScenarioEventKind.PHASE) == []


def test_same_states_same_outputs(
    stage: Callable[..., Any], parameter: Callable[..., Parameter]
) -> None:
    def run() -> list[Any]:
        event = _message_at(parameter, 3.0, 'uav1', 'ego')
        scene = stage(links=(('uav1', 'ego'),), events=(event,), loss=0.5, hold_s=3.0)
        scene.put('van1', 40.0).put('ego', 60.0).follow(900)
        return [
            (o.ground_commands, o.uav_commands.tobytes(), o.links, o.sights, o.events)
            for o in scene.outputs
        ]

    assert run() == run()


def test_numbers_of_events_have_no_gap(stage: Callable[..., Any]) -> None:
    scene = stage(releases={'van1': (ReleaseOn.CAPTURED, 'uav1')}, hold_s=1.0)
    scene.put('van1', 20.0).follow(900)
    numbers = [e.sequence for o in scene.outputs for e in o.events]
    assert numbers == list(range(len(numbers)))
    assert len(numbers) >= 4


def test_who_waits_for_a_time_sets_off_when_it_is_over(stage: Callable[..., Any]) -> None:
    scene = stage(waits_s={'ego': 3.0}, speeds={'ego': 7.0})
    scene.step(80)
    assert scene.commands()[1:] == [(0, 'ego', SET, 0.0), (60, 'ego', SET, 7.0)]
    assert scene.notes(ScenarioEventKind.RELEASED) == [(60, 'ego', '')]
