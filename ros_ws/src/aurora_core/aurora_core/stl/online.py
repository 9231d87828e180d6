# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The robustness of a formula while the trace grows.

Memory and work per sample go with the horizon of the formula, not with the length of the trace,
where future windows without end stand only outermost: alone, under not, and, or and implies. A
future window without end inside another temporal operator keeps the samples from its operand.

Source: Deshmukh et al. 2017, robust online monitoring of signal temporal logic.
"""

from __future__ import annotations

from collections.abc import Mapping
from enum import StrEnum

import numpy as np

from aurora_core.errors import VerificationError
from aurora_core.stl.formula import Formula, predicates
from aurora_core.stl.online_build import first_value
from aurora_core.stl.robustness import SampledSignals
from aurora_core.stl.windows import FloatArray

OPEN = (float('-inf'), float('inf'))


class OnlineVerdict(StrEnum):
    """What the samples so far say; `TRUE` and `FALSE` stay whatever follows."""

    TRUE = 'true'
    FALSE = 'false'
    CURRENTLY_TRUE = 'currently_true'
    CURRENTLY_FALSE = 'currently_false'
    UNKNOWN = 'unknown'


def verdict(low: float, high: float, now: float | None, *, strict: bool) -> OnlineVerdict:
    """Return the verdict of a formula from what `OnlineRobustness` says.

    Args:
        low: Least robustness that is still possible.
        high: Greatest robustness that is still possible.
        now: The robustness if the trace ended here, None if it had none.
        strict: Zero does not hold.
    """

    def holds(value: float) -> bool:
        return value > 0.0 if strict else value >= 0.0

    if holds(low):
        return OnlineVerdict.TRUE
    if not holds(high):
        return OnlineVerdict.FALSE
    if now is None:
        return OnlineVerdict.UNKNOWN
    return OnlineVerdict.CURRENTLY_TRUE if holds(now) else OnlineVerdict.CURRENTLY_FALSE


class OnlineRobustness:
    """The robustness of a formula at sample 0 of a trace that comes in pieces.

    Args:
        formula: The formula.
        dt_s: Time between samples.
        clip: Bounded windows take the samples that there are at the ends of the trace.

    Raises:
        VerificationError: dt_s is not positive, or an interval holds no sample.
    """

    def __init__(self, formula: Formula, *, dt_s: float, clip: bool = False) -> None:
        if not dt_s > 0.0:
            raise VerificationError(f'STL needs a time step above 0 s, found {dt_s}')
        self._dt_s = dt_s
        self._names = {predicate.signal for predicate in predicates(formula)}
        self._first = first_value(formula, dt_s=dt_s, clip=clip)
        self._samples = 0
        self._closed = False

    @property
    def samples(self) -> int:
        """Number of samples so far."""
        return self._samples

    def push(self, samples: Mapping[str, FloatArray]) -> None:
        """Take the next samples; what is refused leaves everything as it was.

        Args:
            samples: Every signal of the formula by name, (k,) finite samples, k >= 0.

        Raises:
            VerificationError: A name is unknown or missing, lengths differ, a sample is not
                finite, or the trace is closed.
        """
        if self._closed:
            raise VerificationError('STL samples after the end of the trace')
        if samples.keys() != self._names:
            raise VerificationError(
                f'STL samples of {", ".join(sorted(self._names))} expected, found '
                f'{", ".join(sorted(samples)) or "none"}'
            )
        signals = SampledSignals(
            values={name: np.asarray(values, np.float64) for name, values in samples.items()},
            dt_s=self._dt_s,
        )
        # A formula that looks back beyond sample 0 never gets a value there: nothing to follow.
        if self._first.exists:
            self._first.push(signals)
        self._samples += signals.samples

    def bounds(self) -> tuple[float, float]:
        """Return the least and the greatest robustness that are still possible.

        They hold for every finite continuation after which there is a value, also for none, and
        never widen. Infinite where open; both the value once the trace is closed.
        """
        if not self._first.exists:
            return OPEN
        value = self._first.ended() if self._closed else None
        low, high = self._first.bounds() if value is None else (value, value)
        return low + 0.0, high + 0.0  # -0.0 becomes 0.0

    def now(self) -> float | None:
        """Return the robustness if the trace ended here, None if it had none.

        The same bits as `robustness` of the samples so far at sample 0.
        """
        value = self._first.ended() if self._first.exists else None
        return None if value is None else value + 0.0

    def close(self) -> float | None:
        """End the trace and return its robustness, None if it has none."""
        self._closed = True
        return self.now()
