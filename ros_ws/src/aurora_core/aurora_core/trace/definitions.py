# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Message definitions: the .msg files of `aurora_msgs` are the only source of every layout.

The local engine writes and the monitor reads the same messages as the ROS graph without importing
ROS: the definitions are parsed from the .msg texts.
"""

from __future__ import annotations

import os
from enum import IntEnum
from functools import lru_cache
from importlib.metadata import version
from pathlib import Path
from typing import Any

from aurora_core.compiled import Compiled
from aurora_core.errors import ConfigError

PACKAGE = 'aurora_msgs'

# What our messages are made of, and what is recorded beside them.
_STANDARD = (
    'builtin_interfaces/msg/Time',
    'rosgraph_msgs/msg/Clock',
    'std_msgs/msg/Header',
    'std_msgs/msg/String',
)


class MessageDefinitions:
    """Types of `aurora_msgs` and the standard ones beside them, with CDR encoding both ways.

    Args:
        folder: Folder that holds the .msg files.
    """

    def __init__(self, folder: Path) -> None:
        # Imported here: many who name this type read or write no bag.
        from rosbags.typesys import Stores, get_typestore

        self._store = get_typestore(Stores.EMPTY)
        self._store.register(compiled_definitions(folder).value())

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


def compiled_definitions(folder: Path) -> Compiled:
    """Return the fields of all messages of a folder, as set-up compiles them."""
    return Compiled(
        name='message_definitions',
        sources=(Path(__file__), *_files(folder)),
        key=version('rosbags'),
        make=lambda: _parsed(folder),
    )


def _files(folder: Path) -> list[Path]:
    return sorted(folder.glob('*.msg'))


def _parsed(folder: Path) -> dict[str, Any]:
    from rosbags.typesys import Stores, get_types_from_msg, get_typestore

    standard = get_typestore(Stores.ROS2_JAZZY).fielddefs
    found: dict[str, Any] = {name: standard[name] for name in _STANDARD}
    for path in _files(folder):
        name = f'{PACKAGE}/msg/{path.stem}'
        found |= get_types_from_msg(path.read_text(encoding='utf-8'), name)
    return {name: _plain(fields) for name, fields in found.items()}


def _plain(value: Any) -> Any:
    """Return tuples and lists with numbers in the place of members of an enum."""
    if isinstance(value, tuple | list):
        return type(value)(_plain(part) for part in value)
    return int(value) if isinstance(value, IntEnum) else value


@lru_cache(maxsize=1)
def message_definitions() -> MessageDefinitions:
    """Return the definitions of the installed `aurora_msgs`, else of the source checkout.

    Raises:
        ConfigError: They are nowhere.
    """
    return MessageDefinitions(definitions_folder())


def definitions_folder() -> Path:
    """Return the folder of the installed .msg files, else that of the source checkout.

    Raises:
        ConfigError: They are nowhere.
    """
    for prefix in os.environ.get('AMENT_PREFIX_PATH', '').split(os.pathsep):
        folder = Path(prefix) / 'share' / PACKAGE / 'msg'
        if prefix and folder.is_dir():
            return folder
    for parent in Path(__file__).resolve().parents:
        folder = parent / PACKAGE / 'msg'
        if folder.is_dir():
            return folder
    raise ConfigError(
        'the message definitions of aurora_msgs are not found',
        hint='run make setup, then source ros_ws/setup.bash',
    )
