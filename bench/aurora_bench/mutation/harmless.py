# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Alterations that change no requirement at all: the status must stay."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from math import dist
from random import Random

import numpy as np
import numpy.typing as npt

from aurora_bench.mutation.geometry import reference, retold, sight_point
from aurora_bench.mutation.mutant import Mutant, mutant
from aurora_bench.mutation.recording import Recording
from aurora_core.trace.layout import GroundColumn, UavColumn
from aurora_core.trace.records import EventRecord, ScenarioEventKind, SightRecord
from aurora_core.trace.trace import Trace

# Nothing moves so close (ticks) to where something is decided: a trigger, a phase, a change of
# sight, a transmission.
_AWAY = 3
# The kind of the run as it is.
UNTOUCHED = 'untouched'


def same_mutants(base: Recording, random: Random, noisy: int) -> Iterator[Mutant]:
    """Yield the run as it is, and alterations that change no requirement.

    Args:
        base: The run.
        random: Seeded.
        noisy: How many with noise on the positions.
    """
    yield mutant(UNTOUCHED, f'seed {base.seed}', base, ())
    yield from _noise(base, random, noisy)
    yield from _unused(base, random)
    yield from _more_sights(base, random)
    yield from _fewer_sights(base, random)
    yield from _same_tick(base, random)


def _decisions(trace: Trace) -> npt.NDArray[np.bool_]:
    """Return where nothing may move, (T,)."""
    ticks = {record.tick for record in trace.events} | {record.tick for record in trace.links}
    last: dict[tuple[str, str], bool] = {}
    for sight in trace.sights:
        pair = (sight.observer, sight.target)
        if last.get(pair) is not sight.visible:
            ticks.add(sight.tick)
        last[pair] = sight.visible
    mask = np.zeros(trace.ticks, dtype=np.bool_)
    for tick in ticks:
        mask[max(0, tick - _AWAY) : tick + _AWAY + 1] = True
    return mask


def _noise(base: Recording, random: Random, count: int) -> Iterator[Mutant]:
    """At most a millimetre on every position, claims adapted."""
    trace = base.trace
    quiet = _decisions(trace)
    for number in range(count):
        generator = np.random.default_rng(random.randrange(1 << 32))
        size_m = (0.001, 0.0001)[number % 2]
        ground, uav = trace.ground.copy(), trace.uav.copy()
        for array, columns in (
            (ground, [GroundColumn.X, GroundColumn.Y]),
            (uav, [UavColumn.X, UavColumn.Y, UavColumn.Z]),
        ):
            noise = generator.uniform(-size_m, size_m, (trace.ticks, array.shape[1], len(columns)))
            noise[quiet] = 0.0
            # On the ground a UAV is at 0 exactly.
            if array is uav:
                noise[uav[:, :, UavColumn.LANDED] > 0.5] = 0.0
            array[:, :, columns] += noise
        yield mutant(
            'noise on positions',
            f'{1000.0 * size_m:g} mm, number {number}',
            base,
            (),
            trace=retold(replace(trace, ground=ground, uav=uav), base.world),
        )


def _unused(base: Recording, random: Random) -> Iterator[Mutant]:
    """Values that no condition reads, and speeds by a millimetre per second."""
    trace = base.trace
    generator = np.random.default_rng(random.randrange(1 << 32))
    ground, uav = trace.ground.copy(), trace.uav.copy()
    ground[:, :, GroundColumn.ACCELERATION] += generator.uniform(-0.1, 0.1, ground.shape[:2])
    uav[:, :, UavColumn.P : UavColumn.R + 1] += 0.01
    yield mutant(
        'values nobody reads',
        'accelerations, rates',
        base,
        (),
        trace=replace(trace, ground=ground, uav=uav),
    )
    ground, uav = trace.ground.copy(), trace.uav.copy()
    moving = ground[:, :, GroundColumn.SPEED] > 1.0
    moving[_decisions(trace)] = False
    ground[:, :, GroundColumn.SPEED] += np.where(moving, 0.001, 0.0)
    uav[:, :, UavColumn.VX : UavColumn.VZ + 1] += 0.001
    yield mutant(
        'noise on speeds', '1 mm/s', base, (), trace=replace(trace, ground=ground, uav=uav)
    )


def _more_sights(base: Recording, random: Random) -> Iterator[Mutant]:
    """A true claim more: between two equal ones that follow each other within a second."""
    trace, world = base.trace, base.world
    places = []
    for a, b in zip(trace.sights, trace.sights[1:], strict=False):
        same = (a.observer, a.target, a.visible) == (b.observer, b.target, b.visible)
        if same and 2 <= b.tick - a.tick <= round(1.0 / trace.roster.dt_s):
            places.append(a)
    for claim in random.sample(places, min(2, len(places))):
        tick = claim.tick + 1
        more = SightRecord(
            tick=tick,
            observer=claim.observer,
            target=claim.target,
            visible=claim.visible,
            slant_range_m=dist(
                reference(trace, world, claim.observer, tick),
                sight_point(trace, world, claim.target, tick),
            ),
        )
        order = sorted((*trace.sights, more), key=lambda r: (r.tick, r.observer, r.target))
        yield mutant(
            'true claim added',
            f'sight at tick {tick}',
            base,
            (),
            trace=replace(trace, sights=tuple(order)),
        )


def _fewer_sights(base: Recording, random: Random) -> Iterator[Mutant]:
    """Sight is told less often: no requirement reads the claims."""
    trace = base.trace
    if trace.sights:
        kept = tuple(r for r in trace.sights if random.random() < 0.5)
        yield mutant('claims told less often', 'half', base, (), trace=replace(trace, sights=kept))


def _same_tick(base: Recording, random: Random) -> Iterator[Mutant]:
    """Releases and phases of one tick are told in another order."""
    trace = base.trace
    free = (ScenarioEventKind.RELEASED, ScenarioEventKind.PHASE)
    by_tick: dict[int, list[EventRecord]] = {}
    for record in trace.events:
        if record.kind in free:
            by_tick.setdefault(record.tick, []).append(record)
    if all(len(records) < 2 for records in by_tick.values()):
        return
    others = [r for r in trace.events if r.kind not in free]
    for _ in range(2):
        shuffled = [random.sample(records, len(records)) for records in by_tick.values()]
        events = [*(r for records in shuffled for r in records), *others]
        yield mutant(
            'order within a tick', 'events', base, (), trace=replace(trace, events=tuple(events))
        )
