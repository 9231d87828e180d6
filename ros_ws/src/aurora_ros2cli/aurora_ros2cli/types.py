# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Message, service and action classes by their ROS names."""

from __future__ import annotations

import importlib
from typing import Any

from aurora_ros2cli.errors import CliError

_WORDS = {'msg': 'message', 'srv': 'service', 'action': 'action'}


def load_type(name: str, kind: str) -> Any:
    """Import a generated class.

    Args:
        name: `package/kind/Name`, or `package/Name`.
        kind: `msg`, `srv` or `action`.

    Raises:
        CliError: If the name is malformed, of another kind, or nothing is found.
    """
    parts = name.split('/')
    if len(parts) == 2:
        parts.insert(1, kind)
    failure = f'The passed {_WORDS[kind]} type is invalid'
    if len(parts) != 3 or parts[1] != kind or not all(part.isidentifier() for part in parts):
        raise CliError(failure)
    try:
        return getattr(importlib.import_module(f'{parts[0]}.{kind}'), parts[2])
    except (ModuleNotFoundError, AttributeError) as err:
        raise CliError(failure) from err
