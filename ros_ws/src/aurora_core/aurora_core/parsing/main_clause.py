# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""One main clause: which family of constructions reads it."""

from __future__ import annotations

from aurora_core.parsing import values
from aurora_core.parsing.adjuncts import AdjunctKind
from aurora_core.parsing.atoms import AtomKind, Determiner, NounKind, NounPhrase
from aurora_core.parsing.constructions import actions, conditions, ground, messages, missions
from aurora_core.parsing.constructions.demands import demands, seen_for
from aurora_core.parsing.constructions.flight_details import ascent, flight_details, landing
from aurora_core.parsing.constructions.flyers import asks_for_flight
from aurora_core.parsing.constructions.identity import is_of_type, none_such
from aurora_core.parsing.constructions.placing import placing
from aurora_core.parsing.constructions.states import predicate_adjectives
from aurora_core.parsing.constructions.triggers import (
    time_adjunct,
)
from aurora_core.parsing.constructions.world import world_words
from aurora_core.parsing.events import complete_event
from aurora_core.parsing.frames import Frame
from aurora_core.parsing.morphology import VerbForm
from aurora_core.parsing.pronouns import ground as ground_agent
from aurora_core.parsing.scene import Entity
from aurora_core.spec.scenario import Behavior
from aurora_core.spec.vocabulary import BehaviorKind, ClauseStatus, MissionMode

_AIR_ONLY = frozenset(
    {'hover', 'track', 'observe', 'navigate', 'orbit', 'fly', 'ascend', 'descend', 'land'}
)
# What may happen at a stated time.
_TIMED = frozenset(
    {
        'brake',
        'stop',
        'slow',
        'accelerate',
        'change_lane',
        'yield',
        'start',
        'cross',
        'step_onto',
        'alert',
        'send',
        'report',
        'land',
        'ascend',
        'descend',
        'drive',
        'track',
        'follow',
        'hover',
        'orbit',
        'navigate',
    }
)
# Predicates that only an actor of the scene can have.
_ACTING = frozenset(
    {
        'drive',
        'circulate',
        'follow',
        'tailgate',
        'overtake',
        'approach',
        'brake',
        'cross',
        'walk',
        'park',
        'turn_left',
        'turn_right',
        'emergency_run',
        'trail',
        'hover',
        'track',
        'orbit',
        'fly',
        'land',
    }
)
_GROUND_ONLY = frozenset(
    {
        'drive',
        'circulate',
        'tailgate',
        'overtake',
        'stop',
        'brake',
        'slow',
        'yield',
        'cross',
        'walk',
        'park',
        'change_lane',
        'turn_left',
        'turn_right',
        'emergency_run',
        'lead',
        'accelerate',
        'contain',
    }
)


def shared_words(frame: Frame) -> None:
    world_words(frame)
    for noun in frame.nouns():
        if noun.kind in (NounKind.UNSUPPORTED, NounKind.AMBIGUOUS):
            frame.resolver.actors((noun,))
        elif noun.kind is NounKind.UNKNOWN and _acts(frame, noun) and _moves(frame):
            frame.resolver.unknown_actor(noun)


def _acts(frame: Frame, noun: NounPhrase) -> bool:
    """`a dragon follows`; in `to study a shock wave, the car brakes` the car does."""
    if noun not in frame.subject_nouns:
        return False
    behind = frame.subject_nouns[frame.subject_nouns.index(noun) + 1 :]
    if not behind:
        return True
    between = frame.scene.prompt[noun.end : behind[0].start].strip().lower()
    return between in ('and', 'or', '&', '+')


def _moves(frame: Frame) -> bool:
    """Only what takes part in traffic needs a type: `the council wants` names no actor."""
    return frame.key in _ACTING and not frame.negated and not frame.passive


def main_clause(frame: Frame) -> None:
    shared_words(frame)
    if _absent(frame) or none_such(frame):
        return
    is_of_type(frame)
    _in_brackets(frame)
    flies = _flies(frame)
    for construction in (_timed, _told, _about_air if flies else _about_ground):
        if construction(frame):
            break
    messages.link_values(frame)
    demands(frame)
    flight_details(frame)
    _from_above(frame)
    _siren(frame)
    if not frame.negated:
        predicate_adjectives(frame)
    if frame.scene.clause.status is not ClauseStatus.ENCODED:
        _only_named(frame)
        command = frame.verb is not None and frame.verb.form is VerbForm.BASE
        if command and not frame.subject_nouns:  # `take my car as the reference`
            egos = [n for n in frame.nouns() if frame.resolver.names_ego(n)]
            frame.scene.clause.objects += frame.resolver.actors(egos)


def _only_named(frame: Frame) -> None:
    """Actors are in the scene although what is said of them was not understood.

    `the owner has hired us`: an unknown noun that is taken as known belongs to the speaker's
    world, `a dragon sleeps` asks for one.
    """
    strange = any(
        n.kind is NounKind.UNKNOWN and n.determiner is Determiner.DEFINITE
        for n in frame.subject_nouns
    )
    if not strange:
        frame.subjects()


def _in_brackets(frame: Frame) -> None:
    """`follows a motorcycle (20 m/s)`: the speed of the noun in front of the bracket."""
    adjunct = frame.attribute('speed')
    if adjunct is None or adjunct.measure is None or adjunct.prep:
        return
    before = frame.scene.prompt[: adjunct.start]
    noun = next((n for n in frame.nouns() if before[n.end :].strip() == '('), None)
    if noun is None or noun in frame.subject_nouns:
        return
    if not values.accepts('ground_speed', adjunct.measure):
        return
    speed = values.explicit('ground_speed', adjunct.measure)
    for entity in frame.resolver.actors((noun,), accept=ground_agent):
        if not entity.is_uav:
            adjunct.used = True
            drive = Behavior(kind=BehaviorKind.DRIVE, speed_mps=speed, span=frame.span)
            entity.behaviors.append(drive)


def _siren(frame: Frame) -> None:
    """`an ambulance with its siren on`."""
    mark = frame.free(AdjunctKind.MARK, AtomKind.SIREN.value)
    about = frame.scene.clause
    agents = [e for e in about.subjects or about.objects if not e.is_uav]
    if mark and not agents:  # `tracks a fire engine on an emergency run`
        agents = [e for e in about.objects if not e.is_uav]
        targets = {m.target for m in frame.scene.missions[-1:]}
        agents = agents or [e for e in frame.scene.agents if e.id in targets]
    if mark and agents:
        mark[0].used = True
        for entity in agents:
            _rush(
                entity,
                Behavior(kind=BehaviorKind.EMERGENCY_RUN, target=_goal(frame), span=frame.span),
            )
        frame.scene.clause.status = ClauseStatus.ENCODED


def _rush(entity: Entity, made: Behavior) -> None:
    """`drives to the hospital with its siren on`: one run, not two."""
    last = entity.behaviors[-1] if entity.behaviors else None
    if last is not None and last.kind is BehaviorKind.DRIVE and last.span == made.span:
        entity.behaviors[-1] = Behavior(
            kind=made.kind,
            target=made.target or last.target,
            speed_mps=last.speed_mps,
            span=made.span,
        )
    else:
        entity.behaviors.append(made)


def _goal(frame: Frame) -> str | None:
    """`on an emergency run to the hospital`."""
    for adjunct in frame.free(AdjunctKind.PHRASE, 'to'):
        for noun in adjunct.nouns:
            place = frame.resolver.place(noun)
            if place is not None:
                adjunct.used = True
                return place
    return None


def _from_above(frame: Frame) -> None:
    """`…, seen from above`: aerial observation without a UAV that is named."""
    mark = frame.mark(AtomKind.AERIAL.value)
    if mark is not None:
        about = frame.scene.clause.subjects + frame.scene.clause.objects
        frame.scene.aerial = (frame.scene.clause, about[0].id if about else None)
        frame.scene.clause.status = ClauseStatus.ENCODED


def _absent(frame: Frame) -> bool:
    """`no drone`: as it is unless one is named."""
    nouns = frame.nouns()
    told = frame.negated and frame.key in ('', 'be', 'exist', 'contain', 'put')
    if frame.key == 'be' and not frame.subject_nouns:
        return False  # `is not acceptable for the drone`
    if not told or not nouns or any(n.kind is not NounKind.UAV for n in nouns):
        return False
    for adjunct in frame.adjuncts:
        adjunct.used = adjunct.used or bool(adjunct.nouns)
    frame.scene.no_uavs = True
    frame.scene.clause.status = ClauseStatus.ENCODED
    return True


def _timed(frame: Frame) -> bool:
    """`the bus brakes after 10 s`."""
    if frame.key not in _TIMED:
        return False
    found = time_adjunct(frame)
    if found is None:
        return False
    at, taken = found
    action = actions.action(frame)
    if action is None:
        taken.used = False
        return False
    complete_event(frame.scene, at, action, frame.span, (frame.scene.clause,))
    return True


def _told(frame: Frame) -> bool:
    """An effect whose cause is not stated: `the drone alerts the ego`, `the bus speeds up`."""
    if not actions.is_action(frame):
        return False
    action = messages.message(frame) or actions.agent_action(frame)
    if action is None:
        return False
    links = [link for link in frame.scene.links if link.id in frame.scene.clause.ids]
    if any(link.rate is not None for link in links):
        return True  # `reports every 2 s`: a stream, no event
    frame.scene.became(frame.scene.add_event(action, frame.span).id)
    return True


def _about_air(frame: Frame) -> bool:
    if seen_for(frame):
        return True
    if conditions.condition(frame):
        if frame.key in ('track', 'follow', 'hover', 'trail', 'fly'):
            missions.mission(frame)
        elif frame.key in ('keep', 'see'):
            missions.watching(frame)
        return True
    return ascent(frame) or landing(frame) or missions.mission(frame)


def _about_ground(frame: Frame) -> bool:
    if conditions.condition(frame):
        if frame.key == 'be':
            placing(frame)  # `is on the sidewalk within 9 m of it`
        return True
    return ground.behavior(frame) or placing(frame)


def _goes_on_flying(frame: Frame) -> bool:
    """`flies a rectangle there, moving at 6 m/s`: the speed of a pattern is that of its UAV."""
    if frame.key != 'drive' or frame.subject_nouns or frame.piece.head is not None:
        return False
    acting = frame.inherited()
    if not acting or not acting[0].is_uav or frame.attribute('speed') is None:
        return False
    return all(m.mode is MissionMode.NAVIGATE for m in frame.scene.missions_of(acting[0])[-1:])


def _flies(frame: Frame) -> bool:
    """Return whether the clause is about a UAV."""
    kinds = [n.kind for n in frame.subject_nouns if n.kind is not NounKind.PRONOUN]
    head = frame.piece.head
    if not frame.subject_nouns and head is not None and head.noun is not None and head.is_actor:
        kinds = [head.noun.kind] if head.noun.kind is not NounKind.PRONOUN else []
    if kinds and not (frame.passive and not frame.subject_nouns):
        return kinds[0] is NounKind.UAV
    if frame.key in _AIR_ONLY or asks_for_flight(frame):
        return True
    if _goes_on_flying(frame):
        return True
    if frame.key in _GROUND_ONLY:
        return False
    command = frame.verb is not None and frame.verb.form is VerbForm.BASE
    if command and not frame.subject_nouns and frame.key == 'follow' and not frame.inherited():
        return True
    lead = next((a for a in frame.adjuncts if a.nouns and not a.key), None)
    placing = frame.key in ('be', 'put', 'exist', 'contain', 'keep', '')
    if placing and lead is not None and (lead.nouns[0].kind is NounKind.UAV):
        return True
    if placing and not frame.subject_nouns and lead is not None:
        kept = frame.key == 'keep' and lead.nouns[0].key == 'it'  # `and keep it there`
        acting = frame.inherited() if kept else ()
        return bool(acting) and acting[0].is_uav
    if frame.has_mark(AtomKind.WORLD.value) or any(
        a.used for a in frame.adjuncts if a.key == AtomKind.WORLD.value
    ):
        return False
    found = frame.subjects()
    if found:
        return found[0].is_uav
    return any(
        n.kind is NounKind.UAV
        for a in frame.adjuncts
        if a.key in ('with', 'using', 'by')
        for n in a.nouns
    )
