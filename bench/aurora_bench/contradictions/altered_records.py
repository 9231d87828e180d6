# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Recordings with other messages, or of another world, than the request says."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace

from aurora_bench.contradictions import motion
from aurora_bench.contradictions.case import Alter, Altered
from aurora_bench.mutation.geometry import retold
from aurora_bench.mutation.ledger import shifted
from aurora_bench.mutation.recording import Recording
from aurora_core.trace.records import LinkEventKind, LinkRecord, LossReason
from aurora_core.trace.trace import Trace

_K = LinkEventKind


def _message(base: Recording, event: str) -> tuple[LinkRecord, ...]:
    """Return the ledger entries of the message of an event."""
    return next(records for records in base.messages.values() if records[0].event == event)


def _with(base: Recording, event: str, records: Iterable[LinkRecord]) -> Trace:
    """Return the trace with other entries of the message of an event."""
    others = [r for r in base.trace.links if r not in _message(base, event)]
    return retold(replace(base.trace, links=(*others, *records)), base.world)


def _sent_later(event: str, seconds: float) -> Alter:
    """Return what sends a message later, or earlier, with the claim that it was sent."""
    return lambda base: shifted(base, _message(base, event), motion.ticks_of(base, seconds))


def _sent_once(base: Recording, event: str, tries: int) -> list[LinkRecord]:
    """Return entries of a message that is given up after so many attempts."""
    sent = _message(base, event)[0]
    link = next(x for x in base.agsg.spec.links if x.id == sent.link)
    spacing = motion.ticks_of(base, link.retransmission_interval_s.value)
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
    return [sent, *lost, replace(lost[-1], kind=_K.FAILED, reason=LossReason.NONE)]


def _received_later(event: str, seconds: float) -> Alter:
    def alter(base: Recording) -> Trace:
        *others, receipt = _message(base, event)
        assert receipt.kind is _K.DELIVERED
        late = replace(receipt, tick=receipt.tick + motion.ticks_of(base, seconds))
        return _with(base, event, [*others, late])

    return alter


def _records(
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


RECORDS: tuple[Altered, ...] = (
    _records(
        'message earlier',
        'alert 3 s before the van is near',
        'tailgate',
        'r7',
        _sent_later('e1', -3.0),
        'e1.not_before',
    ),
    _records(
        'message later',
        'alert 3 s after the van is near',
        'tailgate',
        'r7',
        _sent_later('e1', 3.0),
        'e1.within',
    ),
    _records(
        'message later',
        'sent at 18 s, not 15',
        'lossy link',
        'r5',
        _sent_later('e1', 3.0),
        'e1.time',
        'e1.within',
    ),
    _records(
        'message later',
        'alert 6 s after the stop, not 3',
        'slow and stop',
        'r6',
        _sent_later('e3', 3.0),
        'e3.within',
    ),
    _records(
        'message earlier',
        'alert 1 s after the stop, not 3',
        'slow and stop',
        'r6',
        _sent_later('e3', -2.0),
        'e3.not_before',
    ),
    _records(
        'message removed',
        'no alert of the van',
        'tailgate',
        'r7',
        lambda base: _with(base, 'e1', ()),
        'e1.within',
        'e1.delivered',
    ),
    _records(
        'message removed',
        'no alert of the stop',
        'slow and stop',
        'r6',
        lambda base: _with(base, 'e3', ()),
        'e3.within',
        'e3.delivered',
    ),
    _records(
        'message lost',
        'lost six times, never received',
        'lossy link',
        'r6',
        lambda base: _with(base, 'e1', _sent_once(base, 'e1', 6)),
        'e1.delivered',
        'c1.holds',
    ),
    _records(
        'retransmissions left out',
        'given up after two attempts',
        'lossy link',
        'r4',
        lambda base: _with(base, 'e1', _sent_once(base, 'e1', 2)),
        'link1.retransmissions',
    ),
    _records(
        'latency changed',
        'received after 0.7 s, not 0.2',
        'lossy link',
        'r4',
        _received_later('e1', 0.5),
        'e1.latency',
    ),
    _records(
        'world changed',
        'clear weather, not rain',
        'convoy',
        'r5',
        lambda base: replace(base.world, weather='clear'),
        'world.weather',
    ),
    _records(
        'world changed',
        'noon, not dusk',
        'convoy',
        'r6',
        lambda base: replace(base.world, time_of_day='noon'),
        'world.time_of_day',
    ),
)
