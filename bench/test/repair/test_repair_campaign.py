# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from typing import Any

import pytest

from aurora_bench.repair.__main__ import goals, last_line
from aurora_bench.repair.campaign import Episode
from aurora_bench.repair.faults import KINDS, PLACE, Fault, faults, with_fault
from aurora_core.agsg.parameters import parameters_of
from aurora_core.pipeline.knowledge import installed_knowledge
from aurora_core.spec.parameter import Provenance


def test_faults_are_drawn_of_all_kinds_and_alike_for_a_seed() -> None:
    first = faults(2 * len(KINDS), 1)
    assert first == faults(2 * len(KINDS), 1)
    assert first != faults(2 * len(KINDS), 2)
    assert {fault.kind for fault in first} == set(KINDS)
    assert all(fault.cause in (*fault.values, PLACE) for fault in first)


@pytest.mark.parametrize('fault', faults(len(KINDS), 3), ids=lambda fault: fault.kind)
def test_a_fault_is_what_the_request_has_as_its_default(fault: Fault) -> None:
    known = installed_knowledge()
    spec, cause = with_fault(known, fault, 'downtown')
    found = {path: parameter for path, _, parameter in parameters_of(spec)}
    values = fault.values
    for end, value in values.items():
        [parameter] = [p for path, p in found.items() if path.endswith(end)]
        assert parameter.value == value
        assert parameter.provenance is Provenance.DEFAULT
    assert cause in (*found, PLACE)


def test_only_faults_that_show_are_counted() -> None:
    kind = next(iter(KINDS))

    def episode(key: str, **more: Any) -> Episode:
        fields = {'key': key, 'kind': kind, 'status': 'verified', **more}
        return Episode.model_validate(fields)

    episodes = [
        episode('a', showed=True, repaired=True, simulations=1, localized=True),
        episode('b', showed=True, repaired=False, simulations=5, localized=False),
        episode('c', showed=False),
    ]
    line = last_line(episodes)
    assert line.startswith('repaired 1 of 2 faults  0.500 ')
    assert 'median co-simulations 1 ' in line
    assert 'cause among first three 1 of 2' in line
    met = {goal.name: goal.met for goal in goals(episodes)}
    assert not met['repaired']
    assert met['request unchanged']
