# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""A run in other formats says the same as its trace."""

from __future__ import annotations

import csv
import io
import json
from dataclasses import replace
from types import SimpleNamespace
from typing import Any
from xml.etree.ElementTree import Element, fromstring

import jsonschema
import numpy as np
import pytest

from aurora_core.errors import ReportError
from aurora_core.geometry.frames import geodetic_to_enu
from aurora_core.report.export.flight_plan import TOLERANCE_M, flight_plan
from aurora_core.report.export.open_scenario import open_scenario
from aurora_core.report.export.sumo_folder import recorded_text
from aurora_core.report.export.tables import csv_text, tables_of
from aurora_core.report.export.thinning import kept_samples
from aurora_core.trace.layout import GroundColumn, UavColumn, UavCommandColumn, UavMode
from aurora_core.trace.trace import Trace


def test_a_thinned_motion_is_the_motion_at_every_time() -> None:
    times_s = np.linspace(0.0, 19.95, 400)
    x = np.where(times_s < 10.0, 5.0 * times_s, 50.0) + 0.3 * np.sin(3.0 * times_s)
    points = np.column_stack([x, np.cos(times_s)])
    kept = kept_samples(times_s, points, 0.5)
    assert kept[0] == 0
    assert kept[-1] == 399
    assert len(kept) < 40
    again = np.column_stack([np.interp(times_s, times_s[kept], points[kept, k]) for k in (0, 1)])
    assert np.linalg.norm(again - points, axis=1).max() <= 0.5
    # On one line, but not at one pace: the moment of the change is kept.
    kept = kept_samples(times_s, np.column_stack([np.minimum(times_s, 10.0)]), 0.01)
    assert [round(float(times_s[k]), 2) for k in kept] == [0.0, 10.0, 19.95]
    assert kept_samples(np.zeros(0), np.zeros((0, 2)), 1.0) == []


def test_tables_hold_every_state_to_the_last_bit(make: SimpleNamespace) -> None:
    trace = make.trace()
    trace.ground[7, 0, GroundColumn.X] = np.nan
    tables = {table.name: table for table in tables_of(trace, ())}
    rows = list(csv.DictReader(io.StringIO(csv_text(tables['states']))))
    assert len(rows) == trace.ticks
    assert rows[7]['motorcycle1.x_m'] == ''
    for tick in (0, 8, 250, 399):
        assert int(rows[tick]['tick']) == tick
        assert float(rows[tick]['time_s']) == tick * trace.roster.dt_s
        assert float(rows[tick]['uav1.z_m']) == trace.uav[tick, 0, UavColumn.Z]
        speed = trace.ground[tick, 0, GroundColumn.SPEED]
        assert float(rows[tick]['motorcycle1.speed_mps']) == speed
        phase = trace.uav_commands[tick, 0, UavCommandColumn.PHASE]
        assert float(rows[tick]['uav1.phase']) == phase
    told = list(csv.DictReader(io.StringIO(csv_text(tables['events']))))
    assert [row['kind'] for row in told] == ['phase', 'phase', 'released', 'phase']
    assert {table.name for table in tables_of(trace, ())} >= {'conditions', 'messages', 'sights'}


def _landing(trace: Trace) -> Trace:
    """The same flight with the command to land, as the executor gives it."""
    commands = trace.uav_commands.copy()
    commands[350:, 0, UavCommandColumn.MODE] = UavMode.LAND
    return replace(trace, uav_commands=commands)


def test_a_plan_goes_where_the_flight_went(make: SimpleNamespace) -> None:
    trace, world = _landing(make.trace()), make.world()
    plan = flight_plan(trace, world, 0)
    assert (plan['fileType'], plan['version']) == ('Plan', 1)
    items: list[dict[str, Any]] = plan['mission']['items']
    assert [item['doJumpId'] for item in items] == list(range(1, len(items) + 1))
    commands = [item['command'] for item in items]
    assert (commands[0], commands[-1]) == (22, 21)
    assert {16, 178} <= set(commands)
    corners = []
    for item in items:
        if item['command'] != 16:
            continue
        latitude, longitude, height_m = item['params'][4:]
        east, north = geodetic_to_enu(
            latitude, longitude, world.origin_lat_deg, world.origin_lon_deg
        )
        corners.append((east, north, height_m))
    flown = trace.uav[150:350, 0, UavColumn.X : UavColumn.VX]
    way = np.array(corners)
    ahead, start = np.diff(way, axis=0), way[:-1]
    for point in flown[::10]:
        share = ((point - start) * ahead).sum(axis=1) / np.maximum((ahead**2).sum(axis=1), 1e-9)
        near = start + np.clip(share, 0.0, 1.0)[:, None] * ahead
        assert np.linalg.norm(point - near, axis=1).min() <= TOLERANCE_M + 0.01


# What QGroundControl demands when it opens a plan, else it refuses the file. Source: its readers
# MissionController, MissionItem, SimpleMissionItem, GeoFenceController, RallyPointController.
_NUMBER = {'type': 'number'}
_MAYBE = {'type': ['number', 'null']}
_PLAN_OF_QGC = {
    'type': 'object',
    'required': ['fileType', 'version', 'groundStation', 'mission', 'geoFence', 'rallyPoints'],
    'properties': {
        'fileType': {'const': 'Plan'},
        'version': {'const': 1},
        'mission': {
            'required': ['version', 'plannedHomePosition', 'items', 'firmwareType'],
            'properties': {
                'version': {'const': 2},
                'plannedHomePosition': {'type': 'array', 'items': _NUMBER, 'minItems': 3},
                'firmwareType': _NUMBER,
                'vehicleType': _NUMBER,
                'cruiseSpeed': _NUMBER,
                'hoverSpeed': _NUMBER,
                'items': {
                    'items': {
                        'required': ['type', 'frame', 'command', 'params', 'autoContinue'],
                        'properties': {
                            'type': {'const': 'SimpleItem'},
                            'frame': _NUMBER,
                            'command': _NUMBER,
                            'autoContinue': {'type': 'boolean'},
                            'doJumpId': _NUMBER,
                            'params': {'items': _MAYBE, 'minItems': 7, 'maxItems': 7},
                            'AltitudeMode': _NUMBER,
                            'Altitude': _NUMBER,
                            'AMSLAltAboveTerrain': _MAYBE,
                        },
                        # One of the three asks for all.
                        'dependentRequired': {
                            key: ['AltitudeMode', 'Altitude', 'AMSLAltAboveTerrain']
                            for key in ('AltitudeMode', 'Altitude', 'AMSLAltAboveTerrain')
                        },
                    }
                },
            },
        },
        'geoFence': {
            'required': ['version', 'circles', 'polygons'],
            'properties': {'version': {'const': 2}},
        },
        'rallyPoints': {
            'required': ['version', 'points'],
            'properties': {'version': {'const': 2}},
        },
    },
}


def test_a_plan_has_all_that_qgroundcontrol_demands(make: SimpleNamespace) -> None:
    plan = json.loads(json.dumps(flight_plan(_landing(make.trace()), make.world(), 0)))
    jsonschema.validate(plan, _PLAN_OF_QGC, jsonschema.Draft202012Validator)


def test_a_stop_on_the_way_is_a_time_to_stay(make: SimpleNamespace) -> None:
    trace = _landing(make.trace())
    trace.uav[150:300, 0, : UavColumn.VX] = trace.uav[150, 0, : UavColumn.VX]
    items = flight_plan(trace, make.world(), 0)['mission']['items']
    stays = [item['params'][0] for item in items if item['command'] == 16 and item['params'][0]]
    assert sum(stays) == pytest.approx(7.45, abs=1.0)


def test_who_never_flies_has_no_plan(make: SimpleNamespace) -> None:
    trace = make.trace()
    trace.uav[:, 0, UavColumn.Z] = 0.0
    trace.uav[:, 0, UavColumn.LANDED] = 1.0
    with pytest.raises(ReportError, match='uav1 does not fly'):
        flight_plan(trace, make.world(), 0)


def _course(root: Element, name: str) -> tuple[Any, Any]:
    trajectory = next(t for t in root.iter('Trajectory') if t.get('name') == name)
    times, places = [], []
    for vertex in trajectory.iter('Vertex'):
        times.append(float(vertex.get('time', 'nan')))
        world = next(vertex.iter('WorldPosition'))
        places.append([float(world.get(k, 'nan')) for k in 'xyz'])
    return np.array(times), np.array(places)


def test_open_scenario_holds_where_everybody_is_when(make: SimpleNamespace) -> None:
    trace = make.trace()
    text = open_scenario(
        trace, name='r', prompt='a <b> "c"', date='2026-01-31T12:00:00Z', road_file='m.xodr'
    )
    root = fromstring(text)
    header = next(root.iter('FileHeader'))
    assert 'a <b> "c"' in str(header.get('description'))
    assert {e.get('name') for e in root.iter('ScenarioObject')} == {'motorcycle1', 'uav1'}
    assert next(root.iter('Vehicle')).get('vehicleCategory') == 'motorbike'
    times_s = np.arange(trace.ticks) * trace.roster.dt_s
    # The middle of the rear axle lies behind the middle of the box, which is told by its centre.
    back = float(next(root.iter('Center')).get('x', 'nan'))
    assert back == pytest.approx(0.3 * trace.roster.agents[0].length_m)
    for name, states, shift in (
        ('motorcycle1', trace.ground[:, 0, :2], back),
        ('uav1', trace.uav[:, 0, :2], 0.0),
    ):
        at, places = _course(root, name)
        east = np.interp(times_s, at, places[:, 0])
        assert np.abs(east - (states[:, 0] - shift)).max() <= 0.06
    stop = root.find('./Storyboard/StopTrigger')
    assert stop is not None
    assert float(next(stop.iter('SimulationTimeCondition')).get('value', 'nan')) == 19.95


def test_recorded_data_have_the_front_bumper_as_sumo_has(make: SimpleNamespace) -> None:
    trace = make.trace()
    trace.ground[200:, 0, GroundColumn.PRESENT] = 0.0
    steps = list(fromstring(recorded_text(trace)).iter('timestep'))
    assert len(steps) == trace.ticks
    (first,) = steps[0]
    assert (first.get('id'), first.get('angle')) == ('motorcycle1', '90.00')
    assert float(first.get('x', 'nan')) == pytest.approx(trace.ground[0, 0, 0] + 1.1, abs=0.01)
    assert len(steps[200]) == 0
