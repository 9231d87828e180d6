# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Flights to where something happens, and staying there."""

from __future__ import annotations

import re

from aurora_core.parsing.adjuncts import AdjunctKind
from aurora_core.parsing.atoms import ACTORS, AtomKind
from aurora_core.parsing.constructions.flight_types import FlightValues
from aurora_core.parsing.frames import Frame
from aurora_core.parsing.pieces import Link
from aurora_core.parsing.scene import Entity, MissionDraft
from aurora_core.spec.vocabulary import MissionMode, Pattern


def waits_for(frame: Frame) -> None:
    """`it waits for the bus`: whom a UAV waits for is not where it waits."""
    for adjunct in frame.free(AdjunctKind.PHRASE, 'for') + frame.free(AdjunctKind.OBJECT):
        named = [n for n in adjunct.nouns if n.kind in ACTORS]
        if named and len(named) == len(adjunct.nouns):
            adjunct.used = bool(frame.objects(named))


def waits_aloft(frame: Frame, flying: tuple[Entity, ...], found: FlightValues) -> bool:
    """`has to stay in the air for half an hour`: nothing but how long is said."""
    told = found.duration is not None and frame.key in ('fly', 'keep', 'be', '')
    known = [m for uav in flying for m in frame.scene.missions_of(uav)[-1:]]
    if frame.key == 'keep' and frame.verb is not None and known:
        said = frame.scene.prompt[frame.verb.start : frame.verb.end].lower()
        stays = said.startswith(('hold', 'held', 'stay', 'remain'))
        return told and stays and all(m.mode is MissionMode.NAVIGATE for m in known)
    return told and not known


def is_transit(
    frame: Frame, draft: MissionDraft, pattern: Pattern | None, found: FlightValues
) -> bool:
    """`flies to the park`, `heads for the park`: no more than where to, and how high."""
    actor = draft.target is not None and frame.scene.by_id(draft.target) is not None
    if draft.target is None or actor or found.speed is not None:
        return False
    count = draft.waypoint_count
    counted = found.waypoint_count is not None or (count is not None and count.span is not None)
    goes = pattern is Pattern.WAYPOINTS and not counted
    heads = frame.key == 'approach' and draft.mode is MissionMode.HOVER
    return (goes or heads) and draft.duration is None and frame.key != 'visit'


def arrive(draft: MissionDraft, mode: MissionMode) -> None:
    """`flies to the park and hovers there`: one phase, for which the UAV has to get there."""
    draft.mode = mode
    draft.way_at_altitude = draft.altitude is not None  # so it was told of the way
    draft.pattern = None
    draft.waypoint_count = None


def goes_on_there(
    last: MissionDraft, mode: MissionMode, target: str | None, found: FlightValues
) -> bool:
    """Return whether a phase is flown where the UAV has just been sent to."""
    if not last.on_the_way or mode is MissionMode.TRACK or target not in (None, last.target):
        return False
    return last.altitude is None or found.altitude is None


def watches_from(frame: Frame, last: MissionDraft, mode: MissionMode, target: str | None) -> bool:
    """`watched by a drone hovering there`: what it flies, not what it does first."""
    described = frame.piece.link is Link.RELATIVE and not frame.piece.then
    described = described and mode is not MissionMode.TRACK
    watched = frame.scene.by_id(last.target or '')
    if watched is None or target not in (None, watched.id, *_places_of(watched)):
        return False
    told = (last.altitude, last.standoff, last.bearing, last.duration, last.speed)
    bare = last.watching and last.mode is MissionMode.TRACK and not any(told)
    return described and bare and last.clause == frame.scene.clause_number - 1


def _places_of(entity: Entity) -> list[str | None]:
    return [p.of for p in entity.placements] + [b.target for b in entity.behaviors]


def told_again(frame: Frame, known: list[MissionDraft]) -> MissionDraft | None:
    """`on that route its height is 40 m`: the flight that was told before, and no new one."""
    begin = max(0, frame.piece.start - len('during that '))
    opening = frame.scene.prompt[begin : frame.piece.end].lower()[:_OPENING]
    routes = [m for m in known if m.mode is MissionMode.NAVIGATE]
    marked = any(a.key == AtomKind.ROUTE.value for a in frame.adjuncts)
    return routes[-1] if routes and marked and _REFERS.search(opening) else None


_OPENING = 28  # characters in which a clause says what it goes on about
_REFERS = re.compile(r'\b(?:on|in|during|along|for) (?:that|this) ')
