# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Contact, clearance, routes, motion and what the view says of a run."""

from __future__ import annotations

import math
from dataclasses import replace
from types import ModuleType

import numpy as np
import pytest

from aurora_core.errors import VerificationError
from aurora_core.knowledge.world import CentreLine, NamedPlace
from aurora_core.quantities import contact, motion
from aurora_core.quantities.instant_sight import InstantSight
from aurora_core.quantities.routes import along_route
from aurora_core.quantities.sight import sight_series
from aurora_core.quantities.view import RunView
from aurora_core.trace.commands import GroundCommand
from aurora_core.trace.layout import GroundCommandKind


def test_gap_of_bodies_names_the_nearest_pair(tb: ModuleType) -> None:
    # Cars are 4.5 m long: centres 10 m apart leave 5.5 m, 4 m apart overlap by 0.5 m.
    still = np.zeros(3)
    run = tb.Run(
        ticks=3,
        agents=[tb.driver(n, 'car', x, still) for n, x in (('a', 0.0), ('b', 10.0), ('c', 40.0))],
    )
    run.agents[1].x[2] = 4.0
    gap = contact.body_gap(RunView(run.trace(), tb.world()))
    assert gap.values == pytest.approx([5.5, 5.5, -0.5])
    assert gap.name_at(2) == 'a and b'


def test_an_absent_body_has_no_gap(tb: ModuleType) -> None:
    still = np.zeros(2)
    run = tb.Run(
        ticks=2, agents=[tb.driver('a', 'car', 0.0, still), tb.driver('b', 'car', 1.0, still)]
    )
    run.agents[1].present = np.array([1.0, 0.0])
    gap = contact.body_gap(RunView(run.trace(), tb.world()))
    assert gap.values[0] < 0.0
    assert gap.values[1] == contact.CLEARANCE_CUTOFF_M
    assert gap.name_at(1) == ''


def test_gap_of_a_uav_names_which_uav_and_which_body(tb: ModuleType) -> None:
    ticks = 200
    places = (('a', 0.0), ('b', 200.0), ('c', 400.0))
    run = tb.Run(
        ticks=ticks,
        agents=[tb.driver(name, 'car', x, np.zeros(ticks)) for name, x in places],
        flights=[
            tb.flight(ticks, home, 30.0, id=name)
            for name, home in (('uav1', (600.0, 0.0)), ('uav2', (400.0, 6.0)))
        ],
    )
    view = RunView(run.trace(), tb.world())
    gap = contact.body_gap(view)
    assert gap.name_at(0) == 'uav2 and c'
    assert gap.values[0] < 6.0
    assert contact.obstacle_clearance(view, view.body('uav2')).name_at(0) == 'c'
    assert contact.obstacle_clearance(view, view.body('uav1')).name_at(0) == ''


def test_clearance_is_from_buildings_and_bodies_but_never_from_the_ground(tb: ModuleType) -> None:
    ticks = 200
    run = tb.Run(
        ticks=ticks,
        agents=[tb.driver('bus1', 'bus', 0.0, np.zeros(ticks))],
        flights=[tb.flight(ticks, (0.0, 8.0), 30.0)],
    )
    wall = tb.building(-10.0, 14.0, 10.0, 30.0, 50.0)
    view = RunView(run.trace(), tb.world(buildings=(wall,)))
    least = contact.obstacle_clearance(view, view.body('uav1'))
    # The wall is 6 m away at every height; the side of the bus is 8 - 1.25 = 6.75 m away.
    assert least.values[150] == pytest.approx(6.0)
    assert least.name_at(150) == 'a building'
    view = RunView(run.trace(), tb.world())
    least = contact.obstacle_clearance(view, view.body('uav1'))
    assert least.values[5] == pytest.approx(6.75)
    assert least.name_at(5) == 'bus1'
    assert least.values[150] == pytest.approx(np.hypot(6.75, 30.0 - 3.2))


def test_no_fly_zones_are_signed(tb: ModuleType) -> None:
    ticks = 200
    run = tb.Run(ticks=ticks, flights=[tb.flight(ticks, (0.0, 0.0), 30.0)])
    world = tb.world(zones=(tb.zone(-10.0, -10.0, 10.0, 10.0, 20.0, 100.0),))
    view = RunView(run.trace(), world)
    distance = contact.no_fly_distance(view, view.body('uav1'))
    assert distance[0] == pytest.approx(20.0)
    assert distance[-1] == pytest.approx(-10.0)


def test_progress_along_the_route_of_the_follower(tb: ModuleType) -> None:
    still = np.zeros(4)
    run = tb.Run(
        ticks=4,
        agents=[
            tb.driver('ego', 'car', 0.0, still),
            tb.driver('bus1', 'bus', 0.0, still),
        ],
    )
    # The route goes 50 m east, then north; the bus stands 20 m behind the corner.
    run.agents[0].route = ((0.0, 0.0), (50.0, 0.0), (50.0, 100.0))
    run.agents[1].x = np.full(4, 50.0)
    run.agents[1].y = np.array([20.0, 20.0, 20.0, 20.0])
    view = RunView(run.trace(), tb.world())
    along = along_route(view, view.body('ego'), view.body('bus1'))
    assert along.lead_m == pytest.approx(np.full(4, 70.0))
    assert along.gap_m == pytest.approx(np.full(4, 70.0 - (4.5 + 12.0) / 2))
    assert along.offset_m == pytest.approx(np.zeros(4))


def test_a_leader_behind_the_start_of_the_route_has_a_negative_lead(tb: ModuleType) -> None:
    still = np.zeros(2)
    run = tb.Run(
        ticks=2,
        agents=[tb.driver('ego', 'car', 0.0, still), tb.driver('van1', 'van', -30.0, still)],
    )
    view = RunView(run.trace(), tb.world())
    assert along_route(view, view.body('ego'), view.body('van1')).lead_m == pytest.approx(
        [-30, -30]
    )
    assert along_route(view, view.body('van1'), view.body('ego')).lead_m == pytest.approx([30, 30])


def test_a_new_route_is_in_force_from_its_command_on(tb: ModuleType) -> None:
    still = np.zeros(4)
    run = tb.Run(
        ticks=4, agents=[tb.driver('ego', 'car', 0.0, still), tb.driver('bus1', 'bus', 0.0, still)]
    )
    run.agents[1].x, run.agents[1].y = np.full(4, 0.0), np.full(4, 25.0)
    run.ground_commands[2] = (
        GroundCommand(agent=0, kind=GroundCommandKind.SET_ROUTE, text='north unknown'),
    )
    lane = CentreLine(
        lane_id='north_0',
        street_name='North',
        points=np.array([(0.0, 0.0), (0.0, 90.0)]),
        width_m=3.2,
        speed_limit_mps=13.9,
    )
    view = RunView(run.trace(), tb.replace(tb.world(), lanes=(lane,)))
    along = along_route(view, view.body('ego'), view.body('bus1'))
    assert along.offset_m[0] == pytest.approx(25.0)
    assert along.lead_m[2:] == pytest.approx([25.0, 25.0])
    assert along.offset_m[2:] == pytest.approx([0.0, 0.0])


def test_a_body_without_a_path_uses_its_heading(tb: ModuleType) -> None:
    still = np.zeros(2)
    run = tb.Run(
        ticks=2,
        agents=[tb.driver('ego', 'car', 0.0, still), tb.driver('bus1', 'bus', 15.0, still)],
    )
    run.agents[0].route = ()
    view = RunView(run.trace(), tb.world())
    assert along_route(view, view.body('ego'), view.body('bus1')).lead_m == pytest.approx([15, 15])


def test_jumps_deceleration_and_way(tb: ModuleType) -> None:
    speed = np.array([10.0, 10.0, 9.5, 9.0])
    one = tb.driver('ego', 'car', 0.0, speed)
    one.x[3] += 5.0
    view = RunView(tb.Run(ticks=4, agents=[one]).trace(), tb.world())
    body = view.body('ego')
    assert motion.jump_speeds(view, [body])[:, 0] == pytest.approx([0.0, 10.0, 9.5, 109.0])
    assert motion.deceleration(view, body) == pytest.approx([0.0, 0.0, 10.0, 10.0])
    assert motion.travelled(view, body)[-1] == pytest.approx(0.5 + 0.475 + 5.45)


def test_the_closing_starts_when_a_standing_body_moves(tb: ModuleType) -> None:
    speeds = {'held': [0, 0, 0, 1.0, 2.0], 'moving': [5.0] * 5, 'never': [0.0] * 5}
    run = tb.Run(
        ticks=5,
        agents=[
            tb.driver(n, 'car', 9.0 * k, np.array(v)) for k, (n, v) in enumerate(speeds.items())
        ],
    )
    view = RunView(run.trace(), tb.world())
    found = [motion.closing_start_tick(view, view.body(name), 0.1) for name in speeds]
    assert found == [2, 0, None]


def test_the_view_knows_what_is_missing_and_when_a_run_is_over(tb: ModuleType) -> None:
    run = tb.Run(ticks=30, agents=[tb.driver('ego', 'car', 0.0, np.zeros(30))], missing=(12, 20))
    view = RunView(run.trace(), tb.world())
    assert view.first_missing_tick == 12
    assert view.complete(100.0)  # FINISHED is recorded
    cut = view.up_to(12)
    assert cut.ticks == 12
    assert cut.first_missing_tick is None
    assert not cut.complete(100.0)
    assert cut.complete(0.5)


def test_who_is_not_there_is_named(tb: ModuleType) -> None:
    run = tb.Run(ticks=2, agents=[tb.driver('ego', 'car', 0.0, np.zeros(2))])
    view = RunView(run.trace(), tb.world())
    with pytest.raises(VerificationError, match="no body 'van1'; it has ego"):
        view.body('van1')
    with pytest.raises(VerificationError, match='landmark:Nowhere'):
        view.reference('landmark:Nowhere')


@pytest.mark.parametrize(('behind', 'seen'), [(False, True), (True, False)])
def test_a_landmark_is_where_it_stands_and_arrived_at_on_the_road(
    tb: ModuleType, behind: bool, seen: bool
) -> None:
    hall = tb.building(90.0, 40.0, 110.0, 60.0, 25.0, 'Hall')
    other = tb.building(95.0, 70.0, 105.0, 72.0, 60.0)  # between the UAV and the hall, or not
    spots = {'approach:Hall': (100.0, 0.0), 'landmark:Hall': (100.0, 50.0)}
    world = replace(
        tb.world(buildings=(hall, other) if behind else (hall,)),
        places=tuple(NamedPlace(name=n, x_m=x, y_m=y) for n, (x, y) in spots.items()),
    )
    run = tb.Run(
        ticks=400,
        agents=[tb.driver('car1', 'car', 80.0, np.zeros(400))],
        flights=[tb.flight(400, (100.0, 80.0), 30.0)],
    )
    view, place = RunView(run.trace(), world), 'landmark:Hall'
    assert motion.horizontal_distance(view, 'uav1', place)[200] == pytest.approx(30.0)
    assert motion.horizontal_distance(view, place, 'uav1')[200] == pytest.approx(30.0)
    # 20 m from where the road leads to it, and 54 m from the hall.
    itself_m = motion.horizontal_distance(view, 'car1', place)[200]
    assert itself_m == pytest.approx(math.hypot(20.0, 50.0))
    assert motion.horizontal_distance(view, 'car1', place, on_road=True)[200] == 20.0
    flown_m = motion.horizontal_distance(view, 'uav1', place, on_road=True)[200]
    assert flown_m == pytest.approx(30.0)
    # The building that is looked at does not hide itself; another one does.
    series = sight_series(view, 'uav1', place)
    assert bool(series.visible[200]) is seen
    trace = view.trace
    instant = InstantSight(view.geometry, trace.roster)
    assert instant.see('uav1', place, trace.ground[200], trace.uav[200])[0] is seen


def test_who_is_ahead_on_the_lane_beside_is_so_on_the_first_pass(tb: ModuleType) -> None:
    """The route comes back much later right where the bus stands: it is 60 m ahead, not 460."""
    still = np.zeros(2)
    run = tb.Run(
        ticks=2,
        agents=[tb.driver('ego', 'car', 0.0, still), tb.driver('bus1', 'bus', 60.0, still)],
    )
    run.agents[0].route = (
        (0.0, 3.4), (200.0, 3.4), (200.0, -60.0), (-100.0, -60.0), (-100.0, 0.0), (200.0, 0.0),
    )  # fmt: skip
    run.agents[0].y = np.full(2, 3.4)
    view = RunView(run.trace(), tb.world())
    along = along_route(view, view.body('ego'), view.body('bus1'))
    assert along.lead_m == pytest.approx([60, 60])
