# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Agent types: complete, measured of what is installed, or one clear line."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any
from xml.etree import ElementTree as Xml

import pytest

from aurora_core.errors import ConfigError
from aurora_core.knowledge.agent_types import RECORDS, load_agent_types
from aurora_core.knowledge.config_files import config_path
from aurora_core.spec.vocabulary import AgentType

# Attribute of a vehicle type -> what was measured of it.
DECLARED = {
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


@pytest.fixture
def records(config: Path) -> Path:
    return config.joinpath(*RECORDS)


def _change(path: Path, change: Any) -> None:
    table = json.loads(path.read_text(encoding='utf-8'))
    change(table)
    path.write_text(json.dumps(table), encoding='utf-8')


def _declared() -> dict[str, Xml.Element]:
    root = Xml.parse(config_path('maps', 'vtypes.add.xml')).getroot()
    return {element.attrib['id']: element for element in root.iterfind('vType')}


def test_every_type_of_the_vocabulary_has_a_record() -> None:
    types = load_agent_types()
    assert set(types) == {t.value for t in AgentType} == set(_declared())
    assert list(types) == sorted(types)
    assert types['bus'].length_m > types['car'].length_m > types['motorcycle'].length_m
    assert [n for n, record in types.items() if record.is_person] == ['pedestrian', 'rsu']


def test_vehicles_were_measured_to_do_what_their_types_declare() -> None:
    for name, record in load_agent_types().items():
        declared = _declared()[name].attrib
        assert declared['vClass'] == record.vclass
        for attribute, field in DECLARED.items():
            # Walkers change their speed within a step, whatever their type declares.
            if not (record.is_person and attribute in ('accel', 'decel')):
                value = getattr(record, field)
                assert value == pytest.approx(float(declared[attribute]), abs=1e-3), (name, field)


def test_motion_has_no_chance_and_nobody_runs_red_lights() -> None:
    for name, element in _declared().items():
        attributes = element.attrib
        assert float(attributes['sigma']) == 0.0, name
        assert float(attributes['speedDev']) == 0.0, name
        assert float(attributes['speedFactor']) == 1.0, name
        assert element.find('param') is None, name


def test_limits_of_the_contract_can_be_reached() -> None:
    types = load_agent_types()
    assert types['car'].max_speed_mps >= 50.0
    assert types['pedestrian'].max_speed_mps == 3.0
    # "brake" means at least 4 m/s² for every motor vehicle.
    for name, record in types.items():
        if name not in ('bicycle', 'pedestrian', 'rsu'):
            assert record.decel_mps2 >= 4.0, name


@pytest.mark.parametrize(
    ('change', 'named'),
    [
        (lambda t: t['types'][0].update(length_m=0.0), 'length_m'),
        (lambda t: t['types'][0].update(width_m='wide'), 'width_m'),
        (lambda t: t['types'][0].pop('vclass'), 'vclass'),
        (lambda t: t['types'][0].update(height_m=float('inf')), 'height_m'),
        (lambda t: t['types'][0].update(wheels=4), 'wheels'),
        (lambda t: t.pop('types'), 'types'),
        (lambda t: t.update(types=3), 'types'),
        (lambda t: t.pop('made_of'), 'made_of'),
        (lambda t: t['types'].append(t['types'][0]), 'types repeats a name'),
        (
            lambda t: t.update(types=[r for r in t['types'] if r['name'] != 'bus']),
            'types lacks bus',
        ),
    ],
)
def test_a_bad_record_is_named(records: Path, change: Any, named: str) -> None:
    _change(records, change)
    with pytest.raises(ConfigError) as caught:
        load_agent_types()
    assert named in caught.value.message
    assert 'agent_types.json' in caught.value.message


@pytest.mark.parametrize('data', [b'', b'[]', b'null', b'\xff'])
def test_what_is_no_table_is_refused(records: Path, data: bytes) -> None:
    records.write_bytes(data)
    with pytest.raises(ConfigError, match='is not valid'):
        load_agent_types()


def test_a_file_that_cannot_be_read(records: Path) -> None:
    records.unlink()
    records.mkdir()
    with pytest.raises(ConfigError, match='cannot be read'):
        load_agent_types()


def test_records_of_other_vehicle_types_are_refused(config: Path) -> None:
    vtypes = config / 'maps' / 'vtypes.add.xml'
    vtypes.write_text(vtypes.read_text().replace('maxSpeed="36.00"', 'maxSpeed="20.00"'))
    with pytest.raises(ConfigError, match='measured with vtypes_sha256') as caught:
        load_agent_types()
    assert caught.value.hint.startswith('measure again: aurora map measure downtown')


@pytest.mark.parametrize(('name', 'value'), [('simulator', '1.0.0'), ('dt_s', 0.1)])
def test_records_of_another_simulator_or_step_are_refused(
    records: Path, name: str, value: object
) -> None:
    _change(records, lambda t: t['made_of'].update({name: value}))
    with pytest.raises(ConfigError, match=f'measured with {name} {value}, here is'):
        load_agent_types()


def test_without_a_simulator_its_version_is_not_asked_for(
    records: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    _change(records, lambda t: t['made_of'].update(simulator='1.0.0'))
    monkeypatch.setattr('aurora_core.knowledge.measured_on.simulator_version', lambda: '')
    assert load_agent_types()
