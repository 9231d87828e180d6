# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Alterations of the message ledger."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import replace
from random import Random

from aurora_bench.mutation.geometry import retold
from aurora_bench.mutation.mutant import Mutant, mutant
from aurora_bench.mutation.recording import Recording
from aurora_core.spec.scenario import Link
from aurora_core.trace.records import (
    EventRecord,
    LinkEventKind,
    LinkRecord,
    LossReason,
    ScenarioEventKind,
)
from aurora_core.trace.trace import Trace

_MESSAGE = 'finding:message'
_EVENT = 'finding:event'
_K = LinkEventKind


def ledger_mutants(base: Recording, random: Random) -> Iterator[Mutant]:
    """Yield every alteration of the first message of a run that was delivered."""
    sent = [records for records in base.messages.values() if records[-1].kind is _K.DELIVERED]
    if not sent:
        return
    records = sent[0]
    yield from _removed(base, records)
    yield from _moved(base, records, random)
    yield from _entries(base, records, random)
    yield from _lost(base, records)


def _with(base: Recording, links: Iterable[LinkRecord]) -> Trace:
    return replace(base.trace, links=tuple(links))


def _without_claims(base: Recording, event: str, *kinds: ScenarioEventKind) -> Trace:
    kept = tuple(r for r in base.trace.events if r.subject != event or r.kind not in kinds)
    return replace(base.trace, events=kept)


def _removed(base: Recording, records: tuple[LinkRecord, ...]) -> Iterator[Mutant]:
    event = records[0].event
    others = tuple(r for r in base.trace.links if r not in records)
    never = {_EVENT, f'condition:{event}.within', f'condition:{event}.delivered'}
    kinds = ScenarioEventKind
    yield mutant('message removed', 'claims stay', base, {_EVENT}, trace=_with(base, others))
    silent = _without_claims(base, event, kinds.TRIGGERED, kinds.ACTION)
    yield mutant(
        'message removed', 'with its claims', base, never, trace=replace(silent, links=others)
    )
    unsent = _without_claims(base, event, kinds.ACTION)
    conditions = never - {_EVENT}
    yield mutant(
        'message removed',
        'with the claim that it was sent',
        base,
        conditions,
        trace=replace(unsent, links=others),
    )
    for name, gone in (
        ('receipt', {_K.DELIVERED}),
        ('passed attempt', {_K.ATTEMPT_PASSED}),
        ('passed attempt and receipt', {_K.ATTEMPT_PASSED, _K.DELIVERED}),
        ('sending', {_K.SENT}),
        ('lost attempts', {_K.ATTEMPT_LOST}),
    ):
        kept = [r for r in base.trace.links if r not in records or r.kind not in gone]
        if len(kept) < len(base.trace.links):
            names = {_MESSAGE, _EVENT} if _K.SENT in gone else {_MESSAGE}
            yield mutant('ledger entry removed', name, base, names, trace=_with(base, kept))


def _moved(base: Recording, records: tuple[LinkRecord, ...], random: Random) -> Iterator[Mutant]:
    """The whole message with its claim later or earlier; the trigger claim stays."""
    event, sent = records[0].event, records[0].tick
    trigger = next(e.trigger for e in base.agsg.spec.events if e.id == event)
    for ticks in (random.randint(25, 40), random.randint(41, 80), random.randint(81, 150)):
        # More than the second that is allowed.
        names = {f'condition:{event}.within'}
        yield mutant(
            'message delayed', f'{ticks} ticks', base, names, trace=shifted(base, records, ticks)
        )
    for ticks in (random.randint(5, 20), random.randint(21, 60)):
        if trigger is None or trigger.on == 'visible' or sent - ticks < 1:
            continue
        names = {f'condition:{event}.not_before'}
        yield mutant(
            'message too early',
            f'{ticks} ticks',
            base,
            names,
            trace=shifted(base, records, -ticks),
        )


def shifted(base: Recording, records: tuple[LinkRecord, ...], ticks: int) -> Trace:
    """Return the trace with a message, and the claim that it was sent, so many ticks later."""
    moved = tuple(replace(r, tick=r.tick + ticks) if r in records else r for r in base.trace.links)

    def claim(record: EventRecord) -> EventRecord:
        action = record.kind is ScenarioEventKind.ACTION and record.subject == records[0].event
        return replace(record, tick=record.tick + ticks) if action else record

    events = tuple(claim(record) for record in base.trace.events)
    return retold(replace(base.trace, links=moved, events=events), base.world)


def _entries(base: Recording, records: tuple[LinkRecord, ...], random: Random) -> Iterator[Mutant]:
    """One entry tells something else."""
    agents = [a.body_id for a in base.trace.roster.agents if a.body_id != records[0].receiver]

    def changed(record: LinkRecord, **values: object) -> Trace:
        return _with(
            base,
            (replace(r, **values) if r is record else r for r in base.trace.links),  # type: ignore[arg-type]
        )

    receipt = records[-1]
    for ticks in (-1, random.randint(1, 3), random.randint(4, 40)):
        trace = retold(changed(receipt, tick=receipt.tick + ticks), base.world)
        yield mutant('receipt moved', f'{ticks} ticks', base, {_MESSAGE}, trace=trace)
    for record in records:
        word = record.kind.name.lower()
        metres = random.choice((-1.0, 1.0)) * random.uniform(0.01, 20.0)
        yield mutant(
            'ledger entry altered',
            f'{word}: distance {metres:+.2f} m',
            base,
            {_MESSAGE},
            trace=changed(record, distance_m=record.distance_m + metres),
        )
        yield mutant(
            'ledger entry altered',
            f'{word}: line of sight',
            base,
            {_MESSAGE},
            trace=changed(record, line_of_sight=not record.line_of_sight),
        )
        if agents:
            yield mutant(
                'other receiver',
                word,
                base,
                {_MESSAGE},
                trace=changed(record, receiver=random.choice(agents)),
            )
        yield mutant(
            'ledger entry altered',
            f'{word}: another link',
            base,
            {_MESSAGE, _EVENT},
            trace=changed(record, link='link9'),
        )
        yield mutant(
            'ledger entry altered',
            f'{word}: another event',
            base,
            {_MESSAGE, _EVENT},
            trace=changed(record, event='e9'),
        )
        yield mutant(
            'ledger entry added',
            f'{word} twice',
            base,
            {_MESSAGE, _EVENT},
            trace=_with(base, (*base.trace.links, record)),
        )
        if record.kind is _K.ATTEMPT_LOST:
            yield mutant(
                'ledger entry altered',
                f'{word}: out of range',
                base,
                {_MESSAGE},
                trace=changed(record, reason=LossReason.RANGE),
            )


def _lost(base: Recording, records: tuple[LinkRecord, ...]) -> Iterator[Mutant]:
    """The attempt that passed is lost: honestly to the end, or with a forged receipt."""
    passed = next(r for r in records if r.kind is _K.ATTEMPT_PASSED)
    link = next(x for x in base.agsg.spec.links if x.id == passed.link)
    lost = replace(passed, kind=_K.ATTEMPT_LOST, reason=LossReason.RANDOM)
    forged = tuple(lost if r is passed else r for r in base.trace.links)
    yield mutant(
        'delivery forged', 'lost, yet received', base, {_MESSAGE}, trace=_with(base, forged)
    )
    others = tuple(r for r in base.trace.links if r not in records)
    luckless = next((r for r in records if r.reason is LossReason.RANDOM), None)
    if luckless is not None:
        # Everything else about it is as it would be, had this attempt had luck.
        sooner = passed.tick - luckless.tick
        luck = [r for r in records if r.tick < luckless.tick or r.kind is _K.SENT]
        luck.append(replace(luckless, kind=_K.ATTEMPT_PASSED, reason=LossReason.NONE))
        receipt = replace(records[-1], attempt=luckless.attempt)
        luck.append(replace(receipt, tick=receipt.tick - sooner))
        trace = retold(_with(base, (*others, *luck)), base.world)
        yield mutant('luck forged', 'passed at once', base, {'finding:chance'}, trace=trace)
    end = _given_up(base, records[0], link)
    if end[-1].tick < base.trace.ticks:
        trace = retold(_with(base, (*others, *end)), base.world)
        names = {f'condition:{passed.event}.delivered'}
        yield mutant('message lost', 'every attempt, then given up', base, names, trace=trace)


def _given_up(base: Recording, sent: LinkRecord, link: Link) -> list[LinkRecord]:
    spacing = round(link.retransmission_interval_s.value / base.trace.roster.dt_s)
    tries = 1 + round(link.retransmissions.value)
    lost = [
        replace(
            sent,
            tick=sent.tick + k * spacing,
            kind=_K.ATTEMPT_LOST,
            attempt=k,
            reason=LossReason.RANDOM,
        )
        for k in range(tries)
    ]
    failed = replace(lost[-1], kind=_K.FAILED, reason=LossReason.NONE)
    return [sent, *lost, failed]
