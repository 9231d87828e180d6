# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Agent types: the table for planning and the types for the simulator say the same."""

from __future__ import annotations

import json
from typing import Any
from xml.etree import ElementTree as Xml

from aurora_core.knowledge.config_files import config_path

SAME = {
    'length': 'length_m',
    'width': 'width_m',
    'height': 'height_m',
    'maxSpeed': 'max_speed_mps',
    'accel': 'accel_mps2',
    'decel': 'decel_mps2',
    'emergencyDecel': 'emergency_decel_mps2',
    'tau': 'headway_s',
    'minGap': 'min_gap_m',
}
VOCABULARY = {
    'car',
    'rsu',
    'truck',
    'bus',
    'van',
    'motorcycle',
    'bicycle',
    'pedestrian',
    'police',
    'ambulance',
    'firetruck',
}


def _table() -> dict[str, dict[str, Any]]:
    text = config_path('knowledge', 'agent_types.json').read_text(encoding='utf-8')
    return {row['name']: row for row in json.loads(text)['types']}


def _simulator_types() -> dict[str, Xml.Element]:
    root = Xml.parse(config_path('maps', 'vtypes.add.xml')).getroot()
    return {element.attrib['id']: element for element in root.iterfind('vType')}


def test_both_have_the_whole_vocabulary() -> None:
    assert set(_table()) == VOCABULARY
    assert set(_simulator_types()) == VOCABULARY


def test_both_say_the_same() -> None:
    types = _simulator_types()
    for name, row in _table().items():
        assert types[name].attrib['vClass'] == row['vclass']
        for attribute, field in SAME.items():
            assert float(types[name].attrib[attribute]) == row[field], (name, field)
    assert [name for name, row in _table().items() if row['is_person']] == ['pedestrian', 'rsu']


def test_motion_has_no_chance_and_nobody_runs_red_lights() -> None:
    for name, element in _simulator_types().items():
        attributes = element.attrib
        assert float(attributes['sigma']) == 0.0, name
        assert float(attributes['speedDev']) == 0.0, name
        assert float(attributes['speedFactor']) == 1.0, name
        assert element.find('param') is None, name


def test_limits_of_the_contract_can_be_reached() -> None:
    table = _table()
    assert table['car']['max_speed_mps'] >= 50.0
    assert table['pedestrian']['max_speed_mps'] == 3.0
    # "brake" means at least 4 m/s² for every motor vehicle.
    for name, row in table.items():
        if name not in ('bicycle', 'pedestrian', 'rsu'):
            assert row['decel_mps2'] >= 4.0, name
