# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Stated numbers with which a recorded run would hold: proposals to whoever asked, no repair.

A number is moved by what its condition lacks, the conditions are derived anew from the changed
request, and the recorded trace is judged by them. What holds is another request than the one that
was asked; the verdict on that one stays.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from aurora_core.agsg.influence import parameters_by_condition
from aurora_core.monitor.verify import context_of, judge
from aurora_core.outcomes.agsg import Agsg, AgsgParameter
from aurora_core.outcomes.repair import restated
from aurora_core.outcomes.triggers import as_realised
from aurora_core.outcomes.verdict import ConditionResult, Verdict, VerdictStatus
from aurora_core.pipeline.knowledge import Knowledge
from aurora_core.pipeline.planned import plan_conditions
from aurora_core.report.run_report import RelaxedReport, StatedChange
from aurora_core.spec.parameter import Provenance
from aurora_core.trace.bag_content import BagContent

# Numbers are written with so many digits behind the point, outwards.
_DIGITS = 2


def relaxed(
    known: Knowledge, agsg: Agsg, verdict: Verdict, content: BagContent
) -> RelaxedReport | None:
    """Return which stated numbers would have to be others for a recorded run to hold.

    Args:
        known: What is installed here.
        agsg: Graph that was executed.
        verdict: Of the trace, violated.
        content: The recording.

    Returns:
        The changes and the verdict on the request with all of them; None where no stated number
        is what does not hold.
    """
    held = {row.id for row in verdict.results if _holds(row)}
    rows = {row.path: row for row in agsg.parameters}
    affecting = parameters_by_condition(agsg)
    changes: dict[str, StatedChange] = {}
    for result in (row for row in verdict.results if not _holds(row)):
        near = affecting.get(result.id, ())
        paths = [i.parameter for i in near if i.provenance is Provenance.EXPLICIT]
        for row in (rows[path] for path in paths if rows[path].unit == result.unit):
            change = _change(known, agsg, content, row, result, held)
            if change is not None:
                changes.setdefault(row.path, change)
                break
    if not changes:
        return None
    after = _judged(known, agsg, content, {c.path: c.relaxed for c in changes.values()})
    holds = all(map(_holds, after.values()))
    return RelaxedReport(
        changes=tuple(changes.values()),
        verdict=VerdictStatus.VERIFIED if holds else VerdictStatus.VIOLATED,
    )


def _change(
    known: Knowledge,
    agsg: Agsg,
    content: BagContent,
    row: AgsgParameter,
    result: ConditionResult,
    held: set[str],
) -> StatedChange | None:
    """Return the nearest value with which a condition holds and none that held is lost."""
    for value in _values(row, result):
        after = _judged(known, agsg, content, {row.path: value})
        again = after.get(result.id)
        if again is None or not _holds(again):
            continue
        if any(not _holds(after[name]) for name in held if name in after):
            continue
        return StatedChange(
            path=row.path,
            stated=row.requested,
            relaxed=value,
            unit=row.unit.value,
            condition=result.id,
            sentence=again.sentence,
        )
    return None


def _values(row: AgsgParameter, result: ConditionResult) -> Iterator[float]:
    """Yield a stated number moved by what its condition lacks, either way, inside its domain."""
    if result.margin is None or result.margin >= 0.0:
        return
    step = 10.0**-_DIGITS
    for sign in (1.0, -1.0):
        value = round(row.requested + sign * (step - result.margin), _DIGITS)
        if row.low <= value <= row.high:
            yield value


def _judged(
    known: Knowledge, agsg: Agsg, content: BagContent, values: Mapping[str, float]
) -> dict[str, ConditionResult]:
    """Return how the recorded trace does by the request with other numbers, by condition."""
    grounded, schedule = agsg.grounding, agsg.schedule
    assert grounded is not None  # it was executed
    assert schedule is not None
    spec = restated(agsg.spec, values)
    planned = plan_conditions(spec, grounded, schedule, known.limits, known.tolerances)
    asked = as_realised(spec, grounded)
    context = context_of(content.trace, content.world, planned.conditions, asked)
    return {c.id: judge(context, c) for c in planned.conditions}


def _holds(row: ConditionResult) -> bool:
    return row.satisfied and row.exercised
