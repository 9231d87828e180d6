# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What the actions of ground agents mean: when one begins to show, and when it is complete.

The executor asks at a tick, the monitor of a whole run; both ask here. An action that comes to a
standstill or to a speed begins with the first change of speed and is complete at that speed; one
that already holds when it is due ("stop" of who stands) is complete at once.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
from pydantic import FiniteFloat

from aurora_core.document import Document, omitted
from aurora_core.knowledge.limits import Tolerance, Tolerances
from aurora_core.spec.events import AgentAction, Event, EventDoneTrigger
from aurora_core.spec.parameter import Bound, Parameter
from aurora_core.spec.parking import crosses_rested, stands_s, stops_for_s
from aurora_core.spec.scenario import ScenarioSpec

FloatArray = npt.NDArray[np.float64]
BoolArray = npt.NDArray[np.bool_]

# Actions after which the agent has another speed than before.
SPEED_ACTIONS = frozenset({'stop', 'slow', 'accelerate', 'start', 'brake'})
# Of these and of yielding one cannot tell that they happen once they already hold.
_HOLDS_ALREADY = frozenset({'stop', 'slow'})

# What only somebody on the move can do.
FROM_MOTION = frozenset({'brake', 'stop', 'yield', 'slow', 'change_lane'})

# What nobody does who stands.
_GOES_ON = frozenset({'start', 'accelerate', 'change_lane'})

# What may lack of the half, or of the gain, that an action without a number asks for (m/s).
_NEARLY_MPS = 0.05

# So much more of a change without a number is commanded than asked.
_INSIDE_SHARE = 0.1
# Nobody can be told to climb more slowly (m/s).
_LEAST_CLIMB_MPS = 0.1
# And this share of the tolerance of a speed where that is a bound.
_BOUND_SHARE = 0.5

# A person that left the carriageway nearer to where it stepped onto it has crossed nothing: on the
# way to the crossing people brush the kerb (m).
CROSSED_M = 2.0

# A UAV has climbed to an altitude, or reached it, when it is this close to it (m): what it is told
# to hold it may never quite exceed.
CLIMBED_M = 1.0

# Two are farther apart than a distance by at least this much (m): who keeps it to rounding is not.
APART_M = 0.01


class ActionRules(Document):
    """What actions are measured with; the tolerances in force, as they travel in conditions.

    Attributes:
        stop_mps: Below this an agent stands.
        stop_hold_s: For how long, to have stopped.
        start_mps: At this speed an agent has set off.
        slow_share: Share of the speed at the trigger that `slow` without a number ends with.
        gain_mps: What `accelerate` without a number adds to the speed at the trigger.
        speed_mps: Tolerance on a speed to be reached: at least this ...
        speed_share: ... or this share of it.
        steps_on: Who crosses begins with the first step onto the carriageway; recorded before, it
            was with the first one towards it.
    """

    stop_mps: FiniteFloat
    stop_hold_s: FiniteFloat
    start_mps: FiniteFloat
    slow_share: FiniteFloat
    gain_mps: FiniteFloat
    speed_mps: FiniteFloat
    speed_share: FiniteFloat
    steps_on: bool = omitted(False)


def takes_time(action: AgentAction) -> bool:
    """Tell whether an action is complete only once the agent has got to its speed, lane or kerb.

    Braking and yielding count from when they show.
    """
    if action.do == 'brake':
        return action.value_mps is not None
    return action.do in ('stop', 'slow', 'accelerate', 'start', 'change_lane', 'cross')


def rest_s(spec: ScenarioSpec, event: Event, rules: ActionRules | None) -> float:
    """Return how long an event waits for its agent to have stopped first, 0 for all others (s).

    "Stops and then drives on": who stands for less time than that has not stopped. A wait that is
    stated stays what it is. "Stops for 10 s and then crosses": a person stands for that time.
    """
    trigger, action = event.trigger, event.action
    if rules is None or not isinstance(trigger, EventDoneTrigger) or trigger.after_s is not None:
        return 0.0
    if trigger.on == 'event_begun':
        return 0.0
    if not isinstance(action, AgentAction):
        return 0.0
    person = next((a for a in spec.agents if a.id == action.agent), None)
    rested = action.do == 'cross' and person is not None and crosses_rested(spec, person)
    if not rested and action.do not in _GOES_ON:
        return 0.0
    cause = next((e.action for e in spec.events if e.id == trigger.event), None)
    stops = isinstance(cause, AgentAction) and cause.agent == action.agent and cause.do == 'stop'
    if not stops:
        return 0.0
    lasts = stops_for_s(person) if rested and person is not None else None
    return rules.stop_hold_s if lasts is None else max(rules.stop_hold_s, stands_s(lasts))


def action_rules(tolerances: Tolerances, *, steps_on: bool = False) -> ActionRules:
    """Return what actions are measured with; `steps_on`: an event lets somebody cross."""
    return ActionRules(
        stop_mps=tolerances.stop_speed_mps,
        stop_hold_s=tolerances.stop_hold_s,
        start_mps=tolerances.start_speed_mps,
        slow_share=tolerances.slow_share,
        gain_mps=tolerances.speed_gain_mps,
        speed_mps=tolerances.action_speed_mps.absolute,
        speed_share=tolerances.action_speed_mps.relative,
        steps_on=steps_on,
    )


@dataclass(frozen=True, slots=True, kw_only=True)
class SpeedGoal:
    """The speed that an action is to end with.

    Attributes:
        value_mps: Speed to be reached.
        tolerance_mps: On it; none on a stated bound.
        bound: "to at most 5 m/s" is reached below it, too.
    """

    value_mps: float
    tolerance_mps: float
    bound: Bound

    def reached(self, speed_mps: FloatArray) -> BoolArray:
        """Tell of each speed (n,) in m/s whether it is the one to be reached."""
        off = speed_mps - self.value_mps
        if self.bound is Bound.AT_MOST:
            return off <= self.tolerance_mps
        if self.bound is Bound.AT_LEAST:
            return off >= -self.tolerance_mps
        return (off <= self.tolerance_mps) & (off >= -self.tolerance_mps)


def speed_goal(action: AgentAction, before_mps: float, rules: ActionRules) -> SpeedGoal | None:
    """Return the speed that an action ends with, None when it has none of its own.

    Args:
        action: What is to be done.
        before_mps: Speed of the agent when it is due.
        rules: What actions are measured with.
    """
    stated = action.value_mps
    if action.do not in SPEED_ACTIONS or action.do == 'stop':
        return None
    if stated is not None:
        slack = max(rules.speed_mps, rules.speed_share * stated.value)
        bound = stated.bound
        if bound is not Bound.EXACTLY:
            return SpeedGoal(value_mps=stated.value, tolerance_mps=0.0, bound=bound)
        if action.do in ('slow', 'brake') and before_mps < stated.value:
            # Who is slower already has nothing to do.
            bound = Bound.AT_MOST
        return SpeedGoal(value_mps=stated.value, tolerance_mps=slack, bound=bound)
    if action.do == 'slow':
        # The tolerance of a stated speed is not for this: half of 2 m/s were reached at once.
        wanted = rules.slow_share * before_mps
        return SpeedGoal(value_mps=wanted, tolerance_mps=_NEARLY_MPS, bound=Bound.AT_MOST)
    if action.do != 'accelerate':
        return None
    wanted = before_mps + rules.gain_mps
    return SpeedGoal(value_mps=wanted, tolerance_mps=_NEARLY_MPS, bound=Bound.AT_LEAST)


def ends_with_mps(action: AgentAction, before_mps: float, rules: ActionRules) -> float | None:
    """Return the speed that an action is to end with, None when it is left to the driver."""
    if action.do in ('stop', 'yield') or (action.do == 'brake' and action.value_mps is None):
        return 0.0
    goal = speed_goal(action, before_mps, rules)
    return None if goal is None else goal.value_mps


def commanded_mps(action: AgentAction, now_mps: float, rules: ActionRules) -> float | None:
    """Return the speed that is commanded for an action, None when it is left to the driver.

    Half of a speed, and a gain, are of what it was when the action was due, a tick or two ago:
    what is commanded is a little more than that. Of a stated bound it is half its tolerance more.
    """
    goal_mps, stated = ends_with_mps(action, now_mps, rules), action.value_mps
    if goal_mps is not None and stated is not None:
        slack_mps = max(rules.speed_mps, rules.speed_share * stated.value)
        inside_mps = max(0.0, stated.inside(_BOUND_SHARE * slack_mps))
        return goal_mps if stated.bound is Bound.EXACTLY else inside_mps
    if goal_mps is None or action.do not in ('slow', 'accelerate'):
        return goal_mps
    return goal_mps + _INSIDE_SHARE * (goal_mps - now_mps)


def climbed_mps(asked: Parameter) -> float:
    """Return how fast to climb or descend where that is stated: a bound is kept with a reserve."""
    return max(_LEAST_CLIMB_MPS, asked.inside(_INSIDE_SHARE * asked.value))


def least_climb_mps(asked: Parameter, tolerance: Tolerance) -> float:
    """Return the least that a stated vertical speed leaves: how long a climb may take."""
    if asked.bound is Bound.AT_LEAST:
        return max(_LEAST_CLIMB_MPS, asked.value)
    slack = tolerance.of(asked.value, approximate=asked.approximate)
    return max(_LEAST_CLIMB_MPS, min(climbed_mps(asked), asked.value - slack))


def holds_already(action: AgentAction, speed_mps: float, rules: ActionRules) -> bool:
    """Tell whether nothing is left to be done for an action that is due."""
    if action.do not in _HOLDS_ALREADY or _stands_before(action, speed_mps, rules):
        return False
    if action.do == 'stop':
        return speed_mps < rules.stop_mps
    goal = speed_goal(action, speed_mps, rules)
    return goal is not None and bool(goal.reached(np.array([speed_mps]))[0])


def _stands_before(action: AgentAction, before_mps: float, rules: ActionRules) -> bool:
    """Tell whether an agent that is to slow down, without a number, has no speed to halve."""
    return action.do == 'slow' and action.value_mps is None and before_mps < rules.start_mps


def is_complete(
    action: AgentAction, before_mps: float, speed_mps: float, rules: ActionRules
) -> bool:
    """Tell whether an action that has begun is complete at this speed, as far as one tick shows.

    Args:
        action: What was to be done.
        before_mps: Speed when it was due.
        speed_mps: Speed now.
        rules: What actions are measured with.
    """
    if action.do == 'stop':
        return speed_mps < rules.stop_mps
    if _stands_before(action, before_mps, rules):
        return False
    goal = speed_goal(action, before_mps, rules)
    if goal is not None:
        return bool(goal.reached(np.array([speed_mps]))[0])
    return action.do != 'start' or speed_mps > rules.start_mps


def completion_index(
    action: AgentAction, speeds_mps: FloatArray, hold_ticks: int, rules: ActionRules
) -> int | None:
    """Return the index at which an action is complete, None when it never is.

    Args:
        action: What is to be done; one that ends with a speed.
        speeds_mps: (n,) speeds of the agent from when the action is due.
        hold_ticks: For how many ticks it has to stand, to have stopped.
        rules: What actions are measured with.
    """
    if len(speeds_mps) == 0 or _stands_before(action, float(speeds_mps[0]), rules):
        return None
    if action.do == 'stop':
        done = _held(speeds_mps < rules.stop_mps, hold_ticks)
    else:
        goal = speed_goal(action, float(speeds_mps[0]), rules)
        done = speeds_mps > rules.start_mps if goal is None else goal.reached(speeds_mps)
    index = int(np.argmax(done)) if len(done) else 0
    return index if len(done) and bool(done[index]) else None


def _held(mask: BoolArray, ticks: int) -> BoolArray:
    """Return where a stretch of `ticks` steps begins that lies inside the mask, (n - ticks,)."""
    if len(mask) <= ticks:
        return np.zeros(0, dtype=np.bool_)
    total = np.concatenate(([0], np.cumsum(mask)))
    held: BoolArray = total[ticks + 1 :] - total[: -ticks - 1] == ticks + 1
    return held
