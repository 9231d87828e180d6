# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Causes that are no clauses yet, written out as `when …`.

`on the arrival of the bus`, `in response to the truck's braking`, `having seen a cyclist, …`,
`the landing of the drone makes the bus start`, `…, which makes the car brake`.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from aurora_core.parsing.atom_runs import skip, text_of
from aurora_core.parsing.atoms import Atom, AtomKind
from aurora_core.parsing.measures import TIME
from aurora_core.parsing.morphology import VerbForm
from aurora_core.parsing.pieces import TRANSPARENT
from aurora_core.parsing.rewriting.flight_nouns import flight_end
from aurora_core.parsing.rewriting.in_place import interrupted, verbless
from aurora_core.parsing.rewriting.message_causes import heard
from aurora_core.parsing.told_pieces import PHASES
from aurora_core.spec.parameter import Bound

_OPENERS = frozenset({'on', 'upon', 'at', 'with', 'after', 'following', 'by'})
# What the noun behind `of` undergoes: `at the sight of a cyclist`.
_OF_OBJECT = frozenset({'see', 'lose', 'receive', 'finish'})
# What a participle in front of a sentence tells as its cause.
_NOTICED = frozenset({'see', 'lose', 'receive', 'finish', 'reach'})
_COMPLETES = 'complet'
_ENDS = (AtomKind.STOP, AtomKind.COMMA, AtomKind.THEN, AtomKind.CONJUNCTION)


def verbal(atoms: list[Atom], prompt: str) -> list[Atom]:
    """Return the atoms with events that are told as nouns written out as clauses."""
    atoms = interrupted(verbless(heard(atoms, prompt), prompt))
    written = _participles(_nominal(_made_to(atoms, prompt), prompt), prompt)
    return [
        replace(a, kind=AtomKind.UNKNOWN)
        if a.kind in (AtomKind.HAPPENING, AtomKind.BECAUSE, AtomKind.CAUSING)
        else a
        for a in written
    ]


# --- nouns ---


def _nominal(atoms: list[Atom], prompt: str) -> list[Atom]:
    """`on the arrival of the bus at the park`: `when the bus reaches the park`."""
    written: list[Atom] = []
    i = 0
    while i < len(atoms):
        atom = atoms[i]
        lag = _within_of(written, atom)
        opens = (
            lag
            or atom.kind is AtomKind.BECAUSE
            or (
                atom.kind in (AtomKind.PREPOSITION, AtomKind.SUBORDINATOR)
                and text_of(atom, prompt).strip() in _OPENERS
            )
        )
        event = _event(atoms, i + 1, prompt, because=atom.kind is AtomKind.BECAUSE)
        if not opens or event is None:
            written.append(atom)
            i += 1
            continue
        clause, i = event
        when = replace(
            atom,
            kind=AtomKind.SUBORDINATOR,
            key='after' if lag else 'when',
            other_kinds=frozenset(),
        )
        if lag:  # `within 5 s of the van's braking`: at most so long after it
            late = written.pop()
            assert late.measure is not None
            written[-1] = replace(
                late, start=written[-1].start, measure=replace(late.measure, bound=Bound.AT_MOST)
            )
        if written and written[-1].kind is AtomKind.COMMA and _acts_behind(atoms, i):
            written[-1] = replace(written[-1], kind=AtomKind.CONJUNCTION, key='and')
        written += [when, *clause]
        takes = clause[-1].kind is AtomKind.VERB and clause[-1].key not in _OF_OBJECT
        if takes and i < len(atoms) and atoms[i].is_actor:  # `on arrival the bus …`
            written.append(replace(atom, kind=AtomKind.COMMA, key=','))
    return written


def _within_of(written: Sequence[Atom], atom: Atom) -> bool:
    if atom.kind is not AtomKind.PREPOSITION or atom.key != 'of' or len(written) < 2:
        return False
    timed = written[-1].measure is not None and written[-1].key == TIME
    return timed and written[-2].kind is AtomKind.PREPOSITION and written[-2].key == 'within'


def _acts_behind(atoms: Sequence[Atom], i: int) -> bool:
    """Return whether another clause follows behind the next comma."""
    for k in range(i, len(atoms)):
        if atoms[k].kind is AtomKind.STOP:
            return False
        if atoms[k].kind is AtomKind.COMMA:
            return any(a.kind is AtomKind.VERB for a in atoms[k : k + 6])
    return False


def _event(
    atoms: Sequence[Atom], i: int, prompt: str, *, because: bool
) -> tuple[list[Atom], int] | None:
    """Read the event that begins at i as a clause without its link, and where it ends."""
    begin = i
    i = skip(atoms, i)
    if i >= len(atoms):
        return None
    articled = i > begin
    first = atoms[i]
    if first.is_actor:  # `the truck's braking`, `the truck braking`
        k = i + 1
        owned = k < len(atoms) and text_of(atoms[k], prompt) == "'s"
        k = skip(atoms, k)
        if k >= len(atoms) or not (owned or because):
            return None
        named = _named_event(atoms[k], owned=owned)
        if named is None:
            return None
        return [first, named], k + 1 + _skipped(atoms, k + 1, named)
    own = articled and any(text_of(a, prompt) in ('its', 'their') for a in atoms[begin:i])
    named = _named_event(first, owned=articled)
    gerund = first.kind is AtomKind.VERB and first.form is VerbForm.ING
    if named is None:
        return None
    if first.kind is AtomKind.VERB and not gerund and not articled:
        return None
    k = i + 1
    if named.key == 'finish' and k < len(atoms) and atoms[k].key == 'of':
        k = flight_end(atoms, k + 1) or k  # `on completion of the patrol by drone A`
    of = k < len(atoms) and atoms[k].kind is AtomKind.PREPOSITION and atoms[k].key in ('of', 'by')
    who = skip(atoms, k + 1) if of else k
    if of and who < len(atoms) and (atoms[who].noun is not None) and not own:
        if named.key in _OF_OBJECT and atoms[k].key == 'of':
            verb = replace(named, form=VerbForm.ING)
            return [verb, *atoms[k + 1 : who + 1]], who + 1
        verb = replace(named, form=VerbForm.THIRD)
        return [*atoms[k + 1 : who + 1], verb], who + 1 + _skipped(atoms, who + 1, named)
    completes = first.key == 'trace' and first.words.startswith(_COMPLETES)
    if gerund and not (articled or because or completes) and first.key not in _NOTICED:
        return None  # `after hovering`, `by climbing`: the other readers know these
    verb = replace(named, form=VerbForm.ING)
    return [verb], k + _skipped(atoms, k, named)


def _named_event(atom: Atom, *, owned: bool) -> Atom | None:
    """Return the verb of an event noun or of a verb that stands as a noun."""
    if atom.kind is AtomKind.HAPPENING:
        return replace(atom, kind=AtomKind.VERB, form=VerbForm.THIRD)
    if atom.kind is not AtomKind.VERB or atom.key in PHASES:
        return None
    gerund = atom.form is VerbForm.ING
    noun = owned and atom.form is VerbForm.BASE
    return replace(atom, form=VerbForm.THIRD) if gerund or noun else None


def _skipped(atoms: Sequence[Atom], i: int, named: Atom) -> int:
    """Return how many prepositions behind an arrival say nothing of their own."""
    told = named.key == 'reach' and i < len(atoms) and atoms[i].kind is AtomKind.PREPOSITION
    return 1 if told and atoms[i].key in ('at', 'to', 'in', 'on') else 0


# --- participles ---


def _participles(atoms: list[Atom], prompt: str) -> list[Atom]:
    """`seeing a cyclist, the drone …`, `having received it, the car …`, `once warned, …`."""
    written: list[Atom] = []
    done = -1  # the participle behind `having`
    for i, atom in enumerate(atoms):
        if i == done:
            atom = replace(atom, form=VerbForm.ING)
        opens = not written or written[-1].kind in _ENDS
        helped = opens and text_of(atom, prompt) == 'having' and i + 1 < len(atoms)
        verb = atoms[skip(atoms, i + 1)] if helped and skip(atoms, i + 1) < len(atoms) else None
        told = atom if verb is None else verb
        noticed = (
            opens
            and i != done
            and told.kind is AtomKind.VERB
            and (verb is not None or (told.form is VerbForm.ING and told.key in _NOTICED))
            and _subject_behind(atoms, i)
        )
        if noticed and verb is not None and (verb.form is VerbForm.PAST or verb.key == 'come'):
            link = 'after' if verb.key in PHASES else 'when'
            if written and written[-1].kind is AtomKind.COMMA:
                written[-1] = replace(written[-1], kind=AtomKind.CONJUNCTION, key='and')
            word = replace(atom, kind=AtomKind.SUBORDINATOR, key=link)
            written.append(word)
            if link == 'after':
                written.append(replace(atom, kind=AtomKind.AUXILIARY, key='have'))
            else:
                done = skip(atoms, i + 1)
            continue
        if noticed and verb is None:
            if written and written[-1].kind is AtomKind.COMMA:
                written.append(atom)
                continue
            written.append(
                replace(
                    atom,
                    kind=AtomKind.SUBORDINATOR,
                    key='when',
                    end=atom.start + 1,
                    other_kinds=frozenset(),
                )
            )
        written.append(atom)
    return written


def _subject_behind(atoms: Sequence[Atom], i: int) -> bool:
    """Return whether a comma and an actor follow: the participle opens the sentence."""
    for k in range(i + 1, len(atoms)):
        if atoms[k].kind is AtomKind.STOP:
            return False
        if atoms[k].is_actor and atoms[k - 1].kind is not AtomKind.PREPOSITION:
            behind = atoms[k + 1] if k + 1 < len(atoms) else None
            if behind is not None and behind.kind in (AtomKind.VERB, AtomKind.AUXILIARY):
                return True
        if atoms[k].kind is AtomKind.COMMA:
            after = skip(atoms, k + 1)
            return after < len(atoms) and atoms[after].is_actor
    return False


# --- what makes whom do it ---


def _made_to(atoms: list[Atom], prompt: str) -> list[Atom]:
    """`…, which makes the car brake`, `the arrival of the bus makes the drone land`."""
    changed = list(atoms)
    i = 0
    while i < len(changed):
        effect = _effect(changed, i)
        if effect is None:
            i += 1
            continue
        who, verb = effect
        begin = _clause_start(changed, i)
        cause = changed[begin:i]
        solid = [a for a in cause if a.kind not in TRANSPARENT]
        acts = [changed[who], replace(changed[verb], form=VerbForm.THIRD)]
        relative = bool(solid) and all(
            a.kind is AtomKind.RELATIVE or a.key == 'that' for a in solid
        )
        ing = changed[i].form is VerbForm.ING or changed[i].verb_form is VerbForm.ING
        if relative or (not solid and ing and begin):
            then = replace(changed[i], kind=AtomKind.THEN, key='then', start=changed[i].start)
            changed[begin : verb + 1] = [then, *acts]
            i = begin
            continue
        i += 1
    return changed


def _effect(atoms: Sequence[Atom], i: int) -> tuple[int, int] | None:
    """Return where the actor and the verb stand that a causing verb governs."""
    atom = atoms[i]
    if AtomKind.CAUSING not in (*atom.other_kinds, atom.kind):
        return None
    if atom.kind is AtomKind.CAUSATIVE and atom.form is VerbForm.BASE:
        return None  # `make the bus stop`: a request
    who = skip(atoms, i + 1)
    if who >= len(atoms) or not atoms[who].is_actor:
        return None
    k = skip(atoms, who + 1)
    while k < len(atoms) and (
        atoms[k].kind is AtomKind.AUXILIARY or atoms[k].key in ('to', 'into')
    ):
        k += 1
    if k >= len(atoms) or atoms[k].kind is not AtomKind.VERB:
        return None
    plain = atoms[k].form in (VerbForm.BASE, VerbForm.ING)
    return (who, k) if plain else None


def _clause_start(atoms: Sequence[Atom], i: int) -> int:
    k = i
    while k and atoms[k - 1].kind not in (AtomKind.STOP, AtomKind.COMMA, AtomKind.THEN):
        k -= 1
    return k
