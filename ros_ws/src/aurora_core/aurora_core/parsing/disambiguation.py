# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Auxiliary, causative or full verb: decided by what follows."""

from __future__ import annotations

from dataclasses import replace

from aurora_core.parsing.atoms import Atom, AtomKind, NounKind
from aurora_core.parsing.morphology import VerbForm

_SKIPPED = (AtomKind.FILL, AtomKind.NEGATION, AtomKind.AUXILIARY)


def settle_verbs(atoms: list[Atom]) -> list[Atom]:
    """Decide between auxiliary, causative and full verb by what follows."""
    settled = list(atoms)
    for i in range(len(settled) - 1, -1, -1):
        atom = settled[i]
        kinds = atom.other_kinds
        if AtomKind.AUXILIARY in kinds and AtomKind.VERB in kinds:
            kind = AtomKind.AUXILIARY if _verb_follows(settled, i) else AtomKind.VERB
            settled[i] = _as(atom, kind)
        if atom.kind is AtomKind.VERB and atom.key in _PHASES and _gerund_follows(settled, i):
            settled[i] = replace(atom, kind=AtomKind.AUXILIARY)
        if atom.kind is AtomKind.VERB and atom.key == 'finish' and _ground_act_follows(settled, i):
            settled[i] = replace(atom, kind=AtomKind.AUXILIARY)
        if AtomKind.CAUSATIVE in kinds:
            if _actor_then_verb(settled, i) and not _tells(settled, i):
                settled[i] = _as(atom, AtomKind.CAUSATIVE)
            elif AtomKind.VERB in kinds and settled[i].kind is AtomKind.CAUSATIVE:
                settled[i] = _as(atom, AtomKind.VERB)
        if AtomKind.MESSAGE in kinds and _is_owned(settled, i):
            settled[i] = replace(settled[i], kind=AtomKind.MESSAGE, key=atom.words)
        if atom.kind is AtomKind.VERB and atom.key == 'hover' and _on_the_ground(settled, i):
            settled[i] = replace(settled[i], key='wait')
        down = atom.kind is AtomKind.VERB and atom.key in ('descend', 'ascend')
        if down and atom.words.split()[-1:] in (['down'], ['up']) and _on_the_ground(settled, i):
            settled[i : i + 1] = _along(settled[i])  # `a car goes down the main road`
        stop = _lane_of_another(settled, i)
        if stop is not None:
            settled[i] = replace(settled[i], key='change_lane')
            for k in range(i + 1, stop):
                if not settled[k].is_actor:
                    settled[k] = replace(settled[k], kind=AtomKind.FILL, noun=None)
    return settled


def _is_owned(atoms: list[Atom], i: int) -> bool:
    """`the drone's message`; in `the drone's warning the bus` it is a verb."""
    behind = next((a for a in atoms[i + 1 :] if a.kind is not AtomKind.FILL), None)
    owned = i > 1 and atoms[i - 1].words == "'s" and atoms[i - 2].is_actor
    return owned and (behind is None or not behind.is_actor)


def _on_the_ground(atoms: list[Atom], i: int) -> bool:
    """`the police car standing by at the hospital`: who cannot hover waits."""
    before = next((a for a in reversed(atoms[:i]) if a.kind not in _BESIDE_SUBJECT), None)
    ground = (NounKind.AGENT, NounKind.VEHICLE, NounKind.EGO)
    if before is not None and before.is_actor and before.key in ('it', 'person'):
        before = None
    return before is not None and before.noun is not None and before.noun.kind in ground


_BESIDE_SUBJECT = (*_SKIPPED, AtomKind.RELATIVE)


def _along(atom: Atom) -> list[Atom]:
    cut = atom.start + len(atom.words.split()[0])
    drive = replace(atom, key='drive', end=cut, words=atom.words.split()[0])
    return [
        drive,
        Atom(kind=AtomKind.PREPOSITION, key='along', start=cut, end=atom.end, words='down'),
    ]


# How one gets from lane to lane.
_SIDEWAYS = frozenset({'swerve', 'cross', 'drive', 'start', 'come', 'change_lane', 'visit'})
_INTO_A_LANE = 5  # words, at most, from the verb to the lane


def _lane_of_another(atoms: list[Atom], i: int) -> int | None:
    """`moves over into the truck's lane`: return what lies behind the lane."""
    atom = atoms[i]
    if atom.kind is not AtomKind.VERB or atom.key not in _SIDEWAYS:
        return None
    into = atom.key == 'swerve'  # `swerves into`
    for k in range(i + 1, min(i + 1 + _INTO_A_LANE, len(atoms))):
        behind = atoms[k]
        if behind.noun is not None and behind.noun.kind is NounKind.STREET:
            return k + 1 if into and behind.key == 'lane' else None
        into = into or behind.key == 'to'
        if not (behind.key == 'to' or behind.kind is AtomKind.FILL or (into and behind.is_actor)):
            return None
    return None


# `starts tracking`, `keeps following`: the second verb is the predicate.
_PHASES = ('start', 'keep')


_GROUND_ACTS = ('cross', 'walk', 'overtake', 'brake', 'change_lane', 'turn_left', 'turn_right')


def _gerund_follows(atoms: list[Atom], i: int) -> bool:
    for atom in atoms[i + 1 :]:
        if atom.kind is AtomKind.VERB:
            return atom.form is VerbForm.ING
        if atom.kind is not AtomKind.FILL:
            return False
    return False


def _ground_act_follows(atoms: list[Atom], i: int) -> bool:
    """`has finished crossing`: an act of its own; a flight that is finished is a mission."""
    behind = atoms[i + 1] if i + 1 < len(atoms) else None
    return behind is not None and behind.form is VerbForm.ING and behind.key in _GROUND_ACTS


def _as(atom: Atom, kind: AtomKind) -> Atom:
    if kind is AtomKind.VERB:
        return replace(atom, kind=kind, key=atom.verb_key, form=atom.verb_form)
    return replace(atom, kind=kind)


def _verb_follows(atoms: list[Atom], i: int) -> bool:
    for atom in atoms[i + 1 :]:
        if atom.kind is AtomKind.VERB:
            return True
        spent = atom.kind is AtomKind.MEASURE  # `has spent 20 s hovering`
        if atom.kind not in _SKIPPED and not spent:
            return False
        if spent and not any(a.key == 'spend' for a in atoms[i : i + 3]):
            return False
    return False


def _tells(atoms: list[Atom], i: int) -> bool:
    """`the RSU tells the truck to stop` is a message; `tell the truck to stop` is a request."""
    if atoms[i].verb_key == 'alert' and atoms[i].verb_form is VerbForm.THIRD:
        return True  # `the drone orbits the park and tells the van to brake`
    before = next((a for a in reversed(atoms[:i]) if a.kind not in _SKIPPED), None)
    return before is not None and before.is_actor and atoms[i].verb_key == 'alert'


def _actor_then_verb(atoms: list[Atom], i: int) -> bool:
    """`have a drone follow`, `tell the drone to land`, `send a drone to hover`."""
    j = i + 1
    while j < len(atoms) and atoms[j].kind is AtomKind.FILL:
        j += 1
    if j >= len(atoms) or not atoms[j].is_actor:
        return False
    j += 1
    while j < len(atoms) and (
        atoms[j].kind in (AtomKind.FILL, AtomKind.AUXILIARY)
        or (atoms[j].kind is AtomKind.PREPOSITION and atoms[j].key == 'to')
    ):
        j += 1
    return (
        j < len(atoms)
        and atoms[j].kind is AtomKind.VERB
        and atoms[j].form in (VerbForm.BASE, VerbForm.ING)
    )
