# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""MAVLink frames as bytes: split a datagram, and pack and unpack the messages of every tick.

pymavlink needs 4 us to pack and 8 us to parse a message. A tick carries at least six, so these
few are packed with `struct` here, byte for byte as pymavlink does it (a test compares them);
everything else goes through pymavlink (`decode`). `plain_split`, `plain_pack`, `PlainLayout` and
`PlainNewer` say what is done; where set-up could compile their twins (`native/wire.c`), these do
the same five times as fast.

A datagram is a whole: a frame that does not end inside it is lost, and never waits for the next
datagram as a stream parser would let it.

Source: MAVLink guide, "Packet Serialization" (MAVLink 1 and 2, checksum CRC-16/MCRF4XX).
"""

from __future__ import annotations

import struct
from collections.abc import Callable, Iterator
from functools import partial
from typing import TYPE_CHECKING, Any, NamedTuple, cast

from pymavlink.dialects.v20 import common as mavlink

from aurora_uav_sim.native_code import twin

# Longer datagrams are not ours (ten vehicles need 0.7 kB to us, 1.2 kB from us).
MAX_DATAGRAM = 16384

_MARKER_V2 = 0xFD
_MARKER_V1 = 0xFE
_SIGNED = 0x01
_SIGNATURE_LENGTH = 13

_CRC_EXTRA: dict[int, bytes] = {
    int(number): bytes([kind.crc_extra]) for number, kind in mavlink.mavlink_map.items()
}


def crc_extra(message_id: int) -> bytes:
    """Return the byte that a message of the dialect adds to its checksum."""
    return _CRC_EXTRA[message_id]


def slow_crc16(data: bytes) -> int:
    """Return CRC-16/MCRF4XX of `data` by pymavlink's own Python code."""
    return int(mavlink.x25crc(data).crc)


# fastcrc (a dependency of pymavlink) is C; it is missing on some platforms.
crc16: Callable[[bytes], int] = mavlink.mcrf4xx or slow_crc16


# Marker, payload length, flags that must be understood and need not be, sequence, sender, message.
_V2 = struct.Struct('<BBBBBBBHB')
# Marker, payload length, sequence, sender, message.
_V1 = struct.Struct('<BBBBBB')


class Frame(NamedTuple):
    """A frame whose checksum is right.

    Attributes:
        message_id: Which message.
        sequence: 0 to 255, counts the sender's frames.
        system_id: Of the sender.
        component_id: Of the sender.
        payload: Without the zeros that MAVLink 2 cuts off.
        raw: The whole frame.
    """

    message_id: int
    sequence: int
    system_id: int
    component_id: int
    payload: bytes
    raw: bytes


def plain_split(datagram: bytes) -> Iterator[Frame]:
    """Yield the intact frames of a datagram; anything else between them is skipped."""
    end = len(datagram)
    if end > MAX_DATAGRAM:
        return
    start = 0
    while end - start >= 8:
        marker = datagram[start]
        if marker == _MARKER_V2 and end - start >= 12:
            (_, length, flags, _, sequence, system_id, component_id, low, high) = _V2.unpack_from(
                datagram, start
            )
            message_id = high << 16 | low
            body = start + 10
            known = flags & ~_SIGNED == 0
            after = body + length + (2 + _SIGNATURE_LENGTH if flags & _SIGNED else 2)
        elif marker == _MARKER_V1:
            _, length, sequence, system_id, component_id, message_id = _V1.unpack_from(
                datagram, start
            )
            body = start + 6
            known = True
            after = body + length + 2
        else:
            start += 1
            continue
        extra = _CRC_EXTRA.get(message_id)
        if known and extra is not None and after <= end:
            stop = body + length
            crc = crc16(datagram[start + 1 : stop] + extra)
            if crc == datagram[stop] | datagram[stop + 1] << 8:
                yield Frame(
                    message_id,
                    sequence,
                    system_id,
                    component_id,
                    datagram[body:stop],
                    datagram[start:after],
                )
                start = after
                continue
        start += 1


class Decoder:
    """pymavlink for the messages that are not on the tick path."""

    def __init__(self) -> None:
        self._parser = mavlink.MAVLink(None)
        # Without this, one bad frame blocks the parser for ever.
        self._parser.robust_parsing = True

    def decode(self, frame: Frame) -> Any | None:
        """Return the pymavlink message of a frame, None when pymavlink refuses it."""
        messages = self._parser.parse_buffer(bytearray(frame.raw))
        if not messages or messages[0].get_type() == 'BAD_DATA':
            # Nothing of a refused frame may wait for the next one.
            self._parser.buf = bytearray()
            self._parser.buf_index = 0
            return None
        return messages[0]


def plain_pack(
    sequence: int, system_id: int, component_id: int, message_id: int, payload: bytes
) -> bytes:
    """Return a MAVLink 2 frame.

    Args:
        sequence: 0 to 255.
        system_id: Of the sender.
        component_id: Of the sender.
        message_id: Which message; the dialect must know it.
        payload: Full payload; its trailing zeros are cut off here.
    """
    payload = payload.rstrip(b'\0') or b'\0'
    frame = (
        _V2.pack(
            _MARKER_V2, len(payload), 0, 0, sequence, system_id, component_id,
            message_id & 0xFFFF, message_id >> 16,
        )
        + payload
    )  # fmt: skip
    return frame + crc16(frame[1:] + _CRC_EXTRA[message_id]).to_bytes(2, 'little')


_twin = twin('aurora_uav_wire')
IS_COMPILED = _twin is not None
split: Callable[[bytes], Iterator[Frame]] = plain_split
pack: Callable[[int, int, int, int, bytes], bytes] = plain_pack
if _twin is not None:
    split = partial(_twin.split, _CRC_EXTRA, Frame, MAX_DATAGRAM)
    pack = partial(_twin.pack, _CRC_EXTRA)


class PlainLayout:
    """A message of the tick path: its id and its packed fields in wire order.

    Args:
        kind: pymavlink's class of the message.
    """

    __slots__ = ('message_id', 'size', 'structure')

    def __init__(self, kind: Any) -> None:
        self.message_id = int(kind.id)
        self.structure: struct.Struct = kind.unpacker
        self.size: int = self.structure.size

    def frame(self, sequence: Sequence, *fields: Any) -> bytes:
        """Pack the next message of a sender from its fields in wire order."""
        number = sequence.seq
        sequence.seq = (number + 1) & 0xFF
        payload = self.structure.pack(*fields)
        return plain_pack(
            number, sequence.srcSystem, sequence.srcComponent, self.message_id, payload
        )

    def unpack(self, payload: bytes) -> tuple[Any, ...]:
        """Return the fields; cut-off zeros are put back, unknown extensions are cut off."""
        size = self.size
        if len(payload) != size:
            payload = payload[:size].ljust(size, b'\0')
        return self.structure.unpack(payload)


def layout_of(kind: Any) -> PlainLayout:
    """Return the layout of a message, compiled where there is a twin."""
    if _twin is None:
        return PlainLayout(kind)
    number, extra = int(kind.id), kind.crc_extra
    return cast('PlainLayout', _twin.Layout(number, extra, kind.unpacker.format))


LOCAL_POSITION = layout_of(mavlink.MAVLink_local_position_ned_message)
ATTITUDE = layout_of(mavlink.MAVLink_attitude_quaternion_message)
NAMED_INT = layout_of(mavlink.MAVLink_named_value_int_message)
COMMAND_ACK = layout_of(mavlink.MAVLink_command_ack_message)
COMMAND_LONG = layout_of(mavlink.MAVLink_command_long_message)
SET_POINT = layout_of(mavlink.MAVLink_set_position_target_local_ned_message)


class Sequence:
    """A sender's frame counter.

    Attributes:
        seq: Number of the next frame (pymavlink's name: its messages are packed with it too).
        srcSystem: System id of the sender (pymavlink's name).
        srcComponent: Component id of the sender (pymavlink's name).
        signing: pymavlink's signing state, off.
    """

    __slots__ = ('seq', 'signing', 'srcComponent', 'srcSystem')

    def __init__(self, system_id: int, component_id: int) -> None:
        self.seq = 0
        self.srcSystem = system_id
        self.srcComponent = component_id
        self.signing = mavlink.MAVLinkSigning()

    def encode(self, message: Any) -> bytes:
        """Pack a pymavlink message."""
        frame = bytes(message.pack(self))
        self.seq = (self.seq + 1) & 0xFF
        return frame


class PlainNewer:
    """Lets each sender's frames through once and in order: stale duplicates stop here.

    The counter wraps at 256, so of two frames the one less than half a turn ahead is newer.
    """

    __slots__ = ('_last',)

    def __init__(self) -> None:
        self._last: dict[int, int] = {}

    def accept(self, frame: Frame) -> bool:
        """Return whether the frame is newer than all of its sender so far."""
        _, sequence, system_id, component_id, _, _ = frame
        sender = system_id << 8 | component_id
        last = self._last.get(sender)
        if last is not None and not 0 < (sequence - last) & 0xFF < 128:
            return False
        self._last[sender] = sequence
        return True


_compiled_newer: Any = PlainNewer if _twin is None else _twin.Newer
Newer = PlainNewer if TYPE_CHECKING else _compiled_newer
