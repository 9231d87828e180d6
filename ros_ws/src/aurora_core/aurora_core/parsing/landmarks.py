# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Names of landmarks as the words that a prompt may call them by."""

from __future__ import annotations

from aurora_core.parsing.lexicon import Tag, shipped_lexicon

# Senses that a landmark may take over: `the station` is Union Station where that is the only one.
_YIELDING = frozenset({Tag.LANDMARK_NOUN, Tag.LANDMARK, Tag.SURROUNDINGS})


def landmark_words(name: str) -> tuple[str, ...]:
    """Return a landmark name as lower-case words."""
    return tuple(name.lower().replace('_', ' ').replace('-', ' ').split())


def is_plain_word(words: tuple[str, ...]) -> bool:
    """Tell whether prompts use these words for something else than a place that is named.

    On a map with a restaurant Old Car, `the car` stays a car.
    """
    senses = shipped_lexicon().senses(words)
    return bool(senses) and not any(sense.tag in _YIELDING for sense in senses)


def landmark_phrases(names: tuple[str, ...]) -> dict[tuple[str, ...], str]:
    """Full names, and their last words where only one landmark has them (`the fire station`)."""
    full = {landmark_words(name): name for name in names if landmark_words(name)}
    by_end: dict[tuple[str, ...], list[str]] = {}
    for words, name in full.items():
        for i in range(len(words)):
            by_end.setdefault(words[i:], []).append(name)
    short = {
        end: found[0]
        for end, found in by_end.items()
        if len(found) == 1 and (len(end) > 1 or len(end[0]) > 2) and not is_plain_word(end)
    }
    return short | full
