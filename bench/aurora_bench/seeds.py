# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Seeds of runs as options of the measurements."""

from __future__ import annotations

import argparse

from aurora_core.spec.seed import typed_seed


def seed_option(text: str) -> int:
    """Return the seed of a run that was typed; for `argparse`.

    Raises:
        argparse.ArgumentTypeError: It is none that a run can have; says which are.
    """
    try:
        return typed_seed(text)
    except ValueError as err:
        raise argparse.ArgumentTypeError(str(err)) from err


def seeds_option(text: str) -> tuple[int, ...]:
    """Return the seeds of a comma-separated list, each once, in its order; for `argparse`.

    Raises:
        argparse.ArgumentTypeError: One of them is none that a run can have.
    """
    return tuple(dict.fromkeys(seed_option(part.strip()) for part in text.split(',')))
