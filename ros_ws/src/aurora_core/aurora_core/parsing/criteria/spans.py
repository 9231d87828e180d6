# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Where in a sentence a condition stands: between two pauses, the longest stretch that is one."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache

from aurora_core.parsing.atom_runs import skip
from aurora_core.parsing.atoms import Atom, AtomKind, NounKind
from aurora_core.parsing.criteria.criterion import Criterion
from aurora_core.parsing.criteria.moments import Sequel, sequel
from aurora_core.parsing.criteria.slots import criterion
from aurora_core.parsing.criteria.words import criteria_words
from aurora_core.parsing.pieces import MOST_ATOMS
from aurora_core.spec.parameter import Span

_MOST_UNKNOWN = 4
_MOST_ASIDE = 8
# An aside of these and of unknown words asks for nothing: `as logged by the tracker`.
_SAYS_NOTHING = (
    *(AtomKind.COMMA, AtomKind.FILL, AtomKind.FRAME, AtomKind.PREPOSITION),
    *(AtomKind.SUBORDINATOR, AtomKind.AUXILIARY),
)


def loosely(atoms: Sequence[Atom]) -> Criterion | None:
    """Return the condition that a clause states but for words that nobody knows."""
    unknown = [a for a in atoms if _is_unknown(a)]
    if not unknown or len(unknown) > _MOST_UNKNOWN or any(_changes_meaning(a) for a in unknown):
        return None
    return _left(atoms, unknown) or without_aside(atoms, unknown)


def without_aside(atoms: Sequence[Atom], unknown: Sequence[Atom] = ()) -> Criterion | None:
    """Return the condition that is left without one aside, and without the unknown words."""
    for aside in _asides(atoms):
        found = _left(atoms, [*(a for a in unknown if a not in aside), *aside])
        if found is not None:
            return found
    return None


def _left(atoms: Sequence[Atom], left_out: Sequence[Atom]) -> Criterion | None:
    found = criterion([a for a in atoms if a not in left_out])
    if found is None or not found.topics or not (found.limits or found.share or found.hold):
        return None
    said = [a for a in left_out if a.kind not in _SAYS_NOTHING]
    return replace(found, unread=tuple(Span(start=a.start, end=a.end) for a in said))


def _is_unknown(atom: Atom) -> bool:
    noun = atom.noun is not None and atom.noun.kind is NounKind.UNKNOWN
    return (noun or atom.kind is AtomKind.UNKNOWN) and not _is_word(atom.words)


def _names(atom: Atom) -> bool:
    pronoun = atom.noun is not None and atom.noun.kind is NounKind.PRONOUN
    return atom.is_actor and not pronoun


def _changes_meaning(atom: Atom) -> bool:
    words = criteria_words()
    measured = any(
        one.search(atom.words) for one in (words['names_measured'], words.topics['drift'])
    )
    return measured or words['particular'].search(atom.words) is not None


@lru_cache(maxsize=1024)
def _is_word(text: str) -> bool:
    """Return whether a word stands in one of the lists."""
    words = criteria_words()
    lists = (*words.lists.values(), *words.topics.values(), *words.events.values())
    return any(one.fullmatch(text) for one in lists)


def _asides(atoms: Sequence[Atom]) -> Iterator[tuple[Atom, ...]]:
    """`…, as measured by the tracker, …`: between two commas, without a number or an actor."""
    commas = [i for i, a in enumerate(atoms) if a.kind is AtomKind.COMMA]
    for k, begin in enumerate(commas):
        for end in commas[k + 1 :]:
            inside = atoms[begin : end + 1]
            plain = all(
                a.measure is None and not _names(a) and a.kind is not AtomKind.NEGATION
                for a in inside
            )
            if plain and len(inside) <= _MOST_ASIDE and begin:
                yield tuple(inside)


_PAUSES = (AtomKind.COMMA, AtomKind.CONJUNCTION, AtomKind.THEN)
_CAUSES = ('when', 'after')
_LEADS = ('such', 'so that', 'hence', 'thus', 'so')


@dataclass(frozen=True, slots=True, kw_only=True)
class Stretch:
    """Neighbouring atoms of a sentence, and the condition that they state, if they do."""

    atoms: tuple[Atom, ...]
    criterion: Criterion | Sequel | None = None


def stretches(atoms: Sequence[Atom]) -> list[Stretch]:
    """Cut a sentence into its conditions and what stands around them."""
    may_ask = any(a.measure is not None for a in atoms) or _asks(atoms)
    if not may_ask or len(atoms) > MOST_ATOMS:
        return [Stretch(atoms=tuple(atoms))]
    strict = _cut(atoms, _stated)
    return [part for one in strict for part in ([one] if one.criterion else _loose(one.atoms))]


def _loose(atoms: Sequence[Atom]) -> list[Stretch]:
    """What is left of a sentence, with the conditions in it that have unknown words."""
    if not any(a.measure is not None for a in atoms):
        return [Stretch(atoms=tuple(atoms))]
    return _cut(atoms, lambda all_of, start, stop: (stop, loosely(all_of[start:stop])))


_Made = Criterion | Sequel | None


def _cut(
    atoms: Sequence[Atom],
    state: Callable[[Sequence[Atom], int, int], tuple[int, _Made]],
) -> list[Stretch]:
    """Take out the longest stretches in which `state` finds a condition."""
    starts = [i for i in range(len(atoms)) if i == 0 or _begins(atoms, i)]
    found: list[Stretch] = []
    done = 0
    for start in starts:
        if start < done:
            continue
        for longest in _stops(atoms, start):
            if _is_caused(atoms, start, longest):
                continue
            stop, made = state(atoms, start, longest)
            if made is not None:
                found += _rest(atoms[done:start], opens=done > 0)
                found.append(Stretch(atoms=tuple(atoms[start:stop]), criterion=made))
                done = stop
                break
    found += _rest(atoms[done:], opens=done > 0)
    return found


def _stated(atoms: Sequence[Atom], start: int, stop: int) -> tuple[int, _Made]:
    """Return where the condition or order ends that begins here, and what it is."""
    told = criterion(atoms[start:stop]) or without_aside(atoms[start:stop])
    if told is None:
        return stop, sequel(atoms[start:stop]) if atoms[start].words != 'with' else None
    if _is_detail(atoms[start], told) or _joins(atoms, start, stop):
        return stop, None
    return _first(atoms, start, stop) or (stop, told)


def _is_caused(atoms: Sequence[Atom], start: int, stop: int) -> bool:
    """`once the distance drops below 30 m, the drone should …`: a cause and its effect."""
    opens = start
    while opens and atoms[opens].kind not in (AtomKind.SUBORDINATOR, AtomKind.COMMA):
        opens -= 1
    if atoms[opens].kind is not AtomKind.SUBORDINATOR or atoms[opens].key not in _CAUSES:
        return False
    comma = next((i for i in range(start, stop) if atoms[i].kind is AtomKind.COMMA), stop)
    compared = any(a.measure is not None for a in atoms[start:comma])
    return compared and any(a.is_actor for a in atoms[comma:stop])


def _first(atoms: Sequence[Atom], start: int, stop: int) -> tuple[int, Criterion] | None:
    """`it must take 2 s at most, and it has to arrive`: two of them, when each stands alone."""
    for pause in sorted(_stops(atoms[:stop], start))[:-1]:
        rest = next((i for i in range(pause, stop) if atoms[i].kind not in _PAUSES), stop)
        first = criterion(atoms[start:pause])
        if first is None or rest == stop:
            continue
        if criterion(atoms[rest:stop]) is not None:
            return pause, first
    return None


def _joins(atoms: Sequence[Atom], start: int, stop: int) -> bool:
    """`one at 25 m, and the gap between them must stay above 5 m`: the second alone is one."""
    for pause in _stops(atoms[:stop], start)[1:]:
        rest = skip(atoms, pause, (*_PAUSES, AtomKind.FILL))
        told = rest < stop and (atoms[rest].noun is not None or atoms[rest].kind is AtomKind.THING)
        values = any(a.measure is not None for a in atoms[start:pause])
        if told and values and criterion(atoms[start:pause]) is None:
            alone = criterion(atoms[rest:stop])
            if alone is not None and alone.nouns and alone.limits:
                return True
    return False


def _asks(atoms: Sequence[Atom]) -> bool:
    return any(a.kind is AtomKind.AUXILIARY for a in atoms)


def _begins(atoms: Sequence[Atom], i: int) -> bool:
    pause = atoms[i - 1].kind in _PAUSES and atoms[i].kind not in _PAUSES
    then = atoms[i - 1].kind is AtomKind.THEN
    pause = pause and not (then and i > 1 and atoms[i - 2].kind is AtomKind.SUBORDINATOR)
    pause = pause or _is_wish(atoms[i])
    return pause or atoms[i].words in (*_LEADS, 'with') or _is_own(atoms, i)


def _is_detail(first: Atom, made: Criterion) -> bool:
    """`with an altitude of at least 40 m` is how it is flown, `with a distance of …` a demand."""
    return first.words == 'with' and 'distance' not in made.topics


def _is_own(atoms: Sequence[Atom], i: int) -> bool:
    """`a UAV that hovers there for 45 s | is meant to see it`: the subject is told before."""
    if atoms[i].kind is not AtomKind.AUXILIARY or atoms[i - 1].kind is AtomKind.AUXILIARY:
        return False
    told = any(a.kind is AtomKind.VERB for a in atoms[:i])
    return told and atoms[i - 1].measure is not None


def _is_wish(atom: Atom) -> bool:
    """`… and make sure that …`: what asks for a clause begins it."""
    return atom.kind is AtomKind.FRAME and atom.key in ('wish', 'demand')


def _stops(atoms: Sequence[Atom], start: int) -> list[int]:
    ends = [
        i
        for i in range(start + 1, len(atoms))
        if atoms[i].kind in _PAUSES or (_is_wish(atoms[i]) and not _is_wish(atoms[i - 1]))
    ]
    return sorted([*ends, len(atoms)], reverse=True)


def _rest(atoms: Sequence[Atom], *, opens: bool) -> list[Stretch]:
    """What stands around a condition, without the pauses that part it from it."""
    kept = list(atoms)
    while kept and kept[-1].kind in _PAUSES:
        kept.pop()
    while opens and kept and kept[0].kind in (AtomKind.COMMA, AtomKind.CONJUNCTION):
        kept.pop(0)
    return [Stretch(atoms=tuple(kept))] if kept else []
