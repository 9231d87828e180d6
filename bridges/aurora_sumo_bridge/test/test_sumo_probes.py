# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Driving, standing and walking for the records: what is measured is what SUMO does."""

from __future__ import annotations

from pathlib import Path

import libsumo
import pytest

from aurora_core.errors import GroundSimulatorError
from aurora_core.knowledge.config_files import config_path
from aurora_core.knowledge.map_model import load_map
from aurora_sumo_bridge.drive_probe import measure_types
from aurora_sumo_bridge.spawn_probe import Spot, probe_spawns
from aurora_sumo_bridge.walk_probe import probe_walks

DT_S = 0.05
MAP = load_map('junction')
NET = MAP.net_path
VTYPES = config_path('maps', 'vtypes.add.xml')


def _with(folder: Path, old: str, new: str) -> Path:
    text = VTYPES.read_text(encoding='utf-8')
    assert old in text
    file = folder / 'vtypes.add.xml'
    file.write_text(text.replace(old, new), encoding='utf-8')
    return file


def test_a_type_is_measured_to_do_what_it_declares() -> None:
    told: list[str] = []
    car, bicycle = measure_types(VTYPES, ['car', 'bicycle'], DT_S, told.append)
    assert told == ['car', 'bicycle']
    assert (car.max_speed_mps, car.accel_mps2, car.decel_mps2) == (55.0, 2.6, 4.5)
    assert (car.length_m, car.width_m, car.height_m) == (4.6, 1.8, 1.5)
    assert car.desired_speed_mps is None
    assert (bicycle.max_speed_mps, bicycle.desired_speed_mps) == (10.0, 5.56)
    assert not libsumo.isLoaded()


def test_a_changed_type_is_measured_anew(tmp_path: Path) -> None:
    vtypes = _with(tmp_path, 'maxSpeed="36.00" accel="1.30"', 'maxSpeed="21.00" accel="0.70"')
    (truck,) = measure_types(vtypes, ['truck'], DT_S, lambda _: None)
    assert (truck.max_speed_mps, truck.accel_mps2) == (21.0, 0.7)


def test_walkers_change_their_speed_within_a_step() -> None:
    (walker,) = measure_types(VTYPES, ['pedestrian'], DT_S, lambda _: None)
    assert walker.is_person
    assert walker.max_speed_mps == 3.0
    assert walker.accel_mps2 == walker.decel_mps2 == pytest.approx(1.4 / DT_S)


def test_a_type_that_is_not_there() -> None:
    with pytest.raises(GroundSimulatorError, match="no type 'tank'"):
        measure_types(VTYPES, ['tank'], DT_S, lambda _: None)
    assert not libsumo.isLoaded()


def test_a_type_that_never_moves(tmp_path: Path) -> None:
    vtypes = _with(tmp_path, 'maxSpeed="36.00" accel="1.30"', 'maxSpeed="36.00" accel="0.01"')
    with pytest.raises(GroundSimulatorError, match='no steady speed'):
        measure_types(vtypes, ['truck'], DT_S, lambda _: None)


def _lane() -> str:
    return MAP.network.driving_lanes('passenger')[0].id


def test_a_car_stands_where_it_may_and_nowhere_else() -> None:
    lane = _lane()
    spots = [Spot(lane, 20.0), Spot(lane, 30.0), Spot(lane, 9999.0)]
    first, second, beyond = probe_spawns(NET, VTYPES, 'car', spots, DT_S)
    assert (first, second) == ('', '')
    assert 'the lane ends at' in beyond
    assert not libsumo.isLoaded()


def test_what_is_longer_than_the_road_does_not_stand(tmp_path: Path) -> None:
    vtypes = _with(tmp_path, 'length="12.00"', 'length="420.00"')
    answers = probe_spawns(NET, vtypes, 'bus', [Spot(_lane(), 120.0)], DT_S)
    assert answers[0]


def test_every_sidewalk_and_crossing_of_the_junction_is_walked() -> None:
    crossings = [crossing.id for crossing in MAP.network.crossings]
    sidewalks = [lane.id for lane in MAP.network.sidewalks]
    along, over = probe_walks(NET, VTYPES, sidewalks, crossings, DT_S)
    assert [walk.id for walk in along] == sidewalks
    assert [walk.id for walk in over] == crossings
    assert all(walk.walked and walk.seconds > 0.0 for walk in (*along, *over))
    assert max(walk.seconds for walk in over) < 30.0
    assert not libsumo.isLoaded()


def test_without_anything_to_walk() -> None:
    assert probe_walks(NET, VTYPES, [], [], DT_S) == ((), ())
