# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Who drives to a place and parks there stands there later, and not from the start."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from aurora_core.outcomes.grounded import GroundedScenario, ReleaseOn
from aurora_core.spec.parking import parks, parks_after
from aurora_core.spec.scenario import ScenarioSpec

Read = Callable[..., ScenarioSpec]
MARKET = 'landmark:Harbor Market'


@pytest.mark.parametrize(
    ('prompt', 'later'),
    [
        ('A truck drives to Harbor Market and parks there.', MARKET),
        ('A truck is parked at Harbor Market.', None),
        ('A truck drives to Harbor Market.', None),
    ],
)
def test_parking_after_a_way(prompt: str, later: str | None, read_prompt: Read) -> None:
    spec = read_prompt(prompt, 'downtown')
    (truck,) = spec.agents
    assert parks_after(spec, truck) == later
    assert parks(spec, truck) is ('is parked' in prompt)


def test_it_starts_elsewhere_and_stops_at_the_place(
    read_prompt: Read, ground: Callable[..., GroundedScenario]
) -> None:
    prompt = 'A truck drives to Harbor Market and parks there.'
    (truck,) = ground(read_prompt(prompt, 'downtown'), 'downtown').agents
    assert not truck.parked
    assert truck.release is not ReleaseOn.NEVER
    assert truck.stop_lane_id
