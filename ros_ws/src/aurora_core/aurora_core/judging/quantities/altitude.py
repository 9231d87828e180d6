# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The height of a UAV above ground, flown and commanded."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Literal

from aurora_core.judging.build import (
    EVERY_RUN,
    Inputs,
    Source,
    Target,
    bound_words,
    condition,
    number,
    number_target,
    stated_by,
)
from aurora_core.judging.evaluation import Context, FloatArray
from aurora_core.judging.series import Series, StatedSeries
from aurora_core.outcomes.condition import Condition, MissionArguments, Window
from aurora_core.quantities import motion
from aurora_core.spec.parameter import Parameter, Provenance
from aurora_core.spec.quantity import QuantityName
from aurora_core.spec.scenario import Event, UavAction
from aurora_core.trace.layout import UavCommandColumn

# Who is to stay in the air is higher than this above ground (m).
AIRBORNE_M = 1.0


class Altitude(StatedSeries):
    """Height of a UAV above ground, metres."""

    name = QuantityName.ALTITUDE
    kind: Literal['altitude'] = 'altitude'

    def values(self, context: Context, condition: Condition) -> FloatArray:
        """Return the height at every tick."""
        return motion.altitude(context.view, context.view.body(condition.of[0]))


class CommandedAltitude(Series):
    """Height of a UAV's set-point above ground, metres."""

    name = QuantityName.ALTITUDE
    kind: Literal['commanded_altitude'] = 'commanded_altitude'

    def values(self, context: Context, condition: Condition) -> FloatArray:
        """Return the commanded height at every tick."""
        uav = context.view.body(condition.of[0])
        return context.view.commands(uav)[:, UavCommandColumn.Z]

    def topics(self, condition: Condition) -> tuple[str, ...]:
        """Return the evidence: commands."""
        return tuple(f'uav/command[{name}]' for name in condition.of)


def limits(
    inputs: Inputs, uav: str, missions: tuple[MissionArguments, ...]
) -> Iterator[Condition]:
    """Yield that a UAV flies and is commanded neither too high nor, on a mission, too low."""
    low, high = inputs.limits.uav_altitude_min_m, inputs.limits.uav_altitude_max_m
    slack = inputs.tolerances.altitude_m
    yield condition(
        id=f'safety.altitude_max.{uav}',
        sentence=f'{uav} flies at most {number(high)} m high',
        of=(uav,),
        target=Target(op='<=', threshold=high + slack.of(high), unit='m'),
        arguments=Altitude(**inputs.common, window=Window.AIRBORNE),
        source=EVERY_RUN,
    )
    if not missions:
        return
    yield condition(
        id=f'safety.altitude_min.{uav}',
        sentence=f'{uav} flies at least {number(low)} m high while on mission',
        of=(uav,),
        target=Target(op='>=', threshold=max(0.0, low - slack.of(low)), unit='m'),
        arguments=Altitude(**inputs.common, window=Window.ON_MISSION, missions=missions),
        source=EVERY_RUN,
    )
    yield condition(
        id=f'safety.altitude_command.{uav}',
        sentence=(
            f'{uav} is commanded to between {number(low)} m and {number(high)} m while on mission'
        ),
        signal=f'commanded_altitude({uav})',
        of=(uav,),
        target=Target(
            op='==', threshold=(low + high) / 2.0, unit='m', tolerance=(high - low) / 2.0
        ),
        arguments=CommandedAltitude(**inputs.common, window=Window.ON_MISSION, missions=missions),
        source=EVERY_RUN,
    )


def stays_up(inputs: Inputs, missions: tuple[MissionArguments, ...], source: Source) -> Condition:
    """Return that a UAV is in the air from its last mission to the end of the run."""
    uav = missions[-1].uav
    return condition(
        id=f'{uav}.stays_up',
        sentence=f'{uav} is in the air from its last mission to the end of the run',
        of=(uav,),
        target=Target(op='>', threshold=AIRBORNE_M, unit='m'),
        arguments=Altitude(**inputs.common, window=Window.TO_THE_END, missions=missions),
        source=source,
    )


def climb(
    inputs: Inputs, action: UavAction, altitude: Parameter, event: Event, source: Source
) -> Condition:
    """Return that a UAV reaches the altitude that an event makes it climb to."""
    if altitude.provenance is Provenance.EXPLICIT:
        source = stated_by(source, altitude)
    return condition(
        id=f'{event.id}.altitude',
        sentence=f'{action.uav} reaches {bound_words(altitude)} {number(altitude.value)} m',
        of=(action.uav,),
        target=number_target(altitude, inputs.tolerances.altitude_m),
        arguments=Altitude(**inputs.of_event(event.id), window=Window.RUN),
        source=source,
        by_s=inputs.facts.horizon_s,
    )
