# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Who lets others pass drives on once all of them have passed, and not before."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from aurora_core.execution.observe import Observation
from aurora_core.execution.yielding import Yielding
from aurora_core.spec.scenario import Behavior, GroundAgent, ScenarioSpec
from aurora_core.spec.vocabulary import AgentType, BehaviorKind
from aurora_core.trace.layout import GROUND_WIDTH, GroundColumn
from aurora_core.trace.roster import Roster, RosterEntry

OTHERS = {'ped1': AgentType.PEDESTRIAN, 'ped2': AgentType.PEDESTRIAN, 'bus1': AgentType.BUS}
NAMES = ('car1', *OTHERS)


class _Scene:
    """car1 stands at 0 on a way along +x; the others are where they are put."""

    def __init__(self, *yields_to: str) -> None:
        agents = [
            GroundAgent(
                id='car1',
                type=AgentType.CAR,
                behaviors=tuple(Behavior(kind=BehaviorKind.YIELD, target=o) for o in yields_to),
            ),
            *(GroundAgent(id=name, type=kind) for name, kind in OTHERS.items()),
        ]
        entries = tuple(
            RosterEntry(
                body_id=a.id,
                type_name=a.type.value,
                is_person=a.type is AgentType.PEDESTRIAN,
                system_id=0,
                length_m=4.0,
                width_m=1.8,
                height_m=1.5,
                route_xy_m=((0.0, 0.0), (300.0, 0.0)),
            )
            for a in agents
        )
        self._roster = Roster(dt_s=0.05, agents=entries, uavs=())
        self._ground = np.zeros((len(NAMES), GROUND_WIDTH))
        self._ground[:, GroundColumn.PRESENT] = 1.0
        self._ground[:, GroundColumn.HEADING_X] = 1.0
        self._ground[1:, GroundColumn.X] = -50.0
        spec = ScenarioSpec(prompt='x', agents=tuple(agents))
        self.yielding = Yielding(spec, self._roster)
        for other in yields_to:
            self.yielding.note(0, other)

    def put(self, name: str, x_m: float, y_m: float) -> list[int]:
        """Put a body, return who may drive on then."""
        row = NAMES.index(name)
        self._ground[row, GroundColumn.X] = x_m
        self._ground[row, GroundColumn.Y] = y_m
        unused: Any = None
        return self.yielding.passed(
            Observation(self._roster, self._ground, np.zeros((0, 1)), unused, unused)
        )


@pytest.mark.parametrize('from_m', [-5.0, 5.0])
def test_a_person_has_passed_on_the_other_side_of_the_way(from_m: float) -> None:
    scene = _Scene('ped1')
    side = from_m / 5.0
    assert [scene.put('ped1', 20.0, y * side) for y in (5.0, 3.0, 0.0, -1.9)] == [[]] * 4
    assert scene.put('ped1', 20.0, -2.1 * side) == [0]


def test_who_turns_round_in_the_street_has_not_passed() -> None:
    scene = _Scene('ped1')
    assert all(scene.put('ped1', 20.0, y) == [] for y in (5.0, 0.0, -1.0, 1.0, 3.0, 5.0))


def test_all_have_to_pass() -> None:
    scene = _Scene('ped1', 'ped2')
    for name in ('ped1', 'ped2'):
        scene.put(name, 20.0, 5.0)
    assert scene.put('ped1', 20.0, -5.0) == []
    assert scene.put('ped2', 20.0, -5.0) == [0]
    assert scene.put('ped2', 20.0, -6.0) == []


def test_a_vehicle_has_passed_ahead() -> None:
    scene = _Scene('bus1')
    assert scene.put('bus1', 8.0, 3.3) == []
    assert scene.put('bus1', 9.5, 3.3) == [0]


def test_a_person_crosses_only_once_it_counts_from_the_start() -> None:
    """Who had crossed before one was told to wait is waited for no longer."""
    scene = _Scene('ped1')
    scene.put('ped1', 20.0, 5.0)
    assert scene.put('ped1', 20.0, -5.0) == [0]
    scene.yielding.note(0, 'ped1')
    assert scene.put('ped1', 20.0, -6.0) == [0]
