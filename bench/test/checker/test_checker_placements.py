# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Where bodies stand at t = 0."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

DRIVEN = 'car1'


def _ahead(distance: float | None = None, relation: str = 'ahead') -> dict[str, Any]:
    asked: dict[str, Any] = {
        'kind': 'placement',
        'agent': 'car1',
        'relation': relation,
        'of': 'bus1',
    }
    return asked if distance is None else {**asked, 'distance_m': distance}


def _pair(stage: Any, gap: float, lateral: float = 0.0, speed: float = 8.0) -> None:
    stage.drive('bus1', 'bus', speed, x=0.0)
    stage.drive('car1', 'car', speed, x=gap, y=-1.65 + lateral)


@pytest.mark.parametrize(
    ('gap', 'outcome'),
    [
        (25.0, 'holds'),
        (26.0, 'holds'),
        (26.1, 'does_not'),
        (23.9, 'does_not'),
        (-25.0, 'does_not'),
    ],
)
def test_ahead_by_a_distance_along_the_way(stage: Any, gap: float, outcome: str) -> None:
    _pair(stage, gap)
    assert stage.says(_ahead(25)) == outcome


def test_standing_and_walking_bodies_have_the_wider_tolerance(make_stage: Any) -> None:
    parked = make_stage()
    parked.drive('bus1', 'bus', 0.0, route=[(0, -1.65), (280, -1.65)])
    parked.drive('car1', 'car', 0.0, x=26.9)
    assert parked.says(_ahead(25)) == 'holds'
    moving = make_stage()
    _pair(moving, 26.9)
    assert moving.says(_ahead(25)) == 'does_not'


def test_a_variation_is_what_counts(stage: Any) -> None:
    _pair(stage, 28.0)
    asked = {**_ahead(25), 'id': 'p'}
    assert stage.says(asked) == 'does_not'
    assert stage.says(asked, variation={'p.distance_m': [20, 30]}) == 'holds'
    assert stage.says({**asked, 'tol': 4}) == 'holds'


def test_ahead_behind_and_beside_are_told_apart(stage: Any) -> None:
    _pair(stage, 0.0, lateral=-3.3)
    assert stage.says(_ahead(relation='ahead')) == 'does_not'
    assert stage.says(_ahead(relation='beside')) == 'holds'
    assert stage.says(_ahead(relation='right')) == 'holds'
    assert stage.says(_ahead(relation='left')) == 'does_not'
    assert stage.says(_ahead(relation='adjacent_lane')) == 'holds'
    assert stage.says(_ahead(relation='same_lane')) == 'does_not'


@pytest.mark.parametrize(
    ('faster_mps', 'kept', 'outcome'),
    [(0.0, True, 'holds'), (1.0, True, 'does_not'), (1.0, False, 'holds')],
)
@pytest.mark.parametrize('relation', ['beside', 'right'])
def test_a_side_that_is_told_with_motion_holds_on_the_way(
    stage: Any, relation: str, faster_mps: float, kept: bool, outcome: str
) -> None:
    """After a minute at 1 m/s more than the bus the car is 60 m ahead of it."""
    stage.drive('bus1', 'bus', 8.0, x=0.0)
    stage.drive('car1', 'car', 8.0 + faster_mps, x=0.0, y=-4.95)
    assert stage.says(_ahead(relation=relation) | {'kept': kept}) == outcome


def test_behind_in_the_same_lane(stage: Any) -> None:
    _pair(stage, -30.0)
    assert stage.says(_ahead(30, 'behind')) == 'holds'
    assert stage.says(_ahead(30, 'same_lane')) == 'holds'
    assert stage.says(_ahead(20, 'same_lane')) == 'does_not'
    assert stage.says(_ahead(relation='adjacent_lane')) == 'does_not'


def test_ahead_round_a_corner_is_measured_along_the_way(stage: Any) -> None:
    way = [(0.0, 0.0), (100.0, 0.0), (100.0, 200.0)]
    stage.ground('bus1', 'bus', 50.0, 0.0, route=way)
    stage.ground('car1', 'car', 100.0, 50.0, heading=(0.0, 1.0))
    assert stage.says(_ahead(100)) == 'holds'
    assert stage.says(_ahead(70)) == 'does_not'


def test_oncoming_comes_from_ahead(make_stage: Any) -> None:
    for start, back, outcome in ((80.0, True, 'holds'), (-80.0, True, 'does_not')):
        stage = make_stage(5.0)
        stage.drive('bus1', 'bus', 8.0)
        stage.drive('car1', 'car', 8.0, x=start, y=1.65, back=back)
        assert stage.says(_ahead(relation='oncoming')) == outcome
    same_way = make_stage(5.0)
    same_way.drive('bus1', 'bus', 8.0)
    same_way.drive('car1', 'car', 8.0, x=80.0, y=1.65)
    assert same_way.says(_ahead(relation='oncoming')) != 'holds'


def test_places(stage: Any) -> None:
    stage.drive('car1', 'car', 5.0, x=60.0)
    stage.ground('ped1', 'pedestrian', 100.0, 4.5)
    of = {'kind': 'placement', 'agent': 'car1', 'relation': 'before', 'of': 'crosswalk'}
    assert stage.says({**of, 'distance_m': 40}) == 'holds'
    assert stage.says({**of, 'distance_m': 70}) == 'does_not'
    on = {'kind': 'placement', 'agent': 'ped1', 'relation': 'on'}
    assert stage.says({**on, 'of': 'sidewalk'}) == 'holds'
    assert stage.says({**on, 'agent': 'car1', 'of': 'sidewalk'}) == 'does_not'
    at = {**on, 'relation': 'at'}
    assert stage.says({**at, 'of': 'crosswalk'}) == 'holds'
    assert stage.says({**at, 'of': 'intersection'}) == 'does_not'
    assert stage.says({**at, 'relation': 'near', 'of': 'City Hall'}) == 'cannot_tell'
    assert stage.says({**at, 'relation': 'near', 'of': 'Atlantis'}) == 'cannot_tell'


def test_before_the_junction_and_past_it(make_stage: Any) -> None:
    asked = {
        'kind': 'placement',
        'agent': 'car1',
        'relation': 'before',
        'of': 'intersection',
        'distance_m': 50,
    }
    for x, outcome in ((250.0, 'holds'), (330.0, 'does_not')):
        stage = make_stage(10.0)
        stage.drive('car1', 'car', 5.0, x=x, route=[(x, -1.65), (590, -1.65)])
        assert stage.says(asked) == outcome


def test_parked_stands_all_along(make_stage: Any) -> None:
    asked = {'kind': 'placement', 'agent': 'car1', 'relation': 'parked_at', 'of': 'roadside'}
    still = make_stage()
    still.drive('car1', 'car', 0.0, y=-5.5)
    assert still.says(asked) == 'holds'
    moving = make_stage()
    moving.drive('car1', 'car', 5.0, y=-5.5)
    assert moving.says(asked) == 'does_not'
    elsewhere = make_stage()
    elsewhere.drive('car1', 'car', 0.0, y=60.0)
    assert elsewhere.says(asked) == 'does_not'
    later = make_stage()
    later.drive('car1', 'car', lambda t: 5.0 * (t > 30.0), y=-5.5)
    assert later.says(asked) == 'cannot_tell'


def test_every_member_of_a_group_is_placed(stage: Any) -> None:
    stage.drive('bus1', 'bus', 8.0, x=0.0)
    stage.drive('c1', 'car', 8.0, x=20.0)
    stage.drive('c2', 'car', 8.0, x=-20.0)
    cars = {'kind': 'agent', 'ref': 'cars', 'type': 'car', 'count': 2}
    bus = {'kind': 'agent', 'ref': 'bus1', 'type': 'bus'}
    asked = {'kind': 'placement', 'agent': 'cars', 'relation': 'ahead', 'of': 'bus1'}
    others = [{'kind': 'agent', 'ref': r, 'type': 'car', 'count': 0} for r in ('c1', 'c2')]
    assert stage.says(asked, cars, bus, *others) == 'does_not'


@pytest.mark.parametrize(
    ('faster_mps', 'kept', 'follows', 'outcome'),
    [
        (0.0, True, False, 'holds'),
        (1.0, True, False, 'does_not'),
        (1.0, False, False, 'holds'),  # told of t = 0
        (1.0, False, True, 'cannot_tell'),  # follows, from that far away or so far away
        (0.0, False, True, 'holds'),
    ],
)
def test_a_distance_that_is_told_with_motion_holds_on_the_way(
    stage: Any, faster_mps: float, kept: bool, follows: bool, outcome: str
) -> None:
    stage.drive('bus1', 'bus', 8.0, x=0.0)
    stage.drive('car1', 'car', 8.0 + faster_mps, x=25.0)
    asked = _ahead(25) | ({'kept': True} if kept else {})
    more = [{'kind': 'behavior', 'agent': 'bus1', 'behavior': 'follow', 'target': 'car1'}]
    assert stage.says(asked, *(more if follows else [])) == outcome


def test_who_closes_up_to_one_that_stands_keeps_its_distance_on_the_way(stage: Any) -> None:
    # 20 s side by side in time, 40 s of waiting 10 m nearer.
    stage.drive('car1', 'car', lambda t: np.where(t < 20.0, 8.0, 0.0), x=25.0)
    stage.drive('bus1', 'bus', lambda t: np.where(t < 21.2, 8.0, 0.0), x=0.0)
    assert stage.says(_ahead(25) | {'kept': True}) == 'holds'


def test_who_follows_at_a_stated_distance_may_be_as_near_as_that(stage: Any) -> None:
    _pair(stage, 12.0)  # 3.7 m from bumper to bumper
    follows = {'kind': 'behavior', 'agent': 'bus1', 'behavior': 'follow', 'target': 'car1'}
    assert stage.says(follows) == 'does_not'
    assert stage.says(follows, _ahead(12)) == 'holds'
