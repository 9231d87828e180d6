# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Fill the blocks between streets with buildings, from a seed, without touching any street."""

from __future__ import annotations

import math
import random
from collections.abc import Iterator
from dataclasses import dataclass

import shapely
import shapely.ops

from aurora_core.knowledge.road_network import RoadNetwork
from mapbuild.streets import StreetPlan, edge_between, plan_edges

GRID_M = 0.1
_MIN_SIDE_M = 6.0
_DEFAULT_SETBACK_M = 0.6
_SPLINTER_M = 1.0


@dataclass(frozen=True, slots=True, kw_only=True)
class Style:
    """How a block is built up.

    Args:
        kind: Kind written to each building.
        lot_m2: Lots are split until they are about this large.
        gap_m: Free width between neighbours; 0 attaches them.
        depth_m: Buildings stand within this distance of the building line along the streets; what
            lies farther back is courtyard.
        height_m: Lowest and highest.
        filled: Share of the lots that are built on.
    """

    kind: str
    lot_m2: float
    gap_m: float
    depth_m: float
    height_m: tuple[float, float]
    filled: float = 1.0


@dataclass(frozen=True, slots=True, kw_only=True)
class District:
    """An area and its style; None leaves it open. Where areas overlap, the first one counts."""

    area: shapely.Polygon
    style: Style | None


@dataclass(frozen=True, slots=True, kw_only=True)
class Special:
    """A building that is placed by hand, with free ground around it."""

    id: str
    name: str
    kind: str
    shape: shapely.Polygon
    height_m: float
    clearance_m: float


@dataclass(frozen=True, slots=True, kw_only=True)
class Built:
    """A finished building."""

    id: str
    name: str
    kind: str
    shape: shapely.Polygon
    height_m: float


def build_up(
    plan: StreetPlan,
    network: RoadNetwork,
    extent_m: tuple[float, float, float, float],
    districts: tuple[District, ...],
    specials: tuple[Special, ...],
    seed: int,
) -> tuple[Built, ...]:
    """Return all buildings of a map.

    Args:
        plan: Street plan, for the setbacks.
        network: The built network, for the surfaces.
        extent_m: West, south, east, north of the map.
        districts: Areas and styles, most special first.
        specials: Buildings placed by hand.
        seed: Seed of the lots and heights.

    Raises:
        ValueError: When a special building touches a street.
    """
    keep_clear = _keep_clear(plan, network)
    built = [_special(special, network) for special in specials]
    taken = shapely.union_all(
        [s.shape.buffer(s.clearance_m, join_style='mitre') for s in specials]
    )
    ground = shapely.box(*extent_m).buffer(-4.0, join_style='mitre').difference(keep_clear)
    number = 0
    for block, style in _blocks(ground, districts):
        west, south, _, _ = block.bounds
        rng = random.Random(f'{seed}:{west:.0f}:{south:.0f}')
        frontage = keep_clear.buffer(style.depth_m, quad_segs=2)
        for shape in _fill(block, frontage, style, rng):
            free = _snap(shape.difference(taken))
            low, high = style.height_m
            height_m = round(low + (high - low) * rng.random(), 1)
            if free is not None and free.distance(network.street_surface) >= GRID_M:
                number += 1
                built.append(
                    Built(
                        id=f'b{number:03d}',
                        name='',
                        kind=style.kind,
                        shape=free,
                        height_m=height_m,
                    )
                )
    return tuple(built)


def _blocks(
    ground: shapely.Geometry, districts: tuple[District, ...]
) -> list[tuple[shapely.Polygon, Style]]:
    """Cut the ground between the streets into the parts of the districts, in a fixed order."""
    blocks: list[tuple[shapely.Polygon, Style]] = []
    for district in districts:
        inside = ground.intersection(district.area)
        parts = [p for p in shapely.get_parts(inside) if _is_wide_enough(p)]
        ground = ground.difference(district.area)
        if district.style is not None:
            blocks.extend((part, district.style) for part in sorted(parts, key=lambda p: p.bounds))
    return blocks


def _keep_clear(plan: StreetPlan, network: RoadNetwork) -> shapely.Geometry:
    """Return the streets with their setbacks."""
    parts = [network.street_surface.buffer(_DEFAULT_SETBACK_M)]
    edges = plan_edges(plan)
    for edge in edges:
        setback_m = plan.types[edge_between(edges, edge.from_node, edge.to_node).kind].setback_m
        for lane_id in network.edge(edge.id).lane_ids:
            lane = network.lane(lane_id)
            line = shapely.LineString(lane.polyline)
            parts.append(
                line.buffer(lane.width_m / 2.0 + setback_m, cap_style='flat', join_style='mitre')
            )
    return shapely.union_all(parts)


def _special(special: Special, network: RoadNetwork) -> Built:
    if special.shape.intersects(network.street_surface):
        raise ValueError(f'{special.name} touches a street')
    return Built(
        id=special.id,
        name=special.name,
        kind=special.kind,
        shape=special.shape,
        height_m=special.height_m,
    )


def _fill(
    block: shapely.Polygon, frontage: shapely.Geometry, style: Style, rng: random.Random
) -> Iterator[shapely.Polygon]:
    for lot in _lots(block, style.lot_m2, rng):
        wanted = rng.random() < style.filled
        shape = lot.buffer(-style.gap_m / 2.0, join_style='mitre').intersection(frontage)
        for part in shapely.get_parts(shape):
            if wanted and _is_wide_enough(part):
                yield part


def _is_wide_enough(shape: shapely.Geometry) -> bool:
    if shape.geom_type != 'Polygon' or shape.area < _MIN_SIDE_M * _MIN_SIDE_M:
        return False
    return not shape.buffer(-_MIN_SIDE_M / 2.0 + 0.5).is_empty


def _lots(block: shapely.Polygon, lot_m2: float, rng: random.Random) -> list[shapely.Polygon]:
    """Halve a block across its longer side until the lots are small enough."""
    if block.area < lot_m2 * (0.9 + 0.7 * rng.random()):
        return [block]
    corners = list(block.minimum_rotated_rectangle.exterior.coords)[:4]
    (ax, ay), (bx, by), (cx, cy) = corners[0], corners[1], corners[2]
    ab, bc = math.hypot(bx - ax, by - ay), math.hypot(cx - bx, cy - by)
    share = 0.42 + 0.16 * rng.random()
    if ab >= bc:
        along, across, start = (bx - ax, by - ay), (cx - bx, cy - by), (ax, ay)
    else:
        along, across, start = (cx - bx, cy - by), (ax - bx, ay - by), (bx, by)
    px, py = start[0] + along[0] * share, start[1] + along[1] * share
    cut = shapely.LineString(
        [(px - across[0], py - across[1]), (px + 2 * across[0], py + 2 * across[1])]
    )
    pieces = [
        part
        for part in shapely.get_parts(shapely.ops.split(block, cut))
        if part.geom_type == 'Polygon'
    ]
    if len(pieces) < 2:
        return [block]
    result: list[shapely.Polygon] = []
    for piece in sorted(pieces, key=lambda p: p.bounds):
        result.extend(_lots(piece, lot_m2, rng))
    return result


def _snap(shape: shapely.Geometry) -> shapely.Polygon | None:
    """Return the largest part on the decimetre grid, or None when too little is left."""
    parts = [p for p in shapely.get_parts(shape) if p.geom_type == 'Polygon']
    if not parts:
        return None
    largest = max(parts, key=lambda p: p.area)
    # Opening takes off splinters that cutting leaves at corners.
    opened = largest.buffer(-_SPLINTER_M, join_style='mitre').buffer(
        _SPLINTER_M, join_style='mitre'
    )
    snapped = shapely.set_precision(opened.intersection(largest).simplify(0.4), GRID_M)
    return shapely.normalize(snapped) if _is_wide_enough(snapped) else None
