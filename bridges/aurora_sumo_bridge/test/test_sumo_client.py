# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Same load, same commands, same bits: whatever ran before, in whichever process."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from types import ModuleType

import pytest

from aurora_core.errors import GroundSimulatorError
from aurora_core.ports.simulators import GroundLoad, GroundSimulator
from aurora_sumo_bridge.sumo_client import SumoClient

SCRIPT = Path(__file__).with_name('replay_digest.py')
MAPS = Path(__file__).resolve().parents[3] / 'config' / 'maps'


def test_identical_bits_after_resets_other_runs_failures_and_in_a_fresh_process(
    client: SumoClient, replay: ModuleType, scene: Callable[..., GroundLoad]
) -> None:
    load = replay.busy_load(MAPS)
    first = replay.digest(client, load)
    # A warm reset of the same client.
    assert replay.digest(client, load) == first
    # After another map, an aborted run and a failed load.
    client.load(scene(map_name='junction'))
    client.advance(1, ())
    replay.digest(client, replay.busy_load(MAPS, seed=8), ticks=50)
    with pytest.raises(GroundSimulatorError):
        client.load(replace(load, seed=-1))
    assert replay.digest(client, load) == first
    # After close, with another client.
    client.close()
    other = SumoClient()
    assert replay.digest(other, load) == first
    other.close()
    # In a process of its own.
    fresh = subprocess.run(
        [sys.executable, str(SCRIPT), str(MAPS)],
        check=True,
        capture_output=True,
        text=True,
        env=os.environ | {'PYTHONPATH': os.pathsep.join(sys.path)},
    )
    assert fresh.stdout == first
    assert fresh.stderr == ''


def test_the_client_is_a_ground_simulator(client: SumoClient) -> None:
    simulator: GroundSimulator = client
    with pytest.raises(GroundSimulatorError, match='no scenario is loaded'):
        simulator.state()
    assert client.tick == -1
