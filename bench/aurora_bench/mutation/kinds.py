# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""All families of alterations."""

from __future__ import annotations

from collections.abc import Iterator
from random import Random

from aurora_bench.mutation.claims import claim_mutants
from aurora_bench.mutation.commands import command_mutants
from aurora_bench.mutation.documents import document_mutants
from aurora_bench.mutation.edges import inside_mutants, outside_mutants
from aurora_bench.mutation.flights import flight_mutants
from aurora_bench.mutation.harmless import same_mutants
from aurora_bench.mutation.ledger import ledger_mutants
from aurora_bench.mutation.mutant import Mutant
from aurora_bench.mutation.recording import Recording
from aurora_bench.mutation.states import state_mutants

_FAMILIES = (
    ledger_mutants,
    claim_mutants,
    command_mutants,
    state_mutants,
    flight_mutants,
    document_mutants,
    outside_mutants,
)


def breaking_mutants(base: Recording, seed: int) -> Iterator[Mutant]:
    """Yield everything that breaks something in a verified run, the same for the same seed."""
    for family in _FAMILIES:
        # A stream of its own for each: one more draw in one leaves the others as they are.
        yield from family(base, Random(f'{seed}:{base.name}:{family.__name__}'))


def harmless_mutants(base: Recording, seed: int, noisy: int = 8) -> Iterator[Mutant]:
    """Yield the run as it is and what breaks nothing in it.

    Args:
        base: The run.
        seed: Of the alterations.
        noisy: How many with noise on the positions.
    """
    name = f'{seed}:{base.name}:{base.seed}'
    yield from same_mutants(base, Random(f'{name}:same'), noisy)
    if base.status == 'verified':
        yield from inside_mutants(base, Random(f'{name}:inside'))
