# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Conditions on the scene as a whole: satisfied, violated, not judged.

One car drives for 20 s, tick 0 to 400.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from kind_rows import Row, cut, gone, grounded
from trace_builder import DT_S, driver, number
from trace_cases import Case, convoy_case, ground_case, hover_case, spec, survey_case

from aurora_core.knowledge.world import CentreLine, Wind
from aurora_core.outcomes.verdict import Reason
from aurora_core.spec.parameter import Bound, Unit
from aurora_core.spec.scenario import Behavior
from aurora_core.spec.vocabulary import BehaviorKind
from aurora_core.trace.layout import UavColumn

T = 401
SHORT = Reason.TRACE_SHORT


def _drive(**values: object) -> Case:
    case = ground_case(Behavior(kind=BehaviorKind.DRIVE), np.full(T, 5.0))
    case.spec = spec(**{**dict(case.spec), **values})
    return case


def _also(case: Case, kind: str, role: str = 'other') -> Case:
    """Add a body that nobody asked for."""
    ticks = case.run.ticks
    case.run.agents.append(driver('more1', kind, 300.0, np.zeros(ticks), y=3.3, role=role))
    return case


def _other_type() -> Case:
    case = _drive()
    case.run.agents[0].type = 'bus'
    return case


def _closed(kind: str, value: float, bound: Bound = Bound.EXACTLY) -> Case:
    number_of = number(value, Unit.ONE, explicit=True, bound=bound)
    return _drive(counts=({'id': 'n1', 'kind': kind, 'value': number_of},))


def _without(kind: str) -> Case:
    return _drive(prohibitions=({'forbids': 'agent', 'id': 'no1', 'type': kind},))


def _in(weather: str, time_of_day: str) -> Case:
    """It was to rain at night."""
    case = _drive(world={'weather': 'rain', 'time_of_day': 'night'})
    case.world = replace(case.world, weather=weather, time_of_day=time_of_day)
    return case


def _not_in(setting: str, forbidden: str) -> Case:
    """It rains at dusk."""
    case = _drive(prohibitions=({'forbids': 'world', 'id': 'no1', setting: forbidden},))
    case.world = replace(case.world, weather='rain', time_of_day='dusk')
    return case


def _on_map(name: str) -> Case:
    case = _drive(world={'map_name': 'junction'})
    case.world = replace(case.world, map_name=name)
    return case


def _lasting(seconds: float) -> Case:
    return _drive(world={'duration_s': number(seconds, Unit.SECOND, explicit=True)})


def _traffic(cars: int, away_m: float = 100.0) -> Case:
    """600 m of one street are within 300 m, on which 3 cars per km are 1.8 cars: 2 are due."""
    case = _drive(world={'traffic_density': 'low'})
    line = np.array([(-1000.0, 0.0), (1000.0, 0.0)])
    lanes = tuple(
        CentreLine(
            lane_id=f'a_{k}', street_name='A', points=line + np.array([0.0, 3.3 * k]), width_m=3.3,
            speed_limit_mps=10.0,
        )
        for k in range(2)
    )  # fmt: skip
    case.world = replace(case.world, lanes=lanes)
    for k in range(cars):
        still = np.zeros(case.run.ticks)
        x = away_m + 10.0 * k
        case.run.agents.append(driver(f'more{k}', 'car', x, still, y=3.3, role='background'))
    return case


def _wind(east_mps: float, north_mps: float, case: Case | None = None, **asked: object) -> Case:
    """A wind is recorded, of which something was asked."""
    case = _drive() if case is None else case
    case.spec = spec(**{**dict(case.spec), 'world': asked})
    wind = Wind(mean_east_mps=east_mps, mean_north_mps=north_mps)
    case.world = replace(case.world, wind=wind)
    return case


def _blowing(speed_mps: float, bound: Bound = Bound.EXACTLY) -> Case:
    asked = number(5.0, Unit.METRE_PER_SECOND, explicit=True, bound=bound)
    return _wind(0.6 * speed_mps, -0.8 * speed_mps, wind_mps=asked)


def _from(from_deg: float, east_mps: float = 0.0, north_mps: float = -4.0) -> Case:
    return _wind(east_mps, north_mps, wind_from_deg=number(from_deg, Unit.DEGREE, explicit=True))


def _gusting(over_mps: float, asked_mps: float, bound: Bound = Bound.EXACTLY) -> Case:
    """A mean wind of 5 m/s, and gusts that exceed it."""
    asked = number(asked_mps, Unit.METRE_PER_SECOND, explicit=True, bound=bound)
    case = _wind(3.0, 4.0, gust_mps=asked)
    case.world = replace(case.world, wind=replace(case.world.wind, gust_mps=over_mps))
    return case


def _leaning(case: Case, east_mps: float, north_mps: float) -> Case:
    """Let who flies lean as it has to where the air goes so."""
    limits = case.world.limits
    for one in case.run.flights:
        velocity = one.states[:, UavColumn.VX : UavColumn.VZ + 1]
        gain = np.zeros_like(velocity)
        gain[1:-1] = (velocity[2:] - velocity[:-2]) / (2.0 * DT_S)
        air = velocity - (east_mps, north_mps, 0.0)
        speed = np.linalg.norm(air, axis=1)
        drag = (limits.uav_drag_hz + limits.uav_drag_per_m * speed)[:, None] * air
        up = gain[:, 2] + 9.80665 + drag[:, 2]
        axis = np.column_stack(((gain + drag)[:, :2] / up[:, None], np.ones(len(up))))
        axis /= np.linalg.norm(axis, axis=1)[:, None]
        half = np.sqrt((1.0 + axis[:, 2]) / 2.0)
        one.states[:, UavColumn.QW] = half
        one.states[:, UavColumn.QX] = -axis[:, 1] / (2.0 * half)
        one.states[:, UavColumn.QY] = axis[:, 0] / (2.0 * half)
    return case


def _blown(east_mps: float, north_mps: float) -> Case:
    """5 m/s to the east are asked for and recorded; who hovers leans against another wind."""
    asked = number(5.0, Unit.METRE_PER_SECOND, explicit=True)
    return _leaning(_wind(5.0, 0.0, hover_case(), wind_mps=asked), east_mps, north_mps)


def _shaken(gust_mps: float) -> Case:
    """Gusts of 4 m/s are asked for: every other second the air goes so fast, and back."""
    case = hover_case()
    asked = number(4.0, Unit.METRE_PER_SECOND, explicit=True)
    case.spec = spec(**{**dict(case.spec), 'world': {'gust_mps': asked}})
    case.world = replace(case.world, wind=Wind(gust_mps=4.0))
    still = _leaning(case, -gust_mps, 0.0).run.flights[0].states.copy()
    one = _leaning(case, gust_mps, 0.0).run.flights[0]
    back = np.arange(len(still)) // 20 % 2 == 1
    one.states[back] = still[back]
    return case


ROWS = (
    # 0.5 m/s are allowed where no gusts are asked for, and the least of a gust is 0.4 of it.
    Row(id='world.wind_blown.uav1', make=lambda: _blown(5.0, 0.3), margin=0.2, within=1e-3),
    Row(id='world.wind_blown.uav1', make=lambda: _blown(0.0, 0.0), margin=-4.5, within=1e-3),
    Row(
        id='world.wind_blown.uav1',
        make=lambda: _blown(-5.0, 0.0),
        margin=-9.5,
        within=1e-3,
        what='turned',
    ),
    Row(
        id='world.wind_blown.uav1',
        make=lambda: grounded(_blown(5.0, 0.0)),
        reason=Reason.EMPTY_PHASE,
    ),
    Row(id='world.gust_blown.uav1', make=lambda: _shaken(3.0), margin=1.4, within=0.1),
    Row(id='world.gust_blown.uav1', make=lambda: _shaken(0.0), margin=-1.6, within=0.05),
    Row(
        id='world.gust_blown.uav1',
        make=lambda: grounded(_shaken(3.0)),
        reason=Reason.EMPTY_PHASE,
    ),
    # 1 % is allowed.
    Row(id='world.gust_speed', make=lambda: _gusting(3.0, 8.0), margin=0.08),
    Row(id='world.gust_speed', make=lambda: _gusting(0.0, 8.0), margin=0.08 - 8.0),
    Row(
        id='world.gust_speed',
        make=lambda: _gusting(1.0, 8.0, Bound.AT_MOST),
        margin=0.08 - 2.0,
        what='up-to',
    ),
    Row(id='world.gust_speed', make=lambda: cut(_gusting(3.0, 8.0), 200), reason=SHORT),
    Row(id='world.wind_speed', make=lambda: _blowing(5.0), margin=0.05),
    Row(id='world.wind_speed', make=lambda: _blowing(6.0), margin=0.05 - 1.0),
    Row(id='world.wind_speed', make=lambda: cut(_blowing(5.0), 200), reason=SHORT),
    Row(
        id='world.wind_speed',
        make=lambda: _blowing(6.0, Bound.AT_LEAST),
        margin=1.0,
        what='at-least',
    ),
    # The air goes south: it comes from the north. 15 degrees are allowed.
    Row(id='world.wind_from', make=lambda: _from(350.0), margin=15.0 - 10.0),
    Row(id='world.wind_from', make=lambda: _from(90.0), margin=15.0 - 90.0),
    Row(id='world.wind_from', make=lambda: _from(0.0, 0.0, 0.0), margin=-165.0, what='still'),
    Row(id='world.wind_from', make=lambda: cut(_from(0.0), 200), reason=SHORT),
    # The first of the two long legs of the rectangle goes east, 45 degrees are allowed.
    Row(
        id='world.wind_course',
        make=lambda: _wind(4.0, 0.0, survey_case(), wind='tailwind'),
        margin=45.0,
        what='tailwind',
    ),
    Row(
        id='world.wind_course',
        make=lambda: _wind(4.0, 0.0, survey_case(), wind='headwind'),
        margin=45.0 - 180.0,
        what='headwind',
    ),
    Row(
        id='world.wind_course',
        make=lambda: _wind(-3.0, 3.0, survey_case(), wind='crosswind'),
        margin=0.0,
        what='crosswind',
        within=1e-6,
    ),
    # The bus drives east when it is captured.
    Row(
        id='world.wind_course',
        make=lambda: _wind(-4.0, 0.0, convoy_case(), wind='headwind'),
        margin=45.0,
        what='track',
    ),
    Row(
        id='world.wind_course',
        make=lambda: _wind(0.0, 4.0, convoy_case(), wind='headwind'),
        margin=45.0 - 90.0,
        what='track',
    ),
    Row(
        id='world.wind_course',
        make=lambda: gone(_wind(-4.0, 0.0, convoy_case(), wind='headwind'), 1, 50),
        reason=Reason.TARGET_GONE,
        what='track',
    ),
    # Who hovers has no course; without wind it has no crosswind either.
    Row(
        id='world.wind_course',
        make=lambda: _wind(4.0, 0.0, hover_case(), wind='crosswind'),
        margin=45.0,
        what='hover',
    ),
    Row(
        id='world.wind_course',
        make=lambda: _wind(0.0, 0.0, hover_case(), wind='crosswind'),
        margin=45.0 - 180.0,
        what='still',
    ),
    # 0.7 to 1.5 of what is due are allowed.
    Row(id='world.traffic', make=lambda: _traffic(2), margin=1.0 - 0.7),
    Row(id='world.traffic', make=lambda: _traffic(3), margin=0.0, what='three'),
    Row(id='world.traffic', make=lambda: _traffic(4), margin=1.5 - 2.0, what='four'),
    Row(id='world.traffic', make=lambda: _traffic(2, 400.0), margin=-0.7, what='far'),
    Row(id='world.traffic', make=lambda: cut(_traffic(2), 200), reason=SHORT),
    Row(id='scene.car', make=_drive, margin=0.0),
    Row(id='scene.car', make=lambda: _also(_drive(), 'car', 'background'), margin=0.0, what='bg'),
    Row(id='scene.car', make=lambda: _also(_drive(), 'car'), margin=-1.0, what='one-more'),
    Row(id='scene.car', make=_other_type, margin=-1.0, what='a-bus'),
    Row(id='scene.car', make=lambda: gone(_drive(), 0, 300), margin=-1.0, what='left'),
    Row(id='scene.car', make=lambda: cut(_drive(), 200), reason=SHORT),
    Row(id='scene.uav', make=hover_case, margin=0.0),
    Row(id='n1.holds', make=lambda: _closed('car', 1.0), margin=0.0),
    Row(id='n1.holds', make=lambda: _closed('vehicle', 2.0), margin=-1.0, what='too-few'),
    Row(
        id='n1.holds',
        make=lambda: _also(_closed('vehicle', 1.0), 'bus', 'background'),
        margin=-1.0,
        what='background',
    ),
    Row(
        id='n1.holds',
        make=lambda: _closed('body', 3.0, Bound.AT_MOST),
        margin=2.0,
        what='at-most',
    ),
    Row(id='no1.holds', make=lambda: _without('bus'), margin=0.0, what='no-bus'),
    Row(id='no1.holds', make=lambda: _also(_without('bus'), 'bus'), margin=-1.0, what='a-bus'),
    Row(id='n1.holds', make=lambda: cut(_closed('car', 1.0), 200), reason=SHORT),
    Row(id='world.weather', make=lambda: _in('rain', 'night'), margin=0.0),
    Row(id='world.weather', make=lambda: _in('clear', 'night'), margin=-1.0),
    Row(id='world.weather', make=lambda: cut(_in('rain', 'night'), 200), reason=SHORT),
    Row(id='no1.holds', make=lambda: _not_in('weather', 'snow'), margin=0.0),
    Row(id='no1.holds', make=lambda: _not_in('weather', 'rain'), margin=-1.0),
    Row(id='no1.holds', what='hour', make=lambda: _not_in('time_of_day', 'noon'), margin=0.0),
    Row(id='no1.holds', what='hour', make=lambda: _not_in('time_of_day', 'dusk'), margin=-1.0),
    Row(id='world.time_of_day', make=lambda: _in('rain', 'night'), margin=0.0),
    Row(id='world.time_of_day', make=lambda: _in('rain', 'noon'), margin=-1.0),
    Row(id='world.time_of_day', make=lambda: cut(_in('rain', 'night'), 200), reason=SHORT),
    Row(id='world.map_name', make=lambda: _on_map('junction'), margin=0.0),
    Row(id='world.map_name', make=lambda: _on_map('downtown'), margin=-1.0),
    Row(id='world.map_name', make=lambda: cut(_on_map('junction'), 200), reason=SHORT),
    # The run lasts 20 s; 0.5 s are allowed, of 30 s 0.6 s.
    Row(id='world.duration', make=lambda: _lasting(20.0), margin=0.5),
    Row(id='world.duration', make=lambda: _lasting(30.0), margin=0.6 - 10.0),
    Row(id='world.duration', make=lambda: cut(_lasting(20.0), 200), reason=SHORT),
)


@pytest.mark.parametrize('row', ROWS, ids=lambda row: row.name)
def test_scene_kinds(row: Row) -> None:
    row.check()
