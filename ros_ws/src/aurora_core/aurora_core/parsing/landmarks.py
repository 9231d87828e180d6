# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Names of landmarks as the words that a prompt may call them by."""

from __future__ import annotations


def landmark_words(name: str) -> tuple[str, ...]:
    """Return a landmark name as lower-case words."""
    return tuple(name.lower().replace('_', ' ').replace('-', ' ').split())


def landmark_phrases(names: tuple[str, ...]) -> dict[tuple[str, ...], str]:
    """Full names, and their last word where only one landmark has it (`the tower`)."""
    full = {landmark_words(name): name for name in names if landmark_words(name)}
    by_last: dict[str, list[str]] = {}
    for words, name in full.items():
        by_last.setdefault(words[-1], []).append(name)
    short = {
        (last,): found[0] for last, found in by_last.items() if len(found) == 1 and len(last) > 2
    }
    return short | full
