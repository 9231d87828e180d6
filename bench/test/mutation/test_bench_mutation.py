# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""A sample of the altered runs: what breaks is named, what does not break keeps its status."""

from __future__ import annotations

from pathlib import Path
from random import Random

import pytest

from aurora_bench.mutation.bag import write_bag
from aurora_bench.mutation.judge import (
    by_recomputation,
    in_memory,
    judge_bag,
    through_bag,
    unstamped_in_memory,
)
from aurora_bench.mutation.kinds import breaking_mutants, harmless_mutants
from aurora_bench.mutation.mutant import Mutant, mutant
from aurora_bench.mutation.prompts import SOUND
from aurora_bench.mutation.recording import Recording, record
from aurora_core.pipeline.verification import load_bag
from aurora_core.trace.definitions import message_definitions
from aurora_core.trace.hashing import trace_sha256

SEED = 7


@pytest.fixture(scope='module')
def base(tmp_path_factory: pytest.TempPathFactory) -> Recording:
    return record('tailgate', SOUND['tailgate'], 1, tmp_path_factory.mktemp('runs'))


@pytest.fixture(scope='module')
def sample(base: Recording) -> list[Mutant]:
    """One of every kind and a few more."""
    found = list(breaking_mutants(base, SEED))
    one_each = {one.kind: one for one in found}
    return [*one_each.values(), *Random(SEED).sample(found, 20)]


def test_what_breaks_something_is_named(base: Recording, sample: list[Mutant]) -> None:
    assert base.status == 'verified'
    assert len({one.kind for one in sample}) >= 25
    for one in sample:
        found = in_memory(one)
        assert not found.passed, f'{one.kind}: {one.name}'
        assert found.names & one.names, f'{one.kind}: {one.name}: {found}'


def test_without_new_digests_nothing_is_believed(sample: list[Mutant], tmp_path: Path) -> None:
    definitions = message_definitions()
    for one in sample[::6]:
        found = unstamped_in_memory(one, definitions)
        assert found.status in ('inconclusive', 'refused'), f'{one.kind}: {one.name}'
    found = through_bag(sample[0], tmp_path, definitions, stamped=False)
    assert found.status == 'inconclusive'
    assert 'integrity:altered' in found.names


def test_a_bag_with_new_digests_is_judged_as_its_messages(
    sample: list[Mutant], tmp_path: Path
) -> None:
    for one in sample[3:6]:
        found = through_bag(one, tmp_path, message_definitions(), stamped=True)
        assert found == in_memory(one)


def test_what_breaks_nothing_stays_verified(base: Recording) -> None:
    for one in harmless_mutants(base, SEED, noisy=3):
        assert in_memory(one).status == 'verified', f'{one.kind}: {one.name}'


def test_only_what_was_altered_is_not_the_executor_s(
    base: Recording, sample: list[Mutant]
) -> None:
    assert not by_recomputation(mutant('untouched', '', base, ()))
    kinds = {'phase skipped', 'event moved', 'ledger entry altered', 'sight forged', 'teleport'}
    asked = [one for one in sample if one.kind in kinds]
    assert kinds == {one.kind for one in asked if by_recomputation(one)}


def test_a_bag_that_is_written_anew_holds_the_same_trace(base: Recording, tmp_path: Path) -> None:
    same = mutant('written anew', '', base, ())
    bag = write_bag(same, tmp_path, message_definitions(), other_topics=True)
    content, _ = load_bag(bag)
    assert trace_sha256(content.trace, content.world) == base.reported.sha256
    assert judge_bag(bag).passed
