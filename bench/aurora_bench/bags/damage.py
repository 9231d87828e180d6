# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Every way in which a bag is damaged: each yields a name and leaves a folder to be judged."""

from __future__ import annotations

import random
import shutil
import struct
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path

from aurora_bench.bags.forge import Change, mcap_of, rewrite, stamp
from aurora_core.trace import messages
from aurora_core.trace.bag_metadata import METADATA
from aurora_core.trace.definitions import MessageDefinitions

_HUGE = 0xFFFFFFFF


@dataclass(frozen=True, slots=True, kw_only=True)
class Case:
    """One damaged bag.

    Attributes:
        kind: Family it is counted in.
        name: What was done.
        path: What to judge.
        integrity: What it has to be called, '' when anything but intact will do.
    """

    kind: str
    name: str
    path: Path
    integrity: str = ''


class Damager:
    """Damages copies of one intact bag.

    Args:
        bag: Folder of the intact bag.
        work: Folder for the copies; each case takes the place of the one before.
        definitions: Layouts of the messages.
        seed: Of the places.
    """

    def __init__(self, bag: Path, work: Path, definitions: MessageDefinitions, seed: int) -> None:
        self._bag = bag
        self._work = work
        self._definitions = definitions
        self._random = random.Random(seed)
        self._whole = mcap_of(bag).read_bytes()

    def truncations(self, count: int) -> Iterator[Case]:
        """The file ends too early."""
        for _ in range(count):
            offset = self._random.randrange(len(self._whole))
            folder = self._copy()
            mcap_of(folder).write_bytes(self._whole[:offset])
            yield Case(
                kind='truncated', name=f'at byte {offset}', path=folder, integrity='truncated'
            )

    def flips(self, count: int) -> Iterator[Case]:
        """One bit of the file is another."""
        for _ in range(count):
            offset, bit = self._random.randrange(len(self._whole)), self._random.randrange(8)
            data = bytearray(self._whole)
            data[offset] ^= 1 << bit
            folder = self._copy()
            mcap_of(folder).write_bytes(data)
            yield Case(kind='bit flipped', name=f'byte {offset} bit {bit}', path=folder)

    def flips_without_metadata(self, count: int) -> Iterator[Case]:
        """One bit of the file is another, and no digest tells."""
        for case in self.flips(count):
            (case.path / METADATA).unlink()
            yield Case(kind='bit flipped, no metadata.yaml', name=case.name, path=case.path)

    def one_message_altered(self, count: int) -> Iterator[Case]:
        """One state or command is another, encoded anew, every checksum in order."""
        topics = (messages.GROUND_STATE, messages.UAV_STATE, messages.UAV_COMMAND)
        for k in range(count):
            topic = topics[k % len(topics)]
            number = self._random.randrange(100, 1000)
            for stamped in (False, True):
                folder = self._rewritten(self._altered(topic, number))
                if stamped:
                    stamp(folder)
                name = f'{topic} message {number}' + (', digest stamped anew' if stamped else '')
                yield Case(kind='one message altered', name=name, path=folder, integrity='altered')

    def others(self) -> Iterator[Case]:
        """Everything else that is not a recording of ours any more."""
        folder = self._copy()
        (folder / METADATA).unlink()
        yield Case(kind='other', name='without metadata.yaml', path=folder, integrity='unknown')
        for name, data in (
            ('empty file', b''),
            ('text file', b'Not a bag, but a text.\n' * 20),
            ('zeroes', bytes(100_000)),
            ('random bytes', self._random.randbytes(100_000)),
            (
                'last third zero',
                self._whole[: 2 * len(self._whole) // 3].ljust(len(self._whole), b'\0'),
            ),
            ('chunk that claims 2^40 bytes', self._bomb()),
        ):
            folder = self._copy()
            mcap_of(folder).write_bytes(data)
            yield Case(kind='other', name=name, path=folder)
        yield self._inflated()
        for name, change in self._changes():
            folder = self._rewritten(change)
            stamp(folder)
            yield Case(kind='other', name=name, path=folder)
        yield from self._schemas()

    def _changes(self) -> Iterator[tuple[str, Change]]:
        states = messages.GROUND_STATE
        for topic in (messages.ROSTER, messages.WORLD, messages.UAV_STATE, messages.EVENTS):
            yield (
                f'no message on {topic}',
                lambda t, _k, data, topic=topic: () if t == topic else (data,),  # type: ignore[misc]
            )
        yield 'a tick twice', lambda t, k, data: (data,) * (1 + (t == states and k == 40))
        held: list[bytes] = []

        def swapped(topic: str, number: int, data: bytes) -> tuple[bytes, ...]:
            if topic != states or number not in (50, 51):
                return (data,)
            held.append(data)
            return () if number == 50 else (held[-1], held[-2])

        yield 'two ticks swapped', swapped
        for name, value in (('NaN', float('nan')), ('1e300', 1e300), ('infinity', float('inf'))):
            yield f'{name} in a state', self._altered(messages.UAV_STATE, 60, value)
        yield 'an array of 2^32 numbers', self._lying_length(states, 70)

    def _schemas(self) -> Iterator[Case]:
        other = b'uint64 tick\nfloat64[] data\n'
        bomb = b'string[4294967295] data\n'
        name_of = messages.TOPICS[messages.UAV_STATE]
        replaced: tuple[tuple[str, Callable[[str, str, bytes], tuple[str, str, bytes]]], ...] = (
            ('foreign schema', lambda n, e, d: (n, e, other if n == name_of else d)),
            ('foreign type', lambda n, e, d: ('std_msgs/msg/String' if n == name_of else n, e, d)),
            ('foreign encoding of a schema', lambda n, e, d: (n, 'protobuf', d)),
            ('schema that cannot be read', lambda n, e, d: (n, e, b'\xff\xfe' + d[:50])),
            ('schema with an array of 2^32 texts', lambda n, e, d: (n, e, bomb)),
        )
        for name, redefine in replaced:
            folder = self._copy()
            rewrite(mcap_of(self._bag), mcap_of(folder), redefine=redefine)
            stamp(folder)
            yield Case(kind='other', name=name, path=folder)

    def _altered(self, topic: str, number: int, value: float | None = None) -> Change:
        type_name = messages.TOPICS[topic]

        def change(found: str, k: int, data: bytes) -> tuple[bytes, ...]:
            if (found, k) != (topic, number):
                return (data,)
            message = self._definitions.decode(type_name, data)
            numbers = message.data.copy()
            numbers[0] = numbers[0] + 0.001 if value is None else value
            fields = {name: getattr(message, name) for name in message.__dataclass_fields__}
            fields.pop('__msgtype__', None)
            fields['data'] = numbers
            anew = self._definitions.create(type_name, **fields)
            return (self._definitions.encode(type_name, anew),)

        return change

    def _lying_length(self, topic: str, number: int) -> Change:
        """The array states a length of 2^32 - 1."""

        def change(found: str, k: int, data: bytes) -> tuple[bytes, ...]:
            if (found, k) != (topic, number):
                return (data,)
            message = self._definitions.decode(messages.TOPICS[topic], data)
            at = data.rindex(struct.pack('<I', len(message.data)))
            return (data[:at] + struct.pack('<I', _HUGE) + data[at + 4 :],)

        return change

    def _inflated(self) -> Case:
        """Small on the disk, half a gigabyte in memory for who unpacks all of it at once."""
        piece = bytes(1 << 20)

        def change(topic: str, number: int, data: bytes) -> tuple[bytes, ...]:
            if topic == messages.EVENTS and number == 0:
                return (data, *(piece,) * 512)
            return (data,)

        folder = self._rewritten(change)
        stamp(folder)
        return Case(kind='other', name='512 messages of 1 MiB of zeroes', path=folder)

    def _bomb(self) -> bytes:
        """The second chunk claims to hold a terabyte."""
        first = self._whole.index(b'\x04\x00\x00\x00zstd')
        second = self._whole.index(b'\x04\x00\x00\x00zstd', first + 8)
        at = second - 12  # before it: uncompressed size, checksum
        return self._whole[:at] + struct.pack('<Q', 1 << 40) + self._whole[at + 8 :]

    def _copy(self) -> Path:
        folder = self._work / self._bag.name
        shutil.rmtree(folder, ignore_errors=True)
        shutil.copytree(self._bag, folder)
        return folder

    def _rewritten(self, change: Change) -> Path:
        folder = self._copy()
        rewrite(mcap_of(self._bag), mcap_of(folder), change)
        return folder
