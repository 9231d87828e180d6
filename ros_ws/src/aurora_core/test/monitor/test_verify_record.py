# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What the record lacks or forges: missing ticks, damage, false claims. Never a pass."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from types import ModuleType
from typing import Any

import numpy as np
import pytest
from pydantic import ValidationError

from aurora_core.conditions.derive import derive_conditions
from aurora_core.errors import VerificationError
from aurora_core.judging.codec import conditions_from_json
from aurora_core.monitor.signals_for_plot import signals_for_plot
from aurora_core.monitor.verify import context_of, verify
from aurora_core.outcomes.condition import conditions_to_json
from aurora_core.outcomes.verdict import ConditionResult, Reason, Verdict, VerdictStatus
from aurora_core.trace.layout import UavColumn, UavCommandColumn, UavMode, UavPhase
from aurora_core.trace.records import ScenarioEventKind, SightRecord
from aurora_core.trace.trace import Integrity


def test_missing_samples_leave_no_margin_that_needs_them(tb: ModuleType) -> None:
    case = tb.tailgate_case()
    case.run.missing = (700, 701)
    verdict = tb.judge(case)
    found = {r.id: r for r in verdict.results}
    assert verdict.status is VerdictStatus.INCONCLUSIVE
    assert found['m1.tracked'].reason is Reason.SAMPLES_MISSING
    assert found['safety.collision'].reason is Reason.SAMPLES_MISSING
    assert found['van1.placed'].margin is not None  # decided before
    assert found['e1.delivered'].margin == pytest.approx(1.9)
    assert 'tick 700' in verdict.notes[0]
    for result in verdict.results:
        assert result.margin is None or np.isfinite(result.margin)


def test_a_run_without_its_first_tick_shows_nothing(tb: ModuleType) -> None:
    case = tb.convoy_case()
    case.run.missing = (0,)
    verdict = tb.judge(case)
    assert verdict.status is VerdictStatus.INCONCLUSIVE
    assert {r.reason for r in verdict.results} == {Reason.SAMPLES_MISSING}


@pytest.mark.parametrize('integrity', [Integrity.ALTERED, Integrity.TRUNCATED, Integrity.UNKNOWN])
def test_a_damaged_bag_is_never_better_than_inconclusive(
    tb: ModuleType, integrity: Integrity
) -> None:
    case = tb.convoy_case()
    case.run.integrity = integrity
    verdict = tb.judge(case)
    assert all(r.satisfied for r in verdict.results)  # margins are always recomputed
    assert verdict.status is VerdictStatus.INCONCLUSIVE
    assert verdict.integrity is integrity


def test_a_record_that_was_cut_is_too_short(tb: ModuleType) -> None:
    case = tb.convoy_case()
    case.run.finished = False
    case.facts = case.facts.model_validate(dict(case.facts) | {'horizon_s': 500.0})
    verdict = tb.judge(case)
    found = {r.id: r for r in verdict.results}
    assert verdict.status is VerdictStatus.INCONCLUSIVE
    assert found['safety.collision'].reason is Reason.TRACE_SHORT
    assert found['m1.tracked'].satisfied  # its phase has ended


def test_an_empty_trace_and_unknown_bodies_are_errors(tb: ModuleType) -> None:
    case = tb.convoy_case()
    conditions = derive_conditions(case.spec, case.facts, tb.LIMITS, tb.TOLERANCES).conditions
    trace = case.run.trace()
    with pytest.raises(VerificationError, match='no tick'):
        verify(replace(trace, uav=trace.uav[:0]), case.world, conditions, case.spec)
    case.run.agents.pop(1)
    with pytest.raises(VerificationError, match="no body 'bus1'"):
        verify(case.run.trace(), case.world, conditions, case.spec)


def test_margins_do_not_depend_on_the_way_the_conditions_travelled(tb: ModuleType) -> None:
    case = tb.tailgate_case(lost=1)
    conditions = derive_conditions(case.spec, case.facts, tb.LIMITS, tb.TOLERANCES).conditions
    again = conditions_from_json(conditions_to_json(conditions))
    a = verify(case.run.trace(), case.world, conditions, case.spec)
    b = verify(case.run.trace(), case.world, again, case.spec)
    assert a.canonical_json() == b.canonical_json()
    assert Verdict.model_validate_json(a.canonical_json()) == a


def _tick(case: Any) -> int:
    return int(case.run.links[0].tick)


def _late_trigger(case: Any, tb: ModuleType) -> None:
    for k, record in enumerate(case.run.events):
        case.run.events[k] = replace(record, tick=record.tick + 5)
    case.run.links[:] = []
    tb.message(case, case.run.events[0].tick)


def _no_trigger_claim(case: Any, tb: ModuleType) -> None:
    case.run.events[:] = [e for e in case.run.events if e.kind is not ScenarioEventKind.TRIGGERED]


def _unknown_event(case: Any, tb: ModuleType) -> None:
    case.run.claim(50, ScenarioEventKind.TRIGGERED, 'e9')


def _action_without_message(case: Any, tb: ModuleType) -> None:
    case.run.links[:] = []


def _false_sight(case: Any, tb: ModuleType) -> None:
    case.world = tb.world(weather='fog')
    case.run.flights[0].states[400:, 1] += 200.0
    case.run.links[:] = []
    tb.message(case, case.run.events[0].tick)
    case.run.sights.append(_sight(case, 600, True))


def _sight(case: Any, tick: int, visible: bool) -> SightRecord:
    trace = case.run.trace()
    dx, dy, dz = trace.uav[tick, 0, :3] - (*trace.ground[tick, 1, :2], 1.1)
    slant = float(np.sqrt(dx * dx + dy * dy + dz * dz))
    return SightRecord(
        tick=tick, observer='uav1', target='van1', visible=visible, slant_range_m=slant
    )


def _false_range(case: Any, tb: ModuleType) -> None:
    case.run.sights.append(replace(_sight(case, 600, True), slant_range_m=10.0))


def _unknown_observer(case: Any, tb: ModuleType) -> None:
    case.run.sights.append(replace(_sight(case, 600, True), observer='uav7'))


def _mode_not_reported(case: Any, tb: ModuleType) -> None:
    case.run.flights[0].states[1050:, UavColumn.MODE] = UavMode.OFFBOARD


def _phase_without_motion(case: Any, tb: ModuleType) -> None:
    """Landing is claimed with set-points elsewhere, the UAV goes on tracking."""
    one = case.run.flights[0]
    one.commands[900:1050, UavCommandColumn.PHASE] = UavPhase.LANDING
    one.commands[900:1050, UavCommandColumn.Y] += 30.0


@pytest.mark.parametrize(
    ('forge', 'kind', 'text'),
    [
        (_late_trigger, 'event', 'trigger claimed at tick 650, the states give tick 645'),
        (_no_trigger_claim, 'event', 'trigger claimed at tick None, the states give tick 645'),
        (_unknown_event, 'event', 'the request does not have'),
        (_action_without_message, 'event', 'action claimed at ticks'),
        (_false_sight, 'sight', 'claimed visible: True'),
        (_false_range, 'sight', 'claimed at 10.0 m'),
        (_unknown_observer, 'sight', 'unknown observer'),
        (_mode_not_reported, 'phase', 'mode LAND commanded'),
        (_phase_without_motion, 'phase', 'm off its set-point'),
    ],
)
def test_false_claims_are_found_and_located(
    tb: ModuleType, forge: Callable[[Any, ModuleType], None], kind: str, text: str
) -> None:
    case = tb.tailgate_case()
    forge(case, tb)
    verdict = tb.judge(case)
    assert verdict.status is VerdictStatus.INCONCLUSIVE
    found = [f for f in verdict.cross_check if f.kind == kind and text in f.text]
    assert found, [f.text for f in verdict.cross_check]
    assert found[0].time_s == pytest.approx(found[0].tick * 0.05)


def test_honest_claims_of_sight_agree(tb: ModuleType) -> None:
    case = tb.tailgate_case()
    case.run.sights.append(_sight(case, 600, True))
    assert tb.judge(case).status is VerdictStatus.VERIFIED


def test_a_trigger_claim_that_was_due_after_the_end_is_no_finding(tb: ModuleType) -> None:
    case = tb.tailgate_case()
    case.run.events[:] = []
    case.run.finished = False
    case.run.missing = (645,)
    assert tb.judge(case).cross_check == ()


def test_a_result_has_a_margin_or_a_reason(tb: ModuleType) -> None:
    verdict = tb.judge(tb.convoy_case())
    good = dict(verdict.results[0])
    with pytest.raises(ValidationError, match='either a margin or a reason'):
        ConditionResult.model_validate(good | {'margin': None})
    with pytest.raises(ValidationError, match='not satisfied'):
        ConditionResult.model_validate(good | {'margin': None, 'reason': Reason.EMPTY_PHASE})


def test_the_worst_result_is_one_without_a_margin_if_there_is_one(tb: ModuleType) -> None:
    good = tb.judge(tb.convoy_case())
    assert good.worst is not None
    assert good.worst.normalised == min(r.normalised for r in good.results)
    bad = tb.judge(tb.tailgate_case(keeps_away=True))
    assert bad.worst is not None
    assert bad.worst.margin is None


def test_signals_for_pictures(tb: ModuleType) -> None:
    case = tb.tailgate_case()
    conditions = derive_conditions(case.spec, case.facts, tb.LIMITS, tb.TOLERANCES).conditions
    verdict = verify(case.run.trace(), case.world, conditions, case.spec)
    drawn = {
        p.condition_id: p
        for p in signals_for_plot(context_of(case.run.trace(), case.world, conditions, case.spec))
    }
    margins = {r.id: r.margin for r in verdict.results}
    assert {name: p.margin for name, p in drawn.items()} == margins
    gap = drawn['van1.tailgate']
    assert len(gap.times_s) == len(gap.values) == len(gap.robustness) == 1401
    assert gap.threshold == 1.0
    assert gap.robustness == pytest.approx(1.0 - gap.values)
    share = drawn['m1.tracked']
    assert share.threshold == 0.8
    assert share.held is not None
    assert len(share.times_s) == len(share.held) == len(share.robustness) > 500
    assert share.robustness[-1] == share.margin
    case.run.missing = (0,)
    gone = context_of(case.run.trace(), case.world, conditions, case.spec)
    assert signals_for_plot(gone) == ()
