# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""How many bodies there are."""

from __future__ import annotations

from typing import Literal

import numpy as np

from aurora_core.judging.build import Inputs, Source, Target, condition, number, number_target
from aurora_core.judging.evaluation import Context, Evaluation, Measured, Missing
from aurora_core.judging.quantity import Quantity
from aurora_core.knowledge.limits import Tolerance
from aurora_core.outcomes.condition import Condition, Window
from aurora_core.spec.parameter import Provenance, Span
from aurora_core.spec.prohibitions import ForbiddenAgent
from aurora_core.spec.quantity import QuantityName
from aurora_core.spec.requirements import SceneCount, types_counted
from aurora_core.spec.vocabulary import Role

_EXACT = Tolerance(absolute=0.0, relative=0.0)


class Count(Quantity):
    """Number of bodies of some types.

    Attributes:
        types: Vocabulary types that count.
        background: Traffic in the background counts, too; otherwise only those that are asked for
            by name and what is no background.
    """

    name = QuantityName.COUNT
    kind: Literal['count'] = 'count'
    window: Window = Window.RUN
    types: tuple[str, ...]
    background: bool = False

    def measure(self, context: Context, condition: Condition) -> Evaluation:
        """Return how many there are at each tick."""
        ticks = context.window(condition)
        if isinstance(ticks, Missing):
            return ticks
        view = context.view
        counted = [
            view.present(body.body_id)
            for body in (*view.agents, *view.uavs)
            if body.entry.type_name in self.types
            and (
                self.background
                or body.entry.role != Role.BACKGROUND.value
                or body.body_id in condition.of
            )
        ]
        values = np.zeros(view.ticks)
        for present in counted:
            values += present
        return Measured(ticks=ticks, values=values[ticks], evidence=('roster', 'ground/state'))


def implied(
    inputs: Inputs, kind: str, ids: tuple[str, ...], spans: tuple[Span | None, ...]
) -> Condition:
    """Return that as many of a type take part as are asked for, background traffic aside."""
    return condition(
        id=f'scene.{kind}',
        sentence=f'as many of the type {kind} take part as are asked for: {len(ids)}',
        signal=f'count({kind})',
        of=ids,
        target=Target(op='==', threshold=float(len(ids)), unit='1', tolerance=0.0),
        arguments=Count(**inputs.common, types=(kind,)),
        source=Source(ids=ids, spans=spans),
    )


def stated(inputs: Inputs, count: SceneCount) -> Condition:
    """Return that the whole scene has the stated number of a kind."""
    value = count.value
    return condition(
        id=f'{count.id}.holds',
        sentence=(
            f'{value.bound.value.replace("_", " ")} {number(value.value)} of the kind '
            f'{count.kind} in the whole scene'
        ),
        signal=f'count_all({count.kind})',
        of=(),
        target=number_target(value, _EXACT),
        arguments=Count(**inputs.common, types=types_counted(count.kind), background=True),
        source=Source(
            ids=(count.id,),
            spans=(count.span, value.span),
            provenance=value.provenance,
            implied=False,
        ),
    )


def absent(inputs: Inputs, forbidden: ForbiddenAgent) -> Condition:
    """Return that the whole scene has none of a forbidden type."""
    return condition(
        id=f'{forbidden.id}.holds',
        sentence=f'there is no {forbidden.type} in the whole scene',
        signal=f'count_all({forbidden.type})',
        of=(),
        target=Target(op='==', threshold=0.0, unit='1', tolerance=0.0),
        arguments=Count(**inputs.common, types=(str(forbidden.type),), background=True),
        source=Source(
            ids=(forbidden.id,),
            spans=(forbidden.span,),
            provenance=Provenance.EXPLICIT,
            implied=False,
        ),
    )
