# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""A recording survives a kill up to its last flush, and says when the disk is full."""

from __future__ import annotations

import errno
import os
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from aurora_core.errors import BagError
from aurora_core.trace import messages
from aurora_core.trace.bag_reader import read_bag, read_stored
from aurora_core.trace.bag_writer import BagWriter
from aurora_core.trace.definitions import message_definitions
from aurora_core.trace.messages import MessageBuilder
from aurora_core.trace.messages_world import world_message
from aurora_core.trace.trace import Integrity, Trace


def test_after_a_kill_everything_up_to_the_last_flush_is_there(
    tmp_path: Path,
    make_trace: Callable[..., Trace],
    make_world: Callable[..., Any],
    record: Callable[..., Any],
) -> None:
    trace = make_trace(ticks=55)
    writer = record(tmp_path / 'bag.0', trace, make_world(), close=False)
    # The file as a kill would leave it: what the writer still holds in memory is lost.
    found = read_bag(tmp_path / 'bag.0', message_definitions()).trace
    assert found.integrity is Integrity.TRUNCATED
    # Flushed with the first message of tick 1 (t = 0.05 s), then every half second.
    assert found.ticks == 51
    assert np.array_equal(found.uav, trace.uav[:51])
    assert found.ground_commands == trace.ground_commands[:51]
    writer.flush()
    assert read_bag(tmp_path / 'bag.0', message_definitions()).trace.ticks == 55
    writer.close()
    found = read_bag(tmp_path / 'bag.0', message_definitions()).trace
    assert found.integrity is Integrity.INTACT


def test_an_existing_folder_is_never_overwritten(
    tmp_path: Path,
    make_trace: Callable[..., Trace],
    make_world: Callable[..., Any],
    record: Callable[..., Any],
) -> None:
    record(tmp_path / 'bag.0', make_trace(ticks=10), make_world())
    before = sorted((p.name, p.read_bytes()) for p in (tmp_path / 'bag.0').iterdir())
    with pytest.raises(BagError, match='cannot create the bag'):
        BagWriter(tmp_path / 'bag.0', message_definitions())
    assert sorted((p.name, p.read_bytes()) for p in (tmp_path / 'bag.0').iterdir()) == before


def test_a_folder_that_cannot_be_made(tmp_path: Path) -> None:
    (tmp_path / 'file').write_text('')
    with pytest.raises(BagError, match='cannot create the bag'):
        BagWriter(tmp_path / 'file' / 'bag.0', message_definitions())


def test_a_full_disk_is_an_error_and_the_bag_stays_readable(
    tmp_path: Path,
    make_trace: Callable[..., Trace],
    make_world: Callable[..., Any],
    full_disk: Callable[..., Any],
) -> None:
    definitions = message_definitions()
    trace = make_trace(ticks=2000, agents=10)
    build = MessageBuilder(definitions, 1, 0.05)
    folder = tmp_path / 'bag.0'
    world = world_message(definitions, build.header(0), 'r', make_world())
    stored = [
        (messages.ROSTER, 0, build.roster('r', trace.roster)),
        (messages.WORLD, 0, world),
    ]
    stored += [
        (messages.GROUND_STATE, k, build.state(messages.GROUND_STATE, k, trace.ground[k]))
        for k in range(trace.ticks)
    ]
    writer = BagWriter(folder, definitions)

    def store_all() -> None:
        with writer:
            for topic, tick, message in stored:
                type_name = messages.TOPICS[topic]
                cdr = definitions.encode(type_name, message)
                writer.write(topic, type_name, cdr, tick * 50_000_000)

    with full_disk(60_000), pytest.raises(BagError, match='cannot write the bag') as caught:
        store_all()
    assert 'space' in caught.value.hint
    assert writer.closed
    found = read_bag(folder, definitions).trace
    assert found.integrity is Integrity.TRUNCATED
    assert found.ticks >= 20
    assert np.array_equal(found.ground, trace.ground[: found.ticks])
    with pytest.raises(BagError, match='closed'):
        writer.write(messages.GROUND_STATE, 'aurora_msgs/msg/GroundState', b'', 0)


def test_a_disk_that_is_full_at_the_end_leaves_no_metadata(
    tmp_path: Path,
    make_trace: Callable[..., Trace],
    make_world: Callable[..., Any],
    record: Callable[..., Any],
    full_disk: Callable[..., Any],
) -> None:
    writer = record(tmp_path / 'bag.0', make_trace(ticks=19), make_world(), close=False)
    with full_disk(1000), pytest.raises(BagError, match='cannot write the bag'):
        writer.close()
    assert not (tmp_path / 'bag.0' / 'metadata.yaml').exists()
    with pytest.raises(BagError, match='is closed'):
        writer.close()


def test_closing_twice_is_refused(tmp_path: Path) -> None:
    writer = BagWriter(tmp_path / 'bag.0', message_definitions())
    assert not writer.closed
    writer.close()
    with pytest.raises(BagError, match='is closed'):
        writer.close()


def test_leaving_the_block_closes_the_bag_also_after_an_error(tmp_path: Path) -> None:
    with (
        pytest.raises(RuntimeError, match='simulator'),
        BagWriter(tmp_path / 'bag.0', message_definitions()),
    ):
        raise RuntimeError('simulator')
    assert (tmp_path / 'bag.0' / 'metadata.yaml').is_file()


def test_a_phase_is_out_with_the_next_tick(
    tmp_path: Path, make_trace: Callable[..., Trace], make_world: Callable[..., Any]
) -> None:
    definitions = message_definitions()
    trace = make_trace(ticks=9)
    build = MessageBuilder(definitions, 1, 0.05)
    with BagWriter(tmp_path / 'bag.0', definitions) as writer:

        def put(topic: str, tick: int, message: Any) -> None:
            type_name = messages.TOPICS[topic]
            writer.write(topic, type_name, definitions.encode(type_name, message), tick * 10**8)

        put(messages.ROSTER, 0, build.roster('r', trace.roster))
        put(messages.WORLD, 0, world_message(definitions, build.header(0), 'r', make_world()))
        for k in range(4):
            put(messages.GROUND_STATE, k, build.state(messages.GROUND_STATE, k, trace.ground[k]))
        assert _stored(tmp_path) == 2  # the first message after t = 0 took what was there along
        put(messages.EVENTS, 3, build.event(replace(trace.events[1], tick=3)))
        put(messages.GROUND_STATE, 4, build.state(messages.GROUND_STATE, 4, trace.ground[4]))
        assert _stored(tmp_path) == 2  # a fault is no phase
        put(messages.EVENTS, 4, build.event(replace(trace.events[0], tick=4)))
        assert _stored(tmp_path) == 2
        put(messages.GROUND_STATE, 5, build.state(messages.GROUND_STATE, 5, trace.ground[5]))
        assert _stored(tmp_path) == 6


def _stored(folder: Path) -> int:
    """Return how many ground states have left the process."""
    stored = read_stored(folder / 'bag.0', message_definitions()).messages
    return sum(message.topic == messages.GROUND_STATE for message in stored)


def test_a_disk_that_fails_later_is_an_error_too(
    tmp_path: Path,
    make_trace: Callable[..., Trace],
    make_world: Callable[..., Any],
    record: Callable[..., Any],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    writer = record(tmp_path / 'bag.0', make_trace(ticks=10), make_world(), close=False)

    def full(_descriptor: int) -> None:
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

    monkeypatch.setattr('os.fsync', full)
    with pytest.raises(BagError, match='No space left on device') as caught:
        writer.close()
    assert 'free some space' in caught.value.hint
    assert caught.value.component == 'recorder'
    assert sorted(path.name for path in (tmp_path / 'bag.0').iterdir()) == ['bag.0_0.mcap']
