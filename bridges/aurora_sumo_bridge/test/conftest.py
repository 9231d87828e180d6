# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Loads on the two shipped maps, and a client that is always closed again."""

from __future__ import annotations

import importlib.util
from collections.abc import Callable, Iterator
from pathlib import Path
from types import ModuleType
from typing import Any

import pytest

from aurora_core.ports.simulators import FloatArray, GroundAgentLoad, GroundLoad
from aurora_core.trace.commands import GroundCommand
from aurora_core.trace.layout import GroundCommandKind
from aurora_sumo_bridge.sumo_client import SumoClient

MAPS = Path(__file__).resolve().parents[3] / 'config' / 'maps'

DT_S = 0.05
SCRIPT = Path(__file__).with_name('replay_digest.py')


@pytest.fixture(scope='module')
def replay() -> ModuleType:
    spec = importlib.util.spec_from_file_location('replay_digest', SCRIPT)
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


@pytest.fixture
def client() -> Iterator[SumoClient]:
    simulator = SumoClient()
    yield simulator
    simulator.close()


@pytest.fixture
def vehicle() -> Callable[..., GroundAgentLoad]:
    def build(agent_id: str, type_name: str = 'car', **fields: Any) -> GroundAgentLoad:
        return GroundAgentLoad(agent_id=agent_id, type_name=type_name, is_person=False, **fields)

    return build


@pytest.fixture
def walker() -> Callable[..., GroundAgentLoad]:
    def build(agent_id: str, **fields: Any) -> GroundAgentLoad:
        settings: dict[str, Any] = {'type_name': 'pedestrian', 'lane_id': ''} | fields
        return GroundAgentLoad(agent_id=agent_id, is_person=True, **settings)

    return build


@pytest.fixture
def scene() -> Callable[..., GroundLoad]:
    def build(*agents: GroundAgentLoad, **fields: Any) -> GroundLoad:
        map_name = fields.pop('map_name', 'downtown')
        settings: dict[str, Any] = {
            'map_name': map_name,
            'net_path': MAPS / map_name / 'net.xml.gz',
            'vtypes_path': MAPS / 'vtypes.add.xml',
            'map_digest': '',
            'dt_s': DT_S,
            'seed': 1,
        }
        return GroundLoad(agents=agents, **(settings | fields))

    return build


@pytest.fixture
def command() -> Callable[..., GroundCommand]:
    def build(agent: int, kind: str, value: float = 0.0, **fields: Any) -> GroundCommand:
        return GroundCommand(agent=agent, kind=GroundCommandKind[kind], value=value, **fields)

    return build


@pytest.fixture
def run_on() -> Callable[..., list[FloatArray]]:
    """Advance by a number of ticks without commands; return every state."""

    def run(simulator: SumoClient, ticks: int) -> list[FloatArray]:
        first = simulator.tick + 1
        return [simulator.advance(tick, ()) for tick in range(first, first + ticks)]

    return run
