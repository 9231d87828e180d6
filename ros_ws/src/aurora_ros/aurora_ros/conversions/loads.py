# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Loads of the simulators: core values to and from the `Load…` requests."""

from __future__ import annotations

from array import array

from pydantic import TypeAdapter, ValidationError

from aurora_core.errors import AirSimulatorError, GroundSimulatorError, MapError
from aurora_core.knowledge.config_files import config_path
from aurora_core.knowledge.map_folders import map_folder
from aurora_core.knowledge.map_manifest import read_manifest
from aurora_core.knowledge.map_model import NET_NAME
from aurora_core.ports.simulators import AirLoad, GroundAgentLoad, GroundLoad, UavHome
from aurora_msgs.srv import LoadGround, LoadUav

VTYPES_PATH = ('maps', 'vtypes.add.xml')
_AGENTS = TypeAdapter(tuple[GroundAgentLoad, ...])


def ground_request(
    load: GroundLoad, *, run_id: str, run_number: int, horizon_s: float, listeners: int
) -> LoadGround.Request:
    """Return the request that loads the ground simulator; paths stay behind, the digest goes."""
    return LoadGround.Request(
        run_id=run_id,
        run_number=run_number,
        map_name=load.map_name,
        map_digest=load.map_digest,
        seed=load.seed,
        dt_s=load.dt_s,
        horizon_s=horizon_s,
        weather=load.weather,
        agents_json=_AGENTS.dump_json(load.agents).decode('utf-8'),
        listeners=listeners,
    )


def ground_load(request: LoadGround.Request) -> GroundLoad:
    """Return what the simulator needs, with the files of this machine's map.

    Raises:
        MapError: The map is missing, changed, or not the one of the request.
        GroundSimulatorError: The agents cannot be read.
    """
    folder = map_folder(request.map_name)
    manifest = read_manifest(folder)
    if manifest.digest != request.map_digest:
        raise MapError(
            f'map {request.map_name}: expected digest {request.map_digest or "(none)"}, found '
            f'{manifest.digest}',
            component='sumo_bridge',
            hint='ground the scenario again on this map',
        )
    try:
        agents = _AGENTS.validate_json(request.agents_json)
    except ValidationError as err:
        raise GroundSimulatorError(f'agents_json is not valid: {err}') from err
    return GroundLoad(
        map_name=request.map_name,
        net_path=folder / NET_NAME,
        vtypes_path=config_path(*VTYPES_PATH),
        map_digest=request.map_digest,
        dt_s=request.dt_s,
        seed=request.seed,
        agents=agents,
        weather=request.weather,
    )


def uav_request(
    load: AirLoad, *, run_id: str, run_number: int, horizon_s: float, listeners: int
) -> LoadUav.Request:
    """Return the request that loads the air simulator."""
    return LoadUav.Request(
        run_id=run_id,
        run_number=run_number,
        seed=load.seed,
        dt_s=load.dt_s,
        horizon_s=horizon_s,
        uav_id=[home.uav_id for home in load.homes],
        system_id=array('B', [home.system_id for home in load.homes]),
        home_xy_m=array('d', [v for home in load.homes for v in (home.x_m, home.y_m)]),
        home_yaw_enu_rad=array('d', [home.yaw_enu_rad for home in load.homes]),
        origin_lat_deg=load.origin_lat_deg,
        origin_lon_deg=load.origin_lon_deg,
        origin_alt_m=load.origin_alt_m,
        wind_mean_east_mps=load.wind_mean_east_mps,
        wind_mean_north_mps=load.wind_mean_north_mps,
        wind_gust_mps=load.wind_gust_mps,
        listeners=listeners,
    )


def air_load(request: LoadUav.Request) -> AirLoad:
    """Return what the air simulator needs.

    Raises:
        AirSimulatorError: The arrays of the request have different lengths.
    """
    xy_m = request.home_xy_m
    try:
        homes = tuple(
            UavHome(uav_id=uav_id, system_id=system_id, x_m=x_m, y_m=y_m, yaw_enu_rad=yaw)
            for uav_id, system_id, x_m, y_m, yaw in zip(
                request.uav_id,
                request.system_id,
                xy_m[0::2],
                xy_m[1::2],
                request.home_yaw_enu_rad,
                strict=True,
            )
        )
    except ValueError as err:
        raise AirSimulatorError(f'load of the UAVs: {err}') from err
    return AirLoad(
        dt_s=request.dt_s,
        seed=request.seed,
        homes=homes,
        origin_lat_deg=request.origin_lat_deg,
        origin_lon_deg=request.origin_lon_deg,
        origin_alt_m=request.origin_alt_m,
        wind_mean_east_mps=request.wind_mean_east_mps,
        wind_mean_north_mps=request.wind_mean_north_mps,
        wind_gust_mps=request.wind_gust_mps,
    )
