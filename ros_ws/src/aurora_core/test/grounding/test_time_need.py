# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The inferred horizon is long enough for everything that the prompt asks for."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest

from aurora_core.grounding.time_need import horizon_s
from aurora_core.knowledge.limits import Limits
from aurora_core.knowledge.settings import FlightDefaults, Settings
from aurora_core.spec.parameter import Parameter
from aurora_core.spec.scenario import (
    Event,
    EventDoneTrigger,
    GroundAgent,
    Link,
    ScenarioSpec,
    SendMessage,
    TimeTrigger,
    Uav,
    UavMission,
    World,
)
from aurora_core.spec.vocabulary import AgentType, MissionMode, Pattern

Make = Callable[..., Parameter]


def _spec(make: Make, **fields: Any) -> ScenarioSpec:
    return ScenarioSpec(
        prompt='x',
        agents=(
            GroundAgent(id='a', type=AgentType.CAR),
            GroundAgent(id='b', type=AgentType.CAR),
        ),
        uavs=(Uav(id='u1'), Uav(id='u2')),
        **fields,
    )


def _track(make: Make, name: str, uav: str, seconds: float, height: float = 30.0) -> UavMission:
    return UavMission(
        id=name,
        uav=uav,
        mode=MissionMode.TRACK,
        target='a',
        altitude_m=make(height),
        standoff_m=make(0.0),
        duration_s=make(seconds, 's'),
    )


def _route(make: Make, pattern: Pattern, speed: float, **sizes: Any) -> UavMission:
    return UavMission(
        id='m1',
        uav='u1',
        mode=MissionMode.NAVIGATE,
        altitude_m=make(30.0),
        pattern=pattern,
        speed_mps=make(speed, 'm/s'),
        **sizes,
    )


def test_a_stated_duration_is_the_horizon(limits: Limits, parameter: Make) -> None:
    world = World(duration_s=parameter(77.5, 's'))
    spec = _spec(parameter, world=world, missions=(_track(parameter, 'm1', 'u1', 500.0),))
    assert horizon_s(spec, limits) == 77.5


def test_at_least_a_minute_and_at_most_the_limit(limits: Limits, parameter: Make) -> None:
    assert horizon_s(_spec(parameter), limits) == 60.0
    long = _spec(parameter, missions=(_track(parameter, 'm1', 'u1', 1795.0),))
    assert horizon_s(long, limits) == limits.duration_max_s


def test_missions_of_one_uav_add_up_those_of_two_do_not(limits: Limits, parameter: Make) -> None:
    one = _spec(parameter, missions=(_track(parameter, 'm1', 'u1', 100.0),))
    after = _spec(
        parameter,
        missions=(
            _track(parameter, 'm1', 'u1', 100.0),
            _track(parameter, 'm2', 'u1', 100.0),
        ),
    )
    beside = _spec(
        parameter,
        missions=(
            _track(parameter, 'm1', 'u1', 100.0),
            _track(parameter, 'm2', 'u2', 100.0),
        ),
    )
    assert horizon_s(beside, limits) == horizon_s(one, limits)
    assert horizon_s(after, limits) >= horizon_s(one, limits) + 100.0


def test_high_flights_get_time_to_climb_and_sink(limits: Limits, parameter: Make) -> None:
    low = _spec(parameter, missions=(_track(parameter, 'm1', 'u1', 30.0, 10.0),))
    high = _spec(parameter, missions=(_track(parameter, 'm1', 'u1', 30.0, 120.0),))
    slowest_mps = min(limits.uav_climb_max_mps, limits.uav_descent_max_mps)
    assert horizon_s(high, limits) >= horizon_s(low, limits) + 110.0 / slowest_mps


@pytest.mark.parametrize(
    ('pattern', 'sizes', 'length'),
    [
        (Pattern.RECTANGLE, (200.0, 100.0), 600.0),
        (Pattern.LINE, (500.0, 1.0), 500.0),
        (Pattern.LAWNMOWER, (200.0, 100.0), 1300.0),
    ],
)
def test_routes_get_their_time(
    pattern: Pattern,
    sizes: tuple[float, float],
    length: float,
    limits: Limits,
    parameter: Make,
) -> None:
    size = (parameter(sizes[0]), parameter(sizes[1]))
    for speed in (5.0, 15.0):
        spec = _spec(parameter, missions=(_route(parameter, pattern, speed, size_m=size),))
        assert horizon_s(spec, limits) > length / speed + 30.0


def test_an_orbit_gets_its_time(limits: Limits, parameter: Make) -> None:
    mission = _route(parameter, Pattern.ORBIT, 5.0, radius_m=parameter(100.0))
    assert horizon_s(_spec(parameter, missions=(mission,)), limits) > 628.0 / 5.0 + 30.0


def test_a_route_without_speed_has_a_horizon_too(limits: Limits, parameter: Make) -> None:
    mission = _route(parameter, Pattern.RECTANGLE, 0.0)
    assert horizon_s(_spec(parameter, missions=(mission,)), limits) == limits.duration_max_s


def test_events_get_their_delays_and_their_messages(limits: Limits, parameter: Make) -> None:
    missions = (_track(parameter, 'm1', 'u1', 100.0),)
    link = Link(
        id='l1',
        sender='a',
        receiver='b',
        loss=parameter(0.0, '1'),
        latency_s=parameter(12.0, 's'),
        retransmissions=parameter(5.0, '1'),
        retransmission_interval_s=parameter(4.0, 's'),
    )
    send = SendMessage(do='send_message', sender='a', receiver='b')

    def need(*events: Event) -> float:
        return horizon_s(_spec(parameter, missions=missions, links=(link,), events=events), limits)

    none = need()
    at = TimeTrigger(on='time', at_s=parameter(300.0, 's'))
    assert need(Event(id='e1', trigger=at)) >= none + 300.0
    plain = need(Event(id='e1'))
    assert plain > none
    assert need(Event(id='e1', delay_s=parameter(90.0, 's'))) == plain + 90.0
    after = EventDoneTrigger(on='event_done', event='e1', after_s=parameter(60.0, 's'))
    assert need(Event(id='e1'), Event(id='e2', trigger=after)) >= plain + 60.0
    assert need(Event(id='e1', action=send)) == plain + 12.0 + 20.0


def test_a_multirotor_that_climbs_slowly_gets_the_time(
    limits: Limits, settings: Settings, parameter: Make
) -> None:
    high = _spec(parameter, missions=(_track(parameter, 'm1', 'u1', 30.0, 120.0),))
    usual = horizon_s(high, limits)
    assert horizon_s(high, limits, settings.flight) == usual
    slow = FlightDefaults.model_validate(
        settings.flight.model_dump() | {'climb_mps': 1.0, 'descent_mps': 0.5}
    )
    assert horizon_s(high, limits, slow) > usual + 120.0 / 1.0 + 120.0 / 0.5
