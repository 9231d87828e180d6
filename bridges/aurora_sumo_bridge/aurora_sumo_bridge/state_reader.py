# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Reading the packed state: plain getters, which are libsumo's fastest way out."""

from __future__ import annotations

from math import nan

import libsumo
import numpy as np

from aurora_core.errors import GroundSimulatorError
from aurora_core.geometry.frames import sumo_angle_to_heading
from aurora_core.geometry.kernel import norm2
from aurora_core.ports.simulators import FloatArray
from aurora_core.trace.layout import GROUND_WIDTH, GroundColumn
from aurora_sumo_bridge.conversions import centre_from_front, front_from_centre
from aurora_sumo_bridge.placement import Body
from aurora_sumo_bridge.polyline import Box

# SUMO's own mark for "no value" is -2^30; no map is that large.
_FARTHEST_M = 1e8
_UNKNOWN = 'is not known'
# SUMO turns a long vehicle at once where the lanes under it meet at a kink. A rear bumper that
# goes aside by more than this within one tick is towed by the front instead (m), until SUMO's
# direction has come so near; a front that itself jumps farther is left as it is.
_KINK_M = 1.0
_REACHED_M = 0.1
_JUMP_M = 3.0

# Bound once: these four calls are most of what a tick costs outside SUMO.
_position_of = libsumo.vehicle.getPosition
_angle_of = libsumo.vehicle.getAngle
_speed_of = libsumo.vehicle.getSpeed
_acceleration_of = libsumo.vehicle.getAcceleration


class StateReader:
    """Reads every agent of a run; one that left keeps its last values with PRESENT 0."""

    def __init__(self, bodies: tuple[Body, ...], dt_s: float) -> None:
        self._bodies = bodies
        self._dt_s = dt_s
        # All rows one after the other, and where the row of each agent lies.
        self._values = [0.0] * (GROUND_WIDTH * len(bodies))
        self._rows = tuple(
            slice(GROUND_WIDTH * k, GROUND_WIDTH * (k + 1)) for k in range(len(bodies))
        )
        self._present = [True] * len(bodies)
        # A vehicle on a straight street keeps its angle: its heading is not worked out again.
        self._angles_deg = [nan] * len(bodies)
        self._headings = [(0.0, 0.0)] * len(bodies)
        self._is_towed = [False] * len(bodies)

    def is_present(self, agent: int) -> bool:
        return self._present[agent]

    def mark_gone(self, agent: int) -> None:
        """Note that an agent was taken out on command."""
        self._present[agent] = False
        self._set(agent, GroundColumn.PRESENT, 0.0)

    def read(self) -> FloatArray:
        """Return the state (N, GROUND_WIDTH) after a step.

        Raises:
            GroundSimulatorError: A value is not finite or an agent is nowhere on the map.
        """
        values, present = self._values, self._present
        for index, body in enumerate(self._bodies):
            if not present[index]:
                continue
            try:
                if body.walker is None:
                    row = self._vehicle_row(index, body)
                else:
                    row = self._person_row(index, body)
            except libsumo.TraCIException as err:
                if _UNKNOWN not in str(err):
                    raise GroundSimulatorError(
                        f"agent '{body.agent_id}' cannot be read: {err}"
                    ) from err
                self.mark_gone(index)
            else:
                values[self._rows[index]] = row
        return self._packed()

    def read_spawned(self) -> FloatArray:
        """Return the state of tick 0.

        What SUMO cannot know yet is set by definition: accelerations are 0 (nothing has moved),
        and a walker has the asked speed and faces the way it will walk.

        Raises:
            GroundSimulatorError: As `read`, or a vehicle does not have the asked speed.
        """
        self.read()
        for index, body in enumerate(self._bodies):
            asked_mps = body.agent.speed_mps
            speed_mps = self._values[self._rows[index]][GroundColumn.SPEED]
            if body.heading is not None:
                self._set(index, GroundColumn.HEADING_X, body.heading[0])
                self._set(index, GroundColumn.HEADING_Y, body.heading[1])
                self._set(index, GroundColumn.SPEED, asked_mps)
            elif speed_mps != asked_mps:
                raise GroundSimulatorError(
                    f"agent '{body.agent_id}' starts at {speed_mps:g} m/s, "
                    f'asked for {asked_mps:g} m/s'
                )
            self._set(index, GroundColumn.ACCELERATION, 0.0)
        return self._packed()

    def boxes(self) -> tuple[Box, ...]:
        """Return the footprints of the last state, roster order."""
        return tuple(
            Box(
                x_m=row[GroundColumn.X],
                y_m=row[GroundColumn.Y],
                heading_x=row[GroundColumn.HEADING_X],
                heading_y=row[GroundColumn.HEADING_Y],
                length_m=body.length_m,
                width_m=body.width_m,
            )
            for body, row in zip(self._bodies, self._packed().tolist(), strict=True)
        )

    def _packed(self) -> FloatArray:
        state = np.array(self._values, dtype=np.float64).reshape(len(self._bodies), GROUND_WIDTH)
        # Comparisons with NaN are false, so this finds it too.
        good = np.abs(state) < _FARTHEST_M
        if not good.all():
            agent, column = (int(i) for i in np.argwhere(~good)[0])
            raise GroundSimulatorError(
                f"agent '{self._bodies[agent].agent_id}': SUMO gives "
                f'{GroundColumn(column).name} = {state[agent, column]!r}'
            )
        return state

    def _set(self, agent: int, column: GroundColumn, value: float) -> None:
        self._values[GROUND_WIDTH * agent + column] = value

    def _vehicle_row(self, index: int, body: Body) -> tuple[float, ...]:
        vehicle = body.agent.agent_id
        front_x_m, front_y_m = _position_of(vehicle)
        angle_deg = _angle_of(vehicle)
        if angle_deg != self._angles_deg[index]:
            self._angles_deg[index] = angle_deg
            self._headings[index] = sumo_angle_to_heading(angle_deg)
            self._is_towed[index] |= self._is_kink(index, body)
        heading_x, heading_y = self._headings[index]
        if self._is_towed[index]:
            heading_x, heading_y = self._towed(index, body, front_x_m, front_y_m)
        x_m, y_m = centre_from_front(front_x_m, front_y_m, heading_x, heading_y, body.length_m)
        return (
            x_m,
            y_m,
            heading_x,
            heading_y,
            _speed_of(vehicle),
            _acceleration_of(vehicle),
            1.0,
        )

    def _is_kink(self, index: int, body: Body) -> bool:
        """Tell whether the rear bumper goes aside at once, with the direction that SUMO has."""
        before = self._heading_before(index)
        turn = norm2(*(b - a for a, b in zip(before, self._headings[index], strict=True)))
        return before != (0.0, 0.0) and turn * body.length_m > _KINK_M

    def _towed(
        self, index: int, body: Body, front_x_m: float, front_y_m: float
    ) -> tuple[float, float]:
        """Return the direction of a body whose front pulls its rear bumper (unit vector)."""
        row = self._values[self._rows[index]]
        x_m, y_m = row[GroundColumn.X], row[GroundColumn.Y]
        hx, hy = self._heading_before(index)
        old_x, old_y = front_from_centre(x_m, y_m, hx, hy, body.length_m)
        rear_x, rear_y = front_from_centre(x_m, y_m, -hx, -hy, body.length_m)
        dx, dy = front_x_m - rear_x, front_y_m - rear_y
        away_m = norm2(dx, dy)
        target = self._headings[index]
        if norm2(front_x_m - old_x, front_y_m - old_y) > _JUMP_M or away_m == 0.0:
            self._is_towed[index] = False
            return target
        found = dx / away_m, dy / away_m
        off_m = norm2(target[0] - found[0], target[1] - found[1]) * body.length_m
        self._is_towed[index] = off_m > _REACHED_M
        return found if self._is_towed[index] else target

    def _heading_before(self, index: int) -> tuple[float, float]:
        row = self._values[self._rows[index]]
        return row[GroundColumn.HEADING_X], row[GroundColumn.HEADING_Y]

    def _person_row(self, index: int, body: Body) -> tuple[float, ...]:
        person = body.agent_id
        # SUMO's point of a person is taken as its centre: a body of 0.2 m that turns on the spot
        # would otherwise jump by its own length.
        x_m, y_m = libsumo.person.getPosition(person)
        heading_x, heading_y = sumo_angle_to_heading(libsumo.person.getAngle(person))
        before_mps = self._values[self._rows[index]][GroundColumn.SPEED]
        free = None if body.walker is None else body.walker.free
        # SUMO says 0 of somebody whom it is told where to be.
        speed_mps = libsumo.person.getSpeed(person) if free is None else free.speed_mps
        # SUMO has no acceleration of persons.
        acceleration_mps2 = (speed_mps - before_mps) / self._dt_s
        return (x_m, y_m, heading_x, heading_y, speed_mps, acceleration_mps2, 1.0)
