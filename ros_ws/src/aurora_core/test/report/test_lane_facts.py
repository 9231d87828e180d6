# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What is said of the lanes of a map is counted on its network."""

from __future__ import annotations

from aurora_core.knowledge.lane_samples import sample_lanes
from aurora_core.knowledge.map_model import load_map
from aurora_core.report.lane_facts import along_lanes


def test_shares_are_those_of_the_network() -> None:
    model = load_map('downtown')
    samples, network = sample_lanes(model), model.network
    said = {text.split(maxsplit=1)[1]: text.split()[0] for text in along_lanes(samples)[:-1]}
    lanes = [network.lane(samples.lane_ids[k]) for k in samples.lane]
    driven = set(samples.lane_ids)  # a walkway beside a lane is no second one
    two = sum(bool({lane.left_lane_id, lane.right_lane_id} & driven) for lane in lanes)
    assert said['a second lane'] == f'{two / len(lanes):.0%}' != '100%'
    met = sum(network.opposite_edge(lane.edge_id) is not None for lane in lanes) / len(lanes)
    assert abs(int(said['an oncoming lane'].rstrip('%')) - 100.0 * met) < 3.0
    assert said['a walkway beside'] == '100%'
    low, high = (round(f(lane.speed_limit_mps for lane in lanes), 1) for f in (min, max))
    assert along_lanes(samples)[-1] == f'limits of {low} to {high} m/s'
