# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What repair may move, and the check that nothing else has changed.

Thresholds, tolerances, holds, phase definitions, horizons, links, counts and the seed are locked,
whoever chose them; so is everything that the prompt states. What is left are the places of the
grounding, and the numbers that say how something is flown or placed where the prompt does not.
"""

from __future__ import annotations

from collections.abc import Iterator

from aurora_core.outcomes.agsg import Agsg, AgsgParameter
from aurora_core.outcomes.condition import Condition
from aurora_core.outcomes.grounding import GroundingOutcome
from aurora_core.outcomes.repair import RepairPlan
from aurora_core.spec.parameter import Provenance

# Numbers that may be realised otherwise: by list of the specification, the last name of the path.
_MOVABLE = {
    'missions': frozenset({'altitude_m', 'standoff_m', 'radius_m', 'speed_mps', '0', '1'}),
    'agents': frozenset({'distance_m'}),
}


def is_movable(parameter: AgsgParameter) -> bool:
    """Tell whether repair may realise a parameter otherwise."""
    if parameter.provenance is Provenance.EXPLICIT or not parameter.low < parameter.high:
        return False
    group, _, rest = parameter.path.partition('/')
    return rest.rpartition('/')[2] in _MOVABLE.get(group, frozenset())


def locked_edits(agsg: Agsg, plan: RepairPlan) -> Iterator[str]:
    """Yield why a plan may not be carried out.

    Args:
        agsg: Of the request.
        plan: What is to be realised otherwise.
    """
    known = {row.path: row for row in agsg.parameters}
    for edit in plan.values:
        row = known.get(edit.path)
        if row is None:
            yield f'{edit.path} is not in the request'
        elif not is_movable(row):
            yield f'{edit.path} is locked'
        elif not row.low <= edit.realised <= row.high:
            yield f'{edit.path} = {edit.realised:g} is outside its domain'


def changes_of_the_request(
    before: Agsg,
    after: Agsg,
    left_out: GroundingOutcome,
    now_left_out: GroundingOutcome,
) -> Iterator[str]:
    """Yield what an edit changed that it may not change; nothing when the request is preserved.

    Args:
        before: Grounded, as it was executed first.
        after: Grounded, as it is to be executed.
        left_out: What of `before` nobody carries out or judges.
        now_left_out: The same of `after`.
    """
    if after.spec != before.spec:
        yield 'the request is another one'
    ours, theirs = before.grounding, after.grounding
    if ours is None or theirs is None:
        yield 'one of both is not grounded'
        return
    for name in ('seed', 'map_digest', 'weather', 'time_of_day', 'basis', 'executor_version'):
        if getattr(ours, name) != getattr(theirs, name):
            yield f'{name} is another one'
    if before.schedule is None or after.schedule is None:
        yield 'one of both has no schedule'
        return
    horizons = (before.schedule.horizon_s, after.schedule.horizon_s)
    if before.spec.world.duration_s is not None and horizons[0] != horizons[1]:
        yield 'the horizon is another one'
    now = {condition.id: condition for condition in after.conditions}
    for condition in before.conditions:
        other = now.get(condition.id)
        if other is None:
            yield f'nothing judges {condition.id} any more'
        else:
            yield from _weakened(condition, other, horizons)
    for text in sorted({*now_left_out.unsupported} - {*left_out.unsupported}):
        yield f'nobody carries out or judges {text}'
    for path in sorted(_paths(now_left_out) - _paths(left_out)):
        yield f'no condition depends on {path} any more'


def _paths(outcome: GroundingOutcome) -> set[str]:
    return {row.path for row in outcome.unjudged}


def _weakened(before: Condition, after: Condition, horizons: tuple[float, float]) -> Iterator[str]:
    """Yield what of a condition is another one.

    What the prompt states is the same to the letter. A threshold that follows from a place (time
    to come there, a realised default) may follow from the new one; what is asked may not.
    """
    for name in ('quantity', 'op', 'of', 'hold_s', 'fraction', 'unit', 'implied', 'provenance'):
        if getattr(before, name) != getattr(after, name):
            yield f'{before.id} has another {name}'
    if before.provenance is not Provenance.EXPLICIT:
        return
    for name in ('threshold', 'tolerance'):
        if getattr(before, name) != getattr(after, name):
            yield f'{before.id} has another {name}'
    if before.by_s != after.by_s and (before.by_s, after.by_s) != horizons:
        yield f'{before.id} has another by_s'
