# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Whom `it`, `they`, `one`, `the other`, `the first`, `the target` mean."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from aurora_core.parsing.atoms import NounPhrase
from aurora_core.parsing.lexicon import shipped_lexicon
from aurora_core.parsing.scene import Doubt, Entity, Scene
from aurora_core.spec.parameter import Span
from aurora_core.spec.vocabulary import AgentType, Role

Fits = Callable[[Entity], bool]


def anything(_: Entity) -> bool:
    """Accept any actor."""
    return True


def ground(entity: Entity) -> bool:
    """Accept ground agents."""
    return not entity.is_uav


def mobile(entity: Entity) -> bool:
    """Accept ground agents that can move."""
    return not entity.is_uav and entity.type is not AgentType.RSU


def airborne(entity: Entity) -> bool:
    """Accept UAVs."""
    return entity.is_uav


class PronounResolver:
    """Finds the actors that a pronoun refers to: the latest that fit, objects for objects."""

    def __init__(self, scene: Scene) -> None:
        self._scene = scene
        self._pair: tuple[Entity, ...] = ()  # whom `the former` and `the latter` mean

    def resolve(
        self, noun: NounPhrase, accept: Fits, exclude: Sequence[Entity], as_object: bool
    ) -> tuple[Entity, ...]:
        """Return the actors meant; none, with a doubt, when nobody fits."""
        if noun.key == 'one':
            return self._member(accept, first=True)
        if noun.key == 'other':
            return self._member(accept, first=False)
        if noun.key.startswith('nth'):
            return self._nth(noun, accept, exclude, int(noun.key[3:])) or self._ask(noun)
        if noun.key == 'target':
            tracked = [m.target for m in self._scene.missions if m.target is not None]
            target = self._scene.by_id(tracked[-1]) if tracked else None
            cast = [e for e in self._scene.entities if e.role is Role.TARGET]
            target = target or (cast[-1] if len(cast) == 1 else None)
            return (target,) if target is not None else self._ask(noun)
        if noun.key == 'both' and (number := _how_many(noun)) > 2:
            return self._so_many(number, accept) or self._ask(noun)
        if noun.key == 'both' and noun.head_text.startswith('all'):
            everyone = self._everyone(accept)
            if everyone:
                return everyone
        if noun.key == 'rest':
            return self._ask(noun)
        if noun.key == 'both':
            group = self._last_group(accept) or self._plural(accept, exclude, as_object)
            return group or self._ask(noun)
        if noun.key == 'they':
            return self._plural(accept, exclude, as_object) or self._ask(noun)
        if noun.key == 'there':
            return ()
        return self._singular(noun, accept, exclude, as_object)

    def _singular(
        self, noun: NounPhrase, accept: Fits, exclude: Sequence[Entity], as_object: bool
    ) -> tuple[Entity, ...]:
        person = noun.key == 'person'

        def possible(entity: Entity) -> bool:
            if not accept(entity) or entity in exclude:
                return False
            return not person or entity.type in (
                AgentType.PEDESTRIAN,
                AgentType.BICYCLE,
                AgentType.MOTORCYCLE,
            )

        for clause in reversed(self._scene.clauses):
            order = (
                (clause.objects, clause.subjects)
                if as_object or clause is self._scene.clauses[-1]
                else (clause.subjects, clause.objects)
            )
            for candidates in order:
                fitting = [e for e in candidates if possible(e)]
                if fitting and len({e.group or e.id for e in fitting}) == 1:
                    return (fitting[0],) if len(fitting) == 1 else tuple(fitting)
                alone = [e for e in fitting if e.group is None]
                if noun.key == 'it' and len(alone) == 1:  # `three cars and a bus …, behind it`
                    return (alone[0],)
        rest = [e for e in self._scene.entities if possible(e)]
        if len(rest) == 1:
            return (rest[0],)
        return self._ask(noun)

    def _plural(
        self, accept: Fits, exclude: Sequence[Entity], as_object: bool
    ) -> tuple[Entity, ...]:
        for clause in reversed(self._scene.clauses):
            order = (
                (clause.objects, clause.subjects)
                if as_object
                else (clause.subjects, clause.objects)
            )
            for candidates in order:
                fitting = [e for e in candidates if accept(e) and e not in exclude]
                if len(fitting) > 1:
                    return tuple(fitting)
            together = [
                e for e in (*clause.subjects, *clause.objects) if accept(e) and e not in exclude
            ]
            if len(set(together)) == 2:
                return tuple(dict.fromkeys(together))
        return self._last_group(accept)

    def _everyone(self, accept: Fits) -> tuple[Entity, ...]:
        """`four cars and two buses, and all of them …`: of whatever group."""
        for clause in reversed(self._scene.clauses[:-1]):
            fitting = tuple(e for e in clause.subjects if accept(e))
            if len({e.group for e in fitting}) > 1:
                return fitting
            if fitting:
                return ()
        return ()

    def _so_many(self, number: int, accept: Fits) -> tuple[Entity, ...]:
        """`all three drive at 9 m/s`: who was told of last, or all there are, if that is three."""
        told = [c.subjects for c in reversed(self._scene.clauses[:-1]) if c.subjects]
        kin = (self._scene.agents, self._scene.uavs)
        groups = [*told[:1], self._last_group(accept), *(tuple(k) for k in kin)]
        fitting = (tuple(e for e in group if accept(e)) for group in groups)
        return next((group for group in fitting if len(group) == number), ())

    def _last_group(self, accept: Fits) -> tuple[Entity, ...]:
        members = [e for e in self._scene.entities if e.group is not None and accept(e)]
        if members:
            return tuple(e for e in members if e.group == members[-1].group)
        flying = [e for e in self._scene.uavs if accept(e)]
        return tuple(flying) if len(flying) > 1 else ()

    def _member(self, accept: Fits, *, first: bool) -> tuple[Entity, ...]:
        members = [e for e in self._last_group(accept) if not e.assigned]
        if not members:
            return ()
        chosen = members[0] if first else members[-1]
        chosen.assigned = True
        return (chosen,)

    def _nth(
        self, noun: NounPhrase, accept: Fits, exclude: Sequence[Entity], number: int
    ) -> tuple[Entity, ...]:
        members = self._last_group(accept)
        if noun.head_text in ('the former', 'the latter'):
            return self._of_two(accept, number) or self._singular(noun, accept, exclude, False)
        if len(members) < number:
            return ()
        chosen = members[number - 1]
        chosen.index, chosen.assigned = number, True
        return (chosen,)

    def _of_two(self, accept: Fits, number: int) -> tuple[Entity, ...]:
        """`one drone circles, a second one hovers; the former …`: the last two told of."""
        if number == 2 and self._pair:
            return self._pair[1:]
        told: list[Entity] = []
        for clause in reversed(self._scene.clauses[:-1]):
            fitting = [e for e in clause.subjects if accept(e) and e not in told]
            told = fitting + told
            if len(told) >= 2:
                self._pair = tuple(told[-2:])
                return (told[number - 3],)
            objects = [e for e in clause.objects if accept(e) and e not in told]
            if told and objects and clause is self._scene.clauses[-2]:
                self._pair = (told[-1], objects[-1])
                return (self._pair[number - 1],)
        return ()

    def _ask(self, noun: NounPhrase) -> tuple[Entity, ...]:
        words = self._scene.prompt[noun.start : noun.end]
        self._scene.doubts.append(
            Doubt(
                span=Span(start=noun.start, end=noun.end),
                question=f'Whom or what do you mean by "{words}"?',
            )
        )
        return ()


def _how_many(noun: NounPhrase) -> int:
    """`all three of them`: return the number that is said, 0 where none is."""
    numbers = shipped_lexicon().number_words
    return next((numbers[w] for w in noun.head_text.split() if w in numbers), 0)
