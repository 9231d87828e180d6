# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""How far an autopilot's clock is ahead of ours, and how much faster it runs, from round trips.

A question is sent at `s`, answered at the autopilot's time `a`, back at `r`: its offset at the
middle is a - (s + r) / 2, wrong by at most half the round trip r - s, whatever the two ways took.
A line through the offsets of the last minute gives offset and drift. Round trips that took little
longer than the shortest one count most: one that took `e` longer is wrong by at most e / 2 more,
which is taken for its standard deviation. Where both ways are late independently of each other it
is less (e² / 12 in the square), where a busy machine reads late it is not.

No statistics show a way there that is always longer than the way back; half the shortest round
trip bounds what it does. Source: RFC 5905 (NTP), clock filter and root distance.
"""

from __future__ import annotations

from collections import deque
from dataclasses import dataclass
from math import sqrt

import numpy as np

# Round trips that the line goes through: the time over which a drift counts as constant.
_WINDOW_S = 60.0
# Least standard deviation of one offset: scheduling and the rounding of stamps.
_FLOOR_S = 1e-4
# Which of the shortest round trips tells how near the shortest one is to what is possible.
_SPREAD_RANK = 5
# The clock was set, or stood still, when so many round trips in a row cannot be otherwise.
_CONTRADICTIONS = 5
_SIGMAS = 3.0
# Known before anything is measured: crystals are better than this.
_DRIFT_SIGMA = 1e-3


@dataclass(frozen=True, slots=True, kw_only=True)
class Estimate:
    """A clock at a time of ours.

    Attributes:
        at_s: That time.
        offset_s: The clock's time less ours.
        drift: By how much more it counts per second of ours.
        offset_sigma_s: Standard deviation of the offset.
        drift_sigma: And of the drift.
        asymmetry_s: What the two ways may differ in, at most: half the shortest round trip.
        round_trips: That were used.
    """

    at_s: float
    offset_s: float
    drift: float
    offset_sigma_s: float
    drift_sigma: float
    asymmetry_s: float
    round_trips: int

    @property
    def uncertainty_s(self) -> float:
        """What the offset is wrong by at most: two standard deviations and the asymmetry."""
        return 2.0 * self.offset_sigma_s + self.asymmetry_s

    def theirs_s(self, ours_s: float) -> float:
        """Return the clock's time at a time of ours."""
        return ours_s + self.offset_s + self.drift * (ours_s - self.at_s)

    def ours_s(self, theirs_s: float) -> float:
        """Return the time of ours at which the clock has that time."""
        return self.at_s + (theirs_s - self.offset_s - self.at_s) / (1.0 + self.drift)


class ClockEstimator:
    """The clock of one autopilot.

    Attributes:
        steps: How often the clock was found set or stopped, and all before forgotten.
        round_trips: All that were taken.
        longest_s: The longest of them.
    """

    def __init__(self) -> None:
        self.steps = 0
        self.round_trips = 0
        self.longest_s = 0.0
        # Middle (ours), offset, length of each round trip.
        self._trips: deque[tuple[float, float, float]] = deque()
        self._against: list[tuple[float, float, float]] = []
        self._estimate: Estimate | None = None

    @property
    def estimate(self) -> Estimate | None:
        """The clock as it is known now, None before the first round trip."""
        if self._estimate is None and self._trips:
            self._estimate = self._fit()
        return self._estimate

    def take(self, sent_s: float, answered_s: float, received_s: float) -> None:
        """Take a round trip.

        Args:
            sent_s: When the question was sent, our time.
            answered_s: When it was answered, the autopilot's time.
            received_s: When the answer came, our time.
        """
        length_s = received_s - sent_s
        if length_s < 0.0:
            return
        middle_s = sent_s + 0.5 * length_s
        trip = (middle_s, answered_s - middle_s, length_s)
        self.round_trips += 1
        self.longest_s = max(self.longest_s, length_s)
        if self._contradicts(trip):
            self._against.append(trip)
            if len(self._against) < _CONTRADICTIONS:
                return
            self.steps += 1
            self._trips = deque(self._against)
        else:
            self._trips.append(trip)
        self._against = []
        while self._trips[0][0] < middle_s - _WINDOW_S:
            self._trips.popleft()
        self._estimate = None

    def _contradicts(self, trip: tuple[float, float, float]) -> bool:
        """Tell whether an offset is farther off than its round trip allows."""
        known = self.estimate
        if known is None or known.round_trips < _SPREAD_RANK:
            return False
        middle_s, offset_s, length_s = trip
        ahead_s = middle_s - known.at_s
        off_s = abs(offset_s - known.offset_s - known.drift * ahead_s)
        sigma_s = known.offset_sigma_s + known.drift_sigma * abs(ahead_s)
        return off_s > 0.5 * length_s + known.asymmetry_s + _SIGMAS * sigma_s + _FLOOR_S

    def _fit(self) -> Estimate:
        """Return the weighted least squares line, at the middle of the last round trip."""
        trips = np.array(self._trips)
        at_s = float(trips[-1, 0])
        lengths = np.sort(trips[:, 2])
        spread_s = lengths[min(_SPREAD_RANK, len(lengths)) - 1] - lengths[0]
        if len(lengths) < _SPREAD_RANK:
            spread_s = lengths[-1]
        excess_s = trips[:, 2] - lengths[0] + spread_s
        weight = 1.0 / (_FLOOR_S * _FLOOR_S + excess_s * excess_s / 4.0)
        ahead_s = trips[:, 0] - at_s
        # Normal equations of offset and drift; the drift starts at 0, give or take.
        a = float(weight.sum())
        b = float((weight * ahead_s).sum())
        c = float((weight * ahead_s * ahead_s).sum()) + 1.0 / (_DRIFT_SIGMA * _DRIFT_SIGMA)
        p = float((weight * trips[:, 1]).sum())
        q = float((weight * ahead_s * trips[:, 1]).sum())
        # Offsets are large and nearly equal: their mean goes first.
        mean_s = p / a
        q -= b * mean_s
        determinant = a * c - b * b
        drift = a * q / determinant
        return Estimate(
            at_s=at_s,
            offset_s=mean_s - b * drift / a,
            drift=drift,
            offset_sigma_s=sqrt(c / determinant),
            drift_sigma=sqrt(a / determinant),
            asymmetry_s=0.5 * float(lengths[0]),
            round_trips=len(self._trips),
        )
