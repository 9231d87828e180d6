# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Two vehicles that are to stay farther apart than a distance all along the run."""

from __future__ import annotations

from collections.abc import Collection, Iterator
from dataclasses import dataclass

from aurora_core.grounding.ties import Tie
from aurora_core.spec.quantity import QuantityName
from aurora_core.spec.scenario import ScenarioSpec

_BETWEEN = (QuantityName.DISTANCE, QuantityName.HORIZONTAL_DISTANCE, QuantityName.SEPARATION)

# Along the road they are so much farther apart, for bends and bodies: metres, and a share.
_ROOM_M, _ROOM_SHARE = 20.0, 0.15


@dataclass(frozen=True, slots=True, kw_only=True)
class KeptApart:
    """Two vehicles, and how far apart they stay.

    Attributes:
        behind: Id.
        ahead: Id.
        least_m: Distance that is asked.
    """

    behind: str
    ahead: str
    least_m: float

    @property
    def along_m(self) -> float:
        """How far ahead the one is along the road."""
        return self.least_m * (1.0 + _ROOM_SHARE) + _ROOM_M


def kept_apart(spec: ScenarioSpec, vehicles: Collection[str]) -> Iterator[KeptApart]:
    """Yield the pairs of vehicles of which a condition asks that; the first named one is behind.

    Args:
        spec: The request.
        vehicles: Ids of those on the road.
    """
    for asked in spec.conditions:
        if asked.quantity not in _BETWEEN or asked.op not in ('>=', '>') or asked.by_s:
            continue
        ids = [a.id for a in spec.agents for name in asked.of if name in (a.id, a.group)]
        ids.sort(key=lambda i: asked.of.index(i) if i in asked.of else 0)
        if len(ids) == 2 and set(ids) <= set(vehicles):
            yield KeptApart(behind=ids[0], ahead=ids[1], least_m=asked.value.value)


def ties_apart(spec: ScenarioSpec, vehicles: Collection[str]) -> list[Tie]:
    """Return the ties that put such vehicles far enough apart, where nothing else is said."""
    return [
        Tie(pair.behind, pair.ahead, -pair.along_m, 0, guess=True)
        for pair in kept_apart(spec, vehicles)
    ]
