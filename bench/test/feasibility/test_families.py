# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Both sides of every limit: refused with a proof that holds, or not refused."""

from __future__ import annotations

import copy
import dataclasses

import pytest
from judged_once import judged_once

from aurora_bench.feasibility.corrupt import corrupted
from aurora_bench.feasibility.families import Case, family_cases, typed_cases
from aurora_bench.feasibility.judge import Judged, judged
from aurora_bench.feasibility.other_maps import rests_on_map
from aurora_bench.feasibility.pushes import PUSHES, push_cases
from aurora_cli.installed import installed
from aurora_core.recheck.request import node_at
from aurora_core.spec.scenario import ScenarioSpec

# Many bodies make a long test of the same thing.
_MOST_AGENTS = 60
CASES = tuple(
    c for c in family_cases() if c.spec is not None and len(c.spec.agents) <= _MOST_AGENTS
)


def result_of(ident: str) -> Judged:
    """Judge a case once, however many tests look at what is said of it."""
    (case,) = (c for c in CASES if c.id == ident)
    return judged_once(installed(), 'downtown', case)


@pytest.mark.parametrize('case', CASES, ids=lambda case: case.id)
def test_what_cannot_be_is_refused_and_its_neighbour_is_not(case: Case) -> None:
    result = result_of(case.id)
    assert result.refused is case.must_be_refused
    assert not result.refused or result.right_reason
    assert all(result.valid)


ONCE = [c for c in CASES if c.must_be_refused and c.id.endswith('-refused-1')]


@pytest.mark.parametrize('case', ONCE, ids=lambda case: case.id)
def test_what_could_be_asked_instead_is_not_refused(case: Case) -> None:
    """Each value alone, unless a proof that has nothing to do with it is left."""
    result = result_of(case.id)
    if len(result.certificates) > 1:
        pytest.skip('it is refused for several reasons')
    for mend in result.certificates[0].mends:
        document = copy.deepcopy(result.document)
        number = node_at(document, mend.path)
        if not isinstance(number, dict):
            continue  # as many elements as can be
        number['value'] = mend.nearest
        asked = dataclasses.replace(case, spec=ScenarioSpec.model_validate(document))
        assert not judged(installed(), 'downtown', asked).refused, mend


def test_most_refusals_are_told_with_a_value_that_can_be() -> None:
    """None where no number of the request is at fault, or one alone mends nothing."""
    told = [p for c in ONCE for p in result_of(c.id).certificates]
    assert len([p for p in told if p.mends]) >= 0.9 * len(told)


def test_corrupted_certificates_are_rejected() -> None:
    results = [result_of(case.id) for case in CASES[::3]]
    broken = corrupted(results, 300, 1)
    assert len(broken) > 100
    assert [b for b in broken if b.accepted] == []


def test_every_push_goes_over_a_limit_of_a_request_that_fits_it() -> None:
    bases = tuple((c.id, c.spec) for c in CASES if c.spec is not None and not c.must_be_refused)
    cases = list(push_cases(bases, 2))
    pushed = {c.id.partition('-over:')[0] for c in cases if c.must_be_refused}
    assert len(pushed & {p.id for p in PUSHES}) >= 10
    for case in cases:
        assert judged(installed(), 'downtown', case).refused is case.must_be_refused, case.id


def test_the_typed_requests_are_on_both_sides_of_every_reason() -> None:
    typed = tuple(typed_cases())
    assert len({(c.source, c.id) for c in typed}) == len(typed) == 208
    refused = {c.because[0] for c in typed if c.must_be_refused}
    kept = {c.id.partition('-kept-')[0] for c in typed if not c.must_be_refused}
    assert refused == kept >= {'geofence', 'clearance', 'sensing_range', 'comm_range', 'count'}


def test_what_needs_the_map_is_known_as_such() -> None:
    """Proofs by zones and landmarks are held against other maps; a limit is one everywhere."""
    asked = {'geofence-over-refused-1': True, 'sensing-elsewhere-refused-1': True}
    for ident, expected in (asked | {'space-altitude-refused-1': False}).items():
        result = result_of(ident)
        assert [rests_on_map(p) for p in result.certificates] == [expected], ident
