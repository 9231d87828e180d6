# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""A damaged bag is read as far as it goes, never crashes the reader and never counts as intact."""

from __future__ import annotations

import random
import re
import shutil
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import yaml
from mcap.records import Channel, Message, Schema
from mcap.stream_reader import StreamReader
from mcap.writer import Writer

from aurora_core.errors import BagError
from aurora_core.trace import messages
from aurora_core.trace.bag_metadata import file_sha256
from aurora_core.trace.bag_reader import read_bag
from aurora_core.trace.bag_writer import BagWriter
from aurora_core.trace.definitions import message_definitions
from aurora_core.trace.messages import MessageBuilder, time_ns
from aurora_core.trace.messages_world import world_message
from aurora_core.trace.trace import Integrity, Trace

FILE = 'bag.0_0.mcap'


@pytest.fixture
def bag(
    tmp_path: Path,
    make_trace: Callable[..., Trace],
    make_world: Callable[..., Any],
    record: Callable[..., Any],
) -> Path:
    """A bag of 3 s, flushed twice on its way."""
    folder = tmp_path / 'bag.0'
    record(folder, make_trace(ticks=60), make_world())
    return folder


def _integrity(folder: Path) -> Integrity:
    """Read the trace and return its integrity; a bag that cannot be judged counts as damaged."""
    try:
        trace = read_bag(folder, message_definitions()).trace
    except BagError:
        return Integrity.UNKNOWN
    assert trace.ground.shape[0] == trace.uav.shape[0] == len(trace.ground_commands)
    if trace.integrity is not Integrity.INTACT:
        assert trace.integrity_note
    return trace.integrity


def _sign(folder: Path) -> None:
    """Write the digest of the present file into the metadata, as a forger would."""
    path = folder / 'metadata.yaml'
    text = path.read_text(encoding='utf-8')
    digest = file_sha256(folder / FILE)
    path.write_text(re.sub('(aurora_file_sha256: ).*', rf'\g<1>{digest}', text))


@pytest.mark.parametrize('signed', [False, True])
def test_cut_short_anywhere(bag: Path, signed: bool) -> None:
    whole = (bag / FILE).read_bytes()
    offsets = {0, 1, 7, 8, 9, len(whole) - 1, len(whole) - 8, len(whole) - 9}
    offsets |= set(random.Random(1).sample(range(len(whole)), 30))
    for offset in sorted(offsets):
        (bag / FILE).write_bytes(whole[:offset])
        if signed:
            _sign(bag)
        assert _integrity(bag) is not Integrity.INTACT, offset


def test_any_flipped_bit_is_noticed(bag: Path) -> None:
    whole = (bag / FILE).read_bytes()
    generator = random.Random(2)
    # The first bytes and the records' lengths are where a reader is hurt most.
    places = [*range(0, 120, 3), *generator.sample(range(len(whole)), 60)]
    for place in places:
        damaged = bytearray(whole)
        damaged[place] ^= 1 << generator.randrange(8)
        (bag / FILE).write_bytes(damaged)
        assert _integrity(bag) is not Integrity.INTACT, place


def test_flipped_bits_under_a_forged_digest_do_not_crash(bag: Path) -> None:
    whole = (bag / FILE).read_bytes()
    generator = random.Random(3)
    for place in generator.sample(range(len(whole)), 50):
        damaged = bytearray(whole)
        damaged[place] ^= 1 << generator.randrange(8)
        (bag / FILE).write_bytes(damaged)
        _sign(bag)
        _integrity(bag)


def test_damaged_numbers_inside_messages_do_not_crash(
    tmp_path: Path, make_trace: Callable[..., Trace], make_world: Callable[..., Any]
) -> None:
    """Without compression each flipped bit reaches the decoders."""
    definitions = message_definitions()
    trace, world = make_trace(ticks=3), make_world()
    build = MessageBuilder(definitions, 1, 0.05)
    sample: dict[str, Any] = {
        messages.ROSTER: build.roster('r', trace.roster),
        messages.WORLD: world_message(definitions, build.header(0), 'r', world),
        messages.GROUND_STATE: build.state(messages.GROUND_STATE, 0, trace.ground[0]),
        messages.UAV_STATE: build.state(messages.UAV_STATE, 0, trace.uav[0]),
        messages.UAV_COMMAND: build.state(messages.UAV_COMMAND, 1, trace.uav_commands[1]),
        messages.GROUND_COMMAND: build.ground_commands(1, make_trace().ground_commands[3]),
        messages.COMM: build.link(trace.links[0]),
        messages.SENSING: build.sight(trace.sights[0]),
        messages.EVENTS: build.event(trace.events[0]),
    }
    encoded = {t: definitions.encode(messages.TOPICS[t], m) for t, m in sample.items()}
    generator = random.Random(4)
    number = 0
    for damaged_topic in encoded:
        for _ in range(5):
            number += 1
            folder = tmp_path / f'bag.{number}'
            with BagWriter(folder, definitions) as writer:
                for topic, cdr in encoded.items():
                    data = bytearray(cdr)
                    if topic == damaged_topic:
                        data[generator.randrange(len(data))] ^= 1 << generator.randrange(8)
                    writer.write(topic, messages.TOPICS[topic], bytes(data), 0)
            _integrity(folder)


def test_a_changed_checkpoint_is_located(bag: Path) -> None:
    (file,) = bag.glob('*.mcap')
    content = bytearray(file.read_bytes())
    places = [found.end() for found in re.finditer(rb'sha256\x40\0\0\0', bytes(content))]
    content[places[2]] ^= 1  # a hexadecimal digit
    file.write_bytes(bytes(content))
    found = read_bag(bag, message_definitions()).trace
    assert found.integrity is Integrity.ALTERED
    assert found.ticks == 60
    said = re.search(r'a checkpoint between (\S+) s and (\S+) s was changed', found.integrity_note)
    assert said is not None, found.integrity_note
    begin_s, end_s = map(float, said.groups())
    assert 0.0 < begin_s < end_s < 3.0


def test_without_metadata_nobody_can_vouch_for_a_whole_bag(bag: Path) -> None:
    (bag / 'metadata.yaml').unlink()
    content = read_bag(bag, message_definitions())
    assert content.trace.integrity is Integrity.UNKNOWN
    assert 'metadata.yaml is missing' in content.trace.integrity_note
    assert content.trace.ticks == 60  # everything is still there to be judged


@pytest.mark.parametrize(
    'text', ['', '[', 'a: 1', '- 1', 'rosbag2_bagfile_information: 3', '2001-99-99', '\udcff']
)
def test_damaged_metadata(bag: Path, text: str) -> None:
    (bag / 'metadata.yaml').write_bytes(text.encode('utf-8', 'surrogateescape'))
    content = read_bag(bag, message_definitions())
    assert content.trace.integrity is Integrity.ALTERED


def test_changed_world_does_not_match_its_digest(
    tmp_path: Path, make_trace: Callable[..., Trace], make_world: Callable[..., Any]
) -> None:
    definitions = message_definitions()
    build = MessageBuilder(definitions, 1, 0.05)
    trace, world = make_trace(ticks=1, agents=0, uavs=0), make_world()
    message = world_message(definitions, build.header(0), 'r', world)
    message.buildings[0].height_m = 2.0
    with BagWriter(tmp_path / 'bag.0', definitions) as writer:
        for topic, value in (
            (messages.ROSTER, build.roster('r', trace.roster)),
            (messages.WORLD, message),
            (messages.GROUND_STATE, build.state(messages.GROUND_STATE, 0, trace.ground[0])),
        ):
            type_name = messages.TOPICS[topic]
            writer.write(topic, type_name, definitions.encode(type_name, value), 0)
    found = read_bag(tmp_path / 'bag.0', definitions).trace
    assert found.integrity is Integrity.ALTERED
    assert '/aurora/world: it does not match its digest' in found.integrity_note


def _rewritten(
    folder: Path, trace: Trace, world: Any, keep: Callable[[str, int], int]
) -> tuple[Integrity, str, Trace]:
    """Record a trace with each message written `keep(topic, tick)` times."""
    definitions = message_definitions()
    build = MessageBuilder(definitions, 1, 0.05)
    shutil.rmtree(folder, ignore_errors=True)
    with BagWriter(folder, definitions) as writer:

        def put(topic: str, tick: int, message: Any) -> None:
            type_name = messages.TOPICS[topic]
            for _ in range(keep(topic, tick)):
                cdr = definitions.encode(type_name, message)
                writer.write(topic, type_name, cdr, time_ns(tick, 0.05))

        put(messages.ROSTER, 0, build.roster('r', trace.roster))
        put(messages.WORLD, 0, world_message(definitions, build.header(0), 'r', world))
        for k in range(trace.ticks):
            for topic, rows in (
                (messages.GROUND_STATE, trace.ground),
                (messages.UAV_STATE, trace.uav),
                (messages.UAV_COMMAND, trace.uav_commands),
            ):
                put(topic, k, build.state(topic, k, rows[k]))
            put(messages.GROUND_COMMAND, k, build.ground_commands(k, trace.ground_commands[k]))
            for link in (r for r in trace.links if r.tick == k):
                put(messages.COMM, k, build.link(link))
            for event in (r for r in trace.events if r.tick == k):
                put(messages.EVENTS, k, build.event(event))
    found = read_bag(folder, definitions).trace
    return found.integrity, found.integrity_note, found


@pytest.mark.parametrize(
    'topic',
    [
        messages.GROUND_STATE,
        messages.UAV_STATE,
        messages.UAV_COMMAND,
        messages.GROUND_COMMAND,
    ],
)
def test_a_lost_or_repeated_message_of_a_tick_is_noticed(
    topic: str, tmp_path: Path, make_trace: Callable[..., Trace], make_world: Callable[..., Any]
) -> None:
    trace, world = make_trace(ticks=12), make_world()
    folder = tmp_path / 'bag.0'
    intact, note, _ = _rewritten(folder, trace, world, lambda _t, _k: 1)
    assert intact is Integrity.INTACT, note
    lost, note, found = _rewritten(folder, trace, world, lambda t, k: int((t, k) != (topic, 7)))
    assert lost is Integrity.TRUNCATED
    assert found.missing_ticks == (7,)
    if topic == messages.UAV_STATE:
        assert np.isnan(found.uav[7]).all()
        assert not np.isnan(found.uav[8]).any()
    twice, note, _ = _rewritten(folder, trace, world, lambda t, k: 1 + int((t, k) == (topic, 7)))
    assert twice is Integrity.ALTERED
    assert 'twice' in note


@pytest.mark.parametrize('topic', [messages.COMM, messages.EVENTS])
def test_a_lost_claim_is_noticed(
    topic: str, tmp_path: Path, make_trace: Callable[..., Trace], make_world: Callable[..., Any]
) -> None:
    trace, world = make_trace(ticks=12), make_world()
    first = {messages.COMM: 5, messages.EVENTS: 0}[topic]
    integrity, note, _ = _rewritten(
        tmp_path / 'bag.0', trace, world, lambda t, k: int((t, k) != (topic, first))
    )
    assert integrity is Integrity.TRUNCATED
    assert 'missing' in note


def test_rows_of_a_wrong_number_are_not_judged(
    tmp_path: Path, make_trace: Callable[..., Trace], make_world: Callable[..., Any]
) -> None:
    trace, world = make_trace(ticks=3, agents=2), make_world()
    other = replace(make_trace(ticks=3, agents=1).roster)
    trace = replace(trace, roster=other, links=(), events=(), ground_commands=((),) * 3)
    integrity, note, found = _rewritten(tmp_path / 'bag.0', trace, world, lambda _t, _k: 1)
    assert integrity is Integrity.ALTERED
    assert 'wrong number of rows' in note
    assert found.ground.shape == (3, 1, 7)
    assert np.isnan(found.ground).all()


def test_a_tick_number_out_of_reach_is_damage_not_a_long_gap(
    tmp_path: Path, make_trace: Callable[..., Trace], make_world: Callable[..., Any]
) -> None:
    definitions = message_definitions()
    trace, world = make_trace(ticks=3, agents=1, uavs=0), make_world()
    build = MessageBuilder(definitions, 1, 0.05)
    with BagWriter(tmp_path / 'bag.0', definitions) as writer:
        for topic, value in (
            (messages.ROSTER, build.roster('r', trace.roster)),
            (messages.WORLD, world_message(definitions, build.header(0), 'r', world)),
            (messages.GROUND_STATE, build.state(messages.GROUND_STATE, 0, trace.ground[0])),
            (messages.GROUND_STATE, build.state(messages.GROUND_STATE, 10**9, trace.ground[1])),
        ):
            type_name = messages.TOPICS[topic]
            writer.write(topic, type_name, definitions.encode(type_name, value), 0)
    found = read_bag(tmp_path / 'bag.0', definitions).trace
    assert found.integrity is Integrity.ALTERED
    assert found.ticks == 1


def _foreign(folder: Path, source: Path, schema_name: str | None, text: bytes | None) -> None:
    """Copy a bag with the type name or the definition of one topic replaced."""
    folder.mkdir()
    schemas: dict[int, Schema] = {}
    channels: dict[int, Channel] = {}
    ids: dict[int, int] = {}
    with (source / FILE).open('rb') as stream, (folder / FILE).open('wb') as target:
        writer = Writer(target)
        writer.start(profile='ros2', library='other')
        for record in StreamReader(stream).records:
            if isinstance(record, Schema):
                schemas[record.id] = record
            elif isinstance(record, Channel):
                channels[record.id] = record
            elif isinstance(record, Message):
                if record.channel_id not in ids:
                    channel = channels[record.channel_id]
                    schema = schemas[channel.schema_id]
                    hit = channel.topic == messages.UAV_STATE
                    number = writer.register_schema(
                        name=schema_name if hit and schema_name else schema.name,
                        encoding='ros2msg',
                        data=text if hit and text else schema.data,
                    )
                    ids[record.channel_id] = writer.register_channel(channel.topic, 'cdr', number)
                writer.add_message(ids[record.channel_id], record.log_time, record.data, 0)
        writer.finish()  # type: ignore[no-untyped-call]
    shutil.copy(source / 'metadata.yaml', folder)
    path = folder / 'metadata.yaml'
    info = yaml.safe_load(path.read_text(encoding='utf-8'))
    info['rosbag2_bagfile_information']['custom_data'] = {'other': 'thing'}
    path.write_text(yaml.safe_dump(info), encoding='utf-8')


def test_a_foreign_type_on_a_known_topic(bag: Path, tmp_path: Path) -> None:
    _foreign(tmp_path / 'foreign', bag, 'std_msgs/msg/String', None)
    found = read_bag(tmp_path / 'foreign', message_definitions()).trace
    assert found.integrity is Integrity.UNKNOWN
    assert (
        "foreign schema on /aurora/uav/state: its type is 'std_msgs/msg/String', "
        'expected aurora_msgs/msg/UavState' in found.integrity_note
    )


def test_another_layout_of_the_same_type_cannot_be_vouched_for(bag: Path, tmp_path: Path) -> None:
    _foreign(tmp_path / 'foreign', bag, None, b'uint64 tick\nfloat64[] data')
    found = read_bag(tmp_path / 'foreign', message_definitions()).trace
    assert found.integrity is Integrity.UNKNOWN
    assert 'field 1 of aurora_msgs/msg/UavState is uint64 tick, expected' in found.integrity_note
    assert np.isnan(found.uav).all()


def test_foreign_topics_are_left_alone(
    tmp_path: Path,
    make_trace: Callable[..., Trace],
    make_world: Callable[..., Any],
    record: Callable[..., Any],
) -> None:
    writer = record(tmp_path / 'bag.0', make_trace(ticks=10), make_world(), close=False)
    definitions = message_definitions()
    type_name = 'aurora_msgs/msg/Heartbeat'
    writer.write('/aurora/heartbeat', type_name, b'\x00\x01\x00\x00', 0)
    writer.close()
    found = read_bag(tmp_path / 'bag.0', definitions).trace
    assert found.integrity is Integrity.INTACT


def test_no_bag_and_nothing_in_it(tmp_path: Path) -> None:
    with pytest.raises(BagError, match='no MCAP bag'):
        read_bag(tmp_path, message_definitions())
    BagWriter(tmp_path / 'bag.0', message_definitions()).close()
    with pytest.raises(BagError, match='holds no roster') as caught:
        read_bag(tmp_path / 'bag.0', message_definitions())
    assert caught.value.hint == 'run the scenario again'
