# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The bytes of a prompt: an argument, standard input or a file."""

from __future__ import annotations

import os
import sys
from pathlib import Path
from typing import BinaryIO

from aurora_cli.output import UsageProblem
from aurora_core.files import BAG_BYTES, open_regular
from aurora_core.parsing.text import MAX_PROMPT_BYTES

# Far more than any prompt may have: what is longer is no prompt that somebody wrote, and an
# endless stream is not read to its end. Up to here the run folder keeps every byte.
MOST_BYTES = 4 << 20


def prompt_bytes(argument: str | None, file: Path | None) -> bytes:
    """Return the bytes of the prompt as they were given.

    The end of the last line of a file or of standard input belongs to the editor or the shell,
    not to the prompt: the same text has the same digest whichever way it comes.

    Args:
        argument: PROMPT, or `-` for standard input.
        file: `--prompt-file`.

    Raises:
        UsageProblem: None or both are given, the file cannot be read, or it does not end within
            4 MiB (then nothing of it is kept: a part would be another prompt).
    """
    if (argument is None) is (file is None):
        raise UsageProblem('give one prompt: PROMPT, - (standard input) or --prompt-file FILE')
    if file is not None:
        try:
            with open_regular(file, BAG_BYTES) as stream:  # its own limit is told below
                return _all_of(stream, str(file))
        except OSError as err:
            raise UsageProblem(f'{file} cannot be read: {err.strerror or err}') from err
    if argument == '-':
        return _all_of(sys.stdin.buffer, 'standard input')
    return os.fsencode(argument or '')


def _all_of(stream: BinaryIO, name: str) -> bytes:
    data = stream.read(MOST_BYTES + 1)
    if len(data) > MOST_BYTES:
        raise UsageProblem(
            f'{name} is no prompt: it has more than {MOST_BYTES} bytes, '
            f'and a prompt may have {MAX_PROMPT_BYTES}'
        )
    return _without_end(data)


def _without_end(data: bytes) -> bytes:
    return data.removesuffix(b'\n').removesuffix(b'\r')
