# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Gusts: seeded, bounded, of the stated strength."""

from __future__ import annotations

import itertools
import math

import pytest

from aurora_uav_sim.wind import Wind, wind_stream


def gusts(seed: int, system_id: int, steps: int = 20_000) -> list[tuple[float, float, float]]:
    wind = Wind()
    wind.set(6.0, -2.0, 0.0, 4.0)
    wind.seed(wind_stream(seed, system_id))
    out = []
    for _ in range(steps):
        wind.step(0.01)
        out.append((wind.x, wind.y, wind.z))
    return out


def test_same_seed_same_wind_other_vehicle_other_wind() -> None:
    assert gusts(7, 1, 500) == gusts(7, 1, 500)
    assert gusts(7, 1, 500) != gusts(8, 1, 500)
    assert gusts(7, 1, 500) != gusts(7, 2, 500)


def test_strength_and_bounds() -> None:
    series = gusts(1, 1, 200_000)
    east = [x - 6.0 for x, _, _ in series]
    assert sum(east) / len(east) == pytest.approx(0.0, abs=0.3)
    deviation = math.sqrt(sum(g * g for g in east) / len(east))
    # Half the amplitude, a little less for being bounded.
    assert 1.6 < deviation < 2.1
    assert max(abs(g) for g in east) <= 4.0
    assert max(abs(z) for _, _, z in series) <= 2.0


def test_gusts_are_smooth() -> None:
    series = gusts(3, 1, 1000)
    jumps = [abs(b[0] - a[0]) for a, b in itertools.pairwise(series)]
    assert max(jumps) < 0.6


def test_no_gust_is_the_mean_alone() -> None:
    wind = Wind()
    wind.set(1.0, 2.0, 3.0, 0.0)
    wind.seed(wind_stream(1, 1))
    wind.step(0.01)
    assert (wind.x, wind.y, wind.z) == (1.0, 2.0, 3.0)


def test_seeding_again_starts_over() -> None:
    wind = Wind()
    wind.set(0.0, 0.0, 0.0, 4.0)
    series = []
    for _ in range(2):
        wind.seed(wind_stream(5, 3))
        for _ in range(100):
            wind.step(0.01)
        series.append((wind.x, wind.y, wind.z))
    assert series[0] == series[1]
