# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Patterns, ways and phases of no extent are refused with a proof, and never break anything."""

from __future__ import annotations

from typing import Any

import pytest

from aurora_core.agsg.build import build_agsg
from aurora_core.outcomes.feasibility import Feasibility, Rule
from aurora_core.pipeline.functions import check_stage, ground_stage, parse_stage
from aurora_core.pipeline.knowledge import installed_knowledge
from aurora_core.recheck import recheck
from aurora_core.spec.parameter import Unit
from aurora_core.spec.scenario import ScenarioSpec

_KNOWN = installed_knowledge()

ORBIT = 'A drone orbits City Hall at a radius of'
REFUSED = (
    (f'{ORBIT} 0 m at 40 m.', 'spatial_contradiction'),
    (f'{ORBIT} -20 m at 40 m.', 'spatial_contradiction'),
    (f'{ORBIT} at most 0 m at 40 m.', 'spatial_contradiction'),
    ('A drone flies a line of 0 m at 40 m.', 'spatial_contradiction'),
    ('A drone flies a rectangle of 0 m by 0 m at 40 m.', 'spatial_contradiction'),
    ('A drone flies a rectangle of 100 m by 0 m at 40 m.', 'spatial_contradiction'),
    (
        'A drone surveys an area of 0 m by 100 m in a lawnmower pattern at 40 m.',
        'spatial_contradiction',
    ),
    ('A drone visits 0 waypoints at 40 m.', 'count'),
    ('A drone visits -3 waypoints at 40 m.', 'count'),
    ('A drone visits 2.5 waypoints at 40 m.', 'count'),
    ('A drone patrols a rectangle at 0 m/s at 40 m.', 'speed_limit'),
    ('A drone hovers for 0 seconds at 40 m.', 'temporal_contradiction'),
)
# Nothing is wrong with the first ones; no place is found for the others, which proves nothing.
OPEN = (
    'A drone visits 1 waypoint at 40 m.',
    'A drone tracks a car at 40 m altitude with a standoff of 0 m.',
    'A drone flies a line of 80 m at 40 m.',
    f'{ORBIT} 0.0000000001 m at 40 m.',
    f'{ORBIT} at least 0 m at 40 m.',
    'A drone patrols a rectangle at at least 0 m/s at 40 m.',
    'A drone visits 1000000 waypoints at 40 m.',
    'A drone surveys an area of 100 m by 20000 m in a lawnmower pattern at 40 m.',
)


def read(prompt: str) -> ScenarioSpec:
    spec = parse_stage(_KNOWN, prompt, 'downtown', 1).spec
    assert spec is not None
    return spec


def forged(spec: ScenarioSpec, path: str) -> Any:
    """Return a certificate by the rule of signs that points at a number of a request."""
    refused = check_stage(_KNOWN, build_agsg(read(REFUSED[0][0]), map_digest='')).certificates[0]
    return refused.model_copy(update={'path': path, 'facts': (), 'span': None})


@pytest.mark.parametrize(('prompt', 'reason'), REFUSED)
def test_what_has_no_extent_is_refused_with_a_proof(prompt: str, reason: str) -> None:
    spec = read(prompt)
    verdict = check_stage(_KNOWN, build_agsg(spec, map_digest=''))
    assert verdict.result is Feasibility.INFEASIBLE
    assert {c.rule for c in verdict.certificates} == {Rule.SIGN}
    assert {c.reason for c in verdict.certificates} == {reason}
    document = spec.model_dump(mode='json')
    for proof in verdict.certificates:
        assert recheck(proof, document).valid


@pytest.mark.parametrize('speed_mps', [15.5, -1.0])
def test_a_wind_beyond_its_limit_is_refused_with_a_proof(speed_mps: float) -> None:
    spec = read(f'{ORBIT} 40 m at 80 m.')
    asked = spec.missions[0].altitude_m.model_copy(
        update={'value': speed_mps, 'unit': Unit.METRE_PER_SECOND}
    )
    spec = spec.model_copy(update={'world': spec.world.model_copy(update={'wind_mps': asked})})
    verdict = check_stage(_KNOWN, build_agsg(spec, map_digest=''))
    assert [(c.rule, c.reason) for c in verdict.certificates] == [(Rule.LIMIT, 'speed_limit')]
    proof, document = verdict.certificates[0], spec.model_dump(mode='json')
    assert recheck(proof, document).valid
    inside = {**document['world'], 'wind_mps': {**document['world']['wind_mps'], 'value': 14.0}}
    assert not recheck(proof, {**document, 'world': inside}).valid


@pytest.mark.parametrize('turns', [0.0, -2.0])
def test_an_orbit_without_turns_is_refused_with_a_proof(turns: float) -> None:
    spec = read(f'{ORBIT} 40 m at 40 m.')
    (mission,) = spec.missions
    asked = mission.altitude_m.model_copy(update={'value': turns, 'unit': Unit.ONE})
    spec = spec.model_copy(update={'missions': (mission.model_copy(update={'turns': asked}),)})
    verdict = check_stage(_KNOWN, build_agsg(spec, map_digest=''))
    assert [(c.rule, c.reason) for c in verdict.certificates] == [(Rule.SIGN, 'count')]
    assert recheck(verdict.certificates[0], spec.model_dump(mode='json')).valid


@pytest.mark.parametrize('prompt', OPEN)
def test_what_can_be_is_not_refused_and_grounding_answers(prompt: str) -> None:
    spec = read(prompt)
    graph = build_agsg(spec, map_digest='')
    assert check_stage(_KNOWN, graph).result is Feasibility.FEASIBLE
    outcome = ground_stage(_KNOWN, graph, 1)
    assert (outcome.agsg is None) is not (outcome.failure is None)


@pytest.mark.parametrize(
    ('prompt', 'path'),
    [
        ('A drone tracks a car at 40 m altitude with a standoff of 0 m.', 'missions/0/standoff_m'),
        (f'{ORBIT} at least 0 m at 40 m.', 'missions/0/radius_m'),
        ('A drone flies a line of 80 m at 40 m.', 'missions/0/size_m/0'),
        ('A drone visits 4 waypoints at 40 m.', 'missions/0/waypoint_count'),
    ],
)
def test_a_forged_proof_by_a_sign_is_refuted(prompt: str, path: str) -> None:
    spec = read(prompt)
    assert not recheck(forged(spec, path), spec.model_dump(mode='json')).valid
