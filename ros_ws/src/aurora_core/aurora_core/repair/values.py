# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Edits of values: one parameter by steps and secants, several ones by equation 5.

Margins between the realisations that were tried are taken to be linear in what was moved: a model
that needs no more than the margins, and that every further realisation corrects.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from itertools import product

import numpy as np
import numpy.typing as npt

from aurora_core.outcomes.agsg import Agsg, AgsgParameter
from aurora_core.outcomes.repair import (
    Anchor,
    Attempt,
    Implicated,
    Proposal,
    ProposalOutcome,
    RepairPlan,
    Step,
    ValueEdit,
)
from aurora_core.repair.helps import ANCHOR
from aurora_core.repair.objective import objective
from aurora_core.repair.realised_values import here_of
from aurora_core.repair.settings import RepairSettings

FloatArray = npt.NDArray[np.float64]

# A value is not moved by less than this share of its domain.
_LEAST_SHARE = 1e-3


def one_parameter(
    agsg: Agsg,
    item: Implicated,
    implicated: tuple[Implicated, ...],
    past: Sequence[Attempt],
    settings: RepairSettings,
) -> Iterator[Proposal]:
    """Yield edits of one parameter: where the secant of its margin leads, else fixed steps.

    Args:
        agsg: The best realisation so far.
        item: The parameter and its direction.
        implicated: The whole localization, for the proposal.
        past: Everything that was tried.
        settings: How it is searched.
    """
    parameter = next(row for row in agsg.parameters if row.path == item.field)
    here = here_of(parameter, agsg)
    for value in _tries(parameter, here, item, agsg, past, settings):
        plan = plan_with(agsg, {parameter.path: value})
        yield Proposal(
            outcome=ProposalOutcome.EDITED,
            step=Step.ONE,
            plan=plan,
            implicated=implicated,
            reason=f'{item.reason}; {parameter.path} from {here:.4g} to {value:.4g}',
        )


def searched(
    agsg: Agsg,
    implicated: tuple[Implicated, ...],
    past: Sequence[Attempt],
    settings: RepairSettings,
) -> Iterator[Proposal]:
    """Yield edits of several parameters at once, the least value of equation 5 first.

    Args:
        agsg: The best realisation so far.
        implicated: The localization: at most `most_parameters` of it are moved.
        past: Everything that was tried: single edits say how margins answer.
        settings: How it is searched.
    """
    rows = {row.path: row for row in agsg.parameters}
    axes_of: dict[str, list[float]] = {}
    for item in implicated:
        if item.field == ANCHOR or item.field not in rows:
            continue
        if item.field not in axes_of and len(axes_of) == settings.most_parameters:
            continue
        row = rows[item.field]
        here = here_of(row, agsg)
        steps = axes_of.setdefault(item.field, [here])
        steps += [moved(row, here, item.direction * share) for share in settings.steps]
    if len(axes_of) < 2:
        return
    base = past[_index_of_best(past)].margins
    axes = [rows[path] for path in axes_of]
    slopes = _slopes(axes, agsg, past)
    width = np.array([row.high - row.low for row in axes])
    at = np.array([here_of(row, agsg) for row in axes])
    found = []
    for values in product(*(dict.fromkeys(steps) for steps in axes_of.values())):
        shifts = np.array(values) - at
        changed = {
            path: value for path, value, d in zip(axes_of, values, shifts, strict=True) if d
        }
        if len(changed) < 2:
            continue
        predicted = _predicted(base, slopes, shifts / width)
        edits = [(row, value - row.requested) for row, value in zip(axes, values, strict=True)]
        found.append((objective(predicted.values(), edits, settings), changed, predicted))
    found.sort(key=lambda row: (row[0], sorted(row[1].items())))
    for value, changed, predicted in found:
        told = ', '.join(f'{path} to {number:.4g}' for path, number in changed.items())
        yield Proposal(
            outcome=ProposalOutcome.EDITED,
            step=Step.SEARCH,
            plan=plan_with(agsg, changed),
            implicated=implicated,
            predicted=predicted,
            reason=f'single edits were of no avail; {told} (equation 5: {value:.3g})',
        )


def _tries(
    row: AgsgParameter,
    here: float,
    item: Implicated,
    agsg: Agsg,
    past: Sequence[Attempt],
    settings: RepairSettings,
) -> Iterator[float]:
    """Yield values to try, none twice."""
    known = _points(row, agsg, past, item.conditions)
    tried = {value for value, _ in known}
    wanted = [_secant(row, known, settings.epsilon)] if len(known) > 1 else []
    if item.aim is not None:
        wanted.insert(0, _rounded(row, item.aim))
    wanted += [moved(row, here, item.direction * share) for share in settings.steps]
    least = _LEAST_SHARE * (row.high - row.low)
    for value in wanted:
        if value is not None and all(abs(value - other) > least for other in tried):
            tried.add(value)
            yield value


def moved(row: AgsgParameter, here: float, share: float) -> float:
    """Return a value moved by a share of the room that is left in its direction.

    Args:
        row: The parameter.
        here: Where it is, in its unit.
        share: In [-1, 1]; below 0: downwards.
    """
    room = row.high - here if share > 0.0 else here - row.low
    return _rounded(row, here + share * room)


def _rounded(row: AgsgParameter, value: float) -> float:
    """Return a value inside the domain, as people would write it."""
    return min(row.high, max(row.low, round(value, 2)))


def _points(
    row: AgsgParameter, agsg: Agsg, past: Sequence[Attempt], conditions: Sequence[str]
) -> list[tuple[float, float]]:
    """Return values that were tried at this place alone, with the worst margin they gave."""
    here = _anchor(agsg)
    found = []
    for attempt in past:
        if not attempt.simulated or attempt.anchor is None or attempt.anchor.lane != here.lane:
            continue
        if any(edit.path != row.path for edit in attempt.plan.values):
            continue
        value = next((e.realised for e in attempt.plan.values), row.requested)
        margins = [attempt.margins.get(name) for name in conditions]
        known = [margin for margin in margins if margin is not None]
        if known and len(known) == len(margins):
            found.append((value, min(known)))
    return found


def _secant(
    row: AgsgParameter, known: Sequence[tuple[float, float]], epsilon: float
) -> float | None:
    """Return where the line through the two best points reaches the margin that is aimed at."""
    (x1, y1), (x2, y2) = sorted(known, key=lambda point: -point[1])[:2]
    if x1 == x2 or y1 == y2:
        return None
    return _rounded(row, x1 + (epsilon - y1) * (x2 - x1) / (y2 - y1))


def _slopes(
    rows: Sequence[AgsgParameter], agsg: Agsg, past: Sequence[Attempt]
) -> dict[str, FloatArray]:
    """Return how each margin answers to each parameter, by shares of their domains.

    The least answer that fits the differences of all realisations at this place to the best one.
    """
    best = past[_index_of_best(past)]
    here = _anchor(agsg)
    others = [a for a in past if a.simulated and a is not best and a.anchor == here]
    if not others:
        return {}
    width = np.array([row.high - row.low for row in rows])
    at = np.array([here_of(row, agsg) for row in rows])
    tried = np.array([[_value(row, a) for row in rows] for a in others])
    answer = np.linalg.pinv((tried - at) / width)
    found = {}
    for name, margin in best.margins.items():
        told = [a.margins.get(name) for a in others]
        if margin is not None and None not in told:
            found[name] = answer @ (np.array(told, dtype=float) - margin)
    return found


def _value(row: AgsgParameter, attempt: Attempt) -> float:
    edits = attempt.plan.values
    return next((edit.realised for edit in edits if edit.path == row.path), row.requested)


def _predicted(
    base: Mapping[str, float | None], slopes: Mapping[str, FloatArray], shares: FloatArray
) -> dict[str, float]:
    return {
        name: margin + (float(slopes[name] @ shares) if name in slopes else 0.0)
        for name, margin in base.items()
        if margin is not None
    }


def _index_of_best(past: Sequence[Attempt]) -> int:
    ranks = [attempt.rank for attempt in past]
    return ranks.index(max(ranks))


def _anchor(agsg: Agsg) -> Anchor:
    assert agsg.grounding is not None  # it was executed
    return Anchor(lane=agsg.grounding.anchor_lane, position_m=agsg.grounding.anchor_position_m)


def moved_values(agsg: Agsg, plan: RepairPlan) -> dict[str, float]:
    """Return what a plan realises otherwise than a realisation, by path."""
    rows = {row.path: row for row in agsg.parameters}
    wanted = {edit.path: edit.realised for edit in plan.values}
    assert agsg.grounding is not None  # it was executed
    before = agsg.grounding.repair
    paths = dict.fromkeys((*wanted, *(e.path for e in (before.values if before else ()))))
    found = {path: wanted.get(path, rows[path].requested) for path in paths}
    return {path: value for path, value in found.items() if value != here_of(rows[path], agsg)}


def plan_with(agsg: Agsg, values: Mapping[str, float]) -> RepairPlan:
    """Return the plan of a realisation at its place with other values, earlier ones kept."""
    assert agsg.grounding is not None  # it was executed
    before = agsg.grounding.repair
    wanted = {} if before is None else {edit.path: edit.realised for edit in before.values}
    return RepairPlan(
        avoided=() if before is None else before.avoided,
        kept=_anchor(agsg),
        values=value_edits(agsg, {**wanted, **values}),
    )


def value_edits(agsg: Agsg, values: Mapping[str, float]) -> tuple[ValueEdit, ...]:
    """Return the edits that realise values, those left out that are as requested."""
    rows = {row.path: row for row in agsg.parameters}
    return tuple(
        ValueEdit(
            path=path,
            requested=rows[path].requested,
            realised=value,
            provenance=rows[path].provenance,
        )
        for path, value in sorted(values.items())
        if value != rows[path].requested
    )
