# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The order in which a bag is published again, on bytes made without ROS; and the command line."""

from __future__ import annotations

import struct
import sys
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest

pytest.importorskip('rclpy')

from aurora_core.errors import BagError
from aurora_core.trace import messages
from aurora_core.trace.bag_reader import StoredBag, StoredMessage
from aurora_core.trace.trace import Integrity
from aurora_nodes.replay import main
from aurora_nodes.replay_plan import ReplayPlan, plan_replay

RUN = 11
HEADER = b'\x00\x01\x00\x00' + struct.pack('<iII4s', 0, 0, 4, b'map\x00')


def at(topic: str, tick: int, run_number: int = RUN) -> StoredMessage:
    cdr = HEADER + struct.pack('<QQ', run_number, tick)
    return StoredMessage(topic=topic, cdr=cdr, value=None)


def by_id(topic: str, run_id: str = 'r1') -> StoredMessage:
    text = run_id.encode() + b'\x00'
    cdr = HEADER + struct.pack('<I', len(text)) + text
    return StoredMessage(topic=topic, cdr=cdr, value=None)


DOCUMENTS = tuple(by_id(topic) for topic in (messages.AGSG, messages.ROSTER, messages.WORLD))
# As a recorder writes them: topic by topic.
TICKS = (
    *(at(messages.GROUND_STATE, tick) for tick in range(3)),
    *(at(messages.GROUND_COMMAND, tick) for tick in range(1, 4)),
    at(messages.EVENTS, 2),
)


def plan(stored: tuple[StoredMessage, ...], ticks: int = 3) -> ReplayPlan:
    content: Any = SimpleNamespace(
        trace=SimpleNamespace(ticks=ticks, roster=SimpleNamespace(dt_s=0.05)),
        agsg_message=SimpleNamespace(iteration=2),
    )
    damage = ((Integrity.TRUNCATED, 'it breaks off'),)
    return plan_replay(StoredBag(folder=Path('bag.0'), messages=stored, damage=damage), content)


def test_tick_by_tick_commands_before_states_before_claims() -> None:
    made = plan((*TICKS, *DOCUMENTS))
    assert made.documents == DOCUMENTS
    assert [[m.topic for m in group] for group in made.ticks] == [
        [messages.GROUND_STATE],
        [messages.GROUND_COMMAND, messages.GROUND_STATE],
        [messages.GROUND_COMMAND, messages.GROUND_STATE, messages.EVENTS],
        [messages.GROUND_COMMAND],
    ]
    assert (made.run_number, made.run_id, made.iteration, made.last_tick) == (RUN, 'r1', 2, 2)
    assert made.damage == ((Integrity.TRUNCATED, 'it breaks off'),)
    assert dict(made.counts) == {
        **dict.fromkeys((messages.AGSG, messages.ROSTER, messages.WORLD), 1),
        messages.GROUND_STATE: 3,
        messages.GROUND_COMMAND: 3,
        messages.EVENTS: 1,
    }


def test_another_run_in_the_bag_is_left_out_and_named() -> None:
    made = plan((*DOCUMENTS, *TICKS, at(messages.EVENTS, 1, RUN + 1), by_id(messages.WORLD, 'r2')))
    assert made.damage[-1] == (Integrity.ALTERED, '2 messages belong to another run')
    assert made.counts[messages.EVENTS] == 1
    assert messages.WORLD not in made.counts


def test_a_damaged_tick_number_comes_last_and_holds_nothing_up() -> None:
    made = plan((*DOCUMENTS, *TICKS, at(messages.GROUND_STATE, 2**60)))
    assert len(made.ticks) == 4
    assert made.ticks[-1][-1].topic == messages.GROUND_STATE


def test_a_bag_without_a_tick_cannot_be_replayed() -> None:
    with pytest.raises(BagError, match=r'bag\.0 holds no tick'):
        plan(DOCUMENTS, ticks=0)


@pytest.mark.parametrize(
    ('arguments', 'said'),
    [
        ([], 'the following arguments are required: BAG'),
        (['nowhere'], 'nowhere is neither a run folder'),
        (['.', '--rate', '0'], '--rate must be above 0, found 0.0'),
        (['.', '--rate', 'nan'], '--rate must be above 0, found nan'),
        (['.', '--speed', '2'], 'unrecognized arguments'),
        (['.'], 'holds no bag'),
    ],
)
def test_a_wrong_command_line_is_one_message_and_64(
    arguments: list[str],
    said: str,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
    tmp_path: Path,
) -> None:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(
        sys, 'argv', ['replay', *arguments, '--ros-args', '-p', 'discovery_s:=2.0']
    )
    with pytest.raises(SystemExit) as caught:
        main()
    assert caught.value.code == 64
    output = capsys.readouterr()
    assert said in output.err
    assert not output.out
