# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Requests as documents, and what the check says of them."""

from __future__ import annotations

from functools import cache
from typing import Any

from aurora_core.feasibility.check import check_request
from aurora_core.knowledge.agent_types import load_agent_types
from aurora_core.knowledge.config_files import config_path
from aurora_core.knowledge.limits import load_limits, load_tolerances
from aurora_core.knowledge.map_model import load_map
from aurora_core.outcomes.feasibility import CheckStage, FeasibilityVerdict
from aurora_core.spec.scenario import ScenarioSpec

PROMPT = 'A drone looks at a car, a bus and a van for as long as it is asked to.'


def number(value: float, unit: str, **more: Any) -> dict[str, Any]:
    return {
        'value': value,
        'unit': unit,
        'low': value,
        'high': value,
        'provenance': 'explicit',
        'span': {'start': 0, 'end': 7},
        **more,
    }


def asked(ident: str, quantity: str, of: list[str], op: str, value: float, unit: str) -> Any:
    return {
        'id': ident,
        'quantity': quantity,
        'of': of,
        'op': op,
        'value': number(value, unit),
        'span': {'start': 8, 'end': 20},
    }


def request(
    conditions: list[Any], missions: int | list[dict[str, Any]] = 1, **more: Any
) -> ScenarioSpec:
    flown = (
        missions
        if isinstance(missions, list)
        else [
            {
                'id': f'm{k}',
                'uav': 'uav1',
                'mode': 'track',
                'target': 'car1',
                'altitude_m': {**number(30.0, 'm'), 'provenance': 'default', 'span': None},
                'standoff_m': {**number(0.0, 'm'), 'provenance': 'default', 'span': None},
                'duration_s': {**number(30.0, 's'), 'provenance': 'default', 'span': None},
            }
            for k in range(missions)
        ]
    )
    agents = [{'id': 'car1', 'type': 'car'}, {'id': 'bus1', 'type': 'bus'}]
    return ScenarioSpec.model_validate(
        {
            'prompt': PROMPT,
            'agents': agents,
            'uavs': [{'id': 'uav1'}],
            'missions': flown,
            'conditions': conditions,
            **more,
        }
    )


# A map is loaded once for all tests.
map_of = cache(load_map)


def judged(
    spec: ScenarioSpec, *without: CheckStage, map_name: str = 'downtown'
) -> FeasibilityVerdict:
    return check_request(
        spec,
        map_of(map_name),
        load_limits(config_path('limits.json')),
        load_tolerances(config_path('tolerances.json')),
        load_agent_types(),
        without=frozenset(without),
    )
