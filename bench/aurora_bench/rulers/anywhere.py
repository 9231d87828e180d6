# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Which prompts can be measured on any map: those that name no place of one."""

from __future__ import annotations

from collections.abc import Iterator

from aurora_core.knowledge.map_folders import bundled_maps
from aurora_core.knowledge.map_model import load_map
from aurora_core.spec.reference import LANDMARK


def places_of_maps() -> frozenset[str]:
    """Return the names of landmarks and streets of the bundled maps, in small letters.

    Raises:
        MapError: A map is damaged.
    """
    maps = [load_map(name) for name in bundled_maps()]
    marks = (mark.name for model in maps for mark in model.landmarks)
    streets = (name for model in maps for name in model.network.street_names)
    return frozenset(name.casefold() for name in (*marks, *streets))


def place_names(value: object) -> Iterator[str]:
    """Yield every text in an annotation as a place would be named, in small letters."""
    if isinstance(value, str):
        yield value.removeprefix(LANDMARK).casefold()
    elif isinstance(value, dict):
        for part in value.values():
            yield from place_names(part)
    elif isinstance(value, list):
        for part in value:
            yield from place_names(part)
