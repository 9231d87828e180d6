# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Messages: to whom, what of, when and where they are told."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import pairwise, takewhile

from aurora_core.parsing.atoms import Atom, AtomKind
from aurora_core.parsing.doubts.bodies import taking_part, unnamed
from aurora_core.parsing.doubts.clauses import BREAKS, TOLD, clause_of, events_in, over, sentences
from aurora_core.spec.parameter import Span
from aurora_core.spec.scenario import (
    GroundAgent,
    MessageTrigger,
    ScenarioSpec,
    SendMessage,
    UavAction,
    bodies_of,
)
from aurora_core.spec.vocabulary import AgentType, BehaviorKind

_ENDS = frozenset({AtomKind.VERB, AtomKind.SUBORDINATOR, AtomKind.STOP, AtomKind.COMMA})
# What goes on beside a message whose moment stays open.
_GOES_ON = frozenset(
    {
        *('be', 'circulate', 'drive', 'fly', 'follow', 'hover', 'keep', 'navigate', 'observe'),
        *('orbit', 'park', 'reach', 'receive', 'track', 'wait', 'walk'),
    }
)


# What somebody may do because of a message.
_REACTS = frozenset(BehaviorKind) - {
    *(BehaviorKind.CIRCULATE, BehaviorKind.FOLLOW, BehaviorKind.TAILGATE),
    *(BehaviorKind.APPROACH, BehaviorKind.WAIT, BehaviorKind.PARK),
}


def other_receivers(spec: ScenarioSpec, atoms: Sequence[Atom]) -> Iterator[Span]:
    """`sends its speed to the ego` that became a message to somebody else."""
    for sentence in sentences(atoms):
        sends = None
        for k, atom in enumerate(sentence):
            if atom.kind is AtomKind.VERB:
                sends = atom if atom.key in TOLD else None
            elif atom.kind is AtomKind.SUBORDINATOR:
                sends = None
            elif sends is not None and atom.is_actor and k and sentence[k - 1].key == 'to':
                clause = clause_of(spec, sends)
                if clause is None:
                    continue
                told = [e.action for e in events_in(spec, clause)]
                told_to = frozenset(a.receiver for a in told if isinstance(a, SendMessage))
                if told_to and unnamed(spec, [atom], told_to):
                    yield clause.span


def told_by_a_person(spec: ScenarioSpec, atoms: Sequence[Atom]) -> Iterator[Span]:
    """`it sees a child. Then it tells the car`: a pronoun for things that became a person."""
    persons = {a.id for a in spec.agents if a.type is AgentType.PEDESTRIAN}
    for sentence in sentences(atoms):
        for word, verb in pairwise(a for a in sentence if a.kind is not AtomKind.AUXILIARY):
            it = word.noun is not None and word.noun.key == 'it'
            if not it or verb.kind is not AtomKind.VERB or verb.key not in TOLD:
                continue
            clause = clause_of(spec, verb)
            told = [] if clause is None else [e.action for e in events_in(spec, clause)]
            if any(isinstance(a, SendMessage) and a.sender in persons for a in told):
                yield over(word, verb)


def open_moments(spec: ScenarioSpec, atoms: Sequence[Atom]) -> Iterator[Span]:
    """`overtakes it, then the drone warns the ego`: a message at no time where words tell one.

    Its moment stays open only where nothing else happens in the sentence, or where it is what
    somebody answers to.
    """
    answered = {
        (e.trigger.sender, e.trigger.by)
        for e in spec.events
        if isinstance(e.trigger, MessageTrigger)
    }
    waited = {getattr(e.trigger, 'event', None) for e in spec.events}
    ordered = {name for o in spec.orders for name in (o.first, o.then)}
    for sentence in sentences(atoms):
        verbs = [a for a in sentence if a.kind in (AtomKind.VERB, AtomKind.HAPPENING)]
        ties = any(a.kind in (AtomKind.SUBORDINATOR, AtomKind.THEN) for a in sentence)
        for verb in verbs:
            if verb.key not in TOLD:
                continue
            clause = clause_of(spec, verb)
            others = any(v is not verb and v.key not in _GOES_ON for v in verbs)
            if clause is None or not (ties or others) or _is_premise(sentence, verb):
                continue
            if any(
                isinstance(e.action, SendMessage)
                and e.trigger is None
                and e.id not in waited | ordered
                and (e.action.sender, e.action.receiver) not in answered
                for e in events_in(spec, clause)
            ):
                yield clause.span


def _is_premise(sentence: Sequence[Atom], verb: Atom) -> bool:
    """`brakes because the drone has warned it`: what others wait for may come at any time."""
    before = [a for a in sentence if a.end <= verb.start]
    opening = [a for a in before if a.kind in BREAKS or a.kind is AtomKind.VERB][-1:]
    return any(
        a.key == 'because' or (a.kind is AtomKind.SUBORDINATOR and a.key != 'after')
        for a in opening
    )


def places_of_deeds(spec: ScenarioSpec, atoms: Sequence[Atom]) -> Iterator[Span]:
    """`alerts the ego at Harbor Market when …`: where it is told, not where it begins."""
    for sentence in sentences(atoms):
        tells = None
        for k, atom in enumerate(sentence):
            if atom.kind is AtomKind.VERB or atom.kind is AtomKind.SUBORDINATOR:
                tells = atom if atom.kind is AtomKind.VERB and atom.key in TOLD else None
            elif tells is not None and atom.is_place and k and sentence[k - 1].key == 'at':
                clause = clause_of(spec, atom)
                events = events_in(spec, clause) if clause is not None else []
                part = taking_part(spec, clause) if clause is not None else frozenset()
                moves = any(a.id in part and not _stays(a) for a in spec.agents)
                if moves and events:
                    yield Span(start=sentence[k - 1].start, end=atom.end)


def _stays(agent: GroundAgent) -> bool:
    still = (BehaviorKind.PARK, BehaviorKind.WAIT)
    stands = bool(agent.behaviors) and all(b.kind in still for b in agent.behaviors)
    return stands or agent.type is AgentType.RSU


def contents(spec: ScenarioSpec, atoms: Sequence[Atom]) -> Iterator[Span]:
    """`sends its speed to the ego`, `reports the bus to the ego`: what is said is not simulated.

    Somebody whom the event waits for is no mere content: `reports the van when it comes near`.
    """
    for k, atom in enumerate(atoms):
        if atom.kind is not AtomKind.VERB or atom.key not in TOLD:
            continue
        said = list(takewhile(_of_the_object, atoms[k + 1 :]))
        things = [a for a in said if a.kind in (AtomKind.THING, AtomKind.UNKNOWN)]
        behind = atoms[k + 1 + len(said)].key if k + 1 + len(said) < len(atoms) else ''
        clause = clause_of(spec, atom)
        if clause is None or not (events := events_in(spec, clause)):
            continue
        bodies = frozenset[str]().union(*map(bodies_of, events))
        if things or (behind == 'to' and unnamed(spec, said, bodies)):
            yield clause.span


def _of_the_object(atom: Atom) -> bool:
    return atom.kind not in _ENDS and (atom.kind is not AtomKind.PREPOSITION or atom.key == 'of')


def reactions(spec: ScenarioSpec, atoms: Sequence[Atom]) -> Iterator[Span]:
    """`it alerts the ego car when the bus stops. The ego car brakes`: because it was told so?

    As a behaviour of its own that begins long before the message is sent.
    """
    for event in spec.events:
        sent = event.action
        if not isinstance(sent, SendMessage) or event.span is None:
            continue
        for agent in spec.agents:
            for behavior in agent.behaviors if agent.id == sent.receiver else ():
                span = behavior.span
                if behavior.kind not in _REACTS or behavior.duration_s is not None:
                    continue
                if span is not None and span.start >= event.span.end:
                    yield span


def landings_when_told(spec: ScenarioSpec, atoms: Sequence[Atom]) -> Iterator[Span]:
    """`the car sends a message to the drone, and the drone lands`: when that is there?"""
    acts = [e.action for e in spec.events]
    for event in spec.events:
        sent = event.action
        if not isinstance(sent, SendMessage) or event.span is None:
            continue
        lands = any(isinstance(a, UavAction) and a.uav == sent.receiver and a.lands for a in acts)
        if lands or all(uav.id != sent.receiver for uav in spec.uavs):
            continue
        for atom in atoms:
            landing = atom.kind is AtomKind.VERB and atom.key in ('land', 'return_home')
            if landing and atom.start >= event.span.end:
                yield over(atom, atom)
