# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Whether AURORA and RTAMT agree, sample by sample; what cannot be compared is counted by reason.

Three comparisons of each pair:

* *offline*: RTAMT's offline value with ours where bounded windows are cut at the ends (`clip`).
* *offline, full windows*: the same with ours as a verdict takes it: no value where a bounded
  window reaches beyond the trace.
* *online*: RTAMT's pastified monitor, moved back by its delay, with ours (`clip`).
"""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass, field
from enum import StrEnum

import numpy as np

from aurora_bench.stl.pairs import Pair
from aurora_bench.stl.rtamt_oracle import (
    delay,
    delayed_wrongly,
    endless_over_bounded,
    offline_values,
    online_monitor,
    online_values,
    past_over_future,
    shares_state,
    undisturbed,
)
from aurora_core.stl.robustness import SampledSignals, ValidSeries, robustness

TOLERANCE = 1e-9


class Mode(StrEnum):
    """One of the comparisons."""

    OFFLINE = 'offline'
    FULL = 'offline, full windows'
    ONLINE = 'online'


class Reason(StrEnum):
    """Why samples or pairs are not compared."""

    EMPTY = 'a window lies wholly outside the trace'
    CUT = 'a bounded window reaches beyond the trace'
    ENDLESS = 'a window without end contains a bounded one'
    SINGLE = 'the trace has one sample'
    UNBOUNDED = 'a future window without end'
    PAST = 'a past operator contains a future one'
    UNEVEN = 'branches reach unequally far ahead'
    TWICE = 'two past operators have one text'
    LATE = 'the delay is longer than the trace'


# What each tool does there.
EXPLANATIONS = {
    Reason.EMPTY: 'RTAMT takes minus infinity (eventually, until, once, since) or infinity '
    '(always, historically) and passes it on; AURORA has no value there, and outer windows take '
    'the samples that have one.',
    Reason.CUT: 'RTAMT cuts the window; AURORA has no value there unless the caller declares '
    '`clip`, and with `clip` both agree (first comparison).',
    Reason.ENDLESS: 'RTAMT lets the outer window take inner windows that are cut; AURORA '
    'takes the full ones only, and with `clip` both agree (first comparison).',
    Reason.SINGLE: "RTAMT's offline evaluation raises UnboundLocalError (it measures the time "
    'between samples); AURORA has the value.',
    Reason.UNBOUNDED: 'RTAMT refuses to make a past formula of it.',
    Reason.PAST: "RTAMT's pastified operators also take in the values for times before the first "
    'sample (windows cut at the beginning, or minus infinity from its delay by `once`).',
    Reason.UNEVEN: "RTAMT's past formula delays a predicate twice (by itself and by its variable) "
    'and, instead of a bounded historically, its operand: values are wrong.',
    Reason.TWICE: "RTAMT's online operators are kept by their text, so equal ones share a memory "
    'that is filled twice per sample: values are wrong.',
    Reason.LATE: 'RTAMT has not yet given a value when the trace ends.',
}


@dataclass(kw_only=True)
class Agreement:
    """Counts of one comparison over all pairs.

    Attributes:
        pairs: Pairs of which at least one sample was compared.
        samples: Samples compared.
        greatest: Greatest difference among them.
        unequal: Numbers of the pairs with a difference above the tolerance.
        pairs_left_out: Pairs without any compared sample, by reason.
        samples_left_out: Samples of compared pairs, by reason.
    """

    pairs: int = 0
    samples: int = 0
    greatest: float = 0.0
    unequal: list[int] = field(default_factory=list)
    pairs_left_out: Counter[Reason] = field(default_factory=Counter)
    samples_left_out: Counter[Reason] = field(default_factory=Counter)


class Comparison:
    """Compares pairs and keeps the counts."""

    def __init__(self) -> None:
        self.modes = {mode: Agreement() for mode in Mode}

    @property
    def unequal(self) -> list[int]:
        """Numbers of the pairs that differ anywhere."""
        return sorted({number for found in self.modes.values() for number in found.unequal})

    def compare(self, pair: Pair) -> None:
        """Evaluate a pair with both tools, in every mode that RTAMT has for it."""
        signals = {c: SampledSignals(values=pair.trace, dt_s=1.0, clip=c) for c in (True, False)}
        cut = robustness(pair.formula, signals[True])
        full = robustness(pair.formula, signals[False])
        start, stop = undisturbed(pair.formula, pair.samples)
        self._offline(pair, cut, full, start, stop)
        self._online(pair, cut, start, stop)

    def _offline(
        self, pair: Pair, cut: ValidSeries, full: ValidSeries, start: int, stop: int
    ) -> None:
        offline, complete = self.modes[Mode.OFFLINE], self.modes[Mode.FULL]
        if pair.samples == 1:
            offline.pairs_left_out[Reason.SINGLE] += 1
            complete.pairs_left_out[Reason.SINGLE] += 1
            return
        theirs = np.array(offline_values(pair))
        _count(offline, pair, cut, theirs, start, stop, Reason.EMPTY)
        if endless_over_bounded(pair.formula):
            complete.pairs_left_out[Reason.ENDLESS] += 1
            return
        inside = max(start, full.start), min(stop, full.stop)
        _count(complete, pair, full, theirs, *inside, Reason.CUT)

    def _online(self, pair: Pair, cut: ValidSeries, start: int, stop: int) -> None:
        online = self.modes[Mode.ONLINE]
        lag = delay(pair.formula)
        if lag is None:
            online.pairs_left_out[Reason.UNBOUNDED] += 1
        elif past_over_future(pair.formula):
            online.pairs_left_out[Reason.PAST] += 1
        elif delayed_wrongly(pair.formula):
            online.pairs_left_out[Reason.UNEVEN] += 1
        elif lag >= pair.samples:
            online.pairs_left_out[Reason.LATE] += 1
        elif shares_state(monitor := online_monitor(pair.formula)):
            online.pairs_left_out[Reason.TWICE] += 1
        else:
            theirs = np.array(online_values(monitor, pair)[lag:])
            _count(online, pair, cut, theirs, start, min(stop, len(theirs)), Reason.EMPTY)


def _count(
    counts: Agreement,
    pair: Pair,
    ours: ValidSeries,
    theirs: np.ndarray,
    start: int,
    stop: int,
    reason: Reason,
) -> None:
    """Compare the samples [start, stop); the others are left out for a reason."""
    if start >= stop:
        counts.pairs_left_out[reason] += 1
        return
    mine = ours.values[start - ours.start : stop - ours.start]
    if len(mine) != stop - start:
        counts.unequal.append(pair.number)
        return
    difference = float(np.max(np.abs(mine - theirs[start:stop])))
    counts.pairs += 1
    counts.samples += stop - start
    counts.samples_left_out[reason] += len(theirs) - (stop - start)
    counts.greatest = max(counts.greatest, difference)
    if not difference <= TOLERANCE:
        counts.unequal.append(pair.number)
