# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The kinematic replay surrogate: margins of edits that were not simulated, with their error."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from aurora_core.judging.evaluation import Context
from aurora_core.outcomes.agsg import Agsg
from aurora_core.outcomes.condition import Condition
from aurora_core.outcomes.repair import Attempt
from aurora_core.outcomes.verdict import Verdict
from aurora_core.quantities.view import RunView
from aurora_core.repair.settings import SurrogateSettings
from aurora_core.repair.surrogate.margins import Margins
from aurora_core.repair.surrogate.moved import Candidates, Moved

FloatArray = npt.NDArray[np.float64]


@dataclass(frozen=True, slots=True, kw_only=True)
class Foreseen:
    """What is expected of candidates.

    Attributes:
        margins: By condition, (C,) normalised; conditions without a model are left out.
        errors: By condition: how far off such estimates have been (normalised).
    """

    margins: Mapping[str, FloatArray]
    errors: Mapping[str, float]

    def at(self, k: int) -> dict[str, float]:
        """Return the expected margins of one candidate."""
        return {name: round(float(values[k]), 6) for name, values in self.margins.items()}


class Replay:
    """One recorded run, to be asked what edits would change.

    Args:
        view: The recorded run.
        agsg: The graph that it was executed from.
        verdict: Of its trace.
        past: Attempts of this run: what was expected of them and what came.
        settings: Step of the samples, and errors that were measured before.
    """

    def __init__(
        self,
        view: RunView,
        agsg: Agsg,
        verdict: Verdict,
        past: Sequence[Attempt],
        settings: SurrogateSettings,
    ) -> None:
        self._view = view
        self._agsg = agsg
        self._results = {row.id: row for row in verdict.results}
        context = Context(view, agsg.realised_spec, agsg.conditions)
        self._margins = Margins(context, self._results)
        self._settings = settings
        self._errors = self._measured(past)

    def foresee(self, candidates: Candidates) -> Foreseen:
        """Return the margins that candidates are expected to have.

        An edit of a kind without a model is not foreseen at all: then nothing is said.
        """
        stride = max(1, round(self._settings.step_s / self._view.dt_s))
        ticks = np.arange(0, self._view.ticks, stride, dtype=np.intp)
        moved = Moved(self._view, self._agsg, candidates, ticks)
        if set(candidates.values) - moved.modelled:
            return Foreseen(margins={}, errors={})
        found: dict[str, FloatArray] = {}
        for condition in self._agsg.conditions:
            if condition.id not in self._results:
                continue
            margins = self._margins.of(condition, moved)
            if margins is not None:
                found[condition.id] = margins
        return Foreseen(margins=found, errors={name: self._error(name) for name in found})

    def modelled(self, candidates: Candidates) -> frozenset[str]:
        """Return the paths among those of candidates that have a model."""
        ticks = np.zeros(1, dtype=np.intp)
        return Moved(self._view, self._agsg, candidates, ticks).modelled

    def _error(self, name: str) -> float:
        return self._errors.get(self._kind(name), self._settings.unknown)

    def _kind(self, name: str) -> str:
        condition = next((c for c in self._agsg.conditions if c.id == name), None)
        return '' if condition is None else kind_of(condition)

    def _measured(self, past: Sequence[Attempt]) -> dict[str, float]:
        """Return the errors by kind of condition: of the table, past runs and this one."""
        found = {**self._settings.errors, **(past[0].errors if past else {})}
        for attempt in past:
            for name, expected in attempt.predicted.items():
                came = attempt.margins.get(name)
                if came is None or not attempt.simulated:
                    continue
                kind = self._kind(name)
                before = found.get(kind, self._settings.unknown)
                found[kind] = max(before, missed(expected, came))
        return found


def kind_of(condition: Condition) -> str:
    """Return the kind of a condition that estimates are trusted by."""
    return condition.quantity.value


def missed(expected: float, came: float) -> float:
    """Return by how much an estimate was too good (normalised), 0 where it was too bad."""
    return max(0.0, expected - came)
