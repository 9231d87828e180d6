# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Ways from one mission to the next: straight, over a building, or none."""

from __future__ import annotations

from typing import Any, cast

import pytest

from aurora_core.grounding.airspace import Airspace
from aurora_core.grounding.crossings import crossed
from aurora_core.grounding.planned_flight import PlannedFlight
from aurora_core.grounding.sites import Site
from aurora_core.knowledge.map_types import Building
from aurora_core.mission.plan import MissionPlan
from aurora_core.spec.vocabulary import MissionMode

NOWHERE = cast('Site', None)


def _block(height_m: float) -> Building:
    ring = ((40.0, -50.0), (60.0, -50.0), (60.0, 50.0), (40.0, 50.0))
    return Building(
        id='b1', ring=ring, holes=(), height_m=height_m, height_source='', kind='block', name=''
    )


def _hover(name: str, x: float, z: float) -> PlannedFlight:
    plan = MissionPlan(
        id=name, mode=MissionMode.HOVER, altitude_m=z, hover_point=(x, 0.0, z), duration_s=10.0
    )
    return PlannedFlight(plan=plan, clearance_m=9.0, seen=1.0, over_street=0.0)


@pytest.mark.parametrize(
    ('height_m', 'over_m'), [(10.0, None), (22.0, 45.0), (62.0, 75.0), (119.0, 'none')]
)
def test_a_way_leads_over_what_is_between(height_m: float, over_m: Any) -> None:
    air = Airspace((_block(height_m),), ())
    flights = (_hover('m1', 0.0, 25.0), _hover('m2', 100.0, 35.0))
    found = crossed(flights, NOWHERE, air, clearance_m=4.0, top_m=120.0, speed_mps=8.0)
    if over_m == 'none':
        assert found is None
        return
    assert found is not None
    first, second = (f.plan for f in found)
    assert (first.over_m, second.over_m) == (None, over_m)
    if over_m is not None:
        ways = ((0.0, 0.0, 25.0), (0.0, 0.0, over_m), (100.0, 0.0, over_m), (100.0, 0.0, 35.0))
        assert air.way_clearance_m(ways) >= 4.0


def _stays(z: float, *, keeps: bool) -> PlannedFlight:
    plan = MissionPlan(id='m2', mode=MissionMode.HOVER, altitude_m=z, keeps_level=keeps)
    return PlannedFlight(plan=plan, clearance_m=9.0, seen=1.0, over_street=0.0)


@pytest.mark.parametrize(('keeps', 'height_m'), [(True, 25.0), (False, 70.0)])
def test_who_stays_where_it_is_goes_on_from_there_and_as_high(
    keeps: bool, height_m: float
) -> None:
    air = Airspace((_block(22.0),), ())
    flights = (_hover('m1', 0.0, 25.0), _stays(70.0, keeps=keeps), _hover('m3', 100.0, 25.0))
    found = crossed(flights, NOWHERE, air, clearance_m=4.0, top_m=120.0, speed_mps=8.0)
    assert found is not None
    _, stays, onward = (f.plan for f in found)
    assert (stays.hover_point, stays.altitude_m, stays.over_m) == (None, height_m, None)
    # From (0, 0): over what stands on the way at the lower one of both heights.
    assert onward.over_m == max(25.0, height_m) + 10.0


def test_who_stays_where_it_is_does_not_go_down_into_a_roof() -> None:
    flights = (_hover('m1', 50.0, 40.0), _stays(24.0, keeps=False))
    for height_m, found in ((22.0, False), (15.0, True)):
        air = Airspace((_block(height_m),), ())
        ways = crossed(flights, NOWHERE, air, clearance_m=4.0, top_m=120.0, speed_mps=8.0)
        assert (ways is not None) is found
