# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Refuse targets that drive faster than UAVs can stay near.

A target may pass: at its stated speed less the greatest of a UAV it crosses the ring in which it
counts as tracked, and is out of it too soon. It drives with its stated speed for a share of the
time, and is tracked for a share: both together for what is left of the two.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

from aurora_core.feasibility.certificates import beyond
from aurora_core.feasibility.facts import limit_facts, says, tolerance_facts
from aurora_core.feasibility.operands import SLOWING, in_parts, upward, whole
from aurora_core.knowledge.limits import Limits, Tolerances
from aurora_core.outcomes.feasibility import Certificate, Fact, Rule
from aurora_core.spec.parameter import Parameter
from aurora_core.spec.quantity import QuantityName
from aurora_core.spec.scenario import GroundAgent, ScenarioSpec, UavMission
from aurora_core.spec.stated import is_stated, least, most
from aurora_core.spec.vocabulary import MissionMode


def check_pursuit(
    spec: ScenarioSpec, limits: Limits, tolerances: Tolerances
) -> Iterator[Certificate]:
    """Return tracked targets that are asked to drive away from whoever tracks them."""
    top = limits.uav_speed_max_mps
    fastest = top * (1.0 + tolerances.limit_margin)
    for mission in spec.missions:
        agent = next((a for a in spec.agents if a.id == mission.target), None)
        if mission.mode is not MissionMode.TRACK or agent is None:
            continue
        if in_parts(spec, {mission.uav, agent.id}):
            continue
        tracked = min(
            (c.value.value for c in spec.conditions
             if c.quantity == QuantityName.TRACKED_FRACTION and mission.uav in c.of),
            default=tolerances.tracked_fraction,
        )  # fmt: skip
        tracked = min(tracked, tolerances.tracked_fraction)
        for path, speed, low, share, facts in _speeds(spec, agent, tolerances):
            both_s = (tracked + share - 1.0) * _phase_s(mission, tolerances)
            away_m = (low - fastest) * both_s
            ring_m = _ring_m(mission, limits, tolerances)
            if both_s <= 0.0 or away_m <= ring_m:
                continue
            yield beyond(
                Rule.PURSUIT,
                'speed_limit',
                speed,
                f'missions/{mission.id}/target',
                ('uav_speed_max_mps', top),
                f'{agent.id} drives at {speed.value:g} m/s; {mission.uav} flies at most {top:g} '
                f'm/s: in {both_s:.0f} s it falls {away_m:.0f} m behind, and stays near for '
                f'{ring_m:.0f} m at most.',
                (
                    *says(path, speed),
                    *facts,
                    *says(f'missions/{mission.id}/duration_s', mission.duration_s),
                    *says(f'missions/{mission.id}/standoff_m', mission.standoff_m),
                    *limit_facts(limits, 'uav_speed_max_mps', 'tracking_horizontal_m'),
                    *tolerance_facts(tolerances, 'tracked_fraction', 'limit_margin'),
                ),
            )
            break


_Speed = tuple[str, Parameter, float, float, tuple[Fact, ...]]


def _speeds(spec: ScenarioSpec, agent: GroundAgent, tolerances: Tolerances) -> Iterator[_Speed]:
    """Yield stated speeds: where, the number, the least that meets it, for which share."""
    if not any(b.kind in SLOWING for b in agent.behaviors):
        for k, behavior in enumerate(agent.behaviors):
            speed = behavior.speed_mps
            if speed is not None and is_stated(speed):
                slack = tolerances.route_speed_mps.of(speed.value, approximate=speed.approximate)
                path = f'agents/{agent.id}/behaviors/{k}/speed_mps'
                facts = tolerance_facts(tolerances, 'route_speed_mps', 'route_speed_share')
                low = least(speed, slack, 0.0)
                yield path, speed, low, tolerances.route_speed_share, facts
    for condition in spec.conditions:
        fast = condition.quantity == QuantityName.SPEED and condition.of == (agent.id,)
        if fast and condition.op != '==' and upward(condition) and whole(condition):
            base = f'conditions/{condition.id}'
            facts = says(f'{base}/op', condition.op)
            yield f'{base}/value', condition.value, condition.value.value, 1.0, facts


def _phase_s(mission: UavMission, tolerances: Tolerances) -> float:
    """Return how long the phase lasts at least; what nobody states may be at its domain's end."""
    duration = mission.duration_s
    if duration is None or not is_stated(duration):
        return 0.0 if duration is None else duration.low
    slack = tolerances.duration_s.of(duration.value, approximate=duration.approximate)
    return least(duration, slack, 0.0)


def _ring_m(mission: UavMission, limits: Limits, tolerances: Tolerances) -> float:
    """Return the longest straight way inside the ring in which a target counts as tracked."""
    standoff, slack = mission.standoff_m, limits.tracking_horizontal_m
    inner, outer = 0.0, slack
    if standoff is not None and is_stated(standoff):
        slack = tolerances.standoff_m.of(standoff.value, approximate=standoff.approximate)
        inner = least(standoff, slack, 0.0)
        outer = most(standoff, slack, limits.uav_standoff_max_m + slack)
    elif standoff is not None:
        inner, outer = max(0.0, standoff.value - slack), standoff.value + slack
    # A standoff beyond the limit leaves no ring; the limit itself tells of that.
    return 2.0 * math.sqrt(max(0.0, outer * outer - inner * inner))
