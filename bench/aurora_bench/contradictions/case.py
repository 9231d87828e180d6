# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""One contradiction: what is done to a run, which requirement it breaks, what has to see it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from aurora_bench.mutation.mutant import Mutant, mutant
from aurora_bench.mutation.recording import Recording
from aurora_core.knowledge.world import WorldModel
from aurora_core.trace.trace import Trace
from aurora_system_tests.sabotage import Sabotage

# What an alteration gives: other states and records, or another world.
Alter = Callable[[Recording], Trace | WorldModel]


@dataclass(frozen=True, kw_only=True)
class Case:
    """What a run does that its request does not allow.

    Attributes:
        kind: What it is counted as.
        name: What was done, for people.
        request: Key of `prompts.REQUESTS`.
        requirement: Id of the annotated requirement that does not hold any more: known from what
            was done, from no verifier.
        conditions: Ids of conditions of the monitor of which at least one must fail.
    """

    kind: str
    name: str
    request: str
    requirement: str
    conditions: tuple[str, ...]


@dataclass(frozen=True, kw_only=True)
class Planted(Case):
    """A run of an executor with a planted bug."""

    sabotage: Sabotage


@dataclass(frozen=True, kw_only=True)
class Altered(Case):
    """An honest run whose recording is altered afterwards, and stamped anew."""

    alter: Alter

    def mutant(self, base: Recording) -> Mutant:
        """Return the altered run."""
        made = self.alter(base)
        names = {f'condition:{name}' for name in self.conditions}
        if isinstance(made, WorldModel):
            return mutant(self.kind, self.name, base, names, world=made)
        return mutant(self.kind, self.name, base, names, trace=made)
