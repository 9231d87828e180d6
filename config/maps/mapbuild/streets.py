# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Describe a street plan: nodes, street types, named streets and what stands along them.

All coordinates are ENU metres in the map frame. The values here are data; `plain_xml` writes them.
"""

from __future__ import annotations

from dataclasses import dataclass, field

Point = tuple[float, float]


@dataclass(frozen=True, slots=True, kw_only=True)
class Node:
    """A junction or a bend.

    Args:
        x_m: East, metres.
        y_m: North, metres.
        kind: SUMO node type: priority, traffic_light, allway_stop.
        radius_m: Corner radius, metres. With netconvert's own 1.5 m, turning cars cut the corner
            where walkers step onto a crossing.
    """

    x_m: float
    y_m: float
    kind: str = 'priority'
    radius_m: float = 4.0


@dataclass(frozen=True, slots=True, kw_only=True)
class StreetType:
    """A cross section; lanes are counted per direction, from the right kerb.

    Args:
        lanes: Traffic lanes per direction.
        speed_mps: Speed limit.
        priority: SUMO priority, larger goes first.
        lane_width_m: Width of one traffic lane.
        sidewalk_m: Sidewalk width, 0 for none.
        bike_m: Bike lane width, 0 for none.
        parking_m: Width of a kerbside strip that no vehicle class may drive on, 0 for none.
        setback_m: Distance from the back of the sidewalk to the building line.
    """

    lanes: int
    speed_mps: float
    priority: int
    lane_width_m: float
    sidewalk_m: float
    setback_m: float
    bike_m: float = 0.0
    parking_m: float = 0.0


@dataclass(frozen=True, slots=True, kw_only=True)
class Street:
    """A named street through a chain of nodes.

    Args:
        name: Name as people say it.
        kind: Key of the street type.
        nodes: Node names in order; each consecutive pair is one block of street.
        oneway: Only in the order of `nodes`.
        kinds: Other street type for the block that starts at the given index.
        curves: Inner shape points for the block that starts at the given index.
        spread: SUMO spreadType of its edges.
        first_block: Number of its first block; above 1 where a circle cuts the street in two.
    """

    name: str
    kind: str
    nodes: tuple[str, ...]
    oneway: bool = False
    kinds: dict[int, str] = field(default_factory=dict)
    curves: dict[int, tuple[Point, ...]] = field(default_factory=dict)
    spread: str = 'right'
    first_block: int = 1


@dataclass(frozen=True, slots=True, kw_only=True)
class Zebra:
    """A mid-block crossing with right of way for walkers, at a node of its own."""

    node: str
    width_m: float = 4.0


@dataclass(frozen=True, slots=True, kw_only=True)
class KerbPlace:
    """A bus stop or a row of parking places on the right side of a block of street.

    Args:
        id: Identifier in the stops file.
        name: Name as people say it.
        from_node: Node at which the block starts (direction of travel).
        to_node: Node at which it ends.
        start_m: Start along the lane, metres; negative counts from the end.
        length_m: Length along the lane, metres.
        places: Parking places; 0 makes it a bus stop.
    """

    id: str
    name: str
    from_node: str
    to_node: str
    start_m: float
    length_m: float
    places: int = 0


@dataclass(frozen=True, slots=True, kw_only=True)
class StreetPlan:
    """Everything netconvert and the stops file need."""

    nodes: dict[str, Node]
    types: dict[str, StreetType]
    streets: tuple[Street, ...]
    zebras: tuple[Zebra, ...] = ()
    roundabouts: tuple[tuple[str, ...], ...] = ()
    forbidden_turns: tuple[tuple[tuple[str, str], tuple[str, str]], ...] = ()
    kerb_places: tuple[KerbPlace, ...] = ()


@dataclass(frozen=True, slots=True, kw_only=True)
class PlanEdge:
    """One direction of one block of street."""

    id: str
    from_node: str
    to_node: str
    kind: str
    name: str
    spread: str
    shape: tuple[Point, ...]


def plan_edges(plan: StreetPlan) -> tuple[PlanEdge, ...]:
    """Cut every street into one edge per block and direction, with readable ids."""
    edges: list[PlanEdge] = []
    for street in plan.streets:
        slug = street.name.lower().replace("'", '').replace(' ', '_')
        for i, (a, b) in enumerate(zip(street.nodes[:-1], street.nodes[1:], strict=True)):
            kind = street.kinds.get(i, street.kind)
            inner = street.curves.get(i, ())
            ahead, back = _bounds(plan, a, b)
            number = i + street.first_block
            common = {'kind': kind, 'name': street.name, 'spread': street.spread}
            edges.append(
                PlanEdge(
                    id=f'{slug}_{number}_{ahead}', from_node=a, to_node=b, shape=inner, **common
                )
            )
            if not street.oneway:
                edges.append(
                    PlanEdge(
                        id=f'{slug}_{number}_{back}',
                        from_node=b,
                        to_node=a,
                        shape=tuple(reversed(inner)),
                        **common,
                    )
                )
    return tuple(edges)


def _bounds(plan: StreetPlan, a: str, b: str) -> tuple[str, str]:
    """Return the compass words (eb, wb, nb, sb) of a block and of its opposite."""
    dx = plan.nodes[b].x_m - plan.nodes[a].x_m
    dy = plan.nodes[b].y_m - plan.nodes[a].y_m
    if abs(dx) >= abs(dy):
        return ('eb', 'wb') if dx > 0 else ('wb', 'eb')
    return ('nb', 'sb') if dy > 0 else ('sb', 'nb')


def edge_between(edges: tuple[PlanEdge, ...], a: str, b: str) -> PlanEdge:
    """Return the edge from node a to node b.

    Raises:
        KeyError: When the plan has none.
    """
    for edge in edges:
        if edge.from_node == a and edge.to_node == b:
            return edge
    raise KeyError(f'the plan has no edge from {a} to {b}')
