# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Values of a road network. Positions are ENU map metres; lane index 0 is at the right kerb."""

from __future__ import annotations

from dataclasses import dataclass, field

from aurora_core.geometry.polyline import Polyline

Point = tuple[float, float]
Points = tuple[Point, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class Lane:
    """One lane; index 0 is often the sidewalk, so always choose by `allows`.

    Args:
        id: Lane id, `<edge id>_<index>`.
        edge_id: Edge that it belongs to.
        index: Count from the right kerb.
        polyline: Centre line in driving direction, at least two points, no repeated ones.
        line: The same, measured.
        length_m: Length by which the simulator counts positions; it may differ from the arc length
            on curves, where all lanes of an edge share one length.
        speed_limit_mps: Speed limit.
        width_m: Width.
        allows: Vehicle classes that may use it; empty on a parking strip.
        is_internal: Inside a junction.
        right_lane_id: Neighbour towards the right kerb on the same edge.
        left_lane_id: Neighbour to the left on the same edge.
    """

    id: str
    edge_id: str
    index: int
    polyline: Points
    line: Polyline = field(compare=False, repr=False)
    length_m: float
    speed_limit_mps: float
    width_m: float
    allows: frozenset[str]
    is_internal: bool
    right_lane_id: str | None
    left_lane_id: str | None

    @property
    def arc_length_m(self) -> float:
        """Length of the centre line, metres."""
        return self.line.length_m


@dataclass(frozen=True, slots=True, kw_only=True)
class Edge:
    """One direction of one block of street (or, internal, a path through a junction)."""

    id: str
    street_name: str
    from_junction: str
    to_junction: str
    lane_ids: tuple[str, ...]
    length_m: float
    priority: int
    is_internal: bool


@dataclass(frozen=True, slots=True, kw_only=True)
class Junction:
    """A junction; `kind` is SUMO's type (traffic_light, priority, allway_stop, dead_end, …)."""

    id: str
    kind: str
    x_m: float
    y_m: float
    has_signal: bool
    shape: Points


@dataclass(frozen=True, slots=True, kw_only=True)
class Crossing:
    """A pedestrian crossing.

    Args:
        id: Id of its internal edge.
        junction_id: Junction that it is part of.
        edge_ids: Road edges that it crosses.
        centre_line: Walking line from kerb to kerb.
        width_m: Width across the walking line.
        polygon: Marked area.
        has_signal: Controlled by the junction's signal.
        has_priority: Walkers go first when there is no signal (zebra).
    """

    id: str
    junction_id: str
    edge_ids: tuple[str, ...]
    centre_line: Points
    width_m: float
    polygon: Points
    has_signal: bool
    has_priority: bool


@dataclass(frozen=True, slots=True, kw_only=True)
class Connection:
    """A permitted move between lanes.

    Args:
        from_lane_id: Lane that ends at the junction.
        to_lane_id: Lane that starts there.
        via_lane_ids: Lanes inside the junction in driving order (two where a left turn may wait).
        direction: s straight, l left, r right, L and R partly so, t turnaround.
        signal_id: Traffic light that controls it, if any.
        signal_index: Place in that light's state string, -1 without a light.
    """

    from_lane_id: str
    to_lane_id: str
    via_lane_ids: tuple[str, ...]
    direction: str
    signal_id: str | None
    signal_index: int


@dataclass(frozen=True, slots=True, kw_only=True)
class NetworkData:
    """Everything read from a network file, each kind sorted by id."""

    lanes: tuple[Lane, ...]
    edges: tuple[Edge, ...]
    junctions: tuple[Junction, ...]
    crossings: tuple[Crossing, ...]
    walking_areas: tuple[Points, ...]
    connections: tuple[Connection, ...]
    projection: str
