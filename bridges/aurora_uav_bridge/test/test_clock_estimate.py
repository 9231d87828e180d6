# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Offset and drift from round trips: near the truth, and never surer than right."""

from __future__ import annotations

import numpy as np
import pytest

from aurora_uav_bridge.clock_estimate import ClockEstimator, Estimate

START_S, OFFSET_S, DRIFT = 1e5, -1234.5, 200e-6


def true_s(ours_s: float) -> float:
    return ours_s + OFFSET_S + DRIFT * (ours_s - START_S)


def after(
    seconds: float, seed: int, *, out_s: float = 0.03, back_s: float = 0.03, least_s: float = 1e-4
) -> Estimate:
    """Return what is known after ten round trips a second, each way evenly late."""
    rng = np.random.default_rng(seed)
    clock = ClockEstimator()
    for k in range(round(10 * seconds)):
        sent_s = START_S + 0.1 * k
        there_s = sent_s + least_s + rng.uniform(0.0, out_s)
        clock.take(sent_s, true_s(there_s), there_s + least_s + rng.uniform(0.0, back_s))
    assert clock.steps == 0
    assert clock.estimate is not None
    return clock.estimate


def test_200_ppm_and_30_ms_are_known_to_a_millisecond_and_30_ppm_after_a_minute() -> None:
    for seed in range(20):
        known = after(60.0, seed)
        assert abs(known.theirs_s(known.at_s) - true_s(known.at_s)) < 1.5e-3
        assert abs(known.drift - DRIFT) < 40e-6
        assert known.uncertainty_s < 4e-3


@pytest.mark.parametrize('seconds', [2.0, 10.0, 60.0])
def test_what_it_says_of_itself_is_true(seconds: float) -> None:
    """Over 60 clocks: inside the stated uncertainty, and two deviations hold as often as said."""
    known = [after(seconds, seed) for seed in range(60)]
    off = np.array([abs(k.offset_s - (true_s(k.at_s) - k.at_s)) for k in known])
    drift = np.array([abs(k.drift - DRIFT) for k in known])
    assert (off <= [k.uncertainty_s for k in known]).all()
    assert (off <= [2.0 * k.offset_sigma_s for k in known]).mean() > 0.9
    assert (drift <= [2.0 * k.drift_sigma for k in known]).mean() > 0.9


def test_a_way_that_is_always_longer_stays_within_the_uncertainty() -> None:
    """Nobody can see it in the round trips: half of the shortest one must bound it."""
    rng = np.random.default_rng(3)
    clock = ClockEstimator()
    for k in range(300):
        sent_s = START_S + 0.1 * k
        there_s = sent_s + 0.02 + rng.uniform(0.0, 0.005)
        clock.take(sent_s, true_s(there_s), there_s + rng.uniform(0.0, 0.005))
    known = clock.estimate
    assert known is not None
    off_s = abs(known.offset_s - (true_s(known.at_s) - known.at_s))
    assert 0.008 < off_s < known.uncertainty_s


def test_both_ways_of_telling_the_time_agree() -> None:
    known = after(20.0, 1)
    assert known.ours_s(known.theirs_s(START_S + 40.0)) == pytest.approx(START_S + 40.0, abs=1e-9)


def test_a_clock_that_was_set_is_noticed_and_learned_anew() -> None:
    rng = np.random.default_rng(5)
    clock = ClockEstimator()
    for k in range(400):
        sent_s = START_S + 0.1 * k
        set_s = 0.25 if k >= 200 else 0.0
        there_s = sent_s + rng.uniform(0.0, 0.03)
        clock.take(sent_s, true_s(there_s) - set_s, there_s + rng.uniform(0.0, 0.03))
    assert clock.steps == 1
    known = clock.estimate
    assert known is not None
    assert abs(known.theirs_s(known.at_s) - true_s(known.at_s) + 0.25) < known.uncertainty_s


def test_one_answer_from_nowhere_changes_nothing() -> None:
    rng = np.random.default_rng(6)
    clock = ClockEstimator()
    for k in range(200):
        sent_s = START_S + 0.1 * k
        there_s = sent_s + rng.uniform(0.0, 0.03)
        wrong_s = 5.0 if k % 50 == 49 else 0.0
        clock.take(sent_s, true_s(there_s) + wrong_s, there_s + rng.uniform(0.0, 0.03))
    assert clock.steps == 0
    known = clock.estimate
    assert known is not None
    assert abs(known.theirs_s(known.at_s) - true_s(known.at_s)) < known.uncertainty_s
