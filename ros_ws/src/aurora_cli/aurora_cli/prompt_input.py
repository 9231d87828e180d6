# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The bytes of a prompt: an argument, standard input or a file."""

from __future__ import annotations

import os
import sys
from pathlib import Path

from aurora_cli.output import UsageProblem

# More than any prompt may have; the rest of an endless stream is not read.
_MOST_BYTES = 1 << 20


def prompt_bytes(argument: str | None, file: Path | None) -> bytes:
    """Return the bytes of the prompt as they were given.

    The end of the last line of a file or of standard input belongs to the editor or the shell,
    not to the prompt: the same text has the same digest whichever way it comes.

    Args:
        argument: PROMPT, or `-` for standard input.
        file: `--prompt-file`.

    Raises:
        UsageProblem: None or both are given, or the file cannot be read.
    """
    if (argument is None) is (file is None):
        raise UsageProblem('give one prompt: PROMPT, - (standard input) or --prompt-file FILE')
    if file is not None:
        try:
            with file.open('rb') as stream:
                return _without_end(stream.read(_MOST_BYTES))
        except OSError as err:
            raise UsageProblem(f'{file} cannot be read: {err.strerror or err}') from err
    if argument == '-':
        return _without_end(sys.stdin.buffer.read(_MOST_BYTES))
    return os.fsencode(argument or '')


def _without_end(data: bytes) -> bytes:
    return data.removesuffix(b'\n').removesuffix(b'\r')
