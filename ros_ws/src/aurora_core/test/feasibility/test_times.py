# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Times that exclude each other are refused with a chain of bounds, their neighbours are not."""

from __future__ import annotations

from itertools import product
from typing import Any

import pytest
from time_pairs import OPEN, PAIRS, Pair, at, event_time, lasting, request

from aurora_core.feasibility.times import check_times
from aurora_core.knowledge.limits import Limits, Tolerances
from aurora_core.outcomes.feasibility import BoundKind, Certificate, TimeBound
from aurora_core.recheck import Outcome, recheck
from aurora_core.spec.scenario import ScenarioSpec

BY_NAME = pytest.mark.parametrize('pair', PAIRS, ids=lambda pair: pair.name)


def _found(spec: ScenarioSpec, limits: Limits, tolerances: Tolerances) -> list[Certificate]:
    return list(check_times(spec, limits, tolerances))


@BY_NAME
def test_what_cannot_be_is_refused_and_its_neighbour_is_not(
    pair: Pair, limits: Limits, tolerances: Tolerances
) -> None:
    [proof] = _found(pair.cannot, limits, tolerances)
    assert (proof.rule, proof.path) == (pair.rule, pair.path)
    assert proof.chain
    assert _found(pair.can, limits, tolerances) == []


@BY_NAME
def test_the_proof_holds_for_one_and_for_the_other_it_does_not(
    pair: Pair, limits: Limits, tolerances: Tolerances
) -> None:
    [proof] = _found(pair.cannot, limits, tolerances)
    again = recheck(proof, pair.cannot.model_dump(mode='json'))
    assert again.outcome is Outcome.VALID, again.steps
    bare = proof.model_copy(update={'facts': ()})
    assert recheck(bare, pair.can.model_dump(mode='json')).outcome is Outcome.REFUTED


@BY_NAME
def test_a_tighter_or_looser_chain_is_refuted(
    pair: Pair, limits: Limits, tolerances: Tolerances
) -> None:
    [proof] = _found(pair.cannot, limits, tolerances)
    document = pair.cannot.model_dump(mode='json')
    for changed in _altered(proof):
        again = recheck(changed, document)
        assert again.outcome is Outcome.REFUTED, (changed.chain, again.steps)


def _altered(proof: Certificate) -> list[Certificate]:
    """Return the proof with one bound tightened, renamed, turned round, or left out."""
    found = []
    for k, bound in enumerate(proof.chain):
        rest = proof.chain[:k], proof.chain[k + 1 :]
        tight: dict[str, Any] = (
            {'most_s': bound.most_s - 1.0}
            if bound.most_s is not None
            else {'least_s': (bound.least_s or 0.0) + 1.0}
        )
        changes: list[dict[str, Any]] = [
            tight,
            {'of': 'events/e99'},
            {'earlier': bound.later, 'later': bound.earlier},
            {'kind': next(kind for kind in BoundKind if kind is not bound.kind)},
        ]
        for change in changes:
            altered = TimeBound.model_validate({**bound.model_dump(), **change})
            found.append((*rest[0], altered, *rest[1]))
        if len(proof.chain) > 1:
            found.append((*rest[0], *rest[1]))
    return [proof.model_copy(update={'chain': chain}) for chain in found]


@pytest.mark.parametrize('sides', [(None, None), (1.0, 2.0)])
def test_a_bound_has_one_side(sides: tuple[float | None, float | None]) -> None:
    least_s, most_s = sides
    with pytest.raises(ValueError, match='either a least or a greatest'):
        TimeBound(
            earlier='start',
            later='end',
            least_s=least_s,
            most_s=most_s,
            kind=BoundKind.HORIZON,
            of='world/duration_s',
            words='',
        )


def test_a_chain_about_something_else_is_refuted(limits: Limits, tolerances: Tolerances) -> None:
    for one, other in product(PAIRS, PAIRS):
        if one.path != other.path or one.rule is not other.rule:
            [proof] = _found(one.cannot, limits, tolerances)
            named = proof.model_copy(update={'path': other.path, 'rule': other.rule})
            outcome = recheck(named, one.cannot.model_dump(mode='json')).outcome
            in_chain = any(b.of == other.path for b in proof.chain)
            assert outcome is Outcome.REFUTED or in_chain, (one.name, other.name)


@pytest.mark.parametrize('why', OPEN)
def test_what_is_no_proof_is_not_refused(why: str, limits: Limits, tolerances: Tolerances) -> None:
    assert _found(OPEN[why], limits, tolerances) == []


def test_the_chain_is_told_with_its_numbers(limits: Limits, tolerances: Tolerances) -> None:
    [proof] = _found(PAIRS[0].cannot, limits, tolerances)
    assert proof.sentence == (
        'landed of uav1 is due at 73.6 s; the landing of uav1 comes 73.6 s at the earliest: '
        'uav1 climbs 28 m at 5 m/s at most (5.6 s), m1 at its shortest (58.8 s), '
        'uav1 sinks 27.7 m at 3 m/s at most (9.2 s).'
    )
    assert {fact.path for fact in proof.facts} == {
        'conditions/c1/by_s',
        'missions/m1/altitude_m',
        'missions/m1/duration_s',
        'uav_climb_max_mps',
        'uav_descent_max_mps',
        'altitude_m/absolute',
        'altitude_m/relative',
        'duration_s/absolute',
        'duration_s/relative',
        'touchdown_height_m',
    }


def test_each_demand_has_a_proof_of_its_own(limits: Limits, tolerances: Tolerances) -> None:
    spec = request(
        events=[at(30.0), at(50.0)],
        world=lasting(40.0),
        conditions=[event_time('e1', '<=', 20.0), event_time('e1', '<=', 45.0)],
    )
    found = _found(spec, limits, tolerances)
    assert [proof.path for proof in found] == ['conditions/c1', 'events/e2']


def test_a_proof_without_its_chain_is_not_checked(limits: Limits, tolerances: Tolerances) -> None:
    [proof] = _found(PAIRS[0].cannot, limits, tolerances)
    bare = proof.model_copy(update={'chain': ()})
    outcome = recheck(bare, PAIRS[0].cannot.model_dump(mode='json')).outcome
    assert outcome is Outcome.NOT_CHECKED
