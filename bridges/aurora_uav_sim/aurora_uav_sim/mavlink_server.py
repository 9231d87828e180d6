# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The simulator as a MAVLink endpoint without sockets: datagrams in, datagrams out.

Stand-alone, `poll` lets time pass and streams telemetry, and any ground station may command. In
a lockstep session (`protocol`) only its owner commands and only its steps move time; everyone
else may look. A session cannot be taken away while its owner speaks. Who is not trusted
(`signing`) may look at all times and command at none.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Hashable, Iterable
from typing import Any

from pymavlink.dialects.v20 import common as mavlink

from aurora_uav_sim.autopilot import ACCEPTED, Answer, Result
from aurora_uav_sim.commands import (
    HANDLERS,
    Request,
    request_of_int,
    request_of_long,
    whole,
)
from aurora_uav_sim.link import Link
from aurora_uav_sim.lockstep import Session
from aurora_uav_sim.lockstep_commands import PREPARATIONS, prepare, read_session
from aurora_uav_sim.parameters import MAX_SUBSTEP_S
from aurora_uav_sim.pilot import sticks_of
from aurora_uav_sim.protocol import (
    CMD_LOCKSTEP,
    CMD_STEP,
    MAX_NONCE,
    OWNER_SILENCE_S,
)
from aurora_uav_sim.services import Services
from aurora_uav_sim.set_point import SetPointReader, read_streamed
from aurora_uav_sim.vehicle import Vehicle
from aurora_uav_sim.wire import (
    COMMAND_ACK,
    COMMAND_LONG,
    SET_POINT,
    Decoder,
    Frame,
    split,
)

_SET_POINT_ID = SET_POINT.message_id
_COMMAND_LONG_ID = COMMAND_LONG.message_id

# What moves a vehicle by being streamed.
_FLOWN_BY = frozenset(
    {'MANUAL_CONTROL', 'SET_POSITION_TARGET_GLOBAL_INT', 'SET_POSITION_TARGET_LOCAL_NED'}
)

MAX_LINKS = 32
# A peer that says nothing for so long gets no more telemetry. Heartbeats come every second.
_LINK_SILENCE_S = 10.0
# A session whose owner is gone ends, so that the simulator serves ground stations again.
_SESSION_SILENCE_S = 60.0
# After a stall, simulated time goes on from here instead of catching up.
_MAX_CATCH_UP_S = 0.25
# Old nonces, to tell a late duplicate of an old session from a new one.
_REMEMBERED_NONCES = 64
# Plain name: before Python 3.12 a member is slow to look up, and each tick asks.
_ACCEPTED = Result.ACCEPTED
_UNSIGNED = Answer(Result.DENIED, 'Not signed with the key')


class SimServer:
    """Several vehicles behind one endpoint.

    Args:
        system_ids: MAVLink system ids of the stand-alone vehicles.
        watchers: Destinations that get telemetry without having asked.
        owner_silence_s: After so long a silence of its owner a session may be taken over.
    """

    def __init__(
        self,
        system_ids: Iterable[int] = (1,),
        watchers: Iterable[Hashable] = (),
        *,
        owner_silence_s: float = OWNER_SILENCE_S,
    ) -> None:
        self._owner_silence_s = owner_silence_s
        self._vehicles: dict[int, Vehicle] = {}
        for seat, system_id in enumerate(system_ids):
            self._vehicles[system_id] = Vehicle(system_id, seat)
        self._standalone = tuple(self._vehicles)
        self._links: dict[Hashable, Link] = {w: Link(permanent=True) for w in watchers}
        self._session: Session | None = None
        self._session_heard_s = 0.0
        self._nonces: deque[int] = deque(maxlen=_REMEMBERED_NONCES)
        self._decoder = Decoder()
        self._services = Services()
        self._reader = SetPointReader()
        self._wall_s: float | None = None
        self._station_heard_s: float | None = None
        self._lag_s = 0.0
        self._trusted = True  # the datagram under way

    @property
    def vehicles(self) -> dict[int, Vehicle]:
        """The vehicles in the air space now: the session's fleet or the stand-alone ones."""
        if self._session is not None:
            return self._session.fleet
        return {i: self._vehicles[i] for i in self._standalone}

    @property
    def in_lockstep(self) -> bool:
        """Whether a session is open."""
        return self._session is not None

    # Datagrams --------------------------------------------------------------------------------

    def handle(self, datagram: bytes, source: Hashable, *, trusted: bool = True) -> list[bytes]:
        """Act on a datagram.

        Args:
            datagram: Any bytes; what is no intact frame is skipped.
            source: Where it came from.
            trusted: Whether its sender may command.

        Returns:
            Datagrams to send back to `source`.
        """
        out: list[bytes] = []
        self._trusted = trusted
        for frame in split(datagram):
            link = self._links.get(source)
            if link is None:
                link = self._new_link(source)
            link.heard = True
            session = self._session
            message_id, _, system_id, component_id, payload, _ = frame
            sender = (system_id, component_id)
            if session is not None and self._owns(session, source, sender):
                if not session.newer.accept(frame):
                    # A new client may count from 0 again on the same port.
                    if message_id == _COMMAND_LONG_ID and _is_lockstep(frame):
                        self._message(frame, source, link, out)
                    continue
                if message_id == _SET_POINT_ID:
                    session.take_set_point(payload)
                    continue
                if message_id == _COMMAND_LONG_ID:
                    fields = COMMAND_LONG.unpack(payload)
                    if fields[7] == CMD_STEP:
                        self._step(session, fields[0], frame, link, out)
                        continue
            self._message(frame, source, link, out)
            opened = self._session
            if opened is not None and opened is not session and self._owns(opened, source, sender):
                # What its owner sent before, for an older session, must not act in this one.
                opened.newer.accept(frame)
        return _datagrams(out)

    def _new_link(self, source: Hashable) -> Link:
        if len(self._links) >= MAX_LINKS:
            owner = self._session.source if self._session is not None else None
            oldest = min(
                (s for s, link in self._links.items() if not link.permanent and s != owner),
                key=lambda s: self._links[s].heard_s,
                default=None,
            )
            if oldest is not None:
                del self._links[oldest]
        link = self._links[source] = Link(permanent=False)
        link.heard_s = self._wall_s or 0.0
        return link

    def _step(
        self, session: Session, param1: float, frame: Frame, link: Link, out: list[bytes]
    ) -> None:
        tick = whole(param1)
        result = Result.DENIED if tick is None else session.step(tick)
        if result is _ACCEPTED:
            out.append(session.states(link.sequences))
        first = next(iter(session.fleet))
        out.append(
            COMMAND_ACK.frame(
                link.sequence(first), CMD_STEP, result, 0, tick if tick is not None else -1,
                frame.system_id, frame.component_id,
            )
        )  # fmt: skip

    def _message(self, frame: Frame, source: Hashable, link: Link, out: list[bytes]) -> None:
        """Act on a message off the tick path."""
        m = self._decoder.decode(frame)
        if m is None:
            return
        kind = m.get_type()
        sender = (frame.system_id, frame.component_id)
        if kind == 'HEARTBEAT' and m.autopilot == mavlink.MAV_AUTOPILOT_INVALID:
            self._station_heard_s = self._wall_s or 0.0
        if kind in ('COMMAND_LONG', 'COMMAND_INT'):
            read = request_of_long if kind == 'COMMAND_LONG' else request_of_int
            self._command(read(m, sender), m.target_system, m.target_component, source, link, out)
        elif kind in _FLOWN_BY:
            if self._session is None and self._trusted:
                self._fly_by(m, kind)
        else:
            may_change = self._trusted and (
                self._session is None or self._session.owned_by(source, sender)
            )
            out.extend(self._services.answer(m, kind, sender, self.vehicles, link, may_change))

    def _fly_by(self, m: Any, kind: str) -> None:
        """Take a streamed set-point or the sticks, outside a session."""
        if kind == 'MANUAL_CONTROL':
            for vehicle in self._addressed(m.target, 0):
                vehicle.pilot.take_sticks(*sticks_of(m))
            return
        for vehicle in self._addressed(m.target_system, m.target_component):
            target = read_streamed(self._reader, m, kind, vehicle)
            if target is not None:
                vehicle.autopilot.set_target(target)

    def _addressed(self, system_id: int, component_id: int) -> list[Vehicle]:
        """Return the vehicles that a message is for (0 means all)."""
        if component_id not in (0, mavlink.MAV_COMP_ID_AUTOPILOT1):
            return []
        vehicles = self.vehicles
        if system_id == 0:
            return list(vehicles.values())
        return [vehicles[system_id]] if system_id in vehicles else []

    # Commands -----------------------------------------------------------------------------------

    def _command(
        self,
        request: Request,
        system_id: int,
        component_id: int,
        source: Hashable,
        link: Link,
        out: list[bytes],
    ) -> None:
        if request.command == CMD_LOCKSTEP:
            answer = self._lockstep(request, source)
            # The nonce says which session this is about.
            number = max(whole(request.p2) or 0, 0) & 0xFFFFFF
            answers = [(vehicle, answer) for vehicle in self._addressed(0, 0)[:1]]
        elif request.command == CMD_STEP:
            # Whatever vehicle is meant: a client whose session is gone must learn it.
            number = 0
            denial = Answer(Result.DENIED, 'No such session')
            answers = [(vehicle, denial) for vehicle in self._addressed(0, 0)[:1]]
        else:
            session = self._session
            owned = session is not None and self._owns(session, source, request.sender)
            number = session.nonce if session is not None and owned else 0
            answers = [
                (vehicle, self._vehicle_command(vehicle, request, source, link, out))
                for vehicle in self._addressed(system_id, component_id)
            ]
        for vehicle, answer in answers:
            sequence = link.sequence(vehicle.system_id)
            out.append(
                COMMAND_ACK.frame(
                    sequence, request.command, answer.result, 0, number, *request.sender
                )
            )
            if answer.reason:
                out.append(self._services.text(sequence, answer.reason))

    def _vehicle_command(
        self,
        vehicle: Vehicle,
        request: Request,
        source: Hashable,
        link: Link,
        out: list[bytes],
    ) -> Answer:
        asked = self._services.request(vehicle, request, link, out)
        if asked is not None:
            return asked
        if not self._trusted:
            return _UNSIGNED
        session = self._session
        if session is not None:
            if not session.owned_by(source, request.sender):
                return Answer(Result.TEMPORARILY_REJECTED, 'In lockstep with another client')
            if request.command in PREPARATIONS:
                if session.tick > 0:
                    return Answer(Result.DENIED, 'Only before the first step')
                return prepare(vehicle, request)
        handler = HANDLERS.get(request.command)
        if handler is None:
            # Wind and seed too: they belong to lockstep.
            return Answer(Result.UNSUPPORTED)
        return handler(vehicle, request)

    def _lockstep(self, request: Request, source: Hashable) -> Answer:
        """Open or close a session."""
        if not self._trusted:
            return _UNSIGNED
        nonce = whole(request.p2)
        if nonce is None or not 1 <= nonce <= MAX_NONCE:
            return Answer(Result.DENIED, 'Lockstep denied: nonce')
        session = self._session
        if request.p1 == 0.0:
            if session is not None and session.nonce == nonce:
                if not session.owned_by(source, request.sender):
                    return Answer(Result.DENIED, 'Lockstep denied: not its owner')
                self._leave()
                return ACCEPTED
            # Left already: the answer was lost.
            return ACCEPTED if nonce in self._nonces else Answer(Result.DENIED, 'No such session')
        if request.p1 != 1.0:
            return Answer(Result.DENIED, 'Lockstep denied: enter or leave')
        if session is not None and session.nonce == nonce:
            same = session.owned_by(source, request.sender)
            return ACCEPTED if same else Answer(Result.DENIED, 'Nonce is taken')
        if nonce in self._nonces:
            return Answer(Result.DENIED, 'Lockstep denied: old session')
        owned = session is not None and self._owns(session, source, request.sender)
        if session is not None and not owned and self._owner_speaks(session):
            return Answer(Result.TEMPORARILY_REJECTED, f'Held by {_address(session.source)}')
        wanted = read_session(request)
        if isinstance(wanted, Answer):
            return wanted
        tick_us, system_ids = wanted
        fleet = []
        for system_id in system_ids:
            if system_id not in self._vehicles:
                self._vehicles[system_id] = Vehicle(system_id, system_id - 1)
            vehicle = self._vehicles[system_id]
            vehicle.place_default(lockstep=True)
            fleet.append(vehicle)
        self._session = Session(nonce, source, request.sender, tick_us, fleet)
        self._nonces.append(nonce)
        self._session_heard_s = self._wall_s or 0.0
        return ACCEPTED

    def _owner_speaks(self, session: Session) -> bool:
        """Return whether the owner was heard lately."""
        link = self._links[session.source]
        if link.heard:
            return True
        heard_s = max(link.heard_s, self._session_heard_s)
        return (self._wall_s or 0.0) - heard_s <= self._owner_silence_s

    def _owns(self, session: Session, source: Hashable, sender: tuple[int, int]) -> bool:
        """Return whether the datagram under way is from the session's owner."""
        return self._trusted and session.source == source and session.sender == sender

    def _leave(self) -> None:
        self._session = None
        for system_id in self._standalone:
            self._vehicles[system_id].place_default()

    # Time ---------------------------------------------------------------------------------------

    def poll(self, wall_time_s: float) -> list[tuple[Hashable, bytes]]:
        """Let time pass and return the telemetry that is due, with its destinations.

        Args:
            wall_time_s: Steady time; differences count.
        """
        elapsed_s = 0.0 if self._wall_s is None else max(wall_time_s - self._wall_s, 0.0)
        self._wall_s = wall_time_s
        self._forget(wall_time_s)
        session = self._session
        if session is None:
            self._run(elapsed_s)
        owner = session.source if session is not None else None
        vehicles = self.vehicles
        out: list[tuple[Hashable, bytes]] = []
        for destination, link in self._links.items():
            if session is not None and destination == owner:
                continue
            frames: list[bytes] = []
            for vehicle in vehicles.values():
                frames.extend(link.due(vehicle, wall_time_s))
            out.extend((destination, datagram) for datagram in _datagrams(frames))
        for vehicle in vehicles.values():
            vehicle.pilot.outbox.clear()
        return out

    def _run(self, elapsed_s: float) -> None:
        self._lag_s = min(self._lag_s + elapsed_s, _MAX_CATCH_UP_S)
        steps = int(self._lag_s / MAX_SUBSTEP_S)
        self._lag_s -= steps * MAX_SUBSTEP_S
        silent_s = None
        if self._station_heard_s is not None and self._wall_s is not None:
            silent_s = self._wall_s - self._station_heard_s
        for vehicle in self.vehicles.values():
            vehicle.run(steps, MAX_SUBSTEP_S)
            vehicle.since_step_s = self._lag_s
            vehicle.pilot.link_silent_s = silent_s
            vehicle.pilot.step(steps * MAX_SUBSTEP_S)

    def _forget(self, wall_time_s: float) -> None:
        """Drop silent peers and a session without an owner."""
        session = self._session
        for link in self._links.values():
            if link.heard:
                link.heard = False
                link.heard_s = wall_time_s
        if session is not None:
            link = self._links[session.source]
            if wall_time_s - max(link.heard_s, self._session_heard_s) > _SESSION_SILENCE_S:
                self._leave()
                session = None
        owner = session.source if session is not None else None
        silent = [
            source
            for source, link in self._links.items()
            if not link.permanent
            and wall_time_s - link.heard_s > _LINK_SILENCE_S
            and (session is None or source != owner)
        ]
        for source in silent:
            del self._links[source]


def _address(source: Hashable) -> str:
    return ':'.join(map(str, source)) if isinstance(source, tuple) else str(source)


def _is_lockstep(frame: Frame) -> bool:
    return bool(COMMAND_LONG.unpack(frame.payload)[7] == CMD_LOCKSTEP)


# Frames are joined into datagrams up to this size, below any Ethernet MTU. A tick's states are
# one element and stay whole, which the loopback interface carries.
_JOIN_BYTES = 1200


def _datagrams(frames: list[bytes]) -> list[bytes]:
    """Join frames into datagrams."""
    if len(frames) < 2:
        return frames
    if len(frames) == 2:
        # States and acknowledgement of a tick.
        return [frames[0] + frames[1]]
    out: list[bytes] = []
    current = b''
    for frame in frames:
        if current and len(current) + len(frame) > _JOIN_BYTES:
            out.append(current)
            current = b''
        current += frame
    out.append(current)
    return out
