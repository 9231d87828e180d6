# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What is packed in one go has the bytes that the .msg definitions give."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from rosbags.serde import SerdeError

from aurora_core.errors import BagError
from aurora_core.trace import messages
from aurora_core.trace.commands import GroundCommand
from aurora_core.trace.definitions import MessageDefinitions, message_definitions
from aurora_core.trace.layout import GroundCommandKind
from aurora_core.trace.messages import TOPICS, MessageBuilder
from aurora_core.trace.tick_encoding import TickDecoder, TickEncoder

DT_S = 0.05


@pytest.mark.parametrize('shape', [(0, 7), (1, 7), (3, 16)])
@pytest.mark.parametrize('tick', [0, 19, 20, 123457])
@pytest.mark.parametrize(
    'topic', [messages.GROUND_STATE, messages.UAV_STATE, messages.UAV_COMMAND]
)
def test_rows(topic: str, tick: int, shape: tuple[int, int]) -> None:
    definitions = message_definitions()
    rows = np.random.default_rng(3).normal(size=shape)
    expected = definitions.encode(
        TOPICS[topic], MessageBuilder(definitions, 9, DT_S).state(topic, tick, rows)
    )
    assert TickEncoder(definitions, 9, DT_S).rows(topic, tick, rows) == expected
    turned = np.asfortranarray(rows)
    assert TickEncoder(definitions, 9, DT_S).rows(topic, tick, turned) == expected


def test_every_message_of_one_encoder_has_the_stamp_of_its_tick() -> None:
    definitions = message_definitions()
    encoder, build = TickEncoder(definitions, 9, DT_S), MessageBuilder(definitions, 9, DT_S)
    rows = np.ones((2, 7))
    for tick in (0, 0, 1, 20, 1, 123457):
        state = definitions.encode(
            TOPICS[messages.GROUND_STATE], build.state(messages.GROUND_STATE, tick, rows)
        )
        command = definitions.encode(
            TOPICS[messages.GROUND_COMMAND], build.ground_commands(tick + 1, ())
        )
        assert encoder.rows(messages.GROUND_STATE, tick, rows) == state
        assert encoder.ground_commands(tick + 1, ()) == command


@pytest.mark.parametrize('shape', [(0, 7), (1, 7), (3, 16)])
@pytest.mark.parametrize(
    'topic', [messages.GROUND_STATE, messages.UAV_STATE, messages.UAV_COMMAND]
)
def test_rows_are_read_as_field_by_field(topic: str, shape: tuple[int, int]) -> None:
    definitions = message_definitions()
    rows = np.random.default_rng(3).normal(size=shape)
    cdr = TickEncoder(definitions, 9, DT_S).rows(topic, 19, rows)
    cut, longer = cdr[:-8], cdr + bytes(8)
    other_frame = cdr.replace(b'map\0', b'odo\0')
    for data in (cdr, other_frame, cut, longer):
        found = _decoded(TickDecoder(definitions), TOPICS[topic], data)
        assert found == _decoded(definitions, TOPICS[topic], data)


def _decoded(
    decoder: TickDecoder | MessageDefinitions, name: str, cdr: bytes
) -> tuple[Any, ...] | str:
    try:
        value = decoder.decode(name, cdr)
    except SerdeError as err:
        return str(err)
    return value.header, value.run_number, value.tick, value.data.tolist(), value.data.dtype


@pytest.mark.parametrize(
    'commands',
    [
        (),
        (
            GroundCommand(agent=2, kind=GroundCommandKind.SET_SPEED, value=7.5),
            GroundCommand(agent=0, kind=GroundCommandKind.SET_ROUTE, text='a b'),
        ),
    ],
)
def test_ground_commands(commands: tuple[GroundCommand, ...]) -> None:
    definitions = message_definitions()
    message = MessageBuilder(definitions, 9, DT_S).ground_commands(41, commands)
    expected = definitions.encode(TOPICS[messages.GROUND_COMMAND], message)
    assert TickEncoder(definitions, 9, DT_S).ground_commands(41, commands) == expected
    name = TOPICS[messages.GROUND_COMMAND]
    assert str(TickDecoder(definitions).decode(name, expected)) == str(message)


def test_a_changed_msg_file_is_noticed_before_anything_is_written() -> None:
    class Changed(MessageDefinitions):
        def __init__(self) -> None:
            self._inner = message_definitions()

        def create(self, type_name: str, **fields: Any) -> Any:
            return self._inner.create(type_name, **fields)

        def encode(self, type_name: str, message: Any) -> bytes:
            return self._inner.encode(type_name, message) + b'\0'

    with pytest.raises(BagError, match=r'GroundState\.msg has another layout'):
        TickEncoder(Changed(), 1, DT_S)
