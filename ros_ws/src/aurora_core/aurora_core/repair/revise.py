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

_HIGHER, _NEARER, _CLOSER = ('altitude_m', 1), ('standoff_m', -1), ('distance_m', -1)
_SMALLER = (('radius_m', -1), ('0', -1), ('1', -1))
# What helps where a site lacks something: last name of the path, and in which direction.
LACKED: Mapping[str, tuple[tuple[str, int], ...]] = MappingProxyType(
    {
        'clearance': (_HIGHER, *_SMALLER, _NEARER),
        'pattern': (*_SMALLER, _HIGHER),
        'sight': (_NEARER, _HIGHER),
        'separation': (('standoff_m', 1), _HIGHER),
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

    Args:
        agsg: Of the request.
        failure: What its sites lacked.
        settings: How far a value goes, one after another.
    """
    open_rows = [row for row in agsg.parameters if is_movable(row)]
    counts = failure.rejected_by or {failure.reason: 1}
    for reason in sorted(counts, key=lambda name: (-counts[name], name)):
        rules = LACKED.get(reason, ())
        named = [
            (row, direction)
            for name, direction in rules
            for row in open_rows
            if row.path.rpartition('/')[2] == name
        ][:MOST_FIELDS]
        if not named:
            continue
        implicated = tuple(
            Implicated(
                field=row.path,
                score=float(counts[reason]),
                direction=direction,
                conditions=(),
                reason=f'no place: {failure.told}',
            )
            for row, direction in named
        )
        first = [pair for pair in named if pair[0].path.endswith(rules[0][0])]
        for chosen in (first, named) if first and len(first) < len(named) else (named,):
            for share in settings.steps:
                values = {row.path: moved(row, row.requested, d * share) for row, d in chosen}
                edits = value_edits(agsg, values)
                if edits:
                    yield Proposal(
                        outcome=ProposalOutcome.EDITED,
                        step=Step.SYMBOLIC,
                        plan=RepairPlan(values=edits),
                        implicated=implicated,
                        reason=f'no place ({failure.told}); {_told(edits)}',
                    )


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
