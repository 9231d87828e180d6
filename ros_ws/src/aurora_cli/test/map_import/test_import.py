# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""A file becomes a map that every command takes by its name."""

from __future__ import annotations

import json
import math
from collections.abc import Callable
from pathlib import Path
from types import SimpleNamespace

import osmium
import pyproj
import pytest

from aurora_cli.testing.small_maps import LAT, LON, STEP_LAT, STEP_LON, xodr
from aurora_core.knowledge.map_folders import list_maps, map_folder
from aurora_core.knowledge.map_model import MapModel, load_map
from aurora_core.parsing.landmarks import landmark_phrases

Call = Callable[..., SimpleNamespace]


def _imported(call: Call, file: Path, name: str) -> MapModel:
    done = call('map', 'import', str(file), '--name', name)
    assert done.code == 0, done.err
    return load_map(name)


@pytest.fixture
def city(own: Path, files: SimpleNamespace, call: Call) -> MapModel:
    done = call('map', 'import', str(files.osm), '--json')
    assert done.code == 0, done.err
    facts = json.loads(done.out)
    assert facts['name'] == 'small_city'  # of the file's name
    assert {'read', 'roads', 'buildings', 'places', 'write', 'load'} <= facts['seconds'].keys()
    return load_map('small_city')


def test_streets_signals_and_walkways_are_there(city: MapModel) -> None:
    network = city.network
    assert {'Row 0', 'Row 1', 'Row 2', 'Läntinen 0'} <= set(network.street_names)
    assert sum(j.has_signal for j in network.junctions.values()) == 1
    assert network.sidewalks
    assert network.crossings
    assert any(lane.left_lane_id for lane in network.driving_lanes('passenger'))


def test_north_of_the_map_is_true_north(city: MapModel) -> None:
    """A point of the extract is where a vehicle that flies by latitude and longitude finds it."""
    here = pyproj.Transformer.from_crs('EPSG:4326', city.projection, always_xy=True)
    x, y = here.transform(LON + STEP_LON, LAT + STEP_LAT)  # the junction with the signal
    (light,) = (j for j in city.network.junctions.values() if j.has_signal)
    assert math.hypot(light.x_m - x, light.y_m - y) < 2.0
    x2, y2 = here.transform(LON + STEP_LON, LAT + 2.0 * STEP_LAT)  # due north of it
    assert abs(math.degrees(math.atan2(x2 - x, y2 - y))) < 0.02
    assert city.origin_lat_deg == pytest.approx(LAT + STEP_LAT, abs=1e-3)


def test_lanes_count_as_long_as_they_are(city: MapModel) -> None:
    """Else a vehicle moves at another speed than it is said to."""
    edges = [edge for edge in city.network.edges.values() if not edge.is_internal]
    for edge in edges:
        lanes = [city.network.lane(name) for name in edge.lane_ids]
        driven_m = [lane.arc_length_m for lane in lanes if lane.allows != {'pedestrian'}]
        assert edge.length_m == pytest.approx(sum(driven_m) / len(driven_m), abs=0.01)


def test_heights_come_with_their_source(city: MapModel) -> None:
    by_source = {b.height_source: b for b in city.buildings if b.name != 'Saint Anna Hospital'}
    assert by_source['height tag'].height_m in (12.5, 20.0)
    assert by_source['levels'].height_m in (12.0, 6.0)
    assert by_source['default of its kind'].height_m == 3.0
    named = {b.name: b for b in city.buildings}
    assert named['Grönqvist House'].height_m == 12.5
    assert named['Saint Anna Hospital'].height_source == 'default'
    assert len(named['Taxi'].holes) == 1
    # The one below ground is not there; the one across a street is cut in two.
    assert len(city.buildings) == 7


def test_no_building_stands_on_a_street(city: MapModel) -> None:
    import shapely

    for building in city.buildings:
        assert not shapely.Polygon(building.ring).intersects(city.network.carriageway)


def test_places_have_a_lane_that_reaches_them(city: MapModel) -> None:
    marks = {mark.name: mark for mark in city.landmarks}
    kinds = {name: mark.kind for name, mark in marks.items()}
    # The station has the name of the town: all of it is `in Smallham`.
    assert kinds == {
        'Corn Market': 'square',
        'Saint Anna Hospital': 'hospital',
        'Meadow Park': 'park',
        'Grönqvist House': 'building',
        'Old Town Museum'.replace('Old Town', 'OldTown'): 'museum',
    }
    lane = city.network.lane(marks['Meadow Park'].approach_lane_id)
    assert 'passenger' in lane.allows
    # Shoe Lane is as closed a way as Corn Market, but ten times as long as wide: a street.
    assert sorted(area.name for area in city.areas) == ['Corn Market', 'Meadow Park']
    (stop,) = city.bus_stops
    assert city.network.edge(city.network.lane(stop.lane_id).edge_id).street_name == 'Row 1'


def test_a_name_that_means_something_else_does_not_take_it_over() -> None:
    phrases = landmark_phrases(('Old Car', 'Central Station'))
    assert ('car',) not in phrases
    assert phrases[('station',)] == 'Central Station'
    assert phrases[('old', 'car')] == 'Old Car'


def test_importing_twice_gives_the_same_digest(
    city: MapModel, files: SimpleNamespace, call: Call
) -> None:
    again = _imported(call, files.osm, 'again')
    for file in ('net.xml.gz', 'buildings.geojson', 'landmarks.geojson'):
        assert (again.folder / file).read_bytes() == (city.folder / file).read_bytes()
    text = (city.folder / 'net.xml.gz').read_bytes()
    assert str(files.folder).encode() not in text


def test_pbf_gives_the_roads_and_buildings_that_xml_gives(
    city: MapModel, own: Path, files: SimpleNamespace, call: Call
) -> None:
    packed = files.folder / 'packed.osm.pbf'
    with osmium.SimpleWriter(str(packed)) as writer:
        for element in osmium.FileProcessor(str(files.osm)):
            writer.add(element)
    model = _imported(call, packed, 'packed')
    assert model.network.edges.keys() == city.network.edges.keys()
    assert [(m.name, m.x_m) for m in model.landmarks] == [(m.name, m.x_m) for m in city.landmarks]
    heights = [(b.id, b.height_m, len(b.ring), len(b.holes)) for b in city.buildings]
    assert [(b.id, b.height_m, len(b.ring), len(b.holes)) for b in model.buildings] == heights


def test_a_prompt_runs_and_is_verified_on_it(city: MapModel, here: Path, call: Call) -> None:
    prompt = (
        'A scenario of 40 seconds. A drone hovers over Meadow Park at 20 meters for 5 seconds.'
    )
    assert call('check', prompt, '--map', city.name).code == 0
    done = call('run', prompt, '--map', city.name, '--json')
    report = json.loads(done.out)
    assert report['status'] == 'verified', done.err
    folder = here / 'runs' / report['run_id']
    assert call('verify', str(folder)).code == 0
    manifest = json.loads((folder / 'manifest.json').read_text())
    assert manifest['request']['map_name'] == city.name
    assert report['map'] == city.name
    assert city.digest in (folder / 'grounding.0.json').read_text()


def test_a_bag_is_judged_without_its_map(
    city: MapModel, here: Path, call: Call, monkeypatch: pytest.MonkeyPatch
) -> None:
    prompt = (
        'A scenario of 40 seconds. A drone hovers at 20 meters over the ego car for 5 seconds.'
    )
    report = json.loads(call('run', prompt, '--map', city.name, '--json').out)
    monkeypatch.setenv('AURORA_MAPS', str(here / 'elsewhere'))
    folder = str(here / 'runs' / report['run_id'])
    assert call('verify', folder).code == 4  # said, never silent: the map is not here
    done = call('verify', folder, '--as-recorded')
    assert done.code == 0, done.out + done.err


def test_a_sumo_network_keeps_what_it_has(own: Path, files: SimpleNamespace, call: Call) -> None:
    model = _imported(call, files.net, 'junction2')
    bundled = load_map('junction')
    assert model.network.street_names == bundled.network.street_names
    assert len(model.network.crossings) == len(bundled.network.crossings)
    assert len(model.network.sidewalks) == len(bundled.network.sidewalks)
    assert model.origin_lat_deg == pytest.approx(bundled.origin_lat_deg, abs=1e-4)
    assert not model.buildings
    assert model.licence == 'NOASSERTION'


@pytest.mark.parametrize('walkways', [True, False])
def test_opendrive_becomes_streets_about_its_middle(
    own: Path, files: SimpleNamespace, call: Call, walkways: bool
) -> None:
    files.xodr.write_text(xodr(walkways=walkways))
    done = call('map', 'import', str(files.xodr))
    assert done.code == 0, done.err
    assert ('guessed by netconvert' in done.out) is not walkways
    assert 'the file names none' in done.out
    model = load_map('road')
    assert model.network.street_names == ('Long Road',)
    assert model.network.sidewalks
    west, south, east, north = model.bounds_m
    assert abs(west + east) < 10.0
    assert abs(south + north) < 10.0
    (edge,) = (e for e in model.network.edges.values() if e.length_m > 250.0 and '-' not in e.id)
    (ax, ay), *_, (bx, by) = model.network.lane(edge.lane_ids[-1]).polyline
    assert math.atan2(by - ay, bx - ax) % math.pi == pytest.approx(0.5, abs=1e-3)


def test_own_maps_are_listed_and_examined(
    city: MapModel, files: SimpleNamespace, call: Call
) -> None:
    _imported(call, files.xodr, 'road')
    assert list_maps() == ('downtown', 'helsinki', 'junction', 'road', 'small_city')
    listed = json.loads(call('map', 'list', '--json').out)['maps']
    assert {entry['name']: entry['own'] for entry in listed}['road'] is True
    shown = json.loads(call('map', 'show', 'small_city', '--json').out)
    assert 'Meadow Park (park)' in shown['landmarks']
    done = call('map', 'doctor', 'road')
    assert done.code == 1
    for words in ('no buildings', 'no landmarks', 'no traffic light', 'two lanes'):
        assert words in done.out
    done = call('map', 'doctor', 'downtown')
    assert done.code == 0
    assert 'lacks nothing' in done.out
    assert call('map', 'doctor', 'atlantis').code == 64


def test_a_damaged_own_map_is_named_and_the_others_are_listed(city: MapModel, call: Call) -> None:
    (map_folder(city.name) / 'landmarks.geojson').write_text('{}')
    done = call('map', 'list', '--json')
    assert done.code == 0
    assert [m['name'] for m in json.loads(done.out)['maps']] == [
        'downtown',
        'helsinki',
        'junction',
    ]
    assert 'small_city' in done.err
    assert 'has changed' in done.err
