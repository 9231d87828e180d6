# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The simulator flown by MAVSDK's own calls: the judge is a client that knows PX4, not us."""

from __future__ import annotations

import itertools
import json
import queue
import threading
import time
from collections.abc import Callable, Iterator
from typing import Any

import numpy as np
import pytest
from mavsdk import ComponentType, Configuration, Mavsdk
from mavsdk.plugins.action import Action, ActionError
from mavsdk.plugins.geofence import Circle, FenceType, Geofence, GeofenceData, Point
from mavsdk.plugins.mission import Mission, MissionItem, MissionPlan
from mavsdk.plugins.mission_raw import MissionRaw
from mavsdk.plugins.offboard import Offboard, OffboardError, PositionNedYaw, VelocityNedYaw
from mavsdk.plugins.param import Param, ParamError
from mavsdk.plugins.telemetry import FlightMode, LandedState, Telemetry

from aurora_core.knowledge.config_files import config_path
from aurora_core.knowledge.limits import load_limits
from aurora_core.knowledge.world import Wind, WorldModel
from aurora_core.report.export.flight_plan import flight_plan
from aurora_core.trace.layout import (
    UAV_COMMAND_WIDTH,
    UAV_WIDTH,
    UavColumn,
    UavCommandColumn,
    UavMode,
    UavPhase,
)
from aurora_core.trace.roster import Roster, RosterEntry
from aurora_core.trace.trace import Trace
from aurora_uav_sim.mavlink_server import SimServer
from aurora_uav_sim.settings import PARAMETERS
from aurora_uav_sim.vehicle import Vehicle

LATITUDE_DEG, LONGITUDE_DEG = 47.397742, 8.545594
# 1e-4 degrees of latitude; the same eastwards is this, less the cosine.
STEP_DEG, STEP_M = 1e-4, 11.12
# Simulated time of one turn of the pump, and the wall time that it takes at least: faster than
# the clock, so that flights are short, yet slow enough for MAVSDK's own threads.
TURN_S, WALL_S = 0.02, 0.002
# A flight takes a minute of simulated time; a machine under load may be fifty times slower.
PATIENCE_S = 300.0


class Pilot:
    """MAVSDK on a wire to a simulator of one vehicle, whose time a thread moves.

    Attributes:
        vehicle: The truth.
        modes: Flight modes that MAVSDK saw, each change once.
        texts: What the vehicle said.
    """

    def __init__(self) -> None:
        self._server = SimServer((1,), ['mavsdk'])
        self.vehicle: Vehicle = self._server.vehicles[1]
        self._sent: queue.SimpleQueue[bytes] = queue.SimpleQueue()
        self._stop = threading.Event()
        self._turned = threading.Condition()
        configuration = Configuration.create_with_component_type(ComponentType.GROUND_STATION)
        self._mavsdk = Mavsdk(configuration)
        self._mavsdk.subscribe_raw_bytes_to_be_sent(self._sent.put)
        self._mavsdk.add_any_connection('raw://')
        self._thread = threading.Thread(target=self._pump)
        self._thread.start()
        system = self._mavsdk.first_autopilot(PATIENCE_S)
        assert system is not None
        self.action, self.telemetry = Action(system), Telemetry(system)
        self.mission, self.geofence = Mission(system), Geofence(system)
        self.mission_raw = MissionRaw(system)
        self.offboard, self.param = Offboard(system), Param(system)
        self.modes: list[FlightMode] = []
        self.texts: list[str] = []
        self.telemetry.subscribe_flight_mode(self._see_mode)
        self.telemetry.subscribe_status_text(lambda text, _: self.texts.append(text.text))

    def _see_mode(self, mode: FlightMode, _: Any) -> None:
        if self.modes[-1:] != [mode]:
            self.modes.append(mode)

    def _pump(self) -> None:
        now_s = 0.0
        while not self._stop.is_set():
            while not self._sent.empty():
                for reply in self._server.handle(self._sent.get(), 'mavsdk'):
                    self._mavsdk.pass_received_raw_bytes(reply)
            now_s += TURN_S
            for _, datagram in self._server.poll(now_s):
                self._mavsdk.pass_received_raw_bytes(datagram)
            with self._turned:
                self._turned.notify_all()
            self._stop.wait(WALL_S)

    def wait(self, what: str, condition: Callable[[], bool]) -> None:
        """Let time pass until something holds; fail by saying what did not."""
        until_s = time.monotonic() + PATIENCE_S
        while not condition():
            with self._turned:
                self._turned.wait(1.0)
            assert time.monotonic() < until_s, f'{what}; {self.modes}; {self.texts}'

    def take_off(self, height_m: float) -> None:
        """Arm and climb, by MAVSDK's calls."""
        self.wait('not ready', lambda: self.telemetry.health().is_armable)
        self.action.set_takeoff_altitude(height_m)
        self.action.arm()
        self.action.takeoff()
        body = self.vehicle.autopilot.body
        self.wait('take-off', lambda: abs(body.z - height_m) < 0.5)
        self.wait('hold', lambda: self.telemetry.flight_mode() == FlightMode.HOLD)

    def wait_landed(self) -> None:
        """Wait until MAVSDK sees it on the ground and disarmed."""
        self.wait('not landed', lambda: not self.telemetry.armed())
        self.wait('landed', lambda: self.telemetry.landed_state() == LandedState.ON_GROUND)

    def close(self) -> None:
        """End both."""
        self._stop.set()
        self._thread.join()
        self._mavsdk.destroy()


@pytest.fixture
def pilot() -> Iterator[Pilot]:
    made = Pilot()
    yield made
    made.close()


def item(north: float, east: float, height_m: float, **more: Any) -> MissionItem:
    return MissionItem(
        latitude_deg=LATITUDE_DEG + north * STEP_DEG,
        longitude_deg=LONGITUDE_DEG + east * STEP_DEG,
        relative_altitude_m=height_m,
        speed_m_s=8.0,
        is_fly_through=False,
        acceptance_radius_m=1.0,
        **more,
    )


def test_a_mission_of_five_items_and_the_way_home(pilot: Pilot) -> None:
    plan = MissionPlan(
        [
            item(0, 0, 10.0),
            item(2, 0, 12.0),
            item(2, 2, 15.0, loiter_time_s=1.0),
            item(0, 2, 12.0, yaw_deg=180.0),
            item(-1, 0, 10.0),
        ]
    )
    pilot.mission.set_return_to_launch_after_mission(True)
    pilot.mission.upload_mission(plan)
    back = pilot.mission.download_mission().mission_items
    assert [round(i.relative_altitude_m, 3) for i in back] == [10.0, 12.0, 15.0, 12.0, 10.0]
    assert back[2].latitude_deg == pytest.approx(plan.mission_items[2].latitude_deg, abs=1e-7)
    seen: list[tuple[int, int]] = []
    pilot.mission.subscribe_mission_progress(lambda p, _: seen.append((p.current, p.total)))
    pilot.wait('not ready', lambda: pilot.telemetry.health().is_armable)
    pilot.action.arm()
    pilot.mission.start_mission()
    body = pilot.vehicle.autopilot.body
    pilot.wait('third corner', lambda: (2, 5) in seen)
    pilot.mission.pause_mission()
    pilot.wait('pause', lambda: pilot.modes[-1:] == [FlightMode.HOLD])
    pilot.wait('still', lambda: body.vx**2 + body.vy**2 < 0.01)
    pilot.mission.start_mission()
    pilot.wait('not home', lambda: not pilot.telemetry.armed())
    pilot.wait('finished', lambda: pilot.mission.is_mission_finished())
    # Every item in order, and nothing skipped.
    assert sorted(set(seen)) == [(i, 5) for i in range(6)]
    assert [c for c, _ in seen] == sorted(c for c, _ in seen)
    home = pilot.vehicle.home
    assert (body.x, body.y) == pytest.approx(home[:2], abs=1.0)
    flown = [m for m in pilot.modes if m in (FlightMode.MISSION, FlightMode.RETURN_TO_LAUNCH)]
    assert flown[0] == FlightMode.MISSION
    assert flown[-1] == FlightMode.RETURN_TO_LAUNCH
    pilot.mission.clear_mission()
    assert pilot.vehicle.pilot.mission.items == ()


# Corners of a recorded flight, ENU, m.
CORNERS = ((0.0, 0.0, 10.0), (0.0, 25.0, 10.0), (20.0, 25.0, 14.0))


def _recorded_flight() -> tuple[Trace, WorldModel]:
    """Up, 5 m/s past the corners with 6 s at the second one, and down: dt 0.1 s."""
    legs = [np.linspace(a, b, 50, endpoint=False) for a, b in itertools.pairwise(CORNERS)]
    up = np.linspace((0.0, 0.0, 0.0), CORNERS[0], 50, endpoint=False)
    down = np.linspace(CORNERS[-1], (*CORNERS[-1][:2], 0.0), 100)
    places = np.concatenate([up, legs[0], np.tile(CORNERS[1], (60, 1)), legs[1], down])
    uav = np.zeros((len(places), 1, UAV_WIDTH))
    uav[:, 0, : UavColumn.VX] = places
    uav[:, 0, UavColumn.LANDED] = places[:, 2] <= 0.0
    commands = np.zeros((len(places), 1, UAV_COMMAND_WIDTH))
    commands[:50, 0, UavCommandColumn.PHASE] = UavPhase.ASCENT
    commands[50:-100, 0, UavCommandColumn.PHASE] = UavPhase.MISSION
    commands[-100:, 0, UavCommandColumn.PHASE] = UavPhase.LANDING
    commands[-100:, 0, UavCommandColumn.MODE] = UavMode.LAND
    entry = RosterEntry(
        body_id='uav1', type_name='uav', is_person=False, system_id=1, length_m=0.7,
        width_m=0.7, height_m=0.3,
    )  # fmt: skip
    trace = Trace(
        roster=Roster(dt_s=0.1, agents=(), uavs=(entry,)),
        ground=np.zeros((len(places), 0, 7)),
        uav=uav,
        uav_commands=commands,
        ground_commands=((),) * len(places),
    )
    world = WorldModel(
        map_name='field', map_digest='d' * 64, origin_lat_deg=LATITUDE_DEG,
        origin_lon_deg=LONGITUDE_DEG, weather='clear', time_of_day='noon', wind=Wind(),
        buildings=(), no_fly_zones=(), surfaces=(), lanes=(), signals=(),
        limits=load_limits(config_path('limits.json')),
    )  # fmt: skip
    return trace, world


def test_an_exported_plan_is_read_by_its_importer_and_flown(pilot: Pilot) -> None:
    trace, world = _recorded_flight()
    text = json.dumps(flight_plan(trace, world, 0))
    read = pilot.mission_raw.import_qgroundcontrol_mission_from_string(text)
    commands = [i.command for i in read.mission_items]
    assert (commands[0], commands[-1]) == (22, 21)
    pilot.mission_raw.upload_mission(read.mission_items)
    pilot.wait('not ready', lambda: pilot.telemetry.health().is_armable)
    pilot.action.arm()
    pilot.mission_raw.start_mission()
    body = pilot.vehicle.autopilot.body
    nearest = [1e9] * len(CORNERS)

    def home() -> bool:
        for k, corner in enumerate(CORNERS):
            off = np.linalg.norm(np.subtract((body.x, body.y, body.z), corner))
            nearest[k] = min(nearest[k], float(off))
        return nearest[-1] < 3.0 and not pilot.telemetry.armed()

    pilot.wait('flown and landed', home)
    assert max(nearest) < 2.0
    assert (body.x, body.y) == pytest.approx(CORNERS[-1][:2], abs=1.0)


def test_take_off_go_to_hold_land(pilot: Pilot) -> None:
    pilot.take_off(8.0)
    pilot.action.goto_location(LATITUDE_DEG + STEP_DEG, LONGITUDE_DEG, 488.0 + 12.0, 90.0)
    body = pilot.vehicle.autopilot.body
    pilot.wait('goto', lambda: abs(body.y - STEP_M) < 0.5 and abs(body.z - 12.0) < 0.5)
    pilot.action.hold()
    assert pilot.telemetry.in_air()
    pilot.wait('AMSL', lambda: abs(pilot.telemetry.position().absolute_altitude_m - 500.0) < 0.5)
    assert pilot.telemetry.position().relative_altitude_m == pytest.approx(12.0, abs=0.5)
    assert pilot.telemetry.home().absolute_altitude_m == pytest.approx(488.0, abs=0.1)
    pilot.action.land()
    pilot.wait_landed()
    assert abs(body.y - STEP_M) < 1.0


def test_return_to_launch_climbs_first(pilot: Pilot) -> None:
    pilot.take_off(6.0)
    pilot.action.goto_location(LATITUDE_DEG + STEP_DEG, LONGITUDE_DEG, 488.0 + 6.0, 0.0)
    body = pilot.vehicle.autopilot.body
    pilot.wait('goto', lambda: abs(body.y - STEP_M) < 0.5)
    pilot.action.set_return_to_launch_altitude(20.0)
    assert pilot.action.get_return_to_launch_altitude() == pytest.approx(20.0)
    pilot.action.return_to_launch()
    pilot.wait('climb', lambda: body.z > 18.0)
    assert abs(body.y - STEP_M) < 1.0
    pilot.wait_landed()
    assert abs(body.x) < 1.0
    assert abs(body.y) < 1.0


def test_offboard_by_position_and_velocity_and_its_loss(pilot: Pilot) -> None:
    # MAVSDK repeats its set-points by the clock on the wall.
    pilot.param.set_param_float('COM_OF_LOSS_T', 60.0)
    pilot.take_off(5.0)
    with pytest.raises(OffboardError):
        pilot.offboard.start()
    pilot.offboard.set_position_ned(PositionNedYaw(5.0, -4.0, -9.0, 90.0))
    pilot.offboard.start()
    body = pilot.vehicle.autopilot.body
    pilot.wait('position', lambda: abs(body.y - 5.0) + abs(body.x + 4.0) + abs(body.z - 9.0) < 0.5)
    pilot.offboard.set_velocity_ned(VelocityNedYaw(3.0, 0.0, 0.0, 0.0))
    pilot.wait('velocity', lambda: body.vy > 2.8 and abs(body.vx) < 0.3)
    pilot.offboard.stop()
    pilot.wait('stop', lambda: pilot.telemetry.flight_mode() == FlightMode.HOLD)
    assert not pilot.offboard.is_active()


def test_parameters_with_type_and_range(pilot: Pilot) -> None:
    everything = pilot.param.get_all_params()
    names = {p.name for p in everything.int_params} | {p.name for p in everything.float_params}
    assert names == {row.name for row in PARAMETERS}
    assert {p.name for p in everything.int_params} == {r.name for r in PARAMETERS if r.whole}
    pilot.param.set_param_float('MPC_XY_CRUISE', 7.5)
    assert pilot.param.get_param_float('MPC_XY_CRUISE') == 7.5
    assert pilot.vehicle.autopilot.settings.cruise_mps == 7.5
    pilot.param.set_param_int('NAV_DLL_ACT', 2)
    assert pilot.param.get_param_int('NAV_DLL_ACT') == 2
    with pytest.raises(ParamError):
        pilot.param.get_param_int('MPC_XY_CRUISE')
    with pytest.raises(ParamError):
        pilot.param.get_param_float('NO_SUCH_ONE')
    with pytest.raises(ParamError):
        pilot.param.set_param_float('MPC_XY_CRUISE', 500.0)
    assert pilot.vehicle.autopilot.settings.cruise_mps == 7.5


def test_a_low_battery_brings_it_home(pilot: Pilot) -> None:
    pilot.take_off(6.0)
    full = pilot.telemetry.battery()
    assert full.voltage_v == pytest.approx(4 * 4.05, abs=0.2)
    assert full.remaining_percent > 90.0
    pilot.action.goto_location(LATITUDE_DEG + STEP_DEG, LONGITUDE_DEG, 488.0 + 6.0, 0.0)
    pilot.wait('goto', lambda: pilot.vehicle.autopilot.body.y > STEP_M - 1.0)
    pilot.param.set_param_int('COM_LOW_BAT_ACT', 3)
    pilot.param.set_param_float('SIM_BAT_DRAIN', 400.0)
    pilot.param.set_param_float('SIM_BAT_MIN_PCT', 6.0)
    pilot.vehicle.pilot.battery.share = 0.075
    pilot.wait('return', lambda: FlightMode.RETURN_TO_LAUNCH in pilot.modes)
    pilot.wait_landed()
    assert any('battery critical: return' in text for text in pilot.texts)
    assert pilot.telemetry.battery().remaining_percent < 8.0
    assert abs(pilot.vehicle.autopilot.body.y) < 1.0
    pilot.wait('not armable', lambda: not pilot.telemetry.health().is_armable)
    with pytest.raises(ActionError):
        pilot.action.arm()


def test_a_fence_is_kept(pilot: Pilot) -> None:
    fence = Circle(Point(LATITUDE_DEG, LONGITUDE_DEG), 15.0, FenceType.INCLUSION)
    pilot.geofence.upload_geofence(GeofenceData([], [fence]))
    assert pilot.geofence.download_geofence().circles[0].radius == pytest.approx(15.0)
    pilot.param.set_param_int('GF_ACTION', 3)
    pilot.take_off(6.0)
    pilot.action.goto_location(LATITUDE_DEG + 5 * STEP_DEG, LONGITUDE_DEG, 488.0 + 6.0, 0.0)
    pilot.wait('return', lambda: FlightMode.RETURN_TO_LAUNCH in pilot.modes)
    pilot.wait_landed()
    body = pilot.vehicle.autopilot.body
    assert body.x**2 + body.y**2 < 1.0
    assert any('geofence crossed: return' in text for text in pilot.texts)
    pilot.geofence.clear_geofence()
    assert pilot.vehicle.pilot.fence_items == ()
