# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""How far a link reaches at most, and whether its loss rises towards there."""

from __future__ import annotations

from dataclasses import dataclass

from aurora_core.comm.fading import lost_share
from aurora_core.comm.path_loss import blockage_db, received_dbm
from aurora_core.knowledge.limits import Limits
from aurora_core.spec.parameter import Provenance
from aurora_core.spec.scene import Link
from aurora_core.spec.vocabulary import LinkOcclusion


@dataclass(frozen=True, slots=True, kw_only=True)
class Reach:
    """Bounds beyond which nothing passes, and the loss inside them.

    Attributes:
        sight_m: Range with line of sight (3-D).
        blocked_m: Range without; 0: nothing passes.
        decade_db: Received power that makes the loss a tenth; 0: none is lost inside.
    """

    sight_m: float
    blocked_m: float
    decade_db: float = 0.0

    def range_m(self, line_of_sight: bool) -> float:
        """Return the range with or without line of sight."""
        return self.sight_m if line_of_sight else self.blocked_m

    def holds(self, distance_m: float, line_of_sight: bool) -> bool:
        """Tell whether anything can pass: not beyond the range, and not past what blocks it."""
        range_m = self.range_m(line_of_sight)
        return range_m > 0.0 and distance_m <= range_m

    def chance(self, loss: float, distance_m: float, line_of_sight: bool) -> float:
        """Return the probability that a transmission inside the range is lost, 0..1.

        Args:
            loss: Probability that it is lost wherever it is sent.
            distance_m: 3-D distance.
            line_of_sight: Whether it is free.
        """
        return loss + (1.0 - loss) * self.faded(distance_m, line_of_sight)

    def faded(self, distance_m: float, line_of_sight: bool) -> float:
        """Return the probability that a transmission inside the range fades, 0..1."""
        if self.decade_db <= 0.0 or not self.holds(distance_m, line_of_sight):
            return 0.0
        blockage = 0.0 if line_of_sight else blockage_db(self.sight_m, self.blocked_m)
        margin_db = received_dbm(distance_m, blockage) - received_dbm(self.sight_m)
        return lost_share(margin_db, self.decade_db)


def reach_of(link: Link, limits: Limits) -> Reach:
    """Return the reach of a link.

    A stated range is the same with and without sight. What is said of range or loss replaces the
    fading: such a link loses as much as it says, inside its range.

    Args:
        link: As requested.
        limits: Ranges of a link that states none, and how its loss rises.
    """
    stated = None if link.range_m is None else link.range_m.value
    sight_m = limits.link_range_sight_m if stated is None else stated
    shorter_m = limits.link_range_blocked_m if stated is None else stated
    loses = link.loss.value > 0.0 or link.loss.provenance is Provenance.EXPLICIT
    return Reach(
        sight_m=sight_m,
        blocked_m={
            LinkOcclusion.SHORTENS: shorter_m,
            LinkOcclusion.BLOCKS: 0.0,
            LinkOcclusion.IGNORED: sight_m,
        }[link.occlusion],
        decade_db=0.0 if loses or stated is not None else limits.link_decade_db,
    )
