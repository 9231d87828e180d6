# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""How far messages reach: sent one after the other, in the open and past a wall."""

from __future__ import annotations

import numpy as np

from aurora_core.comm.link import LinkSettings, MessageLink, Path, link_stream
from aurora_core.comm.reach import Reach
from aurora_core.geometry.prism import Prism
from aurora_core.geometry.sight import SightModel
from aurora_core.geometry.sight_line import SightLine
from aurora_core.knowledge.limits import Limits
from aurora_core.knowledge.uav_record import LinkRow
from aurora_core.trace.records import LinkEventKind

_STEP_M = 50.0
_LEAST_MOST_M = 1000.0
# So many over each distance; it is in reach where no larger share of them is lost.
_SENT = 20
_LOST_SHARE = 0.1
_TENTHS = 10  # reaches are whole tenths of a metre
# The ends are so high, and the wall in between is higher (m).
_END_M, _WALL_M = 1.5, 30.0
_SEED = 1


def measure_link(dt_s: float, limits: Limits) -> tuple[tuple[float, float], tuple[LinkRow, ...]]:
    """Send messages without loss by chance or fading over distances that grow: the outer bound.

    Args:
        dt_s: Step of the link.
        limits: Ranges of the link.

    Returns:
        Greatest distance in reach with sight and without (m), and the share received of the
        messages over each distance, as far as one is received.
    """
    most_m = max(_LEAST_MOST_M, 2.0 * limits.link_range_sight_m, 2.0 * limits.link_range_blocked_m)
    rows = []
    for step in range(1, round(most_m / _STEP_M) + 1):
        away_m = step * _STEP_M
        rows.append(
            LinkRow(
                distance_m=away_m,
                with_sight=_received(dt_s, limits, away_m, _OPEN),
                without_sight=_received(dt_s, limits, away_m, _walled(away_m)),
            )
        )
        if rows[-1].with_sight == rows[-1].without_sight == 0.0:
            break
    open_m, blocked_m = (_reach_m(dt_s, limits, most_m, wall=wall) for wall in (False, True))
    return (open_m, blocked_m), tuple(rows)


def _reach_m(dt_s: float, limits: Limits, most_m: float, *, wall: bool) -> float:
    """Return the greatest distance in reach, by halving what is between one and one beyond."""
    low, high = 0, round(most_m * _TENTHS)
    while high - low > 1:
        middle = (low + high) // 2
        away_m = middle / _TENTHS
        ends = _walled(away_m) if wall else _OPEN
        if _received(dt_s, limits, away_m, ends) >= 1.0 - _LOST_SHARE:
            low = middle
        else:
            high = middle
    return low / _TENTHS


_OPEN = SightLine(SightModel(()))


def _walled(away_m: float) -> SightLine:
    """Return what stands in the way: a wall across the middle of it."""
    near_m, far_m = 0.49 * away_m, 0.51 * away_m
    ring = np.array([(near_m, -5.0), (far_m, -5.0), (far_m, 5.0), (near_m, 5.0)])
    return SightLine(SightModel((Prism('wall', ring, (), 0.0, _WALL_M),)))


def _received(dt_s: float, limits: Limits, away_m: float, sight: SightLine) -> float:
    """Return the share of the messages over a distance that is received."""
    settings = LinkSettings(
        link_id='measured',
        sender='a',
        receiver='b',
        loss=0.0,
        latency_s=0.0,
        retransmissions=0,
        interval_s=1.0,
        reach=Reach(sight_m=limits.link_range_sight_m, blocked_m=limits.link_range_blocked_m),
    )
    link = MessageLink(settings, dt_s, link_stream(_SEED, settings.link_id))
    free = sight.free((0.0, 0.0, _END_M), (away_m, 0.0, _END_M))
    path = Path(distance_m=away_m, line_of_sight=free)
    received = 0
    for number in range(_SENT):
        link.send(2 * number, number, '')
        for tick in (2 * number, 2 * number + 1):
            records = link.step(tick, lambda: path, lambda: 0)
            received += sum(r.kind is LinkEventKind.DELIVERED for r in records)
    return received / _SENT
