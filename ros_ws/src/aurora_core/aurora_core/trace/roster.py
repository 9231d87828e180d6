# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Who takes part in a run; the index in the tuples is the row in the packed arrays."""

from __future__ import annotations

from dataclasses import dataclass, field

from aurora_core.spec.vocabulary import AgentType


@dataclass(frozen=True, slots=True, kw_only=True)
class RosterEntry:
    """One body.

    Attributes:
        body_id: Id of the specification.
        type_name: Vocabulary type (`car`, ...) or `uav`.
        is_person: Pedestrian.
        system_id: MAVLink system id of a UAV, else 0.
        length_m: Box along the heading.
        width_m: Box across.
        height_m: Box height.
        route_edges: Planned edges (ground agents).
        route_xy_m: Planned path of the reference point, ENU map frame.
        role: ego, target, background, other.
    """

    body_id: str
    type_name: str
    is_person: bool
    system_id: int
    length_m: float
    width_m: float
    height_m: float
    route_edges: tuple[str, ...] = ()
    route_xy_m: tuple[tuple[float, float], ...] = ()
    role: str = 'other'

    @property
    def has_driver(self) -> bool:
        """Whether somebody drives it, who looks ahead: else it walks, flies or is fixed."""
        return not self.is_person and self.system_id == 0 and self.type_name != AgentType.RSU


@dataclass(frozen=True, slots=True, kw_only=True)
class Roster:
    """All bodies of a run in row order.

    Attributes:
        dt_s: Time step of the lockstep.
        agents: Ground agents, rows of the ground arrays.
        uavs: UAVs, rows of the UAV arrays.
    """

    dt_s: float
    agents: tuple[RosterEntry, ...]
    uavs: tuple[RosterEntry, ...]

    _agent_rows: dict[str, int] = field(init=False, repr=False, compare=False)
    _uav_rows: dict[str, int] = field(init=False, repr=False, compare=False)

    def __post_init__(self) -> None:
        """Index the bodies: rows are asked for every tick."""
        object.__setattr__(self, '_agent_rows', _rows(self.agents))
        object.__setattr__(self, '_uav_rows', _rows(self.uavs))

    def agent_index(self, body_id: str) -> int | None:
        """Return the row of a ground agent, or None when the id is not one."""
        return self._agent_rows.get(body_id)

    def uav_index(self, body_id: str) -> int | None:
        """Return the row of a UAV, or None when the id is not one."""
        return self._uav_rows.get(body_id)


def _rows(entries: tuple[RosterEntry, ...]) -> dict[str, int]:
    """Return the row of each body id, the first one of equal ids."""
    return {entry.body_id: row for row, entry in reversed(tuple(enumerate(entries)))}
