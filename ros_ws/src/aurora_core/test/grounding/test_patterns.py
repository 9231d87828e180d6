# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Flight patterns have exactly the size that is asked for."""

from __future__ import annotations

from itertools import pairwise
from math import sqrt

import pytest

from aurora_core.grounding.patterns import pattern_points, place_pattern
from aurora_core.quantities.waypoints import has_shape
from aurora_core.spec.vocabulary import Pattern

Point2 = tuple[float, float]


def _points(pattern: Pattern, length: float = 120.0, width: float = 70.0) -> tuple[Point2, ...]:
    points = pattern_points(
        pattern, length_m=length, width_m=width, radius_m=45.0, waypoint_count=5
    )
    assert points is not None
    return points


def _extent(points: tuple[Point2, ...]) -> tuple[float, float]:
    xs, ys = [p[0] for p in points], [p[1] for p in points]
    return max(xs) - min(xs), max(ys) - min(ys)


def _centre(points: tuple[Point2, ...]) -> tuple[float, float]:
    xs, ys = [p[0] for p in points], [p[1] for p in points]
    return (max(xs) + min(xs)) / 2.0, (max(ys) + min(ys)) / 2.0


def test_rectangle_is_closed_and_exact() -> None:
    points = _points(Pattern.RECTANGLE)
    assert points[0] == points[-1]
    assert len(points) == 5
    legs = [sqrt((b[0] - a[0]) ** 2 + (b[1] - a[1]) ** 2) for a, b in pairwise(points)]
    assert legs == [120.0, 70.0, 120.0, 70.0]
    assert _centre(points) == (0.0, 0.0)


def test_line_has_its_length() -> None:
    assert _points(Pattern.LINE) == ((-60.0, 0.0), (60.0, 0.0))


@pytest.mark.parametrize('width', [1.0, 20.0, 21.0, 70.0, 100.0])
def test_lawnmower_covers_its_area(width: float) -> None:
    points = _points(Pattern.LAWNMOWER, width=width)
    assert _extent(points) == pytest.approx((120.0, width))
    assert _centre(points) == pytest.approx((0.0, 0.0))
    rows = sorted({round(y, 9) for _, y in points})
    assert rows[0] == -width / 2.0
    assert rows[-1] == width / 2.0
    assert all(b - a <= 20.0 + 1e-9 for a, b in pairwise(rows))
    # Neighbouring lines are flown in opposite directions: no leg crosses the area.
    for a, b in pairwise(points):
        assert a[0] == b[0] or a[1] == b[1]


def test_orbit_is_closed_and_keeps_its_radius() -> None:
    points = _points(Pattern.ORBIT)
    assert points[0] == points[-1]
    assert all(sqrt(x * x + y * y) == pytest.approx(45.0) for x, y in points)
    middles = [((a[0] + b[0]) / 2.0, (a[1] + b[1]) / 2.0) for a, b in pairwise(points)]
    assert all(sqrt(x * x + y * y) > 45.0 * 0.996 for x, y in middles)


@pytest.mark.parametrize(('asked', 'made'), [(5, 5), (2, 2), (1, 1), (12, 12)])
def test_waypoints_are_as_many_as_asked(asked: int, made: int) -> None:
    points = pattern_points(
        Pattern.WAYPOINTS, length_m=1.0, width_m=1.0, radius_m=30.0, waypoint_count=asked
    )
    assert points is not None
    assert len(points) == len(set(points)) == made


@pytest.mark.parametrize('heading', [(1.0, 0.0), (0.0, 1.0), (-0.6, 0.8), (0.6, -0.8)])
@pytest.mark.parametrize('pattern', list(Pattern))
def test_placing_turns_and_moves_but_never_resizes(pattern: Pattern, heading: Point2) -> None:
    points = _points(pattern)
    placed = place_pattern(points, (500.0, -300.0), heading)
    assert len(placed) == len(points)
    for (a, b), (c, d) in zip(pairwise(points), pairwise(placed), strict=True):
        before = (b[0] - a[0], b[1] - a[1])
        after = (d[0] - c[0], d[1] - c[1])
        assert sqrt(after[0] ** 2 + after[1] ** 2) == pytest.approx(
            sqrt(before[0] ** 2 + before[1] ** 2)
        )
        # Along +x of the pattern is along the heading, +y is to the left of it.
        assert after[0] * heading[0] + after[1] * heading[1] == pytest.approx(before[0], abs=1e-9)
        left = -after[0] * heading[1] + after[1] * heading[0]
        assert left == pytest.approx(before[1], abs=1e-9)


@pytest.mark.parametrize('pattern', list(Pattern))
def test_a_planned_pattern_has_its_shape_and_no_other(pattern: Pattern) -> None:
    flat = pattern_points(pattern, length_m=100.0, width_m=60.0, radius_m=40.0, waypoint_count=5)
    assert flat is not None
    placed = place_pattern(flat, (300.0, -20.0), (0.6, 0.8))
    points = tuple((x, y, 30.0) for x, y in placed)
    shapes = {other for other in Pattern if has_shape(other, points)}
    # Points that are not closed may also be waypoints that somebody names.
    assert {pattern} <= shapes <= {pattern, Pattern.WAYPOINTS}


def test_a_ring_that_leaves_a_part_of_the_circle_out_is_no_orbit() -> None:
    """Every tower could be gone round so, and that all points were passed would say nothing."""
    ring = pattern_points(
        Pattern.ORBIT, length_m=1.0, width_m=1.0, radius_m=40.0, waypoint_count=4
    )
    assert ring is not None
    points = tuple((x, y, 30.0) for x, y in ring)
    assert has_shape(Pattern.ORBIT, points)
    assert not has_shape(Pattern.ORBIT, (*points[::2], points[0])[:-1])
    assert not has_shape(Pattern.ORBIT, (*points[:9], *points[10:]))
    half = points[:19]
    assert not has_shape(Pattern.ORBIT, (*half, *half[-2::-1]))
