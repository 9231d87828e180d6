# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What a reader got wrong, or what may be meant otherwise, proves nothing."""

from __future__ import annotations

from typing import Any

import pytest
from requests_by_hand import asked, judged, number, request

from aurora_core.outcomes.feasibility import Certificate, Feasibility, Rule
from aurora_core.recheck import Outcome, recheck


def forged(rule: Rule, path: str, **more: Any) -> Certificate:
    return Certificate(
        kind='contradiction', reason='spatial_contradiction', path=path, sentence='', rule=rule,
        **more,
    )  # fmt: skip


MISREAD = {
    'the altitude of a car': ('altitude', ['car1'], 'm', 50.0, 30.0),
    'the altitude of two': ('altitude', ['uav1', 'car1'], 'm', 50.0, 30.0),
    'the distance to itself': ('distance', ['car1', 'car1'], 'm', 50.0, 30.0),
    'the distance of one': ('distance', ['car1'], 'm', 50.0, 30.0),
    'the speed of a place': ('speed', ['intersection'], 'm/s', 12.0, 8.0),
    'a drift of a bus': ('hover_drift', ['bus1'], 'm', 3.0, 1.0),
}


@pytest.mark.parametrize('name', MISREAD)
def test_a_condition_of_what_has_no_such_quantity_proves_nothing(name: str) -> None:
    quantity, of, unit, high, low = MISREAD[name]
    spec = request(
        [asked('c1', quantity, of, '>', high, unit), asked('c2', quantity, of, '<', low, unit)]
    )
    assert judged(spec).certificates == ()
    proof = forged(Rule.BOUNDS, 'conditions/c2')
    assert recheck(proof, spec.model_dump(mode='json')).outcome is Outcome.REFUTED


@pytest.mark.parametrize(('value', 'quantity', 'of'), [(300.0, 'altitude', 'car1')])
def test_a_limit_of_another_kind_of_body_proves_nothing(
    value: float, quantity: str, of: str
) -> None:
    spec = request([asked('c1', quantity, [of], '>=', value, 'm')])
    assert judged(spec).certificates == ()


def test_a_flight_in_two_phases_may_be_asked_one_thing_after_the_other() -> None:
    both = [
        asked('c1', 'altitude', ['uav1'], '>', 50.0, 'm'),
        asked('c2', 'altitude', ['uav1'], '<', 40.0, 'm'),
    ]
    once, twice = judged(request(both)), judged(request(both, missions=2))
    assert [c.rule for c in once.certificates] == [Rule.BOUNDS]
    assert recheck(once.certificates[0], request(both).model_dump(mode='json')).valid
    assert (twice.result, twice.certificates) == (Feasibility.UNKNOWN, ())
    assert 'different parts' in twice.notes[0]


def test_shares_that_leave_room_for_each_other_are_no_contradiction() -> None:
    for share, refused in ((0.4, False), (0.6, True)):
        part = {'fraction': number(share, '1')}
        spec = request(
            [
                {**asked('c1', 'speed', ['car1'], '>', 9.0, 'm/s'), **part},
                {**asked('c2', 'speed', ['car1'], '<', 5.0, 'm/s'), **part},
            ]
        )
        assert bool(judged(spec).certificates) is refused


def test_the_words_of_a_count_bring_no_more_than_it_counts() -> None:
    words = {'start': 0, 'end': 7}
    count = {'id': 'n1', 'kind': 'vehicle', 'value': number(2.0, '1'), 'span': words}
    own = [{'id': f'car{k}', 'type': 'car', 'span': words} for k in (1, 2)]
    named = {'id': 'bus1', 'type': 'bus', 'span': {'start': 8, 'end': 12}}
    spec = request([], agents=[*own, named], counts=[count])
    assert judged(spec).certificates == ()
    three = [{**a, 'span': {'start': 8, 'end': 12}} for a in (*own, named)]
    more = request([], agents=three, counts=[count])
    [proof] = judged(more).certificates
    assert (proof.rule, proof.reason) == (Rule.SCENE, 'count')
    assert recheck(proof, more.model_dump(mode='json')).valid
    assert not recheck(proof, spec.model_dump(mode='json')).valid


def test_what_only_the_tolerances_allow_is_doubted() -> None:
    # In fog the camera reaches 75 m; the altitude may be missed by 2 m.
    spec = request([], world={'weather': 'fog'})
    (mission,) = spec.missions
    high = mission.altitude_m.model_validate(number(78.0, 'm'))
    spec = spec.model_copy(update={'missions': (mission.model_copy(update={'altitude_m': high}),)})
    verdict = judged(spec)
    assert verdict.result is Feasibility.UNKNOWN
    assert 'Only inside the tolerances' in verdict.notes[0]


def test_a_limit_is_named_of_the_number_that_it_binds() -> None:
    spec = request([asked('c1', 'speed', ['car1'], '>=', 40.0, 'm/s')])
    proof = Certificate(
        kind='limit_exceeded',
        reason='speed_limit',
        path='conditions/c1/value',
        requested=40.0,
        unit='m/s',
        limit_name='agent_types/bus/max_speed_mps',
        limit=28.0,
        rule=Rule.LIMIT,
        sentence='',
    )
    assert recheck(proof, spec.model_dump(mode='json')).outcome is Outcome.REFUTED
