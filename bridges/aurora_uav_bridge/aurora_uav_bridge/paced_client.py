# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The air simulator as core sees it, of autopilots that keep their own time; no ROS.

Nobody waits here for a tick to be flown: tick k is k time steps of this machine's steady clock
after tick 0, whatever happens. Every state that an autopilot tells bears the time of its own
clock; TIMESYNC says what that is in ours (`clock_estimate`), and the state of a tick is the one
between the reports around it. Only standard MAVLink is spoken.

Where a vehicle stands at tick 0 is taken for the home that the scenario gives it; its heading
there is its own.
"""

from __future__ import annotations

import numpy as np

from aurora_core.errors import AirSimulatorError
from aurora_core.ports.simulators import AirLoad, FloatArray, UavHome
from aurora_core.trace.air_clock import AirClock
from aurora_core.trace.layout import UAV_WIDTH, UavCommandColumn, UavMode
from aurora_uav_bridge import conversions
from aurora_uav_bridge.clock_estimate import Estimate
from aurora_uav_bridge.errors import CommandRefusedError
from aurora_uav_bridge.flight_commands import change_mode, check_advance, land
from aurora_uav_bridge.paced_link import PacedLink
from aurora_uav_bridge.telemetry_track import Told
from aurora_uav_bridge.transports import Transport
from aurora_uav_sim.autopilot import FlightMode
from aurora_uav_sim.wire import SET_POINT

# Round trips before a run begins, and how well the clocks must be known by then.
_FIRST_TRIPS = 100
_FIRST_S = 0.025
# States later than this after their tick: commands would no longer answer to them.
_LATE_LIMIT_S = 2.0
# Times of states are told in whole milliseconds. Source: MAVLink common.xml, time_boot_ms.
_ROUNDING_S = 5e-4
_MODES = {
    FlightMode.OFFBOARD.value: UavMode.OFFBOARD,
    FlightMode.TAKEOFF.value: UavMode.TAKEOFF,
    FlightMode.LAND.value: UavMode.LAND,
}


class PacedClient:
    """`aurora_core.ports.simulators.AirSimulator` in real time.

    Args:
        transport: Way to the autopilots; closed by `close`.
        timeout_s: Longest wait for an answer.
    """

    def __init__(self, transport: Transport, *, timeout_s: float = 5.0) -> None:
        self._transport = transport
        self._timeout_s = timeout_s
        self._link: PacedLink | None = None
        self._homes: tuple[UavHome, ...] = ()
        self._dt_s = 0.0
        self._start_s = 0.0
        self._tick = -1
        self._modes: list[UavMode] = []
        # Of each: north, east, down (m) and altitude above sea level (m) where it stood.
        self._origins: list[tuple[float, ...]] = []
        self._takeoff_m: list[float] = []
        self._state: FloatArray = np.zeros((0, UAV_WIDTH))
        self._theirs_s: list[float] = []
        self._worst_s: list[float] = []
        self._latest_s = 0.0

    def load(self, load: AirLoad) -> None:
        """Listen until clocks and states are known; afterwards `state` is tick 0, and time runs.

        Raises:
            CommandRangeError: A number is not finite or out of range.
            AirSimulatorError: The scenario states a wind, which the world of an autopilot has for
                itself.
            CommandRefusedError: A vehicle is not on the ground or not disarmed.
            SimulatorSilentError: An autopilot does not answer, or TIMESYNC does not.
        """
        conversions.check_load(load)
        if load.wind_mean_east_mps or load.wind_mean_north_mps:
            raise AirSimulatorError(
                'the scenario states a wind, and an autopilot that keeps its own time has the '
                'wind of its own world',
                hint='leave the wind out, or run without --autopilot',
            )
        self._homes, self._dt_s = load.homes, load.dt_s
        self._modes = [UavMode.IDLE for _ in load.homes]
        self._theirs_s = [float('-inf') for _ in load.homes]
        self._worst_s = [0.0 for _ in load.homes]
        self._takeoff_m = []
        self._latest_s = 0.0
        self._tick = 0
        if not load.homes:
            return
        ids = tuple(home.system_id for home in load.homes)
        link = self._link = PacedLink(self._transport, self._timeout_s, ids)
        end_s = self._transport.steady_time_s() + 2.0 * self._timeout_s
        if not link.wait(lambda: all(told.heard for told in link.told.values()), end_s):
            raise link.silent('heartbeat')
        link.ask_for_streams()
        if not link.wait(lambda: all(told.complete for told in link.told.values()), end_s):
            raise link.silent('position, attitude, landed state, altitude')
        if not link.wait(self._knows_clocks, end_s + 2.0 * self._timeout_s):
            raise link.silent('TIMESYNC')
        for home in load.homes:
            told = link.told[home.system_id]
            if told.armed or not told.landed:
                raise CommandRefusedError(
                    f'{home.uav_id}: expected its autopilot on the ground and disarmed',
                    hint='land and disarm it, then run again',
                )
        link.begin()
        self._start_s = self._transport.steady_time_s()
        self._origins = [(0.0, 0.0, 0.0) for _ in load.homes]
        self._state = self._state_at(0)
        for i, home in enumerate(load.homes):
            told = link.told[home.system_id]
            place = told.position.between(self._theirs_s[i])
            assert place is not None  # the state of tick 0 was made of it
            self._origins[i] = place[:3]
            self._takeoff_m.append(told.altitude_m or 0.0)
        self._state = self._rows_at(self._start_s)

    def state(self) -> FloatArray:
        """Return the packed state (M, UAV_WIDTH) of the current tick."""
        if self._tick < 0:
            raise AirSimulatorError('no load before state', hint='call load first')
        return self._state.copy()

    def advance(self, tick: int, commands: FloatArray) -> FloatArray:
        """Send commands stamped `tick` at once; return the states at the time of that tick.

        Raises:
            CommandRangeError: A field is not finite or out of range (named); nothing was sent.
            CommandRefusedError: The autopilot refused a mode.
            SimulatorSilentError: Nothing was told around the time of the tick.
        """
        homes = self._homes
        check_advance(homes, self._tick, tick, commands)
        link = self._link
        if link is not None:
            rows: list[list[float]] = commands.tolist()
            wanted = [
                conversions.check_command(home, tick, row)
                for home, row in zip(homes, rows, strict=True)
            ]
            link.take_waiting()
            for i, (home, row) in enumerate(zip(homes, rows, strict=True)):
                link.send(self._set_point(link, i, row))
                if wanted[i] is not self._modes[i]:
                    told = link.told[home.system_id]
                    above_m = row[UavCommandColumn.TAKEOFF_ALTITUDE]
                    change_mode(
                        link, home, wanted[i],
                        armed=told.armed, landed=bool(told.landed),
                        takeoff_m=self._takeoff_m[i] + above_m,
                    )  # fmt: skip
                    self._modes[i] = wanted[i]
            self._state = self._state_at(tick)
        self._tick = tick
        return self._state.copy()

    def stand_by(self) -> None:
        """Keep taking what is told while no tick comes."""
        if self._link is not None:
            self._link.take_waiting()

    def clocks(self) -> tuple[AirClock, ...]:
        """Return what is known of the autopilots' clocks."""
        return tuple(self._clock(i, home) for i, home in enumerate(self._homes))

    def close(self) -> None:
        """Let who still flies land where it is, and free the link; safe to call twice."""
        link, self._link = self._link, None
        try:
            if link is not None:
                link.take_waiting()
                for home in self._homes:
                    told = link.told[home.system_id]
                    if told.armed and not told.landed and self._tick > 0:
                        land(link, home)
        except AirSimulatorError:
            return  # nobody is there, or it does what it wants
        finally:
            self._transport.close()

    def _estimate(self, i: int) -> Estimate:
        assert self._link is not None
        estimate = self._link.clocks[self._homes[i].system_id].estimate
        assert estimate is not None  # `load` waits for it
        return estimate

    def _knows_clocks(self) -> bool:
        assert self._link is not None
        for clock in self._link.clocks.values():
            known = clock.estimate
            if known is None or known.round_trips < _FIRST_TRIPS:
                return False
            if known.offset_sigma_s > _FIRST_S:
                return False
        return True

    def _set_point(self, link: PacedLink, i: int, row: list[float]) -> bytes:
        fields = conversions.set_point_fields(self._homes[i], 0, row)
        now_ms = round(1e3 * self._estimate(i).theirs_s(self._transport.steady_time_s()))
        moved = (a + b for a, b in zip(fields[1:4], self._origins[i], strict=True))
        return SET_POINT.frame(link.sequence, now_ms & 0xFFFFFFFF, *moved, *fields[4:])

    def _state_at(self, tick: int) -> FloatArray:
        """Wait for the states of a tick.

        Raises:
            SimulatorSilentError: They do not come.
            AirSimulatorError: A number is not finite.
        """
        link = self._link
        assert link is not None
        at_s = self._start_s + tick * self._dt_s
        for i in range(len(self._homes)):
            # A better estimate must not take time back.
            theirs_s = self._estimate(i).theirs_s(at_s)
            self._theirs_s[i] = max(theirs_s, self._theirs_s[i])
        now_s = self._transport.steady_time_s()
        if not link.wait(self._has_states, max(at_s, now_s) + _LATE_LIMIT_S):
            raise link.silent(f'states of tick {tick}')
        late_s = self._transport.steady_time_s() - at_s
        if late_s > _LATE_LIMIT_S:
            raise AirSimulatorError(
                f'tick {tick} was complete {late_s:.1f} s late: this machine does not keep pace '
                'with the autopilot',
                hint='stop what else it does, or take fewer vehicles',
            )
        self._latest_s = max(self._latest_s, late_s)
        for i in range(len(self._homes)):
            known = self._estimate(i)
            ahead_s = abs(at_s - known.at_s)
            worst_s = known.uncertainty_s + 2.0 * known.drift_sigma * ahead_s + _ROUNDING_S
            self._worst_s[i] = max(self._worst_s[i], worst_s)
        return self._rows_at(at_s)

    def _has_states(self) -> bool:
        assert self._link is not None
        for i, home in enumerate(self._homes):
            told = self._link.told[home.system_id]
            if told.position.around(self._theirs_s[i]) is None:
                return False
            if told.attitude.around(self._theirs_s[i]) is None:
                return False
        return True

    def _rows_at(self, at_s: float) -> FloatArray:
        assert self._link is not None
        rows = []
        for i, home in enumerate(self._homes):
            told = self._link.told[home.system_id]
            position = told.position.between(self._theirs_s[i])
            attitude = told.attitude.between(self._theirs_s[i])
            assert position is not None
            assert attitude is not None
            moved = [a - b for a, b in zip(position[:3], self._origins[i], strict=True)]
            rows.append(
                conversions.state_row(
                    home, (at_s, *moved, *position[3:]), (at_s, *attitude), _status(told)
                )
            )
        if not conversions.all_finite(rows):
            raise AirSimulatorError(f'{self._transport.peer} reported a number that is not finite')
        return np.array(rows, dtype=np.float64)

    def _clock(self, i: int, home: UavHome) -> AirClock:
        assert self._link is not None
        clock, known = self._link.clocks[home.system_id], self._estimate(i)
        return AirClock(
            uav_id=home.uav_id,
            offset_s=known.offset_s,
            drift_ppm=1e6 * known.drift,
            drift_sigma_ppm=1e6 * known.drift_sigma,
            uncertainty_s=self._worst_s[i],
            round_trips=clock.round_trips,
            shortest_s=2.0 * known.asymmetry_s,
            longest_s=clock.longest_s,
            steps=clock.steps,
            latest_s=self._latest_s,
        )


def _status(told: Told) -> tuple[int, bool, bool]:
    """Return mode, armed and landed in the words of the trace."""
    landed = bool(told.landed)
    if not told.armed:
        return UavMode.IDLE, False, landed
    assert told.mode is not None
    mode = _MODES.get(told.mode)
    if mode is None:
        # Hold, and what nobody here asked for: a failsafe's return, a pilot's position mode.
        mode = UavMode.IDLE if landed else UavMode.HOLD
    return mode, True, landed
