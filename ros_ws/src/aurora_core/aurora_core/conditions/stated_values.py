# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What the stated conditions of all quantities share: comparison, source, words, missions."""

from __future__ import annotations

from aurora_core.judging.build import Inputs, Source, Target, number
from aurora_core.knowledge.limits import Tolerances
from aurora_core.spec.parameter import Parameter, Span, Unit
from aurora_core.spec.quantity import IN_PERCENT, OP_WORDS, SHARE_VERBS
from aurora_core.spec.scenario import StatedCondition, UavMission
from aurora_core.spec.vocabulary import MissionMode

_EXTRAS = {'hold_s': 'stretch', 'by_s': 'deadline', 'fraction': 'share'}


class CannotSayError(Exception):
    """The condition cannot be expressed yet; the text says what of it."""


def only(stated: StatedCondition, *allowed: str) -> None:
    """Refuse a stretch, deadline or share that the quantity has no meaning for.

    Args:
        stated: The condition.
        allowed: Of `hold_s`, `by_s`, `fraction`, those that it may have.

    Raises:
        CannotSayError: It has another one. Leaving it out would ask for something else.
    """
    for name, word in _EXTRAS.items():
        if name not in allowed and getattr(stated, name) is not None:
            raise CannotSayError(f'{word} of {stated.quantity}')


def asked_true(stated: StatedCondition) -> None:
    """Refuse what is not "yes" to a quantity that is yes or no.

    Raises:
        CannotSayError: It is asked not to be so.
    """
    if stated.op not in ('==', '>=') or stated.value.value != 1.0:
        raise CannotSayError(f'{stated.quantity} {stated.op} {number(stated.value.value)}')


def value_of(parameter: Parameter | None) -> float | None:
    """Return the number of a parameter that may be missing."""
    return None if parameter is None else parameter.value


def source_of(stated: StatedCondition) -> Source:
    """Return where a stated condition comes from."""
    return Source(
        ids=(stated.id,),
        spans=(stated.span, stated.value.span),
        provenance=stated.value.provenance,
        implied=False,
    )


def sentence_of(stated: StatedCondition) -> str:
    """Return the comparison in words."""
    value, unit = stated.value.value, stated.value.unit
    much = number(value) if unit is Unit.ONE else f'{number(value)} {unit.value}'
    if stated.quantity in IN_PERCENT:
        much = f'{number(100.0 * value)} %'
    bound = f'{OP_WORDS[stated.op]} {much}'
    text = f'{stated.quantity.replace("_", " ")} of {" and ".join(stated.of)} is {bound}'
    if stated.quantity in SHARE_VERBS and len(stated.of) == 2:
        who, whom = stated.of
        text = f'{who} {SHARE_VERBS[stated.quantity]} {whom} for {bound} of the time'
    if stated.hold_s is not None:
        text += f' for {number(stated.hold_s.value)} s without a break'
    if stated.by_s is not None:
        text += f' by {number(stated.by_s.value)} s'
    return text


def target_of(tolerances: Tolerances, stated: StatedCondition) -> Target:
    """Return the comparison; `==` has the tolerance of its quantity, counts and shares none."""
    value, unit = stated.value.value, stated.value.unit
    kind = {
        Unit.METRE: tolerances.placement_vehicle_m,
        Unit.METRE_PER_SECOND: tolerances.route_speed_mps,
        Unit.METRE_PER_SECOND_SQUARED: tolerances.deceleration_mps2,
        Unit.SECOND: tolerances.duration_s,
    }.get(unit)
    if stated.quantity == 'vertical_speed':
        kind = tolerances.vertical_mps
    if stated.quantity == 'time_headway':
        kind = tolerances.headway_s
    if stated.quantity == 'altitude':
        kind = tolerances.altitude_m
    tolerance = None
    if stated.op == '==':
        approximate = stated.value.approximate
        tolerance = 0.0 if kind is None else kind.of(value, approximate=approximate)
    return Target(op=stated.op, threshold=value, unit=unit.value, tolerance=tolerance)


def missions_of(
    inputs: Inputs, stated: StatedCondition, mode: MissionMode | None = None
) -> tuple[UavMission, ...]:
    """Return the missions in whose phases a condition has to hold.

    Those of its UAVs. Of one UAV's missions the ones that the same clause asks for, if there are
    any, and of these the ones whose target the condition names: "hovers, then tracks the bus,
    staying within 30 m of it" is about the second one alone.

    Args:
        inputs: The request.
        stated: The condition.
        mode: Only missions of this mode.
    """
    own = [m for m in inputs.spec.missions if m.uav in stated.of and mode in (None, m.mode)]
    if len({m.uav for m in own}) == 1:
        for chosen in (
            [m for m in own if _meet(m.span, stated.span)],
            [m for m in own if m.target in stated.of],
        ):
            own = [m for m in own if m in chosen] or own
    return tuple(own)


def _meet(a: Span | None, b: Span | None) -> bool:
    return a is not None and b is not None and a.start < b.end and b.start < a.end
