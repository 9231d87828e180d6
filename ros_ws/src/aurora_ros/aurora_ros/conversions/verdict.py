# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The monitor's verdict to its messages; `verdict_json` is the truth."""

from __future__ import annotations

import math
from collections.abc import Sequence

from aurora_core.monitor.online import Outlook
from aurora_core.outcomes.condition import Condition
from aurora_core.outcomes.verdict import ConditionResult, Verdict
from aurora_core.stl.online import OnlineVerdict
from aurora_msgs.msg import ConditionMargin, Margins
from aurora_msgs.msg import Verdict as VerdictMessage
from aurora_ros.conversions.time import header


def verdict_message(
    verdict: Verdict,
    *,
    run_id: str,
    iteration: int,
    end_s: float,
    trace_sha256: str,
    source: int = VerdictMessage.BAG,
) -> VerdictMessage:
    """Return the message of a verdict.

    Args:
        verdict: What the trace shows.
        run_id: Of the run.
        iteration: Repair iteration.
        end_s: Simulated time of the last tick.
        trace_sha256: Trace hash (hex).
        source: What was judged, the bag or what was published live.
    """
    return VerdictMessage(
        header=header(1, end_s),
        run_id=run_id,
        iteration=iteration,
        status=verdict.status.value,
        conditions=[_margin(result) for result in verdict.results],
        integrity=verdict.integrity.value,
        trace_sha256=trace_sha256,
        verdict_json=verdict.canonical_json(),
        source=source,
    )


def margins_message(verdict: Verdict, *, run_number: int, tick: int, end_s: float) -> Margins:
    """Return the margins of a verdict by themselves.

    Args:
        verdict: What the trace shows.
        run_number: Of the run.
        tick: Last tick that was judged.
        end_s: Simulated time of that tick.
    """
    return Margins(
        header=header(1, end_s),
        run_number=run_number,
        tick=tick,
        conditions=[_margin(result) for result in verdict.results],
    )


def outlooks_message(
    conditions: Sequence[Condition],
    outlooks: Sequence[Outlook],
    *,
    run_number: int,
    tick: int,
    end_s: float,
) -> Margins:
    """Return what a run that goes on can still become.

    Args:
        conditions: What has to hold.
        outlooks: One for each, in the same order.
        run_number: Of the run.
        tick: Last tick that was looked at.
        end_s: Simulated time of that tick.
    """
    return Margins(
        header=header(1, end_s),
        run_number=run_number,
        tick=tick,
        conditions=[
            _so_far(condition, outlook)
            for condition, outlook in zip(conditions, outlooks, strict=True)
        ],
    )


def _so_far(condition: Condition, outlook: Outlook) -> ConditionMargin:
    now = outlook.now
    return ConditionMargin(
        id=condition.id,
        sentence=condition.sentence,
        has_margin=now is not None,
        margin=_number(now),
        normalised=_number(None if now is None else now / condition.scale),
        unit=condition.unit,
        satisfied=outlook.verdict in (OnlineVerdict.TRUE, OnlineVerdict.CURRENTLY_TRUE),
        exercised=now is not None,
        reason='',
        worst_time_s=math.nan,
        low=outlook.low,
        high=outlook.high,
        verdict=outlook.verdict.value,
    )


def _margin(result: ConditionResult) -> ConditionMargin:
    decided = OnlineVerdict.TRUE if result.satisfied else OnlineVerdict.FALSE
    return ConditionMargin(
        id=result.id,
        sentence=result.sentence,
        has_margin=result.margin is not None,
        margin=_number(result.margin),
        normalised=_number(result.normalised),
        unit=result.unit,
        satisfied=result.satisfied,
        exercised=result.exercised,
        reason=result.reason.value if result.reason is not None else '',
        worst_time_s=_number(result.worst_time_s),
        low=_number(result.margin),
        high=_number(result.margin),
        verdict=(OnlineVerdict.UNKNOWN if result.margin is None else decided).value,
    )


def _number(value: float | None) -> float:
    return math.nan if value is None else value
