# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Every spawn example is a spot that the network really has."""

from __future__ import annotations

import pytest

from aurora_core.knowledge.map_folders import list_maps
from aurora_core.knowledge.map_model import load_map
from aurora_core.retrieval.record import Record
from aurora_core.retrieval.spawns import spawn_records


@pytest.mark.parametrize('name', list_maps())
def test_lanes_positions_and_limits_are_those_of_the_map(name: str) -> None:
    map_model = load_map(name)
    records = spawn_records(map_model)
    assert len({record.id for record in records}) == len(records)
    on_lanes = [record for record in records if 'lane' in record.data]
    assert len(on_lanes) >= len(map_model.landmarks) + len(map_model.bus_stops)
    for record in on_lanes:
        lane = map_model.network.lane(str(record.data['lane']))
        x, y, _, _ = map_model.network.position_on_lane(lane.id, number(record, 'pos_m'))
        assert (number(record, 'x_m'), number(record, 'y_m')) == pytest.approx((x, y), abs=0.02)
        assert number(record, 'speed_limit_mps') == pytest.approx(lane.speed_limit_mps, abs=0.01)
        assert not lane.is_internal


def test_what_the_downtown_map_is_known_to_have() -> None:
    records = {record.id: record for record in spawn_records(load_map('downtown'))}
    hall = records['landmark:City Hall']
    assert (hall.data['place_x_m'], hall.data['place_y_m']) == (318.0, 118.0)
    assert hall.data['reference'] == 'landmark:City Hall'
    assert records['street:Foundry Avenue'].data['one_way'] is True
    corner = records['intersection:Grand Boulevard and Market Street (market_boulevard)']
    assert corner.data['has_signal'] is True
    assert records['parking:Cannery Street parking (north side)'].data['places'] == 9


def number(record: Record, name: str) -> float:
    value = record.data[name]
    assert isinstance(value, int | float)
    return float(value)
