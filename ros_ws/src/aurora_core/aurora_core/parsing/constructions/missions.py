# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""UAV missions: hover, track, navigate, with ascent and landing around them."""

from __future__ import annotations

from aurora_core.parsing import values
from aurora_core.parsing.adjuncts import Adjunct, AdjunctKind
from aurora_core.parsing.atoms import ACTORS, AtomKind, NounKind
from aurora_core.parsing.constructions.flight_types import FlightValues, state_ranges
from aurora_core.parsing.constructions.flight_values import take_flight_values
from aurora_core.parsing.constructions.flyers import flyers
from aurora_core.parsing.constructions.pattern_values import WAYPOINT_PREPS, flown_pattern
from aurora_core.parsing.constructions.transits import (
    arrive,
    goes_on_there,
    is_transit,
    told_again,
    waits_aloft,
    waits_for,
    watches_from,
)
from aurora_core.parsing.frames import Frame
from aurora_core.parsing.pieces import Link
from aurora_core.parsing.pronouns import anything, ground
from aurora_core.parsing.scene import Entity, MissionDraft
from aurora_core.spec.parameter import Parameter
from aurora_core.spec.scenario import UavAction
from aurora_core.spec.vocabulary import MissionMode, Pattern

FLYING = frozenset(
    {
        'hover',
        'track',
        'observe',
        'navigate',
        'orbit',
        'fly',
        'follow',
        'trail',
        'visit',
        'trace',
        'approach',
        'keep',
        'be',
        'drive',
        'wait',
        'circulate',
        'reach',
        'start',
        'see',
        'put',
        'finish',
        '',
    }
)


_TRACKING = frozenset({'track', 'follow', 'trail', 'approach'})


_CONCURRENT = (Link.WHILE, Link.PARTICIPLE, Link.RELATIVE)


def mission(frame: Frame) -> bool:
    """Read one mission phase, or more about the last one."""
    if frame.negated or frame.key not in FLYING:
        return False
    if frame.key in ('', 'be') and frame.has_mark(AtomKind.LINK.value):
        return False  # `link UAV to RSU`
    flying = flyers(frame)
    if not flying:
        return False
    watching = frame.mark(AtomKind.AERIAL.value) is not None
    does = frame.key == 'trace' and frame.attribute('speed') is not None  # `does 6 m/s`
    if frame.key in ('trace', 'reach', 'finish') and not (_is_route(frame) or watching or does):
        return False
    target, bare_over = _target(frame, flying)
    mode = _mode(frame, target, bare_over)
    if watching and mode is None and target is not None:
        mode = MissionMode.TRACK if _is_actor(frame, target) else MissionMode.HOVER
    if frame.key == 'observe' and target is None and frame.piece.link in _CONCURRENT:
        mode = None  # `hovers there, observing the traffic`
    pattern = flown_pattern(frame, mode, target)
    if pattern is not None:
        mode = MissionMode.NAVIGATE
    found = take_flight_values(frame, mode, pattern, above=watching)
    if target is None:
        target = found.target
        watched = frame.key in ('observe', 'see') and target is not None
        if watched and target is not None and not _is_actor(frame, target):
            mode = MissionMode.HOVER  # `100 ft above the crosswalk it watches it all`
        if mode is None and target is not None and found.altitude is not None:
            mode = _mode(frame, target, 'over')
    if mode is None and target is not None and (found.standoff or found.bearing):
        mode = MissionMode.TRACK if _is_actor(frame, target) else MissionMode.HOVER
    if mode is None and waits_aloft(frame, flying, found):
        mode = MissionMode.HOVER
    if mode is None:
        return _plain_flight(frame, flying, found)
    made = []
    heights, standoffs = _respective(frame, flying, mode)
    for k, uav in enumerate(flying):
        found.altitude = heights[k] if heights else found.altitude
        found.standoff = standoffs[k] if standoffs else found.standoff
        made.append(_one(frame, uav, mode, target, pattern, found))
    frame.scene.became(*made)
    return True


def _from_where(frame: Frame, target: str | None, found: FlightValues) -> str | None:
    """Return where `flies from the station to the park` begins."""
    for adjunct in frame.free(AdjunctKind.PHRASE, 'from'):
        place = next((p for n in adjunct.nouns if (p := frame.resolver.place(n))), None)
        if place is not None and target not in (None, place) and found.waypoint_count is None:
            adjunct.used = True
            return place
    return None


def watching(frame: Frame) -> None:
    """`keeps the bus in view from a standoff of 60 m`: the flight that keeps it so."""
    if not frame.scene.conditions or frame.attribute('standoff', 'away') is None:
        return
    of = frame.scene.conditions[-1].of
    uav = frame.scene.by_id(of[0])
    if uav is None or not uav.is_uav or len(of) != 2 or frame.scene.missions_of(uav):
        return
    mode = MissionMode.TRACK if _is_actor(frame, of[1]) else MissionMode.HOVER
    found = take_flight_values(frame, mode, None)
    if found.anything and not found.ranges:
        frame.scene.became(_one(frame, uav, mode, of[1], None, found))
    else:
        found.release()


def _respective(
    frame: Frame, flying: tuple[Entity, ...], mode: MissionMode
) -> tuple[list[Parameter], list[Parameter]]:
    """`three drones hover at 30, 45 and 60 m respectively`: heights, or standoffs (`from`)."""
    for adjunct in frame.free(AdjunctKind.MARK, 'list'):
        if len(adjunct.measures) != len(flying) or adjunct.prep not in ('at', 'from', '', 'of'):
            continue
        words = frame.scene.prompt[max(0, adjunct.start - 16) : adjunct.end + 8].lower()
        away = adjunct.prep == 'from' or 'away' in words or 'distance' in words
        adjunct.used = True
        name = 'standoff' if away and mode is MissionMode.TRACK else 'altitude'
        told = [values.explicit(name, m) for m in adjunct.measures]
        if name == 'standoff':
            frame.mark('thing', 'standoff')
            return [], told
        return told, []
    return [], []


def _is_actor(frame: Frame, reference: str) -> bool:
    return frame.scene.by_id(reference) is not None


def _is_route(frame: Frame) -> bool:
    return (
        frame.has_mark(AtomKind.PATTERN.value)
        or any(a.key == AtomKind.ROUTE.value and a.value not in _VAGUE for a in frame.adjuncts)
        or frame.attribute('waypoint') is not None
    )


# `does two jobs`: of what kind they are is said elsewhere.
_VAGUE = frozenset({'job', 'phase', 'stage', 'part', 'segment'})


def _target(frame: Frame, flying: tuple[Entity, ...]) -> tuple[str | None, str]:
    """Return what the flight is about and the preposition in front of it."""
    if frame.key == 'wait':
        waits_for(frame)
    candidates = frame.free(AdjunctKind.OBJECT) + frame.free(
        AdjunctKind.PHRASE,
        'over',
        'around',
        'at',
        'of',
        'to',
        'near',
        'on',
        'with',
        'along',
        'from',
        'in',
        'through',
    )
    candidates.sort(key=lambda a: a.key == 'from')  # where to, before where from
    for adjunct in candidates:
        found = _reference(frame, adjunct, flying)
        if found is not None:
            adjunct.used = True
            return found, adjunct.key
    for adjunct in frame.free(
        AdjunctKind.PLACE, 'near', 'beside', 'behind', 'ahead', 'left', 'right'
    ):
        if not adjunct.nouns:
            continue
        found = _reference(frame, adjunct, flying)
        if found is not None:
            if adjunct.measure is None and adjunct.key in ('near', 'beside'):
                adjunct.used = True
            return found, 'over'
    told = frame.passive and frame.piece.link in (Link.MAIN, Link.WHILE)
    patients = frame.patient(ground) if told else ()
    if len(patients) == 1:  # `the bus drives on and is tracked by a drone`
        return patients[0].id, ''
    return None, ''


def _reference(frame: Frame, adjunct: Adjunct, flying: tuple[Entity, ...]) -> str | None:
    chosen: list[str] = []
    for noun in adjunct.nouns:
        place = frame.resolver.place(noun)
        if place is not None:
            frame.scene.clause.places += (place,)
            chosen.append(place)
        elif noun.kind is NounKind.UNKNOWN:
            if frame.key in _TRACKING or (frame.key == 'observe' and not adjunct.key):
                frame.resolver.unknown_actor(noun)
            elif adjunct.key in ('over', 'around', 'at', 'to', 'near') or (
                not adjunct.key and frame.key in ('orbit', 'navigate', 'visit')
            ):
                frame.resolver.unknown_place(noun)
        elif noun.kind in ACTORS:
            pronoun = noun.kind is NounKind.PRONOUN and frame.key in _TRACKING
            seen = frame.objects((noun,), ground if pronoun else anything)
            found = [e for e in seen if e not in flying]
            chosen += [e.id for e in found]
    if len(chosen) > 1:
        frame.flag(adjunct.start, adjunct.end)
        frame.scene.clause.notes.append('a mission has one target; the first one was taken')
    return chosen[0] if chosen else None


def _mode(frame: Frame, target: str | None, prep: str) -> MissionMode | None:
    key = frame.key
    moving = target is not None and _is_actor(frame, target)
    if key == 'hover' or key == 'wait':
        return MissionMode.HOVER
    if key == 'follow' and _is_route(frame) and not moving:
        return MissionMode.NAVIGATE  # `follows the outline of a rectangle`
    if key in _TRACKING:
        return MissionMode.TRACK if moving or target is None else MissionMode.HOVER
    if key in ('observe', 'see'):
        if target is None:
            return MissionMode.TRACK
        return MissionMode.TRACK if moving else MissionMode.HOVER
    if key in ('navigate', 'orbit', 'visit'):
        return MissionMode.NAVIGATE
    if _is_route(frame):
        return MissionMode.NAVIGATE
    if target is None:
        return None
    if prep in ('around', 'along'):
        return MissionMode.NAVIGATE
    if prep in WAYPOINT_PREPS and not moving:
        return MissionMode.NAVIGATE
    if prep in ('over', 'with', 'at', 'to', 'on', 'in', 'near'):
        return MissionMode.TRACK if moving else MissionMode.HOVER
    return None


def _one(
    frame: Frame,
    uav: Entity,
    mode: MissionMode,
    target: str | None,
    pattern: Pattern | None,
    found: FlightValues,
) -> str:
    scene = frame.scene
    known = scene.missions_of(uav)
    again = told_again(frame, known)
    draft = again or (
        known[-1] if known and _continues(frame, known[-1], mode, target, pattern, found) else None
    )
    if draft is None:
        draft = MissionDraft(
            id=scene.new_id('m'),
            uav=uav,
            mode=mode,
            clause=scene.clause_number,
            span=frame.span,
        )
        draft.watching = frame.key in ('observe', 'see')
        draft.altitude = scene.pending_altitude.pop(uav.id, None) or _climbed_to(frame, uav)
        draft.speed = scene.pending_speed.pop(uav.id, None)
        place = scene.pending_place.pop(uav.id, None)
        draft.target = place if mode is MissionMode.HOVER and target is None else None
        scene.missions.append(draft)
    elif draft.on_the_way:
        arrive(draft, mode)
    elif watches_from(frame, draft, mode, target):
        draft.mode, draft.target = mode, target or draft.target
    # `watches the plaza, hovering there`: from where it watches is said after all.
    draft.watching = draft.watching and frame.key not in ('hover', 'wait')
    draft.target = draft.target or target
    if pattern is Pattern.WAYPOINTS:
        draft.start = draft.start or _from_where(frame, draft.target, found)
    draft.on_the_way = draft.start is None and is_transit(frame, draft, pattern, found)
    draft.needs_target = draft.mode is MissionMode.TRACK and draft.target is None
    if draft.pattern is None or (draft.pattern_assumed and pattern is not None):
        draft.pattern = pattern
        draft.pattern_assumed = _is_assumed(frame, pattern)
    if pattern is Pattern.WAYPOINTS and target is not None and found.waypoint_count is None:
        draft.waypoint_count = draft.waypoint_count or values.inferred('waypoint_count', 1)
    found.apply(draft)
    state_ranges(frame, draft, found)
    return draft.id


def _climbed_to(frame: Frame, uav: Entity) -> Parameter | None:
    """`when it brakes the drone climbs to 60 m and hovers there`: the height of what follows."""
    same = [c for c in frame.scene.clauses[:-1] if c.sentence == frame.piece.sentence]
    for event in reversed(frame.scene.events):
        action = event.action
        if any(event.id in c.ids for c in same) and isinstance(action, UavAction):
            return action.altitude_m if action.do == 'ascend' and action.uav == uav.id else None
    return None


def _is_assumed(frame: Frame, pattern: Pattern | None) -> bool:
    return pattern is Pattern.RECTANGLE and not frame.has_mark(AtomKind.PATTERN.value)


def _goes_on_watching(
    frame: Frame, last: MissionDraft, target: str | None, found: FlightValues
) -> bool:
    """`hovers over a truck; it watches the truck for 25 s`: watching is what the phase is for."""
    if frame.key not in ('observe', 'see') or frame.piece.then or found.standoff is not None:
        return False
    if found.bearing is not None or found.clashes(last):
        return False
    same = target is not None and target == last.target
    agent = target is not None and _is_actor(frame, target)
    # From above a place one watches whoever comes; a phase of its own would lose the place.
    place = last.target is not None and not _is_actor(frame, last.target)
    return same or (frame.key == 'see' and last.mode is MissionMode.HOVER and agent and place)


def _continues(
    frame: Frame,
    last: MissionDraft,
    mode: MissionMode,
    target: str | None,
    pattern: Pattern | None,
    found: FlightValues,
) -> bool:
    """Return whether a clause says more about the last phase instead of opening another."""
    if watches_from(frame, last, mode, target) or _goes_on_watching(frame, last, target, found):
        return True
    if goes_on_there(last, mode, target, found) and pattern is not Pattern.WAYPOINTS:
        return True
    if frame.piece.then or last.mode is not mode:
        return False
    if target is not None and last.target is not None and last.target != target:
        return False
    if target is not None and pattern is Pattern.WAYPOINTS and last.waypoint_count is not None:
        return False  # `visits 6 waypoints; it then flies to the park`
    stated = last.pattern is not None and not last.pattern_assumed
    if pattern is not None and stated and last.pattern is not pattern:
        return False
    return not found.clashes(last)


def _plain_flight(frame: Frame, flying: tuple[Entity, ...], found: FlightValues) -> bool:
    """`flies at 30 m`, `keeping 35 m away`: values for the phase before, else for the next one."""
    if not found.anything:
        named = bool(frame.subject_nouns) and frame.key in ('', 'be', 'fly', 'start')
        if named:
            frame.scene.became(*(u.id for u in flying))
        return named
    scene = frame.scene
    for uav in flying:
        known = scene.missions_of(uav)
        attach = known and not frame.piece.then and not found.clashes(known[-1])
        if attach:
            found.apply(known[-1])
            state_ranges(frame, known[-1], found)
            scene.became(known[-1].id)
        elif (
            found.only_pending
            and not found.ranges
            and not (known and frame.piece.link in _CONCURRENT)
        ):
            if found.altitude is not None:
                scene.pending_altitude[uav.id] = found.altitude
            if found.speed is not None:
                scene.pending_speed[uav.id] = found.speed
            scene.became(uav.id)
        else:
            found.release()
            return False
    return True
