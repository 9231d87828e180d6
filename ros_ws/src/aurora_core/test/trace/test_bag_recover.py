# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What a cut recording holds comes back in a bag that others read; it never counts as intact."""

from __future__ import annotations

import shutil
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from mcap.reader import make_reader
from rosbags.highlevel import AnyReader

from aurora_core.errors import BagError
from aurora_core.trace import messages
from aurora_core.trace.bag_metadata import METADATA
from aurora_core.trace.bag_reader import read_bag
from aurora_core.trace.bag_recover import Outcome, Recovery, recover_bag
from aurora_core.trace.definitions import message_definitions
from aurora_core.trace.trace import Integrity, Trace

FILE = 'bag.0_0.mcap'
TICKS = 65


@pytest.fixture
def trace(make_trace: Callable[..., Trace]) -> Trace:
    return make_trace(ticks=TICKS)


@pytest.fixture
def bag(
    tmp_path: Path, trace: Trace, make_world: Callable[..., Any], record: Callable[..., Any]
) -> Path:
    folder = tmp_path / 'run' / 'bag.0'
    record(folder, trace, make_world())
    return folder


def _recover(bag: Path, out: Path | None = None) -> Recovery:
    before = _bytes(bag)
    done = recover_bag(bag, out, message_definitions())
    assert _bytes(bag) == before, 'the original is never touched'
    return done


def _bytes(folder: Path) -> dict[str, bytes]:
    return {path.name: path.read_bytes() for path in folder.iterdir()}


def _cut(bag: Path, share: float) -> None:
    whole = (bag / FILE).read_bytes()
    (bag / FILE).write_bytes(whole[: int(len(whole) * share)])
    (bag / METADATA).unlink()


def test_a_cut_recording_is_complete_up_to_its_last_flush(bag: Path, trace: Trace) -> None:
    _cut(bag, 0.6)
    done = _recover(bag)
    folder = bag.parent / 'bag.0.recovered'
    assert (done.outcome, done.bag) == (Outcome.RECOVERED, str(folder))
    assert done.integrity is Integrity.TRUNCATED
    assert 10 <= done.last_complete_tick < TICKS - 1
    assert done.complete_s == pytest.approx(done.last_complete_tick * 0.05)
    assert done.lost is None, 'nobody can tell'
    assert any('breaks off' in note for note in done.damage)
    found = read_bag(folder, message_definitions()).trace
    upto = done.last_complete_tick + 1
    assert found.integrity is Integrity.TRUNCATED
    assert 'recovered from a damaged bag' in found.integrity_note
    assert np.array_equal(found.uav[:upto], trace.uav[:upto])
    assert found.ground_commands[:upto] == trace.ground_commands[:upto]


def test_others_read_what_was_recovered(bag: Path) -> None:
    _cut(bag, 0.7)
    done = _recover(bag)
    with AnyReader([Path(done.bag)]) as reader:
        assert reader.message_count == sum(done.kept.values())
        for connection, _, raw in reader.messages():
            reader.deserialize(raw, connection.msgtype)
    with (Path(done.bag) / 'bag.0.recovered_0.mcap').open('rb') as stream:
        summary = make_reader(stream, validate_crcs=True).get_summary()
        assert summary is not None
        assert summary.statistics is not None
        assert summary.statistics.message_count == sum(done.kept.values())


def test_recovering_again_changes_nothing(bag: Path, tmp_path: Path) -> None:
    _cut(bag, 0.8)
    first = _recover(bag)
    before = _bytes(Path(first.bag))
    second = _recover(bag)
    assert second.outcome is Outcome.ALREADY
    assert _bytes(Path(first.bag)) == before
    assert (second.kept, second.last_complete_tick) == (first.kept, first.last_complete_tick)
    elsewhere = _recover(bag, tmp_path / 'bag.0.recovered')
    assert _bytes(Path(elsewhere.bag)) == before, 'the same damage gives the same bytes'
    third = _recover(Path(first.bag))
    assert third.outcome is Outcome.READABLE
    assert third.integrity is Integrity.TRUNCATED


def test_an_intact_bag_needs_no_recovery(bag: Path) -> None:
    done = _recover(bag)
    assert (done.outcome, done.integrity) == (Outcome.READABLE, Integrity.INTACT)
    assert (done.last_complete_tick, done.lost, done.damage) == (TICKS - 1, 0, ())
    assert [path.name for path in bag.parent.iterdir()] == ['bag.0']


def test_a_whole_recording_without_metadata_gets_one_and_stays_unknown(bag: Path) -> None:
    (bag / METADATA).unlink()
    done = _recover(bag)
    assert (done.outcome, done.integrity) == (Outcome.RECOVERED, Integrity.UNKNOWN)
    assert (done.last_complete_tick, done.lost) == (TICKS - 1, 0)
    found = read_bag(Path(done.bag), message_definitions()).trace
    assert found.integrity is Integrity.UNKNOWN


def test_a_damaged_chunk_is_left_out_and_counted(bag: Path) -> None:
    data = bytearray((bag / FILE).read_bytes())
    second = data.index(b'\x04\x00\x00\x00zstd', data.index(b'\x04\x00\x00\x00zstd') + 8)
    data[second + 40] ^= 1
    (bag / FILE).write_bytes(data)
    done = _recover(bag)
    assert done.integrity is Integrity.ALTERED
    assert done.lost is not None
    assert done.lost > 10
    assert done.last_complete_tick < 5
    assert done.ticks == TICKS, 'what follows the gap is kept'
    assert read_bag(Path(done.bag), message_definitions()).trace.integrity is Integrity.ALTERED


def test_the_note_of_a_recovery_cannot_be_taken_away_from_its_metadata_alone(bag: Path) -> None:
    _cut(bag, 0.9)
    folder = Path(_recover(bag).bag)
    text = (folder / METADATA).read_text()
    lines = [line for line in text.splitlines() if 'aurora_recovered_from' not in line]
    (folder / METADATA).write_text('\n'.join(lines))
    assert read_bag(folder, message_definitions()).trace.integrity is Integrity.TRUNCATED


def test_what_is_there_already_is_never_overwritten(bag: Path, tmp_path: Path) -> None:
    _cut(bag, 0.5)
    (tmp_path / 'out').mkdir()
    (tmp_path / 'out' / 'mine').write_text('mine')
    with pytest.raises(BagError, match='is there already') as caught:
        _recover(bag, tmp_path / 'out')
    assert '--out' in caught.value.hint
    assert (tmp_path / 'out' / 'mine').read_text() == 'mine'


def test_where_nothing_can_be_judged_nothing_is_written(bag: Path) -> None:
    _cut(bag, 0.01)
    with pytest.raises(BagError, match='nothing can be judged'):
        _recover(bag)
    (bag / 'other.mcap').write_bytes(b'')
    with pytest.raises(BagError, match='2 MCAP files'):
        _recover(bag)
    assert [path.name for path in bag.parent.iterdir()] == ['bag.0']


def test_a_recovery_on_a_full_disk_leaves_nothing_behind(
    bag: Path, tmp_path: Path, full_disk: Callable[..., Any]
) -> None:
    _cut(bag, 0.9)
    with full_disk(3000), pytest.raises(BagError, match='cannot write'):
        _recover(bag, tmp_path / 'new' / 'bag.0')
    assert list((tmp_path / 'new').iterdir()) == []
    shutil.rmtree(tmp_path / 'new')
    assert _recover(bag, tmp_path / 'new' / 'bag.0').outcome is Outcome.RECOVERED


def test_topics_of_others_are_kept(
    tmp_path: Path, trace: Trace, make_world: Callable[..., Any], record: Callable[..., Any]
) -> None:
    writer = record(tmp_path / 'bag.0', trace, make_world(), close=False)
    writer.write('/clock', 'rosgraph_msgs/msg/Clock', b'\x00\x01\x00\x00' + bytes(8), 0)
    writer.flush()
    done = _recover(tmp_path / 'bag.0')
    assert done.kept['/clock'] == 1
    assert done.kept[messages.UAV_STATE] == TICKS
