# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""When an agent has done for the stated time what it does: stood, or moved without a stop.

Who is to stop has moved before. Who is to drive at a speed does so from when it is as fast.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from aurora_core.quantities import motion
from aurora_core.quantities.actions import ActionRules, SpeedGoal
from aurora_core.quantities.ticks import first_tick, whole_ticks
from aurora_core.quantities.view import RunView
from aurora_core.spec.doing import doing
from aurora_core.spec.parking import stands_s, stops_for_s
from aurora_core.spec.scenario import Behavior, BehaviorDoneTrigger, GroundAgent, ScenarioSpec
from aurora_core.spec.vocabulary import STANDING

BoolArray = npt.NDArray[np.bool_]

# That somebody stands shows a tick or two later: who sets off by itself has stood for so much
# less in the record (s).
_SHOWS_S = 0.2


class DoingWatch:
    """How long somebody has done something in one stretch, tick after tick.

    Args:
        agent: Who.
        behavior: What, for a stated time.
        rules: Speeds at which somebody stands, has set off, and is as fast as is stated.
        dt_s: Length of a tick.
    """

    def __init__(
        self, agent: GroundAgent, behavior: Behavior, rules: ActionRules, dt_s: float
    ) -> None:
        stated, speed = behavior.duration_s, behavior.speed_mps
        assert stated is not None  # that is what is waited for
        self._rules = rules
        self._stands = behavior.kind in STANDING
        need_s = stands_s(stated) - (_SHOWS_S if self._stands else 0.0)
        self._need = whole_ticks(max(0.0, need_s), dt_s)
        self._begun = stated is not stops_for_s(agent)
        self._goal: SpeedGoal | None = None
        if speed is not None and not self._stands:
            slack_mps = max(rules.speed_mps, rules.speed_share * speed.value)
            self._goal = SpeedGoal(
                value_mps=speed.value, tolerance_mps=slack_mps, bound=speed.bound
            )
        self._ticks = 0

    def step(self, speed_mps: float | None) -> bool:
        """Return whether it has done so for its time by a tick; once is for good.

        Args:
            speed_mps: Its speed; None: it is gone.
        """
        if self._ticks >= self._need > 0:
            return True
        self._ticks = self._ticks + 1 if speed_mps is not None and self._does(speed_mps) else 0
        return self._ticks >= self._need

    def _does(self, speed_mps: float) -> bool:
        moves = speed_mps > self._rules.start_mps
        self._begun |= moves
        if self._stands:
            return self._begun and speed_mps < self._rules.stop_mps
        if self._goal is not None and bool(self._goal.reached(np.array(speed_mps))):
            self._goal = None
        return moves and self._goal is None


def done_tick(
    view: RunView, spec: ScenarioSpec, trigger: BehaviorDoneTrigger, rules: ActionRules | None
) -> int | None:
    """Return the tick at which the stated time of what an agent does is over, None if never."""
    found = doing(spec, trigger)
    if found is None or rules is None:
        return None
    watch = DoingWatch(*found, rules, view.dt_s)
    speed, here = motion.speed(view, view.body(trigger.who)), view.present(trigger.who)
    done = [
        watch.step(v if there else None)
        for v, there in zip(speed.tolist(), here.tolist(), strict=True)
    ]
    return first_tick(np.array(done, dtype=np.bool_))


def doing_watches(spec: ScenarioSpec, rules: ActionRules, dt_s: float) -> dict[str, DoingWatch]:
    """Return what has to be watched for the triggers of events, by event."""
    found = {
        event.id: doing(spec, event.trigger)
        for event in spec.events
        if isinstance(event.trigger, BehaviorDoneTrigger)
    }
    return {
        event: DoingWatch(*one, rules, dt_s) for event, one in found.items() if one is not None
    }
