# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The reader takes every fact from a network file and refuses what is not one."""

from __future__ import annotations

import gzip
from pathlib import Path

import pytest

from aurora_core.errors import MapError
from aurora_core.knowledge.net_reader import VEHICLE_CLASSES, read_network

TINY = """<net version="1.20">
  <location netOffset="0,0" projParameter="+proj=tmerc"/>
  <edge id=":c_0" function="internal">
    <lane id=":c_0_0" index="0" disallow="pedestrian" speed="8" length="4.00" shape="50,0 54,0"/>
  </edge>
  <edge id=":c_1" function="internal">
    <lane id=":c_1_0" index="0" speed="8" length="6.00" shape="54,0 60,0"/>
  </edge>
  <edge id=":c_c0" function="crossing" crossingEdges="b a">
    <lane id=":c_c0_0" index="0" allow="pedestrian" speed="1" length="8" width="4"
      shape="52,-4 52,4"/>
  </edge>
  <edge id=":c_w0" function="walkingarea">
    <lane id=":c_w0_0" index="0" allow="pedestrian" speed="1" length="1" shape="50,4 54,4 54,6"/>
  </edge>
  <edge id="a" from="west" to="c" name="Main Street" priority="3">
    <lane id="a_0" index="0" allow="pedestrian" speed="10" length="50" width="2"
      shape="0,-3 50,-3"/>
    <lane id="a_1" index="1" disallow="all" speed="10" length="50" shape="0,-1 0,-1 50,-1"/>
    <lane id="a_2" index="2" disallow="pedestrian tram" speed="10" length="50" shape="0,0 50,0"/>
  </edge>
  <edge id="b" from="c" to="east" priority="3">
    <lane id="b_0" index="0" speed="10" length="40.00" shape="60,0 100,0"/>
  </edge>
  <junction id="c" type="traffic_light" x="55" y="0" shape="50,-5 60,-5 60,5 50,5"/>
  <junction id="east" type="dead_end" x="100" y="0" shape=""/>
  <junction id=":c_1_0" type="internal" x="54" y="0"/>
  <connection from="a" to="b" fromLane="2" toLane="0" via=":c_0_0" tl="c"
    linkIndex="3" dir="l" state="o"/>
  <connection from=":c_0" to="b" fromLane="0" toLane="0" via=":c_1_0" dir="l" state="m"/>
  <connection from=":c_1" to="b" fromLane="0" toLane="0" dir="l" state="M"/>
  <connection from=":c_w0" to=":c_c0" fromLane="0" toLane="0" dir="s" state="M"/>
</net>
"""


def _write(folder: Path, text: str) -> Path:
    path = folder / 'tiny.net.xml.gz'
    path.write_bytes(gzip.compress(text.encode()))
    return path


def test_reads_lanes_permissions_and_neighbours(tmp_path: Path) -> None:
    lanes = {lane.id: lane for lane in read_network(_write(tmp_path, TINY)).lanes}
    assert lanes['a_0'].allows == {'pedestrian'}
    assert lanes['a_1'].allows == frozenset()
    assert lanes['a_2'].allows == VEHICLE_CLASSES - {'pedestrian', 'tram'}
    assert lanes['b_0'].allows == VEHICLE_CLASSES
    assert lanes['a_1'].polyline == ((0.0, -1.0), (50.0, -1.0))
    assert (lanes['a_1'].right_lane_id, lanes['a_1'].left_lane_id) == ('a_0', 'a_2')
    assert (lanes['a_2'].right_lane_id, lanes['a_2'].left_lane_id) == ('a_1', None)
    assert lanes[':c_0_0'].is_internal
    assert lanes['a_2'].width_m == 3.2


def test_joins_the_lanes_inside_a_junction(tmp_path: Path) -> None:
    (link,) = read_network(_write(tmp_path, TINY)).connections
    assert link.via_lane_ids == (':c_0_0', ':c_1_0')
    assert (link.from_lane_id, link.to_lane_id, link.direction) == ('a_2', 'b_0', 'l')
    assert (link.signal_id, link.signal_index) == ('c', 3)


def test_reads_crossings_junctions_and_names(tmp_path: Path) -> None:
    data = read_network(_write(tmp_path, TINY))
    (crossing,) = data.crossings
    assert crossing.edge_ids == ('a', 'b')
    assert crossing.junction_id == 'c'
    assert crossing.has_priority
    assert not crossing.has_signal
    assert set(crossing.polygon) == {(50.0, -4.0), (54.0, -4.0), (54.0, 4.0), (50.0, 4.0)}
    assert [(j.id, j.has_signal) for j in data.junctions] == [('c', True), ('east', False)]
    assert [e.id for e in data.edges if not e.is_internal] == ['a', 'b']
    assert next(e for e in data.edges if e.id == 'a').street_name == 'Main Street'
    assert data.walking_areas == (((50.0, 4.0), (54.0, 4.0), (54.0, 6.0)),)


@pytest.mark.parametrize(
    ('old', 'new', 'reason'),
    [
        ('<net version="1.20">', '<nett>', 'mismatched tag'),
        ('shape="60,0 100,0"', 'shape=""', 'no points'),
        ('length="40.00"', 'length="long"', 'could not convert'),
        ('<lane id=":c_w0_0"', '<line id=":c_w0_0"', 'no lane'),
        (' to="b" fromLane="2"', ' to="b"', 'fromLane'),
    ],
)
def test_damaged_networks_are_refused(tmp_path: Path, old: str, new: str, reason: str) -> None:
    assert old in TINY
    with pytest.raises(MapError, match=reason) as caught:
        read_network(_write(tmp_path, TINY.replace(old, new)))
    assert 'tiny.net.xml.gz' in caught.value.message


def test_other_documents_missing_files_and_broken_compression_are_refused(tmp_path: Path) -> None:
    with pytest.raises(MapError, match='expected <net>'):
        read_network(_write(tmp_path, '<routes/>'))
    with pytest.raises(MapError, match='No such file'):
        read_network(tmp_path / 'none.net.xml')
    truncated = tmp_path / 'cut.net.xml.gz'
    truncated.write_bytes(gzip.compress(TINY.encode())[:-40])
    with pytest.raises(MapError, match='make maps'):
        read_network(truncated)
