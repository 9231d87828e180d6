# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Shorthand and second thoughts, written out before clauses are cut.

`drone A: hover …`, `up to 30 m, wait there`, `over which a drone hovers`, `at 40 m, no, 50 m`.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

from aurora_core.parsing.atom_runs import stop_at, text_of
from aurora_core.parsing.atoms import Atom, AtomKind, NounKind
from aurora_core.parsing.lexicon import shipped_lexicon
from aurora_core.parsing.measures import LENGTH, TIME
from aurora_core.parsing.morphology import VerbForm
from aurora_core.parsing.pieces import MOST_ATOMS, TRANSPARENT
from aurora_core.parsing.rewriting.clefts import plain_order
from aurora_core.parsing.rewriting.conjunctions import joined
from aurora_core.parsing.rewriting.enumerations import told_once
from aurora_core.parsing.rewriting.flight_nouns import flights
from aurora_core.parsing.rewriting.inversions import straighten
from aurora_core.parsing.rewriting.members import members
from aurora_core.parsing.rewriting.message_causes import messages_told
from aurora_core.parsing.rewriting.moments import dated
from aurora_core.parsing.rewriting.nominal import predicates
from aurora_core.parsing.rewriting.nominal_causes import verbal
from aurora_core.parsing.rewriting.not_before import not_before
from aurora_core.parsing.rewriting.placing_words import placing_words, told_of_us
from aurora_core.parsing.rewriting.radio import radio
from aurora_core.parsing.rewriting.roles import cast
from aurora_core.parsing.rewriting.shared_out import shared_out, shares
from aurora_core.parsing.rewriting.statements import value_statements
from aurora_core.parsing.rewriting.then_words import in_front, ways
from aurora_core.parsing.rewriting.wrapping import unwrap
from aurora_core.spec.parameter import Bound, Span

_BREAKS = (AtomKind.COMMA, AtomKind.STOP, AtomKind.THEN, AtomKind.CONJUNCTION)
_PAUSES = (AtomKind.COMMA, AtomKind.STOP, AtomKind.FILL, AtomKind.UNKNOWN, AtomKind.THING)
_MOST_BETWEEN = 9


@dataclass(frozen=True, slots=True, kw_only=True)
class Rewritten:
    """The atoms to cut into clauses; what the speaker took back, and what asks for nothing."""

    atoms: tuple[Atom, ...]
    taken_back: tuple[Span, ...] = ()
    background: tuple[Span, ...] = ()


def longest_sentence(atoms: Sequence[Atom]) -> int:
    """Return the number of atoms of the longest sentence."""
    longest = length = 0
    for atom in atoms:
        length = 0 if atom.kind is AtomKind.STOP else length + 1
        longest = max(longest, length)
    return longest


def rewrite(atoms: Sequence[Atom], prompt: str) -> Rewritten:
    """Return the atoms with shorthand written out and retracted numbers left out."""
    if longest_sentence(atoms) > MOST_ATOMS:
        return Rewritten(atoms=tuple(atoms))
    told, background = unwrap(joined(_cast(atoms, prompt), prompt), prompt)
    told = shared_out(not_before(told), prompt)
    told = dated(verbal(radio(told, prompt), prompt), prompt)
    told = value_statements(
        predicates(plain_order(_places(shares(placing_words(told)), prompt), prompt), prompt),
        prompt,
    )
    kept, spans = _take_back(straighten(told, prompt))
    told = in_front(_labels(_asides(_contrasts(kept))))
    return Rewritten(
        atoms=tuple(_relatives(_climbs(ways(told, prompt), prompt))),
        taken_back=tuple(spans),
        background=tuple(background),
    )


def _cast(atoms: Sequence[Atom], prompt: str) -> list[Atom]:
    """Return the atoms with words for actors and messages as such."""
    told = told_once(members(told_of_us(atoms)))
    return messages_told(flights(cast(told, prompt)), prompt)


def _take_back(atoms: list[Atom]) -> tuple[list[Atom], list[Span]]:
    """`at 40 m, sorry, 50 m`: the first number does not count."""
    spans: list[Span] = []
    i = 0
    while i < len(atoms):
        begin = _retracted(atoms, i)
        if begin is not None:
            spans.append(Span(start=atoms[begin].start, end=atoms[i].end))
            del atoms[begin : i + 1]
            i = begin
        i += 1
    return atoms, spans


def _retracted(atoms: Sequence[Atom], i: int) -> int | None:
    """Return where the number or the weather begins that the words at i take back."""
    atom = atoms[i]
    denied = atom.kind is AtomKind.NEGATION and atom.key == 'no' and _comma_at(atoms, i + 1)
    if not denied and not _takes_back(atom):
        return None
    behind = next((a for a in atoms[i + 1 : i + 4] if a.kind is not AtomKind.COMMA), None)
    if behind is None or _said(behind) is None:
        return None
    paused = False
    for j in range(i - 1, max(-1, i - 1 - _MOST_BETWEEN), -1):
        before = atoms[j]
        again = _takes_back(before)  # `no sorry make that 50 m`
        if _said(before) is not None:
            return j if paused and _said(before) == _said(behind) else None
        paused = paused or again or before.kind in (AtomKind.COMMA, AtomKind.STOP)
        if not again and before.kind not in _PAUSES and before.key != 'no':
            return None
    return None


def _takes_back(atom: Atom) -> bool:
    return atom.kind is AtomKind.FRAME and atom.key in shipped_lexicon().turns['takes_back']


def _said(atom: Atom) -> str | None:
    """Return what a correction may replace: a quantity, the weather, the time of day."""
    if atom.measure is not None:
        return atom.key
    return atom.key.partition(':')[0] if atom.kind is AtomKind.WORLD else None


def _places(atoms: list[Atom], prompt: str) -> list[Atom]:
    """`a crosswalk; 30 m before it a truck is parked`: where, and what `it` can only mean."""
    changed = list(atoms)
    place: Atom | None = None
    acted = False
    for i, atom in enumerate(atoms):
        before = changed[i - 1] if i else None
        if place is not None and _is_same_road(atom, before, place, prompt):
            changed[i] = replace(place, start=atom.start, end=atom.end)
            continue
        upstream = before is not None and before.key == 'before'
        if atom.kind is AtomKind.SUBORDINATOR and atom.key == 'before':
            if before is not None and before.key == LENGTH and before.measure is not None:
                changed[i] = replace(atom, kind=AtomKind.PREPOSITION)
        elif atom.is_place and (atom.noun is None or atom.noun.kind is not NounKind.PRONOUN):
            place = atom
        elif place is not None and atom.key == 'it' and atom.is_actor and before is not None:
            governed = before.kind in (AtomKind.PREPOSITION, AtomKind.RELATION)
            if governed and (upstream or not acted):
                changed[i] = replace(place, start=atom.start, end=atom.end)
        acted = acted or (atom.is_actor and atom.key != 'it')
    return _overhead(changed)


def _overhead(atoms: list[Atom]) -> list[Atom]:
    """`a bus stops at the crosswalk, a drone hovering above at 30 m`: above the one place."""
    written: list[Atom] = []
    places: dict[str, Atom] = {}
    for i, atom in enumerate(atoms):
        written.append(atom)
        if atom.is_place and atom.noun is not None and atom.noun.kind is not NounKind.PRONOUN:
            places.setdefault(atom.key, atom)
        before = atoms[i - 1] if i else None
        behind = atoms[i + 1] if i + 1 < len(atoms) else None
        alone = behind is None or behind.kind in (AtomKind.PREPOSITION, *_BREAKS)
        above = atom.kind is AtomKind.PREPOSITION and atom.words == 'above'
        flown = before is not None and before.kind is AtomKind.VERB and before.key in _STAYING
        if above and alone and flown and len(places) == 1:
            (place,) = places.values()
            written.append(replace(place, start=atom.start, end=atom.end))
        if flown and 'main_road' in places and atom.words in _ABOVE_A_ROAD:
            written[-1] = replace(atom, kind=AtomKind.PREPOSITION, key='over')
            written.append(replace(places['main_road'], start=atom.start, end=atom.end))
    return written


_ABOVE_A_ROAD = ('above the road', 'above the street', 'above the carriageway')
_STAYING = frozenset({'hover', 'orbit', 'wait', 'keep'})


def _is_same_road(atom: Atom, before: Atom | None, place: Atom, prompt: str) -> bool:
    """`two cars are on the main road; a drone flies over this road`."""
    noun = atom.noun
    if noun is None or noun.kind is not NounKind.STREET or before is None or noun.plural:
        return False
    words = text_of(atom, prompt).split()
    again = words[0] in ('the', 'this', 'that') and words[-1] in ('road', 'street', 'carriageway')
    return again and place.key == 'main_road' and before.key in ('over', 'along', 'around')


def _comma_at(atoms: Sequence[Atom], i: int) -> bool:
    return i < len(atoms) and atoms[i].kind is AtomKind.COMMA


def _asides(atoms: list[Atom]) -> list[Atom]:
    """`drives at 50 km/h and, at 15 s, brakes`: no commas around the time of what follows."""
    kept = list(atoms)
    for i in range(len(kept) - 1, 0, -1):
        if kept[i].kind is not AtomKind.COMMA or kept[i - 1].kind not in _OPENS_ASIDE:
            continue
        close = i + 1
        while close < len(kept) and kept[close].kind in _OF_A_TIME:
            close += 1
        times = [a for a in kept[i + 1 : close] if a.key == TIME]
        behind = kept[close : close + 2]
        if not times or len(behind) < 2 or behind[0].kind is not AtomKind.COMMA:
            continue
        if behind[1].kind is AtomKind.VERB and behind[1].form is not VerbForm.ING:
            del kept[close]
            del kept[i]
    return kept


def _contrasts(atoms: list[Atom]) -> list[Atom]:
    """`tracks the motorcycle, not the van, from 30 m`: who is not meant is nobody's object."""
    kept: list[Atom] = []
    i = 0
    while i < len(atoms):
        told = [a for a in atoms[i : i + 5] if a.kind is not AtomKind.FILL]
        denied = (
            len(told) > 2
            and told[0].kind is AtomKind.COMMA
            and told[1].kind is AtomKind.NEGATION
            and told[1].words == 'not'
            and told[2].is_actor
        )
        close = atoms.index(told[2]) + 1 if denied else len(atoms)
        if denied and close < len(atoms) and atoms[close].kind in (AtomKind.COMMA, AtomKind.STOP):
            i = close + (atoms[close].kind is AtomKind.COMMA)
            continue
        kept.append(atoms[i])
        i += 1
    return kept


_OPENS_ASIDE = (AtomKind.RELATIVE, AtomKind.CONJUNCTION, AtomKind.NOUN)
_OF_A_TIME = (
    AtomKind.PREPOSITION,
    AtomKind.MEASURE,
    AtomKind.FROM_START,
    AtomKind.FILL,
    AtomKind.SUBORDINATOR,
)


def _labels(atoms: list[Atom]) -> list[Atom]:
    """`uav B: orbit the park`: one actor in front of a colon is who acts."""
    changed = list(atoms)
    solid: list[Atom] = []
    for i, atom in enumerate(atoms):
        if atom.kind is not AtomKind.STOP:
            if atom.kind not in TRANSPARENT:
                solid.append(atom)
            continue
        noun = solid[0].noun if len(solid) == 1 else None
        one = noun is not None and noun.count <= 1 and not noun.plural
        if atom.key == ':' and one and solid[0].is_actor:
            changed[i] = replace(atom, kind=AtomKind.FILL)
        solid = []
    return changed


def _climbs(atoms: list[Atom], prompt: str) -> list[Atom]:
    """`drone up to 30 m`: behind a UAV or a pause, it is a climb and no upper bound."""
    written: list[Atom] = []
    flying = False
    for i, atom in enumerate(atoms):
        measure = atom.measure
        before = written[-1] if written else None
        flying = flying or (atom.noun is not None and atom.noun.kind is NounKind.UAV)
        if (
            measure is not None
            and atom.key == LENGTH
            and flying
            and before is not None
            and prompt[atom.start : measure.start].lower().strip() == 'up to'
            and (before.is_actor or before.kind in _BREAKS)
            and _ends_here(atoms, i + 1)
        ):
            up = atom.start + len('up')
            written += [
                Atom(
                    kind=AtomKind.VERB,
                    key='ascend',
                    start=atom.start,
                    end=up,
                    form=VerbForm.THIRD,
                ),
                Atom(kind=AtomKind.PREPOSITION, key='to', start=up, end=measure.start),
                replace(
                    atom,
                    start=measure.start,
                    measure=replace(measure, bound=Bound.EXACTLY),
                ),
            ]
        else:
            written.append(atom)
    return written


def _ends_here(atoms: Sequence[Atom], i: int) -> bool:
    """`up to 30 m, …`, `up to 30 m over the park, …`: a climb goes no further."""
    place = i + 1 < len(atoms) and atoms[i].key in ('over', 'at') and atoms[i + 1].is_place
    i += 2 if place else 0
    return i >= len(atoms) or atoms[i].kind in _BREAKS


def _relatives(atoms: list[Atom]) -> list[Atom]:
    """`…, over which a drone hovers`: a sentence about the noun in front of it."""
    written: list[Atom] = []
    for atom in atoms:
        governed = written and written[-1].kind in (AtomKind.PREPOSITION, AtomKind.RELATION)
        if atom.kind is AtomKind.RELATIVE and atom.key != 'that' and governed:
            about = next((a for a in reversed(written) if a.is_actor or a.is_place), None)
            if about is not None:
                word = written.pop()
                stop = stop_at(word)
                if written and written[-1].kind is AtomKind.COMMA:
                    written.pop()
                written += [stop, word, replace(about, start=atom.start, end=atom.end)]
                continue
        written.append(atom)
    return written
