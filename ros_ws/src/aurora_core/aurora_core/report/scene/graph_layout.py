# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Layered layout of a small directed graph, top to bottom, in points.

After Sugiyama, Tagawa and Toda (1981): break cycles, layer by longest path, order each layer by
barycentres to have few crossings, then set coordinates. An edge over several layers has a lane in
each of them, so that no line runs over a node.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise

import networkx as nx

Point = tuple[float, float]
_GAP_X, _GAP_Y = 16.0, 44.0
_LANE = 14.0
_SWEEPS = 12
# Parts of the paper that nodes of a layer may fill, tried until lanes beside them fit too.
_SHARES = (1.0, 0.85, 0.7, 0.55, 0.4)
# Part of a node's width in which edges end.
_PORTS = 0.72


@dataclass(frozen=True, slots=True, kw_only=True)
class Layout:
    """Where everything is; y grows downwards.

    Attributes:
        centres: Of the nodes.
        routes: Per pair of nodes the points of its line, from source to target: verticals
            through layers, free in between.
        width: Of the paper that it needs: what was asked for, or more.
        height: Of the whole.
    """

    centres: Mapping[str, Point]
    routes: Mapping[tuple[str, str], tuple[Point, ...]]
    width: float
    height: float


def layered(
    sizes: Mapping[str, tuple[float, float]], edges: Sequence[tuple[str, str]], width: float
) -> Layout:
    """Return the layout of a graph.

    Args:
        sizes: Width and height of each node; their order breaks ties, also in cycles.
        edges: Source and target; each pair once.
        width: Of the paper.
    """
    forward = _acyclic(tuple(sizes), edges)
    best: list[tuple[float, dict[str, int]]] = []
    for share in _SHARES:
        layer = _layers(sizes, forward, width * share)
        best.append((max(_room(row, sizes) for row in _with_lanes(layer, forward)[0]), layer))
        if best[-1][0] <= width:
            break
    needed, layer = min(best, key=lambda found: max(found[0], width))
    width = max(width, needed)
    rows, chains = _with_lanes(layer, forward)
    sizes = {**{lane: (_LANE, 0.0) for row in rows for lane in row}, **sizes}
    links = [pair for chain in chains.values() for pair in pairwise(chain)]
    rows = _ordered(rows, links)
    x = _columns(rows, links, sizes, width)
    heights = [max(sizes[name][1] for name in row) for row in rows]
    tops = [sum(heights[:k]) + k * _GAP_Y for k in range(len(rows))]
    middle = {n: tops[k] + heights[k] / 2 for k, row in enumerate(rows) for n in row}
    centres = {name: (x[name], middle[name]) for name in layer}
    rows_of = {n: (tops[k], tops[k] + heights[k]) for k, row in enumerate(rows) for n in row}
    ports = _ports(links, x, sizes)
    routes: dict[tuple[str, str], tuple[Point, ...]] = {}
    for pair in edges:
        chain = chains[pair if pair in chains else pair[::-1]]
        first, last = chain[0], chain[-1]
        points = [(ports[first, chain[1]], middle[first] + sizes[first][1] / 2)]
        for lane in chain[1:-1]:
            points += [(x[lane], rows_of[lane][0]), (x[lane], rows_of[lane][1])]
        points.append((ports[last, chain[-2]], middle[last] - sizes[last][1] / 2))
        routes[pair] = tuple(points if pair in chains else points[::-1])
    height = sum(heights) + _GAP_Y * (len(rows) - 1)
    return Layout(centres=centres, routes=routes, width=width, height=height)


def _room(row: Sequence[str], sizes: Mapping[str, tuple[float, float]]) -> float:
    """Return the width of a layer, lanes included."""
    return sum(sizes[n][0] if n in sizes else _LANE for n in row) + _GAP_X * (len(row) - 1)


def _acyclic(names: Sequence[str], edges: Sequence[tuple[str, str]]) -> list[tuple[str, str]]:
    """Return the edges with as many turned round as keep cycles out."""
    place = {name: index for index, name in enumerate(names)}
    graph = nx.DiGraph()
    graph.add_nodes_from(names)
    for source, target in sorted(edges, key=lambda e: place[e[0]] > place[e[1]]):
        turned = nx.has_path(graph, target, source)
        graph.add_edge(*((target, source) if turned else (source, target)))
    return list(graph.edges)


def _layers(
    sizes: Mapping[str, tuple[float, float]], edges: Sequence[tuple[str, str]], width: float
) -> dict[str, int]:
    """Return the layer of each node by longest path; one that is too wide becomes two."""
    graph = nx.DiGraph()
    graph.add_nodes_from(sizes)
    graph.add_edges_from(edges)
    depth: dict[str, int] = {}
    for name in nx.lexicographical_topological_sort(graph, key=list(sizes).index):
        depth[name] = max((depth[before] + 1 for before in graph.predecessors(name)), default=0)
    layer: dict[str, int] = {}
    number = -1
    for level in range(max(depth.values()) + 1):
        number, used = number + 1, 0.0
        for name in sizes:
            if depth[name] == level:
                if used and used + sizes[name][0] > width:
                    number, used = number + 1, 0.0
                used += sizes[name][0] + _GAP_X
                layer[name] = number
    return layer


def _with_lanes(
    layer: Mapping[str, int], edges: Sequence[tuple[str, str]]
) -> tuple[list[list[str]], dict[tuple[str, str], list[str]]]:
    """Return the names in each layer, lanes included, and the chain of each edge."""
    rows: list[list[str]] = [[] for _ in range(max(layer.values()) + 1)]
    for name, number in layer.items():
        rows[number].append(name)
    chains: dict[tuple[str, str], list[str]] = {}
    for source, target in edges:
        lanes = []
        for number in range(layer[source] + 1, layer[target]):
            lanes.append(f'{source}>{target}>{number}')
            rows[number].append(lanes[-1])
        chains[source, target] = [source, *lanes, target]
    return rows, chains


def _ordered(rows: list[list[str]], links: Sequence[tuple[str, str]]) -> list[list[str]]:
    """Return the layers in the order with the fewest crossings that the sweeps find."""
    best, fewest = rows, _crossings(rows, links)
    for sweep in range(_SWEEPS):
        rows = [list(row) for row in rows]
        down = sweep % 2 == 0
        numbers = range(1, len(rows)) if down else range(len(rows) - 2, -1, -1)
        for number in numbers:
            fixed = rows[number - 1 if down else number + 1]
            place = {name: index for index, name in enumerate(fixed)}
            pull = {
                name: _mean([place[o] for o in _others(name, links) if o in place], index)
                for index, name in enumerate(rows[number])
            }
            rows[number].sort(key=lambda name: pull[name])
        crossings = _crossings(rows, links)
        if crossings < fewest:
            best, fewest = rows, crossings
    return best


def _others(name: str, links: Sequence[tuple[str, str]]) -> list[str]:
    return [b if a == name else a for a, b in links if name in (a, b)]


def _mean(values: Sequence[float], otherwise: float) -> float:
    return sum(values) / len(values) if values else otherwise


def _crossings(rows: Sequence[Sequence[str]], links: Sequence[tuple[str, str]]) -> int:
    place = {name: index for row in rows for index, name in enumerate(row)}
    number = {name: index for index, row in enumerate(rows) for name in row}
    count = 0
    for index, (a, b) in enumerate(links):
        for c, d in links[index + 1 :]:
            if number[a] == number[c]:
                count += (place[a] - place[c]) * (place[b] - place[d]) < 0
    return count


def _columns(
    rows: Sequence[Sequence[str]],
    links: Sequence[tuple[str, str]],
    sizes: Mapping[str, tuple[float, float]],
    width: float,
) -> dict[str, float]:
    """Return the centre of everything: near its neighbours, nothing over anything."""
    x = {name: width / 2 for row in rows for name in row}
    for row in rows:
        x |= _spread(row, dict.fromkeys(row, width / 2), sizes, width)
    for sweep in range(_SWEEPS):
        for row in rows if sweep % 2 == 0 else reversed(rows):
            wish = {n: _mean([x[o] for o in _others(n, links)], x[n]) for n in row}
            x |= _spread(row, wish, sizes, width)
    left = min(x[name] - sizes[name][0] / 2 for name in x)
    right = max(x[name] + sizes[name][0] / 2 for name in x)
    return {name: at + (width - left - right) / 2 for name, at in x.items()}


def _spread(
    row: Sequence[str],
    wish: Mapping[str, float],
    sizes: Mapping[str, tuple[float, float]],
    width: float,
) -> dict[str, float]:
    """Return centres in the order of the row, as near to the wishes as the room allows.

    Neighbours that push each other become a block, which sits at the mean of what its members
    wish (pool adjacent violators).
    """
    offsets, room = [], 0.0
    for index, name in enumerate(row):
        room += sizes[name][0] / 2
        offsets.append(room)
        room += sizes[name][0] / 2 + (_GAP_X if index + 1 < len(row) else 0.0)
    blocks: list[tuple[float, int]] = []
    for name, offset in zip(row, offsets, strict=True):
        start, members = wish[name] - offset, 1
        while blocks and blocks[-1][0] > start:
            before, count = blocks.pop()
            start = (before * count + start * members) / (count + members)
            members += count
        blocks.append((start, members))
    starts = [start for start, members in blocks for _ in range(members)]
    limit = max(width - room, 0.0)
    return {
        name: min(max(start, 0.0), limit) + offset
        for name, start, offset in zip(row, starts, offsets, strict=True)
    }


def _ports(
    links: Sequence[tuple[str, str]],
    x: Mapping[str, float],
    sizes: Mapping[str, tuple[float, float]],
) -> dict[tuple[str, str], float]:
    """Return where at a node's lower and upper side each of its edges ends."""
    ports: dict[tuple[str, str], float] = {}
    for side in (0, 1):
        ends: dict[str, list[str]] = {}
        for link in links:
            ends.setdefault(link[side], []).append(link[1 - side])
        for name, others in ends.items():
            others.sort(key=lambda other: x[other])
            room = sizes[name][0] * _PORTS
            for index, other in enumerate(others):
                # As near to straight as even spacing allows.
                share = (index + 0.5) / len(others) - 0.5
                ports[name, other] = x[name] + share * room
    return ports
