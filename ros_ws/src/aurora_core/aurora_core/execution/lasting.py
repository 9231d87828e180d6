# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""For how long agents do something: who stands sets off in time, and the run lasts long enough."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from aurora_core.comm.link import whole_ticks
from aurora_core.execution.observe import Observation
from aurora_core.outcomes.grounded import GroundedAgent
from aurora_core.quantities.actions import ActionRules
from aurora_core.spec.parameter import Bound, Parameter
from aurora_core.spec.parking import stands_first_s, stands_s, stops_for_s
from aurora_core.spec.scenario import ScenarioSpec
from aurora_core.spec.vocabulary import STANDING, BehaviorKind

# What goes on for some time does so for so much longer (s): setting off is no part of it. Who
# tailgates closes up before.
_SPARE_S, _CLOSES_UP_S = 1.0, 20.0

# Sums of ticks are that exact (s); that somebody stands shows a tick or two later.
_ROUNDING_S = 0.2


@dataclass(slots=True, kw_only=True)
class _Doing:
    """How long somebody has done in one stretch what it is to do for some time.

    Attributes:
        begun: It stands from t = 0, or has been on the move: who is to stop drives before.
    """

    agent: str
    kind: BehaviorKind
    stated: Parameter
    begun: bool
    done_s: float = 0.0

    @property
    def need_s(self) -> float:
        """For how long it has to."""
        if self.kind in STANDING:
            return min(self.stated.value, stands_s(self.stated)) - _ROUNDING_S
        closes_s = _CLOSES_UP_S if self.kind is BehaviorKind.TAILGATE else 0.0
        return self.stated.value + _SPARE_S + closes_s

    @property
    def ends(self) -> bool:
        """Whether it is to be seen to end."""
        return self.kind in STANDING and self.stated.bound is not Bound.AT_LEAST


class Standing:
    """Who sets off by itself after a stated time: from t = 0, or from when it has stopped.

    Args:
        spec: The request.
        agents: As grounded.
        dt_s: Length of a tick.
    """

    def __init__(self, spec: ScenarioSpec, agents: Sequence[GroundedAgent], dt_s: float) -> None:
        asked = {agent.id: agent for agent in spec.agents}
        self._until: dict[int, int] = {}
        self._stop_ticks: dict[int, int] = {}
        for index, agent in enumerate(agents):
            first = stands_first_s(asked[agent.id]) if agent.id in asked else None
            if first is not None:
                self._until[index] = whole_ticks(stands_s(first), dt_s)
            if agent.stop_s is not None:
                self._stop_ticks[index] = whole_ticks(agent.stop_s, dt_s)

    def begins(self, index: int, tick: int) -> None:
        """Note that somebody stands from a tick on."""
        if index in self._stop_ticks:
            self._until[index] = tick + self._stop_ticks[index]

    def leaves(self, index: int) -> None:
        """Note that somebody has been told to drive on, and how fast."""
        self._until.pop(index, None)

    def over(self, tick: int) -> list[int]:
        """Return who has stood for its time, each once."""
        found = [index for index, until in self._until.items() if until <= tick]
        for index in found:
            del self._until[index]
        return found


class Lasting:
    """What agents are to do for some time: the run goes on until they have done so.

    Args:
        spec: The request.
        rules: Speeds at which somebody stands, and has set off.
        dt_s: Length of a tick.
    """

    def __init__(self, spec: ScenarioSpec, rules: ActionRules, dt_s: float) -> None:
        self._rules = rules
        self._dt_s = dt_s
        self._left = [
            _Doing(
                agent=agent.id,
                kind=b.kind,
                stated=b.duration_s,
                begun=b.duration_s is not stops_for_s(agent),
            )
            for agent in spec.agents
            for b in agent.behaviors
            if b.duration_s is not None
        ]

    def step(self, seen: Observation) -> None:
        """Count a tick for everybody, and leave out who is done or gone."""
        self._left = [one for one in self._left if self._goes_on(one, seen.speed_mps(one.agent))]

    def is_busy(self, agent: str) -> bool:
        """Tell whether an agent has not done so yet: what nobody dates comes after it."""
        return any(one.agent == agent for one in self._left)

    @property
    def done(self) -> bool:
        """Whether everybody has done it for as long as asked."""
        return not self._left

    def _goes_on(self, one: _Doing, speed_mps: float | None) -> bool:
        if speed_mps is None:
            return False
        stands = one.kind in STANDING
        one.begun |= speed_mps > self._rules.start_mps
        if not one.begun:
            return True
        does = speed_mps < self._rules.stop_mps if stands else speed_mps > self._rules.start_mps
        if does:
            one.done_s += self._dt_s
            return one.done_s < one.need_s or one.ends
        if stands and speed_mps <= self._rules.start_mps:
            return True  # setting off
        done = one.done_s >= one.need_s
        one.done_s = 0.0
        return not done
