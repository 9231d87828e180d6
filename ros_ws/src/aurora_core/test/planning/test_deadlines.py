# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What nobody states of a flight gives way to its deadline; what is stated stays."""

from __future__ import annotations

from collections.abc import Callable

from aurora_core.knowledge.config_files import config_path
from aurora_core.knowledge.limits import load_limits
from aurora_core.planning.complete import complete
from aurora_core.spec.parameter import Parameter
from aurora_core.spec.scenario import (
    Event,
    GroundAgent,
    ScenarioSpec,
    SendMessage,
    StatedCondition,
    TimeTrigger,
    Uav,
    UavMission,
)
from aurora_core.spec.vocabulary import AgentType, MissionMode

Make = Callable[..., Parameter]
LIMITS = load_limits(config_path('limits.json'))


def _flown(
    make: Make,
    *,
    by_s: float,
    stated_m: bool = False,
    stated_s: bool = False,
    least_m: float | None = None,
) -> tuple[float, float]:
    """Return altitude (m) and duration (s) of a tracking that has a deadline."""
    mission = UavMission(
        id='m1',
        uav='uav1',
        mode=MissionMode.TRACK,
        target='van1',
        altitude_m=make(30.0, explicit=stated_m),
        standoff_m=make(0.0, explicit=False),
        duration_s=make(30.0, 's', explicit=stated_s),
    )
    down = StatedCondition(
        id='c1',
        quantity='landed',
        of=('uav1',),
        op='==',
        value=make(1.0, '1'),
        by_s=make(by_s, 's'),
    )
    high = StatedCondition(
        id='c2',
        quantity='altitude',
        of=('uav1',),
        op='>=',
        value=make(least_m or 0.0),
    )
    spec = ScenarioSpec(
        prompt='x',
        agents=(GroundAgent(id='van1', type=AgentType.VAN),),
        uavs=(Uav(id='uav1'),),
        missions=(mission,),
        conditions=(down,) if least_m is None else (down, high),
    )
    (found,) = complete(spec, LIMITS).missions
    assert found.duration_s is not None
    return found.altitude_m.value, found.duration_s.value


def test_a_late_deadline_changes_nothing(parameter: Make) -> None:
    assert _flown(parameter, by_s=90.0) == (30.0, 30.0)


def test_an_early_deadline_takes_altitude_first(parameter: Make) -> None:
    altitude_m, duration_s = _flown(parameter, by_s=65.0)
    assert 15.0 <= altitude_m < 30.0
    assert duration_s == 30.0


def test_a_still_earlier_one_takes_time_as_well(parameter: Make) -> None:
    altitude_m, duration_s = _flown(parameter, by_s=50.0)
    assert altitude_m == 15.0
    assert 10.0 <= duration_s < 30.0


def test_what_is_stated_stays(parameter: Make) -> None:
    assert _flown(parameter, by_s=40.0, stated_m=True, stated_s=True) == (30.0, 30.0)
    altitude_m, duration_s = _flown(parameter, by_s=60.0, stated_s=True)
    assert altitude_m == 15.0
    assert duration_s == 30.0


def test_a_stated_bound_on_the_altitude_stays(parameter: Make) -> None:
    altitude_m, _ = _flown(parameter, by_s=50.0, least_m=20.0)
    assert altitude_m >= 20.0


def _sends_from_m(
    make: Make, at_s: float, mode: MissionMode = MissionMode.HOVER, *, stated_m: bool = False
) -> float:
    """Return the altitude (m) of who hovers or tracks and sends a message at a stated time."""
    mission = UavMission(
        id='m1',
        uav='uav1',
        mode=mode,
        target='van1',
        altitude_m=make(30.0, explicit=stated_m),
        standoff_m=make(0.0, explicit=False) if mode is MissionMode.TRACK else None,
        duration_s=make(30.0, 's', explicit=False),
    )
    event = Event(
        id='e1',
        trigger=TimeTrigger(on='time', at_s=make(at_s, 's')),
        action=SendMessage(do='send_message', sender='uav1', receiver='van1'),
    )
    spec = ScenarioSpec(
        prompt='x',
        agents=(GroundAgent(id='van1', type=AgentType.VAN),),
        uavs=(Uav(id='uav1'),),
        missions=(mission,),
        events=(event,),
    )
    (found,) = complete(spec, LIMITS).missions
    return found.altitude_m.value


def test_who_sends_soon_is_low_enough_to_be_up_by_then(parameter: Make) -> None:
    assert _sends_from_m(parameter, 10.0) == 30.0
    assert 15.0 < _sends_from_m(parameter, 6.0) <= 20.0
    assert _sends_from_m(parameter, 1.0) == 15.0
    assert _sends_from_m(parameter, 6.0, stated_m=True) == 30.0
    # Who tracks sends once it has captured its target.
    assert 15.0 < _sends_from_m(parameter, 10.0, MissionMode.TRACK) <= 20.0
