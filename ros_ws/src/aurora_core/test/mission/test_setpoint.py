# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""References stay inside their limits, reach their goals and cut no corner."""

from __future__ import annotations

import itertools
from math import cos, pi, sin, sqrt

import pytest
from flown_missions import DT_S, SETTINGS

from aurora_core.mission.setpoint import PursuitReference, RouteReference

EPS = 1e-9

Point3 = tuple[float, float, float]


class _Pursuit:
    """Runs a pursuit and keeps the worst of everything."""

    def __init__(self, start: Point3 = (0.0, 0.0, 30.0)) -> None:
        self.reference = PursuitReference(*start)
        self.speed = self.acceleration = self.climb = self.sink = self.lift = 0.0
        self.nearest = self.highest = self.lowest = 0.0

    def step(self, goal: Point3, velocity: tuple[float, float] = (0.0, 0.0)) -> None:
        r = self.reference
        before = (r.x, r.y, r.z, r.vx, r.vy, r.vz)
        r.step(goal, velocity, SETTINGS, DT_S)
        self.speed = max(self.speed, sqrt(r.vx**2 + r.vy**2))
        change = sqrt((r.vx - before[3]) ** 2 + (r.vy - before[4]) ** 2) / DT_S
        self.acceleration = max(self.acceleration, change)
        self.lift = max(self.lift, abs(r.vz - before[5]) / DT_S)
        self.climb, self.sink = max(self.climb, r.vz), max(self.sink, -r.vz)
        # The velocity is that of the step just made: the feed-forward tells the truth.
        assert r.x - before[0] == pytest.approx(r.vx * DT_S, abs=1e-9)
        assert r.y - before[1] == pytest.approx(r.vy * DT_S, abs=1e-9)
        assert r.z - before[2] == pytest.approx(r.vz * DT_S, abs=1e-9)

    def within_limits(self) -> bool:
        return (
            self.speed <= SETTINGS.speed_max_mps + EPS
            and self.acceleration <= SETTINGS.acceleration_mps2 + 1e-6
            and self.climb <= SETTINGS.climb_mps + EPS
            and self.sink <= SETTINGS.descent_mps + EPS
            and self.lift <= 0.5 * SETTINGS.acceleration_mps2 + 1e-6
        )


@pytest.mark.parametrize('goal', [(300.0, -40.0, 60.0), (1.0, 0.0, 29.0), (-80.0, 0.0, 5.0)])
def test_pursuit_of_a_point_arrives_and_stays_inside_the_limits(goal: Point3) -> None:
    run = _Pursuit()
    for _ in range(1200):
        run.step(goal)
    r = run.reference
    assert run.within_limits()
    assert sqrt((r.x - goal[0]) ** 2 + (r.y - goal[1]) ** 2) < 0.05
    assert abs(r.z - goal[2]) < 0.05
    assert sqrt(r.vx**2 + r.vy**2) < 0.05


def test_pursuit_does_not_overshoot_a_point() -> None:
    run = _Pursuit()
    farthest, highest = 0.0, 0.0
    for _ in range(1000):
        run.step((200.0, 0.0, 80.0))
        farthest = max(farthest, run.reference.x)
        highest = max(highest, run.reference.z)
    assert run.speed == pytest.approx(SETTINGS.speed_max_mps)  # it does use what it has
    assert run.climb == pytest.approx(SETTINGS.climb_mps)
    assert farthest < 200.5
    assert highest < 80.5


def test_pursuit_of_a_moving_target_closes_in_and_takes_its_speed() -> None:
    run = _Pursuit()
    x = 100.0
    for _ in range(1600):
        x += 13.0 * DT_S
        run.step((x, 20.0, 30.0), (13.0, 0.0))
    r = run.reference
    assert run.within_limits()
    assert sqrt((r.x - x) ** 2 + (r.y - 20.0) ** 2) < 1.0
    assert r.vx == pytest.approx(13.0, abs=0.05)


def test_pursuit_of_a_target_that_turns_and_stops_stays_inside_the_limits() -> None:
    run = _Pursuit()
    x = y = 0.0
    worst = 0.0
    for k in range(2400):
        vx, vy = ((13.0, 0.0), (0.0, 13.0), (-13.0, 0.0), (0.0, 0.0))[k // 600]
        x, y = x + vx * DT_S, y + vy * DT_S
        run.step((x, y, 30.0), (vx, vy))
        worst = max(worst, sqrt((run.reference.x - x) ** 2 + (run.reference.y - y) ** 2))
    assert run.within_limits()
    assert worst < 45.0  # a reversal at 13 m/s; it is caught up with afterwards
    assert sqrt((run.reference.x - x) ** 2 + (run.reference.y - y) ** 2) < 0.1


def test_pursuit_never_flies_faster_than_its_cap() -> None:
    reference = PursuitReference(0.0, 0.0, 30.0)
    for _ in range(400):
        reference.step((500.0, 0.0, 30.0), (0.0, 0.0), SETTINGS, DT_S, speed_cap_mps=5.0)
        assert sqrt(reference.vx**2 + reference.vy**2) <= 5.0 + EPS


def test_pursuit_at_its_goal_does_not_move() -> None:
    reference = PursuitReference(3.0, 4.0, 30.0)
    reference.step((3.0, 4.0, 30.0), (0.0, 0.0), SETTINGS, DT_S)
    assert (reference.x, reference.y, reference.z) == (3.0, 4.0, 30.0)


RECTANGLE = (
    (0.0, 0.0, 30.0),
    (100.0, 0.0, 30.0),
    (100.0, 60.0, 30.0),
    (0.0, 60.0, 30.0),
    (0.0, 0.0, 30.0),
)
ORBIT = tuple(
    (30.0 * cos(2.0 * pi * k / 36), 30.0 * sin(2.0 * pi * k / 36), 40.0) for k in range(37)
)
HAIRPIN = ((0.0, 0.0, 30.0), (50.0, 0.0, 30.0), (0.0, 1.0, 30.0))
SHORT_LEGS = tuple((0.5 * k, 0.3 * (k % 2), 30.0) for k in range(40))
SLOPE = ((0.0, 0.0, 10.0), (80.0, 0.0, 40.0), (80.0, 0.0, 20.0))


def _fly(points: tuple[Point3, ...], speed: float) -> list[tuple[Point3, Point3]]:
    """Return positions and velocities of a whole route."""
    route = RouteReference(points, speed)
    samples = [((route.x, route.y, route.z), (route.vx, route.vy, route.vz))]
    for _ in range(20000):
        if route.done:
            break
        route.step(SETTINGS, DT_S)
        samples.append(((route.x, route.y, route.z), (route.vx, route.vy, route.vz)))
    assert route.done
    return samples


def _distance_to_leg(p: Point3, a: Point3, b: Point3) -> float:
    d = [b[i] - a[i] for i in range(3)]
    length2 = sum(v * v for v in d)
    t = max(0.0, min(1.0, sum((p[i] - a[i]) * d[i] for i in range(3)) / length2))
    return sqrt(sum((a[i] + t * d[i] - p[i]) ** 2 for i in range(3)))


@pytest.mark.parametrize('speed', [2.0, 8.0, 16.0])
@pytest.mark.parametrize('points', [RECTANGLE, ORBIT, HAIRPIN, SHORT_LEGS, SLOPE])
def test_route_keeps_speed_acceleration_and_line(points: tuple[Point3, ...], speed: float) -> None:
    samples = _fly(points, speed)
    legs = list(itertools.pairwise(points))
    previous = 0.0
    for position, velocity in samples[1:]:
        now = sqrt(sum(v * v for v in velocity))
        assert now <= speed + EPS
        gain = (now - previous) / DT_S
        assert gain <= SETTINGS.acceleration_mps2 + 1e-6 or previous == 0.0
        previous = now
        assert min(_distance_to_leg(position, a, b) for a, b in legs) < 1e-6
    # It stands at the end, and every corner has been passed much closer than 3 m.
    assert samples[-1][0] == pytest.approx(points[-1])
    assert samples[-1][1] == (0.0, 0.0, 0.0)
    for corner in points:
        nearest = min(sqrt(sum((p[i] - corner[i]) ** 2 for i in range(3))) for p, _ in samples)
        assert nearest <= 0.5 * speed * DT_S + EPS


def test_route_slows_down_at_corners_but_not_on_curves() -> None:
    for points, slow in ((RECTANGLE, True), (ORBIT, False)):
        samples = _fly(points, 8.0)
        speeds = [sqrt(v[0] ** 2 + v[1] ** 2) for _, v in samples]
        middle = speeds[60 : len(speeds) - 120]
        assert (min(middle) < 2.0) is slow
        assert max(middle) == pytest.approx(8.0)


def test_route_brakes_no_harder_than_the_acceleration_limit() -> None:
    samples = _fly(RECTANGLE, 16.0)
    speeds = [sqrt(v[0] ** 2 + v[1] ** 2) for _, v in samples]
    braking = max((a - b) / DT_S for a, b in itertools.pairwise(speeds[:-1]))
    assert braking <= SETTINGS.acceleration_mps2


def test_route_is_flown_once_in_its_own_time() -> None:
    """100 m x 60 m at 8 m/s takes 40 s plus the corners; it does not stall on the way."""
    seconds = len(_fly(RECTANGLE, 8.0)) * DT_S
    assert 40.0 < seconds < 70.0


def test_repeated_points_are_one_point() -> None:
    once = _fly(RECTANGLE, 8.0)
    twice = _fly(tuple(p for p in RECTANGLE for _ in range(2)), 8.0)
    assert once == twice


def test_a_route_of_one_place_is_done_at_once() -> None:
    route = RouteReference(((1.0, 2.0, 3.0), (1.0, 2.0, 3.0)), 8.0)
    assert route.done
    route.step(SETTINGS, DT_S)
    assert (route.x, route.y, route.z, route.vx) == (1.0, 2.0, 3.0, 0.0)
