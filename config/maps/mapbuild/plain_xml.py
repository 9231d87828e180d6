# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Write a street plan as SUMO plain XML and as a stops file."""

from __future__ import annotations

import math
from pathlib import Path
from xml.sax.saxutils import quoteattr

from mapbuild.streets import KerbPlace, PlanEdge, StreetPlan, StreetType, edge_between, plan_edges


def write_plain(plan: StreetPlan, folder: Path, stem: str, location: str) -> dict[str, Path]:
    """Write nodes, edges, types and connections.

    Args:
        plan: Street plan.
        folder: Existing folder for the files.
        stem: File name stem.
        location: The `<location .../>` element that pins frame and projection.

    Returns:
        File path per netconvert option name.
    """
    edges = plan_edges(plan)
    texts = {
        'node-files': ('nod', _nodes(plan, location)),
        'edge-files': ('edg', _edges(plan, edges)),
        'type-files': ('typ', _types(plan)),
        'connection-files': ('con', _connections(plan, edges)),
    }
    paths: dict[str, Path] = {}
    for option, (suffix, text) in texts.items():
        path = folder / f'{stem}.{suffix}.xml'
        path.write_text(text, encoding='utf-8')
        paths[option] = path
    return paths


def _element(tag: str, **attributes: object) -> str:
    inner = ' '.join(f'{k.rstrip("_")}={quoteattr(str(v))}' for k, v in attributes.items())
    return f'<{tag} {inner}/>'


def _document(root: str, lines: list[str]) -> str:
    return '\n'.join([f'<{root}>', *(f'  {line}' for line in lines), f'</{root}>', ''])


def _nodes(plan: StreetPlan, location: str) -> str:
    lines = [location]
    for name, node in plan.nodes.items():
        attributes: dict[str, object] = {
            'id': name,
            'x': f'{node.x_m:.2f}',
            'y': f'{node.y_m:.2f}',
            'type': node.kind,
            'radius': node.radius_m,
        }
        lines.append(_element('node', **attributes))
    return _document('nodes', lines)


def _edges(plan: StreetPlan, edges: tuple[PlanEdge, ...]) -> str:
    lines = []
    for edge in edges:
        attributes: dict[str, object] = {
            'id': edge.id,
            'from_': edge.from_node,
            'to': edge.to_node,
            'type': edge.kind,
            'name': edge.name,
            'spreadType': edge.spread,
        }
        if edge.shape:
            ends = [plan.nodes[edge.from_node], plan.nodes[edge.to_node]]
            points = [
                (ends[0].x_m, ends[0].y_m),
                *edge.shape,
                (ends[1].x_m, ends[1].y_m),
            ]
            attributes['shape'] = ' '.join(f'{x:.2f},{y:.2f}' for x, y in points)
        kind = plan.types[edge.kind]
        if kind.parking_m > 0.0:
            lines.append(_element('edge', **attributes)[:-2] + '>')
            lines.extend(_parking_lanes(kind))
            lines.append('</edge>')
        else:
            lines.append(_element('edge', **attributes))
    for ring in plan.roundabouts:
        pairs = zip(ring, (*ring[1:], ring[0]), strict=True)
        ids = ' '.join(edge_between(edges, a, b).id for a, b in pairs)
        lines.append(_element('roundabout', nodes=' '.join(ring), edges=ids))
    return _document('edges', lines)


def _parking_lanes(kind: StreetType) -> list[str]:
    """Spell out the lanes of an edge with a parking strip (lane 1, closed to all classes).

    A strip that no class may use keeps its width in the network, so that a vehicle placed on it
    stands clear of both the traffic lane and the sidewalk.
    """
    lanes = [
        _element('lane', index=0, allow='pedestrian', width=kind.sidewalk_m),
        _element('lane', index=1, disallow='all', width=kind.parking_m),
    ]
    for i in range(kind.lanes):
        lanes.append(_element('lane', index=2 + i, disallow='pedestrian', width=kind.lane_width_m))
    return [f'  {lane}' for lane in lanes]


def _types(plan: StreetPlan) -> str:
    lines = []
    for name, kind in plan.types.items():
        attributes: dict[str, object] = {
            'id': name,
            'numLanes': kind.lanes,
            'speed': kind.speed_mps,
            'priority': kind.priority,
            'width': kind.lane_width_m,
        }
        if kind.parking_m > 0.0:
            attributes['numLanes'] = kind.lanes + 2
        else:
            if kind.sidewalk_m > 0.0:
                attributes['sidewalkWidth'] = kind.sidewalk_m
            if kind.bike_m > 0.0:
                attributes['bikeLaneWidth'] = kind.bike_m
        lines.append(_element('type', **attributes))
    return _document('types', lines)


def _connections(plan: StreetPlan, edges: tuple[PlanEdge, ...]) -> str:
    lines = []
    for (a, b), (c, d) in plan.forbidden_turns:
        from_id, to_id = edge_between(edges, a, b).id, edge_between(edges, c, d).id
        lines.append(_element('delete', from_=from_id, to=to_id))
    for zebra in plan.zebras:
        ids = _one_road_at(edges, zebra.node)
        lines.append(
            _element(
                'crossing',
                node=zebra.node,
                edges=' '.join(ids),
                priority='true',
                width=zebra.width_m,
            )
        )
    return _document('connections', lines)


def _one_road_at(edges: tuple[PlanEdge, ...], node: str) -> list[str]:
    """Return the edges of one arm of a mid-block node: one in, one out, same neighbour."""
    inbound = next(e for e in edges if e.to_node == node)
    outbound = [e.id for e in edges if e.from_node == node and e.to_node == inbound.from_node]
    return [inbound.id, *outbound]


def write_stops(plan: StreetPlan, path: Path, lane_lengths_m: dict[str, float]) -> None:
    """Write bus stops and parking areas as a SUMO additional file.

    Args:
        plan: Street plan.
        path: File to write.
        lane_lengths_m: Length of each lane of the built network.

    Raises:
        ValueError: When a place does not fit its lane.
    """
    edges = plan_edges(plan)
    lines = []
    for place in sorted(plan.kerb_places, key=lambda p: p.id):
        edge = edge_between(edges, place.from_node, place.to_node)
        kind = plan.types[edge.kind]
        index = int(kind.sidewalk_m > 0.0) + int(kind.bike_m > 0.0) + int(kind.parking_m > 0.0)
        lane = f'{edge.id}_{index}'
        start, end = _span(place, lane_lengths_m[lane])
        common: dict[str, object] = {
            'id': place.id,
            'name': place.name,
            'lane': lane,
            'startPos': f'{start:.2f}',
            'endPos': f'{end:.2f}',
        }
        if place.places:
            lines.append(
                _element(
                    'parkingArea',
                    **common,
                    roadsideCapacity=place.places,
                    width=kind.parking_m,
                    length=f'{place.length_m / place.places:.2f}',
                )
            )
        else:
            lines.append(_element('busStop', **common))
    path.write_text(_document('additional', lines), encoding='utf-8')


def _span(place: KerbPlace, lane_length_m: float) -> tuple[float, float]:
    start = place.start_m if place.start_m >= 0.0 else lane_length_m + place.start_m
    end = start + place.length_m
    if start < 0.0 or end > lane_length_m or not math.isfinite(end):
        raise ValueError(
            f'{place.id}: {start:.1f} to {end:.1f} m does not fit a lane of {lane_length_m:.1f} m'
        )
    return start, end
