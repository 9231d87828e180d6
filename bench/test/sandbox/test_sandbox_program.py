# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Programs that run a scene through the pipe, and what is recorded of it."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from aurora_bench.checker.check import check_bag
from aurora_bench.checker.read import read_bag
from aurora_bench.sandbox.process import End, chosen_way
from aurora_bench.sandbox.program import ProgramRun, run_program
from aurora_bench.sandbox.ways import SandboxError
from aurora_cli.installed import installed

WATCH = """
from aurora_scene import scene
lane = scene.lanes(within_m=500.0)[0]
scene.world(weather='rain', time_of_day='dusk')
scene.spawn('ego', 'car', lane['id'], 10.0, speed_mps=5.0, role='ego')
x, y = lane['start']
scene.spawn_uav('drone', x, y)
scene.link('drone', 'ego', latency_s=0.2)
dt = scene.begin()
scene.take_off('drone', 30.0)
scene.set_speed('ego', 5.0)
while scene.state('drone')['z'] < 29.5:
    scene.step()
scene.phase('drone', 0)
scene.fly_to('drone', x, y, 30.0)
scene.send('drone', 'ego')
scene.step(round(10.0 / dt))
assert scene.delivered('drone', 'ego') == 1
scene.land('drone')
while not scene.state('drone')['landed']:
    scene.step()
"""

HOVER: dict[str, Any] = {
    'id': 'hover-901', 'category': 'hover', 'feasibility': 'feasible', 'paraphrase_group': None,
    'end_to_end': True, 'prompt': 'A drone hovers at 30 m for 10 s in rain and warns the ego.',
    'requirements': [
        {'id': 'r1', 'kind': 'world', 'field': 'weather', 'value': 'rain'},
        {'id': 'r2', 'kind': 'uav', 'ref': 'uav1'},
        {'id': 'r3', 'kind': 'mission', 'uav': 'uav1', 'mode': 'hover',
         'altitude_m': 30, 'duration_s': 10},
        {'id': 'r4', 'kind': 'agent', 'ref': 'ego', 'type': 'car', 'role': 'ego'},
    ],
}  # fmt: skip


@pytest.fixture(autouse=True)
def _contained() -> None:
    try:
        chosen_way()
    except SandboxError as err:
        pytest.skip(str(err))


def ran(text: str, folder: Path, seed: int = 1) -> ProgramRun:
    """Run a program on the map downtown."""
    return run_program(
        text, known=installed(), map_name='downtown', seed=seed, bag=folder / f'bag.{seed}'
    )


def test_a_program_is_recorded_and_the_checker_judges_its_trace(tmp_path: Path) -> None:
    found = ran(WATCH, tmp_path)
    assert (found.end, found.told) == (End.FINISHED, '')
    assert found.completed
    said = check_bag(tmp_path / 'bag.1', HOVER).answers
    assert [(a.requirement, a.outcome.value) for a in said] == [
        (f'r{k}', 'holds') for k in range(1, 5)
    ]
    # The same program gives the same recording.
    assert ran(WATCH, tmp_path / 'again').trace_sha256 == found.trace_sha256


def test_a_program_cannot_write_its_own_truth(tmp_path: Path) -> None:
    """It says that a mission is flown while the UAV stands; the states say that it stood."""
    text = WATCH.split('scene.take_off')[0] + "scene.phase('drone', 0)\nscene.step(100)\n"
    assert ran(text, tmp_path).completed
    recording = read_bag(tmp_path / 'bag.1')
    assert recording.uav[:, 0, 2].max() < 0.1
    outcomes = {
        a.requirement: a.outcome.value for a in check_bag(tmp_path / 'bag.1', HOVER).answers
    }
    assert outcomes['r3'] == 'does_not'


@pytest.mark.parametrize(
    ('line', 'told'),
    [
        ("scene.spawn('a', 'tank', lane['id'], 1.0)", "there is no 'tank'"),
        ("scene.spawn('a', 'rsu', lane['id'], 1.0)", "there is no 'rsu'"),
        ("scene.spawn('a', 'car', 'nowhere', 1.0)", "there is no lane 'nowhere'"),
        ("scene.spawn('a', 'car', lane['id'], 1e4)", 'the lane ends at'),
        ("scene.spawn('a', 'car', lane['id'], 1.0, route=['x'])", 'route: it does not begin'),
        ("scene.spawn('a b', 'car', lane['id'], 1.0)", 'name: String should match'),
        ("scene.spawn('a', 'car', lane['id'], 1.0); scene.spawn('a', 'car', lane['id'], 30.0)",
         "there is a 'a' already"),
        ("scene.link('a', 'b')", "there is no 'a'"),
        ('scene.step()', 'step: call begin first'),
        ('scene.begin()', 'begin: nobody was placed'),
        ("scene.spawn_uav('u', *lane['start']); scene.begin(); scene.fly_to('u', 1.0, 1.0, 9.0)",
         'u: take off first'),
        ("scene.spawn_uav('u', *lane['start']); scene.begin(); scene.step(100000)",
         'step: the scene is over at'),
        ("scene._ask('teleport', name='a')", "do: Input tag 'teleport'"),
        ("scene._ask('state', name='a', also=1)", 'call begin first|also: Extra'),
    ],
)  # fmt: skip
def test_what_cannot_be_done_is_answered_and_ends_the_program(
    tmp_path: Path, line: str, told: str
) -> None:
    text = f'from aurora_scene import scene\nlane = scene.lanes()[0]\n{line}\n'
    found = ran(text, tmp_path)
    assert found.end is End.RAISED
    assert any(part in found.told for part in told.split('|')), found.told


def test_a_program_may_say_that_it_cannot_be_done(tmp_path: Path) -> None:
    found = ran("from aurora_scene import scene\nscene.refuse('altitude_limit')\n", tmp_path)
    assert (found.end, found.refused, found.begun) == (End.FINISHED, 'altitude_limit', False)
    assert not found.completed


EVERY = """
from aurora_scene import SceneError, scene
lanes = [l for l in scene.lanes(within_m=900.0) if l['length_m'] > 150.0]
mine = [l for l in lanes if any(o['edge'] == l['edge'] and o['index'] == l['index'] + 1
                                for o in lanes)][0]
onward = scene.next_edges(mine['edge'])[0]
assert scene.route(mine['edge'], onward) == [mine['edge'], onward]
assert all(set(p) == {'x', 'y', 'lane'} for p in scene.places().values())
scene.world(weather='fog', wind_mps=3.0, wind_from_deg=270.0)
scene.spawn('car', 'car', mine['id'], 20.0, speed_mps=8.0, role='ego')
scene.spawn('bus', 'bus', mine['id'], 60.0, speed_mps=8.0)
scene.spawn('van', 'van', mine['id'], 110.0, parked=True)
scene.spawn('ann', 'pedestrian', mine['id'], 5.0)
dt = scene.begin()
walked = scene.state('ann')
scene.set_time_gap('car', 3.0)
scene.change_lane('car', mine['index'] + 1)
scene.set_route('bus', [mine['edge'], onward])
scene.stop_at('bus', mine['id'], 100.0, 5.0)
speeds = []
for _ in range(20):
    scene.step(round(1.0 / dt))
    speeds.append(scene.state('bus')['speed'])
assert min(speeds) < 0.1 < speeds[-1], speeds
scene.set_speed('car', 4.0)
scene.step(round(4.0 / dt))
assert abs(scene.state('car')['speed'] - 4.0) < 0.5 or not scene.state('car')['present']
scene.free_speed('car')
scene.step(round(3.0 / dt))
now = scene.state('ann')
assert (now['x'] - walked['x']) ** 2 + (now['y'] - walked['y']) ** 2 > 100.0
assert scene.state('van')['speed'] == 0.0
try:
    scene.set_speed('nobody', 1.0)
except SceneError as err:
    scene.log(str(err))
"""


def test_every_command_on_the_ground_reaches_the_simulator(tmp_path: Path) -> None:
    found = ran(EVERY, tmp_path)
    assert (found.end, found.told) == (End.FINISHED, '')
    world = read_bag(tmp_path / 'bag.1').world
    assert world.weather == 'fog'
    # From the west: it blows to the east.
    assert world.wind_mps == pytest.approx((3.0, 0.0), abs=1e-9)
