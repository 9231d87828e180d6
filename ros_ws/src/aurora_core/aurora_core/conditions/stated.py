# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Conditions that the prompt states itself: no tolerance, except that `==` needs one."""

from __future__ import annotations

from collections.abc import Iterator

from aurora_core.conditions.build import Inputs, Source, Target, Underivable, condition, number
from aurora_core.conditions.condition import Condition, MissionArguments, Window
from aurora_core.conditions.missions import mission_arguments
from aurora_core.knowledge.limits import Tolerances
from aurora_core.spec.parameter import Bound, Unit
from aurora_core.spec.quantity import QuantityName
from aurora_core.spec.scenario import StatedCondition
from aurora_core.spec.vocabulary import MissionMode

# Quantities with a value at every sample: the worst one, a stretch or a share counts.
_SERIES = {
    'distance': (QuantityName.DISTANCE, 2),
    'horizontal_distance': (QuantityName.HORIZONTAL_DISTANCE, 2),
    'separation': (QuantityName.SEPARATION, 2),
    'altitude': (QuantityName.ALTITUDE, 1),
    'speed': (QuantityName.SPEED, 1),
}
# Quantities with one value per mission phase or event.
_SINGLE = {
    'tracked_fraction': (QuantityName.TRACKED_FRACTION, 2),
    'visible_fraction': (QuantityName.VISIBLE_FRACTION, 2),
    'visible_time': (QuantityName.VISIBLE_TIME, 2),
    'hover_drift': (QuantityName.HOVER_DRIFT, 1),
    'event_time': (QuantityName.EVENT_TIME, 1),
}
_BOUNDS = {'>=': Bound.AT_LEAST, '>': Bound.AT_LEAST, '<=': Bound.AT_MOST, '<': Bound.AT_MOST}


def stated_conditions(inputs: Inputs) -> Iterator[Condition | Underivable]:
    """Yield the conditions that the prompt states."""
    for stated in inputs.spec.conditions:
        try:
            made = _one(inputs, stated)
        except _CannotSayError as reason:
            yield Underivable(element=stated.id, what=str(reason), span=stated.span)
        else:
            yield made


class _CannotSayError(Exception):
    """The condition cannot be expressed yet; the text says what of it."""


def _one(inputs: Inputs, stated: StatedCondition) -> Condition:
    series, single = _SERIES.get(stated.quantity), _SINGLE.get(stated.quantity)
    found = series or single
    if found is None or len(stated.of) != found[1]:
        raise _CannotSayError(f'condition on {stated.quantity} of {", ".join(stated.of)}')
    quantity = found[0]
    if quantity is QuantityName.EVENT_TIME:
        window, mission = Window.MOMENT, None
    else:
        window, mission = _window(inputs, stated, quantity)
    target = _target(inputs.tolerances, stated)
    source = Source(
        ids=(stated.id,),
        spans=(stated.span, stated.value.span),
        provenance=stated.value.provenance,
        implied=False,
    )
    words = f'{stated.quantity.replace("_", " ")} of {" and ".join(stated.of)}'
    sentence = f'{words} {stated.op} {number(stated.value.value)} {stated.value.unit.value}'
    fraction = stated.fraction.value if stated.fraction is not None else None
    hold_s = stated.hold_s.value if stated.hold_s is not None else None
    by_s = stated.by_s.value if stated.by_s is not None else None
    if single is not None and (fraction is not None or by_s is not None):
        raise _CannotSayError(f'share or deadline of {stated.quantity}')
    if fraction is not None:
        if hold_s is not None or by_s is not None:
            raise _CannotSayError('a share together with a stretch or a deadline')
        return condition(
            id=f'{stated.id}.share',
            sentence=f'{sentence} for {number(100 * fraction)} % of the time',
            quantity=quantity,
            signal=f'{stated.quantity}_share({",".join(stated.of)})',
            of=stated.of,
            target=Target(op='>=', threshold=fraction, unit='1'),
            fraction=fraction,
            arguments=inputs.arguments(
                window,
                aspect='share',
                mission=mission,
                bound=_BOUNDS.get(stated.op, Bound.EXACTLY),
                wanted=stated.value.value,
                sample_tolerance=target.tolerance or 0.0,
            ),
            source=source,
            every_sample=False,
        )
    aspect = 'action' if quantity is QuantityName.EVENT_TIME else ''
    if quantity is QuantityName.VISIBLE_TIME and hold_s is not None:
        aspect, hold_s = 'longest', None
    return condition(
        id=f'{stated.id}.holds',
        sentence=sentence,
        quantity=quantity,
        of=stated.of,
        target=target,
        arguments=inputs.arguments(
            # A deadline counts from scenario start, not from the phase.
            Window.RUN if by_s is not None else window,
            aspect=aspect,
            mission=mission,
            event=stated.of[0] if quantity is QuantityName.EVENT_TIME else None,
        ),
        source=source,
        every_sample=single is None or quantity is QuantityName.HOVER_DRIFT,
        hold_s=hold_s if single is None else None,
        by_s=by_s,
    )


def _window(
    inputs: Inputs, stated: StatedCondition, quantity: QuantityName
) -> tuple[Window, MissionArguments | None]:
    uavs = {uav.id for uav in inputs.spec.uavs}
    mode = {
        QuantityName.TRACKED_FRACTION: MissionMode.TRACK,
        QuantityName.HOVER_DRIFT: MissionMode.HOVER,
    }.get(quantity)
    for mission in inputs.spec.missions:
        if mission.uav in stated.of and mode in (None, mission.mode):
            return Window.PHASE, mission_arguments(inputs, mission)
    if quantity in (
        QuantityName.TRACKED_FRACTION,
        QuantityName.VISIBLE_FRACTION,
        QuantityName.VISIBLE_TIME,
        QuantityName.HOVER_DRIFT,
    ):
        raise _CannotSayError(f'{stated.quantity} without a mission of {", ".join(stated.of)}')
    return (Window.AIRBORNE if set(stated.of) & uavs else Window.MISSIONS), None


def _target(tolerances: Tolerances, stated: StatedCondition) -> Target:
    value, unit = stated.value.value, stated.value.unit
    tolerance = None
    if stated.op == '==':
        kind = {
            Unit.METRE: tolerances.placement_vehicle_m,
            Unit.METRE_PER_SECOND: tolerances.route_speed_mps,
            Unit.SECOND: tolerances.duration_s,
        }.get(unit, tolerances.duration_s)
        if stated.quantity == 'altitude':
            kind = tolerances.altitude_m
        tolerance = kind.of(value, approximate=stated.value.approximate)
    return Target(op=stated.op, threshold=value, unit=unit.value, tolerance=tolerance)
