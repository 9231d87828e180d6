# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Whom or what each quantity of a stated condition is about: how many, of which kind, in order.

A condition of the wrong ones would be about something else, or about nothing: it goes back to the
model.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from types import MappingProxyType

BODY, UAV, EVENT, PLACE = 'body', 'UAV', 'event', 'place'


@dataclass(frozen=True, slots=True, kw_only=True)
class _Row:
    """The operands of some quantities.

    Attributes:
        slots: Of each operand, the kinds that it may have.
        more: Further ones of the last kind may follow.
        done: The quantity is done or not; without a value it is to be done.
    """

    quantities: tuple[str, ...]
    slots: tuple[tuple[str, ...], ...]
    more: bool = False
    done: bool = False


_ROWS = (
    _Row(quantities=('distance', 'horizontal_distance'), slots=((BODY,), (BODY, PLACE))),
    _Row(quantities=('separation',), slots=((BODY,), (BODY,)), more=True),
    _Row(quantities=('time_headway', 'time_to_collision'), slots=((BODY,), (BODY,))),
    _Row(quantities=('speed', 'deceleration'), slots=((BODY,),)),
    _Row(
        quantities=('vertical_speed', 'altitude', 'battery', 'hover_drift', 'waypoints_visited'),
        slots=((UAV,),),
    ),
    _Row(quantities=('landed', 'mission_completed'), slots=((UAV,),), done=True),
    _Row(quantities=('tracked_fraction', 'clearance'), slots=((UAV,), (BODY, PLACE))),
    _Row(quantities=('visible_fraction', 'visible_time'), slots=((BODY,), (BODY, PLACE))),
    _Row(quantities=('event_time',), slots=((EVENT,),)),
    _Row(quantities=('delivery_latency', 'delivery_ratio'), slots=((BODY,), (BODY,)), more=True),
    _Row(quantities=('delivered',), slots=((BODY,), (BODY,)), more=True, done=True),
)
_OF: Mapping[str, _Row] = MappingProxyType({name: r for r in _ROWS for name in r.quantities})


def is_done(quantity: str) -> bool:
    """Tell whether a quantity is done or not, and has no value of its own."""
    return _OF[quantity].done


def objection(quantity: str, kinds: Sequence[str | None]) -> str | None:
    """Return what is wrong with the operands of a quantity, None when they fit.

    Args:
        quantity: Its name.
        kinds: What each operand is: a UAV, another body, an event, a place; None: nothing known.
    """
    row = _OF[quantity]
    count = len(kinds)
    slots = [*row.slots, *[row.slots[-1]] * max(0, count - len(row.slots))]
    right = count == len(row.slots) or (row.more and count > len(row.slots))
    fits = right and all(
        kind in slot or (kind == UAV and BODY in slot)
        for kind, slot in zip(kinds, slots, strict=True)
    )
    return None if fits else f'{quantity} is of {_told(row)}'


def table() -> str:
    """Return the operands of all quantities in words."""
    return '; '.join(f'{", ".join(row.quantities)} of {_told(row)}' for row in _ROWS)


def _told(row: _Row) -> str:
    told = ', '.join(' or '.join(slot) for slot in row.slots)
    more, done = ', …' if row.more else '', ' (to be done: no op, no value)' if row.done else ''
    return f'[{told}{more}]{done}'
