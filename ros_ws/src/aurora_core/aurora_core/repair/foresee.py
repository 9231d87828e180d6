# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Edits that the surrogate picks: the least value of equation 5 among very many candidates.

It only chooses what is simulated next. It is believed as far as its error goes: an edit is put
first when every violated condition is expected to hold, and one is put last when one of them is
expected to fail by more than estimates of its kind have been off.
"""

from __future__ import annotations

import random
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from aurora_core.outcomes.agsg import Agsg, AgsgParameter
from aurora_core.outcomes.repair import Implicated
from aurora_core.outcomes.verdict import Verdict
from aurora_core.repair.helps import ANCHOR
from aurora_core.repair.localize import violated
from aurora_core.repair.realised_values import here_of
from aurora_core.repair.settings import RepairSettings
from aurora_core.repair.surrogate.moved import Candidates
from aurora_core.repair.surrogate.replay import Foreseen, Replay

FloatArray = npt.NDArray[np.float64]


@dataclass(frozen=True, slots=True, kw_only=True)
class Choice:
    """An edit that the surrogate picked.

    Attributes:
        values: By path, in the unit of the parameter.
        predicted: Normalised margins that are expected.
        value: Of equation 5.
    """

    values: Mapping[str, float]
    predicted: Mapping[str, float]
    value: float


class Foresight:
    """The surrogate over the admissible neighbourhood of one realisation.

    Args:
        replay: The recorded run.
        agsg: Its graph.
        implicated: The localization: nothing else is moved.
        verdict: Of its trace.
        settings: How it is searched.
    """

    def __init__(
        self,
        replay: Replay,
        agsg: Agsg,
        implicated: Sequence[Implicated],
        verdict: Verdict,
        settings: RepairSettings,
    ) -> None:
        self._replay = replay
        failed = violated(verdict)
        self._failed = tuple(row.id for row in failed)
        self._measured = frozenset(row.id for row in failed if row.margin is not None)
        self._settings = settings
        rows = {row.path: row for row in agsg.parameters}
        fields = dict.fromkeys(i.field for i in implicated if i.field != ANCHOR)
        moved = [rows[name] for name in fields if name in rows]
        here = {row.path: here_of(row, agsg) for row in moved}
        probe = Candidates(values={r.path: np.zeros(1) for r in moved}, here=here)
        known = replay.modelled(probe) if moved else frozenset()
        self._rows = [r for r in moved if r.path in known][: settings.most_parameters]
        self._here = {row.path: here[row.path] for row in self._rows}

    def fails(self, values: Mapping[str, float]) -> bool:
        """Tell whether an edit is expected to leave a condition violated, beyond all doubt."""
        if not values or set(values) - set(self._here):
            return False
        arrays = {path: np.array([value]) for path, value in values.items()}
        foreseen = self._replay.foresee(Candidates(values=arrays, here=self._here))
        return any(
            float(foreseen.margins[name][0]) + foreseen.errors[name] < 0.0
            for name in self._failed
            if name in foreseen.margins
        )

    def predicted(self, values: Mapping[str, float]) -> dict[str, float]:
        """Return the margins that are expected of one edit, {} where there is no model."""
        if not values or set(values) - set(self._here):
            return {}
        arrays = {path: np.array([value]) for path, value in values.items()}
        return self._replay.foresee(Candidates(values=arrays, here=self._here)).at(0)

    def choices(self) -> Iterator[Choice]:
        """Yield edits after which everything is expected to hold, the least of equation 5 first.

        One that nearly equals an earlier one is left out.
        """
        if not self._rows:
            return
        at = np.array([self._here[row.path] for row in self._rows])
        points = self._points(at)
        values = {row.path: points[:, k] for k, row in enumerate(self._rows)}
        foreseen = self._replay.foresee(Candidates(values=values, here=self._here))
        if not self._speaks(foreseen):
            return
        cost = self._cost(foreseen, points)
        width = np.array([row.high - row.low for row in self._rows])
        given: list[FloatArray] = []
        for k in np.argsort(cost, kind='stable'):
            if not _holds(foreseen, int(k)):
                continue
            point = points[k]
            near = self._settings.surrogate.apart
            if any(float(np.abs((point - other) / width).max()) < near for other in given):
                continue
            given.append(point)
            moved = {
                row.path: float(value)
                for row, value, before in zip(self._rows, point, at, strict=True)
                if value != before
            }
            yield Choice(values=moved, predicted=foreseen.at(int(k)), value=float(cost[k]))

    def _speaks(self, foreseen: Foreseen) -> bool:
        """Tell whether there is a model of what failed: of all that has a margin, of some else.

        What has no margin follows from what did not happen; that is foreseen where it can be.
        """
        known = foreseen.margins.keys()
        return not (self._measured - known) and bool(known & set(self._failed))

    def _cost(self, foreseen: Foreseen, points: FloatArray) -> FloatArray:
        """Return equation 5 of every candidate; estimates count less what they have been off."""
        worst = np.full(len(points), np.inf)
        for name, values in foreseen.margins.items():
            if name not in self._failed and float(np.ptp(values)) == 0.0:
                continue  # no edit reaches it
            doubt = foreseen.errors[name] if name in self._failed else 0.0
            worst = np.minimum(worst, values - doubt)
        hinge = np.maximum(0.0, self._settings.epsilon - worst)
        change = np.zeros(len(points))
        for k, row in enumerate(self._rows):
            weight = self._settings.weights.of(row.provenance)
            change += weight * np.abs(points[:, k] - row.requested) / (row.high - row.low)
        return hinge + self._settings.lambda_sem * change

    def _points(self, at: FloatArray) -> FloatArray:
        """Return the candidates, (C, parameters): each parameter alone, then several at once."""
        rows = self._rows
        number = self._settings.surrogate.candidates
        share = max(8, number // (2 * len(rows)))
        found = []
        for k, row in enumerate(rows):
            axis = np.tile(at, (share, 1))
            axis[:, k] = np.round(np.linspace(row.low, row.high, share), 2)
            found.append(axis)
        rest = number - share * len(rows)
        if len(rows) > 1 and rest > 0:
            draw = random.Random('repair/surrogate')
            found.append(np.array([[_drawn(draw, row) for row in rows] for _ in range(rest)]))
        return np.concatenate(found)


def _holds(foreseen: Foreseen, k: int) -> bool:
    """Tell whether a candidate is expected to mend what failed, and to break nothing."""
    return all(float(values[k]) >= 0.0 for values in foreseen.margins.values())


def _drawn(draw: random.Random, row: AgsgParameter) -> float:
    return min(row.high, max(row.low, round(draw.uniform(row.low, row.high), 2)))
