# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Loads of the simulators through their requests and back."""

from __future__ import annotations

import dataclasses
import shutil
from array import array
from pathlib import Path
from typing import Any

import pytest

pytest.importorskip('rclpy')

from aurora_core.errors import AirSimulatorError, ConfigError, GroundSimulatorError, MapError
from aurora_core.knowledge.config_files import config_path
from aurora_core.knowledge.map_manifest import read_manifest, write_manifest
from aurora_core.ports.simulators import AirLoad, GroundAgentLoad, GroundLoad, UavHome
from aurora_ros.conversions.loads import air_load, ground_load, ground_request, uav_request

FOLDER = config_path('maps', 'junction')
GROUND = GroundLoad(
    map_name='junction',
    net_path=FOLDER / 'net.xml.gz',
    vtypes_path=config_path('maps', 'vtypes.add.xml'),
    map_digest=read_manifest(FOLDER).digest,
    dt_s=0.05,
    seed=7,
    agents=(
        GroundAgentLoad(
            agent_id='ego',
            type_name='car',
            is_person=False,
            edges=('a', 'b'),
            lane_id='a_0',
            lane_position_m=1.0 / 3.0,
            time_gap_s=0.8,
        ),
        GroundAgentLoad(
            agent_id='walker',
            type_name='pedestrian',
            is_person=True,
            edges=('a',),
            lane_id='',
            lane_position_m=3.0,
            arrival_position_m=9.5,
        ),
    ),
    weather='rain',
)
AIR = AirLoad(
    dt_s=0.05,
    seed=3,
    homes=(
        UavHome(uav_id='uav1', system_id=1, x_m=0.1, y_m=-2.0, yaw_enu_rad=1.5),
        UavHome(uav_id='uav2', system_id=250, x_m=5.0, y_m=6.0),
    ),
    origin_lat_deg=48.1,
    origin_lon_deg=11.5,
    origin_alt_m=12.5,
    wind_mean_east_mps=1.0,
    wind_mean_north_mps=-2.0,
    wind_gust_mps=0.5,
)
RUN: dict[str, Any] = {'run_id': 'r', 'run_number': 5, 'horizon_s': 60.0, 'listeners': 2}


def test_ground_load_survives() -> None:
    assert ground_load(ground_request(GROUND, **RUN)) == GROUND


def test_air_load_survives() -> None:
    assert air_load(uav_request(AIR, **RUN)) == AIR


@pytest.mark.parametrize('digest', ['', '0' * 64])
def test_another_map_digest_is_refused(digest: str) -> None:
    request = ground_request(dataclasses.replace(GROUND, map_digest=digest), **RUN)
    with pytest.raises(MapError, match='map junction: expected digest'):
        ground_load(request)


def test_an_unknown_map_is_refused() -> None:
    request = ground_request(dataclasses.replace(GROUND, map_name='atlantis'), **RUN)
    with pytest.raises(ConfigError, match='atlantis'):
        ground_load(request)


@pytest.mark.parametrize('text', ['', '{', '[{}]', '[{"agent_id": 1}]'])
def test_agents_that_cannot_be_read_are_refused(text: str) -> None:
    request = ground_request(GROUND, **RUN)
    request.agents_json = text
    with pytest.raises(GroundSimulatorError, match='agents_json is not valid'):
        ground_load(request)


def test_uneven_arrays_are_refused() -> None:
    request = uav_request(AIR, **RUN)
    request.home_yaw_enu_rad = array('d', [0.0])
    with pytest.raises(AirSimulatorError, match='load of the UAVs'):
        air_load(request)


def test_a_map_of_the_user_is_found_by_its_name(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    folder = shutil.copytree(FOLDER, tmp_path / 'mine')
    manifest = read_manifest(folder)
    write_manifest(folder, manifest.model_copy(update={'name': 'mine'}))
    monkeypatch.setenv('AURORA_MAPS', str(tmp_path))
    load = dataclasses.replace(GROUND, map_name='mine', map_digest=read_manifest(folder).digest)
    request = ground_request(load, run_id='r', run_number=1, horizon_s=1.0, listeners=0)
    assert ground_load(request).net_path == folder / 'net.xml.gz'


@pytest.mark.parametrize('name', ['../maps/junction', 'atlantis', ''])
def test_a_name_that_is_no_map_is_refused(name: str) -> None:
    load = dataclasses.replace(GROUND, map_name=name)
    request = ground_request(load, run_id='r', run_number=1, horizon_s=1.0, listeners=0)
    with pytest.raises(MapError, match='there is no map'):
        ground_load(request)
