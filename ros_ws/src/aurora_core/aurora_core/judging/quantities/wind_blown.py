# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The wind that a flight shows: that of the run blew, and was not only recorded."""

from __future__ import annotations

from typing import Literal

import numpy as np

from aurora_core.geometry.kernel import norm2
from aurora_core.grounding.wind import gust_over_mean_mps, mean_speed_mps
from aurora_core.judging.build import Inputs, Source, Target, condition, number
from aurora_core.judging.evaluation import (
    Context,
    Evaluation,
    FloatArray,
    Missing,
    TickArray,
    at_tick,
)
from aurora_core.judging.quantity import Quantity
from aurora_core.outcomes.condition import Condition, Window
from aurora_core.outcomes.verdict import Reason
from aurora_core.quantities.air import wind_of_flight
from aurora_core.spec.parameter import Provenance
from aurora_core.spec.quantity import QuantityName
from aurora_core.spec.reference import ENVIRONMENT_ID

# Of the deviations from the mean so many are less than the gust that counts: a motor that follows
# a new attitude late looks like one for a tick.
_PERCENTILE = 99.0


class _OfFlight(Quantity):
    """What the states of one flight show."""

    window: Window = Window.AIRBORNE

    def shown(
        self, context: Context, condition: Condition
    ) -> tuple[TickArray, FloatArray] | Missing:
        """Return ticks and wind (n, 2), n >= 1."""
        (uav,) = condition.of
        ticks, wind = wind_of_flight(context.view, context.view.body(uav), self.touchdown_m)
        if len(ticks):
            return ticks, wind
        if not context.complete(condition):
            return context.short(condition)
        return Missing(reason=Reason.EMPTY_PHASE, story=f'{uav} never flew')


class WindBlown(_OfFlight):
    """How far the mean wind of a flight is from that of the recorded world, m/s."""

    name = QuantityName.WIND
    kind: Literal['wind_blown'] = 'wind_blown'

    def measure(self, context: Context, condition: Condition) -> Evaluation:
        """Return the length of the difference of the two."""
        found = self.shown(context, condition)
        if isinstance(found, Missing):
            return found
        ticks, wind = found
        east, north = (float(v) for v in wind.mean(axis=0))
        recorded = context.view.world.wind
        away_mps = norm2(east - recorded.mean_east_mps, north - recorded.mean_north_mps)
        story = (
            f'the flight shows {norm2(east, north):.2f} m/s on average, '
            f'{norm2(recorded.mean_east_mps, recorded.mean_north_mps):.2f} m/s are recorded'
        )
        return at_tick(int(ticks[-1]), away_mps, story, _evidence(condition), provisional=True)


class GustBlown(_OfFlight):
    """The greatest gust of a flight on one axis, over the mean that it shows, m/s."""

    name = QuantityName.WIND
    kind: Literal['gust_blown'] = 'gust_blown'

    def measure(self, context: Context, condition: Condition) -> Evaluation:
        """Return that speed."""
        found = self.shown(context, condition)
        if isinstance(found, Missing):
            return found
        ticks, wind = found
        off = np.abs(wind - wind.mean(axis=0))
        gust_mps = float(np.percentile(off, _PERCENTILE, axis=0).max())
        story = f'the flight shows gusts of {gust_mps:.2f} m/s over the mean'
        return at_tick(int(ticks[-1]), gust_mps, story, _evidence(condition), provisional=True)


def _evidence(condition: Condition) -> tuple[str, ...]:
    return ('world', f'uav/state[{condition.of[0]}]')


def blown(inputs: Inputs, uav: str) -> Condition:
    """Return that the wind of the run blew where a UAV flew."""
    t = inputs.tolerances
    most_mps = t.wind_blown_mps + t.wind_blown_gust_share * _gust_mps(inputs)
    return condition(
        id=f'world.wind_blown.{uav}',
        sentence=f'{uav} leans against a wind within {number(most_mps)} m/s of that of the run',
        signal=f'wind_off({uav})',
        of=(uav,),
        target=Target(op='<=', threshold=most_mps, unit='m/s'),
        arguments=WindBlown(**inputs.common),
        source=_source(inputs),
        every_sample=False,
    )


def gusts_blown(inputs: Inputs, uav: str) -> Condition | None:
    """Return that gusts shook a UAV; None where none are asked for."""
    if inputs.spec.world.gust_mps is None:
        return None
    least_mps = inputs.tolerances.gust_blown_share * _gust_mps(inputs)
    if least_mps <= 0.0:
        return None
    return condition(
        id=f'world.gust_blown.{uav}',
        sentence=f'{uav} leans against gusts of at least {number(least_mps)} m/s over the mean',
        signal=f'gust({uav})',
        of=(uav,),
        target=Target(op='>=', threshold=least_mps, unit='m/s'),
        arguments=GustBlown(**inputs.common),
        source=_source(inputs),
        every_sample=False,
    )


def _gust_mps(inputs: Inputs) -> float:
    mean = mean_speed_mps(inputs.spec, inputs.limits, inputs.tolerances), 0.0
    return gust_over_mean_mps(inputs.spec, mean, inputs.limits, inputs.tolerances)


def _source(inputs: Inputs) -> Source:
    world = inputs.spec.world
    asked = [p for p in (world.wind_mps, world.gust_mps, world.wind_from_deg) if p is not None]
    spans = (world.wind_span, *(p.span for p in asked))
    stated = any(p.provenance is Provenance.EXPLICIT for p in asked)
    return Source(
        ids=(ENVIRONMENT_ID,),
        spans=tuple(s for s in spans if s is not None),
        provenance=Provenance.EXPLICIT if stated else Provenance.DEFAULT,
    )
