# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The prompt files that are shipped; the folder says who may look (docs/bench/prompts.md)."""

from __future__ import annotations

from importlib.resources import files
from pathlib import Path
from typing import Literal

Split = Literal['tune', 'held_out']

# AURORA-Bench (120 and 80), what goes beyond it, and what of the first 300 is in neither.
FIRST = ('bench', 'multi_uav', 'more')
# Written later by others, to tune on.
SECOND = 'second'
# Later still, by four others: one family of meanings each; a quarter of it only to measure.
THIRD = 'third'
# By four more, who wrote as four kinds of users; whole to tune on.
FOURTH = 'fourth'


def prompt_file(split: Split, part: str) -> Path:
    """Return the path of a shipped prompt file."""
    return Path(str(files('aurora_bench.prompts').joinpath('data', split, f'{part}.jsonl')))


def first_files(split: Split) -> tuple[Path, ...]:
    """Return the files of the first 200 prompts to tune on, or of the 100 only to measure."""
    return tuple(prompt_file(split, part) for part in FIRST)


def tune_files() -> tuple[Path, ...]:
    """Return all files to tune on, by name."""
    folder = Path(str(files('aurora_bench.prompts').joinpath('data', 'tune')))
    return tuple(sorted(folder.glob('*.jsonl')))
