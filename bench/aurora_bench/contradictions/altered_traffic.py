# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Recordings in which vehicles are others, elsewhere, or do something else than asked for."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from aurora_bench.contradictions import motion
from aurora_bench.contradictions.case import Alter, Altered
from aurora_bench.contradictions.motion import FloatArray
from aurora_bench.mutation.recording import Recording
from aurora_bench.mutation.states import told
from aurora_core.trace.layout import GroundColumn, UavColumn
from aurora_core.trace.trace import Trace

# Changes of speed: hardly felt, when nobody asks for them, and when somebody does (m/s^2).
_SOFTLY_MPS2 = 1.0
_GENTLY_MPS2 = 1.5
_FIRMLY_MPS2 = 3.0

Profile = Callable[[Recording, FloatArray], FloatArray]


def _drives(agent: str, profile: Profile) -> Alter:
    """Return what gives an agent other speeds."""
    return lambda base: motion.driven(base, agent, profile(base, motion.speed_of(base, agent)))


def _eased(at_s: float, goal_mps: float, rate_mps2: float = _FIRMLY_MPS2) -> Profile:
    return lambda base, speed: motion.eased(
        base, speed, motion.ticks_of(base, at_s), goal_mps, rate_mps2
    )


def _delayed(seconds: float) -> Profile:
    return lambda base, speed: motion.delayed(speed, motion.ticks_of(base, seconds))


def _held(from_s: float, to_s: float) -> Profile:
    """Keep the speed of one moment until another, then do what was done at the later one."""

    def profile(base: Recording, speed: FloatArray) -> FloatArray:
        first, last = (motion.ticks_of(base, s) for s in (from_s, to_s))
        held = speed.copy()
        held[first:last] = speed[first - 1]
        return motion.eased(base, held, last, float(speed[-1]), _FIRMLY_MPS2)

    return profile


def _on_again(stop_s: float, stand_s: float, goal_mps: float) -> Profile:
    """Stop, and go on soon after."""

    def profile(base: Recording, speed: FloatArray) -> FloatArray:
        first = motion.ticks_of(base, stop_s)
        stopped = motion.eased(base, speed, first, 0.0, _FIRMLY_MPS2)
        stands = first + int(np.argmax(stopped[first:] <= 0.0))
        on = stands + motion.ticks_of(base, stand_s)
        return motion.eased(base, stopped, on, goal_mps, _GENTLY_MPS2)

    return profile


def _one_more(agent: str, name: str, role: str, behind_m: float) -> Alter:
    """Return what adds the like of an agent, so far behind it."""

    def alter(base: Recording) -> Trace:
        trace, row = base.trace, motion.row_of(base, agent)
        entry = replace(trace.roster.agents[row], body_id=name, role=role)
        new = trace.ground[:, row : row + 1].copy()
        new[:, 0, GroundColumn.X : GroundColumn.Y + 1] -= (
            behind_m * new[0, 0, GroundColumn.HEADING_X : GroundColumn.HEADING_Y + 1]
        )
        return replace(
            trace,
            roster=replace(trace.roster, agents=(*trace.roster.agents, entry)),
            ground=np.concatenate([trace.ground, new], axis=1),
        )

    return alter


def _retyped(agent: str, type_name: str) -> Alter:
    def alter(base: Recording) -> Trace:
        roster, row = base.trace.roster, motion.row_of(base, agent)
        other = replace(roster.agents[row], type_name=type_name)
        agents = (*roster.agents[:row], other, *roster.agents[row + 1 :])
        return replace(base.trace, roster=replace(roster, agents=agents))

    return alter


def _hidden(base: Recording) -> Trace:
    """Park the truck beside the van, between it and the UAV."""
    trace, van, truck = base.trace, motion.row_of(base, 'van1'), motion.row_of(base, 'truck1')
    ground = trace.ground.copy()
    tick = (base.spans[0].first + base.spans[0].stop) // 2
    at = slice(int(GroundColumn.X), int(GroundColumn.Y) + 1)
    away = trace.uav[tick, 0, UavColumn.X : UavColumn.Y + 1] - ground[tick, van, at]
    away = away / np.linalg.norm(away)
    gap_m = (trace.roster.agents[van].width_m + trace.roster.agents[truck].width_m) / 2.0 + 0.2
    ground[:, truck, at] = ground[:, van, at] + gap_m * away
    # Its side to the UAV: it hides most.
    across = np.array([-away[1], away[0]])
    ground[:, truck, GroundColumn.HEADING_X : GroundColumn.HEADING_Y + 1] = across
    return told(base, ground=ground)


def _traffic(
    kind: str, name: str, request: str, requirement: str, alter: Alter, *conditions: str
) -> Altered:
    return Altered(
        kind=kind,
        name=name,
        request=request,
        requirement=requirement,
        conditions=conditions,
        alter=alter,
    )


TRAFFIC: tuple[Altered, ...] = (
    _traffic(
        'sets off earlier',
        'sets off 3 s before the drone is there',
        'setting off',
        'r3',
        _drives('car1', _delayed(-3.0)),
        'e1.at_rest',
        'e1.not_before',
    ),
    _traffic(
        'acts later',
        'sets off 4 s late',
        'setting off',
        'r3',
        _drives('car1', _delayed(4.0)),
        'e1.within',
    ),
    _traffic(
        'speed not reached',
        'gets to 5 m/s, not 8',
        'setting off',
        'r3',
        _drives('car1', lambda _, speed: np.minimum(speed, 5.0)),
        'e1.completed',
    ),
    _traffic(
        'never slows',
        'keeps its speed until it stops',
        'slow and stop',
        'r4',
        _drives('car1', _held(40.0, 60.0)),
        'e1.within',
        'e1.completed',
    ),
    _traffic(
        'speed not reached',
        'slows to 7 m/s, not 4',
        'slow and stop',
        'r4',
        _drives('car1', lambda base, speed: _held(43.0, 60.0)(base, np.maximum(speed, 7.0))),
        'e1.completed',
    ),
    _traffic(
        'never stops',
        'goes on at 4 m/s',
        'slow and stop',
        'r5',
        _drives('car1', _eased(60.0, 4.0)),
        'e2.within',
        'e2.completed',
    ),
    _traffic(
        'acts later',
        'stops 5 s late',
        'slow and stop',
        'r5',
        _drives('car1', _held(59.0, 65.0)),
        'e2.within',
        'e2.time',
    ),
    _traffic(
        'goes on too soon',
        'stands for 1 s and goes on',
        'slow and stop',
        'r5',
        _drives('car1', _on_again(60.0, 1.0, 6.0)),
        'e2.completed',
    ),
    _traffic(
        'never brakes',
        'keeps its speed',
        'brake later',
        'r4',
        _drives('car1', _held(28.0, 1e4)),
        'e2.within',
    ),
    _traffic(
        'brakes softly',
        'slows down with 1 m/s^2',
        'brake later',
        'r4',
        _drives('car1', _eased(30.2, 0.0, _SOFTLY_MPS2)),
        'e2.within',
    ),
    _traffic(
        'placed elsewhere',
        'stands 30 m off the middle of the points around it',
        'points',
        'r4',
        lambda base: motion.shifted_agent(base, 'van1', 30.0),
        'm1.centre',
    ),
    _traffic(
        'placed elsewhere',
        'van 12 m nearer at t = 0',
        'tailgate',
        'r5',
        lambda base: motion.shifted_agent(base, 'van1', 12.0),
        'van1.placed.distance',
    ),
    _traffic(
        'placed elsewhere',
        'bus 10 m farther at t = 0',
        'convoy',
        'r7',
        lambda base: motion.shifted_agent(base, 'bus1', 10.0),
        'bus1.placed.distance',
    ),
    _traffic(
        'placed elsewhere',
        'truck 8 m farther from the van',
        'parked',
        'r6',
        lambda base: motion.shifted_agent(base, 'truck1', -8.0),
        'truck1.placed.distance',
    ),
    _traffic(
        'falls behind',
        'van at 80 % of its speed',
        'tailgate',
        'r4',
        _drives('van1', lambda _, speed: 0.8 * speed),
        'van1.tailgate',
    ),
    _traffic(
        'falls behind',
        'ambulance at half of its speed',
        'convoy',
        'r10',
        _drives('ambulance1', lambda _, speed: 0.5 * speed),
        'ambulance1.follow',
    ),
    _traffic(
        'stands still',
        'bus never drives',
        'convoy',
        'r8',
        _drives('bus1', lambda _, speed: 0.0 * speed),
        'bus1.drive',
    ),
    _traffic(
        'stands still',
        'one of the cars does not circulate',
        'two cars',
        'r3',
        _drives('car1', lambda _, speed: 0.0 * speed),
        'car1.circulate',
    ),
    _traffic(
        'drives off',
        'parked van leaves after a second',
        'parked',
        'r5',
        _drives('van1', _eased(1.0, 5.0, _GENTLY_MPS2)),
        'van1.park',
    ),
    _traffic(
        'in another order',
        'ambulance and bus change places',
        'convoy',
        'r9',
        lambda base: motion.swapped_agents(base, 'bus1', 'ambulance1'),
        'ambulance1.placed',
        'ambulance1.placed.kept',
    ),
    _traffic(
        'target hidden',
        'truck beside the van, towards the UAV',
        'parked',
        'r8',
        _hidden,
        'c1.holds',
    ),
    _traffic(
        'type changed',
        'the ambulance is a van',
        'convoy',
        'r3',
        _retyped('ambulance1', 'van'),
        'scene.ambulance',
    ),
    _traffic(
        'one more',
        'a second bus',
        'convoy',
        'r1',
        _one_more('bus1', 'bus2', 'other', -25.0),
        'scene.bus',
    ),
    _traffic(
        'one more',
        'a third car in the background',
        'two cars',
        'r5',
        _one_more('car1', 'car3', 'background', 30.0),
        'count1.holds',
    ),
)
