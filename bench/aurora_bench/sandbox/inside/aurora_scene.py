# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The simulators, for a program: spawn, step, command, message, log.

    from aurora_scene import scene

Units are SI; the frame is ENU: x east, y north, z metres above ground; yaw in radians, 0 east,
counter-clockwise. Everything that a function cannot do raises `SceneError` with the reason.

A program first says what there is (`world`, `spawn`, `spawn_uav`, `link`), then calls `begin`,
then commands and `step`s. A command holds from the next tick on until another one is given.
The recording is made outside of the program, of what the simulators did. What was flown for which
mission is named by `phase`; names of bodies are the program's own.
"""

from __future__ import annotations

import json
import os
from typing import Any

# Nobody else writes to the pipe: what a program prints goes where it is kept for its author.
_answers = os.fdopen(os.dup(0), 'rb', buffering=0)
_requests = os.fdopen(os.dup(1), 'wb', buffering=0)
os.dup2(2, 1)
_left = b''


class SceneError(Exception):
    """The scene cannot do what was asked."""


def first_line() -> bytes:
    """Return one line of what was sent."""
    global _left
    while b'\n' not in _left:
        data = _answers.read(1 << 16)
        if not data:
            raise SceneError('the scene is gone')
        _left += data
    line, _, _left = _left.partition(b'\n')
    return line


class Scene:
    """The one scene of a program."""

    def _ask(self, do: str, **values: Any) -> Any:
        text = json.dumps({'do': do, **values}, allow_nan=False).encode() + b'\n'
        while text:
            text = text[_requests.write(text) or 0 :]
        answer = json.loads(first_line())
        if 'error' in answer:
            raise SceneError(answer['error'])
        return answer['is']

    # --- the map ---------------------------------------------------------------------------------
    def lanes(self, near: tuple[float, float] | None = None, within_m: float = 300.0) -> list[Any]:
        """Return traffic lanes near a point (None: the middle of the map), nearest first.

        Each is a dict: id, edge, index (0 = rightmost), street, length_m, limit_mps, start, end.
        """
        return list(self._ask('lanes', near=near, within_m=within_m))

    def next_edges(self, edge: str) -> list[str]:
        """Return the edges that a car can drive into from the end of an edge."""
        return list(self._ask('next_edges', edge=edge))

    def route(self, from_edge: str, to_edge: str) -> list[str]:
        """Return the edges of the shortest way for cars; SceneError when there is none."""
        return list(self._ask('route', from_edge=from_edge, to_edge=to_edge))

    def places(self) -> dict[str, Any]:
        """Return the landmarks: name to x, y, and the lane from which it is reached."""
        return dict(self._ask('places'))

    def refuse(self, because: str) -> None:
        """Say that the request cannot be carried out, and why in a word or two: altitude_limit."""
        self._ask('refuse', because=because)

    # --- before begin ----------------------------------------------------------------------------
    def world(
        self,
        weather: str = 'clear',
        time_of_day: str = 'noon',
        wind_mps: float = 0.0,
        wind_from_deg: float = 0.0,
    ) -> None:
        """Say the weather (clear, cloudy, rain, heavy_rain, fog, snow), dawn, noon, dusk or night.

        The wind blows from a compass bearing.
        """
        self._ask(
            'world', weather=weather, time_of_day=time_of_day,
            wind_mps=wind_mps, wind_from_deg=wind_from_deg,
        )  # fmt: skip

    def spawn(
        self,
        name: str,
        type: str,
        lane: str,
        position_m: float,
        route: list[str] | None = None,
        speed_mps: float = 0.0,
        role: str = 'other',
        parked: bool = False,
    ) -> None:
        """Place a ground body with its middle so far along a lane; it drives by itself.

        Args:
            name: Of the body.
            type: car, truck, bus, van, motorcycle, bicycle, police, ambulance, firetruck,
                pedestrian.
            lane: Id of a traffic lane; of a pedestrian, of the street along whose sidewalk he
                walks.
            position_m: Along the lane.
            route: Edges to drive, first that of the lane. None: on and on, straight where it can.
            speed_mps: At the beginning.
            role: ego, target, background, other.
            parked: It stands beside the lane and never moves.
        """
        self._ask(
            'spawn', name=name, type=type, lane=lane, position_m=position_m, route=route,
            speed_mps=speed_mps, role=role, parked=parked,
        )  # fmt: skip

    def spawn_uav(self, name: str, x_m: float, y_m: float, yaw_rad: float = 0.0) -> None:
        """Place a UAV on the ground."""
        self._ask('spawn_uav', name=name, x_m=x_m, y_m=y_m, yaw_rad=yaw_rad)

    def link(
        self,
        sender: str,
        receiver: str,
        loss: float = 0.0,
        latency_s: float = 0.1,
        range_m: float | None = None,
        retransmissions: int = 0,
    ) -> None:
        """Give two bodies a radio link, one way."""
        self._ask(
            'link', sender=sender, receiver=receiver, loss=loss, latency_s=latency_s,
            range_m=range_m, retransmissions=retransmissions,
        )  # fmt: skip

    def begin(self) -> float:
        """Start the simulators with what was placed; return seconds per tick."""
        return float(self._ask('begin'))

    # --- while it runs ---------------------------------------------------------------------------
    def step(self, ticks: int = 1) -> float:
        """Let so many ticks pass; return the time since the beginning (s)."""
        return float(self._ask('step', ticks=ticks))

    def state(self, name: str) -> dict[str, float]:
        """Return where a body is: x, y, z (UAVs), speed, heading_rad, present; UAVs: vx, vy, vz,
        landed."""
        return dict(self._ask('state', name=name))

    def set_speed(self, name: str, speed_mps: float) -> None:
        """Hold a speed, reached within what the body can."""
        self._ask('set_speed', name=name, value=speed_mps)

    def free_speed(self, name: str) -> None:
        """Drive with the traffic again."""
        self._ask('free_speed', name=name)

    def set_time_gap(self, name: str, gap_s: float) -> None:
        """Keep so many seconds behind whoever drives ahead."""
        self._ask('set_time_gap', name=name, value=gap_s)

    def set_route(self, name: str, edges: list[str]) -> None:
        """Drive other edges, first the present one."""
        self._ask('set_route', name=name, edges=edges)

    def change_lane(self, name: str, index: int, for_s: float = 5.0) -> None:
        """Change to a lane of the street (0 = rightmost)."""
        self._ask('change_lane', name=name, value=index, for_s=for_s)

    def stop_at(self, name: str, lane: str, position_m: float, for_s: float = 1000.0) -> None:
        """Stop with the middle of the body so far along a lane of the route."""
        self._ask('stop_at', name=name, lane=lane, position_m=position_m, for_s=for_s)

    def resume(self, name: str) -> None:
        """Leave a stop."""
        self._ask('resume', name=name)

    def take_off(self, name: str, altitude_m: float) -> None:
        """Arm and climb to an altitude above ground. Phase: ascent."""
        self._ask('take_off', name=name, altitude_m=altitude_m)

    def fly_to(
        self,
        name: str,
        x_m: float,
        y_m: float,
        z_m: float,
        velocity_mps: tuple[float, float, float] = (0.0, 0.0, 0.0),
        yaw_rad: float = 0.0,
    ) -> None:
        """Hold a point, reached with a velocity beside it; it flies there in a straight line."""
        self._ask(
            'fly_to', name=name, x_m=x_m, y_m=y_m, z_m=z_m, velocity_mps=velocity_mps,
            yaw_rad=yaw_rad,
        )  # fmt: skip

    def land(self, name: str) -> None:
        """Land where it is. Phase: landing."""
        self._ask('land', name=name)

    def phase(self, name: str, mission: int | None) -> None:
        """Say that from the next tick on a UAV flies mission 0, 1, …; None: it holds after one."""
        self._ask('phase', name=name, mission=mission)

    def send(self, sender: str, receiver: str) -> None:
        """Send a message over a link."""
        self._ask('send', sender=sender, receiver=receiver)

    def delivered(self, sender: str, receiver: str) -> int:
        """Return how many messages have arrived."""
        return int(self._ask('delivered', sender=sender, receiver=receiver))

    def log(self, text: str) -> None:
        """Keep a line for whoever reads what the program did; nothing is judged by it."""
        self._ask('log', text=text)


scene = Scene()
