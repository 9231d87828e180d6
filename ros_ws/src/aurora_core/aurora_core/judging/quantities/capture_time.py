# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""How long a UAV needs to where its mission begins."""

from __future__ import annotations

from typing import Literal

from aurora_core.errors import VerificationError
from aurora_core.judging.build import Inputs, Source, Target, condition, number
from aurora_core.judging.evaluation import Context, Evaluation, at_tick
from aurora_core.judging.quantity import OfMission
from aurora_core.judging.until import not_yet
from aurora_core.outcomes.condition import Condition, MissionArguments, Window
from aurora_core.outcomes.schedule import MissionFacts
from aurora_core.outcomes.verdict import Reason
from aurora_core.spec.quantity import QuantityName


class CaptureTime(OfMission):
    """Time from the end of the ascent (a later mission: its first command) to capture, s."""

    name = QuantityName.CAPTURE_TIME
    kind: Literal['capture_time'] = 'capture_time'
    window: Window = Window.MOMENT

    def measure(self, context: Context, condition: Condition) -> Evaluation:
        """Return that time; a target that is gone before excuses, the end of the run does not."""
        mission = self.mission
        phase = context.phase(mission, self.touchdown_m)
        if phase.capture_tick is not None and phase.ready_tick is not None:
            value = context.time_s(phase.capture_tick - phase.ready_tick)
            story = (
                f'{mission.uav} captured at {context.time_s(phase.capture_tick):.2f} s, '
                f'{value:.2f} s after {context.time_s(phase.ready_tick):.2f} s'
            )
            return at_tick(phase.capture_tick, value, story, self.phase_topics)
        missing = context.phase_missing(condition, mission)
        if missing is None:
            raise VerificationError(f'{condition.id}: a phase without capture must be missing')
        lasted = phase.end_tick is None and phase.ready_tick is not None
        if lasted and missing.reason is not Reason.TARGET_GONE:
            # Not by the end of the record: at the earliest with the next tick.
            waited_s = context.time_s(context.view.ticks - (phase.ready_tick or 0))
            if waited_s > condition.threshold or context.complete(condition):
                story = f'{mission.uav} had not captured after {waited_s:.2f} s'
                tick, topics = context.view.ticks - 1, self.phase_topics
                return not_yet(context, condition, tick, waited_s, story, topics)
            return context.short(condition)
        return missing


def implied(
    inputs: Inputs, mission: MissionArguments, facts: MissionFacts, source: Source
) -> Condition:
    """Return that a UAV captures in the time that the way takes."""
    allowed_s = inputs.tolerances.capture_s + facts.transit_m / facts.transit_speed_mps
    return condition(
        id=f'{mission.mission}.capture',
        sentence=(
            f'{mission.uav} captures {mission.mission} within {number(allowed_s)} s after its '
            'ascent'
        ),
        of=(mission.uav,),
        target=Target(op='<=', threshold=allowed_s, unit='s'),
        arguments=CaptureTime(**inputs.common, mission=mission),
        source=source,
        every_sample=False,
    )
