# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What two bodies on the road do with each other."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from aurora_bench.checker import limits
from aurora_bench.checker.answers import Judged, does_not, graded
from aurora_bench.checker.numbers import Wanted
from aurora_bench.checker.paths import ahead_of
from aurora_bench.checker.phases import missions_end_s
from aurora_bench.checker.recording import FloatArray
from aurora_bench.checker.scene import Scene, longest_s, share

STEP_S = 0.2
# A body that comes so near to what it approaches has surely approached it.
APPROACHED_M = 30.0


def gaps(scene: Scene, follower: str, leader: str) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Return times, bumper-to-bumper gaps (NaN: not on one way) and lateral offsets."""
    key = ('gaps', follower, leader)
    if key not in scene.memory:
        ticks = np.arange(0, scene.recording.ticks, max(1, round(STEP_S / scene.dt_s)))
        ahead, beside = ahead_of(scene, leader, follower, ticks)
        there = scene.present(leader)[ticks] & scene.present(follower)[ticks]
        half = (scene.bodies[leader].length_m + scene.bodies[follower].length_m) / 2.0
        scene.memory[key] = (ticks, np.where(there, ahead - half, np.nan), beside)
    found = scene.memory[key]
    assert isinstance(found, tuple)
    return found


def follow(scene: Scene, body: str, leader: str, stated: Wanted | None = None) -> Judged:
    """Return whether a body follows another: the gap for 0.8 of the time after 10 s.

    Until the last mission ends: what is stated with motion need not hold while UAVs land.

    Args:
        stated: How far behind it is to be, from middle to middle (m): that counts, too.
    """
    if not scene.is_body(leader):
        return does_not(f'{leader} is no body')
    ticks, gap, _ = gaps(scene, body, leader)
    speed = scene.speed(body)[ticks]
    good = within_gap(scene, body, leader, stated)
    times = scene.times[ticks]
    asked = times < missions_end_s(scene)
    late = asked & (times >= limits.FOLLOW_AFTER_S)
    moving = np.flatnonzero(speed > limits.STARTED_MPS)
    if not len(moving):
        return does_not(f'{body} does not move')
    own = asked & (times >= float(times[moving[0]]) + limits.FOLLOW_AFTER_S)
    whole, since = share(good[late]), share(good[own])
    known = gap[late & np.isfinite(gap)]
    middle = float(np.median(known)) if len(known) else np.nan
    why = f'{body} follows {leader} for {whole:.0%} of the time, median gap {middle:.1f} m'
    return graded(whole >= limits.FOLLOW_SHARE, since >= limits.FOLLOW_SHARE, why)


def within_gap(
    scene: Scene, body: str, leader: str, stated: Wanted | None = None
) -> npt.NDArray[np.bool_]:
    """Return at each sample (`STEP_S` apart) whether a body follows another; see `follow`."""
    ticks, gap, _ = gaps(scene, body, leader)
    fast = scene.speed(body)[ticks] > limits.FOLLOW_MOVING_MPS
    least = np.where(fast, limits.FOLLOW_GAP_M[0], limits.FOLLOW_SLOW_GAP_M[0])
    most = limits.FOLLOW_GAP_M[1]
    if stated is not None:
        half = (scene.bodies[body].length_m + scene.bodies[leader].length_m) / 2.0
        least, most = np.minimum(least, stated.low - half), max(most, stated.high - half)
    with np.errstate(invalid='ignore'):
        return np.asarray((gap >= least) & (gap <= most))


def close_behind(scene: Scene, body: str, leader: str) -> npt.NDArray[np.bool_]:
    """Return at each sample (`STEP_S` apart) whether a body is less than 1 s behind another."""
    ticks, gap, beside = gaps(scene, body, leader)
    speed = scene.speed(body)[ticks]
    with np.errstate(invalid='ignore', divide='ignore'):
        close = (speed > limits.TAILGATE_MPS) & (gap > -0.5) & (np.abs(beside) < 2.5)
        close &= gap / np.maximum(speed, 1e-9) < limits.TAILGATE_GAP_S
    return np.asarray(close)


def tailgate(scene: Scene, body: str, leader: str) -> Judged:
    """Return whether a body is less than 1 s behind another for 5 s."""
    if not scene.is_body(leader):
        return does_not(f'{leader} is no body')
    close = close_behind(scene, body, leader)
    longest, total = longest_s(close, STEP_S), float(close.sum()) * STEP_S
    why = (
        f'{body} under 1 s behind {leader} for {longest:.1f} s at a stretch, {total:.1f} s in all'
    )
    return graded(longest >= limits.TAILGATE_S - STEP_S, total >= limits.TAILGATE_S - STEP_S, why)


@dataclass(frozen=True, slots=True)
class Overtaking:
    """One body comes from behind another to ahead of it.

    Attributes:
        clean: Side by side in between, or in the very next sample: no detour by another street.
    """

    start_s: float
    end_s: float
    clean: bool


def overtaking(scene: Scene, body: str, other: str) -> Overtaking | None:
    """Return when a body first comes from behind another to ahead of it, None if it never does."""
    ticks, gap, _ = gaps(scene, body, other)
    half = (scene.bodies[other].length_m + scene.bodies[body].length_m) / 2.0
    with np.errstate(invalid='ignore'):
        behind, ahead = gap > 0.0, gap + half < -half
        level = np.isfinite(gap) & ~behind & ~ahead
    first = np.flatnonzero(behind)
    past = np.flatnonzero(ahead[first[0] :]) if len(first) else first
    if not len(past):
        return None
    done = int(first[0]) + int(past[0])
    start = int(first[first < done][-1])
    clean = bool(level[start + 1 : done].all()) and done - start <= 30.0 / STEP_S
    times = scene.times[ticks]
    return Overtaking(float(times[start]), float(times[done]), clean)


def overtake(scene: Scene, body: str, other: str) -> Judged:
    """Return whether a body comes from behind another to ahead of it."""
    if not scene.is_body(other):
        return does_not(f'{other} is no body')
    done = overtaking(scene, body, other)
    if done is not None:
        why = f'{body} is behind {other} at {done.start_s:.1f} s and ahead of it at '
        return graded(done.clean, True, f'{why}{done.end_s:.1f} s')
    _, gap, _ = gaps(scene, body, other)
    known = gap[np.isfinite(gap)]
    if not (known > 0.0).any():
        return does_not(f'{body} is never behind {other}')
    return does_not(f'{body} stays behind {other}, nearest {float(known.min()):.1f} m')


def approach(scene: Scene, body: str, target: str) -> Judged:
    """Return whether a body comes nearer to another, or to a place."""
    if scene.is_body(target):
        away = scene.distance(body, target, horizontal=True)
    else:
        away = scene.places.outline_distance(target, scene.xy(body), on_road=True)
        away = np.where(scene.present(body), away, np.nan)
    if not np.isfinite(away).any():
        return does_not(f'{body} and {target} are never there together')
    least, start = float(np.nanmin(away)), float(away[np.isfinite(away)][0])
    moved = float(scene.speed(body).max())
    if moved < limits.STARTED_MPS:
        return does_not(f'{body} does not move')
    nearer = start - least
    why = f'{body} comes from {start:.1f} m to {least:.1f} m of {target}'
    near = least <= APPROACHED_M and (nearer >= 5.0 or start <= APPROACHED_M / 2.0)
    return graded(near and nearer > 0.0, nearer >= 5.0, why)
