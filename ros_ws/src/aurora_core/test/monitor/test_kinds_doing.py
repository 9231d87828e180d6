# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What follows the stated time of what somebody does: in time, late, before it is over, never."""

from __future__ import annotations

from functools import partial

import numpy as np
import pytest
from kind_rows import Row
from trace_builder import FloatArray, number
from trace_cases import Case, ground_case, spec

from aurora_core.outcomes.verdict import Reason
from aurora_core.spec.parameter import Bound, Unit
from aurora_core.spec.scenario import Behavior
from aurora_core.spec.vocabulary import BehaviorKind as B


def _speeds(*parts: tuple[float, float]) -> FloatArray:
    """20 s at speeds for times (m/s, s); the last one to the end."""
    each = [np.full(round(20.0 * seconds), mps) for mps, seconds in parts]
    return np.concatenate([*each, np.full(401, parts[-1][0])])[:401]


def _when_over(
    kind: B, speed: FloatArray, mps: float | None = None, bound: Bound = Bound.EXACTLY
) -> Case:
    """car1 does something for 6 s; car2, which stands till then, is to start when that is over.

    It does so at 11 s.
    """
    asked = None if mps is None else number(mps, Unit.METRE_PER_SECOND, explicit=True)
    lasts = number(6.0, Unit.SECOND, explicit=True, bound=bound)
    behavior = Behavior(kind=kind, speed_mps=asked, duration_s=lasts)
    follows = np.concatenate([np.zeros(220), np.full(181, 3.0)])
    case = ground_case(behavior, speed, car2=(60.0, follows))
    event = {
        'id': 'e1',
        'trigger': {'on': 'behavior_done', 'who': 'car1', 'behavior': kind},
        'action': {'do': 'start', 'agent': 'car2'},
    }
    case.spec = spec(**{**dict(case.spec), 'events': (event,)})
    return case


# The trigger holds in the 120th sample at 5 m/s, and 0.2 s before the end of a stand of 6 s.
ROWS = (
    # From 5 s on it is at its speed, before it is not.
    Row(
        id='e1.within',
        make=partial(_when_over, B.DRIVE, _speeds((2.0, 5.0), (5.0, 15.0)), 5.0),
        margin=1.0 - 0.05,
        within=0.06,
        what='at-its-speed',
    ),
    Row(
        id='e1.within',
        make=partial(_when_over, B.DRIVE, _speeds((5.0, 20.0)), 5.0),
        margin=1.0 - 5.05,
        within=0.06,
        what='late',
    ),
    # Until 3 s it drives, then it stands: the 6 s begin anew.
    Row(
        id='e1.within',
        make=partial(_when_over, B.DRIVE, _speeds((5.0, 3.0), (0.0, 2.0), (5.0, 15.0))),
        margin=1.0 - 0.05,
        within=0.06,
        what='without-a-stop',
    ),
    Row(
        id='e1.within',
        make=partial(_when_over, B.STOP, _speeds((5.0, 5.0), (0.0, 6.0), (5.0, 9.0))),
        margin=1.0 - 0.25,
        within=0.06,
        what='stood',
    ),
    # It stands from t = 0 on: nobody has stopped.
    Row(
        id='e1.within',
        make=partial(_when_over, B.STOP, _speeds((0.0, 8.0), (5.0, 12.0))),
        reason=Reason.PREMISE_NEVER,
        what='never-stopped',
    ),
    Row(
        id='e1.within',
        make=partial(_when_over, B.WAIT, _speeds((0.0, 6.0), (5.0, 14.0))),
        margin=1.0 - 5.25,
        within=0.06,
        what='waited-from-the-start',
    ),
    # "At least 6 s" is over after 7 s.
    Row(
        id='e1.within',
        make=partial(
            _when_over, B.STOP, _speeds((5.0, 4.0), (0.0, 8.0), (5.0, 8.0)), None, Bound.AT_LEAST
        ),
        margin=1.0 - 0.25,
        within=0.06,
        what='at-least',
    ),
    # It was on its way before the other one had stood for its time.
    Row(
        id='e1.at_rest',
        make=partial(_when_over, B.STOP, _speeds((5.0, 8.0), (0.0, 8.0), (5.0, 4.0))),
        margin=0.1 - 3.0,
        within=0.06,
        what='too-early',
    ),
)


@pytest.mark.parametrize('row', ROWS, ids=lambda row: row.name)
def test_what_follows_a_stated_time(row: Row) -> None:
    row.check()
