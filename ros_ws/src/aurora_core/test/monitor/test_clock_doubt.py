# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""A time that is known to 5 ms decides nothing about a margin of 3 ms."""

from __future__ import annotations

import pytest

from aurora_core.monitor.clock_doubt import with_clocks
from aurora_core.outcomes.verdict import ConditionResult, Verdict, VerdictStatus
from aurora_core.spec.parameter import Provenance
from aurora_core.trace.air_clock import AirClock, clocks_note, read_clocks
from aurora_core.trace.trace import Integrity

CLOCK = AirClock(
    uav_id='uav1',
    offset_s=-12.0,
    drift_ppm=200.0,
    drift_sigma_ppm=11.0,
    uncertainty_s=0.005,
    round_trips=700,
    shortest_s=0.002,
    longest_s=0.06,
)


def result(name: str, margin: float, unit: str = 's') -> ConditionResult:
    return ConditionResult(
        id=name,
        sentence='it happens in time',
        explanation='it happened at 3 s',
        formula='x >= 0',
        op='>=',
        threshold=0.0,
        margin=margin,
        unit=unit,
        satisfied=margin >= 0.0,
        exercised=True,
        provenance=Provenance.EXPLICIT,
    )


def verdict(*results: ConditionResult) -> Verdict:
    held = all(r.satisfied for r in results)
    return Verdict(
        status=VerdictStatus.VERIFIED if held else VerdictStatus.VIOLATED,
        results=results,
        integrity=Integrity.INTACT,
    )


@pytest.mark.parametrize(
    ('results', 'status'),
    [
        ((result('a', 0.2),), VerdictStatus.VERIFIED),
        ((result('a', 0.0),), VerdictStatus.INCONCLUSIVE),
        ((result('a', 0.003), result('b', 1.0)), VerdictStatus.INCONCLUSIVE),
        # What is missed by less than is known may as well have been in time.
        ((result('a', -0.003),), VerdictStatus.INCONCLUSIVE),
        # What is violated for sure stays so.
        ((result('a', 0.003), result('b', -1.0)), VerdictStatus.VIOLATED),
        ((result('a', -0.003), result('b', -1.0, 'm')), VerdictStatus.VIOLATED),
        ((result('a', -0.2),), VerdictStatus.VIOLATED),
        ((result('a', 0.001, 'm'),), VerdictStatus.VERIFIED),
    ],
)
def test_no_verdict_hangs_on_less_than_the_clock_is_known_by(
    results: tuple[ConditionResult, ...], status: VerdictStatus
) -> None:
    judged = with_clocks(verdict(*results), (CLOCK,))
    assert judged.status is status
    assert judged.clocks == (CLOCK,)
    assert [r.margin for r in judged.results] == [r.margin for r in results]


def test_the_times_say_so() -> None:
    judged = with_clocks(verdict(result('a', 0.003), result('b', 1.0, 'm')), (CLOCK,))
    told = 'it happened at 3 s; times of UAVs are known to ±0.0050 s, which decides nothing here'
    assert [r.explanation for r in judged.results] == [told, 'it happened at 3 s']


def test_lockstep_is_as_it_was() -> None:
    before = verdict(result('a', 0.0))
    assert with_clocks(before, ()) is before
    assert 'clocks' not in before.model_dump(mode='json')


def test_the_record_is_read_back_and_damage_is_told() -> None:
    assert read_clocks(clocks_note((CLOCK,))) == (CLOCK,)
    for damaged in ({}, {'clocks': '[]'}, {'clocks': '[{"uav_id": 1}]'}, {'clocks': 'x' * 70_000}):
        with pytest.raises(ValueError):
            read_clocks(damaged)
