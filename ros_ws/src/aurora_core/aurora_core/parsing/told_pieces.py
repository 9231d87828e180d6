# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What a clause tells before it is read: arrivals, phases, delays, what was told already."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from aurora_core.parsing import values
from aurora_core.parsing.atoms import ACTORS, Atom, AtomKind, NounKind
from aurora_core.parsing.constructions.messages import TELLING
from aurora_core.parsing.constructions.triggers import ELAPSED, Cause, cause
from aurora_core.parsing.frames import Frame
from aurora_core.parsing.morphology import VerbForm
from aurora_core.parsing.pieces import Link, Piece, first_solid
from aurora_core.parsing.story import HeldCause, Story
from aurora_core.spec.parameter import Parameter
from aurora_core.spec.scenario import AgentAction, EventDoneTrigger
from aurora_core.spec.vocabulary import ClauseStatus


def named_later(story: Story, frame: Frame, following: Piece) -> None:
    """`When it sees a bus, the drone …`: a pronoun in front of its noun."""
    if any(n.kind is not NounKind.PRONOUN for n in frame.subject_nouns):
        return
    if not frame.subject_nouns or any(c.subjects or c.objects for c in story.scene.clauses):
        return
    upcoming = Frame(following, story.scene, story.resolver).subject_nouns
    if upcoming and all(n.kind in ACTORS and n.kind is not NounKind.PRONOUN for n in upcoming):
        frame.subject_nouns = upcoming


def acts_later(story: Story, frame: Frame, following: Piece) -> None:
    """`While following a van, the drone …`: who follows is named behind."""
    gerund = frame.verb is not None and frame.verb.form is VerbForm.ING
    if gerund and not frame.subject_nouns and frame.piece.head is None:
        upcoming = Frame(following, story.scene, story.resolver).subject_nouns
        if upcoming and all(n.kind in ACTORS for n in upcoming):
            frame.subject_nouns = upcoming


def joint_causes(pieces: Sequence[Piece], i: int) -> int:
    """Return how many clauses behind the cause at i are causes of the same effect."""
    k = i + 1
    while k + 1 < len(pieces) and _is_second(pieces[k], pieces[i]):
        k += 1
    effect = pieces[k]
    told = effect.sentence == pieces[i].sentence and effect.link is Link.MAIN and not effect.opens
    return k - i - 1 if told else 0


def _is_second(piece: Piece, first: Piece) -> bool:
    if piece.sentence != first.sentence or piece.link is not Link.MAIN or piece.criterion:
        return False
    verb = next((a.key for a in piece.atoms if a.kind is AtomKind.VERB), '')
    joined = piece.opens or piece.atoms[0].kind is AtomKind.CONJUNCTION
    return joined and not piece.paused and not piece.then and verb not in TELLING


def second_cause(story: Story, piece: Piece) -> None:
    """Read a cause beside the one that waits for its effect, or is not known."""
    frame = story.open(piece)
    clause = story.scene.clause
    found = cause(frame)
    held = story.held
    if found is not None and (held is None or held.cause == found):
        clause.status = ClauseStatus.ENCODED
        if held is None:
            story.unknown_cause = -1
            story.held = HeldCause(cause=found, clause=clause, sentence=piece.sentence, delay=None)
    else:
        clause.status = ClauseStatus.NOT_ENCODED
        clause.notes.append('only one cause of an event can be told')
    story.close(frame)


def is_joint_word(sentence: Sequence[Atom], i: int) -> bool:
    """Return whether the `and` at i joins two causes that stand in front of their effect."""
    begin = i
    while begin and sentence[begin - 1].kind not in (AtomKind.COMMA, AtomKind.SUBORDINATOR):
        begin -= 1
    caused = begin > 0 and sentence[begin - 1].kind is AtomKind.SUBORDINATOR
    told = sum(a.kind is AtomKind.VERB for a in sentence[begin:i])
    effect = sum(a.kind is AtomKind.VERB for a in sentence[i:])
    return caused and told == 1 and effect > 1


FLOWN = frozenset({'hover', 'track', 'follow', 'orbit', 'navigate', 'observe', 'fly'})
# `after it has hovered for 20 s` is a phase, not an event.
PHASES = FLOWN | {'wait'}


_GROUND = (NounKind.AGENT, NounKind.VEHICLE, NounKind.EGO)


def is_arrival(piece: Piece) -> bool:
    """Return whether a clause only tells that a ground agent gets somewhere."""
    verb = next((a for a in piece.atoms if a.kind is AtomKind.VERB), None)
    first = first_solid(piece.atoms)
    told = piece.link is Link.MAIN and verb is not None and verb.key in ('reach', 'step_onto')
    grounded = first is not None and first.noun is not None and first.noun.kind in _GROUND
    return told and grounded and any(a.is_place for a in piece.atoms)


def got_message(piece: Piece) -> bool:
    """`B gets the message and tracks the bus`: told as a fact, meant as a cause."""
    verb = next((a for a in piece.atoms if a.kind is AtomKind.VERB), None)
    got = verb is not None and verb.key in ('receive', 'come', 'contain')
    message = any(a.kind is AtomKind.MESSAGE for a in piece.atoms) or (
        verb is not None and (verb.key == 'receive' or piece.atoms[-1].words == 'it')
    )
    named = any(a.is_actor for a in piece.atoms)
    source = any(a.kind is AtomKind.PREPOSITION for a in piece.atoms)
    denied = any(a.kind is AtomKind.NEGATION for a in piece.atoms)
    return piece.link is Link.MAIN and got and message and named and not source and not denied


# What happens at once and may be a cause.
_AT_ONCE = ('vanish', 'exceed', 'lose', 'fall_below', 'receive', 'appear')


def leads_to(piece: Piece) -> bool:
    """`van gets occluded -> drone warns the ego`: only what happens at once is a cause."""
    verb = next((a for a in piece.atoms if a.kind is AtomKind.VERB), None)
    return piece.link is Link.MAIN and verb is not None and verb.key in _AT_ONCE


def is_phase(piece: Piece) -> bool:
    """Return whether a clause tells a phase with its duration as done: `has hovered for 20 s`."""
    verb = next((a for a in piece.atoms if a.kind is AtomKind.VERB), None)
    done = any(a.kind is AtomKind.AUXILIARY and a.key in ('have', 'spend') for a in piece.atoms)
    lasted = any(a.measure is not None and a.key == 'time' for a in piece.atoms)
    if verb is None or not done or not lasted:
        return False
    there = any(a.noun is not None and a.noun.key == 'there' for a in piece.atoms)
    return verb.key in PHASES or (verb.key == 'be' and there)


def was_doing(piece: Piece) -> bool:
    """`the drone is hovering there when a bus stops`: what it does when something happens."""
    verb = next((i for i, a in enumerate(piece.atoms) if a.kind is AtomKind.VERB), None)
    if verb is None or piece.link is not Link.MAIN or piece.atoms[verb].form.value != 'ing':
        return False
    helped = any(a.kind is AtomKind.AUXILIARY and a.key == 'be' for a in piece.atoms[:verb])
    return helped and piece.atoms[verb].key in PHASES | {'drive', 'navigate'}


def is_earlier(piece: Piece) -> bool:
    """`… follows it after ascending to 40 m`: told second, done first."""
    if piece.link is not Link.AFTER:
        return False
    first = first_solid(piece.atoms)
    if any(a.kind is AtomKind.MESSAGE for a in piece.atoms):
        return False  # `lands after getting the message`
    gerund = first is not None and first.form.value == 'ing' and first.key not in HAPPENS
    return gerund or is_phase(piece)


# `after seeing a bus`: what one waits for, not what one does first.
HAPPENS = ('see', 'lose', 'receive', 'alert', 'send', 'report')


def is_ellipsis(piece: Piece) -> bool:
    """`when it does`, `once it has`: the clause before, again."""
    solid = [a for a in piece.atoms if a.kind is not AtomKind.FILL]
    verbs = [a for a in solid if a.kind in (AtomKind.VERB, AtomKind.AUXILIARY)]
    words = verbs and verbs[-1].key in ('trace', 'contain', 'be', 'have', 'do')
    return bool(words) and solid[-1] is verbs[-1] and len(solid) == 2 and solid[0].is_actor


def without_link(piece: Piece, link: Link) -> Piece:
    """Return a clause that was told before, as the cause that a later one refers to."""
    return replace(piece, link=link, then=False, head=None)


def again(story: Story, frame: Frame) -> Cause | None:
    """`…, and when it does, …`: the cause is what the clause in front tells."""
    if not is_ellipsis(frame.piece):
        return None
    named = any(n.kind is not NounKind.PRONOUN for n in frame.subject_nouns)
    who = frame.subjects() if named else ()
    for event in reversed(story.scene.events):  # `after the truck does`
        if who and isinstance(event.action, AgentAction) and event.action.agent == who[0].id:
            return EventDoneTrigger(on='event_done', event=event.id)
    if story.before is None:
        return None
    told = Frame(without_link(story.before, frame.piece.link), story.scene, story.resolver)
    if not told.subject_nouns:
        told.subject_nouns = frame.subject_nouns
    return cause(told)


def delay_of(frame: Frame) -> Parameter | None:
    """Take `5 s` of `5 s after the bus stops`."""
    adjunct = frame.time('')
    if adjunct is None or adjunct.measure is None or adjunct.start != frame.piece.atoms[0].start:
        return None
    if frame.verb is None or not values.accepts('delay', adjunct.measure):
        return None
    if frame.key in ELAPSED and not frame.subject_nouns:
        return None  # `when 10 s have passed`
    adjunct.used = True
    return values.explicit('delay', adjunct.measure)
