# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""MAVLink 2 signatures: who has the key of the graph speaks, everybody else may look.

On whole datagrams, beside `wire`: what is sent is signed last, what arrives is checked first. The
key is in a file that only its owner reads; `up` makes one per graph, and both ends find it by an
environment variable. Without the variable nothing is signed.

Source: MAVLink guide, "Message Signing" (SHA-256 over key, frame, link id and time; its first six
bytes). The time of a stream must grow, and that of a new stream be at most a minute old.
"""

from __future__ import annotations

import os
import secrets
import stat
import time
from collections.abc import Callable, Mapping
from hashlib import sha256
from hmac import compare_digest
from pathlib import Path

from aurora_uav_sim.wire import crc16, crc_extra, split

KEY_FILE_VARIABLE = 'AURORA_MAVLINK_KEY_FILE'
KEY_BYTES = 32

_SIGNED = 0x01
_FLAGS = 2  # place of the flags in a frame
_HEAD, _CHECK, _LINK_AND_TIME, _DIGEST = 10, 2, 7, 6
# The time of signatures counts 10 us since 2015.
_EPOCH_S = 1_420_070_400
_NEW_STREAM_UNITS = 60 * 100_000


class KeyFileError(Exception):
    """The key cannot be used; the message says why."""


def now_units() -> int:
    """Return the time of a signature, 10 us since 2015."""
    return time.time_ns() // 10_000 - _EPOCH_S * 100_000


class Signer:
    """Signs and checks with one key; one per process, since a stream's time must grow.

    Args:
        key: 32 bytes.
        now: Gives the time, 10 us since 2015.
    """

    def __init__(self, key: bytes, now: Callable[[], int] = now_units) -> None:
        if len(key) != KEY_BYTES:
            raise KeyFileError(f'expected a key of {KEY_BYTES} bytes, found {len(key)}')
        self._key = key
        self._now = now
        self._link = bytes([secrets.randbelow(256)])
        self._last = 0
        self._streams: dict[tuple[int, int, int], int] = {}

    def sign(self, datagram: bytes) -> bytes:
        """Return a datagram of our own frames with a signature on each."""
        out = []
        start = 0
        while start < len(datagram):
            end = start + _HEAD + datagram[start + 1] + _CHECK
            out.append(self._signed(datagram[start:end]))
            start = end
        return b''.join(out)

    def _signed(self, frame: bytes) -> bytes:
        body = bytearray(frame[:-_CHECK])
        body[_FLAGS] |= _SIGNED
        message_id = int.from_bytes(frame[7:10], 'little')
        check = crc16(bytes(body[1:]) + crc_extra(message_id)).to_bytes(2, 'little')
        self._last = max(self._last + 1, self._now())
        whole = bytes(body) + check + self._link + self._last.to_bytes(6, 'little')
        return whole + self._digest(whole)

    def signed_part(self, datagram: bytes) -> bytes:
        """Return the frames of a datagram that are signed rightly and for the first time."""
        return self.parts(datagram)[0]

    def parts(self, datagram: bytes) -> tuple[bytes, bytes]:
        """Return the frames that are signed rightly, and those that are not signed at all.

        A signature that is wrong or was seen before makes a frame that is in neither.
        """
        signed, plain = [], []
        for frame in split(datagram):
            if frame.raw[0] != 0xFD or not frame.raw[_FLAGS] & _SIGNED:
                plain.append(frame.raw)
            elif self._is_right(frame.raw, frame.system_id, frame.component_id):
                signed.append(frame.raw)
        return b''.join(signed), b''.join(plain)

    def _is_right(self, raw: bytes, system_id: int, component_id: int) -> bool:
        if not compare_digest(self._digest(raw[:-_DIGEST]), raw[-_DIGEST:]):
            return False
        # Of frames with a right signature alone is the time believed.
        place = len(raw) - _DIGEST - _LINK_AND_TIME
        at = int.from_bytes(raw[place + 1 : place + _LINK_AND_TIME], 'little')
        stream = (raw[place], system_id, component_id)
        before = self._streams.get(stream)
        least = before + 1 if before is not None else self._now() - _NEW_STREAM_UNITS
        if at < least:
            return False
        self._streams[stream] = at
        return True

    def _digest(self, data: bytes) -> bytes:
        return sha256(self._key + data).digest()[:_DIGEST]


def signer_from(environment: Mapping[str, str] = os.environ) -> Signer | None:
    """Return a signer with the key that the environment names, None when it names none.

    Raises:
        KeyFileError: The file cannot be used as a key.
    """
    named = environment.get(KEY_FILE_VARIABLE, '')
    return Signer(_read_key(Path(named))) if named else None


def _read_key(path: Path) -> bytes:
    try:
        # A pipe must not keep us waiting.
        descriptor = os.open(path, os.O_RDONLY | os.O_NONBLOCK | os.O_CLOEXEC | os.O_NOCTTY)
    except OSError as err:
        raise KeyFileError(f'{path} cannot be read: {err.strerror or err}') from err
    with os.fdopen(descriptor, 'rb') as stream:
        found = os.fstat(stream.fileno())
        if not stat.S_ISREG(found.st_mode):
            raise KeyFileError(f'{path} is no regular file')
        if found.st_mode & 0o077:
            raise KeyFileError(f'{path} can be read by others: chmod 600 {path}')
        key = stream.read(KEY_BYTES + 1)
    if len(key) != KEY_BYTES:
        raise KeyFileError(f'{path} does not hold {KEY_BYTES} bytes')
    return key
