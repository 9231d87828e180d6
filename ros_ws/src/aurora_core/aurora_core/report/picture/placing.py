# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Put small labels beside their points without covering each other or what matters."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field

import numpy as np
import numpy.typing as npt

# Directions to try, nearest readable ones first; units of the offset.
_DIRECTIONS = (
    (1.0, 1.0),
    (-1.0, 1.0),
    (1.0, -1.0),
    (-1.0, -1.0),
    (0.0, 1.4),
    (0.0, -1.4),
    (1.4, 0.0),
    (-1.4, 0.0),
)
_RINGS = (1.0, 1.8, 2.8, 4.0, 5.5)


@dataclass(frozen=True, slots=True, kw_only=True)
class Rectangle:
    """An upright rectangle in points of the axes, from its lower left corner."""

    left: float
    bottom: float
    width: float
    height: float

    def overlap(self, other: Rectangle) -> float:
        """Return the common area."""
        wide = min(self.right, other.right) - max(self.left, other.left)
        high = min(self.top, other.top) - max(self.bottom, other.bottom)
        return wide * high if wide > 0.0 and high > 0.0 else 0.0

    @property
    def right(self) -> float:
        """Right edge."""
        return self.left + self.width

    @property
    def top(self) -> float:
        """Upper edge."""
        return self.bottom + self.height


@dataclass(slots=True, kw_only=True)
class Placer:
    """Remembers what is taken.

    Attributes:
        width: Of the axes, points.
        height: Of the axes, points.
        taken: Rectangles that later labels avoid.
    """

    width: float
    height: float
    taken: list[Rectangle] = field(default_factory=list)

    def keep_free(self, points: Iterable[tuple[float, float]], size: float) -> None:
        """Let labels avoid a line given by points in points of the axes."""
        for x, y in points:
            self.taken.append(
                Rectangle(left=x - size / 2, bottom=y - size / 2, width=size, height=size)
            )

    def place(
        self, x: float, y: float, width: float, height: float, gap: float
    ) -> tuple[float, float]:
        """Return the centre of a label of a size beside a point, and take the room.

        Args:
            x: Point, in points of the axes.
            y: Point.
            width: Of the label, points.
            height: Of the label, points.
            gap: Distance between point and label in the first ring, points.
        """
        best, best_cost = (x, y), float('inf')
        axes = np.array([[0.0, 0.0, self.width, self.height]])
        taken = np.array([(r.left, r.bottom, r.right, r.top) for r in self.taken]).reshape(-1, 4)
        for ring in _RINGS:
            for right, up in _DIRECTIONS:
                centre_x = x + right * (gap * ring + width / 2)
                centre_y = y + up * (gap * ring + height / 2)
                room = Rectangle(
                    left=centre_x - width / 2,
                    bottom=centre_y - height / 2,
                    width=width,
                    height=height,
                )
                cost = _covered(room, taken)
                cost += 3.0 * (width * height - _covered(room, axes))
                cost += 0.02 * width * height * ring
                if cost < best_cost - 1e-9:
                    best, best_cost = (centre_x, centre_y), cost
        self.taken.append(
            Rectangle(
                left=best[0] - width / 2, bottom=best[1] - height / 2, width=width, height=height
            )
        )
        return best


def _covered(room: Rectangle, others: npt.NDArray[np.float64]) -> float:
    """Return the area of a rectangle that others (K, 4: left, bottom, right, top) have too."""
    wide = np.minimum(room.right, others[:, 2]) - np.maximum(room.left, others[:, 0])
    high = np.minimum(room.top, others[:, 3]) - np.maximum(room.bottom, others[:, 1])
    return float((np.maximum(wide, 0.0) * np.maximum(high, 0.0)).sum())
