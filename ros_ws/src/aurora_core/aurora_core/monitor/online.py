# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The margins of a run that goes on: what each can still become, and what is decided already.

Ticks come in, for each condition an interval comes out in which its final margin lies, whatever
follows. Signals, windows and thresholds are those of `verify`; once the run is over the interval
is the margin that `verify` gives, to the last bit.

Source: Deshmukh et al. 2017 (robust satisfaction intervals).
"""

from __future__ import annotations

from dataclasses import dataclass
from math import inf

import numpy as np

from aurora_core.judging.evaluation import Context, Later, Measured, Missing
from aurora_core.judging.quantity import measure
from aurora_core.knowledge.world import WorldModel
from aurora_core.monitor.verify import judged_formula, sampled
from aurora_core.outcomes.condition import Condition, Window
from aurora_core.quantities.growing import GrowingView
from aurora_core.quantities.ticks import whole_ticks
from aurora_core.quantities.view import RunView
from aurora_core.spec.scenario import ScenarioSpec
from aurora_core.stl.formula import Comparison, Predicate, predicates
from aurora_core.stl.online import OnlineRobustness, OnlineVerdict, verdict
from aurora_core.stl.robustness import robustness
from aurora_core.stl.syntax import parse_formula
from aurora_core.trace.trace import Trace

Bounds = tuple[float, float]
_OPEN: Bounds = (-inf, inf)


@dataclass(frozen=True, slots=True, kw_only=True)
class Outlook:
    """What is known of a condition while its run goes on.

    Attributes:
        condition_id: Which condition.
        low: Least final margin that is still possible, in the condition's unit; may be -inf.
        high: Greatest one; may be inf.
        now: Margin if the run were over with its last tick; None if it would have none.
        verdict: `true` and `false` are final, `currently_...` follows from `now`.
    """

    condition_id: str
    low: float
    high: float
    now: float | None
    verdict: OnlineVerdict


class OnlineMonitor:
    """Follows one run.

    Args:
        world: Its world.
        spec: Its specification.
        conditions: What has to hold.
        start: The run from its first tick on, at least one.
    """

    def __init__(
        self,
        world: WorldModel,
        spec: ScenarioSpec,
        conditions: tuple[Condition, ...],
        start: Trace,
    ) -> None:
        self._spec = spec
        self._conditions = conditions
        self._view = GrowingView(start, world)
        self._followed = {condition.id: _Followed(condition) for condition in conditions}

    @property
    def ticks(self) -> int:
        """Number of ticks so far."""
        return self._view.ticks

    def extend(self, more: Trace) -> None:
        """Add the ticks that follow, with the claims that came with them.

        Raises:
            VerificationError: They are of another roster, or states are missing in them.
        """
        self._view.extend(more)

    def outlooks(self) -> tuple[Outlook, ...]:
        """Return what is known now, one for each condition."""
        goes_on = Context(self._view, self._spec, self._conditions)
        ended = Context(self._view, self._spec, self._conditions, ended=True)
        return tuple(followed.look(goes_on, ended) for followed in self._followed.values())


class _Followed:
    """One condition of a run that goes on."""

    def __init__(self, condition: Condition) -> None:
        self._condition = condition
        self._formula = parse_formula(condition.formula)
        self._predicate = next(predicates(self._formula))
        self._decided: Outlook | None = None
        self._known: Bounds = _OPEN
        self._samples: OnlineRobustness | None = None

    def look(self, goes_on: Context, ended: Context) -> Outlook:
        """Return what is known now.

        Args:
            goes_on: The run so far.
            ended: The same, as if it were over.
        """
        if self._decided is not None:
            return self._decided
        measured = measure(goes_on, self._condition)
        complete = goes_on.complete(self._condition)
        if isinstance(measured, Measured) and (complete or not measured.provisional):
            margin = self._margin(goes_on, measured)
            if margin is not None:
                self._decided = self._outlook((margin, margin), margin)
                return self._decided
        if not isinstance(measured, Measured):
            measured = measure(ended, self._condition)
        if isinstance(measured, Missing):
            return self._outlook(_OPEN, None)
        now = self._margin(ended, measured)
        return self._outlook(self._bounds(goes_on.view, measured), now)

    def _margin(self, context: Context, measured: Measured) -> float | None:
        formula = judged_formula(context, self._condition, measured)
        return robustness(formula, sampled(context, self._condition, measured)).at(0)

    def _outlook(self, bounds: Bounds, now: float | None) -> Outlook:
        # What was excluded once stays so, also when nothing is left to measure.
        low, high = max(bounds[0], self._known[0]), min(bounds[1], self._known[1])
        self._known = (low, high)
        return Outlook(
            condition_id=self._condition.id,
            low=low,
            high=high,
            now=now,
            verdict=verdict(low, high, now, strict=self._condition.strict),
        )

    def _bounds(self, view: RunView, measured: Measured) -> Bounds:
        match measured.later:
            case Later.SAMPLES:
                return self._of_samples(view, measured)
            case Later.COUNTS:
                return self._of_share(view, measured)
            case Later.RISES:
                return _of_value(self._predicate, float(measured.values[0]), inf)
            case Later.FALLS:
                return _of_value(self._predicate, -inf, float(measured.values[0]))
            case Later.ANY:
                return _OPEN

    def _of_share(self, view: RunView, measured: Measured) -> Bounds:
        assert measured.held is not None  # it is a share
        good, count = int(np.count_nonzero(measured.held)), len(measured.held)
        horizon = whole_ticks(self._condition.arguments.horizon_s, view.dt_s) + 1
        rest = max(0, horizon - view.ticks)
        return _of_value(self._predicate, good / (count + rest), (good + rest) / (count + rest))

    def _of_samples(self, view: RunView, measured: Measured) -> Bounds:
        known = 0 if self._samples is None else self._samples.samples
        moments = self._condition.arguments.window is Window.MOMENT
        if self._samples is None or moments or known > len(measured.values):
            # Few, and those of a message that is on its way still change.
            self._samples = OnlineRobustness(self._formula, dt_s=view.dt_s)
            known = 0
        self._samples.push({self._condition.signal: measured.values[known:]})
        return self._samples.bounds()


def _of_value(predicate: Predicate, least: float, most: float) -> Bounds:
    """Return the robustness of a predicate over a value in [least, most]."""
    match predicate.op:
        case Comparison.GE | Comparison.GT:
            return least - predicate.threshold, most - predicate.threshold
        case Comparison.LE | Comparison.LT:
            return predicate.threshold - most, predicate.threshold - least
        case Comparison.WITHIN:
            off = max(least - predicate.threshold, predicate.threshold - most, 0.0)
            farthest = max(predicate.threshold - least, most - predicate.threshold)
            return predicate.tolerance - farthest, predicate.tolerance - off
