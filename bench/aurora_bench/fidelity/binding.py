# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Which elements of a specification the names of an annotation stand for."""

from __future__ import annotations

import itertools
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field

from aurora_bench.prompts.format import AgentRequirement, Requirement, UavRequirement
from aurora_core.spec.scenario import ScenarioSpec
from aurora_core.spec.vocabulary import AgentType, Place

# More assignments than this are not tried one by one: names are then bound to their own type only,
# and to the first few of it. Five names among five bodies are 1546 assignments.
_MOST = 2000
_FEW = 6

Names = Mapping[str, frozenset[str]]


@dataclass(frozen=True, kw_only=True)
class Binding:
    """Local names of one annotation and what they are bound to.

    Attributes:
        bodies: Agents and UAVs by local name; a group has several, a name without partner none.
        moments: Missions and events by local name.
    """

    bodies: Names
    moments: Mapping[str, str] = field(default_factory=dict)

    def of(self, name: str) -> frozenset[str]:
        """Return the specification's ids (or the place) that a local name means."""
        if name in self.bodies:
            return self.bodies[name]
        if name in {place.value for place in Place}:
            return frozenset({name})
        return frozenset({f'landmark:{name}'})

    def means(self, name: str, found: str | None) -> bool:
        """Whether an id of the specification is (one of) what a local name means."""
        if found is None:
            return False
        folded = {item.casefold() for item in self.of(name)}
        return found.casefold() in folded


def candidate_bodies(requirements: Sequence[Requirement], spec: ScenarioSpec) -> Iterator[Names]:
    """Return the ways to bind agents and UAVs, best guesses first.

    A name of one body takes any body or none; a group takes all that is left of its type.
    """
    agents = [r for r in requirements if isinstance(r, AgentRequirement) and r.count > 0]
    uavs = [r for r in requirements if isinstance(r, UavRequirement) and r.count > 0]
    type_of = {a.id: a.type for a in spec.agents}
    single_agents = [r for r in agents if r.count == 1]
    choices = [_choices(r, spec) for r in single_agents]
    if _product(choices) > _MOST:
        choices = [
            [*[i for i in c if i is not None and type_of[i] is r.type][:_FEW], None]
            for c, r in zip(choices, single_agents, strict=True)
        ]
    flyers = [u.id for u in spec.uavs]
    single_uavs = [r.ref for r in uavs if r.count == 1]
    for on_ground in _assignments([r.ref for r in single_agents], choices):
        for in_air in _assignments(single_uavs, [[*flyers[:_FEW], None]] * len(single_uavs)):
            bodies = {**on_ground, **in_air}
            taken = frozenset().union(*bodies.values()) if bodies else frozenset()
            for group in agents:
                if group.count > 1:
                    rest = {i for i, kind in type_of.items() if kind is group.type}
                    bodies[group.ref] = frozenset(rest - taken)
            for squad in uavs:
                if squad.count > 1:
                    bodies[squad.ref] = frozenset(flyers) - taken
            if 'rsu' not in bodies:
                units = {i for i, kind in type_of.items() if kind is AgentType.RSU}
                bodies['rsu'] = frozenset(units)
            yield bodies


def _choices(requirement: AgentRequirement, spec: ScenarioSpec) -> list[str | None]:
    """Bodies of the right role and type first; none last."""
    ranked = sorted(
        spec.agents,
        key=lambda a: (
            (a.role.value == 'ego') != (requirement.role == 'ego'),
            a.type is not requirement.type,
        ),
    )
    return [*(a.id for a in ranked), None]


def _product(choices: Sequence[Sequence[str | None]]) -> int:
    product = 1
    for choice in choices:
        product *= len(choice)
    return product


def _assignments(
    names: Sequence[str], choices: Sequence[Sequence[str | None]]
) -> Iterator[dict[str, frozenset[str]]]:
    """Return the assignments that use no body twice, at most `_MOST`."""
    for picked in itertools.islice(_distinct(choices), _MOST):
        yield {
            name: frozenset({p} if p is not None else ())
            for name, p in zip(names, picked, strict=True)
        }


def _distinct(
    choices: Sequence[Sequence[str | None]], taken: frozenset[str] = frozenset()
) -> Iterator[tuple[str | None, ...]]:
    if not choices:
        yield ()
        return
    for choice in choices[0]:
        if choice is None:
            yield from ((None, *rest) for rest in _distinct(choices[1:], taken))
        elif choice not in taken:
            for rest in _distinct(choices[1:], taken | {choice}):
                yield (choice, *rest)
