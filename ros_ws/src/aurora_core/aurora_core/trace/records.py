# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What the executor claims beside the states: message ledger, sight, scenario events."""

from __future__ import annotations

from dataclasses import dataclass
from enum import IntEnum


class LinkEventKind(IntEnum):
    """Entries of the message ledger."""

    SENT = 0
    ATTEMPT_LOST = 1
    ATTEMPT_PASSED = 2
    DELIVERED = 3
    FAILED = 4


class LossReason(IntEnum):
    """Why a transmission was lost."""

    NONE = 0
    RANDOM = 1
    RANGE = 2


class ScenarioEventKind(IntEnum):
    """What a scenario event tells."""

    PHASE = (
        0  # subject: UAV id, detail: name of the phase that begins with the next tick's command
    )
    TRIGGERED = 1  # subject: event id
    ACTION = 2  # subject: event id
    RELEASED = 3  # subject: agent id
    FAULT = 4  # subject: body or link id, detail: kind of fault, a blank, JSON of time and value
    FINISHED = 5  # detail: reason


@dataclass(frozen=True, slots=True, kw_only=True)
class LinkRecord:
    """One ledger entry; `sequence` orders the entries of a run."""

    tick: int
    sequence: int
    message: int
    link: str
    event: str
    sender: str
    receiver: str
    kind: LinkEventKind
    attempt: int
    reason: LossReason
    distance_m: float
    line_of_sight: bool


@dataclass(frozen=True, slots=True, kw_only=True)
class SightRecord:
    """What a UAV sees of a target (on change and once a second)."""

    tick: int
    observer: str
    target: str
    visible: bool
    slant_range_m: float


@dataclass(frozen=True, slots=True, kw_only=True)
class EventRecord:
    """Something the executor did or noticed."""

    tick: int
    sequence: int
    kind: ScenarioEventKind
    subject: str
    detail: str

    @property
    def fault_kind(self) -> str:
        """Kind of the injected fault that it announces, empty when it announces none."""
        return self.detail.partition(' ')[0] if self.kind is ScenarioEventKind.FAULT else ''
