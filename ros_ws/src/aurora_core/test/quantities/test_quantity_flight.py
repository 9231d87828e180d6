# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Phases, waypoints and triggers."""

from __future__ import annotations

from itertools import pairwise
from types import ModuleType
from typing import Any

import numpy as np
import pytest

from aurora_core.knowledge.world import Surface, SurfaceKind
from aurora_core.quantities.actions import action_rules
from aurora_core.quantities.kernels import TrackRule
from aurora_core.quantities.phases import (
    CaptureRule,
    flight_phases,
    mission_phase,
    missions_end_tick,
)
from aurora_core.quantities.state_triggers import EventRules
from aurora_core.quantities.triggers import EventTimes
from aurora_core.quantities.view import RunView
from aurora_core.quantities.waypoints import cruising, legs, passages, pattern_centre
from aurora_core.spec.parameter import Unit
from aurora_core.spec.scenario import (
    AltitudeTrigger,
    ArrivalTrigger,
    DistanceTrigger,
    Event,
    EventDoneTrigger,
    MessageTrigger,
    MissionDoneTrigger,
    SpeedTrigger,
    TimeTrigger,
    VisibilityTrigger,
)
from aurora_core.spec.vocabulary import MissionMode


def _view(tb: ModuleType, ticks: int, **values: Any) -> RunView:
    return RunView(tb.Run(ticks=ticks, **values).trace(), tb.world())


def test_the_ascent_ends_inside_the_altitude_tolerance(tb: ModuleType) -> None:
    # 0.2 m per tick from tick 1: 28 m, the first sample within 2 m of 30 m, is tick 140.
    one = tb.flight(400, (0.0, 0.0), 30.0, landing=300)
    view = _view(tb, 400, flights=[one])
    phases = flight_phases(view, view.body('uav1'), 30.0, 2.0, 0.3)
    assert phases.takeoff_tick == 1
    assert phases.ascent_end_tick == pytest.approx(140, abs=1)
    assert phases.landing_tick == 300
    assert phases.landed_tick is None
    assert missions_end_tick(view) == 300


def test_landing_is_seen_in_the_states(tb: ModuleType) -> None:
    one = tb.flight(500, (0.0, 0.0), 10.0, landing=200)
    view = _view(tb, 500, flights=[one])
    phases = flight_phases(view, view.body('uav1'), 10.0, 2.0, 0.3)
    # 10 m with 0.1 m per tick from tick 200 on: down at tick 299.
    assert phases.landed_tick == pytest.approx(299, abs=1)


def test_a_track_mission_captures_in_its_tolerance_and_ends_with_the_next_command(
    tb: ModuleType,
) -> None:
    ticks = 500
    ego = tb.driver('ego', 'car', 100.0, np.zeros(ticks))
    one = tb.flight(ticks, (0.0, 0.0), 30.0, lambda _k: (65.0, 0.0, 30.0), landing=400)
    view = _view(tb, ticks, agents=[ego], flights=[one])
    uav = view.body('uav1')
    flight = flight_phases(view, uav, 30.0, 2.0, 0.3)
    rule = CaptureRule(
        altitude_m=30.0,
        altitude_tolerance_m=5.0,
        track=TrackRule(standoff_m=35.0, horizontal_m=5.0, altitude_m=30.0, vertical_m=5.0),
        target='ego',
    )
    phase = mission_phase(view, uav, 0, flight, rule)
    # 60 m of way at 15 m/s bring the UAV within 40 m of the car: 80 ticks after the ascent.
    assert phase.command_tick == one.ascent_end + 1
    assert phase.capture_tick == pytest.approx(one.ascent_end + 80, abs=1)
    assert (phase.end_tick, phase.stop_tick) == (400, 400)


def test_missions_of_a_sequence_follow_the_phase_column(tb: ModuleType) -> None:
    one = tb.flight(500, (0.0, 0.0), 20.0, landing=450, later=(300,))
    view = _view(tb, 500, flights=[one])
    uav = view.body('uav1')
    flight = flight_phases(view, uav, 20.0, 2.0, 0.3)
    rule = CaptureRule(
        altitude_m=20.0, altitude_tolerance_m=2.0, horizontal_tolerance_m=2.0, point_m=(0.0, 0.0)
    )
    first, second = (mission_phase(view, uav, k, flight, rule) for k in (0, 1))
    assert (first.end_tick, second.command_tick, second.capture_tick) == (300, 300, 300)
    assert second.end_tick == 450
    third = mission_phase(view, uav, 2, flight, rule)
    assert (third.command_tick, third.capture_tick, third.end_tick) == (None, None, None)


SQUARE = ((0.0, 0.0, 30.0), (40.0, 0.0, 30.0), (40.0, 40.0, 30.0), (0.0, 0.0, 30.0))


def _route(k: int) -> tuple[float, float, float]:
    """Along the square's points at 10 m/s from tick 200 on."""
    s = max(0, k - 200) * 0.5
    if s <= 40.0:
        return s, 0.0, 30.0
    if s <= 80.0:
        return 40.0, s - 40.0, 30.0
    back = min(1.0, (s - 80.0) / 56.568)
    return 40.0 * (1 - back), 40.0 * (1 - back), 30.0


def test_waypoints_are_passed_in_order(tb: ModuleType) -> None:
    view = _view(tb, 600, flights=[tb.flight(600, (0.0, 0.0), 30.0, _route)])
    uav = view.body('uav1')
    found = passages(view.reference(uav.body_id), SQUARE, (3.0, 2.0), 180, 600)
    assert [p.tick is not None for p in found] == [True] * 4
    assert [p.nearest_m for p in found] == pytest.approx([0.0] * 4, abs=0.3)
    flown = legs(SQUARE, found)
    assert [(leg.a, leg.b) for leg in flown] == list(pairwise(SQUARE))
    mask = cruising(view, uav, flown[:1], 10.0)
    # 20 m of the first leg are farther than 10 m from both ends: 0.5 m per tick.
    assert np.count_nonzero(mask) == pytest.approx(39, abs=1)
    assert pattern_centre(SQUARE) == (20.0, 20.0)


def test_a_missed_waypoint_is_told_by_its_closest_approach(tb: ModuleType) -> None:
    view = _view(tb, 600, flights=[tb.flight(600, (0.0, 0.0), 30.0, _route)])
    points = (*SQUARE[:2], (52.0, 20.0, 30.0), SQUARE[3])
    found = passages(view.reference('uav1'), points, (3.0, 2.0), 180, 600)
    assert found[2].tick is None
    assert found[2].nearest_m == pytest.approx(12.0)
    assert found[3].tick is not None


def test_a_waypoint_at_the_wrong_altitude_is_not_visited(tb: ModuleType) -> None:
    view = _view(tb, 600, flights=[tb.flight(600, (0.0, 0.0), 30.0, _route)])
    points = ((40.0, 0.0, 34.0),)
    (found,) = passages(view.reference('uav1'), points, (3.0, 2.0), 180, 600)
    assert found.tick is None
    assert found.nearest_m == pytest.approx(4.0 * 3.0 / 2.0)


def test_waypoints_out_of_order_do_not_count(tb: ModuleType) -> None:
    view = _view(tb, 600, flights=[tb.flight(600, (0.0, 0.0), 30.0, _route)])
    points = (SQUARE[2], SQUARE[1])
    found = passages(view.reference('uav1'), points, (3.0, 2.0), 180, 600)
    assert found[0].tick is not None
    assert found[1].tick is None


def _times(
    tb: ModuleType,
    *events: Event,
    place: bool = False,
    sidewalks: tuple[tuple[float, float], ...] = (),
) -> EventTimes:
    ticks = 400
    speed = np.concatenate((np.zeros(100), np.full(200, 10.0), np.zeros(100)))
    ego = tb.driver('ego', 'car', 0.0, np.zeros(ticks))
    van = tb.driver('van1', 'van', -60.0, speed)
    van.x = np.minimum(van.x, 1000.0)
    one = tb.flight(ticks, (0.0, 20.0), 30.0, landing=350)
    world = tb.world()
    if place:
        from aurora_core.knowledge.world import NamedPlace

        spot = NamedPlace(name='intersection', x_m=0.0, y_m=0.0)
        world = tb.replace(world, places=(spot,))
    walks = tuple(
        Surface(
            surface_id=f'walk{k}',
            kind=SurfaceKind.SIDEWALK,
            ring=np.array(tb.box_ring(west, -5.0, east, 5.0)),
        )
        for k, (west, east) in enumerate(sidewalks)
    )
    world = tb.replace(world, surfaces=(*world.surfaces, *walks))
    run = tb.Run(ticks=ticks, agents=[ego, van], flights=[one])
    view = RunView(run.trace(), world)
    request = tb.spec(
        agents=(tb.agent('ego', 'car', role='ego'), tb.agent('van1', 'van')),
        uavs=({'id': 'uav1'},),
        missions=(tb.mission('m1', MissionMode.TRACK, target='ego'),),
        events=events,
    )
    rules = EventRules(
        brake_mps2=4.0,
        onset_mps2=0.5,
        arrival_m=15.0,
        actions=action_rules(tb.TOLERANCES),
        flights={'uav1': flight_phases(view, view.body('uav1'), 30.0, 2.0, 0.3)},
        captured=lambda _uav, _mission: 150,
        links=(),
    )
    return EventTimes(view, request, rules)


def _event(trigger: object, **values: object) -> Event:
    return Event.model_validate({'id': 'e1', 'trigger': trigger} | values)


def test_trigger_ticks(tb: ModuleType) -> None:
    metre = tb.number
    mps = Unit.METRE_PER_SECOND

    def tick(trigger: object, **values: Any) -> int | None:
        return _times(tb, _event(trigger), **values).trigger_tick('e1')

    # The van starts at tick 100 with 0.5 m per tick from 60 m behind: at 20 m after 80 steps.
    near = DistanceTrigger(on='distance_below', a='van1', b='ego', value_m=metre(20.0))
    assert tick(near) == 179
    # It passes the ego and gets beyond 20 m: 60 + 20 m after its start.
    far = DistanceTrigger(on='distance_above', a='van1', b='ego', value_m=metre(20.25))
    assert tick(far) == 260
    assert tick(TimeTrigger(on='time', at_s=metre(5.0, Unit.SECOND))) == 100
    fast = SpeedTrigger(on='speed_above', who='van1', value_mps=metre(8.0, mps))
    slow = SpeedTrigger(on='speed_below', who='van1', value_mps=metre(1.0, mps))
    assert (tick(fast), tick(slow)) == (100, 300)
    never = SpeedTrigger(on='speed_below', who='ego', value_mps=metre(1.0, mps))
    assert tick(never) is None
    assert tick(
        AltitudeTrigger(on='altitude_reached', uav='uav1', value_m=metre(15.0))
    ) == pytest.approx(71, abs=1)
    assert tick(VisibilityTrigger(on='visible', observer='uav1', target='ego')) == pytest.approx(
        140, abs=1
    )
    assert tick(MissionDoneTrigger(on='mission_done', uav='uav1')) == 350
    assert tick(MessageTrigger(on='message_received', by='ego')) is None
    arrives = ArrivalTrigger(on='arrives', who='van1', place='intersection')
    assert tick(arrives, place=True) == 189
    assert tick(arrives) is None


def test_one_arrives_on_a_sidewalk_by_stepping_onto_it(tb: ModuleType) -> None:
    """The van stands on one at first, leaves it 10 m farther on and comes to another at x = 0."""
    event = _event(ArrivalTrigger(on='arrives', who='van1', place='sidewalk'))
    other = ((-80.0, -50.0), (0.0, 30.0))
    assert _times(tb, event, sidewalks=other).trigger_tick('e1') == pytest.approx(219, abs=1)
    assert _times(tb, event, sidewalks=other[:1]).trigger_tick('e1') is None
    assert _times(tb, event).trigger_tick('e1') is None


def test_events_after_events_and_actions_of_agents(tb: ModuleType) -> None:
    metre = tb.number
    first = _event(
        TimeTrigger(on='time', at_s=metre(6.0, Unit.SECOND)),
        action={'do': 'brake', 'agent': 'van1'},
    )
    after = Event(
        id='e2',
        trigger=EventDoneTrigger(on='event_done', event='e1', after_s=metre(1.0, Unit.SECOND)),
    )
    times = _times(tb, first, after)
    # The van loses 10 m/s from tick 299 to tick 300.
    assert times.action_tick('e1', 120) == 300
    assert times.trigger_tick('e2') == 320
    landing = _event(None, action={'do': 'land', 'uav': 'uav1'})
    assert _times(tb, landing).action_tick('e1') == 350
    start = _event(None, action={'do': 'start', 'agent': 'van1'})
    assert _times(tb, start).action_tick('e1') == 100
    never = _event(None, action={'do': 'cross', 'agent': 'van1'})  # it begins on the street
    assert _times(tb, never).action_tick('e1') is None
    assert _times(tb, first).action_tick('nothing') is None


def test_events_that_wait_for_each_other_never_happen(tb: ModuleType) -> None:
    a = _event(EventDoneTrigger(on='event_done', event='e2'), action={'do': 'land', 'uav': 'uav1'})
    b = a.model_validate(dict(a) | {'id': 'e2', 'trigger': {'on': 'event_done', 'event': 'e1'}})
    # That the UAV is seen to land at its end is no landing that the other one brings about.
    assert _times(tb, a, b).trigger_tick('e1') is None


def test_what_nobody_was_told_is_not_done(tb: ModuleType) -> None:
    """The van stands at first: that is no stop which something else could wait for."""
    far = DistanceTrigger(on='distance_above', a='van1', b='ego', value_m=tb.number(300.0))
    stop = {'do': 'stop', 'agent': 'van1'}
    after = Event(id='e2', trigger=EventDoneTrigger(on='event_done', event='e1'))
    told = _event(TimeTrigger(on='time', at_s=tb.number(0.0, Unit.SECOND)), action=stop)
    assert _times(tb, told, after).trigger_tick('e2') is not None
    assert _times(tb, _event(far, action=stop), after).trigger_tick('e2') is None


def test_what_changes_a_flight_counts_from_its_capture(tb: ModuleType) -> None:
    near = DistanceTrigger(on='distance_below', a='van1', b='ego', value_m=tb.number(500.0))
    climb = {'do': 'ascend', 'uav': 'uav1', 'altitude_m': tb.number(60.0)}
    assert _times(tb, _event(near)).trigger_tick('e1') == 0
    # `captured` of the rules is at tick 150.
    assert _times(tb, _event(near, action=climb)).trigger_tick('e1') == 150
