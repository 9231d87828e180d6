# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from collections.abc import Callable

from aurora_core.outcomes.agsg import Agsg
from aurora_core.outcomes.repair import (
    Anchor,
    Attempt,
    AttemptOutcome,
    ProposalOutcome,
    RepairPlan,
    Step,
)
from aurora_core.outcomes.verdict import Verdict
from aurora_core.repair.propose import propose
from aurora_core.repair.settings import load_repair_settings

SETTINGS = load_repair_settings()
Failing = Callable[..., Verdict]
HERE = Anchor(lane='a_0', position_m=10.0)
THERE = Anchor(lane='b_0', position_m=30.0)


def attempt(anchor: Anchor | None, outcome: str = 'violated', **more: object) -> Attempt:
    fields = {'iteration': 0, 'anchor': anchor, 'outcome': outcome, **more}
    return Attempt.model_validate(fields)


def test_a_scene_that_did_not_come_true_goes_to_another_road(agsg: Agsg, failing: Failing) -> None:
    found = propose(agsg, failing(van1__tailgate=-0.5), (attempt(HERE), attempt(THERE)), SETTINGS)
    assert (found.outcome, found.step) == (ProposalOutcome.EDITED, Step.GROUNDING)
    assert found.plan.avoided == (HERE, THERE)
    assert found.plan.values == ()
    assert 'van1.tailgate misses by 0.5' in found.reason


def test_who_tells_nothing_of_the_past_asks_of_the_realisation_alone(
    agsg: Agsg, failing: Failing
) -> None:
    assert agsg.grounding is not None
    found = propose(agsg, failing(van1__tailgate=-0.5), (), SETTINGS)
    assert found.step is Step.GROUNDING
    assert [place.lane for place in found.plan.avoided] == [agsg.grounding.anchor_lane]


def test_where_no_other_road_does_another_place_of_the_same_is_tried_then_none(
    agsg: Agsg, failing: Failing
) -> None:
    verdict = failing(van1__tailgate=-0.5)
    roads = RepairPlan(avoided=(HERE,))
    none = attempt(None, AttemptOutcome.NO_PLACE, step=Step.GROUNDING, plan=roads)
    narrow = propose(agsg, verdict, (attempt(HERE), none), SETTINGS)
    assert [place.whole_road for place in narrow.plan.avoided] == [False]
    again = attempt(None, AttemptOutcome.NO_PLACE, step=Step.GROUNDING, plan=narrow.plan)
    last = propose(agsg, verdict, (attempt(HERE), none, again), SETTINGS)
    assert last.outcome is ProposalOutcome.EXHAUSTED
    assert last.implicated


def test_nothing_is_proposed_for_what_no_realisation_changes(agsg: Agsg, failing: Failing) -> None:
    found = propose(agsg, failing(), (attempt(HERE),), SETTINGS)
    assert found.outcome is ProposalOutcome.OUT_OF_SCOPE
