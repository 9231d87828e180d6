# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Luck that the seed does not give is found; injected losses are no forgery."""

from __future__ import annotations

from dataclasses import replace
from types import ModuleType
from typing import Any

import pytest

from aurora_core.comm.link import link_stream
from aurora_core.conditions.derive import derive_conditions
from aurora_core.monitor.plan_check import Plan
from aurora_core.monitor.verify import verify
from aurora_core.outcomes.verdict import Finding, VerdictStatus
from aurora_core.spec.parameter import Unit
from aurora_core.trace.records import LinkEventKind, ScenarioEventKind

LOSS = 0.5
# So much farther than the ends are apart their link reaches: about 0.4 of the attempts fade.
EDGE = 1.05


def lossy(tb: ModuleType, lost: int) -> Any:
    """A case whose link loses half, with so many attempts lost before one passes."""
    case = tb.tailgate_case(lost=lost)
    link = dict(case.spec.links[0]) | {'loss': tb.number(LOSS, Unit.ONE)}
    case.spec = case.spec.model_validate(dict(case.spec) | {'links': (link,)})
    return case


def fading(tb: ModuleType, lost: int) -> Any:
    """A case of which nothing is stated, with so many attempts lost at the edge of the range."""
    case = tb.tailgate_case(lost=lost)
    apart_m = next(r.distance_m for r in case.run.links if r.attempt == 0)
    limits = tb.LIMITS.model_copy(
        update={'link_range_sight_m': EDGE * apart_m, 'link_decade_db': 1.0}
    )
    case.world = replace(case.world, limits=limits)
    return case


def faded(tb: ModuleType, seed: int) -> int:
    """Return how many attempts fade, by the closed form, before the first one passes."""
    range_m = fading(tb, 0).world.limits.link_range_sight_m
    draws = link_stream(seed, 'l1').random(4)
    apart = [r.distance_m for r in fading(tb, 4).run.links if r.kind is LinkEventKind.ATTEMPT_LOST]
    lost = [u < (d / range_m) ** 16.7 for u, d in zip(draws, apart, strict=True)]
    return [*lost, False].index(False)


def drawn(seed: int) -> int:
    """Return how many attempts a seed loses before the first one passes."""
    draws = link_stream(seed, 'l1')
    lost = 0
    while draws.random() < LOSS:
        lost += 1
    return lost


# Loses once, so that there can be one loss more and one less.
SEED = next(seed for seed in range(100) if drawn(seed) == 1)


def findings(tb: ModuleType, case: Any, seed: int = SEED) -> tuple[VerdictStatus, list[Finding]]:
    conditions = derive_conditions(case.spec, case.facts, tb.LIMITS, tb.TOLERANCES).conditions
    trace = case.run.trace()
    plan = Plan(conditions=conditions, roster=trace.roster, world=case.world, seed=seed)
    verdict = verify(trace, case.world, conditions, case.spec, plan)
    return verdict.status, [f for f in verdict.cross_check if f.kind == 'chance']


def test_the_luck_of_the_seed_is_honest(tb: ModuleType) -> None:
    assert findings(tb, lossy(tb, 1)) == (VerdictStatus.VERIFIED, [])


@pytest.mark.parametrize('more', [1, -1])
def test_other_luck_is_found_at_its_attempt(tb: ModuleType, more: int) -> None:
    status, found = findings(tb, lossy(tb, 1 + more))
    assert status is VerdictStatus.INCONCLUSIVE
    assert len(found) == 1
    assert f'the draw of seed {SEED} is {"passed" if more > 0 else "lost"}' in found[0].text


def test_what_fades_at_the_edge_of_the_range_is_by_the_draws_too(tb: ModuleType) -> None:
    lucky, unlucky = (next(s for s in range(100) if faded(tb, s) == count) for count in (0, 1))
    assert findings(tb, fading(tb, 0), lucky)[1] == []
    assert findings(tb, fading(tb, 1), unlucky)[1] == []
    # An executor that lets everything inside the range pass, and one that loses what is heard.
    for seed, lost, word in ((unlucky, 0, 'lost'), (lucky, 1, 'passed')):
        status, found = findings(tb, fading(tb, lost), seed)
        assert status is VerdictStatus.INCONCLUSIVE
        assert [f'the draw of seed {seed} is {word}' in f.text for f in found] == [True]


def test_an_injected_loss_is_left_out(tb: ModuleType) -> None:
    case = lossy(tb, 2)
    case.run.claim(0, ScenarioEventKind.FAULT, '*', 'link_loss {"at_s":0.0,"value":null}')
    assert findings(tb, case)[1] == []
