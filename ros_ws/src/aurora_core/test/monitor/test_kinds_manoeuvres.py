# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Kinds of manoeuvres of one agent: satisfied, violated, not judged."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import numpy.typing as npt
import pytest
from kind_rows import Row, gone
from trace_builder import world
from trace_cases import Case, ground_case

from aurora_core.knowledge.world import NamedPlace
from aurora_core.outcomes.verdict import Reason
from aurora_core.spec.scenario import Behavior
from aurora_core.spec.vocabulary import BehaviorKind as B

T = 401  # 20 s
TICK = np.arange(T)


def _slows(first: float, then: float) -> Case:
    return ground_case(Behavior(kind=B.SLOW), np.where(TICK < 200, first, then))


def _turn(kind: B, degrees: float, *, ticks: int = 100, start_deg: float = 90.0) -> Case:
    """A car heads `start_deg` clockwise from north and turns by `degrees` (right: above 0)."""
    case = ground_case(Behavior(kind=kind), np.full(T, 5.0))
    share = np.minimum(np.maximum((TICK - 100) / ticks, 0.0), 1.0)
    bearing = np.radians(start_deg + degrees * share)
    case.run.agents[0].heading = (np.sin(bearing), np.cos(bearing))
    return case


def _turn_at(gate_x: float) -> Case:
    """A car drives 100 m from (0, 0) on, and turns left from 25 m on; at the gate, as asked."""
    turns = Behavior(kind=B.TURN_LEFT, target='landmark:Gate')
    case = ground_case(turns, np.full(T, 5.0))
    case.run.agents[0].heading = _turn(B.TURN_LEFT, -90.0).run.agents[0].heading
    case.run.agents[0].x[:], case.run.agents[0].y[:] = 0.25 * TICK, 0.0
    gate = NamedPlace(name='landmark:Gate', x_m=gate_x, y_m=0.0)
    case.world = replace(case.world, places=(gate,))
    return case


def _walks(y: npt.NDArray[np.floating]) -> Case:
    """A person at x = 0 with the given way along y; the carriageway is 7 m wide, from y = 0 on."""
    case = ground_case(Behavior(kind=B.CROSS), np.full(T, 1.5))
    case.run.agents[0].x[:], case.run.agents[0].y[:] = 0.0, y
    case.world = world(streets=((-50.0, 0.0, 50.0, 7.0),))
    return case


# From 3.05 m before the kerb on, 0.1 m per tick: the samples beside the kerbs are 0.05 m off them.
WAY = -3.05 + 0.1 * TICK
NEVER, GONE = Reason.PREMISE_NEVER, Reason.TARGET_GONE
ROWS = (
    # 2 m/s are asked.
    Row(id='car1.slow', make=lambda: _slows(8.0, 5.0), margin=3.0 - 2.0),
    Row(id='car1.slow', make=lambda: _slows(8.0, 6.0), margin=0.0, what='threshold'),
    Row(id='car1.slow', make=lambda: _slows(8.0, 7.5), margin=0.5 - 2.0),
    Row(id='car1.slow', make=lambda: _slows(5.0, 8.0), margin=0.0 - 2.0, what='faster'),
    Row(id='car1.slow', make=lambda: _slows(0.0, 0.0), reason=NEVER),
    Row(id='car1.slow', make=lambda: gone(_slows(8.0, 5.0), 0, 0), reason=GONE),
    # It has slowed down when it leaves at tick 300; or it leaves before.
    Row(
        id='car1.slow',
        make=lambda: gone(_slows(8.0, 5.0), 0, 300),
        margin=3.0 - 2.0,
        what='leaves',
    ),
    Row(
        id='car1.slow',
        make=lambda: gone(_slows(8.0, 5.0), 0, 100),
        margin=0.0 - 2.0,
        what='leaves',
    ),
    # 60 degrees within 15 s are asked.
    Row(id='car1.turn_left', make=lambda: _turn(B.TURN_LEFT, -90.0), margin=90.0 - 60.0),
    Row(
        id='car1.turn_left',
        make=lambda: _turn(B.TURN_LEFT, -80.0, start_deg=40.0),  # through north
        margin=80.0 - 60.0,
        what='north',
    ),
    Row(id='car1.turn_left', make=lambda: _turn(B.TURN_LEFT, 90.0), margin=0.0 - 60.0),
    Row(id='car1.turn_left', make=lambda: gone(_turn(B.TURN_LEFT, -90.0), 0, 0), reason=GONE),
    # There, and 15 s and more before: it turned elsewhere.
    Row(id='car1.turn_left', make=lambda: _turn_at(30.0), margin=90.0 - 60.0, what='there'),
    Row(id='car1.turn_left', make=lambda: _turn_at(-250.0), margin=0.0 - 60.0, what='elsewhere'),
    Row(id='car1.turn_right', make=lambda: _turn(B.TURN_RIGHT, 90.0), margin=90.0 - 60.0),
    Row(
        id='car1.turn_right',
        make=lambda: _turn(B.TURN_RIGHT, 90.0, start_deg=300.0),
        margin=90.0 - 60.0,
        what='north',
    ),
    # 75 degrees in 25 s, of which 15 s lie in the run.
    Row(
        id='car1.turn_right',
        make=lambda: _turn(B.TURN_RIGHT, 75.0, ticks=500),
        margin=75.0 * 300 / 500 - 60.0,
        what='bend',
    ),
    Row(id='car1.turn_right', make=lambda: gone(_turn(B.TURN_RIGHT, 90.0), 0, 0), reason=GONE),
    # 3 m are asked.
    Row(id='car1.cross', make=lambda: _walks(WAY), margin=7.1 - 3.0),
    # 2 m onto it and back to the kerb.
    Row(
        id='car1.cross',
        make=lambda: _walks(np.where(TICK < 51, WAY, WAY[50] - 0.1 * (TICK - 50))),
        margin=0.0 - 3.0,
        what='back',
    ),
    # Left standing in the middle.
    Row(id='car1.cross', make=lambda: _walks(np.minimum(WAY, 4.0)), margin=0.0 - 3.0),
    Row(id='car1.cross', make=lambda: _walks(np.minimum(WAY, -1.0)), reason=NEVER),
    # Who begins on the carriageway has not crossed it.
    Row(id='car1.cross', make=lambda: _walks(WAY + 5.0), reason=NEVER, what='begins-there'),
)


@pytest.mark.parametrize('row', ROWS, ids=lambda row: row.name)
def test_manoeuvre_kinds(row: Row) -> None:
    row.check()
