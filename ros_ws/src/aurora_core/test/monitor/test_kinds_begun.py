# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What waits for the beginning of a deed: in time, only at its end, before it, never."""

from __future__ import annotations

from dataclasses import replace
from functools import partial
from typing import Any

import numpy as np
import pytest
from kind_rows import Row
from trace_builder import box_ring, world
from trace_cases import Case, ground_case, spec

from aurora_core.knowledge.world import NamedPlace, Surface, SurfaceKind
from aurora_core.outcomes.verdict import Reason
from aurora_core.spec.scenario import Behavior
from aurora_core.spec.vocabulary import BehaviorKind

_TICK = np.arange(401)
# It steps onto the carriageway at 8 s, and is over it, 7 m, at 12.65 s.
_STEPS_ON_S = 8.0
_OVER_S = 12.65


def _braking(from_s: float) -> Any:
    """From 10 m/s with 5 m/s^2."""
    return np.maximum(10.0 - 0.25 * np.maximum(_TICK - 20.0 * from_s + 1, 0), 0.0)


def _case(on: str, cause: dict[str, Any], *, brakes_s: float, y_m: Any) -> Case:
    """car1 goes over a street from y = 0 to 7, or brakes; car2 is to brake with `cause`."""
    drives = Behavior(kind=BehaviorKind.DRIVE)
    case = ground_case(drives, np.full(401, 1.5), car2=(60.0, _braking(brakes_s)))
    case.run.agents[0].x[:] = 0.0
    case.run.agents[0].y[:] = y_m
    case.world = world(streets=((-50.0, 0.0, 50.0, 7.0),))
    brakes = {
        'id': 'e2',
        'trigger': {'on': on, 'event': 'e1'},
        'action': {'do': 'brake', 'agent': 'car2'},
    }
    case.spec = spec(**{**dict(case.spec), 'events': ({'id': 'e1', **cause}, brakes)})
    return case


def _crosses(on: str, brakes_s: float, *, ever: bool = True) -> Case:
    y_m = 0.075 * (_TICK - 20.0 * _STEPS_ON_S) + 0.01
    cause = {'action': {'do': 'cross', 'agent': 'car1'}}
    return _case(on, cause, brakes_s=brakes_s, y_m=y_m if ever else -5.0)


def _walks_up_first(brakes_s: float) -> Case:
    """It stands until 4 s and walks 6 m to the kerb: crossing begins there, not here."""
    case = _crosses('event_begun', brakes_s)
    case.run.agents[0].speed[:80] = 0.0
    case.run.agents[0].y[:80] = case.run.agents[0].y[80]
    return case


def _slows(brakes_s: float) -> Case:
    """car1 takes 5 s to stop from 8 s on; car2 is to brake when it begins to."""
    cause = {'action': {'do': 'stop', 'agent': 'car1'}}
    case = _case('event_begun', cause, brakes_s=brakes_s, y_m=3.5)
    case.run.agents[0].speed[:] = np.clip(10.0 - 0.1 * (_TICK - 159.0), 0.0, 10.0)
    return case


def _reaches(brakes_s: float) -> Case:
    """A person walks 1.5 m/s towards a crosswalk 20 m ahead, 5 m from it after 10 s."""
    walks = Behavior(kind=BehaviorKind.WALK)
    case = ground_case(walks, np.full(401, 1.5), car2=(60.0, _braking(brakes_s)))
    ring = np.array(box_ring(20.0, -5.0, 24.0, 5.0))
    outline = Surface(surface_id='c', kind=SurfaceKind.CROSSING, ring=ring)
    middle = NamedPlace(name='crosswalk', x_m=22.0, y_m=0.0)
    case.world = replace(case.world, surfaces=(*case.world.surfaces, outline), places=(middle,))
    person, car = (dict(agent) for agent in case.spec.agents)
    case.run.agents[0].type = 'pedestrian'
    brakes = {
        'id': 'e2',
        'trigger': {'on': 'arrives', 'who': 'car1', 'place': 'crosswalk'},
        'action': {'do': 'brake', 'agent': 'car2'},
    }
    case.spec = spec(agents=(person | {'type': 'pedestrian'}, car), events=(brakes,))
    return case


ROWS = (
    Row(id='e2.within', make=partial(_reaches, 10.5), margin=0.5, within=0.1, what='reaches'),
    # 15 m from its middle, where a car would be there, it has not reached it.
    Row(
        id='e2.within',
        make=partial(_reaches, 4.7),
        margin=1.0 - 10.05,
        within=0.1,
        what='comes-near',
    ),
    Row(
        id='e2.within',
        make=partial(_crosses, 'event_begun', 8.4),
        margin=1.0 - 0.4,
        within=0.06,
        what='steps-on',
    ),
    Row(
        id='e2.within',
        make=partial(_crosses, 'event_begun', _OVER_S),
        margin=1.0 - (_OVER_S - _STEPS_ON_S),
        within=0.06,
        what='only-when-over',
    ),
    Row(
        id='e2.within',
        make=partial(_crosses, 'event_done', _OVER_S + 0.4),
        margin=1.0 - 0.4,
        within=0.06,
        what='its-end',
    ),
    Row(
        id='e2.within',
        make=partial(_crosses, 'event_begun', 8.4, ever=False),
        reason=Reason.PREMISE_NEVER,
        what='never',
    ),
    Row(
        id='e2.within',
        make=partial(_walks_up_first, 8.4),
        margin=1.0 - 0.4,
        within=0.06,
        what='walks-up-first',
    ),
    Row(id='e2.within', make=partial(_slows, 8.4), margin=1.0 - 0.4, within=0.11, what='slows'),
    Row(
        id='e2.within',
        make=partial(_slows, 13.0),
        margin=1.0 - 5.0,
        within=0.11,
        what='stands-already',
    ),
)


@pytest.mark.parametrize('row', ROWS, ids=lambda row: row.name)
def test_what_waits_for_a_beginning(row: Row) -> None:
    row.check()
