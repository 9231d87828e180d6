# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""A message that somebody gets, told as a noun, written out as `when … receives`.

`on receipt of that warning`, `upon notification`, `after getting the call`, `on the drone's
signal`, `once warned by the drone`, `the bus stops on the message`.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from functools import lru_cache

from aurora_core.parsing.atom_runs import HELPERS, LOOSE, skip, text_of
from aurora_core.parsing.atoms import Atom, AtomKind
from aurora_core.parsing.data_files import read_data
from aurora_core.parsing.lexicon import shipped_lexicon
from aurora_core.parsing.morphology import VerbForm


def messages_told(atoms: Sequence[Atom], prompt: str) -> list[Atom]:
    """Return the atoms with these messages as `alerts`, or as sent."""
    told = list(atoms)
    atoms = tuple(told)
    turns = shipped_lexicon().turns
    for i, atom in enumerate(atoms):
        who = skip(told, i + 1)
        if who >= len(told):
            break
        words = text_of(atom, prompt)
        if words in ('call', 'called'):
            told[i] = replace(atom, kind=AtomKind.UNKNOWN)  # `a drone called Alpha`
        elif told[who].is_actor:
            behind = skip(told, who + 1, HELPERS)
            if behind >= len(told):
                continue
            if words in turns['gives'] and told[behind].kind is AtomKind.MESSAGE:
                told[i] = _alert(atom, words)
            elif words in turns['lets'] and text_of(told[behind], prompt) in turns['know']:
                told[i] = _alert(atom, words)
                told[behind] = replace(told[behind], kind=AtomKind.FILL, noun=None)
        elif words in turns['gives'] and told[who].kind is AtomKind.MESSAGE:
            to = told[who + 1 : who + 3]
            if len(to) == 2 and to[0].key == 'to' and to[1].is_actor:
                told[i] = replace(_alert(atom, words), key='send')
    return told


def _alert(atom: Atom, words: str) -> Atom:
    form = VerbForm.ING if words.endswith('ing') else VerbForm.THIRD
    return replace(atom, kind=AtomKind.VERB, key='alert', form=form)


_ENDS = (AtomKind.STOP, AtomKind.COMMA, AtomKind.THEN, AtomKind.CONJUNCTION)
_OPENING = (AtomKind.PREPOSITION, AtomKind.SUBORDINATOR, AtomKind.BECAUSE, AtomKind.VERB)
_GETS = ('receive', 'come', 'contain')
_MOST_WORDS = 4  # atoms from the opening to its message that say nothing of their own


@lru_cache(maxsize=1)
def _hearing() -> dict[str, list[str]]:
    return dict(read_data('lexicon.yaml')['hearing'])


def heard(atoms: Sequence[Atom], prompt: str) -> list[Atom]:
    """Return the atoms with every message that is a cause as a clause behind `when`."""
    written: list[Atom] = []
    atoms = _owned(atoms, prompt)
    i = 0
    while i < len(atoms):
        told = _cause(atoms, i, prompt)
        if told is None:
            written.append(atoms[i])
            i += 1
            continue
        clause, stop = told
        pause = bool(written) and written[-1].kind is AtomKind.COMMA
        if pause and not _interrupts(written) and _effect_behind(atoms, stop):
            written[-1] = replace(written[-1], kind=AtomKind.CONJUNCTION, key='and')
        written += clause
        if stop < len(atoms) and atoms[stop].is_actor:
            written.append(replace(clause[0], kind=AtomKind.COMMA, key=','))
        i = stop
    return written


def _owned(atoms: Sequence[Atom], prompt: str) -> list[Atom]:
    """`it has got the drone's warning`, `once the drone's warning arrives`: a warning from it."""
    told = list(atoms)
    for i in range(1, len(told) - 2):
        owner, message = told[i], told[i + 2]
        if not owner.is_actor or text_of(told[i + 1], prompt) != "'s":
            continue
        if not _is_message(message, prompt, _hearing()['nouns']):
            continue
        behind = skip(told, i + 3, (*LOOSE, AtomKind.AUXILIARY))
        arrives = behind < len(told) and told[behind].key in ('reach', 'come')
        gets = told[i - 1].kind is AtomKind.VERB and told[i - 1].key in _GETS
        if gets or (arrives and told[i - 1].kind is AtomKind.SUBORDINATOR):
            source = replace(told[i + 1], kind=AtomKind.PREPOSITION, key='from')
            told[i : i + 3] = [replace(message, kind=AtomKind.MESSAGE), source, owner]
    return told


def _interrupts(written: Sequence[Atom]) -> bool:
    """`the bus, on receipt of the message, stops`."""
    return len(written) > 1 and written[-2].is_actor


def _effect_behind(atoms: Sequence[Atom], i: int) -> bool:
    for atom in atoms[i + 1 if i < len(atoms) and atoms[i].kind is AtomKind.COMMA else i :]:
        if atom.kind in (AtomKind.STOP, AtomKind.COMMA):
            return False
        if atom.kind is AtomKind.VERB:
            return True
    return False


def _cause(atoms: Sequence[Atom], i: int, prompt: str) -> tuple[list[Atom], int] | None:
    """Read the cause that begins at i: its clause, and where it ends."""
    opening = atoms[i]
    data = _hearing()
    words = text_of(opening, prompt)
    if words == 'having':
        been = _been_told(atoms, i, prompt)
        return None if been is None else _clause(opening, *been)
    if opening.kind not in _OPENING:
        return None
    because = opening.kind is AtomKind.BECAUSE
    behind = skip(atoms, i + 1)
    if behind < len(atoms) and (because or words in (*data['openings'], *data['when'])):
        warned = _warned(atoms, behind, prompt)
        if warned is not None:
            return _clause(opening, *warned)
    if not because and words not in (*data['openings'], *data['with_receipt']):
        return None
    k, received = _receipt(atoms, i + 1, prompt)
    if not received and words in data['with_receipt']:
        return None
    sender: Atom | None = None
    k = _determiner(atoms, k, prompt)
    if k + 1 < len(atoms) and atoms[k].is_actor:
        owned = text_of(atoms[k + 1], prompt) == "'s"
        if owned or _is_message(atoms[k + 1], prompt, data['nouns']):
            sender, k = atoms[k], k + 2 if owned else k + 1
    k = skip(atoms, k)
    named = k < len(atoms) and _is_message(atoms[k], prompt, data['nouns'])
    if not named and not (received and sender is None and _bare_receipt(atoms, k, prompt)):
        return None
    message = atoms[k if named else k - 1]
    if not received and text_of(message, prompt).split()[-1] in data['contents']:
        return None
    k += named
    receiver: Atom | None = None
    while k + 1 < len(atoms) and atoms[k].kind is AtomKind.PREPOSITION and atoms[k + 1].is_actor:
        if atoms[k].key in ('from', 'of', 'by'):
            sender = atoms[k + 1]
        elif atoms[k].key == 'to':
            receiver = atoms[k + 1]
        else:
            break
        k += 2
    if not received and k < len(atoms) and not atoms[k].is_actor and atoms[k].kind not in _ENDS:
        return None  # `after the warning reaches the car`
    return _clause(opening, message, sender, k, receiver)


def _clause(
    opening: Atom, message: Atom, sender: Atom | None, stop: int, receiver: Atom | None = None
) -> tuple[list[Atom], int]:
    when = replace(
        opening,
        kind=AtomKind.SUBORDINATOR,
        key='when',
        other_kinds=frozenset(),
    )
    verb = replace(
        message,
        kind=AtomKind.VERB,
        key='receive',
        form=VerbForm.ING if receiver is None else VerbForm.THIRD,
        noun=None,
    )
    source = []
    if sender is not None:
        source = [replace(verb, kind=AtomKind.PREPOSITION, key='from'), sender]
    return [when, *([] if receiver is None else [receiver]), verb, *source], stop


def _warned(atoms: Sequence[Atom], i: int, prompt: str) -> tuple[Atom, Atom | None, int] | None:
    """`upon being warned by the drone`, `once notified, …`."""
    k = skip(atoms, i, (*LOOSE, AtomKind.AUXILIARY))
    if k >= len(atoms) or atoms[k].kind is not AtomKind.VERB or atoms[k].key != 'alert':
        return None
    if atoms[k].form is not VerbForm.PAST or text_of(atoms[k], prompt).endswith('ing'):
        return None
    by = atoms[k + 1 : k + 3]
    if len(by) == 2 and by[0].key == 'by' and by[1].is_actor:
        return atoms[k], by[1], k + 3
    return None


def _been_told(atoms: Sequence[Atom], i: int, prompt: str) -> tuple[Atom, Atom | None, int] | None:
    """`having been warned (by the drone), the bus stops`."""
    k = skip(atoms, i + 1, (*LOOSE, AtomKind.AUXILIARY))
    been = any(text_of(a, prompt) == 'been' for a in atoms[i + 1 : k])
    if not been or k >= len(atoms) or atoms[k].key != 'alert' or (i and not _ends(atoms[i - 1])):
        return None
    by = atoms[k + 1 : k + 3]
    named = len(by) == 2 and by[0].key == 'by' and by[1].is_actor
    stop = k + 3 if named else k + 1
    told = stop < len(atoms) and atoms[stop].kind is AtomKind.COMMA
    return (atoms[k], by[1] if named else None, stop) if told else None


def _ends(atom: Atom) -> bool:
    return atom.kind in _ENDS


def _receipt(atoms: Sequence[Atom], i: int, prompt: str) -> tuple[int, bool]:
    """Skip `the receipt of`, `getting`, `having received`."""
    listed = _hearing()['receipt']
    k = i
    while k < len(atoms) and k < i + _MOST_WORDS:
        words = text_of(atoms[k], prompt).removeprefix('the ').removesuffix(' of')
        if words in listed:
            k += 1
            if k < len(atoms) and atoms[k].kind is AtomKind.PREPOSITION and atoms[k].key == 'of':
                k += 1
            return k, True
        if atoms[k].kind not in (*LOOSE, AtomKind.AUXILIARY):
            break
        k += 1
    return i, False


def _bare_receipt(atoms: Sequence[Atom], i: int, prompt: str) -> bool:
    """`on receipt, the drone climbs`; `on arrival` tells of no message."""
    noun = text_of(atoms[i - 1], prompt) in _hearing()['alone']
    return noun and (i == len(atoms) or atoms[i].kind in _ENDS or atoms[i].is_actor)


def _determiner(atoms: Sequence[Atom], i: int, prompt: str) -> int:
    """Skip `that` of `on receipt of that warning`: here it is no relative pronoun."""
    k = skip(atoms, i)
    that = k < len(atoms) and atoms[k].kind is AtomKind.RELATIVE
    return k + 1 if that and text_of(atoms[k], prompt) == 'that' else k


def _is_message(atom: Atom, prompt: str, nouns: Sequence[str]) -> bool:
    if atom.kind is AtomKind.MESSAGE or AtomKind.MESSAGE in atom.other_kinds:
        return text_of(atom, prompt) not in ('receipt', 'delivery')
    if atom.is_actor or atom.is_place:
        return False
    return text_of(atom, prompt).rpartition(' ')[2] in nouns
