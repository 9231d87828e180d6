# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What words say and elements do not: the checks after the assembly, for every reader.

Each check compares the words of encoded clauses with what they became and returns the characters
that the specification does not carry. Those are admitted as not encoded, so that a run of the rest
is never called verified. A check reads tagged atoms and the specification, not how it came about.

To add one, write a function `(ScenarioSpec, atoms) -> spans` and list it in `_CHECKS`. It is worth
its place when it is right about most of the prompts that it demotes (`make bench-fidelity`).
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from itertools import takewhile

from aurora_core.parsing.atoms import Atom, AtomKind
from aurora_core.parsing.named_bodies import (
    strangers,
    taking_part,
    unnamed,
    within,
    without_part,
)
from aurora_core.parsing.telling_words import untold
from aurora_core.spec.parameter import Span
from aurora_core.spec.scenario import (
    AgentAction,
    Clause,
    Event,
    GroundAgent,
    ScenarioSpec,
    SendMessage,
    TimeTrigger,
    bodies_of,
)
from aurora_core.spec.vocabulary import AgentType, BehaviorKind, ClauseStatus, MissionMode

_Check = Callable[[ScenarioSpec, Sequence[Atom]], Iterable[Span]]
_TOLD = frozenset({'alert', 'report', 'send'})
_LETS = frozenset({'lets', 'letting'})
_LETS_PASS = frozenset({'cross', 'go', 'overtake', 'pass'})
# What tells of a flight: verbs, `an orbit`, `a patrol`, `back again`.
_FLOWN = frozenset(
    {AtomKind.VERB, AtomKind.PATTERN, AtomKind.THEN, AtomKind.HAPPENING, AtomKind.ROUTE}
)
_ENDS = frozenset({AtomKind.VERB, AtomKind.SUBORDINATOR, AtomKind.STOP, AtomKind.COMMA})
_DURING = frozenset({'while'})


def doubtful(spec: ScenarioSpec, atoms: Sequence[Atom]) -> list[Span]:
    """Return the characters of encoded clauses that the specification does not carry.

    Args:
        spec: The specification as it stands.
        atoms: All atoms of the prompt as tagged, where they stand in it.
    """
    found = {span.start: span for check in _CHECKS for span in check(spec, atoms)}
    return [found[start] for start in sorted(found)]


def _sentences(atoms: Sequence[Atom]) -> Iterator[list[Atom]]:
    sentence: list[Atom] = []
    for atom in atoms:
        if atom.kind is AtomKind.STOP and atom.key != ';':
            yield sentence
            sentence = []
        else:
            sentence.append(atom)
    yield sentence


def _clause_of(spec: ScenarioSpec, atom: Atom) -> Clause | None:
    """Return the encoded clause that holds a word, None where it is unread or in no clause."""
    holding = [c for c in spec.clauses if c.span.start <= atom.start and atom.end <= c.span.end]
    if any(c.status is ClauseStatus.NOT_ENCODED for c in holding):
        return None
    return next((c for c in holding if c.ids), None)


def _events_in(spec: ScenarioSpec, clause: Clause) -> list[Event]:
    return [e for e in spec.events if e.id in clause.ids]


def _named_in_orders(spec: ScenarioSpec, clause: Clause) -> bool:
    return any({o.first, o.then} & set(clause.ids) for o in spec.orders)


def _untied_effects(spec: ScenarioSpec, atoms: Sequence[Atom]) -> Iterator[Span]:
    """`alerts the ego when a van comes near and climbs to 60 m`: it climbs then, not before."""
    for sentence in _sentences(atoms):
        acts = causes = False
        for k, atom in enumerate(sentence):
            if atom.kind is AtomKind.SUBORDINATOR:
                causes = acts and atom.key == 'when'
            if atom.kind is not AtomKind.VERB:
                continue
            acts = True
            joined = k and sentence[k - 1].kind is AtomKind.CONJUNCTION
            clause = _clause_of(spec, atom) if causes and joined else None
            if clause is None or _events_in(spec, clause) or _named_in_orders(spec, clause):
                continue
            if set(clause.ids) <= {m.id for m in spec.missions} | {u.id for u in spec.uavs}:
                yield clause.span


def _other_receivers(spec: ScenarioSpec, atoms: Sequence[Atom]) -> Iterator[Span]:
    """`sends its speed to the ego` that became a message to somebody else."""
    for sentence in _sentences(atoms):
        sends = None
        for k, atom in enumerate(sentence):
            if atom.kind is AtomKind.VERB:
                sends = atom if atom.key in _TOLD else None
            elif atom.kind is AtomKind.SUBORDINATOR:
                sends = None
            elif sends is not None and atom.is_actor and k and sentence[k - 1].key == 'to':
                clause = _clause_of(spec, sends)
                if clause is None:
                    continue
                told = [e.action for e in _events_in(spec, clause)]
                told_to = frozenset(a.receiver for a in told if isinstance(a, SendMessage))
                if told_to and unnamed(spec, [atom], told_to):
                    yield clause.span


def _watched_while_hovering(spec: ScenarioSpec, atoms: Sequence[Atom]) -> Iterator[Span]:
    """`hovers over the market and monitors a bus` that became a flight behind the bus."""
    missions = {m.id: m for m in spec.missions}
    for sentence in _sentences(atoms):
        hovers: Clause | None = None
        for atom in sentence:
            if atom.kind in (AtomKind.THEN, AtomKind.SUBORDINATOR, AtomKind.CONTEXT):
                hovers = None
            if atom.kind is not AtomKind.VERB:
                continue
            clause = _clause_of(spec, atom)
            if atom.key != 'observe' or hovers is None or clause is None:
                hovers = clause if atom.key == 'hover' else None
                continue
            before = {missions[i].uav for i in hovers.ids if i in missions}
            now = [missions[i] for i in clause.ids if i in missions]
            if any(m.mode is MissionMode.TRACK and m.uav in before for m in now):
                yield clause.span


def _flights_without_verb(spec: ScenarioSpec, atoms: Sequence[Atom]) -> Iterator[Span]:
    """`two drones hover at 40 m and 60 m, the first one at 60 m`: no flight after the first."""
    told: set[str] = set()
    bare: dict[str, Span] = {}
    for clause in spec.clauses:
        if any(a.kind in _FLOWN for a in within(atoms, clause.span)):
            told |= set(clause.ids)
        elif clause.status is ClauseStatus.ENCODED:
            bare |= dict.fromkeys(clause.ids, clause.span)
    for mission in spec.missions:
        others = [m for m in spec.missions if m.uav == mission.uav and m is not mission]
        if mission.id in bare and mission.id not in told and others:
            yield bare[mission.id]


def _causeless_messages(spec: ScenarioSpec, atoms: Sequence[Atom]) -> Iterator[Span]:
    """`alerts the ego while it climbs`: a message at no time, beside what goes on meanwhile."""
    waited = {getattr(e.trigger, 'event', None) for e in spec.events}
    ordered = {name for o in spec.orders for name in (o.first, o.then)}
    for sentence in _sentences(atoms):
        for atom in sentence:
            if atom.kind is not AtomKind.VERB or atom.key not in _TOLD:
                continue
            clause = _clause_of(spec, atom)
            loose = clause is not None and any(
                e.trigger is None and e.id not in waited | ordered
                for e in _events_in(spec, clause)
            )
            if (
                clause is not None
                and loose
                and any(a.kind is AtomKind.SUBORDINATOR and a.key in _DURING for a in sentence)
            ):
                yield clause.span


def _let_pass(spec: ScenarioSpec, atoms: Sequence[Atom]) -> Iterator[Span]:
    """`stops and lets a pedestrian cross`: who lets somebody pass waits for that."""
    yields = any(b.kind is BehaviorKind.YIELD for a in spec.agents for b in a.behaviors) or any(
        isinstance(e.action, AgentAction)
        and (e.action.do == 'yield' or (e.trigger and not isinstance(e.trigger, TimeTrigger)))
        for e in spec.events
    )
    for k, atom in enumerate(atoms):
        if atom.kind is not AtomKind.CAUSATIVE or atom.words not in _LETS or yields:
            continue
        rest = list(atoms[k + 1 : k + 3])
        passes = len(rest) == 2 and rest[0].is_actor and rest[1].key in _LETS_PASS
        clause = _clause_of(spec, rest[1]) if passes else None
        if clause is not None:
            yield clause.span


def _places_of_deeds(spec: ScenarioSpec, atoms: Sequence[Atom]) -> Iterator[Span]:
    """`alerts the ego at Harbor Market when …`: where it is told, not where it begins."""
    for sentence in _sentences(atoms):
        tells = None
        for k, atom in enumerate(sentence):
            if atom.kind is AtomKind.VERB or atom.kind is AtomKind.SUBORDINATOR:
                tells = atom if atom.kind is AtomKind.VERB and atom.key in _TOLD else None
            elif tells is not None and atom.is_place and k and sentence[k - 1].key == 'at':
                clause = _clause_of(spec, atom)
                events = _events_in(spec, clause) if clause is not None else []
                part = taking_part(spec, clause) if clause is not None else frozenset()
                moves = any(a.id in part and not _stays(a) for a in spec.agents)
                if moves and events:
                    yield Span(start=sentence[k - 1].start, end=atom.end)


def _stays(agent: GroundAgent) -> bool:
    still = (BehaviorKind.PARK, BehaviorKind.WAIT)
    stands = bool(agent.behaviors) and all(b.kind in still for b in agent.behaviors)
    return stands or agent.type is AgentType.RSU


def _contents(spec: ScenarioSpec, atoms: Sequence[Atom]) -> Iterator[Span]:
    """`sends its speed to the ego`, `reports the bus to the ego`: what is said is not simulated.

    Somebody whom the event waits for is no mere content: `reports the van when it comes near`.
    """
    for k, atom in enumerate(atoms):
        if atom.kind is not AtomKind.VERB or atom.key not in _TOLD:
            continue
        said = list(takewhile(_of_the_object, atoms[k + 1 :]))
        things = [a for a in said if a.kind in (AtomKind.THING, AtomKind.UNKNOWN)]
        behind = atoms[k + 1 + len(said)].key if k + 1 + len(said) < len(atoms) else ''
        clause = _clause_of(spec, atom)
        if clause is None or not (events := _events_in(spec, clause)):
            continue
        bodies = frozenset[str]().union(*map(bodies_of, events))
        if things or (behind == 'to' and unnamed(spec, said, bodies)):
            yield clause.span


def _of_the_object(atom: Atom) -> bool:
    return atom.kind not in _ENDS and (atom.kind is not AtomKind.PREPOSITION or atom.key == 'of')


def _telling(spec: ScenarioSpec, atoms: Sequence[Atom]) -> Iterable[Span]:
    return untold(spec)


_CHECKS: tuple[_Check, ...] = (
    _telling,
    without_part,
    strangers,
    _other_receivers,
    _untied_effects,
    _watched_while_hovering,
    _flights_without_verb,
    _causeless_messages,
    _let_pass,
    _places_of_deeds,
    _contents,
)
