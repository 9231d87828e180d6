# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Core values to message values and back; reading works on any object with the message's fields.

Topics and types of everything that is recorded stand in `TOPICS`.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from aurora_core.trace.commands import GroundCommand
from aurora_core.trace.definitions import MessageDefinitions
from aurora_core.trace.layout import GroundCommandKind
from aurora_core.trace.records import (
    EventRecord,
    LinkEventKind,
    LinkRecord,
    LossReason,
    ScenarioEventKind,
    SightRecord,
)
from aurora_core.trace.roster import Roster, RosterEntry

FloatArray = npt.NDArray[np.float64]

AGSG = '/aurora/agsg'
ROSTER = '/aurora/roster'
WORLD = '/aurora/world'
GROUND_STATE = '/aurora/ground/state'
UAV_STATE = '/aurora/uav/state'
GROUND_COMMAND = '/aurora/ground/command'
UAV_COMMAND = '/aurora/uav/command'
COMM = '/aurora/comm'
SENSING = '/aurora/sensing'
EVENTS = '/aurora/events'

TOPICS: dict[str, str] = {
    AGSG: 'aurora_msgs/msg/Agsg',
    ROSTER: 'aurora_msgs/msg/Roster',
    WORLD: 'aurora_msgs/msg/World',
    GROUND_STATE: 'aurora_msgs/msg/GroundState',
    UAV_STATE: 'aurora_msgs/msg/UavState',
    GROUND_COMMAND: 'aurora_msgs/msg/GroundCommand',
    UAV_COMMAND: 'aurora_msgs/msg/UavCommand',
    COMM: 'aurora_msgs/msg/LinkEvent',
    SENSING: 'aurora_msgs/msg/Visibility',
    EVENTS: 'aurora_msgs/msg/ScenarioEvent',
}

# Frame of everything in a recording.
FRAME_ID = 'map'


def time_ns(tick: int, dt_s: float) -> int:
    """Return the simulated time of a tick in nanoseconds."""
    return round(tick * dt_s * 1e9)


class MessageBuilder:
    """Builds message values of one run for the local engine's bag.

    Args:
        definitions: Layouts.
        run_number: Stamp of the run.
        dt_s: Time step.
    """

    def __init__(self, definitions: MessageDefinitions, run_number: int, dt_s: float) -> None:
        self._definitions = definitions
        self._run = run_number
        self._dt = dt_s

    def header(self, tick: int) -> Any:
        """Return a header stamped with the simulated time of a tick."""
        ns = time_ns(tick, self._dt)
        stamp = self._definitions.create(
            'builtin_interfaces/msg/Time', sec=ns // 1_000_000_000, nanosec=ns % 1_000_000_000
        )
        return self._definitions.create('std_msgs/msg/Header', stamp=stamp, frame_id=FRAME_ID)

    def state(self, topic: str, tick: int, rows: FloatArray) -> Any:
        """Return a GroundState, UavState or UavCommand from packed rows."""
        return self._definitions.create(
            TOPICS[topic],
            header=self.header(tick),
            run_number=self._run,
            tick=tick,
            data=np.ascontiguousarray(rows, dtype=np.float64).ravel(),
        )

    def ground_commands(self, tick: int, commands: tuple[GroundCommand, ...]) -> Any:
        """Return a GroundCommand for `tick`."""
        return self._definitions.create(
            TOPICS[GROUND_COMMAND],
            header=self.header(tick),
            run_number=self._run,
            tick=tick,
            agent=np.array([c.agent for c in commands], dtype=np.uint16),
            kind=np.array([int(c.kind) for c in commands], dtype=np.uint8),
            value=np.array([c.value for c in commands], dtype=np.float64),
            value2=np.array([c.value2 for c in commands], dtype=np.float64),
            text=[c.text for c in commands],
        )

    def link(self, r: LinkRecord) -> Any:
        """Return a LinkEvent."""
        return self._definitions.create(
            TOPICS[COMM],
            header=self.header(r.tick),
            run_number=self._run,
            tick=r.tick,
            sequence=r.sequence,
            message=r.message,
            link=r.link,
            event=r.event,
            sender=r.sender,
            receiver=r.receiver,
            kind=int(r.kind),
            attempt=r.attempt,
            reason=int(r.reason),
            distance_m=r.distance_m,
            line_of_sight=r.line_of_sight,
        )

    def sight(self, r: SightRecord) -> Any:
        """Return a Visibility."""
        return self._definitions.create(
            TOPICS[SENSING],
            header=self.header(r.tick),
            run_number=self._run,
            tick=r.tick,
            observer=r.observer,
            target=r.target,
            visible=r.visible,
            slant_range_m=r.slant_range_m,
        )

    def event(self, r: EventRecord) -> Any:
        """Return a ScenarioEvent."""
        return self._definitions.create(
            TOPICS[EVENTS],
            header=self.header(r.tick),
            run_number=self._run,
            tick=r.tick,
            sequence=r.sequence,
            kind=int(r.kind),
            subject=r.subject,
            detail=r.detail,
        )

    def roster(self, run_id: str, roster: Roster) -> Any:
        """Return a Roster."""
        return self._definitions.create(
            TOPICS[ROSTER],
            header=self.header(0),
            run_id=run_id,
            iteration=0,
            dt_s=roster.dt_s,
            agents=[self._entry(e) for e in roster.agents],
            uavs=[self._entry(e) for e in roster.uavs],
        )

    def _entry(self, entry: RosterEntry) -> Any:
        return self._definitions.create(
            'aurora_msgs/msg/RosterEntry',
            id=entry.body_id,
            type=entry.type_name,
            is_person=entry.is_person,
            system_id=entry.system_id,
            length_m=entry.length_m,
            width_m=entry.width_m,
            height_m=entry.height_m,
            route_edges=list(entry.route_edges),
            route_xy_m=np.array(entry.route_xy_m, dtype=np.float64).ravel(),
            role=entry.role,
        )


def read_roster(message: Any) -> Roster:
    """Return the roster of a Roster message."""
    return Roster(
        dt_s=float(message.dt_s),
        agents=tuple(_read_entry(e) for e in message.agents),
        uavs=tuple(_read_entry(e) for e in message.uavs),
    )


def _read_entry(message: Any) -> RosterEntry:
    xy = np.asarray(message.route_xy_m, dtype=np.float64).reshape(-1, 2).tolist()
    return RosterEntry(
        body_id=str(message.id),
        type_name=str(message.type),
        is_person=bool(message.is_person),
        system_id=int(message.system_id),
        length_m=float(message.length_m),
        width_m=float(message.width_m),
        height_m=float(message.height_m),
        route_edges=tuple(str(e) for e in message.route_edges),
        route_xy_m=tuple((x, y) for x, y in xy),
        role=str(message.role),
    )


def read_rows(message: Any, width: int) -> FloatArray:
    """Return the packed rows (N, width) of a state or UavCommand message."""
    return np.asarray(message.data, dtype=np.float64).reshape(-1, width)


def read_ground_commands(message: Any) -> tuple[GroundCommand, ...]:
    """Return the commands of a GroundCommand message."""
    return tuple(
        GroundCommand(
            agent=int(agent),
            kind=GroundCommandKind(int(kind)),
            value=float(value),
            value2=float(value2),
            text=str(text),
        )
        for agent, kind, value, value2, text in zip(
            message.agent, message.kind, message.value, message.value2, message.text, strict=True
        )
    )


def read_link(message: Any) -> LinkRecord:
    """Return the ledger entry of a LinkEvent message."""
    return LinkRecord(
        tick=int(message.tick),
        sequence=int(message.sequence),
        message=int(message.message),
        link=str(message.link),
        event=str(message.event),
        sender=str(message.sender),
        receiver=str(message.receiver),
        kind=LinkEventKind(int(message.kind)),
        attempt=int(message.attempt),
        reason=LossReason(int(message.reason)),
        distance_m=float(message.distance_m),
        line_of_sight=bool(message.line_of_sight),
    )


def read_sight(message: Any) -> SightRecord:
    """Return the sight claim of a Visibility message."""
    return SightRecord(
        tick=int(message.tick),
        observer=str(message.observer),
        target=str(message.target),
        visible=bool(message.visible),
        slant_range_m=float(message.slant_range_m),
    )


def read_event(message: Any) -> EventRecord:
    """Return the record of a ScenarioEvent message."""
    return EventRecord(
        tick=int(message.tick),
        sequence=int(message.sequence),
        kind=ScenarioEventKind(int(message.kind)),
        subject=str(message.subject),
        detail=str(message.detail),
    )
