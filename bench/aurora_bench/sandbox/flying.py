# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What a program tells its UAVs, as rows of commands; each holds until another one is given."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from aurora_bench.sandbox.requests import FlyTo, Land, Phase, SceneRefusal, TakeOff
from aurora_core.trace.layout import UAV_COMMAND_WIDTH, UavCommandColumn, UavMode, UavPhase
from aurora_core.trace.records import ScenarioEventKind
from aurora_core.trace.roster import Roster
from aurora_core.trace.trace import FloatArray

_X, _YAW = int(UavCommandColumn.X), int(UavCommandColumn.YAW)


class Flying:
    """The commands of one run.

    Args:
        roster: Rows of the UAVs.
    """

    def __init__(self, roster: Roster) -> None:
        self._roster = roster
        self._rows = np.zeros((len(roster.uavs), UAV_COMMAND_WIDTH))
        self._told = self._rows[:, UavCommandColumn.PHASE].copy()

    def take(self, asked: TakeOff | FlyTo | Land | Phase) -> None:
        """Take a command for the next tick.

        Raises:
            SceneRefusal: There is no such UAV, or it is not in the air.
        """
        index = self._roster.uav_index(asked.name)
        if index is None:
            raise SceneRefusal(f'there is no UAV {asked.name!r}')
        row = self._rows[index]
        match asked:
            case TakeOff():
                row[UavCommandColumn.MODE] = UavMode.TAKEOFF
                row[UavCommandColumn.TAKEOFF_ALTITUDE] = asked.altitude_m
                row[UavCommandColumn.PHASE] = UavPhase.ASCENT
            case FlyTo():
                if row[UavCommandColumn.MODE] in (UavMode.IDLE, UavMode.LAND):
                    raise SceneRefusal(f'{asked.name}: take off first')
                row[UavCommandColumn.MODE] = UavMode.OFFBOARD
                row[_X : _YAW + 1] = (
                    asked.x_m, asked.y_m, asked.z_m, *asked.velocity_mps, asked.yaw_rad,
                )  # fmt: skip
            case Land():
                if row[UavCommandColumn.MODE] == UavMode.IDLE:
                    raise SceneRefusal(f'{asked.name}: it is on the ground')
                row[UavCommandColumn.MODE] = UavMode.LAND
                row[UavCommandColumn.PHASE] = UavPhase.LANDING
            case Phase():
                mission = asked.mission
                row[UavCommandColumn.PHASE] = (
                    UavPhase.HOLDING if mission is None else UavPhase.MISSION + mission
                )

    def commands(self) -> FloatArray:
        """Return (M, UAV_COMMAND_WIDTH) for the next tick."""
        return self._rows.copy()

    def events(self) -> Iterator[tuple[ScenarioEventKind, str, str]]:
        """Yield the phases that begin with the next tick: kind, UAV, name."""
        phases = self._rows[:, UavCommandColumn.PHASE]
        for index in np.flatnonzero(phases != self._told).tolist():
            number = int(phases[index])
            known = {int(p): p.name.lower() for p in UavPhase if p is not UavPhase.MISSION}
            name = known.get(number, f'mission {number - UavPhase.MISSION}')
            yield ScenarioEventKind.PHASE, self._roster.uavs[index].body_id, name
        self._told = phases.copy()
