# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Which elements of a specification the names of an annotation stand for."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

from aurora_bench.prompts.format import AgentRequirement, Requirement, UavRequirement
from aurora_core.spec.scenario import ScenarioSpec
from aurora_core.spec.vocabulary import AgentType, Place

Names = Mapping[str, frozenset[str]]


@dataclass(frozen=True, kw_only=True)
class Binding:
    """Local names of one annotation and what they are bound to.

    Attributes:
        bodies: Agents and UAVs by local name; a group has several, a name without partner none.
        moments: Missions and events by local name.
        others: What else says the same as a named mission or event (`equivalences.py`).
    """

    bodies: Names
    moments: Mapping[str, str] = field(default_factory=dict)
    others: Names = field(default_factory=dict)

    def of(self, name: str) -> frozenset[str]:
        """Return the specification's ids (or the place) that a local name means."""
        if name in self.bodies:
            return self.bodies[name]
        if name in {place.value for place in Place}:
            return frozenset({name})
        return frozenset({f'landmark:{name}'})

    def moments_of(self, name: str) -> frozenset[str]:
        """Return every mission, event or moment of one that a local name stands for."""
        own = self.moments.get(name)
        return self.others.get(name, frozenset()) | ({own} if own is not None else frozenset())

    def means(self, name: str, found: str | None) -> bool:
        """Whether an id of the specification is (one of) what a local name means."""
        if found is None:
            return False
        folded = {item.casefold() for item in self.of(name)}
        return found.casefold() in folded


@dataclass(frozen=True, kw_only=True)
class Slot:
    """A name of one body and the bodies that it may mean; None, for nothing, comes last."""

    name: str
    choices: tuple[str | None, ...]


def slots(requirements: Sequence[Requirement], spec: ScenarioSpec) -> tuple[Slot, ...]:
    """Return the names of single agents and UAVs with their choices, best guesses first."""
    singles = [r for r in requirements if isinstance(r, AgentRequirement) and r.count == 1]
    wanted = Counter(r.type for r in singles)
    flyers = tuple(u.id for u in spec.uavs)
    return (
        *(Slot(name=r.ref, choices=_choices(r, wanted[r.type], spec)) for r in singles),
        *(
            Slot(name=r.ref, choices=(*flyers, None))
            for r in requirements
            if isinstance(r, UavRequirement) and r.count == 1
        ),
    )


def bodies_of(
    picked: Mapping[str, str | None], requirements: Sequence[Requirement], spec: ScenarioSpec
) -> Names:
    """Return the bodies of all names: a group takes all of its type that no single name took."""
    bodies = {name: frozenset({p} if p is not None else ()) for name, p in picked.items()}
    taken = frozenset(p for p in picked.values() if p is not None)
    for r in requirements:
        if isinstance(r, AgentRequirement) and r.count > 1:
            bodies[r.ref] = frozenset(a.id for a in spec.agents if a.type is r.type) - taken
        if isinstance(r, UavRequirement) and r.count > 1:
            bodies[r.ref] = frozenset(u.id for u in spec.uavs) - taken
    units = frozenset(a.id for a in spec.agents if a.type is AgentType.RSU)
    bodies.setdefault('rsu', units)
    return bodies


def _choices(r: AgentRequirement, names: int, spec: ScenarioSpec) -> tuple[str | None, ...]:
    """Return bodies that a name may mean: the right role and type first.

    Other types count only when there are not enough bodies of the right one for all its names: a
    van that was read as a truck is still the one meant.
    """
    right = [a for a in spec.agents if a.type is r.type]
    bodies = right if len(right) >= names else list(spec.agents)
    ranked = sorted(
        bodies, key=lambda a: ((a.role.value == 'ego') != (r.role == 'ego'), a.type is not r.type)
    )
    return (*(a.id for a in ranked), None)
