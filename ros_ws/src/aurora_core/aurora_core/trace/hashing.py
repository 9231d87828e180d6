# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The trace hash and the motion hash: sha256 over decoded values in one canonical encoding.

The trace hash covers roster, world, states, commands, comm, sensing and events, ordered by tick,
topic, id; the motion hash the same without the world, which holds the conditions' texts: it tells
whether anybody moved, sent or saw otherwise. Neither covers run id, wall times, heartbeat,
diagnostics, margins. float64 little-endian, integers as int64 little-endian, strings UTF-8 with
their length in front.
"""

from __future__ import annotations

import hashlib
import struct
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from aurora_core.knowledge.world import WorldModel
from aurora_core.trace.roster import Roster, RosterEntry
from aurora_core.trace.trace import Trace

# Encodings are handed to the digest in pieces of about this size.
_PIECE_BYTES = 1 << 20
_ONE = (1).to_bytes(8, 'little')
_INT_HEAD = b'i' + _ONE
_FLOAT_HEAD = b'f' + _ONE
_EMPTY_TUPLE = b't' + bytes(8)
_DOUBLE = struct.Struct('<d')


@dataclass(frozen=True, slots=True, kw_only=True)
class TraceHashes:
    """What a run is told by.

    Attributes:
        trace_sha256: Trace hash (hex).
        motion_sha256: Motion hash (hex).
    """

    trace_sha256: str
    motion_sha256: str


class _Encoder:
    """Feeds digests with typed, self-delimiting values, encoded once."""

    def __init__(self) -> None:
        self._digests = [hashlib.sha256()]
        self._buffer = bytearray()

    def fork(self) -> None:
        """From now on a second digest takes what the first one takes, from the same beginning."""
        self._flush()
        self._digests.append(self._digests[0].copy())

    def only_first(self, encoded: bytes) -> None:
        """Add an encoded value that the second digest does not take."""
        self._flush()
        self._digests[0].update(encoded)

    def _flush(self) -> None:
        for digest in self._digests:
            digest.update(self._buffer)
        self._buffer.clear()

    def add(self, value: object) -> None:
        _encode(value, self._buffer)
        if len(self._buffer) > _PIECE_BYTES:
            self._flush()

    def hexdigests(self) -> tuple[str, ...]:
        self._flush()
        return tuple(digest.hexdigest() for digest in self._digests)


def _encode(value: object, buffer: bytearray) -> None:
    if isinstance(value, np.ndarray):
        array = np.ascontiguousarray(value, dtype='<f8')
        buffer += b'a' + array.size.to_bytes(8, 'little')
        buffer += array.tobytes()
    elif isinstance(value, str):
        data = value.encode('utf-8')
        buffer += b's' + len(data).to_bytes(8, 'little') + data
    elif isinstance(value, float):
        buffer += _FLOAT_HEAD + _DOUBLE.pack(value)
    elif isinstance(value, tuple | list):
        if not value:
            buffer += _EMPTY_TUPLE
            return
        buffer += b't' + len(value).to_bytes(8, 'little')
        for item in value:
            _encode(item, buffer)
    elif isinstance(value, bool | int | np.integer | np.bool_):
        buffer += _INT_HEAD + int(value).to_bytes(8, 'little', signed=True)
    else:
        raise TypeError(f'cannot encode {type(value).__name__}')


class _Same:
    """A world that is equal to itself alone: comparing two takes longer than encoding one."""

    def __init__(self, world: WorldModel) -> None:
        self.world = world

    def __hash__(self) -> int:
        return id(self.world)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, _Same) and other.world is self.world


@lru_cache(maxsize=1)
def _encoded_world(same: _Same) -> bytes:
    """Return the encoding of a world, which its digest and the trace hash both need."""
    buffer = bytearray()
    _encode(_world_values(same.world), buffer)
    return bytes(buffer)


def world_sha256(world: WorldModel) -> str:
    """Return the digest (hex) of a world."""
    return hashlib.sha256(_encoded_world(_Same(world))).hexdigest()


def trace_sha256(trace: Trace, world: WorldModel) -> str:
    """Return the trace hash (hex)."""
    return trace_hashes(trace, world).trace_sha256


def trace_hashes(trace: Trace, world: WorldModel) -> TraceHashes:
    """Return the trace hash and the motion hash."""
    encoder = _Encoder()
    encoder.add(_roster_values(trace.roster))
    encoder.fork()
    encoder.only_first(_encoded_world(_Same(world)))
    links: dict[int, list[object]] = {}
    sights: dict[int, list[object]] = {}
    events: dict[int, list[object]] = {}
    for link in trace.links:
        links.setdefault(link.tick, []).append(
            (
                link.sequence,
                link.message,
                link.link,
                link.event,
                link.sender,
                link.receiver,
                int(link.kind),
                link.attempt,
                int(link.reason),
                link.distance_m,
                link.line_of_sight,
            )
        )
    for sight in sorted(trace.sights, key=lambda s: (s.tick, s.observer, s.target)):
        sights.setdefault(sight.tick, []).append(
            (sight.observer, sight.target, sight.visible, sight.slant_range_m)
        )
    for event in trace.events:
        events.setdefault(event.tick, []).append(
            (event.sequence, int(event.kind), event.subject, event.detail)
        )
    for tick in range(trace.ticks):
        encoder.add(tick)
        encoder.add(links.get(tick, ()))
        encoder.add(events.get(tick, ()))
        encoder.add(
            [
                (c.agent, int(c.kind), c.value, c.value2, c.text)
                for c in trace.ground_commands[tick]
            ]
        )
        encoder.add(trace.ground[tick])
        encoder.add(sights.get(tick, ()))
        encoder.add(trace.uav_commands[tick])
        encoder.add(trace.uav[tick])
    whole, motion = encoder.hexdigests()
    return TraceHashes(trace_sha256=whole, motion_sha256=motion)


def _roster_values(roster: Roster) -> object:
    return (
        roster.dt_s,
        tuple(_entry_values(e) for e in roster.agents),
        tuple(_entry_values(e) for e in roster.uavs),
    )


def _entry_values(e: RosterEntry) -> object:
    return (
        e.body_id,
        e.type_name,
        e.is_person,
        e.system_id,
        e.length_m,
        e.width_m,
        e.height_m,
        e.route_edges,
        np.array(e.route_xy_m),
        e.role,
    )


def _world_values(w: WorldModel) -> object:
    return (
        w.map_name,
        w.map_digest,
        w.origin_lat_deg,
        w.origin_lon_deg,
        w.weather,
        w.time_of_day,
        (w.wind.mean_east_mps, w.wind.mean_north_mps, w.wind.gust_mps),
        tuple(
            (
                b.id,
                np.array(b.ring),
                tuple(np.array(h) for h in b.holes),
                b.height_m,
                b.height_source,
                b.kind,
                b.name,
            )
            for b in w.buildings
        ),
        tuple((z.id, z.name, np.array(z.ring), z.floor_m, z.ceiling_m) for z in w.no_fly_zones),
        tuple((s.surface_id, int(s.kind), s.ring, s.holes) for s in w.surfaces),
        tuple((c.lane_id, c.street_name, c.points, c.width_m, c.speed_limit_mps) for c in w.lanes),
        tuple((p.junction_id, p.x_m, p.y_m) for p in w.signals),
        tuple((p.name, p.x_m, p.y_m) for p in w.places),
        w.limits.canonical_json(),
        w.conditions_json,
    )
