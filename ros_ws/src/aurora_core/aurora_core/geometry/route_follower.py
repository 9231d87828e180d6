# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The progress of a body along a route, sample after sample."""

from __future__ import annotations

import math

import numpy as np

from aurora_core.geometry.arrays import FloatArray, FloatLike, as_rows
from aurora_core.geometry.polyline import DEFAULT_WINDOW_M, Polyline

_WAY_ON_ROUTE = 2.0  # a curve may be longer than its chord
_WAY_OFF_ROUTE = 4.0  # a way across a block cuts three of its sides


class RouteFollower:
    """The progress of one body along a route that may cross or repeat itself.

    Each sample is searched near the previous one: within the window plus twice the distance
    moved (a curve is longer than its chord). A body farther from the route than the window
    has left it; the reach then grows by four times its way until it is back, so it may
    rejoin farther on but does not jump to a lap far away. The first sample lies on whichever
    branch is nearest to it; of branches about equally near (2 m) the one nearest to `start_s`.

    Args:
        route: The route.
        start_s: Where the body is expected at first, metres.
        window_m: Reach of the search.
        extend: As in `Polyline.project`.
    """

    def __init__(
        self,
        route: Polyline,
        start_s: float = 0.0,
        *,
        window_m: float = DEFAULT_WINDOW_M,
        extend: bool = False,
    ) -> None:
        self._route = route
        self._start = start_s
        self._window = window_m
        self._extend = extend
        self._anchor, self._travelled = start_s, 0.0
        self._last: tuple[float, float] | None = None
        self._on_route = True

    def follow(self, xy: FloatLike) -> FloatArray:
        """Return the progress at the next samples; in one call or in many, the same bits.

        Args:
            xy: (T, 2) metres; rows that are not finite (body absent) are skipped.

        Returns:
            (T,) arc length in metres; NaN in skipped rows.
        """
        rows = as_rows('xy', xy, 2)
        out = np.full(len(rows), np.nan)
        for k, (x, y) in enumerate(rows.tolist()):
            if math.isfinite(x) and math.isfinite(y):
                out[k] = self._step(x, y)
        return out

    def _step(self, x: float, y: float) -> float:
        if self._last is None:
            s, lateral = self._route.first_place(x, y, self._start, self._extend)
        else:
            dx, dy = x - self._last[0], y - self._last[1]
            self._travelled += math.sqrt(dx * dx + dy * dy)
            way = _WAY_ON_ROUTE if self._on_route else _WAY_OFF_ROUTE
            reach = self._window + way * self._travelled
            low, high = self._anchor - reach, self._anchor + reach
            s, lateral = self._route.nearest_place(x, y, low, high, self._anchor, self._extend)
        self._last = (x, y)
        self._on_route = abs(lateral) <= self._window
        if self._on_route:
            self._anchor, self._travelled = s, 0.0
        return s
