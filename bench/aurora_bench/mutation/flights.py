# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Alterations that break what the missions, relations and events of a prompt ask for.

Where it can be done, a whole path is displaced: speeds, ways and claims stay true of each other,
and only the margin can tell.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from math import atan2, hypot, pi
from random import Random

import numpy as np

from aurora_bench.mutation.geometry import retold
from aurora_bench.mutation.mutant import Mutant, mutant
from aurora_bench.mutation.recording import Recording, Span
from aurora_bench.mutation.states import FloatArray, told
from aurora_core.spec.parameter import Provenance
from aurora_core.spec.scenario import AgentAction
from aurora_core.spec.vocabulary import MissionMode
from aurora_core.trace.layout import GroundColumn, UavColumn

_GX, _GY = int(GroundColumn.X), int(GroundColumn.Y)
_UX, _UY, _UZ = int(UavColumn.X), int(UavColumn.Y), int(UavColumn.Z)
# Far beyond every tolerance of tracking (10 m), hovering (3 m) and placing (a few metres).
_FAR_M = (40.0, 90.0)
# A waypoint is visited within 3 m; a corner that is cut passes by at more than this.
_MISSED_M = 8.0


def flight_mutants(base: Recording, random: Random) -> Iterator[Mutant]:
    """Yield alterations that break a requirement of the prompt."""
    for span in base.spans:
        if span.mission.mode is MissionMode.TRACK:
            yield from _target(base, span, random)
        yield from _displaced(base, span, random)
        yield from _clipped(base, span, random)
        yield from _stays_up(base, span)
        if span.mission.mode is MissionMode.NAVIGATE:
            yield from _corners(base, span)
    yield from _placements(base, random)
    yield from _separation(base, random)
    yield from _no_braking(base)


def _kept(base: Recording, span: Span) -> set[str]:
    """Return the conditions that a UAV fails that is nowhere near where it should be."""
    wanted = ('tracked', 'drift', 'waypoints', 'capture', 'order')
    return {f'condition:{span.mission.id}.{what}' for what in wanted} & {
        f'condition:{name}' for name in base.conditions
    }


def _target(base: Recording, span: Span, random: Random) -> Iterator[Mutant]:
    trace = base.trace
    target = span.mission.target
    row = None if target is None else trace.roster.agent_index(target)
    if row is None:
        return
    names = {f'condition:{span.mission.id}.tracked', f'condition:{span.mission.id}.capture'}
    for _ in range(2):
        metres = random.uniform(*_FAR_M)
        angle = _outwards(base, span, random) + pi
        ground = trace.ground.copy()
        ground[:, row, _GX] += metres * np.cos(angle)
        ground[:, row, _GY] += metres * np.sin(angle)
        yield mutant(
            'target shifted',
            f'{target} by {metres:.0f} m all along',
            base,
            names,
            trace=told(base, ground=ground),
        )
    # Over half of the phase: more than the fifth that may be lost.
    ground = trace.ground.copy()
    middle = (span.first + span.stop) // 2
    reach = np.clip(np.arange(trace.ticks) - middle, 0, 40)
    ground[:, row, _GY] += reach * 1.5
    yield mutant(
        'target shifted',
        f'{target} from tick {middle} on',
        base,
        {f'condition:{span.mission.id}.tracked'},
        trace=told(base, ground=ground),
    )
    for other, entry in enumerate(trace.roster.agents):
        away = np.hypot(
            trace.ground[:, row, _GX] - trace.ground[:, other, _GX],
            trace.ground[:, row, _GY] - trace.ground[:, other, _GY],
        )
        if other == row or float(np.median(away[span.first : span.stop])) < 15.0:
            continue
        ground = trace.ground.copy()
        ground[:, [row, other]] = ground[:, [other, row]]
        yield mutant(
            'target swapped',
            f'{target} and {entry.body_id}',
            base,
            names,
            trace=told(base, ground=ground),
        )


def _displaced(base: Recording, span: Span, random: Random) -> Iterator[Mutant]:
    """The whole flight somewhere else."""
    for _ in range(2):
        metres, angle = random.uniform(*_FAR_M), _outwards(base, span, random)
        uav = base.trace.uav.copy()
        uav[:, span.row, _UX] += metres * np.cos(angle)
        uav[:, span.row, _UY] += metres * np.sin(angle)
        yield mutant(
            'UAV shifted',
            f'{span.mission.uav} by {metres:.0f} m all along ({span.mission.id})',
            base,
            _kept(base, span),
            trace=told(base, uav=uav),
        )


def _outwards(base: Recording, span: Span, random: Random) -> float:
    """Return a direction in which the UAV gets farther from its target.

    Any direction will do above the target; with a standoff the other side of it is as good.
    """
    target = span.mission.target
    row = None if target is None else base.trace.roster.agent_index(target)
    if row is not None:
        tick = (span.first + span.stop) // 2
        dx, dy = (
            base.trace.uav[tick, span.row, [_UX, _UY]] - base.trace.ground[tick, row, [_GX, _GY]]
        ).tolist()
        if hypot(dx, dy) > 10.0:
            return atan2(dy, dx)
    return random.uniform(0.0, 2.0 * pi)


def _clipped(base: Recording, span: Span, random: Random) -> Iterator[Mutant]:
    trace, mission = base.trace, span.mission.id
    ceiling_m = 0.5 * float(trace.uav[(span.first + span.stop) // 2, span.row, _UZ])
    every = {f'condition:{mission}.{what}' for what in ('order', 'capture', 'altitude', 'tracked')}
    uav = trace.uav.copy()
    uav[:, span.row, _UZ] = np.minimum(uav[:, span.row, _UZ], ceiling_m)
    yield mutant(
        'altitude clipped',
        f'{span.mission.uav} at {ceiling_m:.1f} m ({mission})',
        base,
        every,
        trace=told(base, uav=uav),
    )
    kept = {f'{mission}.altitude', f'{mission}.tracked'} & base.conditions
    if kept:
        first = span.first + random.randint(100, 130)
        uav = trace.uav.copy()
        part = slice(first, span.stop)
        uav[part, span.row, _UZ] = np.minimum(uav[part, span.row, _UZ], ceiling_m)
        share = (span.stop - first) / (span.stop - span.first)
        if share > 0.3:  # a fifth may be lost in tracking, a twentieth of an altitude
            yield mutant(
                'altitude clipped',
                f'{span.mission.uav} from tick {first} on ({mission})',
                base,
                {f'condition:{name}' for name in kept},
                trace=told(base, uav=uav),
            )


def _stays_up(base: Recording, span: Span) -> Iterator[Mutant]:
    """The UAV stands in the air where its last mission ended."""
    trace = base.trace
    if span.stop >= trace.ticks or span is not [s for s in base.spans if s.row == span.row][-1]:
        return
    uav = trace.uav.copy()
    uav[span.stop :, span.row] = uav[span.stop - 1, span.row]
    uav[span.stop :, span.row, UavColumn.VX : UavColumn.VZ + 1] = 0.0
    yield mutant(
        'landing skipped',
        f'{span.mission.uav} stays in the air',
        base,
        {f'condition:{span.mission.uav}.landed'},
        trace=told(base, uav=uav),
    )


def _corners(base: Recording, span: Span) -> Iterator[Mutant]:
    """A straight line from before a waypoint to behind it, as long as it needs to pass it by."""
    trace = base.trace
    path = trace.uav[:, span.row, _UX : _UY + 1]
    # Corners are where the commanded way bends most: found on the path alone.
    ticks = range(span.first + 60, span.stop - 60)
    missed: list[int] = []
    for tick in ticks:
        if any(abs(tick - other) < 120 for other in missed):
            continue
        bend = _off_chord(path, tick, 40)
        if bend > _MISSED_M and bend >= max(_off_chord(path, tick + d, 40) for d in (-8, 8)):
            missed.append(tick)
    for tick in missed:
        uav = trace.uav.copy()
        first, last = tick - 60, tick + 60
        share = np.linspace(0.0, 1.0, last - first + 1)[:, None]
        uav[first : last + 1, span.row, _UX : _UY + 1] = (
            path[first] + (path[last] - path[first]) * share
        )
        yield mutant(
            'waypoint skipped',
            f'corner at tick {tick} cut',
            base,
            {f'condition:{span.mission.id}.waypoints', f'condition:{span.mission.id}.completed'},
            trace=told(base, uav=uav),
        )


def _off_chord(path: FloatArray, tick: int, reach: int) -> float:
    (ax, ay), (px, py), (bx, by) = (path[k] for k in (tick - reach, tick, tick + reach))
    length = hypot(bx - ax, by - ay)
    if length < 1.0:
        return 0.0
    return float(abs((bx - ax) * (ay - py) - (ax - px) * (by - ay)) / length)


def _placements(base: Recording, random: Random) -> Iterator[Mutant]:
    """An agent with a stated distance is somewhere else all along, with its whole path."""
    trace = base.trace
    for agent in base.agsg.spec.agents:
        row = trace.roster.agent_index(agent.id)
        stated = [
            p.distance_m
            for p in agent.placements
            if p.distance_m is not None and p.distance_m.provenance is Provenance.EXPLICIT
        ]
        if row is None or not stated or f'{agent.id}.placed.distance' not in base.conditions:
            continue
        heading = trace.ground[0, row, GroundColumn.HEADING_X : GroundColumn.HEADING_Y + 1]
        for sign in (-1.0, 1.0):
            metres = sign * random.uniform(6.0, 12.0)
            ground = trace.ground.copy()
            ground[:, row, _GX : _GY + 1] += metres * heading
            yield mutant(
                'agent shifted in place',
                f'{agent.id} by {metres:+.1f} m along its way',
                base,
                {f'condition:{agent.id}.placed.distance'},
                trace=told(base, ground=ground),
            )


def _separation(base: Recording, random: Random) -> Iterator[Mutant]:
    trace = base.trace
    if len(trace.roster.uavs) < 2:
        return
    a, b = (uav.body_id for uav in trace.roster.uavs[:2])
    for _ in range(2):
        off = random.uniform(0.5, 4.0)
        uav = trace.uav.copy()
        uav[:, 1] = uav[:, 0]
        uav[:, 1, _UX] += off
        yield mutant(
            'UAVs too close',
            f'{off:.1f} m apart',
            base,
            {f'condition:safety.separation.{a}.{b}'},
            trace=told(base, uav=uav),
        )


def _no_braking(base: Recording) -> Iterator[Mutant]:
    """Who should brake goes on at its speed, on a straight line."""
    trace = base.trace
    for event in base.agsg.spec.events:
        action = event.action
        claims = [r.tick for r in trace.events if r.subject == event.id]
        if not isinstance(action, AgentAction) or action.do != 'brake' or not claims:
            continue
        row = trace.roster.agent_index(action.agent)
        assert row is not None
        tick = claims[0]
        ground = trace.ground.copy()
        state = ground[tick, row].copy()
        ground[tick:, row] = state
        way = np.arange(trace.ticks - tick) * trace.roster.dt_s * state[GroundColumn.SPEED]
        ground[tick:, row, _GX] = state[_GX] + way * state[GroundColumn.HEADING_X]
        ground[tick:, row, _GY] = state[_GY] + way * state[GroundColumn.HEADING_Y]
        yield mutant(
            'event does not happen',
            f'{action.agent} does not brake',
            base,
            {f'condition:{event.id}.within', f'condition:{event.id}.time'},
            trace=retold(replace(trace, ground=ground), base.world),
        )
