# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Fault localization: from violated conditions to what of the realisation can be at fault.

From each violated condition the typed edges of the graph lead back to the parameters that can
affect it (`agsg.influence`); the quantity says how each kind of value works on it
(`repair.helps`), and the margin how bad it is. What follows from something that never happened
counts less than the reason why it did not.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from types import MappingProxyType

from aurora_core.agsg.influence import Influence, parameters_affecting
from aurora_core.judging.evaluation import Context
from aurora_core.outcomes.agsg import Agsg, AgsgParameter
from aurora_core.outcomes.repair import Implicated
from aurora_core.outcomes.verdict import ConditionResult, Reason, Verdict
from aurora_core.quantities.view import RunView
from aurora_core.repair.experience import weight
from aurora_core.repair.helps import ANCHOR, Help, helps
from aurora_core.repair.lock import is_movable
from aurora_core.repair.reach import out_of_reach, reporting_tracker, waits_to_get_far
from aurora_core.repair.shown import why_not_seen, why_sent_late

# How bad it is that a margin is missing (normalised), and what a mere consequence counts.
_NO_MARGIN = 1.0
_CONSEQUENCE = 0.5
_WORST = 3.0
# What geometry proves speaks louder than what often helps.
_EVIDENCE = 6.0
# A value far on the wrong side of its domain is more likely at fault than one that is not.
_LEAST_ROOM, _ROOM = 0.5, 2.0
# The anchor is one step away from everybody, as the environment is.
_ANCHOR_STEPS = 1
# Who tracks what drives off may report only once it has captured it; mostly that is no reason.
_SELDOM = 0.1
_BEHIND = 'who tracks from farther behind has less to catch up before it may report'


@dataclass(slots=True)
class _Case:
    """What speaks for one field and direction."""

    score: float = 0.0
    conditions: list[str] = field(default_factory=list)
    reason: str = ''
    aim: float | None = None
    best: float = 0.0

    def add(self, score: float, condition: str, reason: str, aim: float | None) -> None:
        self.score += score
        self.aim = self.aim if aim is None else aim
        if condition not in self.conditions:
            self.conditions.append(condition)
        if score > self.best:
            self.best, self.reason = score, reason


def violated(verdict: Verdict) -> tuple[ConditionResult, ...]:
    """Return the results that do not hold, or were not exercised, in their order."""
    return tuple(row for row in verdict.results if not (row.satisfied and row.exercised))


def localize(
    agsg: Agsg,
    verdict: Verdict,
    learned: Mapping[str, float] = MappingProxyType({}),
    view: RunView | None = None,
) -> tuple[Implicated, ...]:
    """Return what can be at fault, what most speaks for first; equal ones by name.

    Only what repair may move is in it: the admissible neighbourhood N(S_k).

    Args:
        agsg: Grounded, as it was executed.
        verdict: Of its trace.
        learned: How much more a move counts than usual (`repair.experience`).
        view: What was recorded (`repair.shown`). It and what was learned order what is in it, and
            take nothing in or out.
    """
    context = None if view is None else Context(view, agsg.realised_spec, agsg.conditions)
    rows = violated(verdict)
    conditions = {condition.id: condition for condition in agsg.conditions}
    movable = {row.path: row for row in agsg.parameters if is_movable(row)}
    cases: dict[tuple[str, int], _Case] = {}
    roots = _roots(rows)
    for row in rows:
        condition = conditions.get(row.id)
        if condition is None:
            continue
        share = 1.0 if row.id in roots else _CONSEQUENCE
        influences = parameters_affecting(agsg, row.id)
        seen = None if context is None else why_not_seen(context, condition)
        waits_far = waits_to_get_far(agsg, condition) is not None
        in_vain = waits_far and row.margin is None
        known_help = helps(condition.quantity, condition.op, gets_far=in_vain)
        for name, direction, score, reason in _speaking(known_help, row, influences, movable):
            case = cases.setdefault((name, direction), _Case())
            known = weight(learned, condition.quantity.value, name, direction)
            if seen is not None:
                last = name if name == ANCHOR else name.rpartition('/')[2]
                known *= seen.factors.get((last, direction), 1.0)
                reason = f'{reason} ({seen.told})'
            case.add(share * score * known, row.id, reason, None)
        # A distance that was exceeded is not out of reach.
        proven = {} if waits_far and not in_vain else out_of_reach(agsg, condition)
        tracker = reporting_tracker(agsg, condition)
        if tracker is not None and tracker[0] in movable and row.margin is not None:
            late = None if context is None else why_sent_late(context, condition, *tracker)
            if late is not None:
                proven = {tracker[0]: late, **proven}
            case = cases.setdefault((tracker[0], 1), _Case())
            case.add(share * _severity(row) * _SELDOM, row.id, f'{_told(row)}: {_BEHIND}', None)
        for name, evidence in proven.items():
            if name in movable:
                case = cases.setdefault((name, evidence.direction), _Case())
                score = share * _severity(row) * _EVIDENCE
                case.add(score, row.id, f'{_told(row)}: {evidence.because}', evidence.aim)
    found = [
        Implicated(
            field=name,
            score=case.score,
            direction=direction,
            aim=case.aim,
            conditions=tuple(case.conditions),
            reason=case.reason,
        )
        for (name, direction), case in cases.items()
    ]
    return tuple(sorted(found, key=lambda i: (-i.score, i.field, -i.direction)))


def _roots(rows: Sequence[ConditionResult]) -> frozenset[str]:
    """Return the conditions that are no mere consequence of another one.

    What has no margin because its premise never came follows from why that did not: as long as
    something else has a margin that is negative, that is nearer to the cause.
    """
    measured = frozenset(row.id for row in rows if row.margin is not None)
    return measured or frozenset(row.id for row in rows)


def _speaking(
    known_help: Sequence[Help],
    row: ConditionResult,
    influences: Sequence[Influence],
    movable: Mapping[str, AgsgParameter],
) -> Iterator[tuple[str, int, float, str]]:
    """Yield field, direction, score and reason of all that can be at fault for one condition."""
    severity = _severity(row)
    told = _told(row)
    for help_ in known_help:
        if help_.name == ANCHOR:
            score = severity * help_.weight / (1.0 + _ANCHOR_STEPS)
            yield ANCHOR, 0, score, f'{told}: {help_.because}'
            continue
        for influence in influences:
            parameter = movable.get(influence.parameter)
            if parameter is None or influence.parameter.rpartition('/')[2] != help_.name:
                continue
            room = _room(parameter, help_.direction)
            if room <= 0.0:
                continue
            share = _LEAST_ROOM + _ROOM * room
            score = severity * share * help_.weight / (1.0 + influence.distance)
            yield influence.parameter, help_.direction, score, f'{told}: {help_.because}'


def _severity(row: ConditionResult) -> float:
    if row.normalised is None:
        return _NO_MARGIN
    return min(_WORST, 0.5 + math.log1p(abs(row.normalised)))


def _told(row: ConditionResult) -> str:
    if row.margin is None:
        why = (row.reason or Reason.PREMISE_NEVER).value.replace('_', ' ')
        return f'{row.id} has no margin ({why})'
    when = '' if row.worst_time_s is None else f' at {row.worst_time_s:.1f} s'
    unit = '' if row.unit in ('', '1') else f' {row.unit}'
    return f'{row.id} misses by {abs(row.margin):.3g}{unit}{when}'


def _room(parameter: AgsgParameter, direction: int) -> float:
    """Return how much of its domain a value can still move in a direction, in [0, 1]."""
    here = parameter.requested if parameter.realised is None else parameter.realised
    left = parameter.high - here if direction > 0 else here - parameter.low
    return left / (parameter.high - parameter.low)
