# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What is tried: for each kind of input a function of bytes that raises what must not be raised.

An input is refused by an error of ours that says so; that is no finding. The same functions replay
the inputs that are kept in `corpus/`, without any fuzzer, as a test.
"""

from __future__ import annotations

import contextlib
import json
import struct
import tempfile
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from types import MappingProxyType
from typing import Any

from pymavlink.dialects.v20 import common as mavlink

from aurora_bench.fuzz.campaign import typed
from aurora_bench.guided.small_bag import SmallBag
from aurora_bench.prompts.reading import read_prompts
from aurora_bench.prompts.shipped import first_files
from aurora_cli.installed import installed
from aurora_cli.map_import.frame import frame_about
from aurora_cli.map_import.osm_buildings import buildings
from aurora_cli.map_import.osm_data import read_osm
from aurora_cli.map_import.osm_places import areas, bus_stops, landmarks
from aurora_cli.map_import.osm_shapes import OsmShapes
from aurora_cli.map_import.source import SourceKind, take_in
from aurora_cli.testing.small_maps import LAT, LON, small_city, xodr
from aurora_core.agsg.build import build_agsg
from aurora_core.errors import AuroraError
from aurora_core.knowledge.reach import Reach
from aurora_core.parsing.data_files import read_data
from aurora_core.parsing.llm.check import judge
from aurora_core.parsing.llm.facts import PromptFacts
from aurora_core.parsing.parser import parse_offline
from aurora_core.pipeline.functions import check_stage, parse_context
from aurora_core.planning.complete import complete
from aurora_core.report.run_documents import Unreadable, read_document
from aurora_core.spec.scenario import ScenarioSpec
from aurora_core.trace.bag_reader import read_bag
from aurora_core.trace.definitions import message_definitions
from aurora_uav_sim import wire
from aurora_uav_sim.mavlink_server import SimServer

Attempt = Callable[[bytes], None]
# Of one UAV; more is said by more inputs.
_DATAGRAMS, _DATAGRAM_BYTES = 24, 280
_MAP = 'junction'


@dataclass(frozen=True, slots=True, kw_only=True)
class Target:
    """A kind of input.

    Attributes:
        name: For people and folders.
        most_bytes: Of one input.
        make: Returns what tries an input, given an empty folder for files.
        seeds: Yields inputs to begin with.
        words: What inputs of this kind are made of.
    """

    name: str
    most_bytes: int
    make: Callable[[Path], Attempt]
    seeds: Callable[[], Iterator[bytes]]
    words: Callable[[], Iterator[str]] = lambda: iter(())


def _prompts(_: Path) -> Attempt:
    context = parse_context(installed(), 'downtown', 1)

    def attempt(data: bytes) -> None:
        text = data.decode('utf-8', 'ignore')
        with contextlib.suppress(AuroraError):
            outcome = parse_offline(text, context)
            for clause in outcome.clauses:
                assert text[clause.span.start : clause.span.end] == clause.text, clause
            if outcome.spec is not None:
                complete(outcome.spec, installed().limits)

    return attempt


def _shipped() -> Iterator[bytes]:
    texts = [p.prompt for path in first_files('tune') for p in read_prompts(path)]
    yield from (text.encode() for text in texts[::7])


def _lexicon() -> Iterator[str]:
    def strings(node: Any) -> Iterator[str]:
        if isinstance(node, str):
            yield node
        for inner in node.values() if isinstance(node, dict) else node:
            if not isinstance(node, str):
                yield from strings(inner)

    yield from (word for word in strings(read_data('lexicon.yaml')) if 1 < len(word) < 30)


def _specifications(folder: Path) -> Attempt:
    known, path = installed(), folder / 'spec.0.json'

    def attempt(data: bytes) -> None:
        path.write_bytes(data)
        spec = read_document(path, ScenarioSpec)
        if isinstance(spec, Unreadable):
            assert path.name in spec.why
            return
        with contextlib.suppress(AuroraError):
            check_stage(known, build_agsg(complete(spec, known.limits)))

    return attempt


def _written() -> Iterator[bytes]:
    known = installed()
    context = parse_context(known, 'downtown', 1)
    for data in list(_shipped())[:24]:
        spec = parse_offline(data.decode(), context).spec
        if spec is not None:
            yield spec.model_dump_json(exclude_defaults=True).encode()


def _field_names() -> Iterator[str]:
    schema = ScenarioSpec.model_json_schema()

    def names(node: Any) -> Iterator[str]:
        if isinstance(node, dict):
            yield from node.get('properties', ())
            yield from (word for word in node.get('enum', ()) if isinstance(word, str))
        for inner in node.values() if isinstance(node, dict) else node:
            if isinstance(inner, dict | list):
                yield from names(inner)

    yield from (f'"{name}"' for name in dict.fromkeys(names(schema)))


def _bags(folder: Path) -> Attempt:
    small, path = SmallBag.recorded(folder), folder / 'tried.mcap'
    definitions = message_definitions()

    def attempt(data: bytes) -> None:
        path.write_bytes(small.changed(data))
        with contextlib.suppress(AuroraError):
            read_bag(path, definitions)

    return attempt


def _edits() -> Iterator[bytes]:
    for whole in (0, 1):
        for place in (0, 9, 40, 200, 1000, 5000):
            for value in (0, 1, 0x7F800000, 0xFFFFFFFF):
                yield struct.pack('<BBHIB', whole, place % 13, place % 11, place * 4, 4) + (
                    struct.pack('<I', value)
                )


def _frames(_: Path) -> Attempt:
    numbers = tuple(mavlink.mavlink_map)

    def attempt(data: bytes) -> None:
        server = SimServer()
        at = sequence = 0
        while at + 6 <= len(data) and sequence < _DATAGRAMS:
            how, sender, message, length = struct.unpack_from('<BBHB', data, at)
            payload = data[at + 5 : at + 5 + length]
            at += 5 + length
            # Most with a checksum that is right: otherwise nothing behind it is reached.
            frame = payload
            if how % 8:
                number = numbers[message % len(numbers)]
                frame = wire.pack(sequence, sender or 1, how, number, payload or b'\0')
            server.handle(frame[:_DATAGRAM_BYTES], sender % 3)
            if how % 5 == 0:
                server.poll(0.1 * sequence)
            sequence += 1

    return attempt


def _datagrams() -> Iterator[bytes]:
    numbers = tuple(mavlink.mavlink_map)
    for first in range(0, len(numbers), 6):
        yield b''.join(
            struct.pack('<BBHB', 191, 1, k, 33) + bytes([1, 1, *range(31)])
            for k in range(first, min(first + 6, len(numbers)))
        )
    for command in (16, 20, 21, 22, 176, 192, 400, 410, 511, 512, 520, 31000, 31010):
        long = struct.pack('<7fHBBB', 1, 0, 0, 0, 0, 0, 40, command, 1, 1, 0)
        yield struct.pack('<BBHB', 191, 1, numbers.index(76), len(long)) + long


def _maps(folder: Path) -> Attempt:
    network = installed().map(_MAP).network
    reach, stops = Reach(network), Reach(network, 'bus')
    frame, given = frame_about(LAT, LON), folder / 'tried.osm'
    extent = network.street_surface.buffer(500.0).envelope

    def attempt(data: bytes) -> None:
        given.write_bytes(data)
        with contextlib.suppress(AuroraError), tempfile.TemporaryDirectory(dir=folder) as scratch:
            source = take_in(given, Path(scratch))
            if source.kind not in (SourceKind.OSM, SourceKind.OSM_PBF):
                return
            shapes = OsmShapes(read_osm(source), frame)
            buildings(shapes, network.street_surface, extent)
            areas(shapes, extent)
            landmarks(shapes, reach, extent)
            bus_stops(shapes, stops)

    return attempt


def _extracts() -> Iterator[bytes]:
    text = small_city()
    yield text.encode()
    head, _, body = text.partition('<osm version="0.6">')
    lines = body.splitlines()
    for first in range(0, len(lines), 12):
        part = '\n'.join(line for line in lines[first : first + 12] if '</osm>' not in line)
        yield f'{head}<osm version="0.6">{part}</osm>'.encode()
    yield xodr(walkways=True).encode()


def _tags() -> Iterator[str]:
    yield from (
        '<node id="1" lat="60.17" lon="24.94">', '<way id="2">', '<relation id="3">', '</way>',
        '<nd ref="1"/>', '<member type="way" ref="2" role="outer"/>', 'k="height" v="',
        '<tag k="building" v="yes"/>', 'k="building:levels" v="', 'k="min_height" v="',
        'k="name" v="', 'k="layer" v="', 'highway', 'multipolygon', 'bus_stop', 'leisure',
        'amenity', 'lat="', 'lon="', 'visible="false"', '&#0;', '&lt;', '<!DOCTYPE', '1e999',
        'nan', '-0', ' ft', "12'3\"",
    )  # fmt: skip


def _replies(_: Path) -> Attempt:
    context = parse_context(installed(), 'downtown', 1)
    known = tuple(PromptFacts(row['prompt'], context) for row in _examples())

    def attempt(data: bytes) -> None:
        if not data:
            return
        facts = known[data[0] % len(known)]
        text = data[1:].decode('utf-8', 'replace')
        judgement = judge(text, facts)
        assert judgement.outcome is not None or judgement.complaints, 'refused without a reason'

    return attempt


def _examples() -> list[dict[str, Any]]:
    rows: list[dict[str, Any]] = read_data('llm/examples.yaml')['examples']
    return rows


def _answers() -> Iterator[bytes]:
    for k, row in enumerate(_examples()):
        yield bytes([k]) + json.dumps(typed(row['answer'])).encode()


def _answer_words() -> Iterator[str]:
    text = json.dumps(typed([row['answer'] for row in _examples()]))
    yield from dict.fromkeys(word for word in text.split('"') if 1 < len(word) < 30)


TARGETS: Mapping[str, Target] = MappingProxyType(
    {
        target.name: target
        for target in (
            Target(
                name='prompt', most_bytes=400, make=_prompts, seeds=_shipped, words=_lexicon
            ),
            Target(
                name='specification', most_bytes=6000, make=_specifications, seeds=_written,
                words=_field_names,
            ),
            Target(name='bag', most_bytes=600, make=_bags, seeds=_edits),
            Target(name='mavlink', most_bytes=1500, make=_frames, seeds=_datagrams),
            Target(name='map', most_bytes=6000, make=_maps, seeds=_extracts, words=_tags),
            Target(
                name='reply', most_bytes=5000, make=_replies, seeds=_answers, words=_answer_words
            ),
        )
    }
)  # fmt: skip
