# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Which pattern a flight along a route has: named, or meant by how it is told."""

from __future__ import annotations

from aurora_core.parsing.adjuncts import AdjunctKind
from aurora_core.parsing.atoms import AtomKind
from aurora_core.parsing.constructions.pattern_values import text_of_adjunct
from aurora_core.parsing.frames import Frame
from aurora_core.spec.vocabulary import MissionMode, Pattern, Place

# Prepositions of where a flight leads.
WAYPOINT_PREPS = ('to', 'through', 'via')
_BOTH_WAYS = frozenset(
    {'back and forth', 'to and fro', 'there and back', 'up and down', 'out and back'}
)


def flown_pattern(frame: Frame, mode: MissionMode | None, target: str | None) -> Pattern | None:
    """Return the pattern of a flight, None for one that has none."""
    told = _told_pattern(frame, target)
    if told is not None:
        return told
    if frame.verb is not None and frame.key == 'navigate' and mode is MissionMode.NAVIGATE:
        word = frame.scene.prompt[frame.verb.start : frame.verb.end].lower()
        if word.startswith('mow'):
            return Pattern.LAWNMOWER
    if frame.key == 'orbit':
        return Pattern.ORBIT
    if mode is not MissionMode.NAVIGATE:
        return None
    if frame.attribute('waypoint') is not None or frame.key == 'visit':
        return Pattern.WAYPOINTS
    if frame.attribute('radius', 'diameter') is not None:
        return Pattern.ORBIT  # `a circuit with a radius of 40 m`
    phrases = [a.key for a in frame.adjuncts if a.kind is AdjunctKind.PHRASE and a.used]
    if (
        'around' in phrases
        and not frame.has_mark(AtomKind.ROUTE.value)
        and frame.key != 'navigate'
    ):
        return Pattern.ORBIT
    if 'along' in phrases or target == Place.MAIN_ROAD:
        return Pattern.LINE
    if frame.key in ('fly', 'drive', '') and any(p in WAYPOINT_PREPS for p in phrases):
        return Pattern.WAYPOINTS
    return Pattern.RECTANGLE


def _told_pattern(frame: Frame, target: str | None) -> Pattern | None:
    """Return the pattern that is named; `back and forth` is how a line is flown as well."""
    marks = frame.free(AdjunctKind.MARK, AtomKind.PATTERN.value)
    vague = [m for m in marks if text_of_adjunct(frame, m) in _BOTH_WAYS]
    clear = [m for m in marks if m not in vague]
    if not marks:
        return None
    chosen = (clear or vague)[0]
    for mark in marks:
        mark.used = mark in vague or mark.value == chosen.value
    along = any(a.key == 'along' for a in frame.adjuncts if a.kind is AdjunctKind.PHRASE)
    if not clear and (along or target == Place.MAIN_ROAD):
        return Pattern.LINE
    return Pattern(chosen.value)
