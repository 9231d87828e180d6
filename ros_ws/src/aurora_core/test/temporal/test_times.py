# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Earliest and latest times of plans, and what excludes itself where it was grounded."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from aurora_core.knowledge.limits import Limits, Tolerances
from aurora_core.outcomes.grounded import GroundedScenario
from aurora_core.outcomes.schedule import Schedule
from aurora_core.spec.scenario import ScenarioSpec
from aurora_core.temporal.schedule import plan_time
from aurora_core.temporal.words import named

Plan = Callable[[str], Schedule]

SEQUENCE = (
    'A drone hovers over City Hall at 50 m for 20 seconds and then flies a rectangle of 100 m by '
    '60 m. It must be on the ground by 200 s. At 30 s the bus brakes, and 5 s later the car stops.'
)


@pytest.fixture
def planned(
    read_prompt: Callable[..., ScenarioSpec],
    ground: Callable[..., GroundedScenario],
    limits: Limits,
    tolerances: Tolerances,
) -> Plan:
    """Return the schedule of a prompt."""

    def plan(prompt: str) -> Schedule:
        spec = read_prompt(prompt)
        return plan_time(spec, ground(spec), limits, tolerances)

    return plan


def times(schedule: Schedule) -> dict[str, tuple[float, float]]:
    return {t.point: (t.earliest_s, t.latest_s) for t in schedule.times}


def test_times_follow_from_flight_events_and_deadlines(planned: Plan) -> None:
    schedule = planned(SEQUENCE)
    found = times(schedule)
    assert schedule.conflict == ''
    assert [*found] == [
        'missions/m1/captured',
        'missions/m1/over',
        'missions/m2/captured',
        'missions/m2/over',
        'uavs/uav1/landed',
        'events/e1',
        'events/e2',
    ]
    # 48 m up; 20 s less half a second; the deadline, less 29.5 m at most 3 m/s.
    assert found['missions/m1/captured'][0] == pytest.approx(9.6)
    assert found['missions/m1/over'][0] == pytest.approx(29.1)
    assert found['uavs/uav1/landed'][1] == 200.0
    way = next(f for f in schedule.facts.missions if f.mission == 'm2').transit_m
    assert found['missions/m2/captured'][0] == pytest.approx(29.1 + (way - 6.0) / 18.0)
    assert found['events/e1'] == (29.4, 30.6)
    assert found['events/e2'][0] == pytest.approx(29.4 + 4.5)
    assert found['events/e2'][1] == schedule.horizon_s
    assert all(earliest <= latest for earliest, latest in found.values())


def test_a_stated_duration_bounds_what_nobody_dates(planned: Plan) -> None:
    prompt = 'The scenario lasts 60 s. A drone hovers for 20 s at 40 m over City Hall.'
    found = times(planned(prompt))
    # 37.7 m down, 19.5 s before that.
    assert found['missions/m1/over'][1] == pytest.approx(60.0 - 37.7 / 3.0)
    assert found['missions/m1/captured'][1] == pytest.approx(60.0 - 37.7 / 3.0 - 19.5)


def test_what_excludes_itself_where_it_was_placed_is_told(planned: Plan) -> None:
    schedule = planned('The scenario lasts 15 s. A drone hovers at 60 m over City Hall.')
    assert schedule.times == ()
    assert schedule.conflict.startswith('the scenario lasts 15 s; the landing of uav1 comes ')
    assert 'uav1 sinks 57.7 m at 3 m/s at most (19.2 s)' in schedule.conflict


def test_a_schedule_of_an_older_version_has_no_times(planned: Plan) -> None:
    schedule = planned(SEQUENCE)
    older = schedule.without_times
    assert 'times' not in older.canonical_json()
    assert Schedule.model_validate_json(older.canonical_json()) == older != schedule


@pytest.mark.parametrize(
    ('point', 'words'),
    [
        ('events/e1', 'e1'),
        ('events/e1/trigger', 'the trigger of e1'),
        ('uavs/uav1/landed', 'the landing of uav1'),
        ('missions/m2/over', 'the end of m2'),
        ('conditions/c1', 'c1'),
    ],
)
def test_points_have_names(point: str, words: str) -> None:
    assert named(point) == words
