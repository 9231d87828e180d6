# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The same network for SciPy: shortest paths by Bellman-Ford, in compiled code of its own."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt
from scipy.sparse import csr_array
from scipy.sparse.csgraph import NegativeCycleError, bellman_ford

from aurora_bench.stn.networks import Network


def shortest(network: Network) -> npt.NDArray[np.float64] | None:
    """Return the length of the shortest path between any two points, microseconds.

    A double holds every sum exactly. Infinite: there is no path; None: a circle is negative.
    """
    at = {point: k for k, point in enumerate(network.points)}
    tightest: dict[tuple[int, int], int] = {}
    for edge in network.edges:
        pair = at[edge.earlier], at[edge.later]
        if pair[0] == pair[1]:
            if edge.bound_us < 0:
                return None  # SciPy leaves out the diagonal
            continue
        tightest[pair] = min(edge.bound_us, tightest.get(pair, edge.bound_us))
    count = len(network.points)
    rows, columns = (np.array([p[k] for p in tightest], dtype=np.intp) for k in (0, 1))
    lengths = np.array(list(tightest.values()), dtype=np.float64)
    graph = csr_array((lengths, (rows, columns)), shape=(count, count))
    try:
        return np.asarray(bellman_ford(graph, directed=True))
    except NegativeCycleError:
        return None
