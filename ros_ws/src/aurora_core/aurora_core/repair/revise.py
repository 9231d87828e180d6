# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Symbolic revision: several fields at once, by rules, where no single one is enough.

Two cases. Grounding finds no place: what a site lacked says which values stand in the way, and
nothing is simulated to find out. Or several edits were of no avail: the first fields of the
localization are moved together, the place among them.

Source: paper, "Bounded local repair": a guarded revision of at most six fields.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from types import MappingProxyType

from aurora_core.outcomes.agsg import Agsg, AgsgParameter
from aurora_core.outcomes.grounding import GroundingFailure
from aurora_core.outcomes.repair import (
    Implicated,
    Proposal,
    ProposalOutcome,
    RepairPlan,
    Step,
    ValueEdit,
)
from aurora_core.repair.helps import ANCHOR
from aurora_core.repair.lock import is_movable
from aurora_core.repair.settings import RepairSettings
from aurora_core.repair.values import moved, value_edits

# The paper bounds a symbolic repair so.
MOST_FIELDS = 6

Rule = tuple[tuple[str, int], ...]

# Last name of a path, and in which direction it goes.
_HIGHER: Rule = (('altitude_m', 1),)
_LOWER: Rule = (('altitude_m', -1),)
_NEARER: Rule = (('standoff_m', -1),)
_CLOSER: Rule = (('distance_m', -1),)
_SMALLER: Rule = (('radius_m', -1), ('0', -1), ('1', -1))
_ROUND_IT: Rule = (('radius_m', 1),)
# What helps where a site lacks something: what most often does, and else.
LACKED: Mapping[str, tuple[Rule, ...]] = MappingProxyType(
    {
        'clearance': (_HIGHER, _ROUND_IT, (*_HIGHER, *_SMALLER, *_NEARER)),
        'pattern': (_SMALLER, _HIGHER, (*_SMALLER, *_HIGHER)),
        'sight': (_NEARER, _HIGHER, _LOWER, (*_NEARER, *_HIGHER)),
        'separation': ((('standoff_m', 1),), _HIGHER),
        'way_between_missions': (_HIGHER,),
        'road': (_CLOSER,),
        'oncoming': (_CLOSER,),
        'sidewalk': (_CLOSER,),
        'crosswalk': (_CLOSER,),
        'far_kerb': (_CLOSER,),
    }
)


def revised_to_fit(
    agsg: Agsg, failure: GroundingFailure, settings: RepairSettings
) -> Iterator[Proposal]:
    """Yield revisions with which a request may find a place, small ones first.

    Nothing was recorded that would say how far: each rule is tried with a small step, then with
    larger ones.

    Args:
        agsg: Of the request.
        failure: What its sites lacked.
        settings: How far a value goes, one after another.
    """
    counts = failure.rejected_by or {failure.reason: 1}
    lacked = sorted(counts, key=lambda name: (-counts[name], name))
    rules = [rule for reason in lacked for rule in _by_room(agsg, LACKED.get(reason, ()))]
    implicated = tuple(_at_fault(agsg, rules, failure))
    given: list[RepairPlan] = []
    for share in settings.steps:
        for rule in rules:
            rows = _open_rows(agsg, rule)[:MOST_FIELDS]
            values = {row.path: moved(row, row.requested, way * share) for row, way in rows}
            plan = RepairPlan(values=value_edits(agsg, values))
            if plan.values and plan not in given:
                given.append(plan)
                yield Proposal(
                    outcome=ProposalOutcome.EDITED,
                    step=Step.SYMBOLIC,
                    plan=plan,
                    implicated=implicated,
                    reason=f'no place ({failure.told}); {_told(plan.values)}',
                )


def _by_room(agsg: Agsg, rules: Sequence[Rule]) -> list[Rule]:
    """Return rules with the first of higher and lower that has more room: a UAV that sees nothing
    from high up is more likely too far away than too low to see over what stands between.
    """
    found = list(rules)
    if _HIGHER in found and _LOWER in found:
        rows = _open_rows(agsg, _HIGHER)
        room = sum((row.high + row.low) / 2.0 - row.requested for row, _ in rows)
        if room < 0.0:
            found.remove(_LOWER)
            found.insert(found.index(_HIGHER), _LOWER)
    return found


def _open_rows(agsg: Agsg, rule: Rule) -> list[tuple[AgsgParameter, int]]:
    return [
        (row, way)
        for name, way in rule
        for row in agsg.parameters
        if is_movable(row) and row.path.rpartition('/')[2] == name
    ]


def _at_fault(
    agsg: Agsg, rules: Sequence[Rule], failure: GroundingFailure
) -> Iterator[Implicated]:
    """Yield what the rules move, each once, in their order."""
    pairs = dict.fromkeys(pair for rule in rules for pair in _names(agsg, rule))
    for k, (path, way) in enumerate(pairs):
        yield Implicated(
            field=path,
            score=1.0 / (1.0 + k),
            direction=way,
            conditions=(),
            reason=f'no place: {failure.told}',
        )


def _names(agsg: Agsg, rule: Rule) -> list[tuple[str, int]]:
    return [(row.path, way) for row, way in _open_rows(agsg, rule)]


def revised(
    agsg: Agsg,
    implicated: Sequence[Implicated],
    here: Mapping[str, float],
    elsewhere: RepairPlan,
    settings: RepairSettings,
) -> Iterator[Proposal]:
    """Yield revisions of the first fields of a localization, all at once and at another place.

    Args:
        agsg: The best realisation so far.
        implicated: The localization.
        here: Its values, by path.
        elsewhere: Leads to another place, values of its own included.
        settings: How far a value goes, one after another.
    """
    rows = {row.path: row for row in agsg.parameters}
    wanted: dict[str, Implicated] = {}
    for item in implicated:
        # What speaks most for a field says in which direction it goes.
        if item.field != ANCHOR and item.field in rows and item.field not in wanted:
            wanted[item.field] = item
    chosen = list(wanted.values())[: MOST_FIELDS - 1]
    if not chosen or all(item.field != ANCHOR for item in implicated):
        return
    before = {edit.path: edit.realised for edit in elsewhere.values}
    for share in settings.steps:
        values = {item.field: _goal(rows[item.field], item, here, share) for item in chosen}
        edits = value_edits(agsg, {**before, **values})
        yield Proposal(
            outcome=ProposalOutcome.EDITED,
            step=Step.SYMBOLIC,
            plan=elsewhere.model_copy(update={'values': edits}),
            implicated=tuple(implicated),
            reason=f'nothing else was of avail; at another place, {_told(edits)}',
        )


def _goal(row: AgsgParameter, item: Implicated, here: Mapping[str, float], share: float) -> float:
    if item.aim is not None:
        return moved(row, item.aim, 0.0)
    return moved(row, here.get(row.path, row.requested), item.direction * share)


def _told(edits: Sequence[ValueEdit]) -> str:
    return ', '.join(f'{edit.path} to {edit.realised:.4g}' for edit in edits) or 'all as it was'
