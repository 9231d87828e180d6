# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The gap of oriented rectangles against shapely."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

from aurora_core.geometry.box import box_gap_series, chord_pose


class OrientedBox(NamedTuple):
    """Centre and heading (ENU, a unit vector), extent along and across it (m)."""

    x_m: float
    y_m: float
    heading_x: float
    heading_y: float
    length_m: float
    width_m: float

    def polygon(self) -> shapely.Polygon:
        ahead = np.array([self.heading_x, self.heading_y]) * self.length_m / 2.0
        left = np.array([-self.heading_y, self.heading_x]) * self.width_m / 2.0
        centre = np.array([self.x_m, self.y_m])
        return shapely.Polygon(
            [centre + a * ahead + b * left for a, b in ((1, 1), (-1, 1), (-1, -1), (1, -1))]
        )


def box_gap(a: OrientedBox, b: OrientedBox) -> float:
    return float(box_gap_series(*(np.array([value]) for value in (*a, *b)))[0])


YAW = st.one_of(st.floats(-4.0, 4.0), st.sampled_from([0.0, math.pi / 2, math.pi, math.pi / 4]))
PLACE = st.one_of(st.floats(-12.0, 12.0), st.sampled_from([0.0, 1.0, 5.0]))
SIZE = st.floats(0.2, 14.0)
BOXES = st.builds(
    lambda x, y, yaw, length, width: OrientedBox(
        x_m=x,
        y_m=y,
        heading_x=math.cos(yaw),
        heading_y=math.sin(yaw),
        length_m=length,
        width_m=width,
    ),
    PLACE,
    PLACE,
    YAW,
    SIZE,
    SIZE,
)


def box(
    x: float, y: float, yaw: float = 0.0, length: float = 4.0, width: float = 2.0
) -> OrientedBox:
    return OrientedBox(
        x_m=x,
        y_m=y,
        heading_x=math.cos(yaw),
        heading_y=math.sin(yaw),
        length_m=length,
        width_m=width,
    )


def axes(one: OrientedBox) -> list[tuple[float, float]]:
    return [(one.heading_x, one.heading_y), (-one.heading_y, one.heading_x)]


@settings(derandomize=True, deadline=None, max_examples=400)
@given(a=BOXES, b=BOXES)
def test_gap_is_shapelys_distance_or_the_least_parting_shift(
    a: OrientedBox, b: OrientedBox
) -> None:
    gap = box_gap(a, b)
    first, second = a.polygon(), b.polygon()
    assert box_gap(b, a) == pytest.approx(gap, abs=1e-9)
    if gap > 0.0:
        assert gap == pytest.approx(first.distance(second), abs=1e-9)
        return
    assert first.distance(second) <= 1e-9
    directions = [(s * x, s * y) for x, y in axes(a) + axes(b) for s in (1.0, -1.0)]
    parted = [
        first.distance(shapely.affinity.translate(second, (1e-6 - gap) * x, (1e-6 - gap) * y))
        for x, y in directions
    ]
    assert max(parted) > 0.0
    if gap < -1e-6:
        overlaps = [
            first.intersection(
                shapely.affinity.translate(second, -(gap + 1e-6) * x, -(gap + 1e-6) * y)
            ).area
            for x, y in directions
        ]
        assert min(overlaps) > 0.0


@pytest.mark.parametrize(
    ('b', 'gap'),
    [
        (box(10.0, 0.0), 6.0),  # in line
        (box(4.0, 0.0), 0.0),  # bumpers touch
        (box(4.0, 2.0), 0.0),  # corners touch
        (box(7.0, 6.0), 5.0),  # corner to corner, 3-4-5
        (box(3.0, 0.0), -1.0),
        (box(0.0, 0.0), -2.0),  # the same place
        (box(0.0, 3.0, math.pi / 2), 0.0),
        (box(0.5, 0.0, 0.0, 0.2, 0.5), -1.25),  # swallowed: out by the nearer side
    ],
)
def test_known_gaps(b: OrientedBox, gap: float) -> None:
    assert box_gap(box(0.0, 0.0), b) == pytest.approx(gap, abs=1e-12)


def test_series_equals_single_gaps_to_the_bit() -> None:
    rng = np.random.default_rng(5)
    rows = 300
    a_xy, b_xy = rng.random((2, rows, 2)) * 12.0
    a_yaw, b_yaw = rng.random((2, rows)) * 7.0
    series = box_gap_series(
        a_xy[:, 0], a_xy[:, 1], np.cos(a_yaw), np.sin(a_yaw), 5.0, 1.8,
        b_xy[:, 0], b_xy[:, 1], np.cos(b_yaw), np.sin(b_yaw), 12.0, 2.5,
    )  # fmt: skip
    assert (series < 0.0).any()
    assert (series > 0.0).any()
    for k in range(rows):
        # headings from numpy as in the series: math.cos may differ in the last bit
        a = OrientedBox(
            x_m=float(a_xy[k, 0]), y_m=float(a_xy[k, 1]), heading_x=float(np.cos(a_yaw[k])),
            heading_y=float(np.sin(a_yaw[k])), length_m=5.0, width_m=1.8,
        )  # fmt: skip
        b = OrientedBox(
            x_m=float(b_xy[k, 0]), y_m=float(b_xy[k, 1]), heading_x=float(np.cos(b_yaw[k])),
            heading_y=float(np.sin(b_yaw[k])), length_m=12.0, width_m=2.5,
        )  # fmt: skip
        assert box_gap(a, b) == series[k]


def test_sizes_may_differ_per_row() -> None:
    zero, one = np.zeros(2), np.ones(2)
    gap = box_gap_series(
        zero, zero, one, zero, np.array([4.0, 6.0]), 2.0, 10.0 * one, zero, one, zero, 4.0, 2.0
    )
    assert gap.tolist() == [6.0, 5.0]


def test_absent_rows_stay_absent() -> None:
    x, zero, one = np.array([np.nan, 10.0]), np.zeros(2), np.ones(2)
    gap = box_gap_series(zero, zero, one, zero, 4.0, 2.0, x, zero, one, zero, 4.0, 2.0)
    assert np.isnan(gap[0])
    assert gap[1] == 6.0


def test_in_a_bend_a_bus_stands_inside_of_its_lane() -> None:
    """On an arc of 20 m its middle is nearer to the centre of the arc by the sagitta."""
    radius_m, length_m = 20.0, 12.0
    half = math.asin(0.5 * length_m / radius_m)
    front, back = ((radius_m * math.cos(a), radius_m * math.sin(a)) for a in (half, -half))
    x, y, hx, hy = chord_pose(front, back, length_m)
    assert (x, y) == pytest.approx((radius_m * math.cos(half), 0.0), abs=1e-9)
    assert (hx, hy) == pytest.approx((0.0, 1.0), abs=1e-9)
