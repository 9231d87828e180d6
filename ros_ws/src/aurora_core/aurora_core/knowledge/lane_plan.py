# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Choose the lanes of a route with the fewest lane changes."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from aurora_core.knowledge.net_types import Connection, Edge, Lane

LinkTable = Mapping[str, tuple[Connection, ...]]


@dataclass(frozen=True, slots=True, kw_only=True)
class LanePlan:
    """Lane on entering and on leaving each edge, and the link taken at its end."""

    entry: tuple[str, ...]
    exit: tuple[str, ...]
    links: tuple[Connection, ...]


def plan_lanes(
    edges: tuple[Edge, ...],
    lanes: Mapping[str, Lane],
    links: LinkTable,
    vclass: str,
    start_lane_id: str | None,
) -> LanePlan | None:
    """Choose lanes with the fewest lane changes; None when the route is not connected.

    Ties take the rightmost lane. `links` maps a lane to the connections that leave it.
    """
    usable = [[i for i in edge.lane_ids if vclass in lanes[i].allows] for edge in edges]
    if start_lane_id is not None:
        usable[0] = [start_lane_id] if start_lane_id in usable[0] else []
    # ways[k][lane] = fewest changes from entering edge k on that lane to the end, with the exit
    # lane and the link that reach it.
    ways: list[dict[str, tuple[int, str, Connection | None]]] = [{} for _ in edges]
    ways[-1] = {lane_id: (0, lane_id, None) for lane_id in usable[-1]}
    for k in range(len(edges) - 2, -1, -1):
        exits: list[tuple[int, int, Connection]] = []
        for lane_id in edges[k].lane_ids:
            if vclass not in lanes[lane_id].allows:
                continue
            for link in links.get(lane_id, ()):
                onward = ways[k + 1].get(link.to_lane_id)
                if onward is not None:
                    exits.append((onward[0], lanes[lane_id].index, link))
        for lane_id in usable[k]:
            index = lanes[lane_id].index
            options = [
                (cost + abs(exit_index - index), exit_index, lanes[link.to_lane_id].index, link)
                for cost, exit_index, link in exits
                if _may_slide(lanes, edges[k], index, exit_index, vclass)
            ]
            if options:
                cost, _, _, link = min(options, key=lambda option: option[:3])
                ways[k][lane_id] = (cost, link.from_lane_id, link)
    if not ways[0]:
        return None
    entry = [min(ways[0], key=lambda i: (ways[0][i][0], lanes[i].index))]
    exit_: list[str] = []
    taken: list[Connection] = []
    for k in range(len(edges)):
        _, exit_lane, link_out = ways[k][entry[k]]
        exit_.append(exit_lane)
        if link_out is not None:
            taken.append(link_out)
            entry.append(link_out.to_lane_id)
    return LanePlan(entry=tuple(entry), exit=tuple(exit_), links=tuple(taken))


def _may_slide(
    lanes: Mapping[str, Lane], edge: Edge, from_index: int, to_index: int, vclass: str
) -> bool:
    low, high = min(from_index, to_index), max(from_index, to_index)
    return all(vclass in lanes[edge.lane_ids[i]].allows for i in range(low, high + 1))
