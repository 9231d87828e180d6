# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""One way to bind the names of an annotation to the bodies of a recording."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from aurora_bench.checker.answers import CheckerError
from aurora_bench.checker.scene import Scene

Requirement = Mapping[str, Any]
# Without these a requirement of the kind says nothing.
NEEDED = {
    'condition': ('quantity', 'of', 'op', 'value'),
    'placement': ('agent', 'relation'),
    'behavior': ('agent', 'behavior'),
    'mission': ('uav', 'mode'),
    'world': ('field', 'value'),
    'link': ('sender', 'receiver'),
    'order': ('first', 'then'),
}
Binding = Mapping[str, tuple[str, ...]]


class Annotation:
    """The requirements of a prompt, and what its names are.

    Args:
        prompt: One line of a prompt file.

    Raises:
        CheckerError: It has no list of requirements, or one without id or kind.
    """

    def __init__(self, prompt: Mapping[str, Any]) -> None:
        found = prompt.get('requirements')
        if not isinstance(found, list) or not all(isinstance(r, Mapping) for r in found):
            raise CheckerError('the prompt has no list of requirements; see the prompt format')
        self.requirements: tuple[Requirement, ...] = tuple(found)
        for requirement in self.flat():
            lacks = [
                f
                for f in ('kind', *NEEDED.get(str(requirement.get('kind')), ()))
                if requirement.get(f) is None
            ]
            if lacks:
                raise CheckerError(f'a requirement has no {lacks[0]}: {dict(requirement)}')
        variation = prompt.get('variation') or {}
        self.variation: Mapping[str, Any] = variation if isinstance(variation, Mapping) else {}
        self.events = self._named('event')
        self.missions = self._named('mission')
        self.bodies: dict[str, tuple[str, ...]] = {}  # name of a body: types that it may have
        self.counts: dict[str, int] = {}
        self.roles: dict[str, str] = {}
        for requirement in self.flat():
            kind, ref = requirement['kind'], requirement.get('ref')
            if kind not in ('agent', 'uav') or not isinstance(ref, str):
                continue
            count = requirement.get('count', 1)
            if count == 0 or requirement.get('negate'):
                continue
            own = 'uav' if kind == 'uav' else str(requirement.get('type'))
            self.bodies[ref] = tuple(dict.fromkeys((*self.bodies.get(ref, ()), own)))
            self.counts[ref] = max(self.counts.get(ref, 1), int(count))
            self.roles.setdefault(ref, str(requirement.get('role', '')))

    def _named(self, kind: str) -> dict[str, Requirement]:
        return {
            str(r['ref']): r for r in self.flat() if r['kind'] == kind and r.get('ref') is not None
        }

    def flat(self) -> Iterator[Requirement]:
        """Yield every requirement, those inside of `any_of` included."""
        yield from _flat(self.requirements)

    def names_in(self, requirement: Requirement) -> frozenset[str]:
        """Return the names of bodies on which a requirement depends, through events as well."""
        seen: set[str] = set()
        open_ = [requirement]
        found: set[str] = set()
        while open_:
            for text in _texts(open_.pop()):
                if text in self.bodies:
                    found.add(text)
                for named in (self.events, self.missions):
                    if text in named and text not in seen:
                        seen.add(text)
                        open_.append(named[text])
        # Which flown mission is which depends on all that is asked of the same UAV, and an event
        # depends on the orders and links that name it.
        for other in self.flat():
            texts = frozenset(_texts(other))
            if other['kind'] in ('mission', 'event', 'link', 'order', 'behavior') and (
                texts & (found | seen)
            ):
                found |= texts & set(self.bodies)
        return frozenset(found)


def _flat(requirements: Sequence[Any]) -> Iterator[Requirement]:
    for requirement in requirements:
        if isinstance(requirement, Mapping):
            yield requirement
            inner = requirement.get('any_of')
            if isinstance(inner, list):
                yield from _flat(inner)


def _texts(value: Any) -> Iterator[str]:
    if isinstance(value, str):
        yield value
    elif isinstance(value, Mapping):
        for part in value.values():
            yield from _texts(part)
    elif isinstance(value, list | tuple):
        for part in value:
            yield from _texts(part)


class Case:
    """A scene, an annotation and a binding: what judges get.

    Args:
        binding: Bodies of each name; a name without a body is missing.
    """

    def __init__(self, scene: Scene, annotation: Annotation, binding: Binding) -> None:
        self.scene = scene
        self.annotation = annotation
        self.binding = binding
        self.variation = annotation.variation
        self.memory: dict[object, Any] = {}

    def things(self, name: Any) -> tuple[str, ...]:
        """Return what a name stands for: bodies, or the name itself when it is a place's.

        Empty when it is a body that does not exist, or no name.
        """
        if not isinstance(name, str):
            return ()
        if name in self.annotation.bodies:
            return self.binding.get(name, ())
        if name in self.scene.bodies and not self.scene.places.known(name):
            return (name,)
        if name == 'rsu':
            return tuple(b.body_id for b in self.scene.bodies.values() if b.type_name == 'rsu')
        return (name,)

    def bodies(self, name: Any) -> tuple[str, ...]:
        """Return the bodies that a name stands for; empty for a place."""
        return tuple(t for t in self.things(name) if self.scene.is_body(t))

    def does(self, agent: str, do: str) -> bool:
        """Return whether an annotated event makes a body do something."""
        actions = [other.get('action') or {} for other in self.annotation.flat()]
        return any(
            a.get('do') == do and agent in self.bodies(a.get('agent') or a.get('uav'))
            for a in actions
        )

    def missing(self, *names: Any) -> str:
        """Return the first of the names that stands for nothing in the recording, or ''."""
        for name in names:
            if isinstance(name, str) and name in self.annotation.bodies and not self.things(name):
                return name
        return ''

    def unknown_place(self, name: Any) -> bool:
        """Return whether a name is neither a body's nor that of a place of the world."""
        return (
            isinstance(name, str)
            and not self.bodies(name)
            and name not in self.annotation.bodies
            and not self.scene.places.known(name)
        )
