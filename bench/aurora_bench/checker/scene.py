# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Series over the ticks of a recording, each computed once."""

from __future__ import annotations

import functools

import numpy as np

from aurora_bench.checker import recording as rec
from aurora_bench.checker.limits import LIMITS, SENSING_FACTOR, SENSING_RANGE_M
from aurora_bench.checker.places import Places
from aurora_bench.checker.recording import Body, BoolArray, FloatArray, Recording

AIRBORNE_M = 0.5


class Scene:
    """Positions, speeds and distances of everything that a name can stand for.

    A *thing* is the id of a body or, where there is no such body, the name of a place.

    Args:
        recording: What was recorded.
    """

    def __init__(self, recording: Recording) -> None:
        self.recording = recording
        self.world = recording.world
        self.dt_s = recording.dt_s
        self.times: FloatArray = np.arange(recording.ticks, dtype=np.float64) * recording.dt_s
        self.bodies: dict[str, Body] = {b.body_id: b for b in recording.bodies}
        self.places = Places(recording.world)
        self._distances: dict[tuple[str, str, bool], FloatArray] = {}
        # Answers to questions that cost something (sight, routes), asked again with each binding.
        self.memory: dict[object, object] = {}

    @property
    def end_s(self) -> float:
        """Return the time of the last tick."""
        return float(self.times[-1])

    def tick(self, time_s: float) -> int:
        """Return the first tick at or after a time, within the recording."""
        return int(np.clip(np.ceil(time_s / self.dt_s - 1e-6), 0, self.recording.ticks - 1))

    def limit(self, name: str) -> float:
        """Return a limit: the recorded one where the run had another than the contract's."""
        return float(self.world.limits.get(name, LIMITS[name]))

    @property
    def sensing_range_m(self) -> float:
        """Return how far the camera reaches in this weather and light."""
        ranges = self.world.limits.get('sensing_range_m', SENSING_RANGE_M)
        factors = self.world.limits.get('sensing_factor', SENSING_FACTOR)
        return float(ranges[self.world.weather]) * float(factors[self.world.time_of_day])

    @property
    def windy(self) -> bool:
        """Return whether there is wind or gusts."""
        east, north = self.world.wind_mps
        return bool(np.hypot(east, north) > 0.0 or self.world.gust_mps > 0.0)

    def is_body(self, thing: str) -> bool:
        """Return whether it is a body of the roster (else a place)."""
        return thing in self.bodies

    @functools.cache  # noqa: B019 - a scene lives as long as one check
    def xyz(self, body_id: str) -> FloatArray:
        """Return the reference points (ticks, 3) of a body, metres."""
        body = self.bodies[body_id]
        if body.is_uav:
            return self.recording.uav[:, body.row, rec.UX : rec.UZ + 1]
        rows = self.recording.ground[:, body.row]
        return np.column_stack([rows[:, rec.X], rows[:, rec.Y], np.zeros(len(rows))])

    def xy(self, body_id: str) -> FloatArray:
        """Return the positions (ticks, 2) of a body on the map, metres."""
        return self.xyz(body_id)[:, :2]

    @functools.cache  # noqa: B019
    def speed(self, body_id: str) -> FloatArray:
        """Return the ground speed (ticks,) of a body, m/s."""
        body = self.bodies[body_id]
        if body.is_uav:
            rows = self.recording.uav[:, body.row]
            return np.hypot(rows[:, rec.VX], rows[:, rec.VY])
        return self.recording.ground[:, body.row, rec.SPEED]

    @functools.cache  # noqa: B019
    def acceleration(self, body_id: str) -> FloatArray:
        """Return the change of speed (ticks,) of a ground body over 0.2 s, m/s^2."""
        steps = max(1, round(0.2 / self.dt_s))
        speed = self.speed(body_id)
        change = np.zeros_like(speed)
        change[steps:] = (speed[steps:] - speed[:-steps]) / (steps * self.dt_s)
        return change

    def heading(self, body_id: str) -> FloatArray:
        """Return unit vectors (ticks, 2): of ground bodies the recorded heading."""
        body = self.bodies[body_id]
        if not body.is_uav:
            return self.recording.ground[:, body.row, rec.HEADING_X : rec.HEADING_Y + 1]
        velocity = self.recording.uav[:, body.row, rec.VX : rec.VY + 1]
        length = np.linalg.norm(velocity, axis=1, keepdims=True)
        return np.asarray(velocity / np.maximum(length, 1e-9))

    def course(self, body_id: str) -> FloatArray:
        """Return the heading, frozen while the body is slower than 0.5 m/s."""
        heading, moving = self.heading(body_id), self.speed(body_id) > 0.5
        last = np.maximum.accumulate(np.where(moving, np.arange(len(moving)), -1))
        return np.asarray(heading[np.where(last < 0, 0, last)])

    def present(self, body_id: str) -> BoolArray:
        """Return (ticks,) whether the body exists."""
        body = self.bodies[body_id]
        if body.is_uav:
            return np.ones(self.recording.ticks, dtype=bool)
        return self.recording.ground[:, body.row, rec.PRESENT] > 0.5

    def altitude(self, uav: str) -> FloatArray:
        """Return (ticks,) metres above ground."""
        return self.xyz(uav)[:, 2]

    def vertical_speed(self, uav: str) -> FloatArray:
        """Return (ticks,) m/s up or down, over 0.2 s."""
        steps = max(1, round(0.2 / self.dt_s))
        z, rate = self.altitude(uav), np.zeros(self.recording.ticks)
        rate[steps:] = np.abs(z[steps:] - z[:-steps]) / (steps * self.dt_s)
        return rate

    def airborne(self, uav: str) -> BoolArray:
        """Return (ticks,) whether a UAV is off the ground."""
        rows = self.recording.uav[:, self.bodies[uav].row]
        return (rows[:, rec.UZ] > AIRBORNE_M) & (rows[:, rec.LANDED] < 0.5)

    def powered(self, uav: str) -> BoolArray:
        """Return (ticks,) whether a UAV is off the ground or reports that it is."""
        rows = self.recording.uav[:, self.bodies[uav].row]
        return np.asarray((rows[:, rec.UZ] > AIRBORNE_M) | (rows[:, rec.LANDED] < 0.5))

    def landed_s(self, uav: str) -> float | None:
        """Return when a UAV that has flown is on the ground for good; None when it is not."""
        airborne = np.flatnonzero(self.airborne(uav))
        if not len(airborne) or airborne[-1] + 1 >= self.recording.ticks:
            return None
        return float(self.times[airborne[-1] + 1])

    def distance(self, a: str, b: str, horizontal: bool = False) -> FloatArray:
        """Return (ticks,) metres between the reference points of two things.

        A place without a position of its own is taken where it is nearest. NaN where a body does
        not exist.
        """
        key = (a, b, horizontal) if a <= b else (b, a, horizontal)
        if key not in self._distances:
            self._distances[key] = self._distance(*key)
        return self._distances[key]

    def _distance(self, a: str, b: str, horizontal: bool) -> FloatArray:
        if not self.is_body(a):
            a, b = b, a
        start = self.xyz(a)
        if self.is_body(b):
            delta = start - self.xyz(b)
            flat, height = np.hypot(delta[:, 0], delta[:, 1]), delta[:, 2]
            present = self.present(a) & self.present(b)
        else:
            flat = self.places.distance(b, start[:, :2])
            height = start[:, 2]
            present = self.present(a)
        whole = flat if horizontal else np.hypot(flat, height)
        return np.where(present, whole, np.nan)

    def is_person(self, body_id: str) -> bool:
        """Return whether a body is a person on foot."""
        return self.bodies[body_id].is_person

    def stands_throughout(self, body_id: str) -> bool:
        """Return whether a body never moves."""
        moved = np.linalg.norm(self.xy(body_id) - self.xy(body_id)[0], axis=1)
        return bool(moved.max() < 0.5)


def runs_of(true: BoolArray) -> list[tuple[int, int]]:
    """Return the stretches [first, past the last) over which a series is true."""
    edges = np.diff(np.concatenate([[False], true, [False]]).astype(np.int8))
    starts, ends = np.flatnonzero(edges == 1), np.flatnonzero(edges == -1)
    return [(int(a), int(b)) for a, b in zip(starts, ends, strict=True)]


def longest_s(true: BoolArray, dt_s: float) -> float:
    """Return the longest unbroken time over which a series is true."""
    return max((b - 1 - a for a, b in runs_of(true)), default=0) * dt_s


def share(true: BoolArray) -> float:
    """Return the share of true samples (0 of none)."""
    return float(np.mean(true)) if len(true) else 0.0
