# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The readers of the map's files take every field and refuse damaged ones."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from aurora_core.errors import MapError
from aurora_core.knowledge.map_files import (
    read_areas,
    read_buildings,
    read_landmarks,
    read_stops,
    read_zones,
)
from aurora_core.knowledge.map_model import MapModel

SQUARE = [[0, 0], [0, 10], [10, 10], [10, 0], [0, 0]]
HOLE = [[2, 2], [4, 2], [4, 4], [2, 4], [2, 2]]


def _write(folder: Path, *features: dict[str, Any], frame: str = 'enu_m') -> Path:
    path = folder / 'some.geojson'
    document = {'type': 'FeatureCollection', 'frame': frame, 'features': list(features)}
    path.write_text(json.dumps(document), encoding='utf-8')
    return path


def _building(**properties: Any) -> dict[str, Any]:
    base = {'id': 'b1', 'kind': 'house', 'height_m': 8.5, 'height_source': 'design'}
    return {
        'properties': base | properties,
        'geometry': {'type': 'Polygon', 'coordinates': [SQUARE, HOLE]},
    }


def test_building_rings_are_open_and_oriented(tmp_path: Path) -> None:
    (building,) = read_buildings(_write(tmp_path, _building(name='Shed')))
    # The file has the outline clockwise: it is turned; the hole is turned the other way.
    assert building.ring == ((10.0, 0.0), (10.0, 10.0), (0.0, 10.0), (0.0, 0.0))
    assert building.holes == (((2.0, 4.0), (4.0, 4.0), (4.0, 2.0), (2.0, 2.0)),)
    assert (building.height_m, building.height_source) == (8.5, 'design')
    assert (building.kind, building.name) == ('house', 'Shed')


def test_listings_are_sorted(tmp_path: Path) -> None:
    path = _write(tmp_path, _building(id='b2'), _building(id='b10'), _building(id='a'))
    assert [b.id for b in read_buildings(path)] == ['a', 'b10', 'b2']


def test_zones_and_areas_are_told_apart(tmp_path: Path) -> None:
    geometry = {'type': 'Polygon', 'coordinates': [SQUARE]}
    closed = {'id': 'z', 'name': 'Z', 'kind': 'no_fly', 'floor_m': 10, 'ceiling_m': 90}
    park = {'id': 'p', 'name': 'P', 'kind': 'park'}
    path = _write(
        tmp_path,
        {'properties': park, 'geometry': geometry},
        {'properties': closed, 'geometry': geometry},
    )
    (zone,) = read_zones(path)
    assert (zone.id, zone.floor_m, zone.ceiling_m) == ('z', 10.0, 90.0)
    (area,) = read_areas(path)
    assert (area.id, area.kind) == ('p', 'park')


@pytest.mark.parametrize(
    ('feature', 'reason'),
    [
        (_building(height_m=0), 'height 0.0 m'),
        (_building(height_m=float('nan')), 'height nan'),
        (_building(height_m='tall'), 'could not convert'),
        ({'properties': {'id': 'b1'}, 'geometry': {}}, 'height_m'),
        (_building() | {'geometry': {'type': 'Point', 'coordinates': [0, 0]}}, 'expected Polygon'),
        (
            _building() | {'geometry': {'type': 'Polygon', 'coordinates': [[[0, 0], [1, 1]]]}},
            'fewer than three points',
        ),
    ],
)
def test_damaged_buildings_are_refused(
    tmp_path: Path, feature: dict[str, Any], reason: str
) -> None:
    with pytest.raises(MapError, match=reason) as caught:
        read_buildings(_write(tmp_path, feature))
    assert 'some.geojson' in caught.value.message
    assert 'make maps' in caught.value.hint


def test_degrees_instead_of_metres_are_refused(tmp_path: Path) -> None:
    with pytest.raises(MapError, match="expected 'enu_m'"):
        read_buildings(_write(tmp_path, _building(), frame='EPSG:4326'))


def test_two_of_one_id_are_refused(tmp_path: Path) -> None:
    with pytest.raises(MapError, match='b1 is there twice'):
        read_buildings(_write(tmp_path, _building(), _building()))


def test_zone_with_its_ceiling_under_its_floor_is_refused(tmp_path: Path) -> None:
    zone = {'id': 'z', 'name': 'Z', 'kind': 'no_fly', 'floor_m': 50, 'ceiling_m': 20}
    geometry = {'type': 'Polygon', 'coordinates': [SQUARE]}
    with pytest.raises(MapError, match=r'from 50\.0 to 20\.0 m'):
        read_zones(_write(tmp_path, {'properties': zone, 'geometry': geometry}))


def test_landmark_without_an_approach_is_refused(tmp_path: Path, junction: MapModel) -> None:
    feature = {
        'properties': {'name': 'N', 'kind': 'park'},
        'geometry': {'type': 'Point', 'coordinates': [1, 2]},
    }
    with pytest.raises(MapError, match='approach_lane_id'):
        read_landmarks(_write(tmp_path, feature), junction.network)


def test_landmark_beside_the_end_of_its_lane_is_refused(
    tmp_path: Path, junction: MapModel
) -> None:
    lane = junction.network.driving_lanes('passenger')[0]
    where = {'approach_lane_id': lane.id, 'approach_pos_m': lane.length_m + 0.01}
    feature = {
        'properties': {'name': 'N', 'kind': 'park'} | where,
        'geometry': {'type': 'Point', 'coordinates': [1, 2]},
    }
    with pytest.raises(MapError, match='N: position'):
        read_landmarks(_write(tmp_path, feature), junction.network)


def test_missing_file_is_refused(tmp_path: Path) -> None:
    with pytest.raises(MapError, match='No such file'):
        read_buildings(tmp_path / 'none.geojson')


def test_stops_and_parking_rows(tmp_path: Path, junction: MapModel) -> None:
    path = tmp_path / 'stops.add.xml'
    path.write_text(
        '<additional>'
        '<busStop id="s" name="S" lane="long_street_1_eb_1" startPos="10" endPos="30"/>'
        '<parkingArea id="p" name="P" lane="cross_street_1_nb_1" startPos="20" endPos="40"'
        ' roadsideCapacity="2" width="2.7" length="10"/>'
        '</additional>',
        encoding='utf-8',
    )
    (stop,), (row,) = read_stops(path, junction.network)
    assert (stop.lane_id, stop.start_pos_m, stop.end_pos_m) == ('long_street_1_eb_1', 10.0, 30.0)
    # Lane centre at x = 1.65 heading north, half a lane (1.65) and half a place (1.35) further.
    assert [(p.x_m, p.y_m) for p in row.places] == [
        pytest.approx((4.65, -125.0)),
        pytest.approx((4.65, -115.0)),
    ]
    assert (row.places[0].heading_east, row.places[0].heading_north) == pytest.approx((0.0, 1.0))


@pytest.mark.parametrize(
    ('element', 'reason'),
    [
        ('<busStop id="s" lane="nowhere_0" startPos="1" endPos="9"/>', 'nowhere_0'),
        ('<busStop id="s" lane="long_street_1_eb_1" startPos="1" endPos="900"/>', '900'),
        ('<busStop id="s" lane="long_street_1_eb_1" startPos="1"/>', 'endPos'),
        ('<busStop id="s"', 'not well-formed'),
    ],
)
def test_damaged_stops_are_refused(
    tmp_path: Path, junction: MapModel, element: str, reason: str
) -> None:
    path = tmp_path / 'stops.add.xml'
    path.write_text(f'<additional>{element}</additional>', encoding='utf-8')
    with pytest.raises(MapError, match=reason):
        read_stops(path, junction.network)
