# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Alterations of what the executor claims: events, phases, sight, the end."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import replace
from random import Random

from aurora_bench.mutation.mutant import Mutant, mutant
from aurora_bench.mutation.recording import Recording
from aurora_core.trace.records import EventRecord, ScenarioEventKind, SightRecord
from aurora_core.trace.trace import Trace

_K = ScenarioEventKind
_FINDING = {
    _K.PHASE: 'finding:phase',
    _K.TRIGGERED: 'finding:event',
    _K.ACTION: 'finding:event',
    _K.RELEASED: 'finding:event',
}
# Triggers may be claimed this much off where the executor learns of something later (ticks).
_OFF_TICKS = 3
# What the text of a sight range is good for (m).
_RANGE_M = 0.001


def claim_mutants(base: Recording, random: Random) -> Iterator[Mutant]:
    """Yield alterations of scenario events and of claims of sight."""
    for record in base.trace.events:
        if record.kind in _FINDING:
            yield from _one_event(base, record, random)
    yield from _added(base, random)
    yield from _reordered(base)
    yield from _end(base, random)
    yield from _sights(base, random)


def _events(base: Recording, records: Iterable[EventRecord]) -> Trace:
    return replace(base.trace, events=tuple(records))


def _one_event(base: Recording, record: EventRecord, random: Random) -> Iterator[Mutant]:
    names = {_FINDING[record.kind]}
    word = f'{record.kind.name.lower()} of {record.subject}'
    others = [r for r in base.trace.events if r is not record]
    # That an agent was let go is told by nothing but the claim.
    if record.kind is not _K.RELEASED:
        yield mutant('event removed', word, base, names, trace=_events(base, others))
    yield mutant(
        'event added', f'{word} twice', base, names, trace=_events(base, [*others, record, record])
    )
    ticks = random.choice((-1, 1)) * random.randint(_OFF_TICKS, 60)
    tick = record.tick + ticks
    if not 0 <= tick < base.trace.ticks - 1:
        tick = record.tick + abs(ticks)
    moved = [replace(record, tick=tick), *others]
    yield mutant('event moved', f'{word} to tick {tick}', base, names, trace=_events(base, moved))
    stranger = [replace(record, subject='stranger'), *others]
    yield mutant(
        'event altered', f'{word}: another subject', base, names, trace=_events(base, stranger)
    )


def _added(base: Recording, random: Random) -> Iterator[Mutant]:
    tick = random.randrange(10, base.trace.ticks - 10)
    uav = base.trace.roster.uavs[0].body_id
    for kind, subject, detail in (
        (_K.TRIGGERED, 'e7', ''),
        (_K.ACTION, 'e7', ''),
        (_K.RELEASED, 'car77', ''),
        (_K.PHASE, uav, 'landing'),
    ):
        record = EventRecord(tick=tick, sequence=0, kind=kind, subject=subject, detail=detail)
        yield mutant(
            'event added',
            f'{kind.name.lower()} of {subject} at tick {tick}',
            base,
            {_FINDING[kind]},
            trace=_events(base, (*base.trace.events, record)),
        )


def _reordered(base: Recording) -> Iterator[Mutant]:
    """Two claims at different times change places."""
    records = list(base.trace.events)
    for k in range(len(records) - 1):
        a, b = records[k], records[k + 1]
        if b.tick - a.tick < _OFF_TICKS or b.kind is _K.FINISHED:
            continue
        swapped = [
            *records[:k],
            replace(b, tick=a.tick),
            replace(a, tick=b.tick),
            *records[k + 2 :],
        ]
        names = {_FINDING[a.kind], _FINDING[b.kind]}
        yield mutant(
            'events reordered',
            f'{a.kind.name.lower()} and {b.kind.name.lower()}',
            base,
            names,
            trace=_events(base, swapped),
        )


def _end(base: Recording, random: Random) -> Iterator[Mutant]:
    others = [r for r in base.trace.events if r.kind is not _K.FINISHED]
    end = base.trace.events[-1]
    if end.detail != 'horizon':
        yield mutant(
            'event removed', 'end', base, {'reason:trace_short'}, trace=_events(base, others)
        )
        horizon = [*others, replace(end, detail='horizon')]
        yield mutant(
            'event altered',
            'end by the horizon',
            base,
            {'finding:end'},
            trace=_events(base, horizon),
        )
    tick = random.randrange(10, base.trace.ticks - 1)
    for name, records in (
        ('end, early', [*others, replace(end, tick=tick)]),
        ('end, twice', [*others, replace(end, tick=tick), end]),
    ):
        yield mutant('event added', name, base, {'finding:end'}, trace=_events(base, records))


def _sights(base: Recording, random: Random) -> Iterator[Mutant]:
    sights = base.trace.sights
    if not sights:
        return

    def one(name: str, index: int, record: SightRecord) -> Mutant:
        altered = (*sights[:index], record, *sights[index + 1 :])
        trace = replace(base.trace, sights=altered)
        return mutant('sight forged', name, base, {'finding:sight'}, trace=trace)

    for index in sorted(random.sample(range(len(sights)), min(3, len(sights)))):
        record = sights[index]
        at = f'at tick {record.tick}'
        yield one(f'visible {at}', index, replace(record, visible=not record.visible))
        metres = random.choice((-1.0, 1.0)) * random.uniform(_RANGE_M, 30.0)
        farther = replace(record, slant_range_m=record.slant_range_m + metres)
        yield one(f'range {at} {metres:+.3f} m', index, farther)
    unseen = [k for k, record in enumerate(sights) if not record.visible]
    for index in random.sample(unseen, min(2, len(unseen))):
        record = sights[index]
        yield one(f'seen while hidden at tick {record.tick}', index, replace(record, visible=True))
    index = random.randrange(len(sights))
    yield one('by a stranger', index, replace(sights[index], observer='uav9'))
    yield one('after the end', index, replace(sights[index], tick=base.trace.ticks + 5))
