# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Message definitions: the .msg files of `aurora_msgs` are the only source of every layout.

The local engine writes and the monitor reads the same messages as the ROS graph without importing
ROS: the definitions are parsed from the .msg texts.
"""

from __future__ import annotations

import os
from functools import lru_cache
from pathlib import Path
from typing import Any

from aurora_core.errors import ConfigError

PACKAGE = 'aurora_msgs'


class MessageDefinitions:
    """Types of `aurora_msgs` and of the standard packages, with CDR encoding both ways.

    Args:
        folder: Folder that holds the .msg files.
    """

    def __init__(self, folder: Path) -> None:
        # Imported here: many who name this type read or write no bag.
        from rosbags.typesys import Stores, get_types_from_msg, get_typestore

        self._store = get_typestore(Stores.ROS2_JAZZY)
        for path in sorted(folder.glob('*.msg')):
            name = f'{PACKAGE}/msg/{path.stem}'
            self._store.register(get_types_from_msg(path.read_text(encoding='utf-8'), name))

    def create(self, type_name: str, **fields: Any) -> Any:
        """Return a message value of a type."""
        return self._store.types[type_name](**fields)

    def encode(self, type_name: str, message: Any) -> bytes:
        """Return the CDR encoding of a message value."""
        return bytes(self._store.serialize_cdr(message, type_name))

    def decode(self, type_name: str, cdr: bytes) -> Any:
        """Return the message value of a CDR encoding."""
        return self._store.deserialize_cdr(cdr, type_name)

    def text(self, type_name: str) -> str:
        """Return the full definition with its dependencies (`ros2msg` schema)."""
        return self._store.generate_msgdef(type_name, ros_version=2)[0]

    def type_hash(self, type_name: str) -> str:
        """Return the RIHS01 hash of a type, '' for one that is not ours."""
        return self._store.hash_rihs01(type_name) if type_name in self._store.types else ''


@lru_cache(maxsize=1)
def message_definitions() -> MessageDefinitions:
    """Return the definitions of the installed `aurora_msgs`, else of the source checkout.

    Raises:
        ConfigError: They are nowhere.
    """
    for prefix in os.environ.get('AMENT_PREFIX_PATH', '').split(os.pathsep):
        folder = Path(prefix) / 'share' / PACKAGE / 'msg'
        if prefix and folder.is_dir():
            return MessageDefinitions(folder)
    for parent in Path(__file__).resolve().parents:
        folder = parent / PACKAGE / 'msg'
        if folder.is_dir():
            return MessageDefinitions(folder)
    raise ConfigError(
        'the message definitions of aurora_msgs are not found',
        hint='run make setup, then source ros_ws/setup.bash',
    )
