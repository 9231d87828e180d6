# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What a specification puts before what."""

from __future__ import annotations

from aurora_bench.fidelity.answer import offline_answer
from aurora_bench.fidelity.moments import landing_of, precedence

FLIGHTS = 'Drone A hovers over City Hall at 30 m. Drone B tracks a bus. '


def _pairs(text: str) -> frozenset[tuple[str, str]]:
    spec = offline_answer(FLIGHTS + text).spec
    assert spec is not None
    return precedence(spec)


def test_what_waits_for_the_end_of_a_flight_waits_for_its_landing() -> None:
    pairs = _pairs('Drone A lands before drone B lands.')
    assert (landing_of('uav1'), 'e1') in pairs
    assert ('m1', 'e1') in pairs
    assert ('e1', landing_of('uav1')) not in pairs


def test_landings_of_which_nothing_is_said_have_no_order() -> None:
    pairs = _pairs('Both land.')
    landings = {landing_of('uav1'), landing_of('uav2')}
    assert not [pair for pair in pairs if set(pair) <= landings]
    assert ('m1', landing_of('uav1')) in pairs
