# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Whoever a clause names has a part in what the clause became.

`reports the bus to the ego car` that became a message from the drone to the ego car says nothing
of the bus; `no other vehicle comes near the bus` that became a distance of the drone is about
somebody else. It looks at words and specification alone, whoever wrote that.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from functools import lru_cache
from itertools import pairwise, zip_longest

from pydantic import BaseModel

from aurora_core.parsing.atoms import Atom, AtomKind, Determiner, NounKind, NounPhrase
from aurora_core.parsing.doubts.clauses import (
    Same,
    clause_of,
    meet,
    sentences,
    stretch,
    within,
)
from aurora_core.spec.parameter import Span
from aurora_core.spec.scenario import (
    AgentAction,
    Clause,
    MessageTrigger,
    ScenarioSpec,
    SendMessage,
    bodies_of,
)
from aurora_core.spec.vocabulary import AgentType, BehaviorKind, ClauseStatus, Relation, Role

_ON_FOOT = frozenset({AgentType.PEDESTRIAN, AgentType.RSU})
_FINITE = frozenset({AtomKind.VERB, AtomKind.AUXILIARY})
# Verbs that only say that somebody is there.
_PRESENTS = frozenset({'be', 'contain', 'put', 'see'})
_TRANSITIVE = frozenset(
    {
        *('alert', 'approach', 'follow', 'observe', 'overtake', 'report', 'send', 'tailgate'),
        *('track', 'yield'),
    }
)
_OWN_NUMBER = re.compile(r'\W(?:\d+|[A-Za-z])$')
# What is left of a noun that is told behind the next one.
_HALF = re.compile(r'(?:a|an|one|the) \w+$', re.IGNORECASE)
# Of whom one is aware before something happens to them, which the next clause tells.
_AWAITS = frozenset({'see', 'wait'})
_ENDED = frozenset({'no longer'})
# What stands before somebody who was not there before.
_NEW = frozenset({Determiner.INDEFINITE, Determiner.ONE})
_NAMED = frozenset({NounKind.AGENT, NounKind.VEHICLE, NounKind.UAV, NounKind.EGO})


def without_part(spec: ScenarioSpec, atoms: Sequence[Atom]) -> list[Span]:
    """Return the actors of encoded clauses that no element of their clause is about.

    Args:
        spec: The specification as it stands.
        atoms: All atoms of the prompt as tagged, where they stand in it.
    """
    unread = [c.span for c in spec.clauses if c.status is ClauseStatus.NOT_ENCODED]
    clauses = sorted(spec.clauses, key=lambda c: c.span.start)
    lost = []
    for clause, following in zip(clauses, (*clauses[1:], None), strict=True):
        words = within(atoms, clause.span)
        if clause.status is ClauseStatus.NOT_ENCODED or not clause.ids or _of_kinds(spec, clause):
            continue
        if any(a.kind is AtomKind.NEGATION and a.key in _ENDED for a in words):
            continue  # what it does no longer is told by the phase before
        part = taking_part(spec, clause) | _told_of(spec, clause)
        awaits = any(a.kind is AtomKind.VERB and a.key in _AWAITS for a in words)
        if following is not None and awaits:
            part |= taking_part(spec, following)
        lost += [
            span
            for span in unnamed(spec, words, part)
            if not any(u.start <= span.start and span.end <= u.end for u in unread)
        ]
    return lost


def _told_of(spec: ScenarioSpec, clause: Clause) -> frozenset[str]:
    """Return whom somebody lets pass on a message: whoever that is about."""
    waited = {
        e.trigger.by
        for e in spec.events
        if e.id in clause.ids
        and isinstance(e.trigger, MessageTrigger)
        and isinstance(e.action, AgentAction)
        and e.action.do == 'yield'
    }
    sent = (e for e in spec.events if isinstance(e.action, SendMessage))
    about = [bodies_of(e) for e in sent if getattr(e.action, 'receiver', None) in waited]
    return frozenset[str]().union(*about)


def idle(spec: ScenarioSpec, atoms: Sequence[Atom]) -> Iterator[Span]:
    """`overtakes the bus and the car`: whom a verb is about, and nothing of the scene is.

    Who is somewhere, and in no clause (`flies a patrol along Main Street`), is nothing, either.
    """
    bodies = bodies_called(spec)
    told = {name for clause in spec.clauses for name in clause.ids}
    about: set[str] = set()
    for agent in spec.agents:
        parts = (*agent.placements, *agent.behaviors)
        somewhere = agent.id in told or any(p.of in bodies for p in agent.placements)
        about |= {agent.id} if agent.behaviors or (parts and somewhere) else set()
        about |= {word for part in parts for word in _strings(part)}
    others = (*spec.missions, *spec.events, *spec.conditions, *spec.links, *spec.prohibitions)
    about |= {word for one in others for word in _strings(one)}
    for sentence in sentences(atoms):
        acts = False
        for k, atom in enumerate(sentence):
            if atom.kind is AtomKind.VERB:
                acts = atom.key not in _PRESENTS
            elif atom.kind is AtomKind.COMMA and sentence[k + 1 : k + 2]:
                acts = acts and sentence[k + 1].kind in (AtomKind.CONJUNCTION, AtomKind.THEN)
            named = list(_named([atom], spec.prompt, bodies)) if acts else []
            if not named or any(a.kind is AtomKind.VERB for a in stretch(sentence, k + 1)):
                continue
            for name, span in named:
                meant = {who for who, names in bodies.items() if name in names}
                if not meant & about and clause_of(spec, atom) is not None:
                    yield span


def meeting(spec: ScenarioSpec, atoms: Sequence[Atom]) -> Iterator[Span]:
    """`an oncoming truck passes the ego car`: they meet, which is no overtaking."""
    for agent in spec.agents:
        comes_to = {p.of for p in agent.placements if p.relation is Relation.ONCOMING}
        for behavior in agent.behaviors:
            overtakes = behavior.kind is BehaviorKind.OVERTAKE
            if overtakes and behavior.target in comes_to and behavior.span is not None:
                yield behavior.span


def crowded(spec: ScenarioSpec, atoms: Sequence[Atom]) -> Iterator[Span]:
    """`the motorcycle escapes the police car`: `escapees`, corrected where a verb has to stand."""
    text = spec.prompt.lower()
    for before, atom, behind in zip(atoms, atoms[1:], atoms[2:], strict=False):
        actors = before.is_actor and atom.is_actor and behind.is_actor
        if actors and atom.words not in text:
            yield Span(start=atom.start, end=atom.end)


def halved(spec: ScenarioSpec, atoms: Sequence[Atom]) -> Iterator[Span]:
    """`a red and a blue car drive`: the red one is a car that drives, too."""
    for clause in spec.clauses:
        if clause.status is not ClauseStatus.NO_REQUIREMENT or not _HALF.match(clause.text):
            continue
        behind = next((a for a in atoms if a.start >= clause.span.end), None)
        if behind is not None and behind.kind is AtomKind.CONJUNCTION:
            yield clause.span


def listed(spec: ScenarioSpec, atoms: Sequence[Atom]) -> Iterator[Span]:
    """`overtakes the bus, the car and the van`: of a list of objects each one has to be meant."""
    bodies = bodies_called(spec)
    objects = _objects(spec)
    for sentence in sentences(atoms):
        for k, verb in enumerate(sentence):
            if verb.kind is not AtomKind.VERB or verb.key not in _TRANSITIVE:
                continue
            nouns, end = _list_from(sentence, k + 1)
            goes_on = end < len(sentence) and sentence[end].kind in (
                *(AtomKind.VERB, AtomKind.AUXILIARY, AtomKind.RELATIVE),
            )
            joined = any(a.kind is AtomKind.CONJUNCTION for a in sentence[k + 1 : end])
            if len(nouns) < 2 or not joined or clause_of(spec, verb) is None:
                continue
            for name, span in _named(nouns[: -1 if goes_on else None], spec.prompt, bodies):
                if not any(name in bodies[who] for who in objects & bodies.keys()):
                    yield span


def _list_from(sentence: Sequence[Atom], start: int) -> tuple[list[Atom], int]:
    """Return the actors that stand in a row, and what is behind: `a bus, a car and a van`."""
    nouns: list[Atom] = []
    k = start
    while k < len(sentence):
        atom = sentence[k]
        if atom.is_actor and not (nouns and sentence[k - 1].is_actor):
            nouns.append(atom)
        elif atom.kind not in (AtomKind.COMMA, AtomKind.CONJUNCTION, AtomKind.FILL):
            break
        k += 1
    return nouns, k


def _objects(spec: ScenarioSpec) -> set[str]:
    """Return the bodies that something is done to or measured from."""
    found: set[str] = set()
    for agent in spec.agents:
        found |= {b.target for b in agent.behaviors if b.target is not None}
        found |= {p.of for p in agent.placements if p.of is not None}
    found |= {m.target for m in spec.missions if m.target is not None}
    others = (*spec.events, *spec.conditions, *spec.prohibitions)
    return found | {word for one in others for word in _strings(one)}


def places_without_part(spec: ScenarioSpec, atoms: Sequence[Atom]) -> Iterator[Span]:
    """`stops at City Hall; 5 s later it starts`: a place that the act, an event, leaves out."""
    for clause in spec.clauses:
        if clause.status is not ClauseStatus.ENCODED or not clause.ids:
            continue
        told = _told(spec, clause)
        words = within(atoms, clause.span)
        for atom, behind in zip_longest(words, words[1:]):
            noun = atom.noun
            if noun is None or noun.kind not in (NounKind.PLACE, NounKind.LANDMARK):
                continue
            if behind is not None and behind.is_actor and behind.start - atom.end == 1:
                continue  # `a crossing pedestrian`
            if atom.start == clause.span.start:
                continue  # `Park a drone above it`: a verb, where the map has a park
            if noun.key == 'crosswalk' and _crosses(spec, told):
                continue  # one crosses on it, wherever that is
            if not told & {noun.key, f'landmark:{noun.key}'} and clause_of(spec, atom) is not None:
                yield Span(start=atom.start, end=atom.end)


def _crosses(spec: ScenarioSpec, part: set[str]) -> bool:
    """Whether one of these bodies crosses a road."""
    walks = {a.id for a in spec.agents for b in a.behaviors if b.kind is BehaviorKind.CROSS}
    acts = [e.action for e in spec.events if isinstance(e.action, AgentAction)]
    return bool(part & (walks | {a.agent for a in acts if a.do == 'cross'}))


def twins(spec: ScenarioSpec, atoms: Sequence[Atom]) -> Iterator[Span]:
    """`a drone circles the drone that hovers`: two of a kind that became one."""
    if len(spec.uavs) != 1:
        return
    for sentence in sentences(atoms):
        told = [a for a in sentence if a.kind is not AtomKind.FILL]
        for k, atom in enumerate(told):
            noun = atom.noun
            if noun is None or noun.kind is not NounKind.UAV or clause_of(spec, atom) is None:
                continue
            if any(a.kind in _FINITE for a in stretch(told, k + 1)):
                continue  # `after it has stopped | the drone warns the ego`
            done_to = (k > 0 and told[k - 1].kind is AtomKind.VERB) or _above(told[:k])
            earlier = [
                j
                for j, b in enumerate(told[:k])
                if b.noun is not None and b.noun.kind is NounKind.UAV
            ]
            # `the drone that tracks the bus hovers; the drone that tracks the taxi lands`
            told_apart = _described(told, k) and any(_described(told, j) for j in earlier)
            if told_apart or (done_to and earlier):
                yield Span(start=atom.start, end=atom.end)


def _described(told: Sequence[Atom], k: int) -> bool:
    """Tell whether a relative clause says which one a noun means."""
    return k + 1 < len(told) and told[k + 1].kind is AtomKind.RELATIVE


def denied(spec: ScenarioSpec, atoms: Sequence[Atom]) -> Iterator[Span]:
    """`no car exceeds 40 km/h. Two cars drive`: of whom nobody does so is no body more."""
    for k, (no, atom) in enumerate(pairwise(atoms)):
        noun = atom.noun
        if no.kind is not AtomKind.NEGATION or no.words != 'no' or noun is None:
            continue
        if noun.kind not in _NAMED or clause_of(spec, atom) is None:
            continue
        others = (b.noun for b in atoms[k + 2 :] if b.noun is not None)
        same = [b for b in others if (b.kind, b.key) == (noun.kind, noun.key)]
        if any(b.count > 1 or b.determiner in _NEW for b in same):
            yield Span(start=no.start, end=atom.end)


def _above(before: Sequence[Atom]) -> bool:
    """`flies 10 m above | the drone`."""
    relations = [a.key for a in before[-1:] if a.kind is AtomKind.PREPOSITION]
    return any(key in ('above', 'around', 'over') for key in relations)


def gapped(spec: ScenarioSpec, atoms: Sequence[Atom]) -> Iterator[Span]:
    """`a truck is parked on the right and a van on the left`: the van is parked, too."""
    bodies = bodies_called(spec)
    does = {a.id for a in spec.agents if a.behaviors}
    does |= {word for e in (*spec.events, *spec.missions) for word in _strings(e)}
    for sentence in sentences(atoms):
        verb: Atom | None = None
        for k, atom in enumerate(sentence):
            verb = atom if atom.kind is AtomKind.VERB else verb
            joined = atom.kind is AtomKind.CONJUNCTION and verb is not None
            if not joined or verb is None or verb.key in _PRESENTS:
                continue
            told = stretch(sentence, k + 1)
            if any(a.key == 'with' and verb.end <= a.start for a in sentence[:k]):
                continue  # `drives with a bus ahead and a van behind`
            placed = any(a.kind in (AtomKind.PREPOSITION, AtomKind.RELATION) for a in told)
            if any(a.kind in (AtomKind.VERB, AtomKind.AUXILIARY) for a in told) or not placed:
                continue
            subject = next((a for a in told if a.is_actor), None)
            if subject is None or clause_of(spec, subject) is None:
                continue
            where = Span(start=told[0].start, end=told[-1].end)
            placed_here = {
                a.id
                for a in spec.agents
                if any(p.span is not None and meet(p.span, where) for p in a.placements)
            }
            for name, _ in _named(told, spec.prompt, bodies):
                meant = {who for who, names in bodies.items() if name in names}
                if meant & placed_here and not meant & does:
                    yield where
                    break


def unnamed(spec: ScenarioSpec, words: Sequence[Atom], part: frozenset[str]) -> list[Span]:
    """Return the words that name somebody of the scene who is none of these bodies."""
    bodies = bodies_called(spec)
    named = _named(words, spec.prompt, bodies)
    return [span for name, span in named if not any(name in bodies[who] for who in part)]


def numbered(spec: ScenarioSpec, atoms: Sequence[Atom]) -> Iterator[Span]:
    """`the second intersection`, `the other truck` where there is one: an ordinal for nobody."""
    bodies = bodies_called(spec)
    for atom in atoms:
        noun = atom.noun
        if noun is None or clause_of(spec, atom) is None:
            continue
        own = _OWN_NUMBER.search(f' {spec.prompt[noun.start : noun.end]}')
        rank = 0 if own else noun.index
        if noun.kind in (NounKind.PLACE, NounKind.LANDMARK):
            lost = rank > 0
        else:
            one = noun.key if noun.kind is NounKind.AGENT else noun.kind.value
            count = sum(one in names for names in bodies.values())
            least = 2 if noun.determiner is Determiner.OTHER else rank
            lost = 0 < count < least or (rank > 0 and noun.determiner is Determiner.ALL)
        if lost:
            yield Span(start=atom.start, end=atom.end)


def _of_kinds(spec: ScenarioSpec, clause: Clause) -> bool:
    """A clause about kinds of bodies (`no other bicycle`), not about those that are there."""
    counted = any(c.id in clause.ids for c in spec.counts)
    return counted or any(p.id in clause.ids for p in spec.prohibitions)


def strangers(spec: ScenarioSpec, atoms: Sequence[Atom]) -> list[Span]:
    """Return the relative clauses that became something about another than whom they describe.

    `the second drone, which hovers at 60 m` that became a hover of the first.
    """
    found = []
    for before, atom in pairwise(a for a in atoms if a.kind is not AtomKind.COMMA):
        if atom.kind is not AtomKind.RELATIVE:
            continue
        following = (c for c in spec.clauses if c.span.end > atom.end)
        clause = min(following, key=lambda c: c.span.start, default=None)
        if clause is None or clause.status is not ClauseStatus.ENCODED or not clause.ids:
            continue
        if unnamed(spec, [before], taking_part(spec, clause)):
            found.append(clause.span)
    return found


def bodies_called(spec: ScenarioSpec) -> dict[str, frozenset[str]]:
    """Return what each body can be called: its type, the wider words for it, `the second van`."""
    called = {}
    types = [a.type for a in spec.agents]
    for k, agent in enumerate(spec.agents):
        rank = types[: k + 1].count(agent.type)
        names = {agent.type.value, f'{agent.type.value} {rank}'}
        if agent.type not in _ON_FOOT:
            names.add(NounKind.VEHICLE)
        if agent.role is Role.EGO:
            names.add(NounKind.EGO)
        called[agent.id] = frozenset(names)
    for rank, uav in enumerate(spec.uavs, start=1):
        called[uav.id] = frozenset({NounKind.UAV, f'{NounKind.UAV} {rank}'})
    return called


def _named(
    atoms: Sequence[Atom], prompt: str, bodies: dict[str, frozenset[str]]
) -> Iterator[tuple[str, Span]]:
    """Yield what somebody of the scene is called by; of others `coverage` takes care."""
    for atom in atoms:
        if atom.noun is not None:
            name = _name(atom.noun, prompt)
            if any(name in names for names in bodies.values()):
                yield name, Span(start=atom.start, end=atom.end)


def called(atom: Atom | None, prompt: str) -> str:
    """Return what a word calls somebody by name, empty when it names nobody."""
    return _name(atom.noun, prompt) if atom is not None and atom.noun is not None else ''


def _name(noun: NounPhrase, prompt: str) -> str:
    """Return what a phrase calls somebody, empty when it names nobody.

    A number or letter of its own (`drone B`) is a name, and says nothing of an order.
    """
    if noun.kind not in _NAMED:
        return ''
    called = noun.key if noun.kind is NounKind.AGENT else noun.kind.value
    ranked = noun.index and not _OWN_NUMBER.search(prompt[noun.start : noun.end])
    return f'{called} {noun.index}' if ranked else called


def taking_part(spec: ScenarioSpec, clause: Clause) -> frozenset[str]:
    """Return the bodies that the elements of a clause are about, and those these stand beside.

    Its elements are those that it names, and all whose words stand in it.
    """
    bodies = {agent.id for agent in spec.agents} | {uav.id for uav in spec.uavs}
    return frozenset(_told(spec, clause) & bodies)


def _told(spec: ScenarioSpec, clause: Clause) -> set[str]:
    """Return ids and places of the elements of a clause, and of the bodies that take part."""
    elements = _elements(Same(spec))
    told = set(clause.ids)
    told |= {
        name
        for name, parts in elements.items()
        if any(meet(clause.span, span) for spans, _ in parts for span in spans)
    }
    for _ in range(2):
        told |= {word for name in told for _, words in elements.get(name, ()) for word in words}
    return told


# Every clause asks for them again, of one specification after the other.
@lru_cache(maxsize=1)
def _elements(key: Same) -> dict[str, list[tuple[tuple[Span, ...], frozenset[str]]]]:
    """Return the spans and words of the elements of a specification by their ids."""
    spec = key.spec
    parts: list[tuple[str, BaseModel]] = []
    for agent in spec.agents:
        parts += [(agent.id, part) for part in (*agent.placements, *agent.behaviors)]
    for group in (spec.missions, spec.events, spec.conditions, spec.links, spec.orders):
        parts += [(one.id, one) for one in group]
    found: dict[str, list[tuple[tuple[Span, ...], frozenset[str]]]] = {}
    for name, part in parts:
        inside = _parts(part)
        spans = tuple(one for one in inside if isinstance(one, Span))
        words = frozenset(one for one in inside if isinstance(one, str))
        found.setdefault(name, []).append((spans, words))
    return found


def _strings(value: object) -> Iterator[str]:
    return (part for part in _parts(value) if isinstance(part, str))


def _parts(value: object) -> list[object]:
    """Return what a model is made of, down to the plain values and the spans, in no order."""
    found: list[object] = []
    left = [value]
    while left:
        part = left.pop()
        if isinstance(part, tuple):
            left += part
        elif isinstance(part, BaseModel) and not isinstance(part, Span):
            left += vars(part).values()
        else:
            found.append(part)
    return found
