# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The shipped configuration, scenes read from prompts, and their groundings, made once."""

from __future__ import annotations

import sys
from collections.abc import Callable, Mapping
from functools import cache
from types import FrameType, ModuleType
from typing import Any

import pytest
import spec_strategies
import trace_builder
import trace_cases
from hypothesis.strategies import SearchStrategy

from aurora_core.grounding.ground import Grounder
from aurora_core.knowledge.agent_types import AgentTypeRecord, load_agent_types
from aurora_core.knowledge.config_files import config_path
from aurora_core.knowledge.limits import Limits, Tolerances, load_limits, load_tolerances
from aurora_core.knowledge.map_model import MapModel, load_map
from aurora_core.knowledge.settings import Settings, load_settings
from aurora_core.outcomes.grounded import GroundedScenario
from aurora_core.outcomes.grounding import GroundingFailure
from aurora_core.outcomes.parse import ParseContext
from aurora_core.parsing.parser import parse_offline
from aurora_core.planning.complete import complete
from aurora_core.spec.parameter import Bound, Parameter, Provenance, Span, Unit
from aurora_core.spec.scenario import ScenarioSpec

# What a trace function returns: itself.
TraceFunction = Callable[[FrameType, str, Any], Any]

# The prompts of the paper, by what they are about.
PROMPTS = {
    'survey': (
        'In clear weather at midday, a drone flies a rectangular survey route at 30 meters '
        'altitude over the streets around the ego car.'
    ),
    'motorcycle': (
        'A drone ascends to 40 meters and then follows a motorcycle as it drives through the '
        'streets.'
    ),
    'convoy': (
        'A bus drives ahead of the ego car and an ambulance follows behind it while two '
        'background cars circulate; a drone tracks the bus from 35 meters.'
    ),
    'tailgate': (
        'A van tailgates the ego car closely, closing from 45 meters; a tracking drone alerts the '
        'ego when the van comes within 20 meters.'
    ),
}

_map = cache(load_map)


@cache
def _limits() -> Limits:
    return load_limits(config_path('limits.json'))


@cache
def _tolerances() -> Tolerances:
    return load_tolerances(config_path('tolerances.json'))


_settings = cache(load_settings)
_types = cache(load_agent_types)


@cache
def _grounder(map_name: str) -> Grounder:
    return Grounder(_map(map_name), _types(), _limits(), _tolerances(), _settings())


@cache
def _ground(spec_json: str, map_name: str, seed: int) -> GroundedScenario | GroundingFailure:
    return _grounder(map_name).ground(ScenarioSpec.model_validate_json(spec_json), seed)


def _read(prompt: str, map_name: str = 'downtown') -> ScenarioSpec:
    text = PROMPTS.get(prompt, prompt)
    marks = tuple(mark.name for mark in _map(map_name).landmarks)
    outcome = parse_offline(text, ParseContext(map_name=map_name, landmark_names=marks))
    assert outcome.spec is not None, (outcome.question, outcome.refusals)
    return complete(outcome.spec, _limits())


def _parameter(
    value: float,
    unit: str = 'm',
    *,
    explicit: bool = True,
    bound: Bound = Bound.EXACTLY,
    approximate: bool = False,
) -> Parameter:
    return Parameter(
        value=value,
        unit=Unit(unit),
        low=min(0.0, value),
        high=max(1e4, value),
        provenance=Provenance.EXPLICIT if explicit else Provenance.DEFAULT,
        span=Span(start=0, end=1) if explicit else None,
        bound=bound,
        approximate=approximate,
    )


def _steps(function: Callable[[], object]) -> int:
    count = 0

    def count_line(_frame: FrameType, event: str, _argument: object) -> TraceFunction:
        nonlocal count
        count += event == 'line'
        return count_line

    before = sys.gettrace()
    sys.settrace(count_line)
    try:
        function()
    finally:
        sys.settrace(before)
    return count


@pytest.fixture(scope='session')
def steps_of() -> Callable[[Callable[[], object]], int]:
    """Count the lines of Python that a call executes: what it costs, on any machine, busy or not.

    Work inside numpy counts as the line that asks for it.
    """
    return _steps


@pytest.fixture(scope='session')
def limits() -> Limits:
    """The shipped limits."""
    return _limits()


@pytest.fixture(scope='session')
def tolerances() -> Tolerances:
    """The shipped tolerances."""
    return _tolerances()


@pytest.fixture(scope='session')
def settings() -> Settings:
    """The shipped settings."""
    return _settings()


@pytest.fixture(scope='session')
def agent_types() -> Mapping[str, AgentTypeRecord]:
    """The shipped agent types."""
    return _types()


@pytest.fixture(scope='session')
def map_of() -> Callable[[str], MapModel]:
    """Return a shipped map by name."""
    return _map


@pytest.fixture(scope='session')
def read_prompt() -> Callable[..., ScenarioSpec]:
    """Return the specification of a prompt (or of one of the paper's by its name)."""
    return _read


@pytest.fixture(scope='session')
def ground() -> Callable[..., GroundedScenario | GroundingFailure]:
    """Ground a specification on a map; the same one is grounded once."""

    def grounded(
        spec: ScenarioSpec, map_name: str = 'downtown', seed: int = 1
    ) -> GroundedScenario | GroundingFailure:
        return _ground(spec.canonical_json(), map_name, seed)

    return grounded


@pytest.fixture(scope='session')
def parameter() -> Callable[..., Parameter]:
    """Make a parameter; by default one that the prompt states."""
    return _parameter


@pytest.fixture(scope='session')
def specifications() -> SearchStrategy[ScenarioSpec]:
    """Any specification that the schema allows, for hypothesis."""
    return spec_strategies.specifications()


@pytest.fixture(scope='session')
def tb() -> ModuleType:
    """The names of `trace_builder` and of `trace_cases`."""
    both = ModuleType('tb')
    for module in (trace_builder, trace_cases):
        vars(both).update({k: v for k, v in vars(module).items() if not k.startswith('__')})
    return both
