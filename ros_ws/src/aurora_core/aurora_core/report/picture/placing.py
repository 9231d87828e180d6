# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Put small labels beside their points without covering each other or what matters."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field

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
        wide = min(self.left + self.width, other.left + other.width) - max(self.left, other.left)
        high = min(self.bottom + self.height, other.bottom + other.height) - max(
            self.bottom, other.bottom
        )
        return wide * high if wide > 0.0 and high > 0.0 else 0.0


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
                cost = sum(room.overlap(other) for other in self.taken)
                cost += 3.0 * (width * height - room.overlap(self._axes()))
                cost += 0.02 * width * height * ring
                if cost < best_cost - 1e-9:
                    best, best_cost = (centre_x, centre_y), cost
        self.taken.append(
            Rectangle(
                left=best[0] - width / 2, bottom=best[1] - height / 2, width=width, height=height
            )
        )
        return best

    def _axes(self) -> Rectangle:
        return Rectangle(left=0.0, bottom=0.0, width=self.width, height=self.height)
