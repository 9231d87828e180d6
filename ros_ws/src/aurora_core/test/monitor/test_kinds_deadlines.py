# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`Within 6 s`: what has an end is over by then, not only begun.

The event is triggered at 15 s; who loses or gains speed does so with 5 m/s^2.
"""

from __future__ import annotations

from collections.abc import Callable

import pytest
from action_cases import ascends, changed, lands, never_due, to_speed
from kind_rows import Row
from trace_builder import number
from trace_cases import Case

from aurora_core.outcomes.verdict import Reason
from aurora_core.spec.parameter import Bound, Unit


def _by(make: Callable[[], Case], deadline_s: float) -> Callable[[], Case]:
    stated = number(deadline_s, Unit.SECOND, explicit=True)
    late = stated.model_copy(update={'bound': Bound.AT_MOST})
    return lambda: changed(make(), delay_s=late)


def _row(make: Callable[[], Case], took_s: float, what: str) -> Row:
    case = _by(make, 3.0)
    return Row(id='e1.done_within', make=case, margin=3.0 - took_s, within=0.06, what=what)


ROWS = (
    _row(lambda: to_speed('stop', 0.0), 2.0, 'stop'),
    _row(lambda: to_speed('slow', 4.0, 4.0), 1.0, 'slow'),
    _row(lambda: to_speed('accelerate', 14.0, 14.0), 0.6, 'gain'),
    # Both set in at once.
    _row(lambda: to_speed('stop', 1.0), 5.05, 'stop-never'),
    _row(lambda: to_speed('slow', 9.5, 4.0), 5.05, 'slow-never'),
    Row(id='e1.done_within', make=_by(lambda: never_due('stop', 0.0), 3.0),
        reason=Reason.PREMISE_NEVER),
    # It is within 2 m of 60 m after 7.5 s.
    _row(lambda: ascends(310, 15.0), 7.5, 'climb'),
    _row(lambda: lands(310, 15.0), 15.45, 'land'),
)  # fmt: skip


@pytest.mark.parametrize('row', ROWS, ids=lambda row: row.name)
def test_deadline_kinds(row: Row) -> None:
    row.check()
