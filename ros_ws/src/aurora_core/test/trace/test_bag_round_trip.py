# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What is recorded comes back to the last bit, and other tools can read it."""

from __future__ import annotations

import sys
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import yaml
from rosbags.highlevel import AnyReader

from aurora_core.trace import messages
from aurora_core.trace.bag_metadata import file_sha256
from aurora_core.trace.bag_reader import BagContent, bag_folder, read_bag
from aurora_core.trace.definitions import message_definitions
from aurora_core.trace.hashing import trace_sha256, world_sha256
from aurora_core.trace.messages import time_ns
from aurora_core.trace.trace import Integrity, Trace

EXTREMES = (
    5e-324,
    -sys.float_info.max,
    sys.float_info.min,
    sys.float_info.epsilon,
    -0.0,
    float('nan'),
    float('inf'),
)


def _read(folder: Path) -> BagContent:
    return read_bag(folder, message_definitions())


def _assert_same(found: Trace, expected: Trace) -> None:
    assert found.roster == expected.roster
    assert found.ground.tobytes() == expected.ground.tobytes()
    assert found.uav.tobytes() == expected.uav.tobytes()
    assert found.uav_commands.tobytes() == expected.uav_commands.tobytes()
    assert found.ground.shape == expected.ground.shape
    assert found.uav.shape == expected.uav.shape
    assert found.ground_commands == expected.ground_commands
    assert (found.links, found.sights, found.events) == (
        expected.links,
        expected.sights,
        expected.events,
    )


def test_every_kind_of_record_comes_back(
    tmp_path: Path,
    make_trace: Callable[..., Trace],
    make_world: Callable[..., Any],
    record: Callable[..., Any],
) -> None:
    trace, world = make_trace(), make_world()
    record(tmp_path / 'bag.0', trace, world)
    content = _read(tmp_path / 'bag.0')
    _assert_same(content.trace, trace)
    assert content.trace.integrity is Integrity.INTACT
    assert content.trace.integrity_note == ''
    assert content.trace.missing_ticks == ()
    assert content.agsg_message is None
    assert world_sha256(content.world) == world_sha256(world)
    assert content.world.buildings == world.buildings
    assert content.world.no_fly_zones == world.no_fly_zones
    assert content.world.limits == world.limits
    assert (content.world.places, content.world.signals) == (world.places, world.signals)
    assert content.world.wind == world.wind
    assert content.world.sensing_range_m == 150.0 * 0.8
    for ours, theirs in zip(content.world.surfaces, world.surfaces, strict=True):
        assert ours.kind is theirs.kind
        assert np.array_equal(ours.ring, theirs.ring)
        assert [h.tolist() for h in ours.holes] == [h.tolist() for h in theirs.holes]


def test_extreme_numbers_keep_every_bit(
    tmp_path: Path,
    make_trace: Callable[..., Trace],
    make_world: Callable[..., Any],
    record: Callable[..., Any],
) -> None:
    trace = make_trace(ticks=3)
    trace.ground[1, 0, : len(EXTREMES)] = EXTREMES
    trace.uav[2, 0, : len(EXTREMES)] = EXTREMES
    trace.uav_commands[1, 0, : len(EXTREMES)] = EXTREMES
    trace = replace(
        trace, links=(replace(trace.links[0], tick=1, distance_m=5e-324),), sights=(), events=()
    )
    record(tmp_path / 'bag.0', trace, make_world())
    _assert_same(_read(tmp_path / 'bag.0').trace, trace)


@pytest.mark.parametrize(('agents', 'uavs'), [(0, 0), (0, 2), (3, 0), (1, 1)])
def test_any_number_of_bodies(
    agents: int,
    uavs: int,
    tmp_path: Path,
    make_trace: Callable[..., Trace],
    make_world: Callable[..., Any],
    record: Callable[..., Any],
) -> None:
    trace = make_trace(ticks=12, agents=agents, uavs=uavs)
    record(tmp_path / 'bag.0', trace, make_world())
    found = _read(tmp_path / 'bag.0').trace
    _assert_same(found, trace)
    assert found.ticks == 12
    assert found.integrity is Integrity.INTACT, found.integrity_note


def test_a_world_without_anything_in_it(
    tmp_path: Path,
    make_trace: Callable[..., Trace],
    make_world: Callable[..., Any],
    record: Callable[..., Any],
) -> None:
    world = replace(make_world(()), no_fly_zones=(), surfaces=(), lanes=(), signals=(), places=())
    record(tmp_path / 'bag.0', make_trace(ticks=10), world)
    found = _read(tmp_path / 'bag.0').world
    assert world_sha256(found) == world_sha256(world)
    assert (found.buildings, found.surfaces, found.lanes, found.places) == ((), (), (), ())


@pytest.mark.parametrize('dt_s', [0.05, 0.1, 0.02, 1.0 / 3.0])
def test_time_of_a_tick_has_no_drift(dt_s: float) -> None:
    assert time_ns(0, dt_s) == 0
    assert time_ns(36000, 0.05) == 1_800_000_000_000
    assert abs(time_ns(30000, dt_s) - 30000 * dt_s * 1e9) <= 0.5
    assert all(time_ns(k + 1, dt_s) > time_ns(k, dt_s) for k in range(100))


def test_other_tools_open_the_bag_with_its_own_definitions(
    tmp_path: Path,
    make_trace: Callable[..., Trace],
    make_world: Callable[..., Any],
    record: Callable[..., Any],
) -> None:
    trace, world = make_trace(), make_world()
    summary = record(tmp_path / 'bag.0', trace, world)
    with AnyReader([tmp_path / 'bag.0']) as reader:
        assert reader.message_count == sum(summary.counts.values())
        assert {c.topic: c.msgtype for c in reader.connections}.items() <= messages.TOPICS.items()
        assert reader.topics[messages.UAV_STATE].msgcount == trace.ticks
        stamps = []
        for connection, time, raw in reader.messages(
            [c for c in reader.connections if c.topic == messages.UAV_STATE]
        ):
            message: Any = reader.deserialize(raw, connection.msgtype)
            stamp = message.header.stamp
            assert stamp.sec * 1_000_000_000 + stamp.nanosec == time
            assert message.header.frame_id == 'map'
            stamps.append(time)
            assert np.array_equal(message.data, trace.uav[message.tick].ravel())
        assert stamps == [50_000_000 * k for k in range(trace.ticks)]
        [(connection, _, raw)] = reader.messages(
            [c for c in reader.connections if c.topic == messages.WORLD]
        )
        found: Any = reader.deserialize(raw, connection.msgtype)
        assert found.buildings[0].name == 'Café Überführung 東京 🚁'
        assert found.digest == world_sha256(world)


def test_metadata_says_what_is_in_the_bag(
    tmp_path: Path,
    make_trace: Callable[..., Trace],
    make_world: Callable[..., Any],
    record: Callable[..., Any],
) -> None:
    summary = record(tmp_path / 'bag.0', make_trace(ticks=21), make_world())
    text = (tmp_path / 'bag.0' / 'metadata.yaml').read_text(encoding='utf-8')
    info = yaml.safe_load(text)['rosbag2_bagfile_information']
    assert info['storage_identifier'] == 'mcap'
    assert info['relative_file_paths'] == ['bag.0_0.mcap']
    assert info['starting_time']['nanoseconds_since_epoch'] == 0
    assert info['duration']['nanoseconds'] == 21 * 50_000_000  # with the command for tick 21
    assert info['message_count'] == sum(summary.counts.values())
    counted = {
        t['topic_metadata']['name']: t['message_count'] for t in info['topics_with_message_count']
    }
    assert counted == summary.counts
    assert counted[messages.GROUND_STATE] == 21
    assert all(
        t['topic_metadata']['type_description_hash'].startswith('RIHS01_')
        for t in info['topics_with_message_count']
    )
    durable = {
        t['topic_metadata']['name']: t['topic_metadata']['offered_qos_profiles'][0]['durability']
        for t in info['topics_with_message_count']
    }
    assert durable[messages.WORLD] == 'transient_local'
    assert durable[messages.UAV_STATE] == 'volatile'
    digest = file_sha256(tmp_path / 'bag.0' / 'bag.0_0.mcap')
    assert summary.sha256 == digest == info['custom_data']['aurora_file_sha256']


def test_hash_from_memory_and_from_the_bag_are_one(
    tmp_path: Path,
    make_trace: Callable[..., Trace],
    make_world: Callable[..., Any],
    record: Callable[..., Any],
) -> None:
    trace, world = make_trace(), make_world()
    record(tmp_path / 'a.0', trace, world, run_id='first')
    record(tmp_path / 'b.0', trace, world, run_id='a quite different one')
    one, two = _read(tmp_path / 'a.0'), _read(tmp_path / 'b.0')
    expected = trace_sha256(trace, world)
    assert trace_sha256(one.trace, one.world) == expected
    assert trace_sha256(two.trace, two.world) == expected


def test_a_bag_is_found_by_its_folder_or_by_its_file(
    tmp_path: Path,
    make_trace: Callable[..., Trace],
    make_world: Callable[..., Any],
    record: Callable[..., Any],
) -> None:
    folder = tmp_path / 'bag.0'
    record(folder, make_trace(ticks=10), make_world())
    assert bag_folder(folder) == folder
    assert bag_folder(folder / 'bag.0_0.mcap') == folder
    assert _read(folder / 'metadata.yaml').trace.ticks == 10
