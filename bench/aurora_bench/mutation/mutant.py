# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""One altered run, and what its alteration has to lead to."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace

from aurora_bench.mutation.recording import Recording
from aurora_core.knowledge.world import WorldModel
from aurora_core.outcomes.agsg import Agsg
from aurora_core.trace.records import EventRecord, LinkRecord
from aurora_core.trace.trace import Trace


@dataclass(frozen=True, kw_only=True)
class Mutant:
    """One altered run.

    Attributes:
        kind: Family that it is counted in.
        name: What was done.
        base: The run before.
        names: What counts as having found it (see `local_runs.names_of`); known from what was
            done, not from the verifier. Empty: it breaks nothing, and the status must stay.
    """

    kind: str
    name: str
    base: Recording
    trace: Trace
    world: WorldModel
    agsg: Agsg
    names: frozenset[str]

    @property
    def harmless(self) -> bool:
        """Whether the status must stay."""
        return not self.names


def mutant(
    kind: str,
    name: str,
    base: Recording,
    names: Iterable[str],
    *,
    trace: Trace | None = None,
    world: WorldModel | None = None,
    agsg: Agsg | None = None,
) -> Mutant:
    """Return a mutant; what is not given is as recorded. Records are numbered anew."""
    altered = base.trace if trace is None else trace
    return Mutant(
        kind=kind,
        name=name,
        base=base,
        trace=replace(altered, links=_links(altered.links), events=_events(altered.events)),
        world=base.world if world is None else world,
        agsg=base.agsg if agsg is None else agsg,
        names=frozenset(names),
    )


def _links(records: Iterable[LinkRecord]) -> tuple[LinkRecord, ...]:
    """Number ledger entries in order of time: a forger leaves no gap."""
    ordered = sorted(records, key=lambda r: r.tick)
    return tuple(replace(record, sequence=k) for k, record in enumerate(ordered))


def _events(records: Iterable[EventRecord]) -> tuple[EventRecord, ...]:
    ordered = sorted(records, key=lambda r: r.tick)
    return tuple(replace(record, sequence=k) for k, record in enumerate(ordered))
