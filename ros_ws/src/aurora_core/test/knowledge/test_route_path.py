# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The path along a route is continuous, has the right lengths, and knows its lanes and signals."""

from __future__ import annotations

import math

import pytest

from aurora_core.errors import MapError
from aurora_core.knowledge.map_model import MapModel
from aurora_core.knowledge.route_path import RoutePath


def _distance(a: tuple[float, ...], b: tuple[float, ...]) -> float:
    return math.sqrt((a[0] - b[0]) ** 2 + (a[1] - b[1]) ** 2)


def _straight(junction: MapModel) -> RoutePath:
    return junction.network.route_path(('long_street_1_eb', 'long_street_2_eb'), 'passenger')


def test_forty_metres_ahead_is_forty_metres(junction: MapModel) -> None:
    path = _straight(junction)
    start = path.arc_of('long_street_1_eb_1', 100.0)
    a, b = path.position_at(start), path.position_at(start + 40.0)
    # Through the junction, on a straight street.
    assert b[0] - a[0] == pytest.approx(40.0, abs=1e-9)
    assert _distance(a, b) == pytest.approx(40.0, abs=1e-9)
    lane_id, pos_m = path.lane_position_at(start)
    assert lane_id == 'long_street_1_eb_1'
    assert pos_m == pytest.approx(100.0)


def test_path_runs_from_end_to_end_without_gaps(junction: MapModel) -> None:
    path = _straight(junction)
    assert path.length_m == pytest.approx(300.0, abs=0.05)
    assert [s.lane_id for s in path.segments] == [
        'long_street_1_eb_1',
        path.segments[1].lane_id,
        'long_street_2_eb_1',
    ]
    assert path.segments[1].is_internal
    assert path.segments[0].start_m == 0.0
    for before, after in zip(path.segments[:-1], path.segments[1:], strict=True):
        assert before.end_m == after.start_m
    assert path.segments[-1].end_m == pytest.approx(path.length_m, abs=1e-9)


def test_signals_passed_are_at_the_stop_line(junction: MapModel) -> None:
    path = _straight(junction)
    ((arc_m, signal_id, index),) = path.signals
    assert signal_id == 'centre'
    assert index >= 0
    x, y, _, _ = path.position_at(arc_m)
    assert (x, y) == pytest.approx(junction.network.lane('long_street_1_eb_1').polyline[-1])


def test_left_turn_bends_left(junction: MapModel) -> None:
    path = junction.network.route_path(('long_street_1_eb', 'cross_street_2_nb'), 'passenger')
    assert not path.has_lane_change
    # Left turns leave from the innermost lane.
    assert path.segments[0].lane_id == 'long_street_1_eb_2'
    _, _, east, north = path.position_at(path.length_m)
    assert (east, north) == pytest.approx((0.0, 1.0))


def test_forced_start_lane_gives_a_lane_change(junction: MapModel) -> None:
    path = junction.network.route_path(
        ('long_street_1_eb', 'cross_street_2_nb'),
        'passenger',
        start_lane_id='long_street_1_eb_1',
        start_pos_m=50.0,
    )
    (change,) = path.lane_changes
    assert (change.from_lane_id, change.lane_id) == ('long_street_1_eb_1', 'long_street_1_eb_2')
    assert change.start_m == pytest.approx(50.0)
    assert change.lane_end_pos_m == pytest.approx(80.0)
    assert path.position_at(change.start_m)[1] == pytest.approx(-4.95)
    assert path.position_at(change.end_m)[1] == pytest.approx(-1.65)


def test_every_point_of_long_routes_is_near_the_previous_one(downtown: MapModel) -> None:
    network = downtown.network
    pairs = [
        ('meridian_parkway_1_eb', 'ridge_road_1_eb'),
        ('smithy_court_1_sb', 'grand_boulevard_3_sb'),
        ('founders_circle_2_wb', 'needle_lane_1_nb'),
    ]
    for a, b in pairs:
        route = network.shortest_route(a, b, 'passenger')
        assert route is not None
        path = network.route_path(route, 'passenger')
        previous = path.position_at(0.0)
        for i in range(1, int(path.length_m)):
            here = path.position_at(float(i))
            # A chord is never longer than its arc, and junction curves are gentle.
            assert 0.9 <= _distance(previous, here) <= 1.0 + 1e-9
            previous = here


def test_lane_positions_and_arcs_are_inverse(downtown: MapModel) -> None:
    network = downtown.network
    route = network.shortest_route('ridge_road_1_wb', 'market_street_7_eb', 'passenger')
    assert route is not None
    path = network.route_path(route, 'passenger')
    for i in range(0, int(path.length_m), 7):
        lane_id, pos_m = path.lane_position_at(float(i))
        assert path.arc_of(lane_id, pos_m) == pytest.approx(float(i), abs=1e-6)
        segment = next(s for s in path.segments if s.start_m <= i <= s.end_m)
        if not segment.is_lane_change:
            x, y, _, _ = network.position_on_lane(lane_id, pos_m)
            assert _distance((x, y), path.position_at(float(i))) < 0.02


def test_bad_questions_are_refused(junction: MapModel) -> None:
    network = junction.network
    path = _straight(junction)
    with pytest.raises(MapError, match='not on the route'):
        path.position_at(path.length_m + 1.0)
    with pytest.raises(MapError, match='not on the route'):
        path.lane_position_at(-0.5)
    with pytest.raises(MapError, match='is not on the route'):
        path.arc_of('long_street_1_wb_1', 10.0)
    with pytest.raises(MapError, match='at least one edge'):
        network.route_path((), 'passenger')
    with pytest.raises(MapError, match='cannot drive the route'):
        network.route_path(('long_street_1_eb', 'long_street_1_wb'), 'passenger')
    with pytest.raises(MapError, match='from lane long_street_1_eb_0'):
        network.route_path(('long_street_1_eb',), 'passenger', start_lane_id='long_street_1_eb_0')
