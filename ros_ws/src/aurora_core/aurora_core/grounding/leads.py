# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""How far a target is on its way when the UAV that tracks it is up: it starts ahead of it."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from aurora_core.grounding.convoy import SceneSplit
from aurora_core.grounding.pace import watched_speed_mps
from aurora_core.grounding.releases import Release, convoy_release, own_release
from aurora_core.knowledge.agent_types import AgentTypeRecord
from aurora_core.knowledge.limits import LEVELS_OFF_S, Limits
from aurora_core.knowledge.settings import Settings
from aurora_core.quantities.actions import FROM_MOTION
from aurora_core.spec.doing import dated_s
from aurora_core.spec.events import AgentAction
from aurora_core.spec.flight_order import begun_by
from aurora_core.spec.parking import stands
from aurora_core.spec.scenario import GroundAgent, ScenarioSpec, UavMission
from aurora_core.spec.vocabulary import AgentType, MissionMode


def leads_m(
    spec: ScenarioSpec,
    split: SceneSplit,
    types: Mapping[str, AgentTypeRecord],
    limits: Limits,
    settings: Settings,
) -> Mapping[str, float]:
    """Return how far the first target of a UAV has gone when the UAV is up, by UAV (m).

    That is so of a target that others have tracked before it, and of one that sets off with the
    run because of what happens to it at a stated time.

    Args:
        spec: The request.
        split: Its vehicles by how they are seated.
        types: How fast they get faster.
        limits: Limits in force.
        settings: How fast UAVs climb and targets drive.
    """
    return {
        uav.id: _lead_m(spec, split, first, types, limits, settings)
        for uav in spec.uavs
        if (first := next((m for m in spec.missions if m.uav == uav.id), None)) is not None
        and first.mode is MissionMode.TRACK
    }


def _lead_m(
    spec: ScenarioSpec,
    split: SceneSplit,
    mission: UavMission,
    types: Mapping[str, AgentTypeRecord],
    limits: Limits,
    settings: Settings,
) -> float:
    speed_mps = watched_speed_mps(spec, mission, limits, settings.grounding)
    if begun_by(spec, mission) is not None:
        return speed_mps * sum(
            m.duration_s.value
            for m in spec.missions
            if m.target == mission.target and m.uav != mission.uav and m.duration_s is not None
        )
    target = next((m.agent for m in split.convoy if m.agent.id == mission.target), None)
    if target is None or not _sets_off_at_once(spec, split, target):
        return 0.0
    record = types[target.type.value]
    up_s = mission.altitude_m.value / settings.flight.climb_mps + LEVELS_OFF_S
    stops_s = min(_slowed_at_s(spec, target), default=up_s)
    driven_s = min(up_s, stops_s)
    gaining_s = min(driven_s, speed_mps / record.accel_mps2)
    reached_mps = gaining_s * record.accel_mps2
    way_m = 0.5 * reached_mps * gaining_s + speed_mps * (driven_s - gaining_s)
    # Until it stands, or until the UAV that it comes up to is as fast.
    until_mps2 = record.decel_mps2 if stops_s < up_s else settings.flight.acceleration_mps2
    return way_m + reached_mps * reached_mps / (2.0 * until_mps2)


def _sets_off_at_once(spec: ScenarioSpec, split: SceneSplit, target: GroundAgent) -> bool:
    """Tell whether a target drives from t = 0 on."""
    drives = target.type is not AgentType.PEDESTRIAN and not stands(target)
    return drives and own_release(spec, target, convoy_release(spec, split)) == Release()


def _slowed_at_s(spec: ScenarioSpec, target: GroundAgent) -> Iterator[float]:
    """Yield the stated times at which a target has to brake or stop, s."""
    for event in spec.events:
        action, at_s = event.action, dated_s(spec, event)
        if not isinstance(action, AgentAction) or at_s is None:
            continue
        if action.agent == target.id and action.do in FROM_MOTION:
            yield at_s
