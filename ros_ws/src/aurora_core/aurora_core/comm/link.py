# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The message link: each transmission may be lost; what passes arrives after the latency.

A message is sent, and while it is lost it is sent again after the retransmission interval until
no retransmission is left. Loss has two causes: the seeded draw, whose chance the loss of the link
and the fading over its reach make (`reach`), and distance beyond the reach, which is none during
an outage.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from math import ceil

import numpy as np

from aurora_core.comm.reach import Reach
from aurora_core.ports.random_streams import stream
from aurora_core.quantities.ledger import is_out
from aurora_core.trace.records import LinkEventKind, LinkRecord, LossReason


@dataclass(frozen=True, slots=True, kw_only=True)
class LinkSettings:
    """Parameters of one directed link.

    Attributes:
        loss: Probability that one transmission is lost, 0..1.
        latency_s: From transmission to receipt.
        retransmissions: Further transmissions after the first.
        interval_s: Between transmissions.
        reach: Range with line of sight and without, and how much fades inside it.
        outage_s: From when to when the link reaches nowhere; None: it always does.
        rate_hz: Reports that the sender sends by itself, per second; None: none.
    """

    link_id: str
    sender: str
    receiver: str
    loss: float
    latency_s: float
    retransmissions: int
    interval_s: float
    reach: Reach
    outage_s: tuple[float, float] | None = None
    rate_hz: float | None = None


@dataclass(frozen=True, slots=True, kw_only=True)
class Path:
    """Geometry of a transmission: 3-D distance and whether the line of sight is free."""

    distance_m: float
    line_of_sight: bool


@dataclass(slots=True)
class _Message:
    number: int
    event: str
    attempt: int
    next_tick: int
    arrives_tick: int | None = None


def whole_ticks(duration_s: float, dt_s: float) -> int:
    """Return the least number of ticks that lasts `duration_s`, representation errors aside."""
    return ceil(duration_s / dt_s - 1e-9)


def link_stream(seed: int, link_id: str) -> np.random.Generator:
    """Return the draws of a link: one for each transmission."""
    return stream(seed, f'link:{link_id}')


class MessageLink:
    """One link with its messages under way.

    Args:
        settings: Parameters.
        dt_s: Time step.
        generator: Stream of this link alone.
        loss_at: Loss probability in force at a tick (faults change it); default: the parameter.
    """

    def __init__(
        self,
        settings: LinkSettings,
        dt_s: float,
        generator: np.random.Generator,
        loss_at: Callable[[int], float] | None = None,
    ) -> None:
        self.settings = settings
        self._dt = dt_s
        self._generator = generator
        self._loss_at = loss_at if loss_at is not None else (lambda _tick: settings.loss)
        self._messages: list[_Message] = []

    @property
    def idle(self) -> bool:
        """Whether no message is under way."""
        return not self._messages

    def send(self, tick: int, number: int, event: str) -> None:
        """Hand message `number` to the link; its first transmission happens at `tick`."""
        self._messages.append(_Message(number=number, event=event, attempt=0, next_tick=tick))

    def step(
        self, tick: int, path: Callable[[], Path], next_sequence: Callable[[], int]
    ) -> list[LinkRecord]:
        """Deliver and transmit what is due at `tick`; return the ledger entries in order."""
        records: list[LinkRecord] = []
        for message in list(self._messages):
            if message.arrives_tick is not None:
                if tick >= message.arrives_tick:
                    here = path()
                    records.append(
                        self._record(tick, next_sequence(), message, LinkEventKind.DELIVERED, here)
                    )
                    self._messages.remove(message)
                continue
            if tick >= message.next_tick:
                records += self._transmit(tick, message, path(), next_sequence)
        return records

    def _transmit(
        self, tick: int, message: _Message, path: Path, next_sequence: Callable[[], int]
    ) -> list[LinkRecord]:
        records = []
        if message.attempt == 0:
            records.append(self._record(tick, next_sequence(), message, LinkEventKind.SENT, path))
        reach = self.settings.reach
        chance = reach.chance(self._loss_at(tick), path.distance_m, path.line_of_sight)
        # The draw is made for every transmission, in range or not: one draw per attempt keeps the
        # stream aligned when a repair moves a body in or out of range.
        lost_by_chance = bool(self._generator.random() < chance)
        reason = LossReason.NONE
        held = reach.holds(path.distance_m, path.line_of_sight)
        if not held or is_out(self.settings.outage_s, tick, self._dt):
            reason = LossReason.RANGE
        elif lost_by_chance:
            reason = LossReason.RANDOM
        if reason is LossReason.NONE:
            message.arrives_tick = tick + whole_ticks(self.settings.latency_s, self._dt)
            records.append(
                self._record(tick, next_sequence(), message, LinkEventKind.ATTEMPT_PASSED, path)
            )
            return records
        records.append(
            self._record(tick, next_sequence(), message, LinkEventKind.ATTEMPT_LOST, path, reason)
        )
        if message.attempt >= self.settings.retransmissions:
            records.append(
                self._record(tick, next_sequence(), message, LinkEventKind.FAILED, path)
            )
            self._messages.remove(message)
        else:
            message.attempt += 1
            message.next_tick = tick + max(1, whole_ticks(self.settings.interval_s, self._dt))
        return records

    def _record(
        self,
        tick: int,
        sequence: int,
        message: _Message,
        kind: LinkEventKind,
        path: Path,
        reason: LossReason = LossReason.NONE,
    ) -> LinkRecord:
        return LinkRecord(
            tick=tick,
            sequence=sequence,
            message=message.number,
            link=self.settings.link_id,
            event=message.event,
            sender=self.settings.sender,
            receiver=self.settings.receiver,
            kind=kind,
            attempt=message.attempt,
            reason=reason,
            distance_m=path.distance_m,
            line_of_sight=path.line_of_sight,
        )
