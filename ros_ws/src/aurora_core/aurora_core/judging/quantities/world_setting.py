# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Which world was run: weather, time of day, map."""

from __future__ import annotations

from typing import Literal

import numpy as np

from aurora_core.judging.build import Inputs, Source, Target, condition
from aurora_core.judging.evaluation import Context, Evaluation, Measured, Missing
from aurora_core.judging.quantity import Quantity
from aurora_core.outcomes.condition import Condition, Window
from aurora_core.spec.parameter import Provenance, Span
from aurora_core.spec.prohibitions import ForbiddenWorld
from aurora_core.spec.quantity import QuantityName
from aurora_core.spec.reference import ENVIRONMENT_ID
from aurora_core.spec.vocabulary import TimeOfDay, Weather

Setting = Literal['weather', 'time_of_day', 'map_name']


class WorldSetting(Quantity):
    """1 at each tick when the world that was run has the setting, else 0.

    Attributes:
        setting: Which one.
        asked: What it may be.
    """

    name = QuantityName.WORLD_SETTING
    kind: Literal['world_setting'] = 'world_setting'
    window: Window = Window.RUN
    setting: Setting
    asked: tuple[str, ...]

    def measure(self, context: Context, condition: Condition) -> Evaluation:
        """Return whether the recorded world is as asked."""
        ticks = context.window(condition)
        if isinstance(ticks, Missing):
            return ticks
        found = getattr(context.view.world, self.setting)
        story = f'the recorded world has {self.setting.replace("_", " ")} {found}'
        return Measured(
            ticks=ticks,
            values=np.full(len(ticks), 1.0 if found in self.asked else 0.0),
            story=story,
            evidence=('world',),
        )


def implied(inputs: Inputs, setting: Setting, asked: str, span: Span | None) -> Condition:
    """Return that a setting of the world is the one of the request."""
    return condition(
        id=f'world.{setting}',
        sentence=f'the {setting.replace("_", " ")} of the run is {asked.replace("_", " ")}',
        signal=f'{setting}_is_{asked}',
        of=(),
        target=Target(op='>=', threshold=1.0, unit='1'),
        arguments=WorldSetting(**inputs.common, setting=setting, asked=(asked,)),
        source=Source(ids=(ENVIRONMENT_ID,), spans=(span,)),
    )


def absent(inputs: Inputs, forbidden: ForbiddenWorld) -> Condition | None:
    """Return that the run has another weather or time of day, None for what is no setting."""
    setting: Setting
    if forbidden.weather is not None:
        setting, asked, others = 'weather', forbidden.weather.value, tuple(Weather)
    elif forbidden.time_of_day is not None:
        setting, asked, others = 'time_of_day', forbidden.time_of_day.value, tuple(TimeOfDay)
    else:
        return None
    return condition(
        id=f'{forbidden.id}.holds',
        sentence=f'the {setting.replace("_", " ")} of the run is not {asked.replace("_", " ")}',
        signal=f'{setting}_is_not_{asked}',
        of=(),
        target=Target(op='>=', threshold=1.0, unit='1'),
        arguments=WorldSetting(
            **inputs.common, setting=setting, asked=tuple(o.value for o in others if o != asked)
        ),
        source=Source(
            ids=(forbidden.id,),
            spans=(forbidden.span,),
            provenance=Provenance.EXPLICIT,
            implied=False,
        ),
    )
