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
from itertools import pairwise

from pydantic import BaseModel

from aurora_core.parsing.atoms import Atom, AtomKind, NounKind, NounPhrase
from aurora_core.spec.parameter import Span
from aurora_core.spec.scenario import Clause, ScenarioSpec
from aurora_core.spec.vocabulary import AgentType, ClauseStatus, Role

_ON_FOOT = frozenset({AgentType.PEDESTRIAN, AgentType.RSU})
_OWN_NUMBER = re.compile(r'\W(?:\d+|[A-Za-z])$')
# Of whom one is aware before something happens to them, which the next clause tells.
_AWAITS = frozenset({'see', 'wait'})
_ENDED = frozenset({'no longer'})
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
        part = taking_part(spec, clause)
        awaits = any(a.kind is AtomKind.VERB and a.key in _AWAITS for a in words)
        if following is not None and awaits:
            part |= taking_part(spec, following)
        lost += [
            span
            for span in unnamed(spec, words, part)
            if not any(u.start <= span.start and span.end <= u.end for u in unread)
        ]
    return lost


def unnamed(spec: ScenarioSpec, words: Sequence[Atom], part: frozenset[str]) -> list[Span]:
    """Return the words that name somebody of the scene who is none of these bodies."""
    bodies = _bodies(spec)
    named = _named(words, spec.prompt, bodies)
    return [span for name, span in named if not any(name in bodies[who] for who in part)]


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


def within(atoms: Sequence[Atom], span: Span) -> list[Atom]:
    """Return the atoms that lie wholly within some characters."""
    return [a for a in atoms if span.start <= a.start and a.end <= span.end]


def _bodies(spec: ScenarioSpec) -> dict[str, frozenset[str]]:
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
    parts: list[tuple[str, BaseModel]] = []
    for agent in spec.agents:
        parts += [(agent.id, part) for part in (*agent.placements, *agent.behaviors)]
    parts += [(m.id, m) for m in spec.missions]
    parts += [(e.id, e) for e in spec.events]
    parts += [(c.id, c) for c in spec.conditions]
    parts += [(link.id, link) for link in spec.links]
    parts += [(o.id, o) for o in spec.orders]
    by_id: dict[str, list[BaseModel]] = {}
    for name, part in parts:
        by_id.setdefault(name, []).append(part)
    told = set(clause.ids)
    told |= {name for name, part in parts if any(_meet(clause.span, s) for s in _spans(part))}
    for _ in range(2):
        told |= {word for name in told for part in by_id.get(name, ()) for word in _strings(part)}
    bodies = {agent.id for agent in spec.agents} | {uav.id for uav in spec.uavs}
    return frozenset(told & bodies)


def _meet(one: Span, other: Span) -> bool:
    return one.start < other.end and other.start < one.end


def _spans(value: object) -> Iterator[Span]:
    return (part for part in _parts(value) if isinstance(part, Span))


def _strings(value: object) -> Iterator[str]:
    return (part for part in _parts(value) if isinstance(part, str))


def _parts(value: object) -> Iterator[object]:
    """Yield what a model is made of, down to the plain values and the spans."""
    if isinstance(value, BaseModel) and not isinstance(value, Span):
        for _, inner in value:
            yield from _parts(inner)
    elif isinstance(value, tuple):
        for inner in value:
            yield from _parts(inner)
    else:
        yield value
