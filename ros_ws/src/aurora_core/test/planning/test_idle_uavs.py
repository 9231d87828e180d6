# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""A UAV of which no mission is asked hovers over the scene, or tracks what it reports."""

from __future__ import annotations

from collections.abc import Callable

from aurora_core.planning.complete import hovering
from aurora_core.spec.parameter import Parameter, Provenance
from aurora_core.spec.scenario import (
    Event,
    GroundAgent,
    ScenarioSpec,
    SendMessage,
    SpeedTrigger,
    Uav,
    UavMission,
)
from aurora_core.spec.vocabulary import AgentType, MissionMode

Make = Callable[..., Parameter]


def _spec(make: Make) -> ScenarioSpec:
    return ScenarioSpec(
        prompt='x',
        agents=(GroundAgent(id='m2', type=AgentType.CAR),),
        uavs=(Uav(id='uav1'), Uav(id='uav2'), Uav(id='uav3')),
        missions=(
            UavMission(
                id='m1',
                uav='uav2',
                mode=MissionMode.HOVER,
                altitude_m=make(50.0),
                duration_s=make(30.0, 's'),
            ),
        ),
    )


def test_only_those_without_a_mission_get_one(parameter: Make) -> None:
    spec = _spec(parameter)
    found = hovering(spec)
    assert found.missions[0] == spec.missions[0]
    assert [(m.id, m.uav) for m in found.missions] == [
        ('m1', 'uav2'), ('m3', 'uav1'), ('m4', 'uav3'),
    ]  # fmt: skip
    for mission in found.missions[1:]:
        assert mission.mode is MissionMode.HOVER
        assert mission.target is None
        assert mission.altitude_m.value == 30.0
        assert mission.altitude_m.provenance is Provenance.DEFAULT
        assert mission.duration_s is not None
        assert mission.duration_s.value == 30.0


def test_nothing_changes_where_everybody_flies(parameter: Make) -> None:
    spec = hovering(_spec(parameter))
    assert hovering(spec) is spec


def test_who_reports_what_a_vehicle_does_tracks_it(parameter: Make) -> None:
    fast = SpeedTrigger(on='speed_above', who='m2', value_mps=parameter(9.0, 'm/s'))
    report = SendMessage(do='send_message', sender='uav1', receiver='uav3')
    events = (Event(id='e1', trigger=fast, action=report),)
    spec = ScenarioSpec.model_validate({**dict(_spec(parameter)), 'events': events})
    sender, relay = hovering(spec).missions[1:]
    assert (sender.mode, sender.target) == (MissionMode.TRACK, 'm2')
    assert sender.target_inferred
    assert (relay.mode, relay.target) == (MissionMode.HOVER, None)
