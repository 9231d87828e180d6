# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""How much traffic there is around what is asked for."""

from __future__ import annotations

from typing import Literal

import numpy as np
from pydantic import FiniteFloat

from aurora_core.judging.build import Inputs, Source, Target, condition, number
from aurora_core.judging.evaluation import Context, Evaluation, Later, Missing, at_tick
from aurora_core.judging.quantity import Quantity
from aurora_core.knowledge.street_length import street_length_m
from aurora_core.outcomes.condition import Condition, Window
from aurora_core.quantities.kernels import distance_2d
from aurora_core.spec.parameter import Provenance
from aurora_core.spec.quantity import QuantityName
from aurora_core.spec.reference import ENVIRONMENT_ID
from aurora_core.spec.vocabulary import Role, TrafficDensity


class Traffic(Quantity):
    """Mean number of background vehicles near the anchor of a scene, as a share of what is due.

    The anchor is the middle of the bodies on the ground that are asked for at t = 0; of a scene
    without any, of its UAVs.

    Attributes:
        radius_m: So near.
        per_km: Vehicles that are due per kilometre of street there.
        least: Vehicles that are due in any case.
    """

    name = QuantityName.TRAFFIC
    kind: Literal['traffic'] = 'traffic'
    window: Window = Window.RUN
    radius_m: FiniteFloat
    per_km: FiniteFloat
    least: FiniteFloat

    def measure(self, context: Context, condition: Condition) -> Evaluation:
        """Return that share."""
        ticks = context.window(condition)
        if isinstance(ticks, Missing):
            return ticks
        view = context.view
        behind = Role.BACKGROUND.value
        asked = [body for body in view.agents if body.entry.role != behind] or list(view.uavs)
        first = np.array([view.reference(body.body_id)[0, :2] for body in asked])
        x, y = first.mean(axis=0).tolist()
        near = np.zeros(view.ticks)
        for body in (b for b in view.agents if b.entry.role == behind):
            point = view.reference(body.body_id)
            inside = distance_2d(point[:, 0] - x, point[:, 1] - y) <= self.radius_m
            near += inside & view.present(body.body_id)
        lanes = ((lane.street_name, lane.points) for lane in view.geometry.world.lanes)
        length_km = street_length_m(lanes, (x, y), self.radius_m) / 1000.0
        due = max(self.per_km * length_km, self.least)
        mean, last = float(near[ticks].mean()), int(ticks[-1])
        story = (
            f'{mean:.1f} vehicles of the traffic were near on average, {due:.1f} are due on '
            f'{length_km:.2f} km of street'
        )
        topics = ('roster', 'ground/state')
        return at_tick(last, mean / due, story, topics, later=Later.ANY)


def implied(inputs: Inputs, density: TrafficDensity) -> Condition:
    """Return that there is as much traffic as the prompt says."""
    tolerances = inputs.tolerances
    low, high = tolerances.traffic_share
    radius_m, per_km = tolerances.traffic_radius_m, tolerances.traffic_per_km[density.value]
    return condition(
        id='world.traffic',
        sentence=(
            f'the traffic is {number(100.0 * low)} to {number(100.0 * high)} % of '
            f'{number(per_km)} vehicles per km of street within {number(radius_m)} m'
        ),
        signal='traffic',
        of=(),
        target=Target(
            op='==', threshold=(low + high) / 2.0, unit='1', tolerance=(high - low) / 2.0
        ),
        arguments=Traffic(
            **inputs.common, radius_m=radius_m, per_km=per_km, least=tolerances.traffic_least
        ),
        source=Source(
            ids=(ENVIRONMENT_ID,),
            spans=(inputs.spec.world.span,),
            provenance=Provenance.EXPLICIT,
            implied=False,
        ),
        every_sample=False,
    )
