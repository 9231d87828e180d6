# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""R10: whatever frames a stranger sends, nothing changes. R11: a mission is uploaded whole or not
at all, whatever the link loses, doubles and reorders.
"""

from __future__ import annotations

import math
import random
import struct
from dataclasses import astuple
from pathlib import Path
from typing import Any

from pymavlink.dialects.v20 import common as mavlink

from aurora_bench.trust.part import NEVER, Counter, Found
from aurora_uav_sim import wire
from aurora_uav_sim.mavlink_server import SimServer
from aurora_uav_sim.signed_server import SignedServer
from aurora_uav_sim.signing import Signer

_KEY, _FOREIGN = bytes(range(32)), bytes(32)
_MESSAGES = tuple(mavlink.mavlink_map)
_SPECIAL = (math.nan, math.inf, -math.inf, 1e38, -0.0)
# So many frames of strangers between two looks at the vehicle.
_LOOK_FRAMES = 50
_ARM = 400
_REQUEST_MESSAGE = 512
_AUTOPILOT_VERSION = 148


class _Station:
    """Packs messages of somebody, with growing sequence numbers."""

    def __init__(self, system_id: int = 255) -> None:
        self._mav = mavlink.MAVLink(None, srcSystem=system_id, srcComponent=190)

    def pack(self, message: Any) -> bytes:
        """Return a frame."""
        raw = bytes(message.pack(self._mav))
        self._mav.seq = (self._mav.seq + 1) % 256
        return raw


def frames(first: int, count: int, _: Path) -> Found:
    """Send frames of all kinds that do not have the key to a simulator that has one.

    A case is a frame. It holds when nothing is raised, vehicle, plans, settings and session are
    what they were, and the owner of the key is still answered.
    """
    counter = Counter()
    rng = random.Random(first)
    inner = SimServer()
    server = SignedServer(inner, Signer(_KEY))
    owner, signer, foreign = _Station(), Signer(_KEY), Signer(_FOREIGN)
    good = owner.pack(_command(_ARM, 1.0))
    seen = signer.sign(owner.pack(mavlink.MAVLink_heartbeat_message(6, 8, 0, 0, 4, 3)))
    server.handle(seen, 'owner')
    before = _state(inner)
    for number in range(count):
        frame = _hostile(rng, number, good, seen, foreign)
        try:
            server.handle(frame, ('stranger', number % 40))
            problem = ''
        except Exception as err:  # noqa: BLE001  (whatever it is, it is what is looked for)
            problem = f'{type(err).__name__}: {err} on {frame.hex()}'
        if number % _LOOK_FRAMES == _LOOK_FRAMES - 1 and not problem:
            if _state(inner) != before:
                problem = f'something changed by frame {first + number}: {_state(inner)}'
                before = _state(inner)
            asked = _command(_REQUEST_MESSAGE, _AUTOPILOT_VERSION)
            if not server.handle(signer.sign(owner.pack(asked)), 'owner'):
                problem = f'the owner was not answered after frame {first + number}'
        counter.add(problem)
    return counter.found()


def _hostile(rng: random.Random, number: int, good: bytes, seen: bytes, foreign: Signer) -> bytes:
    kind = number % 8
    if kind == 0:
        return rng.randbytes(rng.randrange(300))
    if kind == 1:
        changed = bytearray(seen)
        changed[rng.randrange(len(changed))] ^= rng.randrange(1, 256)
        return bytes(changed)
    if kind == 2:
        return seen  # a signature counts once
    if kind == 3:
        return foreign.sign(good)
    if kind == 4:
        return good
    if kind == 5:
        count = mavlink.MAVLink_mission_count_message(1, 1, 65535, rng.randrange(4))
        return _Station(rng.randrange(1, 256)).pack(count)
    if kind == 6:
        values = b''.join(struct.pack('<f', rng.choice(_SPECIAL)) for _ in range(10))
        payload = (values + rng.randbytes(60))[: rng.choice((9, 30, 60, 100))]
    else:
        payload = rng.randbytes(rng.choice((1, 9, 30, 255)))
    return wire.pack(
        number & 0xFF, rng.randrange(1, 256), rng.randrange(256), rng.choice(_MESSAGES), payload
    )


def _command(number: int, *parameters: float) -> Any:
    filled = [*parameters, *([0.0] * (7 - len(parameters)))]
    return mavlink.MAVLink_command_long_message(1, 1, number, 0, *filled)


def _state(server: SimServer) -> tuple[Any, ...]:
    """Return everything that a stranger must not change."""
    told: list[Any] = [server.in_lockstep, sorted(server.vehicles)]
    for vehicle in server.vehicles.values():
        autopilot, pilot = vehicle.autopilot, vehicle.pilot
        body = autopilot.body
        told += [autopilot.armed, autopilot.mode, body.x, body.y, body.z]
        told += [astuple(autopilot.settings), pilot.mission.items, pilot.fence_items]
    return tuple(told)


# R11 ------------------------------------------------------------------------------------------

_PARTLY = 'neither the old plan nor the new'
_STEP_S = 0.02
_UPLOAD_LIMIT_S = 60.0
_TIMEOUT_S, _RETRIES = 1.5, 5


class _Link:
    """Loses, doubles and delays datagrams both ways.

    Args:
        loss: Share of the datagrams that never arrives.
        cut_s: Nothing arrives from then on.
    """

    def __init__(self, rng: random.Random, loss: float, cut_s: float) -> None:
        self._rng, self._loss, self._cut_s = rng, loss, cut_s
        self._under_way: list[tuple[float, int, bytes]] = []
        self._count = 0

    def put(self, now_s: float, datagram: bytes) -> None:
        """Send a datagram."""
        copies = 2 if self._rng.random() < 0.05 else 1
        for _ in range(copies):
            if self._rng.random() >= self._loss and now_s < self._cut_s:
                self._count += 1
                delay_s = self._rng.uniform(0.0, 0.1)
                self._under_way.append((now_s + delay_s, self._count, datagram))

    def take(self, now_s: float) -> list[bytes]:
        """Return what has arrived, which may be in another order."""
        arrived = sorted(entry for entry in self._under_way if entry[0] <= now_s)
        self._under_way = [entry for entry in self._under_way if entry[0] > now_s]
        return [datagram for _, _, datagram in arrived]


def uploads_10(first: int, count: int, folder: Path) -> Found:
    """Upload missions over links that lose one datagram in ten."""
    return _uploads(first, count, 0.1, cut=False)


def uploads_20(first: int, count: int, folder: Path) -> Found:
    """Upload missions over links that lose one datagram in five."""
    return _uploads(first, count, 0.2, cut=False)


def uploads_cut(first: int, count: int, folder: Path) -> Found:
    """Upload missions over links that are cut: the old one stays, or the new one is whole."""
    return _uploads(first, count, 0.05, cut=True)


def _uploads(first: int, count: int, loss: float, *, cut: bool) -> Found:
    counter = Counter()
    for number in range(first, first + count):
        problem = _upload(random.Random(number), loss, cut=cut)
        # Of these not one is allowed, whatever share has to arrive.
        counter.figure(NEVER, float(_PARTLY in problem))
        counter.add(problem)
    return counter.found()


def _upload(rng: random.Random, loss: float, *, cut: bool) -> str:
    """Upload a second plan over a first one; return what went wrong."""
    server = SimServer()
    server.poll(0.0)
    vehicle = next(iter(server.vehicles.values()))
    old, new = _plan(rng, 3), _plan(rng, rng.randrange(2, 20))
    done = _transfer(server, _Link(rng, 0.0, math.inf), _Link(rng, 0.0, math.inf), old, 0.0)
    before = vehicle.pilot.mission.items
    if not done or len(before) != len(old):
        return 'the first plan was not taken over a good link'
    begun_s = _UPLOAD_LIMIT_S
    cut_s = begun_s + rng.uniform(0.0, 1.5) if cut else math.inf
    done = _transfer(server, _Link(rng, loss, cut_s), _Link(rng, loss, cut_s), new, begun_s)
    after = vehicle.pilot.mission.items
    # A plan is its items and where they are, not how often the link carried them.
    whole = len(after) == len(new) and all(
        (item.x, item.y, item.z) == (m.x, m.y, m.z) for item, m in zip(after, new, strict=True)
    )
    if after != before and not whole:
        return f'{len(after)} of {len(new)} items are active: {_PARTLY}'
    if cut:
        return ''
    return '' if done and whole else 'it was not taken, though the link went on'


def _plan(rng: random.Random, count: int) -> list[Any]:
    places = [(rng.randrange(-900, 900), rng.randrange(-900, 900)) for _ in range(count)]
    return [
        mavlink.MAVLink_mission_item_int_message(
            1, 1, seq, 6, 16, 0, 1, 0, 0, 0, math.nan,
            473_977_419 + x, 85_455_938 + y, 20.0 + seq, 0,
        )
        for seq, (x, y) in enumerate(places)
    ]  # fmt: skip


def _transfer(server: SimServer, up: _Link, down: _Link, plan: list[Any], begun_s: float) -> bool:
    """Upload as the guide of the mission protocol says; tell whether it was acknowledged."""
    station = _Station()
    reader = mavlink.MAVLink(None)
    reader.robust_parsing = True
    count = mavlink.MAVLink_mission_count_message(1, 1, len(plan), 0)
    last: Any = count
    up.put(begun_s, station.pack(last))
    sent_s, tries = begun_s, 0
    now_s = begun_s
    while now_s < begun_s + _UPLOAD_LIMIT_S - 1.0:
        now_s += _STEP_S
        for datagram in up.take(now_s):
            for answer in server.handle(datagram, 'station'):
                down.put(now_s, answer)
        for destination, datagram in server.poll(now_s):
            if destination == 'station':
                down.put(now_s, datagram)
        for datagram in down.take(now_s):
            for m in reader.parse_buffer(bytearray(datagram)) or []:
                kind = m.get_type()
                if kind in ('MISSION_REQUEST_INT', 'MISSION_REQUEST') and m.seq < len(plan):
                    last = plan[m.seq]
                    up.put(now_s, station.pack(last))
                    sent_s, tries = now_s, 0
                elif kind == 'MISSION_ACK':
                    if m.type == mavlink.MAV_MISSION_ACCEPTED:
                        return True
                    # Who hears that begins anew.
                    last = count
                    up.put(now_s, station.pack(last))
                    sent_s, tries = now_s, 0
        if now_s - sent_s > _TIMEOUT_S:
            tries += 1
            if tries > _RETRIES:
                return False
            up.put(now_s, station.pack(last))
            sent_s = now_s
    return False
