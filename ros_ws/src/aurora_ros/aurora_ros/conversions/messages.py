# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""ROS messages from the same builders that fill the local engine's bag (`aurora_core.trace`).

Core builds message values through `create(type name, fields)`; here that makes rclpy messages, so
there is one mapping from values to fields. Reading back is `aurora_core.trace.messages` as well.
"""

from __future__ import annotations

from array import array
from functools import lru_cache
from importlib import import_module
from typing import Any, cast

import numpy as np
from pydantic import ValidationError

from aurora_core.agsg.message import agsg_message as core_agsg_message
from aurora_core.agsg.message import read_agsg
from aurora_core.errors import SpecError
from aurora_core.knowledge.world import WorldModel
from aurora_core.outcomes.agsg import Agsg
from aurora_core.trace.definitions import MessageDefinitions
from aurora_core.trace.messages import MessageBuilder
from aurora_core.trace.messages_world import world_message as core_world_message
from aurora_msgs.msg import Agsg as AgsgMessage
from aurora_msgs.msg import World
from aurora_ros.conversions.time import header


class RosMessages:
    """Stands in for `MessageDefinitions` where messages are created."""

    def create(self, type_name: str, **fields: Any) -> Any:
        """Return an rclpy message; numpy arrays become arrays of the same C type."""
        for name, value in fields.items():
            if isinstance(value, np.ndarray):
                fields[name] = array(value.dtype.char, value.tobytes())
        return message_class(type_name)(**fields)


@lru_cache(maxsize=64)
def message_class(type_name: str) -> Any:
    """Return the class of a type such as `aurora_msgs/msg/Tick`."""
    package, _, name = type_name.split('/')
    return getattr(import_module(f'{package}.msg'), name)


def message_builder(run_number: int, dt_s: float) -> MessageBuilder:
    """Return a builder of rclpy messages of one run."""
    return MessageBuilder(_ros_definitions(), run_number, dt_s)


def world_message(builder: MessageBuilder, world: WorldModel, run_id: str) -> World:
    """Return the message that makes a bag self-contained."""
    return core_world_message(_ros_definitions(), builder.header(0), run_id, world)


def agsg_message(agsg: Agsg, run_id: str) -> AgsgMessage:
    """Return the message of a scenario graph."""
    return core_agsg_message(RosMessages().create, header(0, 1.0), run_id, agsg)


def agsg(message: AgsgMessage) -> Agsg:
    """Return the scenario graph of a message.

    Raises:
        SpecError: A document is not valid, or the typed fields or the digest do not match.
    """
    try:
        return read_agsg(message)
    except (ValidationError, IndexError, ValueError) as err:
        raise SpecError(f'scenario graph of run {message.run_id!r} is not valid: {err}') from err


def _ros_definitions() -> MessageDefinitions:
    # Only `create` of it is used on the way out.
    return cast(MessageDefinitions, RosMessages())
