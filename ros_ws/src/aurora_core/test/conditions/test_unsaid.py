# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What no run can do or judge yet is named: such a run is never `verified`."""

from __future__ import annotations

from types import ModuleType

from aurora_core.conditions.derive import derive_conditions
from aurora_core.conditions.unsaid import unsaid
from aurora_core.judging.build import Inputs
from aurora_core.spec.parameter import Unit


def test_every_such_element_is_named(tb: ModuleType) -> None:
    case = tb.tailgate_case()
    (mission,) = case.spec.missions
    route = dict(mission) | {
        'mode': 'navigate',
        'pattern': 'line',
        'speed_mps': tb.number(8.0, Unit.METRE_PER_SECOND),
        'dwell_s': tb.number(3.0, Unit.SECOND),
    }
    changes = {
        'world': dict(case.spec.world) | {'seed': 7},
        'missions': (route,),
    }
    inputs = Inputs(
        spec=tb.spec(**dict(case.spec) | changes),
        facts=case.facts,
        limits=tb.LIMITS,
        tolerances=tb.TOLERANCES,
    )
    assert {(u.element, u.what) for u in unsaid(inputs)} == {
        ('world', 'the seed 7 of the request: give it to the run'),
        (mission.id, 'a dwell time at waypoints'),
    }


def test_a_forbidden_event_is_neither_done_nor_judged_as_one(tb: ModuleType) -> None:
    case = tb.tailgate_case()
    before = derive_conditions(case.spec, case.facts, tb.LIMITS, tb.TOLERANCES)
    forbidden = {'id': 'p1', 'forbids': 'event', 'action': {'do': 'land', 'uav': 'uav1'}}
    spec = tb.spec(**dict(case.spec) | {'prohibitions': (forbidden,)})
    after = derive_conditions(spec, case.facts, tb.LIMITS, tb.TOLERANCES)
    assert after.conditions == before.conditions
    assert [u.element for u in after.underivable] == ['p1']
