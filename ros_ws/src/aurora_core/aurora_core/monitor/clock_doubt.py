# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What a verdict is worth where an autopilot kept its own time: no better than its clock."""

from __future__ import annotations

from aurora_core.outcomes.verdict import ConditionResult, Verdict, VerdictStatus
from aurora_core.spec.parameter import Unit
from aurora_core.trace.air_clock import AirClock


def with_clocks(verdict: Verdict, clocks: tuple[AirClock, ...]) -> Verdict:
    """Return a verdict that says how well the autopilots' clocks were known.

    A margin of a time says so itself. One that is smaller decides nothing, whatever its sign: a
    verdict that hangs on such margins is inconclusive.

    Args:
        verdict: By the times as they were recorded.
        clocks: Of the run; () where it ran in lockstep.
    """
    if not clocks:
        return verdict
    known_s = max(clock.uncertainty_s for clock in clocks)
    open_ids = [r.id for r in verdict.results if _is_open(r, known_s)]
    status = verdict.status
    if open_ids:
        decided = [r for r in verdict.results if r.id not in open_ids]
        broken = any(not (r.satisfied and r.exercised) for r in decided)
        if status is VerdictStatus.VERIFIED or not broken:
            status = VerdictStatus.INCONCLUSIVE
    return verdict.model_copy(
        update={
            'status': status,
            'clocks': clocks,
            'results': tuple(_told(r, known_s, r.id in open_ids) for r in verdict.results),
        }
    )


def _is_open(result: ConditionResult, known_s: float) -> bool:
    return (
        result.unit == Unit.SECOND and result.margin is not None and abs(result.margin) < known_s
    )


def _told(result: ConditionResult, known_s: float, is_open: bool) -> ConditionResult:
    if result.unit != Unit.SECOND or result.margin is None:
        return result
    text = f'times of UAVs are known to ±{known_s:.4f} s'
    if is_open:
        text += ', which decides nothing here'
    explanation = f'{result.explanation}; {text}' if result.explanation else text
    return result.model_copy(update={'explanation': explanation})
