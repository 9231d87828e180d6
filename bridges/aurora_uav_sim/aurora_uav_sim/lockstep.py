# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""A lockstep session: simulated time moves only by steps that the session's owner asks for."""

from __future__ import annotations

from collections.abc import Hashable, Iterable
from math import ceil

from aurora_core.geometry.frames import attitude_enu_to_ned
from aurora_uav_sim.autopilot import Result, Target
from aurora_uav_sim.parameters import MAX_SUBSTEP_S
from aurora_uav_sim.protocol import AUTOPILOT_COMPONENT, STATUS_NAME, pack_status
from aurora_uav_sim.set_point import SetPointReader
from aurora_uav_sim.telemetry import uav_mode
from aurora_uav_sim.vehicle import Vehicle
from aurora_uav_sim.wire import ATTITUDE, LOCAL_POSITION, NAMED_INT, SET_POINT, Newer, Sequence

MIN_TICK_US = 1_000
MAX_TICK_US = 1_000_000
# Plain name: before Python 3.12 a member is slow to look up, and each tick asks.
_ACCEPTED = Result.ACCEPTED


class Session:
    """State of a session.

    Attributes:
        nonce: Number that the owner chose.
        source: Where the owner sends from.
        sender: System and component id of the owner.
        fleet: The vehicles by system id, ascending; these and no others are stepped.
        tick: Last tick that was simulated.
        newer: Filter against stale frames of the owner.
    """

    __slots__ = (
        '_h',
        '_readers',
        '_steps',
        '_targets',
        'fleet',
        'newer',
        'nonce',
        'sender',
        'source',
        'tick',
    )

    def __init__(
        self,
        nonce: int,
        source: Hashable,
        sender: tuple[int, int],
        tick_us: int,
        vehicles: Iterable[Vehicle],
    ) -> None:
        self.nonce = nonce
        self.source = source
        self.sender = sender
        self.fleet = {v.system_id: v for v in vehicles}
        self.tick = 0
        self.newer = Newer()
        self._steps = ceil(tick_us / (MAX_SUBSTEP_S * 1e6))
        self._h = tick_us / 1e6 / self._steps
        self._targets: dict[int, Target] = {}
        self._readers = {system_id: SetPointReader() for system_id in self.fleet}

    def owned_by(self, source: Hashable, sender: tuple[int, int]) -> bool:
        """Return whether somebody is the owner: the same address and the same MAVLink ids."""
        return self.source == source and self.sender == sender

    def take_set_point(self, payload: bytes) -> None:
        """Keep a set-point for the next tick; one for another tick or vehicle is dropped."""
        fields = SET_POINT.unpack(payload)
        system_id = fields[13]
        if fields[0] != self.tick + 1 or system_id not in self.fleet:
            return
        target = self._readers[system_id].read(fields)
        if target is not None:
            self._targets[system_id] = target

    def step(self, tick: int) -> Result:
        """Advance to `tick`, or say why not; the present tick again is accepted as it is."""
        if tick == self.tick:
            return _ACCEPTED
        if tick != self.tick + 1:
            return Result.DENIED
        targets = self._targets
        if len(targets) < len(self.fleet):
            return Result.TEMPORARILY_REJECTED
        for system_id, vehicle in self.fleet.items():
            autopilot = vehicle.autopilot
            autopilot.set_target(targets[system_id])
            autopilot.run(self._steps, self._h)
        targets.clear()
        self.tick = tick
        return _ACCEPTED

    def states(self, sequences: dict[int, Sequence]) -> bytes:
        """Return the frames with the state of every vehicle at the present tick.

        Args:
            sequences: Frame counters by system id of the link that the frames go to.
        """
        tick = self.tick
        out = b''
        for system_id, vehicle in self.fleet.items():
            sequence = sequences.get(system_id)
            if sequence is None:
                sequence = sequences[system_id] = Sequence(system_id, AUTOPILOT_COMPONENT)
            autopilot = vehicle.autopilot
            b = autopilot.body
            status = pack_status(
                self.nonce, uav_mode(autopilot), autopilot.armed, autopilot.landed
            )
            w, x, y, z = attitude_enu_to_ned(b.qw, b.qx, b.qy, b.qz)
            out += (
                LOCAL_POSITION.frame(sequence, tick, b.y, b.x, -b.z, b.vy, b.vx, -b.vz)
                + ATTITUDE.frame(sequence, tick, w, x, y, z, b.p, -b.q, -b.r, 0.0, 0.0, 0.0, 0.0)
                + NAMED_INT.frame(sequence, tick, status, STATUS_NAME)
            )
        return out
