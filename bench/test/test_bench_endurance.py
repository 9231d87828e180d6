# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What the endurance campaign calls growth, and that it looks at this very process."""

from __future__ import annotations

import os
import threading
from dataclasses import replace

import pytest

from aurora_bench.endurance import __main__ as endurance
from aurora_bench.endurance.cases import cases
from aurora_bench.endurance.holdings import Holdings, growth_goals, holdings

EARLY = Holdings(memory_mib=200.0, descriptors=9, threads=3, shared_memory=frozenset({'theirs'}))


def unmet(late: Holdings) -> list[str]:
    return [
        goal.name.split(' after')[0] for goal in growth_goals(EARLY, late, 10, 100) if not goal.met
    ]


@pytest.mark.parametrize(
    ('late', 'broken'),
    [
        (EARLY, []),
        (replace(EARLY, memory_mib=209.9), []),
        (replace(EARLY, memory_mib=150.0, shared_memory=frozenset()), []),
        (replace(EARLY, memory_mib=210.5), ['resident memory']),
        (replace(EARLY, descriptors=10), ['open descriptors']),
        (replace(EARLY, threads=4), ['threads']),
        (replace(EARLY, shared_memory=frozenset({'theirs', 'ours'})), ['new names in /dev/shm']),
    ],
)
def test_growth(late: Holdings, broken: list[str]) -> None:
    assert unmet(late) == broken


def test_a_new_descriptor_and_a_new_thread_are_seen() -> None:
    before = holdings()
    end = threading.Event()
    thread = threading.Thread(target=end.wait)
    reader, writer = os.pipe()
    thread.start()
    try:
        after = holdings()
    finally:
        end.set()
        thread.join()
        os.close(reader)
        os.close(writer)
    assert (after.descriptors, after.threads) == (before.descriptors + 2, before.threads + 1)
    assert before.memory_mib > 10.0


def test_repetitions_that_differ_and_errors_are_counted() -> None:
    same = [('verified', 'a'), ('verified', 'a')]
    goals = endurance.sameness_goals([same, [('violated', 'b'), ('violated', 'c')]])
    assert [(goal.figure, goal.met) for goal in goals] == [('1', False), ('0', True)]
    goals = endurance.sameness_goals([same, [('error', ''), ('error', '')]])
    assert [(goal.figure, goal.met) for goal in goals] == [('0', True), ('2', False)]


def test_every_case_has_had_its_turn_by_the_early_sample() -> None:
    assert len(cases()) <= endurance._EARLY_RUNS
    with pytest.raises(SystemExit):
        endurance.main(['--runs', str(endurance._EARLY_RUNS)])
