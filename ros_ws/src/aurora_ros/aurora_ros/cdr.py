# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Read the first fields of a serialised message without deserialising it.

Every recorded message but `/clock` begins with a `std_msgs/Header`, followed either by
`uint64 run_number, uint64 tick` or by `string run_id`.

Source: OMG DDS-XTypes 1.3, section 7.4.1 (plain CDR, version 1): a 4-byte encapsulation header,
then each primitive aligned to its size, counted from the end of that header.
"""

from __future__ import annotations

import struct

from aurora_core.errors import BagError

_START = 4  # bytes of the encapsulation header
_NANOSECONDS = 1_000_000_000
_FIXED = 12  # seconds, nanoseconds, length of frame_id


def time_ns(cdr: bytes) -> int:
    """Return the stamp that the message begins with, in nanoseconds.

    Raises:
        BagError: The message is cut short.
    """
    seconds, nanoseconds = _unpack(cdr, 'iI', _START)
    return int(seconds) * _NANOSECONDS + int(nanoseconds)


def run_and_tick(cdr: bytes) -> tuple[int, int]:
    """Return run number and tick that follow the header.

    Raises:
        BagError: The message is cut short.
    """
    offset = _after_header(cdr)
    offset += -(offset - _START) % 8
    run_number, tick = _unpack(cdr, 'QQ', offset)
    return int(run_number), int(tick)


def run_id(cdr: bytes) -> str:
    """Return the run id that follows the header.

    Raises:
        BagError: The message is cut short.
    """
    offset = _after_header(cdr)
    offset += -(offset - _START) % 4
    (length,) = _unpack(cdr, 'I', offset)
    text = cdr[offset + 4 : offset + 4 + length]
    if len(text) != length or not length:
        raise BagError(f'expected a text of {length} bytes in a message, found {len(text)}')
    return text[:-1].decode('utf-8', errors='replace')


def _after_header(cdr: bytes) -> int:
    (length,) = _unpack(cdr, 'I', _START + 8)
    return _START + _FIXED + int(length)


def _unpack(cdr: bytes, fields: str, offset: int) -> tuple[int, ...]:
    order = '<' if len(cdr) > 1 and cdr[1] & 1 else '>'
    try:
        return struct.unpack_from(order + fields, cdr, offset)
    except struct.error as err:
        raise BagError(f'expected a message with a header, found {len(cdr)} bytes: {err}') from err
