# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The checker finds the places where lanes meet, also where short streets link two of them."""

from __future__ import annotations

import numpy as np
import pytest
import shapely

from aurora_bench.checker.junctions import junctions
from aurora_bench.checker.recording import Lane

WIDTH_M = 3.5


def _street(name: str, a: tuple[float, float], b: tuple[float, float]) -> list[Lane]:
    """Two lanes, one in each direction, on the right of the line from one point to the other."""
    start, end = np.array(a), np.array(b)
    along = (end - start) / np.linalg.norm(end - start)
    right = np.array([along[1], -along[0]]) * WIDTH_M / 2.0
    return [
        Lane(lane_id=f'{name}_{k}', street=name, xy_m=xy, width_m=WIDTH_M, limit_mps=13.9)
        for k, xy in enumerate(
            (np.array([start + right, end + right]), np.array([end - right, start - right]))
        )
    ]


def _ground(lanes: list[Lane], *middles: tuple[float, float]) -> shapely.Geometry:
    strips = [shapely.LineString(lane.xy_m).buffer(WIDTH_M / 2.0) for lane in lanes]
    return shapely.union_all(
        [*strips, *(shapely.box(x - 8, y - 8, x + 8, y + 8) for x, y in middles)]
    )


def test_two_meeting_places_that_a_short_street_links_are_two() -> None:
    """As in CARLA's Town10HD: eleven metres of street lie between two signals."""
    low, high = (0.0, 0.0), (0.0, 27.0)
    lanes = [
        *_street('south', (0.0, -100.0), (0.0, -8.0)),
        *_street('between', (0.0, 8.0), (0.0, 19.0)),
        *_street('north', (0.0, 35.0), (0.0, 120.0)),
        *_street('east', (8.0, 0.0), (100.0, 0.0)),
        *_street('west', (-8.0, 27.0), (-100.0, 27.0)),
    ]
    found = junctions(tuple(lanes), _ground(lanes, low, high))
    middles = sorted((round(x), round(y)) for x, y, _ in found)
    assert middles == [(0, 0), (0, 27)]


def test_a_bend_and_a_street_cut_in_two_are_no_meeting_place() -> None:
    lanes = [
        *_street('south', (0.0, -100.0), (0.0, -8.0)),
        *_street('east', (8.0, 0.0), (60.0, 0.0)),
        *_street('further', (76.0, 0.0), (160.0, 0.0)),
    ]
    assert junctions(tuple(lanes), _ground(lanes, (0.0, 0.0), (68.0, 0.0))) == []


def test_a_wide_meeting_place_whose_lanes_end_far_apart_is_one() -> None:
    lanes = [
        *_street('south', (0.0, -100.0), (0.0, -30.0)),
        *_street('east', (30.0, 0.0), (100.0, 0.0)),
        *_street('north', (0.0, 30.0), (0.0, 100.0)),
    ]
    wide = shapely.union(_ground(lanes), shapely.box(-5.0, -30.0, 30.0, 30.0))
    ((x, y, outline),) = junctions(tuple(lanes), wide)
    assert (x, y) == pytest.approx((12.5, 0.0), abs=1.0)
    assert outline.contains(shapely.Point(0.0, 0.0))
