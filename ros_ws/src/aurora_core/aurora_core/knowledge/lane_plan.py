# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Choose the lanes of a route with the fewest lane changes."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from operator import itemgetter

from aurora_core.knowledge.net_types import Connection, Edge, Lane

LinkTable = Mapping[str, tuple[Connection, ...]]


@dataclass(frozen=True, slots=True, kw_only=True)
class LanePlan:
    """Lane on entering and on leaving each edge, and the link taken at its end."""

    entry: tuple[str, ...]
    exit: tuple[str, ...]
    links: tuple[Connection, ...]


# From a lane of an edge: lanes to cross, index of the lane at its end and of the one behind, and
# the link between these two.
_Way = tuple[int, int, int, Connection]


class LanePlanner:
    """Chooses lanes with the fewest lane changes.

    Args:
        lanes: By id.
        links: Connections that leave a lane, by its id.
    """

    def __init__(self, lanes: Mapping[str, Lane], links: LinkTable) -> None:
        self._lanes = lanes
        self._links = links
        self._ways: dict[tuple[str, str], dict[str, tuple[_Way, ...]]] = {}

    def plan(
        self, edges: tuple[Edge, ...], vclass: str, start_lane_id: str | None = None
    ) -> LanePlan | None:
        """Plan a route of connected edges; None when the class cannot drive it.

        Ties take the rightmost lane.
        """
        # Fewest changes from entering an edge on a lane to the end, with the link that it takes.
        last = self._ways_of(edges[-1], vclass)
        best: list[dict[str, tuple[int, Connection | None]]] = [dict.fromkeys(last, (0, None))]
        for edge in edges[-2::-1]:
            onward = best[-1]
            here: dict[str, tuple[int, Connection | None]] = {}
            for lane_id, ways in self._ways_of(edge, vclass).items():
                options = [
                    (onward[link.to_lane_id][0] + crossed, exit_index, to_index, link)
                    for crossed, exit_index, to_index, link in ways
                    if link.to_lane_id in onward
                ]
                if options:
                    cost, _, _, taken = min(options, key=itemgetter(0, 1, 2))
                    here[lane_id] = cost, taken
            best.append(here)
        best.reverse()
        starts = best[0]
        if start_lane_id is not None:
            starts = {k: v for k, v in starts.items() if k == start_lane_id}
        if not starts:
            return None
        entry = [min(starts, key=lambda i: (starts[i][0], self._lanes[i].index))]
        exit_: list[str] = []
        links: list[Connection] = []
        for costs in best:
            link = costs[entry[-1]][1]
            if link is None:
                exit_.append(entry[-1])
            else:
                exit_.append(link.from_lane_id)
                links.append(link)
                entry.append(link.to_lane_id)
        return LanePlan(entry=tuple(entry), exit=tuple(exit_), links=tuple(links))

    def _ways_of(self, edge: Edge, vclass: str) -> dict[str, tuple[_Way, ...]]:
        """Return the ways from each usable lane of an edge over its end."""
        key = edge.id, vclass
        if key not in self._ways:
            usable = [i for i in edge.lane_ids if vclass in self._lanes[i].allows]
            exits = [
                (self._lanes[i].index, self._lanes[link.to_lane_id].index, link)
                for i in usable
                for link in self._links.get(i, ())
            ]
            self._ways[key] = {
                i: tuple(
                    (abs(at - self._lanes[i].index), at, to_index, link)
                    for at, to_index, link in exits
                    if self._may_slide(edge, self._lanes[i].index, at, vclass)
                )
                for i in usable
            }
        return self._ways[key]

    def _may_slide(self, edge: Edge, from_index: int, to_index: int, vclass: str) -> bool:
        low, high = min(from_index, to_index), max(from_index, to_index)
        return all(vclass in self._lanes[edge.lane_ids[i]].allows for i in range(low, high + 1))
