# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""How often Python looks for reference cycles, of which a run makes few."""

from __future__ import annotations

import gc
from collections.abc import Iterator
from contextlib import contextmanager

# Between two looks for reference cycles.
_NEW_VALUES = 50_000


def relax_collector() -> None:
    """Let Python look for reference cycles more rarely.

    A command makes many values that stay (words, map, routes) and few cycles; by default every
    700 new values set off a look, and the larger looks visit everything that stays.
    """
    gc.set_threshold(_NEW_VALUES, *gc.get_threshold()[1:])


@contextmanager
def no_collection() -> Iterator[None]:
    """Keep Python from looking for reference cycles: a tick makes none.

    What it makes is kept for the trace, which sets the collector off again and again, and each of
    its full passes visits the whole knowledge base (70 ms).
    """
    enabled = gc.isenabled()
    gc.disable()
    try:
        yield
    finally:
        if enabled:
            gc.enable()
