# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""On which lane a body is, and when it goes over to another one."""

from __future__ import annotations

from collections.abc import Callable
from types import ModuleType

import numpy as np
import pytest

from aurora_core.knowledge.world import CentreLine
from aurora_core.quantities.lanes import (
    NO_LANE,
    edges_with_several_lanes,
    inside_lanes_m,
    lane_before,
    lane_change_ticks,
    lane_of,
)
from aurora_core.quantities.view import RunView

Drive = Callable[..., RunView]
Point = tuple[float, float]


def _lane(name: str, *points: Point) -> CentreLine:
    return CentreLine(
        lane_id=name, street_name='', points=np.array(points), width_m=3.0, speed_limit_mps=10.0
    )


# Two lanes to the east, one back to the west, then a street to the north with a bend.
LANES = (
    _lane('a_0', (0.0, 0.0), (100.0, 0.0)),
    _lane('a_1', (0.0, 3.0), (100.0, 3.0)),
    _lane('-a_0', (100.0, 6.0), (0.0, 6.0)),
    _lane('b_0', (120.0, 0.0), (150.0, 0.0), (150.0, 50.0)),
)


@pytest.fixture
def drive(tb: ModuleType) -> Drive:
    """Builds the run of a car that is at the points in turn and heads one way."""

    def build(*points: Point, heading: Point = (1.0, 0.0)) -> RunView:
        x, y = (np.array(values) for values in zip(*points, strict=True))
        car = tb.Agent(id='c', type='car', x=x, y=y, speed=np.ones(len(x)), heading=heading)
        world = tb.replace(tb.world(), lanes=LANES)
        return RunView(tb.Run(ticks=len(x), agents=[car]).trace(), world)

    return build


@pytest.mark.parametrize(
    ('point', 'heading', 'lane'),
    [
        ((50.0, 0.0), (1.0, 0.0), 0),
        ((50.0, 1.4), (1.0, 0.0), 0),
        ((50.0, 1.6), (1.0, 0.0), 1),  # nearer to the next one
        ((50.0, 6.0), (-1.0, 0.0), 2),
        ((50.0, 6.0), (1.0, 0.0), NO_LANE),  # against the traffic
        ((50.0, -2.0), (1.0, 0.0), NO_LANE),  # off the street
        ((110.0, 0.0), (1.0, 0.0), NO_LANE),  # inside the junction
        ((150.0, 30.0), (0.0, 1.0), 3),  # after the bend
    ],
)
def test_the_lane_of_a_place(drive: Drive, point: Point, heading: Point, lane: int) -> None:
    view = drive(point, heading=heading)
    assert lane_of(view, view.body('c')).tolist() == [lane]


def test_a_change_is_one_to_another_lane_of_the_street(drive: Drive) -> None:
    view = drive((10.0, 0.0), (20.0, 0.0), (30.0, 3.0), (110.0, 3.0), (130.0, 0.0))
    lanes = lane_of(view, view.body('c'))
    assert lanes.tolist() == [0, 0, 1, NO_LANE, 3]
    assert lane_change_ticks(view, lanes) == [2]
    assert [lane_before(lanes, tick) for tick in (0, 2, 4)] == [NO_LANE, 0, 1]


def test_a_change_through_the_gap_between_two_lanes_is_seen(drive: Drive) -> None:
    view = drive((10.0, 0.0), (20.0, -2.0), (30.0, 3.0))
    assert lane_change_ticks(view, lane_of(view, view.body('c'))) == [2]


def test_streets_with_another_lane(tb: ModuleType) -> None:
    assert edges_with_several_lanes(tb.replace(tb.world(), lanes=LANES)) == {'a'}


def test_the_depth_in_the_nearest_lane() -> None:
    points = np.array([(50.0, 0.5), (50.0, 2.0), (50.0, -3.0)])
    assert inside_lanes_m(LANES[:2], points).tolist() == [1.0, 0.5, -1.5]
