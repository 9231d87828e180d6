# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The scenarios of the benchmark: as many as asked, the same every time, all of them inserted."""

from __future__ import annotations

import itertools

import pytest

from aurora_bench.lockstep.scenarios import (
    SEED,
    Configuration,
    ScenarioRefusedError,
    grounded,
    specification,
)
from aurora_cli.installed import installed
from aurora_core.outcomes.agsg import Agsg
from aurora_core.outcomes.grounded import GroundedScenario
from aurora_core.outcomes.schedule import Schedule
from aurora_core.pipeline.functions import execution_stage
from aurora_core.trace.layout import GroundColumn
from aurora_sumo_bridge.sumo_client import SumoClient


def scenario(graph: Agsg) -> GroundedScenario:
    return GroundedScenario.model_validate_json(graph.texts.grounding)


def test_thirty_agents_are_all_inserted() -> None:
    graph = grounded(Configuration(agents=30, uavs=1, seconds=60))
    assert len(scenario(graph).agents) == 30
    client = SumoClient()
    try:
        client.load(execution_stage(installed(), graph, SEED, ()).ground_load)
        rows = client.state()
    finally:
        client.close()
    assert rows.shape[0] == 30
    assert rows[:, GroundColumn.PRESENT].all()


def test_uavs_track_at_altitudes_of_their_own() -> None:
    graph = grounded(Configuration(agents=3, uavs=8, seconds=60))
    uavs = scenario(graph).uavs
    altitudes = [uav.missions[0].altitude_m for uav in uavs]
    assert len(uavs) == 8
    assert [b - a for a, b in itertools.pairwise(altitudes)] == [10.0] * 7
    assert {uav.missions[0].target for uav in uavs} == {graph.spec.missions[0].target}
    assert [uav.system_id for uav in uavs] == list(range(1, 9))


def test_the_run_lasts_exactly_as_long_as_asked() -> None:
    graph = grounded(Configuration(agents=2, uavs=1, seconds=45))
    schedule = Schedule.model_validate_json(graph.texts.schedule)
    assert schedule.stated_horizon
    assert schedule.horizon_s == 45.0


def test_the_same_configuration_gives_the_same_graph() -> None:
    configuration = Configuration(agents=12, uavs=2, seconds=60)
    first = grounded(configuration)
    grounded.cache_clear()
    second = grounded(configuration)
    assert first is not second
    assert first == second


@pytest.mark.parametrize('agents', [2, 10, 200])
def test_the_prompt_is_read_as_meant(agents: int) -> None:
    spec = specification(Configuration(agents=agents, uavs=1, seconds=300))
    assert len(spec.agents) == agents
    assert spec.world.duration_s is not None
    assert spec.world.duration_s.value == 300.0


@pytest.mark.parametrize(
    ('agents', 'uavs', 'seconds'),
    [(1, 1, 60), (201, 1, 60), (10, 0, 60), (10, 11, 60), (10, 1, 5)],
)
def test_sizes_out_of_range_are_refused(agents: int, uavs: int, seconds: int) -> None:
    with pytest.raises(ScenarioRefusedError, match='expected 2 to 200 agents'):
        Configuration(agents=agents, uavs=uavs, seconds=seconds)
