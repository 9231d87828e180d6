# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Where an annotation is silent, a reference has what the product takes for the unsaid."""

from __future__ import annotations

import pytest

from aurora_bench.prompts.reference_parts import DEFAULTS, SIZE_M
from aurora_core.parsing.values import default, unsaid_values

# Names of the references, and of the product's table.
SAME = {
    'altitude_m': 'altitude',
    'standoff_m': 'standoff',
    'duration_s': 'mission_duration',
    'speed_mps': 'route_speed',
    'latency_s': 'link_latency',
    'loss': 'link_loss',
    'retransmissions': 'link_retransmissions',
    'retransmission_interval_s': 'link_retransmission_interval',
    'value_m': 'trigger_distance',
    'at_s': 'trigger_time',
    'radius_m': 'orbit_radius',
    'waypoint_count': 'waypoint_count',
}


@pytest.mark.parametrize('name', SAME)
def test_the_unsaid_has_the_value_of_the_product_inside_its_domain(name: str) -> None:
    value, low, high = DEFAULTS[name]
    given = default(SAME[name])
    assert value == given.value
    assert given.low <= low <= value <= high <= given.high


def test_an_unsaid_rectangle_has_the_size_of_the_product() -> None:
    sizes = unsaid_values()
    assert (sizes['pattern_length'], sizes['pattern_width']) == SIZE_M


def test_only_the_speed_of_a_trigger_is_a_value_of_its_own() -> None:
    assert DEFAULTS.keys() - SAME.keys() == {'value_mps'}
