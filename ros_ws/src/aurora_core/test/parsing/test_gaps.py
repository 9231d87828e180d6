# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""A verb said once for two UAVs, and never given to a vehicle."""

from __future__ import annotations

import pytest

from aurora_core.outcomes.parse import ParseContext
from aurora_core.parsing.parser import parse_offline


@pytest.mark.parametrize(
    'prompt',
    [
        'Drone A follows the bus at 40 m altitude, drone B the truck at 60 m altitude.',
        'Two UAVs: one tracks the bus at 40 m altitude, the other the truck at 60 m altitude.',
        'Two UAVs. The first follows the bus, 40 m up, and the second the truck, 60 m up.',
    ],
)
def test_the_other_uav_does_the_same(prompt: str) -> None:
    outcome = parse_offline(prompt, ParseContext())
    assert outcome.spec is not None
    flown = [(m.mode.value, m.target, m.altitude_m.value) for m in outcome.spec.missions]
    assert flown == [('track', 'bus1', 40.0), ('track', 'truck1', 60.0)]


def test_a_vehicle_gets_no_verb() -> None:
    outcome = parse_offline('A bus follows the ego, a van 20 m behind it.', ParseContext())
    assert outcome.spec is not None
    van = next(a for a in outcome.spec.agents if a.id == 'van1')
    assert not van.behaviors
