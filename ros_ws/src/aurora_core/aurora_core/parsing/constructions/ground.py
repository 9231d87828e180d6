# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Ground agents: where they are and what they do."""

from __future__ import annotations

from aurora_core.parsing import values
from aurora_core.parsing.adjuncts import Adjunct, AdjunctKind
from aurora_core.parsing.atoms import ACTORS, AtomKind, NounKind, NounPhrase
from aurora_core.parsing.constructions.places import (
    add_placement,
    gap,
    is_throughout,
    lane_side,
    named_reference,
    place_of,
    placements_of,
)
from aurora_core.parsing.constructions.spacing import column, fill_in
from aurora_core.parsing.frames import Frame
from aurora_core.parsing.morphology import VerbForm
from aurora_core.parsing.pronouns import ground
from aurora_core.parsing.scene import Entity
from aurora_core.spec.parameter import Parameter
from aurora_core.spec.scenario import Behavior, Placement
from aurora_core.spec.scene import KEEPS_HEADWAY, lasts
from aurora_core.spec.vocabulary import AgentType, BehaviorKind, MissionMode, Relation

# Predicates that name a behaviour in other words.
BEHAVIORS = {kind.value: kind for kind in BehaviorKind} | {
    'trail': BehaviorKind.FOLLOW,
    'lead': BehaviorKind.DRIVE,
    'start': BehaviorKind.DRIVE,
    'track': BehaviorKind.FOLLOW,
    'come': BehaviorKind.APPROACH,
    'step_onto': BehaviorKind.CROSS,
    'visit': BehaviorKind.DRIVE,
    'reach': BehaviorKind.DRIVE,
    'trace': BehaviorKind.DRIVE,
}


_TARGETED = frozenset(
    {
        'follow',
        'trail',
        'tailgate',
        'overtake',
        'approach',
        'yield',
        'lead',
        'track',
        'change_lane',
    }
)


_BEHIND_ITS_TARGET = frozenset({'follow', 'trail', 'tailgate', 'overtake', 'approach', 'track'})


_AT_PLACES = frozenset(
    {'stop', 'wait', 'brake', 'slow', 'yield', 'park', 'turn_left', 'turn_right'}
)


_MOVING = frozenset(
    {'drive', 'follow', 'trail', 'lead', 'circulate', 'walk', 'emergency_run', 'track'}
)


_EMERGENCY = (AgentType.POLICE, AgentType.AMBULANCE, AgentType.FIRETRUCK)
_BEGINS = ('start', 'begin', 'began', 'begun', 'commenc', 'come', 'coming', 'came')
_MOTION = frozenset({'drive', 'driving', 'move', 'moving', 'off', 'out', 'rolling'})
_GOALS = (NounKind.PLACE, NounKind.LANDMARK, NounKind.MISSING_LANDMARK)


def is_behavior(key: str) -> bool:
    """Return whether a predicate is something that ground agents do."""
    return key in BEHAVIORS


def behavior(frame: Frame) -> bool:
    """Read what ground agents do, with the place that is stated in the same breath."""
    if frame.negated or frame.key not in BEHAVIORS:
        return False
    if frame.key == 'start' and frame.free(AdjunctKind.PLACE) and _begins(frame):
        return False  # `starts 45 m behind the ego` is a place, `pulls out ahead of it` a deed
    if frame.key == 'reach' and not any(n.kind in _GOALS for n in frame.nouns()):
        return False
    _commanded(frame)
    if frame.key == 'trace' and not _goes_at(frame):
        return False
    subjects = frame.subjects(ground)
    if not subjects or any(e.is_uav for e in subjects):
        return False
    if _closing(frame, subjects):
        return True
    kind = BEHAVIORS[frame.key]
    if (
        frame.key == 'come'
        and frame.attribute('speed') is not None
        and not frame.free(AdjunctKind.OBJECT)
    ):
        kind = BehaviorKind.DRIVE  # `the bus, which comes at 8 m/s`
    if frame.key == 'trace' and all(e.type is AgentType.PEDESTRIAN for e in subjects):
        kind = BehaviorKind.WALK
    if kind is BehaviorKind.EMERGENCY_RUN and _only_fast(frame, subjects):
        kind = BehaviorKind.DRIVE
    target = _target(frame, subjects)
    _tracked_for(frame, subjects)
    speed = speed_of(frame)
    duration = _duration(frame, kind)
    closing = _closing_distance(frame) if frame.key in ('tailgate', 'approach', 'come') else None
    if kind is BehaviorKind.OVERTAKE and not _overtakes(frame, target):
        kind = BehaviorKind.DRIVE  # `a bus goes past at 20 km/h`
    headway = frame.attribute('gap') if kind in KEEPS_HEADWAY else None
    kept = None if headway is None else headway.measure
    if headway is not None and kept is not None and values.accepts('headway', kept):
        headway.used = True
    else:
        kept = None
    side = lane_side(frame)
    placements = _placements(frame, subjects, target, closing)
    made = Behavior(
        kind=kind,
        target=target,
        speed_mps=speed,
        closing_from_m=closing,
        headway_s=None if kept is None else values.explicit('headway', kept),
        side=side,
        duration_s=duration,
        span=frame.span,
    )
    if kind is BehaviorKind.CIRCULATE:
        for adjunct in frame.free(AdjunctKind.OBJECT):
            if any(n.kind is not NounKind.STREET for n in adjunct.nouns):
                frame.flag(adjunct.start, adjunct.end)  # `around the block`: nobody does that
    for entity in subjects:
        own = tuple(p for p in placements if p.of != entity.id)
        add_behavior(entity, made, own)
    frame.scene.became(*(e.id for e in subjects))
    return True


def _overtakes(frame: Frame, target: str | None) -> bool:
    named = any(names_actor(a) for a in frame.adjuncts) or frame.passive
    place = target is not None and frame.scene.by_id(target) is None
    if place:  # `must have passed the crosswalk`
        return named
    return named or target is not None or frame.attribute('speed') is None


def _only_fast(frame: Frame, subjects: tuple[Entity, ...]) -> bool:
    """`two motorcycles race along`: nobody of them is on an emergency run."""
    plain = frame.verb is not None and ' ' not in frame.verb.words
    siren = frame.has_mark(AtomKind.SIREN.value)
    return plain and not siren and not any(e.type in _EMERGENCY for e in subjects)


def _tracked_for(frame: Frame, subjects: tuple[Entity, ...]) -> None:
    """`a drone tracks a jogger. The jogger runs for 60 s`: so long it is tracked."""
    adjunct = frame.time('for')
    drafts = [m for m in frame.scene.missions if m.target in {e.id for e in subjects}]
    if adjunct is None or adjunct.measure is None or len(drafts) != 1:
        return
    draft = drafts[0]
    if draft.mode is not MissionMode.TRACK or draft.duration is not None:
        return
    if values.accepts('mission_duration', adjunct.measure):
        adjunct.used = True
        draft.duration = values.explicit('mission_duration', adjunct.measure)


def _duration(frame: Frame, kind: BehaviorKind) -> Parameter | None:
    """`stops for 15 s`, `rides for at least 40 s`: how long it does so."""
    adjunct = frame.time('for')
    if adjunct is None or adjunct.measure is None:
        return None
    measure = adjunct.measure
    if not values.accepts('behavior_duration', measure) or not lasts(kind, measure.bound):
        return None
    adjunct.used = True
    return values.explicit('behavior_duration', measure)


def _goes_at(frame: Frame) -> bool:
    """`the car does 50 mph`, `a jogger runs along the pavement`: moving, not carrying out."""
    if frame.has_mark(AtomKind.PATTERN.value) or frame.has_mark(AtomKind.ROUTE.value):
        return False
    along = frame.free(AdjunctKind.PHRASE, 'along', 'on', 'through', 'over')
    return frame.attribute('speed') is not None or bool(along)


# Predicates whose object acts when they stand without a subject: `drive the ego car …`.
_COMMANDS = frozenset(
    {'drive', 'circulate', 'stop', 'brake', 'slow', 'park', 'walk', 'wait', 'start'}
)


def _commanded(frame: Frame) -> None:
    if frame.key not in _COMMANDS or frame.subject_nouns or frame.verb is None:
        return
    if frame.verb.form is not VerbForm.BASE or frame.piece.head is not None:
        return
    for adjunct in frame.free(AdjunctKind.OBJECT):
        if names_actor(adjunct):
            adjunct.used = True
            frame.subject_nouns = adjunct.nouns
            return


def add_behavior(entity: Entity, made: Behavior, placements: tuple[Placement, ...]) -> None:
    for i, known in enumerate(entity.behaviors):
        same = known.kind is made.kind and (known.target == made.target or made.target is None)
        same = same and (known.side is made.side or None in (known.side, made.side))
        same = same and None in (known.duration_s, made.duration_s)
        if same and (known.speed_mps is None or made.speed_mps is None):
            entity.behaviors[i] = Behavior(
                kind=known.kind,
                target=known.target or made.target,
                speed_mps=known.speed_mps or made.speed_mps,
                closing_from_m=known.closing_from_m or made.closing_from_m,
                headway_s=known.headway_s or made.headway_s,
                side=known.side or made.side,
                duration_s=known.duration_s or made.duration_s,
                span=known.span,
            )
            break
    else:
        entity.behaviors.append(made)
    for placement in placements:
        add_placement(entity, placement)


def _target(frame: Frame, subjects: tuple[Entity, ...]) -> str | None:
    for adjunct in frame.free(AdjunctKind.OBJECT) + frame.free(
        AdjunctKind.PHRASE, 'to', 'of', 'with'
    ):
        acting = [n for n in adjunct.nouns if n.kind in ACTORS and n.key != 'there']
        if frame.key not in _TARGETED and acting:
            continue
        if frame.key == 'start' and adjunct.kind is AdjunctKind.OBJECT:
            continue  # `leaves the station`
        there = _place_again(frame, acting)
        if there is not None:
            adjunct.used = True
            return there
        named = named_reference(frame, adjunct)
        if named is not None:
            adjunct.used = True
            return named
    patients = frame.patient(ground) if frame.passive else ()
    if frame.key in _TARGETED and len(patients) == 1 and patients[0] not in subjects:
        return patients[0].id  # `the bus drives on and is followed by a van`
    if frame.key in _TARGETED:
        for adjunct in frame.free(AdjunctKind.PLACE, 'behind', 'ahead', 'near'):
            if adjunct.nouns:
                return named_reference(frame, adjunct)
        away = frame.attribute('away', 'gap', 'standoff')
        if away is not None and away.nouns:
            return named_reference(frame, away)
        if (
            frame.key in ('tailgate', 'follow', 'trail', 'overtake')
            and frame.scene.ego is not None
        ):
            ego = frame.scene.ego
            return ego.id if ego not in subjects else None
        others = [e for e in frame.scene.agents if e not in subjects]
        if frame.key == 'tailgate' and len(others) == 1:
            return others[0].id  # `a van with a motorcycle on its bumper`
        return None
    if frame.key in _AT_PLACES:
        for adjunct in frame.free(AdjunctKind.PHRASE, 'at', 'on', 'in', 'before', 'for'):
            place = place_of(frame, adjunct)
            if place is not None:
                adjunct.used = frame.key not in ('wait', 'park')
                return place
    if frame.key in ('drive', 'start'):
        for adjunct in frame.free(AdjunctKind.PHRASE, 'for'):  # `heads for the main road`
            place = place_of(frame, adjunct)
            if place is not None:
                adjunct.used = True
                return place
    if frame.key in ('drive', 'cross', 'walk', 'visit'):
        for adjunct in frame.free(AdjunctKind.PHRASE, 'through', 'along', 'at', 'over', 'on'):
            place = place_of(frame, adjunct)
            if place is not None and (frame.key != 'walk' or adjunct.key != 'on'):
                adjunct.used = frame.key != 'drive' or adjunct.key in ('through', 'along')
                return place if adjunct.used else None
    return None


def _begins(frame: Frame) -> bool:
    """Tell `starts`, `begins its run` from `starts off`, `pulls out`."""
    words = frame.verb.words.split() if frame.verb is not None else ['']
    return words[0].startswith(_BEGINS) and words[-1] not in _MOTION


def _place_again(frame: Frame, nouns: list[NounPhrase]) -> str | None:
    """`people wait at the crosswalk while a bus approaches it`: people are no `it`."""
    if len(nouns) != 1 or nouns[0].kind is not NounKind.PRONOUN or nouns[0].key != 'it':
        return None
    if frame.key != 'approach' or len(frame.scene.clauses) < 2:
        return None
    before = frame.scene.clauses[-2]
    people = all(e.type is AgentType.PEDESTRIAN for e in before.subjects if not e.is_uav)
    places = [*before.places, *(p.of for e in before.subjects for p in e.placements if p.of)]
    places = [p for p in places if frame.scene.by_id(p) is None]
    return places[-1] if before.subjects and people and places else None


def speed_of(frame: Frame) -> Parameter | None:
    adjunct = frame.attribute('speed')
    if adjunct is None or adjunct.measure is None:
        return None
    if adjunct.measure.dimension == 'count' or not values.accepts('ground_speed', adjunct.measure):
        return None
    adjunct.used = True
    return values.explicit('ground_speed', adjunct.measure)


def _closing_distance(frame: Frame) -> Parameter | None:
    adjunct = frame.length('from')
    away = frame.attribute('standoff', 'away')  # `approaches from 50 m away`
    if adjunct is None and away is not None and away.prep == 'from' and not away.nouns:
        adjunct = away
    if adjunct is None or adjunct.measure is None:
        return None
    if not values.accepts('closing_from', adjunct.measure):
        return None
    adjunct.used = True
    return values.explicit('closing_from', adjunct.measure)


def _closing(frame: Frame, subjects: tuple[Entity, ...]) -> bool:
    """`…, closing from 45 m` adds the distance to what the agent is doing already."""
    if frame.key != 'approach' or frame.free(AdjunctKind.OBJECT):
        return False
    behaviors = subjects[0].behaviors
    if len(subjects) != 1 or not behaviors:
        return False
    last = behaviors[-1]
    if last.kind not in (
        BehaviorKind.TAILGATE,
        BehaviorKind.FOLLOW,
        BehaviorKind.APPROACH,
        BehaviorKind.OVERTAKE,
    ):
        return False
    distance = _closing_distance(frame)
    if distance is None:
        return False
    behaviors[-1] = last.model_copy(update={'closing_from_m': distance})
    if last.target is not None:
        add_placement(
            subjects[0],
            Placement(
                relation=Relation.BEHIND, of=last.target, distance_m=distance, span=frame.span
            ),
        )
    for adjunct in frame.free(AdjunctKind.PLACE, 'behind'):
        adjunct.used = not adjunct.nouns and adjunct.measure is None
    frame.scene.became(subjects[0].id)
    return True


def _is_placed(frame: Frame, subjects: tuple[Entity, ...], target: str) -> bool:
    """`a truck is 40 m ahead of the ego, and the ego approaches it`: said already."""
    other = frame.scene.by_id(target)
    return other is not None and any(p.of == e.id for e in subjects for p in other.placements)


def _place_told(frame: Frame) -> str | None:
    """`a boy crosses at the crosswalk, a car approaches from 50 m`: what it approaches."""
    for clause in reversed(frame.scene.clauses[:-1]):
        if clause.sentence == frame.piece.sentence and clause.places:
            return clause.places[-1]
    return None


def _placements(
    frame: Frame, subjects: tuple[Entity, ...], target: str | None, closing: Parameter | None
) -> tuple[Placement, ...]:
    kept = frame.key in _MOVING
    column(frame, subjects, kept=kept)
    made = list(placements_of(frame, subjects, kept=kept))
    wanted = None
    if target is not None and not made and ':' not in target:
        if frame.key in _BEHIND_ITS_TARGET:
            wanted = Relation.BEHIND
        elif frame.key == 'lead':
            wanted = Relation.AHEAD
    if target is not None and _is_placed(frame, subjects, target):
        wanted = None
        other = frame.scene.by_id(target)
        distance = gap(frame) if other is not None and not made else None
        if other is not None and distance is not None:  # of the one who is placed
            fill_in((other,), {other.id, subjects[0].id}, distance)
    place = target if target is not None else _place_told(frame)
    free = closing is not None and not made and frame.scene.by_id(place or '') is None
    if free and place is not None:  # `approaches the junction from 50 m away`
        made.append(
            Placement(relation=Relation.BEFORE, of=place, distance_m=closing, span=frame.span)
        )
    if wanted is not None and target is not None and frame.scene.by_id(target) is not None:
        distance = closing or gap(frame)
        made.append(
            Placement(
                relation=wanted,
                of=target,
                distance_m=distance or values.default('placement_distance'),
                kept_in_motion=kept or is_throughout(frame),
                throughout=is_throughout(frame),
                span=frame.span,
            )
        )
    elif closing is not None and made:
        first = made[0]
        made[0] = Placement(
            relation=first.relation,
            of=first.of,
            distance_m=closing,
            kept_in_motion=first.kept_in_motion,
            throughout=first.throughout,
            span=first.span,
        )
    return tuple(made)


def names_actor(adjunct: Adjunct) -> bool:
    """Return whether an adjunct is somebody."""
    return any(n.kind in ACTORS for n in adjunct.nouns)
