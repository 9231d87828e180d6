# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The live verdict beside the bag's: equal, or nothing is claimed."""

from __future__ import annotations

import math

import pytest

pytest.importorskip('rclpy')

from aurora_core.outcomes.verdict import ConditionResult, Verdict, VerdictStatus
from aurora_core.spec.parameter import Provenance
from aurora_core.trace.trace import Integrity
from aurora_nodes.judgement import Judgement, LiveOutcome, reconcile


def judgement(margin: float = 0.1, run_id: str = 'r1', trace: str = 'a' * 64) -> Judgement:
    result = ConditionResult(
        id='m1.altitude',
        sentence='it keeps its altitude',
        explanation='it did',
        formula='G(a >= 0)',
        op='>=',
        threshold=0.0,
        margin=margin,
        unit='m',
        normalised=margin,
        satisfied=True,
        exercised=True,
        provenance=Provenance.DEFAULT,
    )
    return Judgement(
        run_id=run_id,
        iteration=0,
        graph_sha256='b' * 64,
        trace_sha256=trace,
        last_tick=40,
        end_s=2.0,
        verdict=Verdict(
            status=VerdictStatus.VERIFIED, results=(result,), integrity=Integrity.INTACT
        ),
    )


def heard(live: Judgement, iteration: int = 0) -> LiveOutcome:
    return LiveOutcome(run_id=live.run_id, iteration=iteration, judgement=live)


def test_equal_or_unknown_leaves_the_verdict_of_the_bag_as_it_is() -> None:
    bag = judgement()
    for live in (
        None,
        heard(judgement()),
        heard(judgement(0.7, run_id='r2')),
        heard(judgement(0.7), iteration=1),
    ):
        assert reconcile(bag, live) is bag.verdict


def test_one_bit_makes_it_inconclusive_with_both_values() -> None:
    verdict = reconcile(judgement(0.1), heard(judgement(math.nextafter(0.1, 1.0))))
    assert verdict.status is VerdictStatus.INCONCLUSIVE
    (finding,) = verdict.cross_check
    assert (finding.kind, finding.subject, finding.tick) == ('live', 'm1.altitude', 40)
    assert 'live margin 0.10000000000000002, bag 0.1' in finding.text
    assert verdict.results == judgement(0.1).verdict.results


def test_another_trace_with_equal_margins_is_inconclusive() -> None:
    verdict = reconcile(judgement(), heard(judgement(trace='c' * 64)))
    assert verdict.status is VerdictStatus.INCONCLUSIVE
    assert 'c' * 64 in verdict.cross_check[0].text
    assert 'a' * 64 in verdict.cross_check[0].text


def test_a_run_that_could_not_be_judged_live_is_inconclusive() -> None:
    live = LiveOutcome(run_id='r1', iteration=0, problem='the roster was not heard')
    verdict = reconcile(judgement(), live)
    assert verdict.status is VerdictStatus.INCONCLUSIVE
    assert 'live none (the roster was not heard), bag verified' in verdict.cross_check[0].text
