# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Which UAVs a clause is about."""

from __future__ import annotations

from typing import Literal

from aurora_core.parsing.adjuncts import AdjunctKind
from aurora_core.parsing.atoms import AtomKind, Determiner, NounKind
from aurora_core.parsing.frames import Frame
from aurora_core.parsing.lexicon import shipped_lexicon
from aurora_core.parsing.morphology import VerbForm
from aurora_core.parsing.pronouns import airborne
from aurora_core.parsing.scene import Entity

# Predicates that only a UAV has: without a subject they ask for one.
_AERIAL_ONLY = frozenset({'hover', 'orbit', 'fly', 'navigate', 'ascend', 'descend'})


_WATCHED = ('track', 'observe', 'follow')
# Predicates whose object may be the UAV: `fly a drone`, `hover a quadcopter`.
_LAUNCHED = frozenset(
    {'keep', 'fly', 'ascend', 'be', 'exist', 'put', 'hover', 'orbit', 'land', 'descend'}
)


def flyers(frame: Frame) -> tuple[Entity, ...]:
    """Return the UAVs that act in a clause; a clause that needs one and names none gets one."""
    scene = frame.scene
    nouns = frame.subject_nouns
    if frame.key in _LAUNCHED and (
        not nouns or (nouns[0].kind is NounKind.PRONOUN and nouns[0].key == 'there')
    ):
        launched = next(
            (a for a in frame.free(AdjunctKind.OBJECT) if a.nouns[0].kind is NounKind.UAV), None
        )
        if launched is not None:
            launched.used = True
            frame.subject_nouns = launched.nouns
    _told_to_stay(frame)
    found = frame.subjects(airborne)
    if found:
        return found
    if frame.subject_nouns and not frame.passive:
        return ()
    for adjunct in frame.free(AdjunctKind.PHRASE, 'with', 'using', 'by', 'from'):
        if adjunct.nouns[0].kind is NounKind.UAV:
            adjunct.used = True
            found = frame.resolver.actors(adjunct.nouns, accept=airborne)
            scene.clause.subjects = found
            return found
    if frame.key in ('be', 'keep', 'drive', 'start', 'reach', 'wait', 'put'):
        return ()
    if frame.verb is None and not asks_for_flight(frame):
        return ()
    if frame.passive and frame.key in _WATCHED:
        found = frame.inherited(airborne)
        if len(found) == 1:  # `it hovers there; then a truck is to be tracked`
            scene.clause.subjects = found
            return found
    if frame.inherited():
        return ()
    if len(scene.uavs) == 1:
        scene.clause.subjects = (scene.uavs[0],)
        return (scene.uavs[0],)
    aerial = frame.key in _AERIAL_ONLY or asks_for_flight(frame)
    if not scene.uavs and (aerial or frame.attribute('altitude') is not None):
        found = _named_later(frame) or (new_uav(frame),)
        scene.clause.subjects = found
        return found
    if frame.key in _WATCHED and not scene.uavs:
        return _left_out(frame)
    return ()


def _told_to_stay(frame: Frame) -> None:
    """`put a drone over the square and keep it there for 45 s`: whom one keeps."""
    base = frame.verb is not None and frame.verb.form is VerbForm.BASE
    if frame.key not in ('keep', 'hover', 'put') or frame.subject_nouns or not base:
        return
    acting = frame.inherited(airborne)
    for adjunct in frame.free(AdjunctKind.OBJECT):
        noun = adjunct.nouns[0]
        if len(acting) == 1 and noun.kind is NounKind.PRONOUN and noun.key == 'it':
            adjunct.used = True
            frame.subject_nouns = adjunct.nouns
            return


def asks_for_flight(frame: Frame) -> bool:
    """`rectangle patrol around the market`, `do a lawnmower survey`: only UAVs fly patterns."""
    if frame.key not in ('', 'trace') or frame.subject_nouns:
        return False
    routes = [a.value for a in frame.adjuncts if a.key == AtomKind.ROUTE.value]
    flown = any('patrol' in name or 'survey' in name for name in routes)
    return flown or frame.has_mark(AtomKind.PATTERN.value)


def _named_later(frame: Frame) -> tuple[Entity, ...]:
    """`climb to 80 m and hover over the park, one drone`: the command is for whom it names."""
    nouns = frame.scene.uav_nouns
    if not nouns or nouns[0].determiner in (Determiner.ANOTHER, Determiner.OTHER):
        return ()
    again = all(n.determiner is Determiner.DEFINITE and not n.index for n in nouns[1:])
    return frame.resolver.actors(nouns[:1]) if again and nouns[0].index <= 1 else ()


def _left_out(frame: Frame) -> tuple[Entity, ...]:
    """Return the UAV that a clause leaves out: named later, or implied by a stated altitude."""
    scene = frame.scene
    if len(scene.uav_nouns) == 1:
        found = frame.resolver.actors(scene.uav_nouns)
    elif not scene.uav_nouns and scene.altitude_stated:
        found = (new_uav(frame),)
    else:
        scene.questions.append('Who should do that: a UAV, or which vehicle? ' + _quote(frame))
        return ()
    scene.clause.subjects = found
    return found


def _quote(frame: Frame) -> str:
    return f'"{frame.scene.prompt[frame.piece.start : frame.piece.end]}"'


def new_uav(frame: Frame) -> Entity:
    """Add the UAV that a clause implies."""
    entity = Entity(id=frame.scene.new_id('uav'), is_uav=True, span=frame.span)
    frame.scene.entities.append(entity)
    return entity


def landed_by(frame: Frame) -> Literal['land', 'return_home']:
    """Return which of the two a landing is: `returns to its base` is no landing on the spot."""
    words = frame.verb.words.split() if frame.verb is not None else []
    home = bool(words) and words[-1] in shipped_lexicon().turns['homeward']
    return 'return_home' if home else 'land'
