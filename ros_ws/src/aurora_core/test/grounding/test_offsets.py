# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Where UAVs may stand from what they watch, and how far from each other."""

from __future__ import annotations

from itertools import combinations, pairwise
from math import hypot
from typing import Any

import numpy as np
import pytest

from aurora_core.grounding.apart import homes_m, layer_m, ring_m, spacing_m
from aurora_core.grounding.convoy import split_scene
from aurora_core.grounding.offsets import Spread, from_afar, is_lost, loses_sight, offsets
from aurora_core.grounding.releases import convoy_release
from aurora_core.knowledge.config_files import config_path
from aurora_core.knowledge.limits import load_limits
from aurora_core.planning.complete import complete
from aurora_core.spec.parameter import Parameter
from aurora_core.spec.scenario import ScenarioSpec

LIMITS = load_limits(config_path('limits.json'))
EAST = np.array([0.0, 0.0, 1.0, 0.0])


def _number(value: float, unit: str = 'm', provenance: str = 'default') -> dict[str, Any]:
    found: dict[str, Any] = {'value': value, 'unit': unit, 'low': 0.0, 'high': 150.0}
    span = {'span': {'start': 0, 'end': 5}} if provenance == 'explicit' else {}
    return found | {'provenance': provenance} | span


def _spec(count: int, apart_m: float | None, *, altitude: str = 'default') -> ScenarioSpec:
    """Return UAVs that track one bus, and keep a distance from each other."""
    uavs = [f'u{k + 1}' for k in range(count)]
    missions = [
        {
            'id': f'm{k + 1}', 'uav': uav, 'mode': 'track', 'target': 'bus1',
            'altitude_m': _number(40.0, provenance=altitude), 'standoff_m': _number(0.0),
            'duration_s': _number(30.0, 's'),
        }
        for k, uav in enumerate(uavs)
    ]  # fmt: skip
    asked = [] if apart_m is None else [
        {
            'id': 'c1', 'quantity': 'separation', 'of': uavs, 'op': '>=',
            'value': _number(apart_m),
        }
    ]  # fmt: skip
    lost = {'on': 'occluded', 'observer': 'u1', 'target': 'bus1'}
    return ScenarioSpec.model_validate(
        {
            'prompt': 'Three', 'agents': [{'id': 'bus1', 'type': 'bus'}],
            'uavs': [{'id': uav} for uav in uavs], 'missions': missions, 'conditions': asked,
            'events': [{'id': 'e1', 'trigger': lost, 'action': {'do': 'land', 'uav': 'u1'}}],
        }
    )  # fmt: skip


def test_who_keeps_a_distance_is_stacked_by_more_than_it() -> None:
    done = complete(_spec(3, 20.0), LIMITS)
    heights = sorted(m.altitude_m.value for m in done.missions)
    assert all(b - a > 20.0 for a, b in pairwise(heights))
    usual = sorted(m.altitude_m.value for m in complete(_spec(3, None), LIMITS).missions)
    assert usual == [40.0, 50.0, 60.0]
    # Over each other their starts may lie as usual.
    assert homes_m(done, LIMITS) == 0.0


def test_at_one_stated_height_they_stand_round_their_target_far_enough_apart() -> None:
    done = complete(_spec(3, 20.0, altitude='explicit'), LIMITS)
    assert {m.altitude_m.value for m in done.missions} == {40.0}
    spread = Spread(apart_m=spacing_m(done, LIMITS), strict=True, bearings=12)
    places = [next(iter(offsets(m, EAST, spread, (k, 3)))) for k, m in enumerate(done.missions)]
    # On the way there two of them come nearer, by the square root of two.
    least = min(hypot(a[0] - b[0], a[1] - b[1]) for a, b in combinations(places, 2))
    assert least >= 20.0 * 2.0**0.5
    assert homes_m(done, LIMITS) >= 20.0 * 2.0**0.5


def test_where_nothing_is_asked_the_limits_count() -> None:
    spec = _spec(2, None)
    assert layer_m(spec, LIMITS) == spacing_m(spec, LIMITS) == 2.0 * LIMITS.separation_min_m
    assert ring_m(spec, spec.missions[0], LIMITS) == 0.0


def test_a_standoff_that_nobody_states_is_tried_from_afar() -> None:
    mission = _spec(1, None).missions[0]
    tried = [m.standoff_m.value for m in from_afar(mission, 60.0) if m.standoff_m is not None]
    assert tried[0] == 0.0
    assert tried == sorted(tried)
    assert tried[-1] <= 60.0
    stated = _number(10.0, provenance='explicit')
    said = mission.model_copy(update={'standoff_m': Parameter.model_validate(stated)})
    assert list(from_afar(said, 60.0)) == [said]


def test_only_who_waits_for_it_is_to_lose_sight() -> None:
    spec = _spec(2, None)
    assert [loses_sight(spec, m) for m in spec.missions] == [True, False]


@pytest.mark.parametrize(
    ('seen', 'lost'),
    [('11111', False), ('11001', True), ('11010', False), ('00111', False), ('10011', False)],
)
def test_lost_is_who_was_seen_before_for_more_than_a_sample(seen: str, lost: bool) -> None:
    assert is_lost(np.array([c == '1' for c in seen])) is lost


def _takes_over(*, watched: bool, cause: dict[str, Any]) -> ScenarioSpec:
    """Return a scene in which u2 takes off for the bus when an event says so."""
    spec = _spec(2, None)
    document = spec.model_dump(mode='json')
    first, second = document['missions']
    if not watched:
        first |= {'mode': 'hover', 'target': None, 'standoff_m': None}
    begins = {'do': 'change_mission', 'uav': 'u2', 'mission': second['id']}
    document['events'] = [{'id': 'e1', 'trigger': cause, 'action': begins}]
    return ScenarioSpec.model_validate(document)


ONE_IS_DONE = {'on': 'mission_done', 'uav': 'u1'}


@pytest.mark.parametrize(
    ('watched', 'cause', 'by'),
    [
        (False, ONE_IS_DONE, 'm2'),
        # Who is watched before goes with the first one that is ready.
        (True, ONE_IS_DONE, 'm1'),
        # What it does itself, it has to be free to do.
        (False, {'on': 'speed_above', 'who': 'bus1', 'value_mps': _number(5.0, 'm/s')}, ''),
    ],
)
def test_a_target_waits_for_who_takes_off_for_it(
    watched: bool, cause: dict[str, Any], by: str
) -> None:
    spec = _takes_over(watched=watched, cause=cause)
    assert convoy_release(spec, split_scene(spec)).mission == by
