# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Start, refusal and silence of the one simulation of a process."""

from __future__ import annotations

import gc
from collections.abc import Callable
from pathlib import Path

import libsumo
import pytest

from aurora_core.errors import GroundSimulatorError
from aurora_core.ports.simulators import GroundAgentLoad, GroundLoad
from aurora_sumo_bridge.sumo_client import SumoClient

Scene = Callable[..., GroundLoad]
Vehicle = Callable[..., GroundAgentLoad]


@pytest.fixture
def car(vehicle: Vehicle) -> GroundAgentLoad:
    return vehicle(
        'ego', edges=('long_street_1_eb',), lane_id='long_street_1_eb_1', lane_position_m=50.0
    )


def test_a_second_client_is_refused_while_the_first_is_loaded(
    client: SumoClient, scene: Scene, car: GroundAgentLoad
) -> None:
    client.load(scene(car, map_name='junction'))
    second = SumoClient()
    with pytest.raises(GroundSimulatorError, match='another SUMO client'):
        second.load(scene(map_name='junction'))
    assert client.advance(1, ()).shape == (1, 7)
    client.close()
    second.load(scene(map_name='junction'))
    assert second.state().shape == (0, 7)
    second.close()


def test_a_client_dropped_without_close_does_not_block_the_next(
    client: SumoClient, scene: Scene
) -> None:
    dropped = SumoClient()
    dropped.load(scene(map_name='junction'))
    del dropped
    gc.collect()
    client.load(scene(map_name='junction'))
    assert client.tick == 0


def test_a_simulation_started_by_someone_else_is_left_alone(
    client: SumoClient, scene: Scene
) -> None:
    net = scene(map_name='junction').net_path
    libsumo.start(['sumo', '-n', str(net), '--no-step-log', '--no-warnings'])
    try:
        with pytest.raises(GroundSimulatorError, match='started by someone else'):
            client.load(scene(map_name='junction'))
        assert libsumo.isLoaded()
    finally:
        libsumo.close()


@pytest.mark.parametrize(
    ('content', 'expected'),
    [
        (None, 'No such file'),
        ('', 'cannot be read as XML'),
        ('plain words', 'cannot be read as XML'),
        ('<net><edge', 'without a version'),
        ('<net></net>', 'without a version'),
        ('<additional/>', 'begins with <additional>'),
        ('<net version="1.20"><location', 'does not start'),
    ],
)
def test_a_damaged_net_is_an_error_and_the_client_lives_on(
    client: SumoClient,
    scene: Scene,
    tmp_path: Path,
    capfd: pytest.CaptureFixture[str],
    content: str | None,
    expected: str,
) -> None:
    net = tmp_path / 'net.xml'
    if content is not None:
        net.write_text(content)
    with pytest.raises(GroundSimulatorError, match=expected):
        client.load(scene(net_path=net))
    assert client.tick == -1
    client.load(scene(map_name='junction'))
    assert client.tick == 0
    assert capfd.readouterr() == ('', '')


def test_a_damaged_archive_is_an_error(client: SumoClient, scene: Scene, tmp_path: Path) -> None:
    net = tmp_path / 'net.xml.gz'
    net.write_bytes(scene().net_path.read_bytes()[:50])
    with pytest.raises(GroundSimulatorError, match='cannot be read as XML'):
        client.load(scene(net_path=net))


@pytest.mark.parametrize(
    ('content', 'expected'),
    [
        ('<additional><vType id="car" vClass="hovercraft"/></additional>', 'hovercraft'),
        ('<additional><vType id="car" length="-3"/></additional>', 'length must be greater'),
        ('<routes', 'cannot be read as XML'),
    ],
)
def test_what_sumo_says_about_vtypes_is_in_the_error_and_not_on_the_terminal(
    client: SumoClient,
    scene: Scene,
    tmp_path: Path,
    capfd: pytest.CaptureFixture[str],
    content: str,
    expected: str,
) -> None:
    vtypes = tmp_path / 'vtypes.add.xml'
    vtypes.write_text(content)
    with pytest.raises(GroundSimulatorError, match=expected):
        client.load(scene(vtypes_path=vtypes))
    assert capfd.readouterr() == ('', '')
    client.load(scene(map_name='junction'))


@pytest.mark.parametrize('dt_s', [0.0, -0.05, 0.0005, 0.0505001, 1.5, float('nan')])
def test_step_lengths_that_sumo_would_round_are_refused(
    client: SumoClient, scene: Scene, dt_s: float
) -> None:
    with pytest.raises(GroundSimulatorError, match='whole milliseconds'):
        client.load(scene(dt_s=dt_s))


@pytest.mark.parametrize('seed', [-1, 2**31])
def test_seeds_outside_sumos_range_are_refused(
    client: SumoClient, scene: Scene, seed: int
) -> None:
    with pytest.raises(GroundSimulatorError, match=f'seed {seed}'):
        client.load(scene(seed=seed))


def test_a_comma_in_a_path_is_refused(client: SumoClient, scene: Scene, tmp_path: Path) -> None:
    folder = tmp_path / 'a,b'
    folder.mkdir()
    net = folder / 'net.xml.gz'
    net.write_bytes(scene().net_path.read_bytes())
    with pytest.raises(GroundSimulatorError, match='comma'):
        client.load(scene(net_path=net))


def test_close_is_idempotent_and_ends_the_simulation(client: SumoClient, scene: Scene) -> None:
    client.close()
    client.load(scene(map_name='junction'))
    client.close()
    client.close()
    assert not libsumo.isLoaded()
    with pytest.raises(GroundSimulatorError, match='no scenario is loaded'):
        client.state()
    with pytest.raises(GroundSimulatorError, match='no scenario is loaded'):
        client.advance(1, ())


def test_a_collision_is_listed_and_leaves_the_terminal_clean(
    client: SumoClient,
    scene: Scene,
    vehicle: Vehicle,
    car: GroundAgentLoad,
    capfd: pytest.CaptureFixture[str],
) -> None:
    # 1 m behind a standing car at 10 m/s: no braking can help.
    rear = vehicle(
        'rear',
        edges=('long_street_1_eb',),
        lane_id='long_street_1_eb_1',
        lane_position_m=50.0 - 4.6 - 1.0,
        speed_mps=10.0,
        lane_change_mode=0,
    )
    client.load(scene(car, rear, map_name='junction'))
    assert client.collisions() == ()
    pairs: set[tuple[str, str]] = set()
    for tick in range(1, 10):
        client.advance(tick, ())
        pairs.update(client.collisions())
        assert client.teleports() == ()
    assert pairs == {('rear', 'ego')}
    assert capfd.readouterr() == ('', '')
