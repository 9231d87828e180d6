# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""A proof by the map holds on its own map, and none of one map is given for another."""

from __future__ import annotations

from typing import Any

import pytest
from requests_by_hand import judged, map_of, number

from aurora_core.feasibility.zones import roof_of
from aurora_core.knowledge.map_model import MapModel
from aurora_core.knowledge.map_types import Landmark
from aurora_core.outcomes.feasibility import FeasibilityVerdict, Rule
from aurora_core.recheck import recheck
from aurora_core.spec.scenario import ScenarioSpec

MAPS = ('downtown', 'helsinki', 'junction')
# A hover may be missed by so much in height, and the gap over a roof is kept as well.
_ABOVE_M = 10.0
_BELOW_M = 3.5


@pytest.fixture(scope='module')
def maps() -> dict[str, MapModel]:
    return {name: map_of(name) for name in MAPS}


def hover(map_name: str, landmark: str, altitude_m: float, **more: Any) -> ScenarioSpec:
    prompt = f'A drone hovers over {landmark} at {altitude_m:g} m for 20 seconds.'
    mission = {
        'id': 'm1',
        'uav': 'uav1',
        'mode': 'hover',
        'target': f'landmark:{landmark}',
        'altitude_m': number(altitude_m, 'm'),
        'duration_s': number(20.0, 's'),
        **more,
    }
    return ScenarioSpec.model_validate(
        {
            'prompt': prompt,
            'uavs': [{'id': 'uav1'}],
            'missions': [mission],
            'world': {'map_name': map_name},
        }
    )


def said(spec: ScenarioSpec, map_model: MapModel) -> FeasibilityVerdict:
    return judged(spec, map_name=map_model.name)


def top_m(map_model: MapModel, mark: Landmark) -> float | None:
    """Return the height of the one building that a landmark stands in; None where it has none."""
    around = [b for b in map_model.buildings if roof_of(mark, (b,)) is not None]
    return around[0].height_m if len(around) == 1 else None


def on(spec: ScenarioSpec, map_name: str) -> dict[str, Any]:
    document: dict[str, Any] = spec.model_dump(mode='json')
    document['world']['map_name'] = map_name
    return document


@pytest.mark.parametrize('name', MAPS)
def test_proofs_by_the_buildings_of_a_map_hold_there_alone(
    maps: dict[str, MapModel], name: str
) -> None:
    own = maps[name]
    refused = 0
    for mark in own.landmarks:
        height = top_m(own, mark)
        if height is None or height < 8.0 or height + _ABOVE_M > 120.0:
            continue
        high = said(hover(name, mark.name, height + _ABOVE_M), own)
        assert not [c for c in high.certificates if c.rule is Rule.ROOF], mark.name
        low = hover(name, mark.name, height - _BELOW_M)
        for proof in said(low, own).certificates:
            refused += proof.rule is Rule.ROOF
            assert recheck(proof, low.model_dump(mode='json')).valid, mark.name
            other = MAPS[(MAPS.index(name) + refused) % len(MAPS)]
            if other != name:
                assert not recheck(proof, on(low, other)).valid, (mark.name, other)
    assert refused, 'no landmark of this map has a building that anything is refused for'


def test_a_no_fly_zone_of_one_map_is_none_of_another(maps: dict[str, MapModel]) -> None:
    over = hover('downtown', 'Signal Tower', 80.0)
    proofs = [c for c in said(over, maps['downtown']).certificates if c.rule is Rule.ZONE]
    assert proofs
    for other in ('helsinki', 'junction'):
        assert not recheck(proofs[0], on(over, other)).valid
        # The same request there: the place is not known, so nothing is proven by a zone.
        there = ScenarioSpec.model_validate(on(over, other))
        assert not [c for c in said(there, maps[other]).certificates if c.rule is Rule.ZONE]


def test_the_zone_of_a_map_without_landmarks_in_it_refuses_none_of_them(
    maps: dict[str, MapModel],
) -> None:
    own = maps['junction']
    assert own.zones
    for mark in own.landmarks:
        verdict = said(hover('junction', mark.name, 60.0), own)
        assert not verdict.certificates, mark.name


def test_the_way_between_two_places_is_that_of_the_map(maps: dict[str, MapModel]) -> None:
    """Two hovers that need most of the battery: the way decides, and each map has its own."""
    own = maps['downtown']
    marks = {m.name: m for m in own.landmarks}
    assert {'Ridge School', 'Eastgate Stadium'} <= set(marks)
    missions = [
        {
            'id': f'm{k}',
            'uav': 'uav1',
            'mode': 'hover',
            'target': f'landmark:{place}',
            'altitude_m': number(60.0, 'm'),
            'duration_s': number(737.0, 's'),
        }
        for k, place in enumerate(('Ridge School', 'Eastgate Stadium'))
    ]
    spec = ScenarioSpec.model_validate(
        {
            'prompt': 'A drone hovers over Ridge School and then over Eastgate Stadium.',
            'uavs': [{'id': 'uav1'}],
            'missions': missions,
            'world': {'map_name': 'downtown'},
        }
    )
    proofs = [c for c in said(spec, own).certificates if c.rule is Rule.BATTERY]
    assert proofs
    assert recheck(proofs[0], spec.model_dump(mode='json')).valid
    assert not recheck(proofs[0], on(spec, 'helsinki')).valid
