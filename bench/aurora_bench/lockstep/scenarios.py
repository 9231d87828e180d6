# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Scenarios with N ground agents and U UAVs, through the product's own pipeline.

One UAV: a prompt, read by the parser and grounded as any other. More UAVs: the specification of
that prompt, in which the one track mission is repeated for each further UAV, 10 m higher each
time, then grounded as any other. The same arguments give the same graph, byte for byte.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

from aurora_cli.installed import installed
from aurora_core.agsg.build import build_agsg
from aurora_core.errors import AuroraError
from aurora_core.outcomes.agsg import Agsg
from aurora_core.outcomes.feasibility import Feasibility
from aurora_core.pipeline.functions import check_stage, ground_stage, parse_stage
from aurora_core.spec.parameter import Provenance
from aurora_core.spec.scenario import ScenarioSpec

MAP_NAME = 'downtown'
SEED = 1

_STANDOFF_M = 35
_LOWEST_M = 30
# As grounding itself would layer them: twice the separation in flight.
_STEP_M = 10
# Take-off and approach before the mission; the landing after it may last beyond the end.
_WAY_S = 40
_SHORTEST_MISSION_S = 5
_FEWEST_AGENTS = 2
# Up to the first altitude, and the shortest mission.
_SHORTEST_S = 12


class ScenarioRefusedError(AuroraError):
    """The pipeline does not take a scenario of this size."""

    default_component = 'bench'


@dataclass(frozen=True, slots=True, kw_only=True, order=True)
class Configuration:
    """What is run.

    Attributes:
        agents: Ground agents: one bus that is tracked, the others drive about.
        uavs: Each tracks the bus.
        seconds: Simulated duration.
    """

    agents: int
    uavs: int
    seconds: int

    def __post_init__(self) -> None:
        limits = installed().limits
        if not (
            _FEWEST_AGENTS <= self.agents <= limits.agents_max
            and 1 <= self.uavs <= limits.uavs_max
            and _SHORTEST_S <= self.seconds <= limits.duration_max_s
        ):
            raise ScenarioRefusedError(
                f'expected {_FEWEST_AGENTS} to {limits.agents_max} agents, 1 to {limits.uavs_max} '
                f'UAVs and {_SHORTEST_S} to {limits.duration_max_s:g} s, found {self}'
            )

    def __str__(self) -> str:
        return f'{self.agents} agents, {self.uavs} UAV{"s" * (self.uavs > 1)}, {self.seconds} s'


def prompt(configuration: Configuration) -> str:
    """Return the prompt of a configuration with one UAV."""
    mission_s = max(_SHORTEST_MISSION_S, configuration.seconds - _WAY_S)
    cars = configuration.agents - 1
    driving = f'{cars} background cars circulate' if cars > 1 else 'a background car circulates'
    return (
        f'A drone tracks the bus from {_STANDOFF_M} meters at an altitude of {_LOWEST_M} meters '
        f'for {mission_s} seconds and stays in the air while {driving}. '
        f'The scenario lasts {configuration.seconds} seconds.'
    )


def specification(configuration: Configuration) -> ScenarioSpec:
    """Return the specification.

    Raises:
        ScenarioRefusedError: The parser does not understand the prompt as meant.
    """
    outcome = parse_stage(installed(), prompt(configuration), MAP_NAME, SEED)
    spec = outcome.spec
    if spec is None or len(spec.agents) != configuration.agents or len(spec.missions) != 1:
        found = 'no scenario' if spec is None else f'{len(spec.agents)} agents'
        raise ScenarioRefusedError(f'expected {configuration}, the parser found {found}')
    return spec if configuration.uavs == 1 else _with_uavs(spec, configuration.uavs)


@lru_cache(maxsize=32)
def grounded(configuration: Configuration) -> Agsg:
    """Return the grounded graph, ready for `execution_stage` and for `/aurora/execute`.

    Raises:
        ScenarioRefusedError: A stage refuses the scenario, or an agent found no place.
    """
    spec = specification(configuration)
    graph = build_agsg(spec, map_digest=installed().map(MAP_NAME).digest)
    feasibility = check_stage(installed(), graph)
    if feasibility.result is Feasibility.INFEASIBLE:
        raise ScenarioRefusedError(f'{configuration} is infeasible: {feasibility}')
    outcome = ground_stage(installed(), graph, SEED)
    if outcome.agsg is None or outcome.unsupported:
        why = outcome.failure.reason if outcome.failure else ', '.join(outcome.unsupported)
        raise ScenarioRefusedError(f'{configuration} cannot be grounded: {why}')
    return outcome.agsg


def _with_uavs(spec: ScenarioSpec, count: int) -> ScenarioSpec:
    """Repeat the first UAV and its mission; the copies belong to no piece of the prompt."""
    document = spec.model_dump()
    first_uav, first = document['uavs'][0], document['missions'][0]
    for number in range(2, count + 1):
        uav = f'uav{number}'
        document['uavs'] = (*document['uavs'], {**first_uav, 'id': uav, 'span': None})
        altitude = {**first['altitude_m'], 'value': float(_LOWEST_M + _STEP_M * (number - 1))}
        copy = {**first, 'id': f'm{number}', 'uav': uav, 'altitude_m': altitude, 'span': None}
        for name, value in copy.items():
            if isinstance(value, dict) and 'provenance' in value:
                copy[name] = {**value, 'provenance': Provenance.DEFAULT, 'span': None}
        document['missions'] = (*document['missions'], copy)
    return ScenarioSpec.model_validate(document)
