# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Whom a condition is about: named in it, or meant by a pronoun or by nothing at all."""

from __future__ import annotations

import re
from collections.abc import Sequence

from aurora_core.parsing.atoms import Determiner, NounKind, NounPhrase
from aurora_core.parsing.pronouns import Fits, airborne, anything
from aurora_core.parsing.resolver import Resolver
from aurora_core.parsing.scene import Entity, Scene
from aurora_core.spec.vocabulary import AgentType

_PLACES = (NounKind.PLACE, NounKind.LANDMARK)
_ON_FOOT = (AgentType.PEDESTRIAN, AgentType.RSU)
_SEVERAL = ('both', 'they')


class Parties:
    """Finds actors and places of one clause."""

    def __init__(self, scene: Scene, resolver: Resolver, nouns: Sequence[NounPhrase]) -> None:
        self._scene = scene
        self._resolver = resolver
        self._nouns = nouns

    def named(self) -> list[Entity | str]:
        """Return what the nouns name that are no pronouns, in order; places by their key."""
        found: list[Entity | str] = []
        for noun in self._nouns:
            if noun.kind in _PLACES:
                place = self._resolver.place(noun)
                found += [place] if place is not None and place not in found else []
            elif self._is_one(noun):
                others = [e for e in found if isinstance(e, Entity)]
                meant = self._resolver.actors((noun,), exclude=others)
                found += [e for e in meant if e not in found]
        return found

    def _is_one(self, noun: NounPhrase) -> bool:
        if noun.kind is NounKind.PRONOUN:
            return noun.key not in ('it', 'person', *_SEVERAL)
        return not self._is_several(noun)

    def actors(self, accept: Fits = anything) -> list[Entity]:
        """Return the actors among them."""
        return [e for e in self.named() if isinstance(e, Entity) and accept(e)]

    def several(self, avoid: Sequence[Entity | str] = ()) -> list[Entity] | None:
        """Return the members of a group that the clause is about; None when it names none."""
        for noun in self._nouns:
            if self._is_several(noun):
                members = self._members(noun, avoid)
                self._resolver.note(noun, members)
                return members
        return None

    def kin(self) -> list[Entity]:
        """Return everybody of the kind of the first noun: `no drone … any other`."""
        noun = self._nouns[0]
        members = self._members(noun)
        self._resolver.note(noun, members)
        return members

    def it(self, accept: Fits = anything, avoid: Sequence[Entity | str] = ()) -> Entity | None:
        """Return who was spoken of last and fits."""
        for clause in reversed(self._scene.clauses[:-1]):
            for entity in (*clause.subjects, *clause.objects):
                if accept(entity) and entity not in avoid:
                    return entity
        fitting = [e for e in self._scene.entities if accept(e) and e not in avoid]
        return fitting[-1] if fitting else None

    def flyers(self) -> list[Entity]:
        """Return the UAVs meant: named, all of them, or the one spoken of last."""
        named = self.actors(airborne)
        if named:
            return named
        group = self.several()
        if group and all(e.is_uav for e in group):
            return group
        flying = self.it(airborne)
        return [flying] if flying is not None else []

    def pair(self) -> list[Entity]:
        """Return the group that nobody names: `the distance must stay above 10 m`."""
        return self._members(None)

    @staticmethod
    def _is_several(noun: NounPhrase) -> bool:
        if noun.kind is NounKind.PRONOUN:
            return noun.key in _SEVERAL
        new = noun.determiner is Determiner.INDEFINITE
        return (noun.plural or noun.count > 1) and not new

    def _members(
        self, noun: NounPhrase | None, avoid: Sequence[Entity | str] = ()
    ) -> list[Entity]:
        scene = self._scene
        if noun is not None and noun.kind is NounKind.UAV:
            return list(scene.uavs)
        if noun is not None and noun.kind is NounKind.AGENT:
            return [e for e in scene.agents if e.type.value == noun.key]
        if noun is not None and noun.kind is NounKind.VEHICLE:
            return [e for e in scene.agents if e.type not in _ON_FOOT]
        earlier = scene.clauses[:-1]
        if avoid:
            spoken = [e for c in earlier for e in (*c.subjects, *c.objects)]
            return [e for e in dict.fromkeys(spoken) if e not in avoid and not e.is_uav]
        for clause in reversed(earlier):
            if len(clause.subjects) > 1:
                return list(clause.subjects)
            if clause.subjects:
                break
        if len(scene.uavs) > 1:
            return list(scene.uavs)
        grouped = [e for e in scene.entities if e.group is not None]
        if grouped:
            return [e for e in grouped if e.group == grouped[-1].group]
        for clause in reversed(earlier):
            named = dict.fromkeys((*clause.subjects, *clause.objects))
            if len(named) > 1:
                return list(named)
        return list(scene.entities) if len(scene.entities) == 2 else []


def left_out_before(prompt: str, start: int) -> bool:
    """`its sway, …, must not exceed 2 m`: what a clause compares stands in front of it, unread."""
    before = prompt[:start].rstrip()
    joined = re.search(r'\b(?:and|but|or|also|then|please)$', before.lower()) is not None
    return before.endswith((',', ')')) or (before[-1:].isalnum() and not joined)
