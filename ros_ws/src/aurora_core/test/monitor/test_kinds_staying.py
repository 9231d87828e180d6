# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""A hover without a place holds where the mission before has led its UAV, and as high."""

from __future__ import annotations

from functools import partial

import pytest
from kind_rows import Row, grounded
from trace_builder import TOLERANCES, flight, number
from trace_cases import Case, facts_of, hover_case, mission, spec

from aurora_core.outcomes.schedule import MissionFacts
from aurora_core.outcomes.verdict import Reason
from aurora_core.spec.parameter import Unit
from aurora_core.spec.vocabulary import MissionMode

# The second mission begins and ends with these ticks.
BEGINS, ENDS = 700, 1100
CLIMBS = 500


def _then_hovers(
    east_m: float = 0.0,
    *,
    mps: float = 0.0,
    later: int = 2,
    climbs: bool = False,
    back: bool = False,
) -> Case:
    """A drone hovers over (100, 0), then where it is.

    Args:
        east_m: So far it flies on from where it is when that begins.
        mps: As fast as that it is flying by then.
        later: So many ticks after that it leaves, where it was at rest.
        climbs: A clock tells it to 45 m in its first mission.
        back: It goes down to 30 m again 5 s later.
    """
    case = hover_case()
    set_off = round(BEGINS - 30.0 / (0.05 * mps)) if mps else BEGINS + later

    def path(k: int) -> tuple[float, float, float]:
        step_m = 0.05 * (mps or 15.0)
        before_m = 30.0 if mps else 0.0
        way_m = min(before_m + east_m, step_m * max(0, k - set_off))
        high = climbs and k >= CLIMBS and not (back and k >= CLIMBS + 100)
        return 100.0 + way_m, 0.0, 45.0 if high else 30.0

    case.run.flights[:] = [flight(1401, (100.0, 0.0), 30.0, path, landing=ENDS, later=(BEGINS,))]
    (first,) = case.spec.missions
    second = mission('m2', MissionMode.HOVER)
    event = {
        'id': 'e1',
        'trigger': {'on': 'time', 'at_s': number(CLIMBS * 0.05, Unit.SECOND)},
        'action': {'do': 'ascend', 'uav': 'uav1', 'altitude_m': number(45.0)},
    }
    changes = {'missions': (first, second), 'events': (event,) if climbs else ()}
    case.spec = spec(**{**dict(case.spec), **changes})
    stays = MissionFacts(
        mission='m2', uav='uav1', mode=MissionMode.HOVER, altitude_m=30.0, duration_s=20.0
    )
    case.facts = facts_of(*case.facts.missions, stays, horizon_s=70.0)
    return case


ROWS = (
    Row(id='m2.drift', make=_then_hovers, margin=2.0, what='at-rest'),
    # It was at rest, and flew somewhere else.
    Row(id='m2.drift', make=partial(_then_hovers, 26.0), margin=2.0 - 26.0, what='at-rest'),
    # From 8 m/s braking takes 8^2 / (2 * 1.5) = 21.3 m, and 5 m more may it be off.
    Row(id='m2.drift', make=partial(_then_hovers, 20.0, mps=8.0), margin=2.0, what='braking'),
    Row(
        id='m2.drift',
        make=partial(_then_hovers, 60.0, mps=8.0),
        margin=2.0 - 60.0,
        what='flying-on',
    ),
    Row(id='m2.drift', make=lambda: grounded(_then_hovers()), reason=Reason.EMPTY_PHASE),
    # The first sample at rest is the one after the last step of 0.4 m.
    Row(
        id='m2.capture',
        make=partial(_then_hovers, 20.0, mps=8.0),
        margin=30.0 - 51 * 0.05,
        within=0.06,
        what='braking',
    ),
    Row(id='m2.capture', make=partial(_then_hovers, climbs=True), margin=30.0, what='as-high'),
    Row(
        id='m2.capture',
        make=partial(_then_hovers, climbs=True, back=True),
        reason=Reason.EMPTY_PHASE,
        what='back-down',
    ),
)


@pytest.mark.parametrize('row', ROWS, ids=lambda row: row.name)
def test_hovers_where_a_uav_is(row: Row) -> None:
    row.check()


def test_the_tolerances_that_the_margins_were_worked_out_with() -> None:
    assert TOLERANCES.route_acceleration_mps2 == 1.5
    assert TOLERANCES.phase_follow_m == 5.0
    assert TOLERANCES.hover_drift_calm_m == 2.0
