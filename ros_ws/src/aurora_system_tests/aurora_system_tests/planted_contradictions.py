# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""More executors with planted bugs: each does something else than a number in the request says.

Most tell truly what they do: only the request is not met. Those that begin too early believe in
their trigger, and those that send nothing believe that they did.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from aurora_core.comm.link import LinkSettings, MessageLink
from aurora_core.execution.events import EventRunner
from aurora_core.execution.observe import Observation
from aurora_core.mission.machine import MissionMachine
from aurora_core.mission.plan import UavPlan
from aurora_core.spec.parameter import Parameter, Provenance, Unit
from aurora_core.spec.scenario import (
    AgentAction,
    AltitudeTrigger,
    DistanceTrigger,
    Event,
    SendMessage,
)
from aurora_core.trace.commands import GroundCommand
from aurora_core.trace.layout import GroundCommandKind
from aurora_system_tests.planted_bugs import PLANTED
from aurora_system_tests.sabotage import (
    Sabotage,
    with_agents,
    with_links,
    with_machines,
    with_runner,
)

Machines = Sequence[MissionMachine]

_HASTE_S = 2.0
_DAWDLE_S = 3.0
_EARLY_TICK = 40
_CRAWL_MPS = 2.0
_WEAK = 0.5
_LAG_S = 0.5
_ASIDE_M = 60.0  # off the roof of any building: over it is over it
_REMAINING = 0.4
_SLOWER = 0.6
_SMALLER = 0.5
_NEARER = 0.5


def planted(name: str) -> Sabotage:
    """Return the sabotage of a planted bug of `planted_bugs` by its name."""
    return next(one.sabotage for one in PLANTED if one.name == name)


class _OtherDelays(EventRunner):
    """Waits longer or shorter than the request says, by `more_s`."""

    more_s = 0.0

    def __init__(self, *arguments: Any) -> None:
        super().__init__(*arguments)
        for state in self._states:
            state.event = self._waiting(state.event)

    def _waiting(self, event: Event) -> Event:
        wait_s = event.waits_s + self.more_s
        if self.more_s < 0.0 and event.delay_s is None:
            return event
        delay = Parameter(
            value=wait_s, unit=Unit.SECOND, low=0.0, high=1e4, provenance=Provenance.INFERRED
        )
        return Event.model_validate(dict(event) | {'delay_s': delay})


class _Hasty(_OtherDelays):
    more_s = -_HASTE_S


class _Dawdling(_OtherDelays):
    more_s = _DAWDLE_S


class _Jumpy(EventRunner):
    """Takes an altitude for reached, and a distance for small, long before."""

    def _begins(
        self, event: Event, tick: int, dt_s: float, seen: Observation, machines: Machines
    ) -> bool:
        if isinstance(event.trigger, AltitudeTrigger):
            return tick >= _EARLY_TICK
        if isinstance(event.trigger, DistanceTrigger):
            return all(m.first_capture_tick is not None for m in machines)
        return super()._begins(event, tick, dt_s, seen, machines)


class _Mute(EventRunner):
    """Tells of messages that it never hands to a link."""

    def _act(
        self, tick: int, event: Event, seen: Observation, machines: Machines
    ) -> list[GroundCommand]:
        if isinstance(event.action, SendMessage):
            return []
        return super()._act(tick, event, seen, machines)


class _HalfHearted(EventRunner):
    """Orders half of a change of speed, and a crawl where a standstill is asked for."""

    def _agent_commands(self, action: AgentAction, seen: Observation) -> list[GroundCommand]:
        now_mps = seen.speed_mps(action.agent) or 0.0

        def weaker(command: GroundCommand) -> GroundCommand:
            if command.kind is not GroundCommandKind.SET_SPEED:
                return command
            if action.do == 'stop':
                return replace(command, value=_CRAWL_MPS)
            return replace(command, value=now_mps + _WEAK * (command.value - now_mps))

        return [weaker(command) for command in super()._agent_commands(action, seen)]


class _Impatient(MessageLink):
    """Gives a message up when its first transmission is lost, and says so."""

    def __init__(self, settings: LinkSettings, *others: Any) -> None:
        super().__init__(replace(settings, retransmissions=0), *others)


class _Sluggish(MessageLink):
    """Takes longer than the link that was asked for."""

    def __init__(self, settings: LinkSettings, *others: Any) -> None:
        super().__init__(replace(settings, latency_s=settings.latency_s + _LAG_S), *others)


def _replanned(change: Callable[[Mapping[str, Any]], Mapping[str, Any]]) -> Sabotage:
    """Return the sabotage that changes the plan of every mission."""

    def plan(plan: UavPlan) -> UavPlan:
        document = plan.model_dump()
        document['missions'] = [{**m, **change(m)} for m in document['missions']]
        return UavPlan.model_validate(document)

    return with_machines(plan=plan)


def _shorter(mission: Mapping[str, Any]) -> Mapping[str, Any]:
    seconds = mission['duration_s']
    return {'duration_s': None if seconds is None else _REMAINING * seconds}


def _slower(mission: Mapping[str, Any]) -> Mapping[str, Any]:
    return {'speed_mps': _SLOWER * mission['speed_mps']}


def _smaller(mission: Mapping[str, Any]) -> Mapping[str, Any]:
    """Draw a route together along its first leg, the long side of a rectangle."""
    points = np.array(mission['waypoints'])
    along = points[1, :2] - points[0, :2]
    along = along / np.linalg.norm(along)
    centre = points[:-1, :2].mean(axis=0)
    off = (points[:, :2] - centre) @ along
    points[:, :2] -= ((1.0 - _SMALLER) * off)[:, None] * along
    return {'waypoints': tuple(tuple(point) for point in points.tolist())}


def _nearer(mission: Mapping[str, Any]) -> Mapping[str, Any]:
    return {
        'standoff_m': _NEARER * mission['standoff_m'],
        'offset_m': tuple(_NEARER * metres for metres in mission['offset_m']),
    }


def _aside(mission: Mapping[str, Any]) -> Mapping[str, Any]:
    point = mission['hover_point']
    if point is None:
        return {}
    return {'hover_point': (point[0] + _ASIDE_M, point[1], point[2])}


BRAKES_EARLY = with_runner(_Hasty)
ALERTS_LATE = with_runner(_Dawdling)
TRIGGERS_EARLY = with_runner(_Jumpy)
SENDS_NOTHING = with_runner(_Mute)
HALF_HEARTED = with_runner(_HalfHearted)
NEVER_AGAIN = with_links(_Impatient)
SLUGGISH_LINK = with_links(_Sluggish)
ENDS_EARLY = _replanned(_shorter)
FLIES_SLOWLY = _replanned(_slower)
SMALL_PATTERN = _replanned(_smaller)
TOO_NEAR = _replanned(_nearer)
HOVERS_ASIDE = _replanned(_aside)
DRIVES_PAST = with_agents(stop_lane_id='')
