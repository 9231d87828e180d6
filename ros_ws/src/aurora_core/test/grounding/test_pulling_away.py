# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""A target that drives faster than its UAV is tracked from ahead of it, while it is near."""

from __future__ import annotations

from collections.abc import Callable
from math import hypot

import pytest

from aurora_core.grounding.pulling_away import PullingAway
from aurora_core.mission.plan import MissionPlan
from aurora_core.outcomes.grounded import GroundedScenario
from aurora_core.spec.scenario import ScenarioSpec

POLICE = 'A police car drives at 20 m/s. A drone tracks the police car from 30 m at 50 m altitude'


def kept_by_steps_s(away: PullingAway, offset: tuple[float, float]) -> float:
    """Fall behind in small steps until the target is too near or too far."""
    hx, hy = away.heading
    t = 0.0
    while t < 1000.0:
        x, y = (o - away.gains_mps * t * h for o, h in zip(offset, (hx, hy), strict=True))
        if not away.near_m <= hypot(x, y) <= away.far_m:
            return t
        t += 0.01
    return t


@pytest.mark.parametrize('heading', [(1.0, 0.0), (0.6, 0.8)])
@pytest.mark.parametrize(
    ('near_m', 'far_m', 'standoff_m'), [(25.0, 35.0, 30.0), (10.0, 20.0, 15.0), (0.0, 10.0, None)]
)
def test_it_stays_near_for_as_long_as_told_and_no_way_round_for_longer(
    heading: tuple[float, float], near_m: float, far_m: float, standoff_m: float | None
) -> None:
    away = PullingAway(
        gains_mps=2.0,
        heading=heading,
        near_m=near_m,
        far_m=far_m,
        standoff_m=standoff_m,
        top_mps=18.0,
    )
    best_s = max(away.kept_s(offset) for offset in away.offsets())
    hx, hy = heading
    for offset in away.offsets():
        assert away.kept_s(offset) == pytest.approx(kept_by_steps_s(away, offset), abs=0.02)
    from_m = far_m - 2.0 if standoff_m is None else standoff_m
    for ahead in (-1.0, -0.6, 0.0, 0.6, 0.8, 1.0):
        aside = (1.0 - ahead * ahead) ** 0.5
        there = (from_m * (ahead * hx - aside * hy), from_m * (ahead * hy + aside * hx))
        told_s = away.kept_s(there)
        assert told_s == pytest.approx(kept_by_steps_s(away, there), abs=0.02)
        # Nearer to the inner circle than it keeps one may be near for a little longer.
        assert told_s <= best_s * 1.05 + 0.1


def test_the_uav_begins_ahead_and_its_phase_ends_before_the_target_is_gone(
    read_prompt: Callable[..., ScenarioSpec], ground: Callable[..., GroundedScenario]
) -> None:
    plan, heading = _tracked(f'{POLICE}.', read_prompt, ground)
    ahead_m = plan.offset_m[0] * heading[0] + plan.offset_m[1] * heading[1]
    assert hypot(*plan.offset_m) == pytest.approx(30.0)
    assert 14.0 < ahead_m < 16.0
    # It needs 6 s to be as fast as the UAV, and gets from 15 m behind it to 23 m ahead in 19 s:
    # they are 85 % of the phase.
    assert plan.duration_s is not None
    assert 28.0 < plan.duration_s < 30.0


def test_a_stated_duration_stays_and_so_does_a_slower_target(
    read_prompt: Callable[..., ScenarioSpec], ground: Callable[..., GroundedScenario]
) -> None:
    plan, _ = _tracked(f'{POLICE} for 40 seconds.', read_prompt, ground)
    assert plan.duration_s == 40.0
    slow, _ = _tracked(f'{POLICE}.'.replace('20 m/s', '10 m/s'), read_prompt, ground)
    assert slow.duration_s == 30.0


def _tracked(
    prompt: str,
    read_prompt: Callable[..., ScenarioSpec],
    ground: Callable[..., GroundedScenario],
) -> tuple[MissionPlan, tuple[float, float]]:
    """Return the planned tracking, and where the target heads at first."""
    found = ground(read_prompt(prompt, 'downtown'), 'downtown')
    target = next(a for a in found.agents if a.type_name == 'police')
    (plan,) = found.uavs[0].missions
    return plan, (target.heading_x, target.heading_y)
