# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""How long a mission lasts."""

from __future__ import annotations

from typing import Literal

from pydantic import FiniteFloat

from aurora_core.document import omitted
from aurora_core.judging.build import (
    Inputs,
    Source,
    bound_words,
    condition,
    number,
    number_target,
    stated_by,
)
from aurora_core.judging.evaluation import Context, Evaluation, Later, at_tick
from aurora_core.judging.quantity import OfMission
from aurora_core.outcomes.condition import Condition, MissionArguments
from aurora_core.spec.parameter import Parameter
from aurora_core.spec.quantity import QuantityName


class PhaseDuration(OfMission):
    """Time from capture to the first command of the next phase, seconds.

    Attributes:
        wanted_s: Of a mission that an event may end before its time: what it counts as then.
    """

    name = QuantityName.PHASE_DURATION
    kind: Literal['phase_duration'] = 'phase_duration'
    wanted_s: FiniteFloat | None = omitted(None)

    def measure(self, context: Context, condition: Condition) -> Evaluation:
        """Return that time."""
        missing = context.phase_missing(condition, self.mission)
        if missing is not None:
            return missing
        phase = context.phase(self.mission, self.touchdown_m)
        assert phase.capture_tick is not None  # nothing is missing
        value = context.time_s(phase.stop_tick - phase.capture_tick)
        story = (
            f'{self.mission.mission} lasted from {context.time_s(phase.capture_tick):.2f} s to '
            f'{context.time_s(phase.stop_tick):.2f} s, {value:.2f} s'
        )
        left_by, wanted_s = self.mission.left_by, self.wanted_s
        if left_by is not None and wanted_s is not None and value < wanted_s:
            trigger = context.events.trigger_tick(left_by)
            ended = trigger is not None and phase.end_tick is not None
            if ended and context.events.action_tick(left_by, trigger or 0) == phase.end_tick:
                value, story = wanted_s, f'{story}, until {left_by} ended it'
        return at_tick(phase.stop_tick - 1, value, story, self.phase_topics, later=Later.RISES)


def implied(
    inputs: Inputs, mission: MissionArguments, duration: Parameter, source: Source
) -> Condition:
    """Return that a mission lasts as long as the prompt says, or until what may end it."""
    ends = '' if mission.left_by is None else f', or until {mission.left_by} ends it'
    words = f'{bound_words(duration)} {number(duration.value)} s'
    return condition(
        id=f'{mission.mission}.duration',
        sentence=f'{mission.mission} lasts {words}{ends}',
        of=(mission.uav,),
        target=number_target(duration, inputs.tolerances.duration_s),
        arguments=PhaseDuration(
            **inputs.common,
            mission=mission,
            wanted_s=None if mission.left_by is None else duration.value,
        ),
        source=stated_by(source, duration),
        every_sample=False,
    )
