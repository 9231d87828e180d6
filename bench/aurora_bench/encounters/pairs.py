# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Generated requests in which two bodies are to meet, of six kinds."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from aurora_bench.matrix.cells import Cell, agent, does, stands, when
from aurora_bench.prompts.documents import Doc

KINDS = (
    'overtake',
    'approach from a side street',
    'cross in front',
    'catch up',
    'oncoming',
    'step out from behind',
)
# Two lanes of one street lie so far apart (m); who meets on another one comes to the same point.
_BESIDE_M = 9.0
_SAME_POINT_M = 4.0


@dataclass(frozen=True, kw_only=True)
class Pair:
    """Two bodies of one request.

    Attributes:
        kind: Of `KINDS`.
        cell: The request.
        one, other: Ids of the two.
        within_m: They are at one point when they are nearer than this.
    """

    kind: str
    cell: Cell
    one: str
    other: str
    within_m: float


def pairs(count: int, seed: int) -> Iterator[Pair]:
    """Yield pairs, the kinds in turn.

    Args:
        count: How many.
        seed: Of their numbers.
    """
    generator = np.random.Generator(np.random.PCG64(seed))
    for number in range(count):
        kind = KINDS[number % len(KINDS)]
        slow = float(generator.integers(5, 8))
        fast = slow + float(generator.integers(3, 6))
        away = float(generator.integers(4, 9)) * 5.0
        near = float(generator.integers(3, 6)) * 5.0
        parts, other = _request(kind, slow, fast, away, near)
        row = f'{kind} {number + 1}'
        yield Pair(
            kind=kind,
            cell=Cell(table='Encounter', row=row, column=f'{slow:g} {fast:g} {away:g} {near:g}',
                      parts=parts),
            one='ego',
            other=other,
            within_m=_BESIDE_M if kind in ('oncoming', 'overtake', 'catch up') else _SAME_POINT_M,
        )  # fmt: skip


def _request(
    kind: str, slow: float, fast: float, away: float, near: float
) -> tuple[list[Doc], str]:
    """Return the requirements of a pair and the id of whom the ego meets."""
    ego = [agent('ego', 'car', 'ego'), does('ego', 'drive', speed_mps=slow)]
    van = agent('van1', 'van')
    meets: Doc = {'on': 'distance_below', 'a': 'van1', 'b': 'ego', 'value_m': near}
    if kind == 'overtake':
        behind = stands('van1', 'behind', 'ego', distance_m=away)
        return [*ego, van, does('van1', 'overtake', 'ego'), behind], 'van1'
    if kind == 'approach from a side street':
        side = 'left' if int(away) % 10 else 'right'
        goals = [does('ego', 'approach', 'intersection'), does('van1', 'approach', 'intersection')]
        at = stands('van1', side, 'ego')
        return [ego[0], van, at, *goals, when(meets)], 'van1'
    if kind == 'catch up':
        behind = stands('van1', 'behind', 'ego', distance_m=away + near)
        return [*ego, van, does('van1', 'drive', speed_mps=fast), behind, when(meets)], 'van1'
    if kind == 'oncoming':
        ahead = stands('van1', 'oncoming', 'ego', distance_m=away + 40.0)
        return [*ego, van, does('van1', 'drive', speed_mps=slow), ahead, when(meets)], 'van1'
    sees: Doc = {'on': 'distance_below', 'a': 'ego', 'b': 'ped1', 'value_m': near + 10.0}
    crosses = when(sees, {'do': 'cross', 'agent': 'ped1'})
    person = agent('ped1', 'pedestrian')
    if kind == 'cross in front':
        return [*ego, person, crosses], 'ped1'
    hidden = [stands('van1', 'parked_at', 'roadside'), stands('ped1', 'behind', 'van1')]
    return [*ego, van, person, *hidden, crosses], 'ped1'
