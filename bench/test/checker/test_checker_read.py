# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Bags, as a recorder writes them: what is read, what is refused, and the command line."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from mcap.writer import Writer
from rosbags.typesys import Stores, get_types_from_msg, get_typestore

from aurora_bench.checker import CheckerError, check_bag
from aurora_bench.checker.__main__ import main
from aurora_bench.checker.read import read_bag
from aurora_bench.checker.recording import LinkKind

DEFINITIONS = Path(__file__).resolve().parents[3] / 'aurora_msgs' / 'msg'
TICKS = 401
DT_S = 0.05
RING = np.array([0.0, 0.0, 10.0, 0.0, 10.0, 10.0, 0.0, 10.0])
REQUIREMENTS = [
    {'id': 'r1', 'kind': 'agent', 'ref': 'car1', 'type': 'car'},
    {'id': 'r2', 'kind': 'uav', 'ref': 'uav1'},
    {'id': 'r3', 'kind': 'behavior', 'agent': 'car1', 'behavior': 'drive'},
    {'id': 'r4', 'kind': 'world', 'field': 'weather', 'value': 'rain'},
]
PROMPT = {'id': 'drive-001', 'requirements': REQUIREMENTS}
Change = Callable[[str, dict[str, Any]], bool]


class Bag:
    """Writes the messages of a run of 20 s with a car, a person and a UAV.

    Args:
        change: May alter the fields of a message; False leaves it out.
    """

    def __init__(self, folder: Path, change: Change = lambda topic, fields: True) -> None:
        self.folder = folder
        self._change = change
        self._store = get_typestore(Stores.ROS2_JAZZY)
        types: dict[str, Any] = {}
        for file in sorted(DEFINITIONS.glob('*.msg')):
            name = f'aurora_msgs/msg/{file.stem}'
            types.update(get_types_from_msg(file.read_text(encoding='utf-8'), name))
        self._store.register(types)
        self._channels: dict[str, int] = {}
        folder.mkdir()
        with (folder / 'run_0.mcap').open('wb') as stream:
            self._writer = Writer(stream)
            self._writer.start(profile='ros2')
            self._fill()
            self._writer.finish()  # type: ignore[no-untyped-call]

    def _make(self, message: str, /, **fields: Any) -> Any:
        return self._store.types[message](**fields)

    def _header(self, tick: int = 0) -> Any:
        ns = round(tick * DT_S * 1e9)
        stamp = self._make('builtin_interfaces/msg/Time', sec=ns // 10**9, nanosec=ns % 10**9)
        return self._make('std_msgs/msg/Header', stamp=stamp, frame_id='map')

    def _write(self, topic: str, name: str, at: int, /, **fields: Any) -> None:
        if not self._change(topic, fields):
            return
        kind = f'aurora_msgs/msg/{name}'
        if topic not in self._channels:
            text = self._store.generate_msgdef(kind, ros_version=2)[0]
            schema = self._writer.register_schema(kind, 'ros2msg', text.encode())
            self._channels[topic] = self._writer.register_channel(topic, 'cdr', schema)
        message = self._make(kind, header=self._header(at), **fields)
        data = bytes(self._store.serialize_cdr(message, kind))
        ns = round(at * DT_S * 1e9)
        self._writer.add_message(self._channels[topic], ns, data, ns)

    def _entry(self, body: str, kind: str, person: bool = False) -> Any:
        return self._make(
            'aurora_msgs/msg/RosterEntry', id=body, type=kind, is_person=person, system_id=0,
            length_m=4.6, width_m=1.8, height_m=1.5, route_edges=[],
            route_xy_m=np.array([0.0, 0.0, 300.0, 0.0]), role='other',
        )  # fmt: skip

    def _fill(self) -> None:
        self._write(
            '/aurora/roster', 'Roster', 0, run_id='run', iteration=0, dt_s=DT_S,
            agents=[self._entry('car1', 'car'), self._entry('ped1', 'pedestrian', True)],
            uavs=[self._entry('uav1', 'uav')],
        )  # fmt: skip
        self._write('/aurora/world', 'World', 0, **self._world())
        for tick in range(TICKS):
            time = tick * DT_S
            ground = np.zeros((2, 7))
            ground[0] = (8.0 * time, 0.0, 1.0, 0.0, 8.0, 0.0, 1.0)
            ground[1] = (5.0, 5.0, 0.0, 1.0, 0.0, 0.0, 1.0)
            uav = np.zeros((1, 16))
            uav[0, :3] = (1.0, 2.0, min(4.0 * time, 40.0))
            command = np.zeros((1, 10))
            command[0, 9] = 1.0 if time < 10.0 else 2.0
            same = {'run_number': 1, 'tick': tick}
            self._write('/aurora/ground/state', 'GroundState', tick, data=ground.ravel(), **same)
            self._write('/aurora/uav/state', 'UavState', tick, data=uav.ravel(), **same)
            if tick:
                self._write(
                    '/aurora/uav/command', 'UavCommand', tick, data=command.ravel(), **same
                )
        for k, kind in enumerate((0, 2, 3)):
            self._write(
                '/aurora/comm', 'LinkEvent', 300, run_number=1, tick=300 + 2 * (kind == 3),
                sequence=k, message=0, link='l', event='e', sender='uav1', receiver='car1',
                kind=kind, attempt=0, reason=0, distance_m=100.0, line_of_sight=True,
            )  # fmt: skip

    def _world(self) -> dict[str, Any]:
        none = {'hole_starts': np.zeros(0, dtype=np.uint32), 'holes_xy_m': np.zeros(0)}
        make = self._make
        return {
            'run_id': 'run', 'map_name': 'tiny', 'map_digest': '', 'origin_lat_deg': 0.0,
            'origin_lon_deg': 0.0, 'weather': 'rain', 'time_of_day': 'dusk',
            'wind_mean_east_mps': 3.0, 'wind_mean_north_mps': 0.0, 'wind_gust_mps': 2.0,
            'buildings': [
                make('aurora_msgs/msg/Building', id='b', ring_xy_m=RING, height_m=12.0,
                     height_source='', kind='house', name='City Hall',
                     hole_starts=np.array([0], dtype=np.uint32),
                     holes_xy_m=np.array([4.0, 4.0, 6.0, 4.0, 6.0, 6.0])),
            ],
            'no_fly_zones': [
                make('aurora_msgs/msg/NoFlyZone', id='z', name='zone', ring_xy_m=RING,
                     floor_m=0.0, ceiling_m=50.0),
            ],
            'surfaces': [
                make('aurora_msgs/msg/Carriageway', id=f's{k}', kind=k, ring_xy_m=RING, **none)
                for k in range(3)
            ],
            'lanes': [
                make('aurora_msgs/msg/LaneCentreLine', lane_id='e_0', street_name='Main Street',
                     xy_m=np.array([0.0, 0.0, 300.0, 0.0]), width_m=3.3, speed_limit_mps=13.89),
            ],
            'signals': [make('aurora_msgs/msg/Signal', id='j', x_m=50.0, y_m=0.0)],
            'places': [
                make('aurora_msgs/msg/NamedPlace', name='landmark:City Hall', x_m=5.0, y_m=0.0),
            ],
            'limits_json': '{"uav_endurance_s": 900.0}', 'conditions_json': '[]', 'digest': '',
        }  # fmt: skip


def test_a_bag_is_read_as_it_was_written(tmp_path: Path) -> None:
    found = read_bag(Bag(tmp_path / 'bag').folder)
    assert [b.body_id for b in found.bodies] == ['car1', 'ped1', 'uav1']
    assert [b.is_uav for b in found.bodies] == [False, False, True]
    assert found.bodies[1].is_person
    assert found.ground.shape == (TICKS, 2, 7)
    assert found.ground[200, 0, 0] == pytest.approx(80.0)
    assert found.uav[100, 0, 2] == pytest.approx(20.0)
    assert (found.phase[0, 0], found.phase[199, 0], found.phase[200, 0]) == (0.0, 1.0, 2.0)
    assert [e.kind for e in found.ledger] == [
        LinkKind.SENT, LinkKind.ATTEMPT_PASSED, LinkKind.DELIVERED,
    ]  # fmt: skip
    assert found.ledger[2].time_s == pytest.approx(15.1)
    world = found.world
    assert (world.weather, world.time_of_day, world.map_name) == ('rain', 'dusk', 'tiny')
    assert world.buildings[0].polygon.area == pytest.approx(98.0)
    assert (len(world.driving), len(world.crossings), len(world.sidewalks)) == (1, 1, 1)
    assert world.limits['uav_endurance_s'] == 900.0
    assert world.places == (('landmark:City Hall', 5.0, 0.0),)


def test_the_answers_of_a_bag(tmp_path: Path) -> None:
    checked = check_bag(Bag(tmp_path / 'bag').folder, PROMPT)
    assert [a.outcome.value for a in checked.answers] == ['holds'] * 4
    assert checked.binding == {'car1': ('car1',), 'uav1': ('uav1',)}


def _without(topic: str) -> Change:
    return lambda own, fields: own != topic


def _no_tick(tick: int) -> Change:
    return lambda own, fields: own != '/aurora/ground/state' or fields['tick'] != tick


def _not_finite(topic: str, fields: dict[str, Any]) -> bool:
    if topic == '/aurora/uav/state' and fields['tick'] == 7:
        fields['data'][0] = np.nan
    return True


@pytest.mark.parametrize(
    'change',
    [
        _without('/aurora/roster'),
        _without('/aurora/world'),
        _without('/aurora/uav/state'),
        _no_tick(17),
        _no_tick(TICKS - 1),
        _not_finite,
    ],
)
def test_a_bag_that_lacks_something_is_refused(tmp_path: Path, change: Change) -> None:
    bag = Bag(tmp_path / 'bag', change)
    with pytest.raises(CheckerError, match='bag folder of a finished run'):
        check_bag(bag.folder, PROMPT)


def test_what_is_no_bag_is_refused(tmp_path: Path) -> None:
    with pytest.raises(CheckerError, match=r'no \.mcap file'):
        check_bag(tmp_path, PROMPT)
    (tmp_path / 'x.mcap').write_bytes(b'\x89MCAP0\r\nnothing of use')
    with pytest.raises(CheckerError):
        check_bag(tmp_path, PROMPT)
    whole = Bag(tmp_path / 'bag').folder / 'run_0.mcap'
    whole.write_bytes(whole.read_bytes()[: whole.stat().st_size // 2])
    with pytest.raises(CheckerError):
        check_bag(whole, PROMPT)


def test_the_command_line(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    bag = str(Bag(tmp_path / 'bag').folder)
    wrong = {**PROMPT, 'id': 'wrong', 'requirements': [*REQUIREMENTS,
             {'id': 'r5', 'kind': 'behavior', 'agent': 'car1', 'behavior': 'park'}]}  # fmt: skip
    file = tmp_path / 'prompts.jsonl'
    file.write_text(f'{json.dumps(PROMPT)}\n\n{json.dumps(wrong)}\n', encoding='utf-8')
    asked = [bag, '--prompts', str(file), '--id']
    assert main([*asked, 'drive-001']) == 0
    assert '4 hold, 0 do not, 0 cannot be told' in capsys.readouterr().out
    assert main([*asked, 'wrong', '--json']) == 1
    told = json.loads(capsys.readouterr().out)
    assert [a['outcome'] for a in told['answers']] == ['holds'] * 4 + ['does_not']
    assert told['binding'] == {'car1': ['car1'], 'uav1': ['uav1']}
    assert main([*asked, 'nobody']) == 4
    assert 'nobody' in capsys.readouterr().err
    assert main([str(tmp_path / 'none'), *asked[1:], 'drive-001']) == 4
    with pytest.raises(SystemExit) as usage:
        main([bag])
    assert usage.value.code == 64
