# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Inputs that stay: one file for each kind, each line one input (base64)."""

from __future__ import annotations

import base64
from collections.abc import Iterable
from pathlib import Path

# So few that a test reads all of them in seconds.
MOST_INPUTS, MOST_BYTES = 40, 1500
FOLDER = Path(__file__).resolve().parent / 'corpus'


def kept(name: str) -> list[bytes]:
    """Return the inputs that are kept of a kind."""
    path = FOLDER / f'{name}.txt'
    lines = path.read_text(encoding='ascii').split() if path.exists() else []
    return [base64.b64decode(line) for line in lines]


def keep(name: str, inputs: Iterable[bytes], folder: Path = FOLDER) -> int:
    """Keep the shortest inputs of a kind beside those that are kept; return how many there are.

    Args:
        name: Of the kind.
        inputs: Each reaches what no other does.
        folder: Of the files.
    """
    before = kept(name)
    fresh = {data for data in inputs if len(data) <= MOST_BYTES} - set(before)
    room = max(0, MOST_INPUTS - len(before))
    chosen = sorted(fresh, key=lambda data: (len(data), data))
    # Not only the shortest: of equal shares of the lengths one each.
    step = max(1, len(chosen) // room) if room else 1
    every = [*before, *chosen[::step][:room]]
    folder.mkdir(parents=True, exist_ok=True)
    text = ''.join(f'{base64.b64encode(data).decode()}\n' for data in every)
    (folder / f'{name}.txt').write_text(text, encoding='ascii')
    return len(every)


def keep_found(name: str, data: bytes, folder: Path = FOLDER) -> None:
    """Keep an input that something was found with, whatever its length."""
    before = kept(name)
    if data not in before:
        text = ''.join(f'{base64.b64encode(one).decode()}\n' for one in (*before, data))
        (folder / f'{name}.txt').write_text(text, encoding='ascii')
