# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""How long a ground body stands before it goes on, or moves without a stop."""

from __future__ import annotations

from collections.abc import Callable
from math import inf

import numpy as np

from aurora_bench.checker import limits
from aurora_bench.checker.answers import Judged, decide, does_not, graded, holds
from aurora_bench.checker.case import Case, Requirement
from aurora_bench.checker.numbers import Wanted, wanted
from aurora_bench.checker.on_the_way import stated_between
from aurora_bench.checker.pairs import STEP_S, close_behind, within_gap
from aurora_bench.checker.recording import BoolArray
from aurora_bench.checker.scene import longest_s, runs_of

STANDS = ('stop', 'wait', 'park')
MOVES = ('drive', 'walk', 'circulate', 'follow', 'emergency_run')
# Setting off again takes so long (s).
SET_OFF_S = 1.0
# So exactly one knows when a time is over (s), and that somebody is as fast as asked (m/s); inside
# "at least" a time one may be by so much (s).
EDGE_S, LOOSE_MPS, SPARE_S = 0.3, 0.5, 1.5


def lasting(
    case: Case,
    requirement: Requirement,
    body: str,
    targets: list[str],
    near: Callable[[bool], BoolArray],
    held_up: Callable[[], BoolArray],
) -> Judged:
    """Return whether a body does something for as long as is annotated.

    Args:
        case: Recording and annotation.
        requirement: A behaviour.
        body: Whose.
        targets: Bodies or places that it is about.
        near: Where it is at them: surely so, or perhaps.
        held_up: Where somebody or a junction keeps it from a speed.
    """
    asked = wanted(requirement, 'duration_s', case.variation, limits.DURATION)
    if asked is None:
        return holds('')
    low, high = _between(case, requirement, asked)
    kind = str(requirement.get('behavior'))
    if kind in STANDS:
        return _stands(case, kind, body, near, low, high)
    if kind == 'tailgate':
        longest = max(longest_s(close_behind(case.scene, body, t), STEP_S) for t in targets)
        return decide(longest >= low - 2.0 * STEP_S, f'{body} is close behind for {longest:.1f} s')
    if kind not in MOVES:
        return does_not(f'{kind} has no duration')
    return _moves(case, requirement, body, targets, held_up, low)


def _between(case: Case, requirement: Requirement, asked: Wanted) -> tuple[float, float]:
    """Return the least and the greatest time that counts (s)."""
    own = case.variation.get(f'{requirement.get("id")}.duration_s') or (asked.value, asked.value)
    open_up = float(own[0]) == asked.value < float(own[1])
    open_down = float(own[1]) == asked.value > float(own[0])
    low = asked.value if open_up else 0.0 if open_down else asked.low
    return low, inf if open_up else asked.value if open_down else asked.high


def over_s(case: Case, trigger: Requirement) -> list[tuple[float, float]] | None:
    """Return between which times (s) what somebody does has gone on for as long as annotated.

    Args:
        case: Recording and annotation.
        trigger: Says who, and which behaviour.

    Returns:
        One pair for every stretch that is long enough; None where no time is annotated.
    """
    who, kind = trigger.get('who'), str(trigger.get('behavior'))
    for one in case.annotation.flat():
        if (one['kind'], one.get('agent'), one.get('behavior')) != ('behavior', who, kind):
            continue
        asked = wanted(one, 'duration_s', case.variation, limits.DURATION)
        if asked is not None:
            low, high = _between(case, one, asked)
            high = asked.value + SPARE_S if high == inf else high
            return [
                (begin + low - EDGE_S, sure + high + EDGE_S)
                for body in case.bodies(who)
                for begin, sure, lasts in _stretches(case, one, body)
                if lasts >= low - EDGE_S
            ]
    return None


def _stretches(
    case: Case, requirement: Requirement, body: str
) -> list[tuple[float, float, float]]:
    """Return from when on a body perhaps, and surely, does something, and for how long (s)."""
    scene, kind = case.scene, str(requirement.get('behavior'))
    if kind in STANDS:
        does = (scene.speed(body) < limits.STOPPED_MPS) & scene.present(body)
        if kind == 'stop':
            does &= np.logical_or.accumulate(scene.speed(body) > limits.STARTED_MPS)
        return [(a * scene.dt_s, a * scene.dt_s, (b - a) * scene.dt_s) for a, b in runs_of(does)]
    does = (scene.speed(body) > limits.STARTED_MPS) & scene.present(body)
    speed, found = wanted(requirement, 'speed_mps', case.variation, limits.SPEED), []
    for a, b in runs_of(does):
        perhaps = sure = a
        if speed is not None:
            off = np.array([speed.off(v) for v in scene.speed(body)[a:b].tolist()])
            if not (off <= speed.slack + LOOSE_MPS).any():
                continue
            perhaps = a + int(np.argmax(off <= speed.slack + LOOSE_MPS))
            sure = a + int(np.argmin(off))
        found.append((perhaps * scene.dt_s, sure * scene.dt_s, (b - perhaps) * scene.dt_s))
    return found


def _stands(
    case: Case, kind: str, body: str, near: Callable[[bool], BoolArray], low: float, high: float
) -> Judged:
    scene = case.scene
    still = (scene.speed(body) < limits.STOPPED_MPS) & scene.present(body)
    if kind == 'stop':
        still &= np.logical_or.accumulate(scene.speed(body) > limits.STARTED_MPS)

    def counts(at: BoolArray) -> bool:
        stood = [(b - a) * scene.dt_s for a, b in runs_of(still & at) if b < len(still)]
        if high == inf:
            return any((b - a) * scene.dt_s >= low for a, b in runs_of(still & at))
        if low == 0.0:
            return limits.STOPPED_S / 2.0 <= max(stood, default=0.0) <= high + scene.dt_s
        edge = 2.0 * scene.dt_s
        return any(low - edge <= s <= high + SET_OFF_S + edge for s in stood)

    times = [
        f'{(b - a) * scene.dt_s:.1f} s from {a * scene.dt_s:.1f} s' for a, b in runs_of(still)
    ]
    why = f'{body} stands for {times or "no time"}, {low:.1f} to {high:.1f} s asked'
    return graded(counts(near(True)), counts(near(False)), why)


def _moves(
    case: Case,
    requirement: Requirement,
    body: str,
    targets: list[str],
    held_up: Callable[[], BoolArray],
    low: float,
) -> Judged:
    scene = case.scene
    step = max(1, round(STEP_S / scene.dt_s))
    moving = ((scene.speed(body) > limits.STARTED_MPS) & scene.present(body))[::step]
    width = max(1, round((low - 2.0 * STEP_S) / STEP_S))
    why = f'{body} moves for {longest_s(moving, STEP_S):.1f} s without a stop, {low:.1f} s asked'
    begins = _sums(moving, width) == width
    if not begins.any():
        return does_not(why)
    surely = perhaps = begins
    speed = wanted(requirement, 'speed_mps', case.variation, limits.SPEED)
    if speed is not None:
        kept = _at_speed(case, body, speed)[::step]
        free = ~held_up()[::step] & (np.abs(scene.acceleration(body)[::step]) < 0.3)
        good, all_free = _sums(kept & free, width), _sums(free, width)
        surely = surely & (good >= limits.SPEED_SHARE * all_free) & (_sums(kept, width) > 0)
        perhaps = perhaps & (good >= 0.5 * all_free)
    if str(requirement.get('behavior')) == 'follow':
        ways = [within_gap(scene, body, t, stated_between(case, body, t)) for t in targets]
        shares = [_sums(way, width) / width for way in ways]
        best = np.max(shares, axis=0) if shares else np.zeros(len(begins))
        surely = surely & (best >= limits.FOLLOW_SHARE)
        perhaps = perhaps & (best >= 0.5)
    return graded(bool(surely.any()), bool(perhaps.any()), why)


def _at_speed(case: Case, body: str, asked: Wanted) -> BoolArray:
    speed = case.scene.speed(body)
    return np.asarray((speed >= asked.low - asked.slack) & (speed <= asked.high + asked.slack))


def _sums(true: BoolArray, width: int) -> np.ndarray:
    """Return how many of each `width` samples in a row are true; none where there are fewer."""
    total = np.concatenate([[0], np.cumsum(true)])
    return np.asarray(total[width:] - total[:-width]) if len(total) > width else np.zeros(0)
