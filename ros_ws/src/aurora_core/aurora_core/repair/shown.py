# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What a recording shows of a failure beyond its margin: why a target was not seen, a report late.

Out of the range of the sensor it has to come nearer; behind a building it has to be looked at from
higher up, or elsewhere. Which of both it was is in the trace. So is how far a target was ahead of
its tracker, who may report only when it has captured.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from math import dist

import numpy as np
import numpy.typing as npt

from aurora_core.errors import VerificationError
from aurora_core.judging.evaluation import Context, Missing
from aurora_core.outcomes.condition import Condition, Window
from aurora_core.quantities.sight import sight_series
from aurora_core.repair.helps import ANCHOR
from aurora_core.repair.reach import Evidence
from aurora_core.spec.parameter import Parameter
from aurora_core.spec.quantity import QuantityName
from aurora_core.spec.scenario import SendMessage

_SEEN = (
    QuantityName.VISIBLE_FRACTION,
    QuantityName.VISIBLE_TIME,
    QuantityName.VISIBLE_AT_SEND,
)
# How much more, and less, that speaks for a field and direction.
_MORE, _LESS = 1.5, 0.5
# A standoff is made larger by so many times the way that was to be caught up: it has to be held.
_AMPLE = 2.0
BoolArray = npt.NDArray[np.bool_]
Move = tuple[str, int]


@dataclass(frozen=True, slots=True, kw_only=True)
class Shown:
    """What was found.

    Attributes:
        told: In English.
        factors: How much more it speaks for the last name of a field, with its direction.
    """

    told: str
    factors: Mapping[Move, float]


def why_not_seen(context: Context, condition: Condition) -> Shown | None:
    """Return why a target was not seen for most of the time that it was not, None if it was.

    Args:
        context: The recorded run.
        condition: Violated.
    """
    if condition.quantity not in _SEEN or len(condition.of) != 2:
        return None
    view = context.view
    observer, target = condition.of
    if not view.has(observer) or not view.has(target):
        return None
    sight = sight_series(view, observer, target)
    unseen = view.present(observer) & view.present(target) & ~sight.visible
    unseen &= _looked_at(context, condition, len(unseen))
    if not unseen.any():
        return None
    left_m = view.geometry.world.sensing_range_m - sight.slant_range_m
    far, hidden = int((unseen & (left_m < 0.0)).sum()), int((unseen & (left_m >= 0.0)).sum())
    if far > hidden:
        return Shown(
            told=f'{target} is out of range for {far * view.dt_s:.1f} s',
            factors={
                ('standoff_m', -1): _MORE,
                ('altitude_m', -1): _MORE / _LESS,
                ('altitude_m', 1): _LESS,
                (ANCHOR, 0): _LESS,
            },
        )
    return Shown(
        told=f'something stands before {target} for {hidden * view.dt_s:.1f} s',
        factors={('altitude_m', 1): _MORE, (ANCHOR, 0): _MORE},
    )


def why_sent_late(
    context: Context, condition: Condition, path: str, away: Parameter
) -> Evidence | None:
    """Return what lets a tracker capture sooner that was not ready when its report was due.

    Who had ended its ascent and then had to catch up has less to catch up from farther behind.

    Args:
        context: The recorded run.
        condition: Violated; it waits for the report.
        path: Of the standoff ...
        away: ... at which it tracks.
    """
    times, view = context.events, context.view
    event = times.event(condition.arguments.event or '')
    due = None if event is None else times.due_tick(event.id)
    if event is None or due is None or not isinstance(event.action, SendMessage):
        return None
    sender = event.action.sender
    mission = next(m for m in context.spec.missions if path == f'missions/{m.id}/standoff_m')
    flight, target = times.rules.flights.get(sender), mission.target or ''
    up, ready = None if flight is None else flight.ascent_end_tick, times.reports_from(event, due)
    if up is None or ready is None or ready <= max(up, due) or not view.has(target):
        return None
    behind_m = dist(view.reference(sender)[up, :2], view.reference(target)[up, :2])
    aim = min(away.high, away.value + _AMPLE * behind_m)
    if aim <= away.value:
        return None
    told = (
        f'{sender} captured {context.time_s(ready - up):.1f} s after its ascent, which ended '
        f'{behind_m:.3g} m from {target}'
    )
    return Evidence(aim=aim, because=told, direction=1)


def _looked_at(context: Context, condition: Condition, ticks: int) -> BoolArray:
    """Return the ticks that a condition is about, all where it has no such window."""
    everywhere = np.ones(ticks, dtype=np.bool_)
    if condition.arguments.window is Window.MOMENT:
        return everywhere
    try:
        window = context.window(condition)
    except VerificationError:
        return everywhere
    if isinstance(window, Missing):
        return everywhere
    return np.isin(np.arange(ticks), window)
