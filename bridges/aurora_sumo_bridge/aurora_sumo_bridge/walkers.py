# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""A pedestrian in SUMO: exact placing, walking, and standing at the goal.

SUMO takes a person out of the simulation when its last stage ends and moves it to another
stripe of the sidewalk when a stage begins. Neither is wanted here: a walker that has arrived
stands, and a new walk begins at the very spot where the last one was left.
"""

from __future__ import annotations

import libsumo

from aurora_core.geometry.frames import sumo_angle_to_heading
from aurora_core.ports.simulators import GroundAgentLoad
from aurora_sumo_bridge.checks import unplaceable
from aurora_sumo_bridge.free_walk import FreeWalk
from aurora_sumo_bridge.network import PEDESTRIAN, Network
from aurora_sumo_bridge.polyline import Point

# SUMO ends the walk even of a standing person less than 0.4 m from its goal (measured), so a
# walker is held before that, plus what one step covers: it stands about half a metre short.
ARRIVAL_MARGIN_M = 0.45
# A walker that only stands still needs a walk: to this far from the end of its sidewalk.
END_MARGIN_M = 0.5
# Jumps to a spot begin so far before it.
_RUN_UP_M = 0.5


class Walker:
    """One pedestrian.

    Args:
        agent: What was asked.
        network: The loaded net.
        dt_s: Step length.

    Raises:
        GroundSimulatorError: Place, edges or arrival position do not exist for walkers.
    """

    def __init__(self, agent: GroundAgentLoad, network: Network, dt_s: float) -> None:
        self._agent = agent
        self._network = network
        self._dt_s = dt_s
        fault = network.check_walkable(agent.edges)
        if fault:
            raise unplaceable(agent, fault)
        self.lane_id = agent.lane_id or network.lane_for(agent.edges[0], PEDESTRIAN)
        if not network.has_lane(self.lane_id):
            raise unplaceable(agent, f"the map has no lane '{self.lane_id}'")
        if network.edge_of(self.lane_id) != agent.edges[0]:
            raise unplaceable(agent, f"the lane is not on the first edge '{agent.edges[0]}'")
        if not network.allows(self.lane_id, PEDESTRIAN):
            raise unplaceable(agent, 'the lane does not allow walkers')
        length_m = network.arc_length_m(self.lane_id)
        if agent.lane_position_m > length_m:
            raise unplaceable(agent, f'the lane ends at {length_m:.2f} m')
        for label, value in (
            ('time_gap_s', agent.time_gap_s),
            ('min_gap_m', agent.min_gap_m),
            ('acceleration_mps2', agent.acceleration_mps2),
        ):
            if value is not None:
                raise unplaceable(agent, f'a walker has no {label}')
        # The type's walking speed is only known once the person is in (`settle`).
        self._type_mps = 0.0
        self._usual_mps = 0.0
        self._wanted_mps = agent.speed_mps
        self.free: FreeWalk | None = None
        if agent.way_xy_m:
            try:
                self.free = FreeWalk(agent.agent_id, agent.way_xy_m, dt_s)
            except ValueError as err:
                raise unplaceable(agent, f'way_xy_m: {err}') from err
        # From here on lane positions are SUMO's; arc lengths stay outside.
        self._position_m = network.sumo_position_m(self.lane_id, agent.lane_position_m)
        self._edges, self._arrival_m, self._standing = self._goal()

    def add(self) -> None:
        """Hand the person to SUMO; the next step inserts it."""
        agent = self._agent
        libsumo.person.add(
            agent.agent_id,
            agent.edges[0],
            self._position_m,
            libsumo.constants.DEPARTFLAG_NOW,
            agent.type_name,
        )
        libsumo.person.appendWalkingStage(agent.agent_id, self._edges, self._arrival_m)

    def settle(self) -> float:
        """Move the inserted person to the middle of the sidewalk, exactly where asked.

        Returns:
            Compass angle in degrees of the direction in which it walks.

        Raises:
            GroundSimulatorError: SUMO did not insert the person.
        """
        agent = self._agent
        if agent.agent_id not in libsumo.person.getIDList():
            raise unplaceable(agent, 'SUMO did not insert the person')
        # moveTo turns the reported angle towards the jump, so the angle is read before.
        angle_deg = float(libsumo.person.getAngle(agent.agent_id))
        self._jump(self.lane_id, self._position_m, agent.lateral_m, angle_deg)
        self._type_mps = float(libsumo.person.getMaxSpeed(agent.agent_id))
        self._usual_mps = agent.speed_factor * self._type_mps
        self.set_speed(agent.speed_mps if agent.speed_mps > 0.0 else self._usual_mps)
        return angle_deg if self.free is None else self.free.angle_deg

    def asked_point(self) -> Point:
        """Return the asked spot: the middle of the sidewalk, or of a free way the beginning."""
        if self.free is not None:
            return self.free.start
        line, left_m = self._network.shape(self.lane_id), self._agent.lateral_m
        (x, y), (tx, ty) = line.at(self._agent.lane_position_m)
        return x - left_m * ty, y + left_m * tx

    def _jump(self, lane_id: str, position_m: float, left_m: float, angle_deg: float) -> None:
        """Move the person to a spot of a lane without turning it round.

        SUMO takes the direction of the jump for that of the walk, and a person of which it thinks
        that it walks back from where its walk began is gone in the next step (seen where a
        sidewalk bends). So the last of two jumps goes ahead.
        """
        hx, hy = sumo_angle_to_heading(angle_deg)
        _, (tx, ty) = self._network.shape(lane_id).at(
            self._network.arc_position_m(lane_id, position_m)
        )
        back_m = -_RUN_UP_M if hx * tx + hy * ty >= 0.0 else _RUN_UP_M
        end_m = self._network.sumo_position_m(lane_id, self._network.arc_length_m(lane_id))
        before_m = min(max(position_m + back_m, 0.0), end_m)
        if before_m != position_m:
            libsumo.person.moveTo(self._agent.agent_id, lane_id, before_m, left_m)
        libsumo.person.moveTo(self._agent.agent_id, lane_id, position_m, left_m)

    def set_speed(self, speed_mps: float) -> None:
        """Walk at this speed; a walker at its goal stays there until the next walk."""
        self._wanted_mps = speed_mps
        self._apply_speed()

    def release_speed(self) -> None:
        """Walk at the type's own speed again."""
        self.set_speed(self._usual_mps)

    def set_speed_factor(self, factor: float) -> None:
        """Walk at a multiple of the type's own speed from now on."""
        self._usual_mps = factor * self._type_mps
        self.set_speed(self._usual_mps)

    def walk(self, edges: tuple[str, ...], arrival_arc_m: float) -> str:
        """Begin another walk from the present spot.

        Args:
            edges: Edges to walk along, first = where it stands.
            arrival_arc_m: Goal on the last edge, arc length along its sidewalk.

        Returns:
            '' when done, else why it cannot be.
        """
        agent_id = self._agent.agent_id
        fault = self._network.check_walkable(edges)
        if fault or self.free is not None:
            return fault or 'it has a way of its own over the street'
        here = str(libsumo.person.getRoadID(agent_id))
        if here != edges[0]:
            return f"the walk must begin on the walker's edge '{here}', not on '{edges[0]}'"
        goal_lane = self._network.lane_for(edges[-1], PEDESTRIAN)
        if arrival_arc_m > self._network.arc_length_m(goal_lane):
            return f"lane '{goal_lane}' ends before {arrival_arc_m:g} m"
        arrival_m = self._network.sumo_position_m(goal_lane, arrival_arc_m)
        lane_id = str(libsumo.person.getLaneID(agent_id))
        lane_position_m = float(libsumo.person.getLanePosition(agent_id))
        left_m = self._left_of_middle_m(lane_id, lane_position_m)
        if len(edges) == 1 and abs(arrival_m - lane_position_m) <= self._reach_m():
            self._standing = True
            self._apply_speed()
            return ''
        libsumo.person.appendWalkingStage(agent_id, edges, arrival_m)
        libsumo.person.removeStage(agent_id, 0)
        # The new stage put it on another stripe: back to the spot, before SUMO moves it.
        angle_deg = float(libsumo.person.getAngle(agent_id))
        self._jump(lane_id, lane_position_m, left_m, angle_deg)
        self._edges, self._arrival_m, self._standing = edges, arrival_m, False
        self._apply_speed()
        return ''

    def step_freely(self) -> None:
        """Go on over the street where the person has a free way."""
        if self.free is not None:
            self.free.step(self._wanted_mps)

    def hold_on_arrival(self) -> None:
        """Stop a walker that would reach its goal, and so vanish, in the next step."""
        if self._standing:
            return
        agent_id = self._agent.agent_id
        if libsumo.person.getRoadID(agent_id) != self._edges[-1]:
            return
        to_go_m = abs(self._arrival_m - float(libsumo.person.getLanePosition(agent_id)))
        if to_go_m <= self._reach_m():
            self._standing = True
            self._apply_speed()

    def _reach_m(self) -> float:
        return self._wanted_mps * self._dt_s + ARRIVAL_MARGIN_M

    def _apply_speed(self) -> None:
        speed_mps = 0.0 if self._standing else self._wanted_mps
        libsumo.person.setSpeed(self._agent.agent_id, speed_mps)

    def _left_of_middle_m(self, lane_id: str, lane_position_m: float) -> float:
        position = libsumo.person.getPosition(self._agent.agent_id)
        return self._network.shape(lane_id).left_offset_m(
            (position[0], position[1]), self._network.arc_position_m(lane_id, lane_position_m)
        )

    def _goal(self) -> tuple[tuple[str, ...], float, bool]:
        """Return edges, SUMO's arrival position and whether the person just stands."""
        agent, network = self._agent, self._network
        goal_lane = network.lane_for(agent.edges[-1], PEDESTRIAN)
        length_m = network.arc_length_m(goal_lane)
        single = len(agent.edges) == 1
        arrival_arc_m = agent.arrival_position_m
        if arrival_arc_m is None:
            arrival_arc_m = agent.lane_position_m if single else 0.5 * length_m
        if arrival_arc_m > length_m:
            raise unplaceable(
                agent,
                f'arrival_position_m {arrival_arc_m:g}: lane {goal_lane} ends at {length_m:.2f} m',
            )
        arrival_m = network.sumo_position_m(goal_lane, arrival_arc_m)
        at_goal = single and abs(arrival_m - self._position_m) <= self._reach_m()
        if not agent.parked and not at_goal and not agent.way_xy_m:
            return agent.edges, arrival_m, False
        # A walk that is never walked: without a stage SUMO would take the person away.
        here_m = network.arc_length_m(self.lane_id)
        margin_m = min(END_MARGIN_M, 0.25 * here_m)
        far_arc_m = margin_m if agent.lane_position_m > 0.5 * here_m else here_m - margin_m
        return agent.edges[:1], network.sumo_position_m(self.lane_id, far_arc_m), True
