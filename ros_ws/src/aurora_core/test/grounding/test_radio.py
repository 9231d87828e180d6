# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The communication term of the anchor score falls with what the links of a request lack."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from aurora_core.outcomes.grounded import GroundedScenario
from aurora_core.spec.scenario import ScenarioSpec

Read = Callable[[str], ScenarioSpec]
Ground = Callable[..., GroundedScenario]

ASKED = 'A drone hovers over the ego car at 80 meters for 10 seconds and sends it a message.'


def comm(spec: ScenarioSpec, ground: Ground) -> float:
    return ground(spec).score.comm


def with_range(spec: ScenarioSpec, range_m: float | None) -> ScenarioSpec:
    (link,) = spec.links
    (altitude,) = (m.altitude_m for m in spec.missions)
    stated = None if range_m is None else altitude.model_copy(update={'value': range_m})
    return spec.model_copy(update={'links': (link.model_copy(update={'range_m': stated}),)})


def test_a_link_that_reaches_costs_nothing(read_prompt: Read, ground: Ground) -> None:
    assert comm(with_range(read_prompt(ASKED), None), ground) == 1.0


def test_beyond_its_range_a_link_counts_by_the_share_it_reaches(
    read_prompt: Read, ground: Ground
) -> None:
    # The drone is at least its altitude above the car.
    found = [comm(with_range(read_prompt(ASKED), range_m), ground) for range_m in (40.0, 20.0)]
    assert found[0] == pytest.approx(2.0 * found[1])
    assert 0.3 < found[0] <= 40.0 / 79.0


def test_without_a_link_nothing_is_lost(read_prompt: Read, ground: Ground) -> None:
    spec = read_prompt('A drone hovers over the ego car at 80 meters for 10 seconds.')
    assert not spec.links
    assert comm(spec, ground) == 1.0
