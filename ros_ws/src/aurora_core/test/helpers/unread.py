# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What the offline reader leaves unread of a prompt."""

from __future__ import annotations

from aurora_core.outcomes.parse import ParseContext
from aurora_core.parsing.parser import parse_offline
from aurora_core.spec.vocabulary import ClauseStatus


def unread(prompt: str, *landmarks: str) -> list[str]:
    """Return the words of a prompt that are admitted as not encoded, on a map with landmarks."""
    outcome = parse_offline(prompt, ParseContext(landmark_names=landmarks))
    return [c.text for c in outcome.clauses if c.status is ClauseStatus.NOT_ENCODED]
