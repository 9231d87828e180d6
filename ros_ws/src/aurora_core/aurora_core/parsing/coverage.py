# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The last check: every number, named actor and telling word of the prompt went somewhere."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import takewhile

from pydantic import BaseModel

from aurora_core.parsing.atom_runs import text_of
from aurora_core.parsing.atoms import ACTORS, Atom, AtomKind, NounKind
from aurora_core.parsing.measures import COUNT
from aurora_core.parsing.resolver import Resolver
from aurora_core.spec.parameter import Parameter, Span
from aurora_core.spec.scenario import Clause, ScenarioSpec
from aurora_core.spec.vocabulary import ClauseStatus

# A group beyond this many is cut: it is refused as too many in any case.
_MOST = 200
_RANKS = ('first', 'last', 'earlier', 'sooner', 'next')
_WHERE = 'where'
_NO_ACTORS = (NounKind.PRONOUN, NounKind.UNSUPPORTED, NounKind.AMBIGUOUS)


def unaccounted(
    spec: ScenarioSpec,
    atoms: Sequence[Atom],
    resolver: Resolver,
    *,
    no_uavs: bool,
    understood: Sequence[Span] = (),
) -> list[Span]:
    """Return the numbers and named actors that no element and no unread clause accounts for.

    Args:
        spec: The specification as it stands.
        atoms: All atoms of the prompt.
        resolver: Knows which noun phrases became actors.
        no_uavs: The prompt says that there is no UAV: naming one is not asking for it.
        understood: Clauses that were read word by word.
    """
    stated = [p.span for p in parameters(spec) if p.span is not None]
    unread = [c.span for c in spec.clauses if c.status is ClauseStatus.NOT_ENCODED]
    lost: list[Span] = []
    for atom in atoms:
        span = Span(start=atom.start, end=atom.end)
        if any(_inside(span, clause) for clause in (*unread, *understood)):
            continue
        if atom.measure is not None:
            number = Span(start=atom.measure.start, end=atom.measure.end)
            if not any(_inside(number, known) for known in stated):
                lost.append(span)
        elif atom.noun is not None:
            noun = atom.noun
            names = noun.kind in ACTORS and noun.kind not in _NO_ACTORS
            forgotten = names and not resolver.known(noun) and not resolver.denied(noun)
            if no_uavs and noun.kind is NounKind.UAV:
                forgotten = False
            counted = not names and noun.count > 0 and noun.kind is not NounKind.UNKNOWN
            digits = any(c.isdigit() for c in spec.prompt[atom.start : atom.end])
            became = len(resolver.known(noun)) if names else 0
            miscounted = digits and became > 0 and became != noun.count > 0
            miscounted = miscounted and became <= _MOST
            if forgotten or miscounted or (counted and (digits or noun.count != 1)):
                lost.append(span)
    lost += _forgotten_places(spec, atoms)
    ordered = [o.span for o in spec.orders if o.span is not None]
    for span in _telling(spec.prompt, atoms):
        if not any(_inside(span, known) for known in unread + ordered):
            lost.append(span)
    return lost


def in_no_clause(atoms: Sequence[Atom], clauses: Sequence[Clause]) -> list[Span]:
    """Return the numbers that no clause holds: rewriting left them behind.

    Counts are left to `unaccounted`: `the number of cars is four` becomes four cars.
    """
    told = [a for a in atoms if a.measure is not None and a.measure.dimension != COUNT]
    numbers = [Span(start=a.start, end=a.end) for a in told]
    return [n for n in numbers if not any(_meets(n, c.span) for c in clauses)]


def _telling(prompt: str, atoms: Sequence[Atom]) -> Iterator[Span]:
    """Return small words that change the meaning where they stand, though mostly they are filler.

    `lands first`, unless it goes on with `then`; `at the same height`: as high as somebody else.
    """
    for k, atom in enumerate(atoms):
        word = text_of(atom, prompt)
        before = atoms[k - 1] if k else None
        after = atoms[k + 1 :]
        if word in _RANKS and before is not None and before.kind is AtomKind.VERB:
            sentence = takewhile(lambda a: a.kind is not AtomKind.STOP or a.key == ';', after)
            if not any(a.kind is AtomKind.THEN for a in sentence):
                yield _covering(before, atom)
        elif word == 'same' and after and after[0].kind is AtomKind.THING:
            yield _covering(atom, after[0])


def _forgotten_places(spec: ScenarioSpec, atoms: Sequence[Atom]) -> Iterator[Span]:
    """Return `City Hall, where` when nothing is placed there: who is told of behind it is not.

    That a place is flown over or tracked puts nobody at it.
    """
    taken = {p.of for agent in spec.agents for p in agent.placements}
    taken |= {b.target for agent in spec.agents for b in agent.behaviors}
    for k, atom in enumerate(atoms):
        before = [a for a in atoms[max(0, k - 2) : k] if a.kind is not AtomKind.COMMA][-1:]
        told = atom.kind is AtomKind.FRAME and atom.key == _WHERE
        who = next((a.noun for a in atoms[k + 1 : k + 2]), None)
        told = told and who is not None and who.kind in (NounKind.AGENT, NounKind.VEHICLE)
        if told and before and before[0].is_place:
            place = before[0].key
            if place not in taken and f'landmark:{place}' not in taken:
                yield _covering(before[0], atom)


def _covering(first: Atom, last: Atom) -> Span:
    """Return the characters from one word to the other, whichever stands first."""
    return Span(start=min(first.start, last.start), end=max(first.end, last.end))


def _meets(one: Span, other: Span) -> bool:
    return one.start < other.end and other.start < one.end


def _inside(inner: Span, outer: Span) -> bool:
    return outer.start <= inner.start and inner.end <= outer.end


def parameters(value: object) -> Iterator[Parameter]:
    """Yield every number of a specification, or of a part of it."""
    if isinstance(value, Parameter):
        yield value
    elif isinstance(value, BaseModel):
        for _, inner in value:
            yield from parameters(inner)
    elif isinstance(value, tuple):
        for inner in value:
            yield from parameters(inner)
