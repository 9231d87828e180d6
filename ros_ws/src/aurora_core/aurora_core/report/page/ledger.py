# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What happened between bodies: the message ledger as recorded, and who sees whom."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from aurora_core.trace.records import LinkEventKind, LinkRecord, LossReason
from aurora_core.trace.trace import Trace

_LOST = {
    LossReason.RANDOM: 'lost by chance',
    LossReason.RANGE: 'out of range',
    LossReason.NONE: 'lost',
}


@dataclass(frozen=True, slots=True, kw_only=True)
class MessageRow:
    """A message and what became of it, times in simulated seconds.

    Attributes:
        event: That sent it; '' of a report by itself.
        attempts: Time of each attempt and what became of it, in words.
        ended_s: When it was delivered or given up, None when it was still under way.
        distance_m: Between both at the first attempt, None when there was none.
        line_of_sight: At the first attempt.
    """

    number: int
    link: str
    event: str
    sender: str
    receiver: str
    sent_s: float
    attempts: tuple[tuple[float, str], ...]
    delivered: bool
    ended_s: float | None
    distance_m: float | None
    line_of_sight: bool

    @property
    def outcome(self) -> str:
        """What became of it."""
        if self.ended_s is None:
            return 'under way at the end'
        return 'delivered' if self.delivered else 'not delivered'


def messages_of(trace: Trace) -> tuple[MessageRow, ...]:
    """Return the messages of a run in the order in which they were sent."""
    ledger: dict[int, list[LinkRecord]] = {}
    for record in trace.links:
        ledger.setdefault(record.message, []).append(record)
    rows = [_row(trace, number, records) for number, records in ledger.items()]
    return tuple(sorted(rows, key=lambda row: (row.sent_s, row.number)))


def _row(trace: Trace, number: int, records: list[LinkRecord]) -> MessageRow:
    first = next((r for r in records if r.kind is LinkEventKind.SENT), records[0])
    tried = [
        r for r in records if r.kind in (LinkEventKind.ATTEMPT_LOST, LinkEventKind.ATTEMPT_PASSED)
    ]
    ends = (LinkEventKind.DELIVERED, LinkEventKind.FAILED)
    end = next((r for r in records if r.kind in ends), None)
    passed = LinkEventKind.ATTEMPT_PASSED
    return MessageRow(
        number=number,
        link=first.link,
        event=first.event,
        sender=first.sender,
        receiver=first.receiver,
        sent_s=round(trace.time_s(first.tick), 3),
        attempts=tuple(
            (
                round(trace.time_s(r.tick), 3),
                'passed' if r.kind is passed else _LOST.get(r.reason, 'lost'),
            )
            for r in tried
        ),
        delivered=end is not None and end.kind is LinkEventKind.DELIVERED,
        ended_s=None if end is None else round(trace.time_s(end.tick), 3),
        distance_m=tried[0].distance_m if tried else None,
        line_of_sight=bool(tried and tried[0].line_of_sight),
    )


def sights_of(trace: Trace) -> list[dict[str, Any]]:
    """Return of each observer and target when its sight changes, times in seconds."""
    found: dict[tuple[str, str], list[tuple[float, int]]] = {}
    for record in trace.sights:
        changes = found.setdefault((record.observer, record.target), [])
        if not changes or changes[-1][1] != int(record.visible):
            changes.append((round(trace.time_s(record.tick), 3), int(record.visible)))
    return [{'by': by, 'of': of, 'seen': seen} for (by, of), seen in found.items()]
