# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Small words in what is said of places, written out before clauses are cut.

`we drive 20 m behind a bus`, `the bus itself waits`, `parked roadside`, `starts 45 m back`.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from aurora_core.parsing.atom_runs import HELPERS, by_sentence
from aurora_core.parsing.atoms import Atom, AtomKind, Determiner, NounKind, NounPhrase
from aurora_core.parsing.measures import COUNT, LENGTH, SPEED
from aurora_core.parsing.morphology import VerbForm
from aurora_core.parsing.pieces import MARKERS

_WE = ('we', 'i')
# What drivers say of themselves, beside a place or a speed.
_DRIVEN = frozenset(
    {'be', 'drive', 'follow', 'approach', 'overtake', 'tailgate', 'wait', 'stop', 'come', 'start'}
    | {'keep', 'brake', 'slow', 'cross', 'park', 'change_lane', 'turn_left', 'turn_right', 'trace'}
)
_OF_OTHERS = frozenset({'follow', 'approach', 'overtake', 'tailgate'})
_STANDING = frozenset({'park', 'wait', 'stop'})
_ITSELF = ('itself', 'themselves', 'himself', 'herself')


def told_of_us(atoms: Sequence[Atom]) -> list[Atom]:
    """`we drive 20 m behind a bus`: who speaks sits in the ego vehicle."""
    told: list[Atom] = []
    for i, atom in enumerate(atoms):
        if atom.kind is AtomKind.CONTEXT and atom.words.split()[0] in _WE:
            be = Atom(
                kind=AtomKind.VERB,
                key='be',
                start=atom.start + len(atom.words.split()[0]),
                end=atom.end,
                form=VerbForm.THIRD,
            )
            if _drives([be, *atoms[i + 1 :]], 0):
                told += [_ego(atom, be.start), be]
                continue
        if atom.kind is AtomKind.UNKNOWN and atom.words in _WE:
            verb = i + 1
            while verb < len(atoms) and atoms[verb].kind in HELPERS:
                verb += 1
            if verb < len(atoms) and _drives(atoms, verb):
                told.append(_ego(atom, atom.end))
                continue
        told.append(atom)
    return told


def _ego(atom: Atom, end: int) -> Atom:
    noun = NounPhrase(kind=NounKind.EGO, key='i', start=atom.start, end=end, head_text='we')
    return replace(atom, kind=AtomKind.NOUN, key='i', end=end, noun=noun, words='we')


def _drives(atoms: Sequence[Atom], verb: int) -> bool:
    """Return whether the clause says where or how fast somebody drives."""
    act = atoms[verb]
    if act.kind is not AtomKind.VERB or act.key not in _DRIVEN:
        return False
    for i in range(verb + 1, len(atoms)):
        atom = atoms[i]
        if atom.kind is AtomKind.STOP or atom.kind in MARKERS:
            return False
        if atom.kind in (AtomKind.VERB, AtomKind.UNKNOWN):
            return False  # `we are working on a car`
        if atom.key == SPEED and atom.measure is not None:
            return True
        ground = atom.is_actor and atom.noun is not None and atom.noun.kind is not NounKind.UAV
        if ground and (atoms[i - 1].kind is AtomKind.RELATION or act.key in _OF_OTHERS):
            return True
    return False


def placing_words(atoms: Sequence[Atom]) -> list[Atom]:
    """Write out what is left unsaid of places."""
    told = list(_themselves(atoms))
    return _back(_bare_places(_lane_numbers(_in_between(list(told)))))


def _themselves(atoms: Sequence[Atom]) -> list[Atom]:
    """`the bus itself waits`: nobody else."""
    kept: list[Atom] = []
    for atom in atoms:
        before = kept[-1] if kept else None
        again = atom.is_actor and atom.words in _ITSELF
        # Behind a word nobody knows, too: `a van has squeezed itself in to the left of the bus`.
        mere = before is not None and before.kind in (AtomKind.RELATIVE, AtomKind.UNKNOWN)
        if again and before is not None and (before.is_actor or mere):
            kept.append(replace(atom, kind=AtomKind.FILL, noun=None))
        else:
            kept.append(atom)
    return kept


def _in_between(atoms: Sequence[Atom]) -> list[Atom]:
    """`the ego, with a bus in front, drives at 9 m/s`: who else is there is told behind."""

    def told(sentence: list[Atom]) -> list[Atom]:
        commas = [i for i, a in enumerate(sentence) if a.kind is AtomKind.COMMA]
        opens = len(commas) > 1 and sentence[commas[0] + 1].key == 'with'
        opens = opens and commas[0] > 0 and sentence[commas[0] - 1].is_actor
        closes = commas[1] if opens else 0
        apart = sentence[commas[0] : closes] if opens else []
        rest = sentence[closes + 1 :]
        verbless = not any(a.kind is AtomKind.VERB for a in (*sentence[: closes + 1],))
        acts = bool(rest) and rest[0].kind in (AtomKind.VERB, AtomKind.AUXILIARY)
        if apart and verbless and acts and any(a.is_actor for a in apart):
            return [*sentence[: commas[0]], *rest, *apart]
        return _members_between(sentence, commas)

    return by_sentence(atoms, told)


def _members_between(sentence: list[Atom], commas: list[int]) -> list[Atom]:
    """`two vans, one ahead of it, one behind it, drive at 9 m/s`: what both of them do first."""
    if len(commas) < 2 or not sentence[commas[0] - 1].is_actor or commas[0] == 0:
        return sentence
    share = sentence[commas[0] + 1]
    close = commas[-1]
    verb = next((a for a in sentence[close + 1 :] if a.kind not in HELPERS), None)
    verbless = not any(a.kind is AtomKind.VERB for a in sentence[:close])
    if share.key != 'one' or not share.is_actor or verb is None or not verbless:
        return sentence
    if verb.kind is not AtomKind.VERB:
        return sentence
    return [*sentence[: commas[0]], *sentence[close + 1 :], *sentence[commas[0] : close]]


def _lane_numbers(atoms: Sequence[Atom]) -> list[Atom]:
    """`in lane 2 right beside it`: the number names a lane, it is no distance."""
    told = list(atoms)
    for i in range(1, len(told)):
        noun = told[i - 1].noun
        lane = noun is not None and noun.kind is NounKind.STREET and noun.key == 'lane'
        if lane and told[i].key == COUNT and told[i].measure is not None:
            told[i] = replace(told[i], kind=AtomKind.UNKNOWN, key=told[i].words, measure=None)
    return told


def _bare_places(atoms: Sequence[Atom]) -> list[Atom]:
    """`two trucks parked roadside`: at the roadside."""
    written: list[Atom] = []
    for atom in atoms:
        before = written[-1] if written else None
        noun = atom.noun
        bare = noun is not None and noun.kind is NounKind.PLACE and atom.words == noun.head_text
        bare = bare and noun is not None and noun.determiner is Determiner.BARE
        stands = before is not None and before.key in _STANDING
        stands = stands and before is not None and before.kind is AtomKind.VERB
        if bare and before is not None and stands:
            key = 'on' if atom.key in _ROADS else 'at'
            written.append(
                Atom(kind=AtomKind.PREPOSITION, key=key, start=before.end, end=atom.start)
            )
        written.append(atom)
    return written


_ROADS = ('main_road', 'sidewalk')


def _back(atoms: Sequence[Atom]) -> list[Atom]:
    """`starts 45 m back`: behind; `behind the van, some 45 m back`: so far behind it."""
    written: list[Atom] = []
    for i, atom in enumerate(atoms):
        before = written[-1] if written else None
        if (
            atom.words not in ('back', 'further back', 'farther back')
            or before is None
            or before.measure is None
            or before.key != LENGTH
        ):
            written.append(atom)
            continue
        behind = _behind_whom(written)
        later = atoms[i + 1] if i + 1 < len(atoms) else None
        if behind is not None:
            far = written.pop()
            while written[-1].kind is AtomKind.COMMA:
                written.pop()
            written.insert(behind, far)
        elif later is None or later.kind not in (AtomKind.VERB, AtomKind.NOUN):
            written.append(replace(atom, kind=AtomKind.RELATION, key='behind'))
        else:
            written.append(atom)
    return written


def _behind_whom(written: Sequence[Atom]) -> int | None:
    """Return where the word is that the distance belongs to: `behind the van, 45 m`."""
    k = len(written) - 2
    while k > 1 and written[k].kind is AtomKind.COMMA:
        k -= 1
    told = k > 1 and written[k].is_actor and written[k - 1].key == 'behind'
    bare = told and written[k - 1].kind is AtomKind.RELATION and written[k - 2].measure is None
    return k - 1 if bare else None
