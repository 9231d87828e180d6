# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""How far behind another one somebody drives, in seconds: headway, and time to collision."""

from __future__ import annotations

import numpy as np

from aurora_bench.checker import limits
from aurora_bench.checker.answers import Judged, does_not, graded
from aurora_bench.checker.numbers import Wanted
from aurora_bench.checker.pairs import gaps
from aurora_bench.checker.phases import missions_end_s
from aurora_bench.checker.recording import BoolArray, FloatArray
from aurora_bench.checker.scene import Scene, share

# Of who stands, follows nobody in its lane, or does not close in (s).
NONE_S = 100.0
MOVING_MPS = 1.0
# Half a lane.
BESIDE_M = 1.75
# A share that is missed, or met, by less is in doubt: gaps are measured along another line.
DOUBT = 0.05


def seconds(
    scene: Scene, quantity: str, follower: str, leader: str
) -> tuple[FloatArray, BoolArray]:
    """Return (ticks,) the seconds of a quantity, and whether the follower moves."""
    ticks, gap, beside = gaps(scene, follower, leader)
    rate = scene.speed(follower)[ticks]
    moves = rate > MOVING_MPS
    if quantity == 'time_to_collision':
        same = np.einsum('ij,ij->i', scene.heading(follower)[ticks], scene.heading(leader)[ticks])
        rate = rate - scene.speed(leader)[ticks] * same
    with np.errstate(invalid='ignore'):
        counts = (gap > 0.0) & (np.abs(beside) <= BESIDE_M)
        counts &= moves if quantity == 'time_headway' else rate > 0.0
        found = np.where(counts, np.minimum(gap / np.where(counts, rate, 1.0), NONE_S), NONE_S)
    step = int(ticks[1] - ticks[0]) if len(ticks) > 1 else 1
    size = scene.recording.ticks
    both = scene.present(follower) & scene.present(leader)
    values = np.where(both, np.repeat(found, step)[:size], np.nan)
    return values, np.repeat(moves, step)[:size] & both


def keeps(scene: Scene, body: str, leader: str, number: Wanted) -> Judged:
    """Return whether a body keeps a headway for 0.8 of its time on the move after 10 s."""
    values, moves = seconds(scene, 'time_headway', body, leader)
    asked = moves & (scene.times >= limits.FOLLOW_AFTER_S)
    asked &= scene.times < missions_end_s(scene)
    if not asked.any():
        return does_not(f'{body} does not move then')
    good = share((values >= number.low - 1e-9) & (values <= number.high + 1e-9) & asked)
    good /= share(asked)
    middle = float(np.median(values[asked]))
    why = f'{body} {number.text()} s behind {leader} for {good:.0%}, median {middle:.2f} s'
    least = limits.FOLLOW_SHARE
    return graded(good >= least, good >= least - DOUBT, why)
