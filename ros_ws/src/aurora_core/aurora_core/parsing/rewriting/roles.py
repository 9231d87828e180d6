# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Who is the target, who only fills the streets: `the target is a van`, `background: ten cars`."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from aurora_core.parsing.atom_runs import text_of
from aurora_core.parsing.atoms import Atom, AtomKind, Determiner, NounKind, NounPhrase
from aurora_core.parsing.lexicon import shipped_lexicon
from aurora_core.parsing.morphology import VerbForm
from aurora_core.parsing.pieces import TRANSPARENT


def drivers(atoms: Sequence[Atom], prompt: str) -> list[Atom]:
    """Return the atoms with vehicles and UAVs where such people are named."""
    return _at_the_wheel(_birds(list(atoms)), prompt)


def _birds(atoms: list[Atom]) -> list[Atom]:
    """`our bird is up, and the bird sees …`: whoever owns a bird flies a UAV."""
    birds = [i for i, a in enumerate(atoms) if a.noun is not None and a.noun.key == 'bird']
    nouns = [atoms[i].noun for i in birds]
    if not any(n is not None and n.determiner is Determiner.MY for n in nouns):
        return atoms
    for i, noun in zip(birds, nouns, strict=True):
        assert noun is not None
        flown = replace(noun, kind=NounKind.UAV, key='drone', determiner=Determiner.DEFINITE)
        atoms[i] = replace(atoms[i], key='drone', noun=flown)
    return atoms


def _at_the_wheel(atoms: list[Atom], prompt: str) -> list[Atom]:
    """`the suspect rides a motorcycle`, `a woman is driving a van`: the vehicle drives."""
    driven: dict[str, NounPhrase] = {}
    told: list[Atom] = []
    i = 0
    while i < len(atoms):
        person, vehicle = atoms[i], _vehicle_of(atoms, i, prompt)
        noun = person.noun
        if noun is not None and vehicle is not None:
            at = atoms[vehicle]
            assert at.noun is not None
            driven[noun.head_text] = at.noun
            verb = next((a for a in atoms[i:vehicle] if a.kind is AtomKind.VERB), None)
            told.append(replace(at, start=person.start))
            if verb is not None and verb.key != 'be':
                told.append(replace(verb, key='drive'))
            i = vehicle + 1
            continue
        known = driven.get(noun.head_text) if noun is not None else None
        if known is not None and noun is not None and noun.determiner is Determiner.DEFINITE:
            again = replace(
                known, start=noun.start, end=noun.end, determiner=Determiner.DEFINITE, count=0
            )
            person = replace(person, key=known.key, noun=again)
        told.append(person)
        i += 1
    return told


def _vehicle_of(atoms: Sequence[Atom], i: int, prompt: str) -> int | None:
    """Return where the vehicle stands that the person at i drives."""
    noun = atoms[i].noun
    person = noun is not None and (noun.kind is NounKind.UNKNOWN or noun.key == 'pedestrian')
    if not person or noun is None or noun.plural:
        return None
    k = i + 1
    words = shipped_lexicon().turns['rides']
    rides = False
    while k < len(atoms) and k < i + 5 and atoms[k].noun is None:
        rides = rides or text_of(atoms[k], prompt) in words or _is_on(atoms, k)
        if atoms[k].kind not in (*TRANSPARENT, AtomKind.VERB, AtomKind.PREPOSITION):
            return None
        k += 1
    if k >= len(atoms) or not rides:
        return None
    told = atoms[k].noun
    new = told is not None and told.determiner in (Determiner.INDEFINITE, Determiner.BARE)
    driven = told is not None and told.kind is NounKind.AGENT and told.key not in _NOT_DRIVEN
    return k if new and driven else None


def _is_on(atoms: Sequence[Atom], i: int) -> bool:
    """`the suspect is on a motorcycle`."""
    on = atoms[i].kind is AtomKind.PREPOSITION and atoms[i].key == 'on'
    return on and i + 1 < len(atoms) and atoms[i + 1].key in ('motorcycle', 'bicycle')


_NOT_DRIVEN = ('pedestrian', 'rsu')


_SERVES = frozenset({'be', 'serve', 'trace', 'act', 'form', 'wait'})


def cast(atoms: Sequence[Atom], prompt: str) -> list[Atom]:
    """Return the atoms with roles noted at the nouns that have them."""
    told = _apposed(_own_types(drivers(atoms, prompt)))
    return _targets(_background(told, prompt), prompt)


def _own_types(atoms: list[Atom]) -> list[Atom]:
    """`the ego vehicle, a van, drives`, `the ego is a truck`: what the ego vehicle is."""
    i = 0
    while i + 2 < len(atoms):
        ego, link, told = atoms[i : i + 3]
        noun = told.noun
        governed = i > 0 and atoms[i - 1].kind in (AtomKind.RELATION, AtomKind.PREPOSITION)
        own = ego.noun is not None and ego.noun.kind is NounKind.EGO and noun is not None
        own = own and not governed  # `the vehicle ahead of the ego is a bus`
        if own and noun is not None and noun.kind is NounKind.AGENT and not noun.plural:
            new = noun.determiner in (Determiner.INDEFINITE, Determiner.ONE)
            if link.key == ':' and (
                new or noun.determiner is Determiner.BARE
            ):  # `ego: van, 9 m/s`
                link, new = replace(link, kind=AtomKind.COMMA), True
            behind = atoms[i + 3] if i + 3 < len(atoms) else None
            ends = behind is None or behind.kind is AtomKind.STOP
            apposed = link.kind is AtomKind.COMMA and not ends
            apposed = apposed and behind is not None and behind.kind is AtomKind.COMMA
            goes_on = atoms[i + 4] if i + 4 < len(atoms) else None
            apposed = apposed and (goes_on is None or goes_on.noun is None)
            if new and noun.key != 'pedestrian' and (apposed or (link.key == 'be' and ends)):
                whole = replace(
                    noun, start=ego.start, end=told.end, determiner=Determiner.MY, count=0
                )
                merged = replace(told, start=ego.start, noun=whole)
                atoms[i : i + 4 if apposed else i + 3] = [merged]
        i += 1
    return atoms


def _apposed(atoms: list[Atom]) -> list[Atom]:
    """`vehicle 1: truck, 10 m/s`, `the first vehicle, a truck, waits`: one of that type."""
    i = 0
    while i + 2 < len(atoms):
        about, link, told = atoms[i : i + 3]
        opens = i == 0 or atoms[i - 1].kind is AtomKind.STOP
        governed = i > 0 and atoms[i - 1].kind in (AtomKind.RELATION, AtomKind.PREPOSITION)
        named = about.noun is not None and about.noun.index > 0
        opens = opens or (governed and named)  # `20 m in front of vehicle B, a truck`
        apart = link.kind is AtomKind.COMMA or link.key in (':', '(', '=')
        behind = atoms[i + 3] if i + 3 < len(atoms) else None
        ends = behind is None or behind.kind in (AtomKind.COMMA, AtomKind.STOP, AtomKind.FILL)
        whole = _with_type(about, told) if opens and apart and ends else None
        if apart and behind is not None and behind.kind is AtomKind.COMMA and _same(about, told):
            whole = about  # `drone B, the second one, hovers`
        if whole is not None:
            closes = behind is not None and behind.key in (',', ')')
            atoms[i : i + 4 if closes else i + 3] = [whole]
        i += 1
    return atoms


def _same(about: Atom, told: Atom) -> bool:
    """Return whether the second noun only says how the named one is counted."""
    name, number = about.noun, told.noun
    if name is None or number is None or not name.index or name.plural or number.plural:
        return False
    counted = number.kind is name.kind and number.index in (0, name.index) and not number.labels
    again = number.kind is NounKind.PRONOUN and number.key == f'nth{name.index}'
    return again or (counted and number.determiner is not Determiner.ANOTHER and not number.count)


def _with_type(about: Atom, told: Atom) -> Atom | None:
    """Return `the first vehicle` as the truck that it is; None when it has no mark of its own."""
    noun, kind = about.noun, told.noun
    if noun is None or noun.kind is not NounKind.VEHICLE or noun.count > 1 or noun.plural:
        return None
    if kind is None or kind.kind is not NounKind.AGENT or kind.plural:
        return None
    new = kind.determiner in (Determiner.INDEFINITE, Determiner.ONE, Determiner.BARE)
    if not new or not (noun.index or noun.labels):
        return None
    whole = replace(
        kind,
        start=about.start,
        index=noun.index,
        labels=noun.labels,
        determiner=Determiner.INDEFINITE,
    )
    return replace(told, start=about.start, noun=whole)


def _background(atoms: list[Atom], prompt: str) -> list[Atom]:
    """`background traffic: ten cars`, `fifteen cars serve as background traffic`."""
    for i, atom in enumerate(atoms):
        words = text_of(atom, prompt)
        if atom.kind is not AtomKind.WORLD or 'background' not in words:
            continue
        first, last = _sentence(atoms, i)
        behind = [k for k in range(i + 1, len(atoms)) if atoms[k].kind not in TRANSPARENT]
        listed = bool(behind) and atoms[behind[0]].key == ':'
        if listed:
            last = _sentence(atoms, behind[0] + 1)[1]
        serves = any(_serves(a) for a in atoms[first:i]) and not listed
        if not listed and not serves:
            continue
        told = range(i + 1, last) if listed else range(first, i)
        filling = [k for k in told if _is_agent(atoms[k])]
        if not filling:
            continue
        for k in filling:
            noun = atoms[k].noun
            assert noun is not None
            atoms[k] = replace(atoms[k], noun=replace(noun, background=True))
        atoms[i] = replace(atom, kind=AtomKind.FILL)
        if listed:
            atoms[behind[0]] = replace(atoms[behind[0]], kind=AtomKind.FILL)
    return atoms


def _serves(atom: Atom) -> bool:
    return atom.kind in (AtomKind.VERB, AtomKind.UNKNOWN, AtomKind.AUXILIARY) and (
        atom.key in _SERVES
    )


def _is_agent(atom: Atom) -> bool:
    noun = atom.noun
    return (
        noun is not None and noun.kind is NounKind.AGENT and noun.determiner is not Determiner.MY
    )


def _targets(atoms: list[Atom], prompt: str) -> list[Atom]:
    """`the target is a van parked at the market`: the van is there, and it is the target."""
    for i in range(2, len(atoms)):
        if atoms[i].noun is None or atoms[i].key != 'target' or atoms[i - 1].key != 'be':
            continue
        first, last = _sentence(atoms, i)
        agents = [k for k in range(first, i) if _is_agent(atoms[k])]
        if i + 1 == last and len(agents) == 1:  # `the bus is the target`
            noun = atoms[agents[0]].noun
            assert noun is not None
            atoms[agents[0]] = replace(atoms[agents[0]], noun=replace(noun, target=True))
            atoms[i] = replace(atoms[i], kind=AtomKind.FILL, noun=None)
    for i in range(len(atoms) - 2):
        named = atoms[i].noun is not None and atoms[i].key == 'target'
        if not named:
            continue
        first, _ = _sentence(atoms, i)
        if any(a.noun is not None and a.noun.kind is NounKind.UAV for a in atoms[first:i]):
            continue  # `a UAV tracks, the target being a truck`: of its mission
        solid = list(range(i + 1, min(i + 8, len(atoms))))
        solid = [k for k in solid if atoms[k].kind not in (AtomKind.FILL, AtomKind.AUXILIARY)]
        if len(solid) < 2:
            continue
        link, new = atoms[solid[0]], atoms[solid[1]]
        joins = link.key in ('be', ':') or link.kind is AtomKind.COMMA
        noun = new.noun
        if not joins or noun is None or noun.kind is not NounKind.AGENT or noun.plural:
            continue
        if noun.determiner not in (Determiner.INDEFINITE, Determiner.ONE, Determiner.BARE):
            continue
        atoms[solid[1]] = replace(new, noun=replace(noun, target=True))
        there = link.kind is AtomKind.VERB
        verb = replace(link, kind=AtomKind.VERB, key='exist', form=VerbForm.THIRD)
        atoms[i] = replace(atoms[i], kind=AtomKind.FILL, noun=None)
        atoms[solid[0]] = verb if there else replace(link, kind=AtomKind.FILL)
    return atoms


def _sentence(atoms: Sequence[Atom], i: int) -> tuple[int, int]:
    first = i
    while first and atoms[first - 1].kind is not AtomKind.STOP:
        first -= 1
    last = i
    while last < len(atoms) and atoms[last].kind is not AtomKind.STOP:
        last += 1
    return first, last
