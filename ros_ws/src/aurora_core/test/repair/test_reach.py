# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from math import hypot

import pytest

from aurora_core.outcomes.agsg import Agsg
from aurora_core.outcomes.parse import ParseOutcome
from aurora_core.outcomes.repair import RepairPlan, ValueEdit, with_values
from aurora_core.pipeline.functions import ground_stage, parse_stage, understood
from aurora_core.pipeline.knowledge import installed_knowledge
from aurora_core.repair.helps import helps
from aurora_core.repair.reach import out_of_reach
from aurora_core.spec.quantity import QuantityName

_KNOWN = installed_knowledge()
PROMPT = (
    'A drone tracks a van and alerts the ego car when the van comes within 40 meters of the drone.'
)
ALTITUDE, STANDOFF = 'missions/m1/altitude_m', 'missions/m1/standoff_m'


def grounded(altitude_m: float, standoff_m: float, prompt: str = PROMPT) -> Agsg:
    parsed = parse_stage(_KNOWN, prompt, 'downtown', 1)
    assert parsed.spec is not None
    assert parsed.agsg is not None
    rows = {row.path: row for row in parsed.agsg.parameters}
    wanted = {ALTITUDE: altitude_m, STANDOFF: standoff_m}
    spec = with_values(
        parsed.spec,
        tuple(
            ValueEdit(
                path=path,
                requested=rows[path].requested,
                realised=value,
                provenance=rows[path].provenance,
            )
            for path, value in wanted.items()
        ),
    )
    graph = understood(_KNOWN, ParseOutcome(spec=spec)).agsg
    assert graph is not None
    found = ground_stage(_KNOWN, graph, 1).agsg
    assert found is not None
    return found


def evidence(agsg: Agsg) -> dict[str, float]:
    [within] = [c for c in agsg.conditions if c.id == 'e1.within']
    return {path: found.aim for path, found in out_of_reach(agsg, within).items()}


@pytest.mark.parametrize(
    ('altitude_m', 'standoff_m', 'cause', 'other_m'),
    [(80.0, 10.0, ALTITUDE, 10.0), (20.0, 70.0, STANDOFF, 20.0)],
)
def test_the_value_that_keeps_away_is_named_with_one_that_does_not(
    altitude_m: float, standoff_m: float, cause: str, other_m: float
) -> None:
    found = evidence(grounded(altitude_m, standoff_m))
    assert set(found) == {cause}
    assert 20.0 < hypot(found[cause], other_m) < 35.0


def test_nothing_is_named_where_it_is_near_enough() -> None:
    assert evidence(grounded(20.0, 10.0)) == {}


def test_a_distance_to_stay_within_is_evidence_as_well() -> None:
    graph = grounded(20.0, 70.0, 'A drone tracks a van and stays within 40 meters of it.')
    [within] = [c for c in graph.conditions if c.id == 'c1.holds']
    found = out_of_reach(graph, within)
    assert set(found) == {STANDOFF}
    assert found[STANDOFF].aim < 35.0


@pytest.mark.parametrize(('gap_m', 'is_named'), [(150.0, True), (20.0, False)])
def test_who_starts_behind_the_greatest_gap_starts_nearer(gap_m: float, is_named: bool) -> None:
    parsed = parse_stage(_KNOWN, 'A car follows a bus.', 'downtown', 1).agsg
    assert parsed is not None
    [row] = [r for r in parsed.parameters if r.path.endswith('placements/0/distance_m')]
    edit = ValueEdit(
        path=row.path, requested=row.requested, realised=gap_m, provenance=row.provenance
    )
    found = ground_stage(_KNOWN, parsed, 1, RepairPlan(values=(edit,))).agsg
    assert found is not None
    [follows] = [c for c in found.conditions if c.quantity is QuantityName.FOLLOW_FRACTION]
    named = out_of_reach(found, follows)
    assert set(named) == ({row.path} if is_named else set())
    assert all(10.0 < evidence.aim < 50.0 for evidence in named.values())


def test_a_start_gap_that_leaves_no_room_to_a_distance_to_keep_is_named_with_a_larger_one() -> (
    None
):
    prompt = (
        'A motorcycle drives behind a bus. The distance between the motorcycle and the bus is '
        'always more than 24 meters.'
    )
    parsed = parse_stage(_KNOWN, prompt, 'downtown', 1).agsg
    assert parsed is not None
    graph = ground_stage(_KNOWN, parsed, 1).agsg
    assert graph is not None
    [kept] = [c for c in graph.conditions if c.quantity is QuantityName.DISTANCE]
    [(path, found)] = out_of_reach(graph, kept).items()
    assert path == 'agents/motorcycle1/placements/0/distance_m'
    assert (found.direction, found.aim) == (1, 144.0)
    assert found.because.endswith('24 m are to be kept')


def test_a_height_that_takes_most_of_a_distance_leaves_a_standoff_that_fits() -> None:
    found = evidence(grounded(31.0, 70.0))
    assert set(found) == {STANDOFF}
    assert hypot(31.0, found[STANDOFF]) < 40.0


@pytest.mark.parametrize(
    ('standoff_m', 'beyond', 'is_named'),
    [(0.0, 60, True), (0.0, 400, False), (70.0, 60, False)],
)
def test_a_tracker_that_stays_near_is_named_where_a_greater_distance_is_waited_for(
    standoff_m: float, beyond: int, is_named: bool
) -> None:
    prompt = (
        'A drone tracks a van. When the distance between the drone and the van is larger than '
        f'{beyond} meters, the drone alerts the ego car.'
    )
    graph = grounded(30.0, standoff_m, prompt)
    [within] = [c for c in graph.conditions if c.id == 'e1.within']
    found = out_of_reach(graph, within)
    assert (STANDOFF in found) == is_named
    if is_named:
        assert found[STANDOFF].direction == 1
        assert hypot(found[STANDOFF].aim, 30.0) > 0.7 * beyond


def test_what_waits_in_vain_for_a_greater_distance_is_not_helped_by_a_smaller_one() -> None:
    names = {(h.name, h.direction) for h in helps(QuantityName.EVENT_DELAY, '<=', gets_far=True)}
    assert {('altitude_m', 1), ('standoff_m', 1)} <= names
    assert not {('altitude_m', -1), ('standoff_m', -1)} & names
