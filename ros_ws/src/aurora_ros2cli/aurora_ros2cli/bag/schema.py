# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The text of a message type with all types inside it, as MCAP keeps it (`ros2msg`)."""

from __future__ import annotations

from aurora_ros2cli.interface.show import definition_path, nested_type

_SEPARATOR = '=' * 80


def schema_text(type_name: str) -> str:
    """Return the definition of a message type and of every type that it uses.

    Args:
        type_name: `package/msg/Name`.

    Raises:
        CliError: If a definition is not installed.
    """
    texts: dict[str, str] = {}
    waiting = [type_name]
    while waiting:
        name = waiting.pop(0)
        if name in texts:
            continue
        texts[name] = definition_path(name).read_text(encoding='utf-8').rstrip('\n') + '\n'
        package = name.partition('/')[0]
        for line in texts[name].splitlines():
            inside = nested_type(line.partition('#')[0], package)
            if inside is not None:
                waiting.append(inside)
    first, *others = texts.items()
    return first[1] + ''.join(
        f'{_SEPARATOR}\nMSG: {name.replace("/msg/", "/")}\n{text}' for name, text in others
    )
