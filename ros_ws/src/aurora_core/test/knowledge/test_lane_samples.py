# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Lane samples against the network and the map, asked one by one."""

from __future__ import annotations

import math

import numpy as np
import pytest
import shapely

from aurora_core.errors import MapError
from aurora_core.knowledge.array_file import arrays_bytes
from aurora_core.knowledge.lane_samples import (
    BUILDING_REACH_M,
    NO_LANE,
    WALKWAY_REACH_M,
    LaneSamples,
    sample_arcs,
    sample_lanes,
)
from aurora_core.knowledge.map_model import MapModel


@pytest.fixture(scope='module')
def samples(downtown: MapModel) -> LaneSamples:
    return sample_lanes(downtown)


def _some(samples: LaneSamples) -> range:
    return range(0, len(samples), 37)


@pytest.mark.parametrize(
    ('length_m', 'arcs'),
    [(3.0, [1.5]), (10.0, [5.0]), (15.0, [7.5]), (29.0, [5.0, 15.0]), (30.0, [5.0, 15.0, 25.0])],
)
def test_every_ten_metres_and_at_least_once(length_m: float, arcs: list[float]) -> None:
    assert sample_arcs(length_m).tolist() == arcs


def test_every_lane_for_vehicles_is_sampled(samples: LaneSamples, downtown: MapModel) -> None:
    expected = {
        lane.id
        for lane in downtown.network.lanes.values()
        if not lane.is_internal and lane.allows - {'pedestrian'}
    }
    assert set(samples.lane_ids) == expected
    assert set(samples.lane.tolist()) == set(range(len(samples.lane_ids)))


def test_place_heading_and_limit_are_those_of_the_lane(
    samples: LaneSamples, downtown: MapModel
) -> None:
    for row in _some(samples):
        lane = downtown.network.lane(samples.lane_ids[samples.lane[row]])
        x, y, hx, hy = lane.line.at(float(samples.arc_m[row]))
        assert (samples.x_m[row], samples.y_m[row]) == pytest.approx((x, y), abs=0.02)
        assert (samples.heading_x[row], samples.heading_y[row]) == pytest.approx(
            (hx, hy), abs=1e-3
        )
        assert samples.limit_mps[row] == pytest.approx(lane.speed_limit_mps, abs=0.01)
        left_m = lane.arc_length_m - samples.arc_m[row]
        assert samples.junction_m[row] == pytest.approx(left_m, abs=0.02)


def test_neighbours_are_beside_and_opposite_lanes_come_towards(
    samples: LaneSamples, downtown: MapModel
) -> None:
    seen = 0
    for row in _some(samples):
        lane = downtown.network.lane(samples.lane_ids[samples.lane[row]])
        left = samples.left[row]
        assert left == NO_LANE or samples.lane_ids[left] == lane.left_lane_id
        opposite = samples.opposite[row]
        edge = downtown.network.opposite_edge(lane.edge_id)
        if opposite == NO_LANE:
            continue
        seen += 1
        other = downtown.network.lane(samples.lane_ids[opposite])
        assert other.edge_id == edge
        arc_m, _ = other.line.project(float(samples.x_m[row]), float(samples.y_m[row]))
        _, _, hx, hy = other.line.at(min(max(arc_m, 0.0), other.arc_length_m))
        assert hx * samples.heading_x[row] + hy * samples.heading_y[row] < -0.9
    assert seen


def test_walkways_and_buildings_are_the_nearest_ones(
    samples: LaneSamples, downtown: MapModel
) -> None:
    walkways = shapely.union_all(
        [shapely.LineString(lane.polyline) for lane in downtown.network.sidewalks]
    )
    shapes = {b.id: shapely.Polygon(b.ring, b.holes) for b in downtown.buildings}
    for row in _some(samples):
        point = shapely.Point(float(samples.x_m[row]), float(samples.y_m[row]))
        away_m = point.distance(walkways)
        found = samples.walkway_m[row]
        if math.isinf(found):
            assert away_m > WALKWAY_REACH_M - 0.03
        else:
            assert found == pytest.approx(away_m, abs=0.03)
        near_m = min(point.distance(shape) for shape in shapes.values())
        if math.isinf(samples.building_m[row]):
            assert near_m > BUILDING_REACH_M - 0.03
        else:
            assert samples.building_m[row] == pytest.approx(near_m, abs=0.03)


def test_a_crossing_ahead_is_farther_than_the_end_of_the_lane(samples: LaneSamples) -> None:
    ahead = np.isfinite(samples.crossing_m)
    assert ahead.any()
    behind_m = samples.crossing_m[ahead] - samples.junction_m[ahead]
    assert (behind_m >= -0.02).all()
    assert behind_m.max() < 15.0


def test_the_nearest_sample_of_a_lane(samples: LaneSamples) -> None:
    lane_id = samples.lane_ids[0]
    assert samples.nearest(lane_id, 0.0) == samples.first[lane_id][0]
    assert samples.nearest(lane_id, 1e6) == samples.first[lane_id][1] - 1
    assert samples.nearest('no lane', 5.0) is None


def test_arrays_come_back_the_same(samples: LaneSamples, downtown: MapModel) -> None:
    again = LaneSamples.of_arrays(samples.arrays())
    assert arrays_bytes(again.arrays()) == arrays_bytes(samples.arrays())
    assert arrays_bytes(sample_lanes(downtown).arrays()) == arrays_bytes(samples.arrays())


def test_arrays_that_do_not_fit_are_refused(samples: LaneSamples) -> None:
    arrays = samples.arrays()
    with pytest.raises(MapError, match='different lengths'):
        LaneSamples.of_arrays(arrays | {'x_m': arrays['x_m'][1:]})
    del arrays['y_m']
    with pytest.raises(MapError, match='y_m'):
        LaneSamples.of_arrays(arrays)


def test_lanes_beside_a_place_are_named(samples: LaneSamples, downtown: MapModel) -> None:
    for lane_id in samples.lane_ids:
        right = downtown.network.lane(lane_id).right_lane_id
        driven = right in samples.lane_ids
        assert samples.right_of(lane_id) == (right if driven else None)
    for row in _some(samples):
        lane_id, opposite = samples.lane_ids[samples.lane[row]], samples.opposite[row]
        named = samples.opposite_of(lane_id, float(samples.arc_m[row]))
        assert named == (None if opposite == NO_LANE else samples.lane_ids[opposite])
    assert samples.right_of(':no_lane') is samples.opposite_of(':no_lane', 0.0) is None
