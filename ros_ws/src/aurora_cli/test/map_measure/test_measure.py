# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`aurora map measure`: all or nothing, the same each time, and what it says is then used."""

from __future__ import annotations

import json
import shutil
import sys
from collections.abc import Callable
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest

from aurora_cli import installed
from aurora_cli.doctor import data
from aurora_cli.doctor.machine import Machine
from aurora_cli.doctor.run import CHECKS
from aurora_cli.map_measure import measure
from aurora_cli.testing.small_maps import xodr
from aurora_core.knowledge.config_files import ENVIRONMENT_VARIABLE, config_root
from aurora_core.knowledge.map_model import load_map
from aurora_core.knowledge.uav_record import load_uav_record
from aurora_core.outcomes.grounded import GroundedScenario
from aurora_core.pipeline.background import registries
from aurora_core.pipeline.functions import parse_stage

Call = Callable[..., SimpleNamespace]
FAST_TRUCK = 'A truck drives at 15 m/s. A drone tracks it.'
TRUCK = 'A drone tracks a truck.'


@pytest.fixture
def shipped(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A copy of the shipped configuration that a test may change, in force."""
    return _in_force(config_root(), tmp_path, monkeypatch)


@pytest.fixture(scope='module')
def of_a_small_battery(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A configuration whose UAV is soon flown empty, measured on one map."""
    with pytest.MonkeyPatch.context() as patch:
        copy = _in_force(config_root(), tmp_path_factory.mktemp('small'), patch)
        _edit(copy / 'multirotor.json', '"battery_wh": 90.0', '"battery_wh": 9.0')
        _edit(copy / 'limits.json', '"uav_endurance_s": 1500.0', '"uav_endurance_s": 60.0')
        installed.forget()
        measure.measure(load_map('junction'), lambda _: None)
    installed.forget()
    return copy


@pytest.fixture
def config(of_a_small_battery: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A copy of that, in force: most of measuring is flying until a battery is empty."""
    return _in_force(of_a_small_battery, tmp_path, monkeypatch)


def _in_force(folder: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    copy = tmp_path / 'config'
    shutil.copytree(folder, copy, ignore_dangling_symlinks=True)
    monkeypatch.setenv(ENVIRONMENT_VARIABLE, str(copy))
    installed.forget()
    return copy


def _files(folder: Path) -> dict[str, bytes]:
    return {
        str(path.relative_to(folder)): path.read_bytes()
        for path in sorted(folder.rglob('*'))
        if path.is_file()
    }


def _edit(path: Path, old: str, new: str) -> None:
    text = path.read_text(encoding='utf-8')
    assert old in text
    path.write_text(text.replace(old, new), encoding='utf-8')


def _grounded(prompt: str) -> GroundedScenario:
    known = installed.installed()
    parsed = parse_stage(known, prompt, 'junction', 1).agsg
    assert parsed is not None
    found = known.grounder('junction').ground(parsed.spec, 1)
    assert isinstance(found, GroundedScenario)
    return found


def test_the_shipped_records_are_what_is_measured(shipped: Path, call: Call) -> None:
    knowledge = shipped / 'knowledge'
    before = _files(knowledge)
    shutil.rmtree(knowledge)
    done = call('map', 'measure', 'downtown', '--json')
    assert done.code == 0, done.err
    facts = json.loads(done.out)
    assert facts['records']['map_name'] == 'downtown'
    assert all(row['stands'] >= 0.98 * row['tried'] for row in facts['records']['spawns'])
    assert {'vehicles', 'multirotor', 'spawn points', 'walks'} <= facts['seconds'].keys()
    assert 'aurora: walks' in done.err
    for name in ('helsinki', 'junction'):
        # The flights are those of the first map.
        records = measure.measure(load_map(name), lambda _: None, again=False).records
        assert all(row.stands >= 0.98 * row.tried for row in records.spawns)
    assert set(_files(knowledge)) == set(before)
    for name, found in _files(knowledge).items():
        # Another zlib may pack the arrays differently; their digest is in the records.
        assert found == before[name] or name.endswith('.npz'), name


def test_measuring_again_changes_no_byte(config: Path, call: Call) -> None:
    first = call('map', 'measure', 'junction')
    before = _files(config)
    assert call('map', 'measure', 'junction').code == first.code == 0
    assert _files(config) == before
    assert 'car stands at' in first.out
    assert 'messages reach 500 m, past a wall 200 m' in first.out
    assert 'in force' not in first.out


def test_a_changed_vehicle_is_refused_until_measured_and_then_used(
    config: Path, call: Call
) -> None:
    before = _grounded(TRUCK).agents
    assert call('check', '--map', 'junction', FAST_TRUCK).code == 0
    _edit(
        config / 'maps' / 'vtypes.add.xml',
        'length="8.50" width="2.50" height="3.40" maxSpeed="36.00" accel="1.30"',
        'length="9.50" width="2.50" height="3.40" maxSpeed="12.00" accel="0.90"',
    )
    installed.forget()
    refused = call('check', '--map', 'junction', FAST_TRUCK)
    assert refused.code == 4
    assert 'measured with vtypes_sha256' in refused.out
    assert 'measure again: aurora map measure' in refused.out
    assert call('map', 'measure', 'junction').code == 0
    infeasible = call('check', '--map', 'junction', '--json', FAST_TRUCK)
    assert infeasible.code == 5
    (certificate,) = json.loads(infeasible.out)['feasibility']['certificates']
    assert certificate['limit'] == 12.0
    (old,) = [a for a in before if a.type_name == 'truck']
    (new,) = [a for a in _grounded(TRUCK).agents if a.type_name == 'truck']
    assert (old.length_m, old.acceleration_mps2) == (8.5, 1.3)
    assert (new.length_m, new.acceleration_mps2) == (9.5, 0.9)
    # The other map was measured with the former truck.
    other = call('check', '--map', 'downtown', TRUCK)
    assert other.code == 4
    assert 'measure again: aurora map measure downtown' in other.out


def test_a_changed_multirotor_is_refused_until_measured_and_then_planned_with(
    shipped: Path, call: Call
) -> None:
    high = 'A drone hovers at 100 m over the ego car for 10 seconds.'
    before = json.loads(call('check', '--map', 'junction', '--json', high).out)
    _edit(shipped / 'multirotor.json', '"climb_limit_mps": 6.0', '"climb_limit_mps": 1.0')
    installed.forget()
    refused = call('check', '--map', 'junction', high)
    assert refused.code == 4
    assert 'measured with multirotor_sha256' in refused.out
    done = call('map', 'measure', 'junction')
    assert done.code == 0
    assert 'uav_climb_max_mps is 0.8 in force, not 5: the multirotor does no more' in done.out
    known = installed.installed()
    assert known.limits.uav_climb_max_mps == 0.8  # of 1.0 m/s, with the reserve
    assert 0.5 < known.settings.flight.climb_mps < 0.8
    after = json.loads(call('check', '--map', 'junction', '--json', high).out)
    assert after['horizon_s'] > before['horizon_s'] + 100.0


def _seen() -> dict[str, tuple[float, ...]]:
    """What the parser is offered, and what grounding places, in numbers."""
    known = installed.installed()
    offered: dict[str, Any] = {r.id: r.data for r in registries(known, 'junction')}
    types, limits = offered['agent_types'], offered['limits']
    found = _grounded(TRUCK)
    (truck,) = [a for a in found.agents if a.type_name == 'truck']
    settings = known.settings
    return {
        'parser: truck, m and m/s': (types['truck']['length_m'], types['truck']['max_speed_mps']),
        'parser: UAV, m/s and s': (limits['uav_speed_max_mps'], limits['uav_endurance_s']),
        'parser: UAV at most, m': (limits['uav_altitude_max_m'],),
        'grounding: truck, m long': (truck.length_m,),
        'grounding: UAV, m/s planned': (settings.flight.speed_max_mps,),
        'grounding: its target, m/s': (settings.grounding.target_speed_mps,),
        'grounding: UAV, m from obstacles': (settings.grounding.clearance_m,),
    }


def test_one_measurement_reaches_parser_grounding_and_check(shipped: Path, call: Call) -> None:
    asked = {
        FAST_TRUCK: 'agent_types/truck/max_speed_mps',
        'A drone flies to four waypoints at 14 m/s at 40 m.': 'uav_speed_max_mps',
        'A drone hovers over the intersection at 40 m for 1200 seconds.': 'uav_endurance_s',
        'A drone hovers over the intersection at 100 m for 10 seconds.': 'uav_altitude_m',
    }
    before = _seen()
    for prompt in asked:
        assert call('check', '--map', 'junction', prompt).code == 0, prompt
    types, model = shipped / 'maps' / 'vtypes.add.xml', shipped / 'multirotor.json'
    _edit(
        types,
        'length="8.50" width="2.50" height="3.40" maxSpeed="36.00"',
        'length="9.50" width="2.50" height="3.40" maxSpeed="12.00"',
    )
    _edit(model, '"horizontal_speed_limit_mps": 21.5', '"horizontal_speed_limit_mps": 11.5')
    _edit(model, '"battery_wh": 90.0', '"battery_wh": 45.0')
    _edit(shipped / 'limits.json', '"uav_altitude_max_m": 120.0', '"uav_altitude_max_m": 80.0')
    _edit(shipped / 'limits.json', '"clearance_min_m": 3.0', '"clearance_min_m": 6.0')
    assert call('map', 'measure', 'junction').code == 0
    after, shown = _seen(), []
    for name, values in after.items():
        shown.append(f'{name}: {before[name]} -> {values}')
        assert values != before[name], name
    for prompt, limit in asked.items():
        refused = call('check', '--map', 'junction', '--json', prompt)
        assert refused.code == 5, prompt
        (proof,) = json.loads(refused.out)['feasibility']['certificates']
        shown.append(f'check: {proof["sentence"]}')
        assert proof['limit_name'] == limit
    sys.stdout.write('\n'.join(shown))  # pytest -rP shows it


def test_a_clearance_that_changes_is_measured_again(config: Path, call: Call) -> None:
    _edit(config / 'limits.json', '"clearance_min_m": 3.0', '"clearance_min_m": 6.0')
    installed.forget()
    refused = call('check', '--map', 'junction', TRUCK)
    assert refused.code == 4
    assert 'measured with clearance_m 5.0, here is 6.7' in refused.out
    assert call('map', 'measure', 'junction').code == 0
    assert call('check', '--map', 'junction', TRUCK).code == 0


def test_a_link_range_that_changes_is_sent_over_again(config: Path, call: Call) -> None:
    far = (
        'The distance between the bus and the van always stays above 80 m. At 20 s the bus sends '
        'a message to the van.'
    )
    assert call('check', '--map', 'junction', far).code == 0
    _edit(config / 'limits.json', '"link_range_sight_m": 500.0', '"link_range_sight_m": 60.3')
    _edit(config / 'limits.json', '"link_range_blocked_m": 200.0', '"link_range_blocked_m": 25.0')
    installed.forget()
    refused = call('check', '--map', 'junction', far)
    assert refused.code == 4
    assert 'measured with link_range_sight_m 500.0, here is 60.3' in refused.out
    done = json.loads(call('map', 'measure', 'junction', '--json').out)['multirotor']
    assert (done['reach_sight_m'], done['reach_blocked_m']) == (60.3, 25.0)
    received = [(row['with_sight'], row['without_sight']) for row in done['link']]
    assert received == [(1.0, 0.0), (0.0, 0.0)]  # 50 m, 100 m
    assert call('check', '--map', 'junction', far).code == 5


def test_a_battery_is_flown_until_it_is_empty(shipped: Path, call: Call) -> None:
    """Rotors that take twice the power halve every flight, and what is offered."""
    long = 'A drone hovers over the intersection at 40 m for 1200 seconds.'
    before = load_uav_record()
    assert call('check', '--map', 'junction', long).code == 0
    _edit(shipped / 'multirotor.json', '"efficiency": 0.55', '"efficiency": 0.275')
    done = json.loads(call('map', 'measure', 'junction', '--json').out)
    for new, old in zip(done['multirotor']['endurances'], before.endurances, strict=True):
        # The climb of each takes more than a hover, and less than a fast flight.
        assert -15.0 < new['endurance_s'] - old.endurance_s / 2.0 < 45.0
    assert any('uav_endurance_s is ' in text for text in done['lower_limits'])
    assert call('check', '--map', 'junction', long).code == 5


@pytest.mark.parametrize(
    ('old', 'new', 'code'),
    [
        # Gusts that the multirotor holds against, and a storm that carries it off.
        ('"heavy_rain": 4.0', '"heavy_rain": 18.0', 0),
        ('"heavy_rain": 6.0', '"heavy_rain": 28.0', 6),
    ],
)
def test_a_wind_that_changes_is_flown_in(
    config: Path, call: Call, old: str, new: str, code: int
) -> None:
    rainy = 'A drone hovers over the intersection at 30 m for 10 seconds in heavy rain.'
    assert call('check', '--map', 'junction', rainy).code == 0
    _edit(config / 'limits.json', old, new)
    installed.forget()
    refused = call('check', '--map', 'junction', rainy)
    assert refused.code == 4
    assert 'measured with wind_heavy_rain 6 m/s, gusts 4 m/s, here is' in refused.out
    assert call('map', 'measure', 'junction').code == 0
    assert call('check', '--map', 'junction', rainy).code == code
    assert call('check', '--map', 'junction', TRUCK).code == 0


@pytest.mark.parametrize(
    ('old', 'new', 'said'),
    [
        ('"vertical_acceleration_limit_mps2": 5.0', '"vertical_acceleration_limit_mps2": 12.5',
         'the multirotor'),
        ('"mass_kg": 1.5', '"mass_kg": 3.75', 'gets to 0.0 m'),
    ],
)  # fmt: skip
def test_a_multirotor_that_does_not_fly_is_told(
    config: Path, call: Call, old: str, new: str, said: str
) -> None:
    before = _files(config / 'knowledge')
    _edit(config / 'multirotor.json', old, new)
    done = call('map', 'measure', 'junction')
    assert done.code == 4
    assert said in done.err
    assert 'multirotor.json' in done.err
    assert 'defect' not in done.err
    assert _files(config / 'knowledge') == before


def test_a_stop_on_the_way_leaves_what_was_there(
    config: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    before = _files(config)

    def stopped(*_: object) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr(measure, 'probe_walks', stopped)
    with pytest.raises(KeyboardInterrupt):
        measure.measure(load_map('junction'), lambda _: None)
    assert _files(config) == before


def test_records_that_cannot_be_written(
    config: Path, call: Call, monkeypatch: pytest.MonkeyPatch
) -> None:
    shutil.rmtree(config / 'knowledge' / 'maps')
    (config / 'knowledge' / 'maps').write_text('no folder')
    done = call('map', 'measure', 'junction')
    assert done.code == 4
    assert 'cannot be written' in done.err


def test_a_workspace_links_to_what_is_written_into_its_sources(
    config: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, call: Call
) -> None:
    share = tmp_path / 'share'
    for path in config.rglob('*'):
        if path.is_file() and 'knowledge' not in path.relative_to(config).parts:
            link = share / path.relative_to(config)
            link.parent.mkdir(parents=True, exist_ok=True)
            link.symlink_to(path)
    shutil.rmtree(config / 'knowledge')
    monkeypatch.setenv(ENVIRONMENT_VARIABLE, str(share))
    installed.forget()
    assert call('map', 'measure', 'junction').code == 0
    linked = _files(share / 'knowledge')
    assert linked == _files(config / 'knowledge')
    assert 'measured/agent_types.json' in linked
    assert (share / 'knowledge' / 'measured' / 'agent_types.json').is_symlink()


def test_an_import_measures_unless_it_is_told_not_to(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, call: Call
) -> None:
    monkeypatch.setenv('AURORA_MAPS', str(tmp_path / 'own'))
    road = tmp_path / 'road.xodr'
    road.write_text(xodr(walkways=True))
    done = call('map', 'import', str(road), '--json')
    assert done.code == 0, done.err
    facts = json.loads(done.out)
    assert facts['measured'] == 'yes'
    assert facts['seconds']['measure'] > 0.0
    assert json.loads(call('map', 'show', 'road', '--json').out)['measured'] == 'yes'
    assert 'measured:' not in call('map', 'doctor', 'road').out
    assert call('map', 'import', str(road), '--name', 'untried', '--no-measure').code == 0
    assert 'measured: no (aurora map measure untried)' in call('map', 'doctor', 'untried').out


def test_doctor_and_show_tell_what_was_measured(config: Path, call: Call) -> None:
    shown = json.loads(call('map', 'show', 'junction', '--json').out)
    assert shown['measured'] == 'yes'
    shutil.rmtree(config / 'knowledge' / 'maps' / 'junction')
    done = call('map', 'doctor', 'junction')
    assert done.code == 1
    assert 'aurora map measure junction' in done.out
    assert call('map', 'measure', 'junction').code == 0
    assert 'aurora map measure junction' not in call('map', 'doctor', 'junction').out


def test_the_doctor_finds_records_of_something_else(config: Path) -> None:
    """Every command is refused with them: it says so before anything is tried."""
    assert ('records', data.records) in CHECKS
    assert data.records(Machine()) == []
    arrays = config / 'knowledge' / 'maps' / 'junction' / 'arrays.npz'
    kept = arrays.read_bytes()
    arrays.write_bytes(b'')
    (of_map,) = data.records(Machine())
    assert of_map.fix == 'measure again: aurora map measure junction'
    arrays.write_bytes(kept)
    _edit(config / 'multirotor.json', '"mass_kg": 1.5', '"mass_kg": 1.6')
    (of_vehicles,) = data.records(Machine())
    assert 'measured with multirotor_sha256' in of_vehicles.found
