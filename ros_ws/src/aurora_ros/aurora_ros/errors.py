# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`AuroraError` across the wire: `error_code` and `error_msg` of a response and back.

`error_msg` is `component: message`, with the hint on a second line when there is one.
"""

from __future__ import annotations

import re
from typing import Any

from aurora_core.errors import AuroraError, error_class

_PREFIX = re.compile(r'([a-z][a-z0-9_]*): (.*)', re.DOTALL)


def error_text(err: AuroraError) -> str:
    """Return what travels as `error_msg`."""
    text = f'{err.component}: {err.message}'
    return f'{text}\n{err.hint}' if err.hint else text


def write_error(message: Any, err: AuroraError) -> None:
    """Fill `error_code` and `error_msg` of a response, result or message."""
    message.error_code = err.code
    message.error_msg = error_text(err)


def read_error(message: Any, server: str) -> AuroraError | None:
    """Return the error that a response, result or message carries, None when it carries none.

    Args:
        message: Anything with `error_code` and `error_msg`.
        server: Node that sent it: the component when the text names none.
    """
    if message.error_code == 0:
        return None
    text, _, hint = str(message.error_msg).partition('\n')
    match = _PREFIX.fullmatch(text)
    component, words = (match[1], match[2]) if match else (server, text)
    kind = error_class(int(message.error_code))
    return kind(words, hint=hint, component=component, code=int(message.error_code))


def raise_error(message: Any, server: str) -> None:
    """Raise what `read_error` finds.

    Raises:
        AuroraError: The response carries an error; its class is the one of its code.
    """
    err = read_error(message, server)
    if err is not None:
        raise err
