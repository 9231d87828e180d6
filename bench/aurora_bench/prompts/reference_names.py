# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Ids of a reference specification for the local names of an annotation."""

from __future__ import annotations

import re
from collections.abc import Sequence

from aurora_bench.prompts.format import (
    AgentRequirement,
    EventRequirement,
    MissionRequirement,
    Requirement,
    UavRequirement,
)
from aurora_core.spec.vocabulary import AgentType, Place


class NotExpressibleError(ValueError):
    """The schema of specifications cannot say what an annotation asks for."""


class Names:
    """Which ids stand for a local name: one for a body, several for a group.

    Attributes:
        undeclared_rsu: Somebody sends to `rsu`, of which no requirement says that there is one.
    """

    def __init__(self, requirements: Sequence[Requirement]) -> None:
        """Give ids to everything that the requirements declare.

        Args:
            requirements: One reading of each `any_of`.
        """
        self._bodies: dict[str, tuple[str, ...]] = {}
        self.uavs: list[str] = []
        self.agents: list[str] = []
        for r in requirements:
            if isinstance(r, AgentRequirement | UavRequirement) and r.count > 0 and not r.negate:
                stem = id_of(r.ref)
                ids = (stem,) if r.count == 1 else tuple(f'{stem}_{k + 1}' for k in range(r.count))
                self._bodies[r.ref] = ids
                (self.agents if isinstance(r, AgentRequirement) else self.uavs).extend(ids)
                if isinstance(r, AgentRequirement) and r.type is AgentType.RSU:
                    self._bodies.setdefault('rsu', ids)
        self.undeclared_rsu = 'rsu' not in self._bodies and any(map(_names_rsu, requirements))
        if self.undeclared_rsu:
            self._bodies['rsu'] = ('rsu',)
            self.agents.append('rsu')
        self.egos = [
            i
            for r in requirements
            if isinstance(r, AgentRequirement) and r.role == 'ego'
            for i in self.all(r.ref)
        ]
        self.moments = {
            r.ref for r in requirements if isinstance(r, MissionRequirement | EventRequirement)
        }

    def all(self, ref: str) -> tuple[str, ...]:
        """Return every id (or the place) that a local name stands for."""
        if ref in self._bodies:
            return self._bodies[ref]
        return (ref,) if ref in set(Place) else (f'landmark:{ref}',)

    def one(self, ref: str | None) -> str | None:
        """Return the first of them, None for no name."""
        return None if ref is None else self.all(ref)[0]

    def agent(self, ref: str | None) -> str:
        """Return a ground agent: the named one, else the ego, else the first.

        Raises:
            NotExpressibleError: There is none, or the name is that of something else.
        """
        return self._named(ref, [*self.egos, *self.agents], self.agents, 'ground agent')

    def uav(self, ref: str | None) -> str:
        """Return a UAV: the named one, else the first.

        Raises:
            NotExpressibleError: There is none, or the name is that of something else.
        """
        return self._named(ref, self.uavs, self.uavs, 'UAV')

    def body(self, ref: str | None) -> str:
        """Return any body: the named one, else the ego or another agent, else a UAV.

        Raises:
            NotExpressibleError: There is none, or the name is that of a place.
        """
        everybody = [*self.egos, *self.agents, *self.uavs]
        return self._named(ref, everybody, everybody, 'body')

    def _named(self, ref: str | None, silent: list[str], known: list[str], kind: str) -> str:
        """Return the named one, or without a name the first of `silent`; it has to be known."""
        found = self.one(ref) if ref is not None else next(iter(silent), None)
        if found not in known:
            raise NotExpressibleError(f'{ref!r} is no {kind}')
        return found

    def moment(self, ref: str) -> str:
        """Return the id of an event or mission.

        Raises:
            NotExpressibleError: No requirement of this reading declares it.
        """
        if ref not in self.moments:
            raise NotExpressibleError(f'{ref!r} is no event and no mission of this reading')
        return id_of(ref)


def _names_rsu(r: Requirement) -> bool:
    """Tell whether a requirement speaks of the roadside unit, which the format lets it name."""
    parts = (r, getattr(r, 'trigger', None), getattr(r, 'action', None))
    names = ('sender', 'receiver', 'a', 'b', 'observer', 'target', 'by', 'from_')
    named = {getattr(part, name, None) for part in parts for name in names}
    of = getattr(r, 'of', None)
    return 'rsu' in named or (isinstance(of, tuple) and 'rsu' in of)


def id_of(ref: str) -> str:
    """Return a valid id for a local name."""
    text = re.sub(r'[^a-z0-9_]', '_', ref.lower())[:28]
    return text if text[:1].isalpha() else f'x{text}'
