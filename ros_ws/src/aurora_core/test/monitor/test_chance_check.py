# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Luck that the seed does not give is found; injected losses are no forgery."""

from __future__ import annotations

from types import ModuleType
from typing import Any

import pytest

from aurora_core.comm.link import link_stream
from aurora_core.conditions.derive import derive_conditions
from aurora_core.monitor.plan_check import Plan
from aurora_core.monitor.verify import verify
from aurora_core.outcomes.verdict import Finding, VerdictStatus
from aurora_core.spec.parameter import Unit
from aurora_core.trace.records import ScenarioEventKind

LOSS = 0.5


def lossy(tb: ModuleType, lost: int) -> Any:
    """A case whose link loses half, with so many attempts lost before one passes."""
    case = tb.tailgate_case(lost=lost)
    link = dict(case.spec.links[0]) | {'loss': tb.number(LOSS, Unit.ONE)}
    case.spec = case.spec.model_validate(dict(case.spec) | {'links': (link,)})
    return case


def drawn(seed: int) -> int:
    """Return how many attempts a seed loses before the first one passes."""
    draws = link_stream(seed, 'l1')
    lost = 0
    while draws.random() < LOSS:
        lost += 1
    return lost


# Loses once, so that there can be one loss more and one less.
SEED = next(seed for seed in range(100) if drawn(seed) == 1)


def findings(tb: ModuleType, case: Any) -> tuple[VerdictStatus, list[Finding]]:
    conditions = derive_conditions(case.spec, case.facts, tb.LIMITS, tb.TOLERANCES).conditions
    trace = case.run.trace()
    plan = Plan(conditions=conditions, roster=trace.roster, world=case.world, seed=SEED)
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


def test_an_injected_loss_is_left_out(tb: ModuleType) -> None:
    case = lossy(tb, 2)
    case.run.claim(0, ScenarioEventKind.FAULT, '*', 'link_loss {"at_s":0.0,"value":null}')
    assert findings(tb, case)[1] == []
