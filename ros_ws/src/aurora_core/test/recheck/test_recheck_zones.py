# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""A flight beside a no-fly zone: refused exactly when no place that is asked for is outside."""

from __future__ import annotations

from dataclasses import replace
from functools import cache
from itertools import product
from typing import Any

import numpy as np
import pytest
import shapely

from aurora_core.feasibility.zones import check_zones
from aurora_core.knowledge.config_files import config_path
from aurora_core.knowledge.limits import load_limits, load_tolerances
from aurora_core.knowledge.map_model import load_map
from aurora_core.outcomes.parse import ParseContext
from aurora_core.parsing.parser import parse_offline
from aurora_core.recheck import Outcome, recheck
from aurora_core.spec.scenario import ScenarioSpec

LIMITS = load_limits(config_path('limits.json'))
TOLERANCES = load_tolerances(config_path('tolerances.json'))
MAP = load_map('downtown')
MARKS = {mark.name: mark for mark in MAP.landmarks}
PROMPT = 'A drone flies at the landmark.'

PLACES = ('Signal Tower', 'City Hall', 'Mercy Hospital')
DISTANCES_M = (None, 0.0, 20.0, 40.0, 44.0, 60.0, 108.0, 140.0)
BEARINGS_DEG = (None, 0.0, 90.0, 187.0)
BOUNDS = ('exactly', 'at_least', 'at_most')


def number(value: float, unit: str, bound: str = 'exactly') -> dict[str, Any]:
    return {
        'value': value,
        'unit': unit,
        'low': -1e6,
        'high': 1e6,
        'provenance': 'explicit',
        'span': {'start': 0, 'end': len(PROMPT)},
        'bound': bound,
    }


def request(**mission: Any) -> ScenarioSpec:
    whole = {'start': 0, 'end': len(PROMPT)}
    made = {'id': 'm1', 'uav': 'uav1', 'span': whole, **mission}
    clause = {'text': PROMPT, 'span': whole, 'status': 'encoded', 'ids': ['m1']}
    return ScenarioSpec.model_validate(
        {'prompt': PROMPT, 'uavs': [{'id': 'uav1'}], 'missions': [made], 'clauses': [clause]}
    )


def hover(place: str, standoff: Any, bearing: Any, altitude_m: float = 40.0) -> ScenarioSpec:
    return request(
        mode='hover',
        target=f'landmark:{place}',
        altitude_m=number(altitude_m, 'm'),
        standoff_m=standoff,
        bearing_deg=bearing,
        duration_s=number(30.0, 's'),
    )


def orbit(place: str, radius: Any) -> ScenarioSpec:
    return request(
        mode='navigate',
        pattern='orbit',
        target=f'landmark:{place}',
        altitude_m=number(40.0, 'm'),
        radius_m=radius,
        speed_mps=number(8.0, 'm/s'),
    )


def slack_m(value: float) -> float:
    return max(5.0, 0.1 * value)


def distances(value: float | None, bound: str, bearing: float | None) -> tuple[float, float]:
    if value is None:
        return (0.0, 13.0) if bearing is None else (0.0, 150.0)
    near = 0.0 if bound == 'at_most' else max(0.0, value - slack_m(value))
    return near, 150.0 if bound == 'at_least' else value + slack_m(value)


@cache
def all_inside(place: str, near: float, far: float, bearing: float | None) -> bool:
    """Whether every place of a fine grid over what is asked for lies in one zone."""
    mark = MARKS[place]
    low, high = (0.0, 360.0) if bearing is None else (bearing - 15.0, bearing + 15.0)
    angles = np.radians(np.linspace(low, high, 181))
    spots = np.linspace(near, far, 61)[:, None]
    x, y = mark.x_m + spots * np.sin(angles), mark.y_m + spots * np.cos(angles)
    return any(
        bool(shapely.contains_xy(shapely.Polygon(zone.ring), x, y).all()) for zone in MAP.zones
    )


def refusals(spec: ScenarioSpec) -> list[Any]:
    return list(check_zones(spec, MAP.zones, MAP.landmarks, LIMITS, TOLERANCES))


def some_refusal() -> Any:
    return refusals(hover('Signal Tower', None, None))[0]


CASES = tuple(
    (place, distance, bearing, bound)
    for place, distance, bearing, bound in product(PLACES, DISTANCES_M, BEARINGS_DEG, BOUNDS)
    if distance is not None or bound == 'exactly'
)


@pytest.mark.parametrize('place', PLACES)
def test_a_hover_is_refused_when_every_place_is_inside(place: str) -> None:
    forged = some_refusal()
    for where, distance, bearing, bound in CASES:
        if where != place:
            continue
        spec = hover(
            place,
            None if distance is None else number(distance, 'm', bound),
            None if bearing is None else number(bearing, 'deg'),
        )
        case = (place, distance, bearing, bound)
        inside = all_inside(place, *distances(distance, bound, bearing), bearing)
        found = refusals(spec)
        assert bool(found) is inside, case
        document = spec.model_dump(mode='json')
        assert all(recheck(proof, document).valid for proof in found), case
        again = recheck(forged.model_copy(update={'facts': ()}), document)
        assert (again.outcome is Outcome.VALID) is inside, (case, again.steps)


def test_the_cases_are_of_both_kinds() -> None:
    inside = [all_inside(p, *distances(d, b, a), a) for p, d, a, b in CASES]
    assert inside.count(True) >= 10
    assert inside.count(False) >= 100


@pytest.mark.parametrize(
    ('place', 'radius_m', 'bound', 'refused'),
    [
        ('Signal Tower', 30.0, 'exactly', True),
        ('Signal Tower', 30.0, 'at_most', True),
        ('Signal Tower', 30.0, 'at_least', False),  # 100 m is at least 30 m
        ('Signal Tower', 48.0, 'exactly', False),  # 53 m is within the tolerance, and outside
        ('Signal Tower', 100.0, 'exactly', False),
        ('Signal Tower', 100.0, 'at_most', False),
        ('Mercy Hospital', 100.0, 'exactly', True),  # round the hospital, through its helipad
        ('Mercy Hospital', 60.0, 'exactly', False),
        ('Mercy Hospital', 150.0, 'exactly', False),
        ('Mercy Hospital', 100.0, 'at_most', False),
        ('City Hall', 120.0, 'exactly', True),
        ('City Hall', 50.0, 'exactly', False),
    ],
)
def test_a_way_round_is_refused_when_each_allowed_one_crosses_a_zone(
    place: str, radius_m: float, bound: str, refused: bool
) -> None:
    spec = orbit(place, number(radius_m, 'm', bound))
    found = refusals(spec)
    assert bool(found) is refused
    document = spec.model_dump(mode='json')
    assert all(recheck(proof, document).valid for proof in found)
    for zone in MAP.zones:
        forged = some_refusal().model_copy(update={'facts': (), 'word': zone.name})
        assert not recheck(forged, document).valid or refused


def test_above_a_zone_there_is_room() -> None:
    """What may be higher than a zone reaches is not proven to be inside."""
    inside = hover('Signal Tower', None, None, altitude_m=119.0)
    assert refusals(inside)
    low = [replace(zone, ceiling_m=100.0) for zone in MAP.zones]
    assert not list(check_zones(inside, low, MAP.landmarks, LIMITS, TOLERANCES))


@pytest.mark.parametrize(
    ('prompt', 'refused'),
    [
        ('A drone hovers 140 m east of Signal Tower at 40 m.', False),
        ('A drone hovers over Signal Tower at 40 m.', True),
        ('A drone hovers at most 20 m east of Signal Tower at 40 m.', True),
        ('A drone hovers east of Signal Tower at 40 m.', False),
        # Words that tell of the place and are not read: nothing is proven by the rest.
        ('A drone hovers within 100 m of Signal Tower at 40 m altitude.', False),
        # Watched from anywhere; hovered over from one place.
        ('A drone observes Signal Tower at 40 m altitude.', False),
        ('A drone watches Signal Tower from 100 m away at an altitude of 40 m.', False),
        ('A drone orbits Signal Tower at a radius of at least 30 m at 40 m.', False),
    ],
)
def test_prompts_beside_a_zone(prompt: str, refused: bool) -> None:
    names = tuple(mark.name for mark in MAP.landmarks)
    spec = parse_offline(prompt, ParseContext(landmark_names=names)).spec
    assert spec is not None
    found = refusals(spec)
    assert bool(found) is refused
    document = spec.model_dump(mode='json')
    again = recheck(some_refusal().model_copy(update={'facts': (), 'span': None}), document)
    assert again.valid is refused, again.steps
