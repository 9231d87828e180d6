# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Who does what another was told to do: `…, and so does the taxi`, `the van does the same`."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from itertools import takewhile

from aurora_core.parsing.atom_runs import LOOSE, skip, stop_at, text_of
from aurora_core.parsing.atoms import Atom, AtomKind, NounKind
from aurora_core.parsing.lexicon import shipped_lexicon
from aurora_core.parsing.measures import SPEED
from aurora_core.parsing.morphology import VerbForm

_BREAKS = (AtomKind.COMMA, AtomKind.CONJUNCTION, AtomKind.STOP)
_AS = ('so', 'as', 'and so')
_VALUES = (AtomKind.MEASURE, AtomKind.PREPOSITION, AtomKind.RELATION, AtomKind.THEN, AtomKind.FILL)
_SOONER_OR_LATER = ('before', 'after')
_STANDS_FOR = frozenset({'trace', 'be', 'keep', 'do so'})
_MOVES = frozenset({'be', 'drive', 'move', 'come'})


def alike(atoms: Sequence[Atom], prompt: str) -> list[Atom]:
    """Return the atoms with the predicate said once more for everybody who shares it."""
    written: list[Atom] = []
    i = 0
    while i < len(atoms):
        opens = not written or written[-1].kind in _BREAKS
        next_one = _next(atoms, i)
        found = _sharer(atoms, i, prompt) if opens and next_one is None else next_one
        told = _predicate(written, atoms[found[0]]) if found is not None else None
        if found is None or told is None:
            written.append(atoms[i])
            i += 1
            continue
        begin, stop, resume = found
        pause: list[Atom] = []
        while written[-1].kind in _BREAKS and written[-1].kind is not AtomKind.STOP:
            pause = [stop_at(written.pop())]
        who = list(atoms[begin:stop])
        if next_one is not None:  # not the values of the first one
            told = told[:1] + list(takewhile(lambda a: a.kind not in _VALUES, told[1:]))
            who = [atoms[i], *who]
        rest = resume < len(atoms) and atoms[resume].kind not in _BREAKS
        said = told[:1] if rest else told
        written += [*pause, *who, replace(said[0], form=VerbForm.THIRD), *said[1:]]
        i = resume
    return written


def _next(atoms: Sequence[Atom], i: int) -> tuple[int, int, int] | None:
    """`A lands first, then B`, `A lands before B`: the second, at the end of the sentence."""
    then = atoms[i].kind is AtomKind.THEN
    lands = atoms[i].words in _SOONER_OR_LATER and i > 0 and atoms[i - 1].key == 'land'
    stop = _named(atoms, skip(atoms, i + 1)) if then or lands else None
    if stop is None or (stop < len(atoms) and atoms[stop].kind is not AtomKind.STOP):
        return None
    return skip(atoms, i + 1), stop, stop


def _sharer(atoms: Sequence[Atom], i: int, prompt: str) -> tuple[int, int, int] | None:
    """Return where they are named who share the predicate, and where the text goes on."""
    words = shipped_lexicon().turns
    if text_of(atoms[i], prompt) in _AS:  # `so does the taxi`, `as is the taxi`
        verb = skip(atoms, i + 1)
        who = verb + 1
        if who >= len(atoms) or not _stands_for(atoms[verb], prompt):
            return None
        stop = _named(atoms, who)
        return None if stop is None else (who, stop, stop)
    for who in range(i + 1, min(i + 6, len(atoms))):
        if atoms[who].noun is None or not atoms[who].is_actor:
            continue
        said = prompt[atoms[i].start : atoms[who].start].lower().strip()
        stop = _named(atoms, who) if said in words['the_same_for'] else None
        if stop is not None:
            return who, stop, stop
        break
    stop = _named(atoms, i)
    if stop is None or stop >= len(atoms):
        return None
    end = next((k for k in range(stop, len(atoms)) if atoms[k].kind in _BREAKS), len(atoms))
    said = prompt[atoms[stop].start : atoms[end - 1].end].lower() if end > stop else ''
    return (i, stop, end) if said in words['does_the_same'] else None


def _stands_for(atom: Atom, prompt: str) -> bool:
    """`does`, `is`, `should`, `ought`: in place of the whole predicate."""
    if atom.kind is AtomKind.VERB:
        return atom.key in _STANDS_FOR
    return atom.kind is AtomKind.AUXILIARY or text_of(atom, prompt) == 'ought'


def _named(atoms: Sequence[Atom], i: int) -> int | None:
    """Return the end of the nouns of actors that begin here, None when there is none."""
    if i >= len(atoms) or not atoms[i].is_actor:
        return None
    while (
        i + 2 < len(atoms) and atoms[i + 1].kind is AtomKind.CONJUNCTION and atoms[i + 2].is_actor
    ):
        i += 2
    return i + 1


def _predicate(written: Sequence[Atom], who: Atom) -> list[Atom] | None:
    """Return the verb of the clause in front and what hangs on it."""
    stop = len(written)
    while stop and written[stop - 1].kind in _BREAKS:
        stop -= 1
    begin = stop
    while begin and written[begin - 1].kind is not AtomKind.STOP:
        begin -= 1
    told = list(written[begin:stop])
    verbs = [k for k, a in enumerate(told) if a.kind is AtomKind.VERB]
    if not verbs or any(a.kind in (AtomKind.SUBORDINATOR, AtomKind.RELATIVE) for a in told):
        return None
    acting = next((a for a in reversed(told[: verbs[-1]]) if a.is_actor), None)
    if acting is None or not _of_a_kind(acting, who):
        return None
    if any(a.kind is AtomKind.NEGATION for a in told):
        return None
    return told[verbs[-1] :]


def _of_a_kind(one: Atom, other: Atom) -> bool:
    """Return whether both fly, or neither does; a pronoun may mean either."""
    kinds = [a.noun.kind for a in (one, other) if a.noun is not None]
    return NounKind.PRONOUN in kinds or kinds.count(NounKind.UAV) in (0, 2)


def as_fast(atoms: Sequence[Atom], prompt: str) -> list[Atom]:
    """`the taxi is just as fast`, `… drives at the same speed`: the speed told last, once more."""
    told = shipped_lexicon().turns['as_fast']
    written: list[Atom] = []
    speed: Atom | None = None
    i = 0
    while i < len(atoms):
        atom = atoms[i]
        speed = atom if atom.key == SPEED and atom.measure is not None else speed
        written.append(atom)
        i += 1
        moves = atom.kind is AtomKind.VERB and atom.key in _MOVES
        if not moves or speed is None:
            continue
        end = i
        while end < len(atoms) and atoms[end].kind not in _BREAKS:
            end += 1
        said = prompt[atoms[i].start : atoms[end - 1].end].lower() if end > i else ''
        if said in told and all(a.kind in (*LOOSE, *_SMALL) for a in atoms[i:end]):
            first, last = atoms[i].start, atoms[end - 1].end
            at = Atom(kind=AtomKind.PREPOSITION, key='at', start=first, end=last)
            written[-1] = replace(atom, key='drive')
            written += [at, replace(speed, start=first, end=last)]
            i = end
    return written


_SMALL = (AtomKind.SUBORDINATOR, AtomKind.PREPOSITION, AtomKind.THING, AtomKind.UNKNOWN)
