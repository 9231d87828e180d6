# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The network of a request: its points and bounds, each as the check derives it by itself."""

from __future__ import annotations

import math
from collections.abc import Callable
from itertools import chain

import pytest
from time_pairs import OPEN, PAIRS, after, at, brakes, hover, landed, lasting, order, request

from aurora_core.knowledge.limits import Limits, Tolerances
from aurora_core.outcomes.feasibility import BoundKind
from aurora_core.recheck.request import Request
from aurora_core.recheck.times import derived
from aurora_core.spec.scenario import ScenarioSpec
from aurora_core.temporal.demands import demands
from aurora_core.temporal.links import Basis, Link
from aurora_core.temporal.network import contradictions, core_links, first_conflict

REQUESTS = {
    **{f'{pair.name}: cannot': pair.cannot for pair in PAIRS},
    **{f'{pair.name}: can': pair.can for pair in PAIRS},
    **OPEN,
}
NAMES = ['survey', 'motorcycle', 'convoy', 'tailgate']


def links(spec: ScenarioSpec, limits: Limits, tolerances: Tolerances) -> list[Link]:
    basis = Basis(spec=spec, limits=limits, tolerances=tolerances)
    return [*core_links(basis), *chain.from_iterable(demands(basis))]


def same_as_derived(spec: ScenarioSpec, found: list[Link]) -> None:
    """Assert that the check, which shares no code with the network, has every bound as well."""
    twins = list(derived(Request(spec.model_dump(mode='json'))))
    for link in found:
        mine = [
            d
            for d in twins
            if (d.kind, d.of, d.earlier, d.later) == (link.kind, link.of, link.earlier, link.later)
        ]
        least = [d.least_s for d in mine if math.isfinite(d.least_s)]
        most = [d.most_s for d in mine if math.isfinite(d.most_s)]
        if link.least_s is not None:
            assert least == [pytest.approx(link.least_s)], link
        else:
            assert most == [pytest.approx(link.most_s)], link


@pytest.mark.parametrize('name', REQUESTS)
def test_the_check_derives_every_bound_by_itself(
    name: str, limits: Limits, tolerances: Tolerances
) -> None:
    spec = REQUESTS[name]
    same_as_derived(spec, links(spec, limits, tolerances))


@pytest.mark.parametrize('name', NAMES)
def test_prompts_of_the_paper_are_consistent_and_derived_the_same(
    name: str, read_prompt: Callable[..., ScenarioSpec], limits: Limits, tolerances: Tolerances
) -> None:
    spec = read_prompt(name)
    found = links(spec, limits, tolerances)
    same_as_derived(spec, found)
    assert first_conflict(found) == ()


def test_points_are_those_of_events_and_flights(limits: Limits, tolerances: Tolerances) -> None:
    spec = request(
        missions=[hover(30.0, 40.0), hover(20.0)],
        events=[at(10.0), after('e1', 5.0, delay_s=None)],
        orders=[order('e1', 'm2')],
        conditions=[landed(200.0)],
        world=lasting(300.0),
    )
    found = links(spec, limits, tolerances)
    assert {p for link in found for p in (link.earlier, link.later)} == {
        'start', 'end', 'uavs/uav1/takeoff', 'uavs/uav1/up', 'uavs/uav1/landed',
        'missions/m1/captured', 'missions/m1/over', 'missions/m2/captured', 'missions/m2/over',
        'events/e1/trigger', 'events/e1', 'events/e1/done',
        'events/e2/trigger', 'events/e2', 'events/e2/done',
    }  # fmt: skip
    [before] = [link for link in found if link.kind is BoundKind.ORDER]
    assert (before.earlier, before.later) == ('events/e1', 'missions/m2/captured')
    asked = [link.of for link in found if link.kind is BoundKind.INSIDE]
    assert asked == ['events/e1', 'events/e2', 'uavs/uav1']


def test_what_nobody_states_bounds_nothing(limits: Limits, tolerances: Tolerances) -> None:
    found = links(request(missions=[hover(None)]), limits, tolerances)
    assert {link.least_s for link in found} == {0.0, None}
    assert [link.kind for link in found if link.most_s is not None] == [BoundKind.BATTERY]


def test_a_circle_is_told_in_the_order_of_time(limits: Limits, tolerances: Tolerances) -> None:
    spec = PAIRS[0].cannot
    basis = Basis(spec=spec, limits=limits, tolerances=tolerances)
    [cycle] = contradictions(basis)
    assert [link.kind.value for link in cycle] == [
        'start', 'climb', 'sequence', 'phase', 'sink', 'deadline',
    ]  # fmt: skip
    needed = sum(link.least_s for link in cycle if link.least_s is not None)
    assert needed > (cycle[-1].most_s or 0.0)


def test_several_circles_are_found_one_after_the_other(
    limits: Limits, tolerances: Tolerances
) -> None:
    waits = [after('e2'), after('e1'), after('e4'), after('e3'), {'action': brakes()}]
    spec = request(events=[*waits, at(50.0)], world=lasting(40.0))
    basis = Basis(spec=spec, limits=limits, tolerances=tolerances)
    found = [{link.of for link in cycle} for cycle in contradictions(basis)]
    assert {'events/e1', 'events/e2'} in found
    assert {'events/e3', 'events/e4'} in found
    assert {'events/e6', 'world/duration_s'} in found
    assert len(found) == 3
