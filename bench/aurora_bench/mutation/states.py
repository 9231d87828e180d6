# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Alterations of the recorded states of any body: jumps, collisions, speeds, gaps, the end."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from random import Random

import numpy as np
import numpy.typing as npt

from aurora_bench.mutation.geometry import retold
from aurora_bench.mutation.mutant import Mutant, mutant
from aurora_bench.mutation.recording import Recording
from aurora_core.trace.layout import GroundColumn, UavColumn
from aurora_core.trace.records import EventRecord, ScenarioEventKind
from aurora_core.trace.trace import Trace

FloatArray = npt.NDArray[np.float64]

# From tick to tick a body may be displaced by as much as 60 m/s gives.
_JUMP_MPS = 60.0
_GX, _GY = int(GroundColumn.X), int(GroundColumn.Y)
_UX, _UY, _UZ = int(UavColumn.X), int(UavColumn.Y), int(UavColumn.Z)


def state_mutants(base: Recording, random: Random) -> Iterator[Mutant]:
    """Yield alterations of states that break something whatever the prompt asks for."""
    yield from _teleports(base, random)
    yield from _vanished(base, random)
    yield from _collisions(base, random)
    yield from _speeds(base, random)
    yield from _missing(base, random)
    yield from _cut(base, random)
    yield from _heights(base, random)


def told(base: Recording, **arrays: FloatArray) -> Trace:
    """Return the trace with other states, its claims adapted to them."""
    return retold(replace(base.trace, **arrays), base.world)  # type: ignore[arg-type]


def _tick(base: Recording, random: Random) -> int:
    return random.randrange(100, base.trace.ticks - 100)


def _teleports(base: Recording, random: Random) -> Iterator[Mutant]:
    trace = base.trace
    step_m = _JUMP_MPS * trace.roster.dt_s
    for row, agent in enumerate(trace.roster.agents):
        tick, metres = _tick(base, random), random.uniform(2.0 * step_m, 100.0)
        for name, stop in (('for good', trace.ticks), ('for one tick', tick + 1)):
            ground = trace.ground.copy()
            ground[tick:stop, row, _GX] += metres
            yield mutant(
                'teleport',
                f'{agent.body_id} by {metres:.1f} m at tick {tick} {name}',
                base,
                {'condition:safety.jump'},
                trace=told(base, ground=ground),
            )
    for row, body in enumerate(trace.roster.uavs):
        tick = _tick(base, random)
        for metres, names in (
            (random.uniform(2.0 * step_m, 60.0), {'condition:safety.jump'}),
            # Too short for a jump: only way and speed tell.
            (random.uniform(1.0, 0.6 * step_m), {'finding:motion'}),
        ):
            uav = trace.uav.copy()
            uav[tick:, row, _UX] += metres
            yield mutant(
                'teleport',
                f'{body.body_id} by {metres:.1f} m at tick {tick}',
                base,
                names,
                trace=told(base, uav=uav),
            )


def _vanished(base: Recording, random: Random) -> Iterator[Mutant]:
    trace = base.trace
    for row, agent in enumerate(trace.roster.agents):
        tick = _tick(base, random)
        for name, stop in (('for good', trace.ticks), ('for one tick', tick + 1)):
            ground = trace.ground.copy()
            ground[tick:stop, row, GroundColumn.PRESENT] = 0.0
            yield mutant(
                'agent vanished',
                f'{agent.body_id} at tick {tick} {name}',
                base,
                {'condition:safety.presence'},
                trace=replace(trace, ground=ground),
            )


def _collisions(base: Recording, random: Random) -> Iterator[Mutant]:
    trace = base.trace
    agents = trace.roster.agents
    tick = _tick(base, random)
    span = slice(tick, tick + random.randint(1, 20))
    if len(agents) > 1:
        a, b = random.sample(range(len(agents)), 2)
        ground = trace.ground.copy()
        ground[span, a] = ground[span, b]
        yield mutant(
            'collision planted',
            f'{agents[a].body_id} inside {agents[b].body_id}',
            base,
            {'condition:safety.collision'},
            trace=told(base, ground=ground),
        )
    flying = base.spans[0]
    tick = random.randrange(flying.first, flying.stop)
    span = slice(tick, tick + random.randint(1, 20))
    uav_id = flying.mission.uav
    for row, agent in enumerate(agents):
        uav = trace.uav.copy()
        uav[span, flying.row, _UX] = trace.ground[span, row, _GX]
        uav[span, flying.row, _UY] = trace.ground[span, row, _GY]
        uav[span, flying.row, _UZ] = agent.height_m / 2.0
        yield mutant(
            'collision planted',
            f'{uav_id} inside {agent.body_id}',
            base,
            {'condition:safety.collision'},
            trace=told(base, uav=uav),
        )
    # Through a building: to the first corner of one that is higher than a metre.
    house = random.choice([b for b in base.world.buildings if b.height_m > 4.0])
    uav = trace.uav.copy()
    uav[span, flying.row, _UX : _UZ + 1] = (*house.ring[0], house.height_m / 2.0)
    yield mutant(
        'collision planted',
        f'{uav_id} at building {house.id}',
        base,
        {f'condition:safety.clearance.{uav_id}'},
        trace=told(base, uav=uav),
    )


def _speeds(base: Recording, random: Random) -> Iterator[Mutant]:
    trace = base.trace
    for row, agent in enumerate(trace.roster.agents):
        speed = trace.ground[:, row, GroundColumn.SPEED]
        fast = np.flatnonzero(speed > 5.0)
        if agent.is_person or len(fast) < 100:
            continue
        first = int(fast[random.randrange(len(fast) - 60)])
        for name, factor in (('halved', 0.5), ('doubled', 2.0), ('nought', 0.0)):
            ground = trace.ground.copy()
            ground[first : first + 60, row, GroundColumn.SPEED] *= factor
            if np.count_nonzero(speed[first : first + 60] > 5.0) < 40:
                continue
            yield mutant(
                'speed changed',
                f'{agent.body_id} {name} from tick {first}',
                base,
                {'finding:motion'},
                trace=replace(trace, ground=ground),
            )
    flying = base.spans[0]
    tick = random.randrange(flying.first, flying.stop - 30)
    uav = trace.uav.copy()
    uav[tick : tick + 30, flying.row, UavColumn.VX] += random.uniform(3.0, 8.0)
    yield mutant(
        'speed changed',
        f'{flying.mission.uav} at tick {tick}',
        base,
        {'finding:motion'},
        trace=replace(trace, uav=uav),
    )
    limit = base.world.limits.uav_speed_max_mps
    uav = trace.uav.copy()
    uav[tick : tick + 30, flying.row, UavColumn.VX] = 1.5 * limit
    yield mutant(
        'speed changed',
        f'{flying.mission.uav} beyond its limit',
        base,
        {f'condition:safety.speed.{flying.mission.uav}'},
        trace=replace(trace, uav=uav),
    )


def _missing(base: Recording, random: Random) -> Iterator[Mutant]:
    trace = base.trace
    for count in (1, 1, 20):
        tick = _tick(base, random)
        ticks = range(tick, tick + count)
        ground, uav = trace.ground.copy(), trace.uav.copy()
        ground[tick : tick + count] = np.nan
        uav[tick : tick + count] = np.nan
        yield mutant(
            'samples dropped',
            f'{count} from tick {tick}',
            base,
            {'reason:samples_missing'},
            trace=replace(trace, ground=ground, uav=uav, missing_ticks=tuple(ticks)),
        )


def _cut(base: Recording, random: Random) -> Iterator[Mutant]:
    """The record ends early: as it is, or with a forged end."""
    trace = base.trace
    landing = max(span.stop for span in base.spans)
    for stop in (random.randrange(50, landing), landing + 5):
        short = shortened(trace, stop)
        yield mutant('horizon cut', f'at tick {stop}', base, {'reason:trace_short'}, trace=short)
        for outcome in ('finished', 'horizon'):
            end = EventRecord(
                tick=stop - 1,
                sequence=0,
                kind=ScenarioEventKind.FINISHED,
                subject='run',
                detail=outcome,
            )
            yield mutant(
                'horizon cut',
                f'at tick {stop}, {outcome} claimed',
                base,
                {'finding:end'},
                trace=replace(short, events=(*short.events, end)),
            )


def shortened(trace: Trace, stop: int) -> Trace:
    """Return the first ticks of a trace."""
    return replace(
        trace,
        ground=trace.ground[:stop],
        uav=trace.uav[:stop],
        uav_commands=trace.uav_commands[:stop],
        ground_commands=trace.ground_commands[:stop],
        links=tuple(r for r in trace.links if r.tick < stop),
        sights=tuple(r for r in trace.sights if r.tick < stop),
        events=tuple(r for r in trace.events if r.tick < stop),
    )


def _heights(base: Recording, random: Random) -> Iterator[Mutant]:
    trace, limits = base.trace, base.world.limits
    for span in base.spans:
        middle = (span.first + span.stop) // 2
        part = slice(middle, middle + random.randint(20, 60))
        for name, height_m, condition in (
            ('too high', 1.1 * limits.uav_altitude_max_m, 'altitude_max'),
            ('too low', 0.5, 'altitude_min'),
        ):
            uav = trace.uav.copy()
            uav[part, span.row, _UZ] = height_m
            yield mutant(
                'altitude changed',
                f'{span.mission.uav} {name} at tick {middle}',
                base,
                {f'condition:safety.{condition}.{span.mission.uav}'},
                trace=told(base, uav=uav),
            )
