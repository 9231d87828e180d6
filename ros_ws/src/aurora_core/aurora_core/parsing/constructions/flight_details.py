# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Take-off, climb and landing, and numbers of a flight told in a clause of their own."""

from __future__ import annotations

from aurora_core.parsing.adjuncts import Adjunct, AdjunctKind
from aurora_core.parsing.atoms import AtomKind
from aurora_core.parsing.constructions.flight_types import stated_value
from aurora_core.parsing.constructions.flight_values import take_flight_values
from aurora_core.parsing.constructions.flyers import flyers, landed_by
from aurora_core.parsing.frames import Frame
from aurora_core.parsing.measures import TIME
from aurora_core.parsing.pieces import Link
from aurora_core.parsing.scene import Entity, MissionDraft
from aurora_core.spec.scenario import MissionDoneTrigger, UavAction
from aurora_core.spec.vocabulary import MissionMode


def ascent(frame: Frame) -> bool:
    """`ascends to 40 m`: the altitude of the phase that follows."""
    if frame.negated or frame.key not in ('ascend', 'descend'):
        return False
    flying = flyers(frame)
    if not flying:
        return False
    found = take_flight_values(frame, MissionMode.HOVER, None)
    if found.duration is not None or found.standoff is not None or found.ranges:
        found.release()
        return False
    place = found.target
    for uav in flying:
        if place is not None:
            frame.scene.pending_place[uav.id] = place
        if found.altitude is not None:
            frame.scene.pending_altitude[uav.id] = found.altitude
        if found.speed is not None:
            frame.scene.pending_speed[uav.id] = found.speed
    frame.scene.became(*(u.id for u in flying))
    return True


def landing(frame: Frame) -> bool:
    """`then lands`, `then returns home`, `does not land`, `stays in the air`."""
    airborne_end = None
    if frame.key in ('keep', 'be', 'land', ''):
        airborne_end = frame.mark(AtomKind.IN_FLIGHT.value)
    if frame.key != 'land' and airborne_end is None:
        return False
    flying = flyers(frame)
    if not flying:
        return False
    missions = [m for u in flying for m in frame.scene.missions_of(u)[-1:]]
    if frame.negated or airborne_end is not None:
        if not missions:
            return False
        for one in missions:
            one.ends_in_flight = True
    elif landed_by(frame) == 'return_home':
        for one in missions:
            home = UavAction(do='return_home', uav=one.uav.id)
            done = MissionDoneTrigger(on='mission_done', uav=one.uav.id)
            frame.scene.became(frame.scene.add_event(home, frame.span, done).id)
    frame.scene.became(*([m.id for m in missions] or [u.id for u in flying]))
    return True


_OF_FLIGHTS = ('altitude', 'standoff', 'radius', 'diameter', 'length', 'width', 'waypoint')
_HANGING = (Link.RELATIVE, Link.PARTICIPLE)
_CAUSES = (Link.WHEN, Link.AFTER)


def flight_details(frame: Frame) -> None:
    """Give what is left to the last mission, if it has no such value yet."""
    left = [a for a in frame.adjuncts if not a.used and _is_detail(frame, a)]
    draft = _last(frame) if left and not frame.negated else None
    if draft is None:
        _for_later(frame, left)
        return
    found = take_flight_values(frame, draft.mode, draft.pattern)
    taken = [a for a in found.taken if a not in left]
    if not found.anything or found.clashes(draft) or found.ranges or taken:
        found.release()
        return
    found.apply(draft)
    frame.scene.became(draft.id)


def _for_later(frame: Frame, left: list[Adjunct]) -> None:
    """`a drone at 90 m altitude keeps the stadium in view`: its phase comes later."""
    flying = [e for e in frame.scene.clause.subjects if e.is_uav]
    heights = [a for a in left if a.key == 'altitude' and a.measure is not None]
    if len(flying) != 1 or not heights or frame.scene.missions or frame.negated:
        return
    measure = heights[0].measure
    parameter = stated_value('altitude', measure) if measure is not None else None
    if parameter is not None:
        heights[0].used = True
        frame.scene.pending_altitude.setdefault(flying[0].id, parameter)
        frame.scene.became(flying[0].id)


def _is_detail(frame: Frame, adjunct: Adjunct) -> bool:
    measure = adjunct.measure
    if measure is None or adjunct.nouns or adjunct.prep == 'within':
        return False
    if adjunct.kind is AdjunctKind.ATTRIBUTE:
        alone = adjunct.key in ('speed', 'duration') and (
            frame.verb is None or (frame.key == 'be' and _of_the_flight(frame))
        )
        lasting = (
            adjunct.key == 'duration'
            and adjunct.prep in ('over', 'for', 'of')
            and (frame.piece.link in _HANGING)
        )
        return adjunct.key in _OF_FLIGHTS or alone or lasting
    if adjunct.kind is not AdjunctKind.MEASURE:
        return False
    if measure.second is not None:
        return frame.verb is None
    if measure.dimension == TIME:
        return adjunct.prep == 'for' and (
            frame.verb is None or frame.piece.link in (*_HANGING, *_CAUSES)
        )
    return False


def _of_the_flight(frame: Frame) -> bool:
    """`a drone flies a line. The speed is 18 m/s`: of whom the clause before was about."""
    told = [c.subjects for c in frame.scene.clauses[:-1] if c.subjects]
    return not frame.subject_nouns and bool(told) and all(e.is_uav for e in told[-1])


def _last(frame: Frame) -> MissionDraft | None:
    """Return the mission that was spoken of last, in this sentence or the one before."""
    scene = frame.scene
    if not scene.missions or any(not e.is_uav for e in _own_subjects(frame)):
        return None
    draft = scene.missions[-1]
    near = scene.clauses[draft.clause].sentence >= frame.piece.sentence - 3
    ended = any(
        isinstance(e.action, UavAction)
        and e.action.uav == draft.uav.id
        and e.action.mission != draft.id
        for e in scene.events
    )
    return draft if near and not ended else None


def _own_subjects(frame: Frame) -> tuple[Entity, ...]:
    """A clause about somebody else keeps its numbers, unless it only describes a target."""
    if frame.piece.link in (*_HANGING, *_CAUSES) or not frame.subject_nouns:
        return ()
    return frame.scene.clause.subjects
