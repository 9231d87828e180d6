# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Messages recomputed from the ledger: only whether chance lost an attempt is taken from it.

That is compared with the draws of the run in `monitor/chance_check.py`.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from math import comb

from aurora_core.quantities.motion import distance
from aurora_core.quantities.sight import radio_sight_series
from aurora_core.quantities.ticks import whole_ticks
from aurora_core.quantities.view import RunView
from aurora_core.trace.records import LinkEventKind, LinkRecord, LossReason

# Distances in the ledger are those that the kernel gives; this guards their text form alone.
DISTANCE_GUARD_M = 1e-6


@dataclass(frozen=True, slots=True, kw_only=True)
class LinkModel:
    """Parameters of a link as the specification states them.

    Attributes:
        link_id: Id in the specification.
        sender: Body id.
        receiver: Body id.
        loss: Probability that an attempt in range is lost.
        latency_s: From a passed attempt to receipt.
        retransmissions: Further attempts after the first.
        interval_s: Between attempts.
        range_sight_m: Range with line of sight.
        range_blocked_m: Range without; 0: nothing passes.
        fades: Towards the range more is lost, which nothing is said of here but that it may be.
        outage_s: From when to when the link reaches nowhere; None: it always does.
        reports: The sender reports by itself, beside what events send.
    """

    link_id: str
    sender: str
    receiver: str
    loss: float
    latency_s: float
    retransmissions: int
    interval_s: float
    range_sight_m: float
    range_blocked_m: float
    outage_s: tuple[float, float] | None = None
    reports: bool = False
    fades: bool = False


@dataclass(frozen=True, slots=True, kw_only=True)
class Attempt:
    """One transmission."""

    tick: int
    number: int
    passed: bool
    reason: LossReason


@dataclass(frozen=True, slots=True, kw_only=True)
class Message:
    """One message; delivery is recomputed from the attempt that passed.

    Attributes:
        number: Number in the run.
        event: Event that sent it.
        sent_tick: Tick of the SENT entry.
        attempts: In order.
        delivered_tick: Tick of the passed attempt plus the latency in whole ticks, None when no
            attempt passed.
    """

    number: int
    link_id: str
    event: str
    sender: str
    receiver: str
    sent_tick: int
    attempts: tuple[Attempt, ...]
    delivered_tick: int | None


@dataclass(frozen=True, slots=True, kw_only=True)
class Disagreement:
    """A claim that recomputation does not bear out."""

    tick: int
    subject: str
    text: str


def is_out(outage_s: tuple[float, float] | None, tick: int, dt_s: float) -> bool:
    """Tell whether a link reaches nowhere at a tick: from the beginning of an outage to its end.

    Args:
        outage_s: In scenario time, None for no outage.
        tick: The tick.
        dt_s: Time step.
    """
    if outage_s is None:
        return False
    return whole_ticks(outage_s[0], dt_s) <= tick < whole_ticks(outage_s[1], dt_s)


def messages(view: RunView, models: tuple[LinkModel, ...]) -> tuple[Message, ...]:
    """Return the messages of the known links in order of their numbers."""
    by_id = {model.link_id: model for model in models}
    grouped: dict[int, list[LinkRecord]] = {}
    for record in view.trace.links:
        if record.link in by_id:
            grouped.setdefault(record.message, []).append(record)
    found = []
    for number in sorted(grouped):
        records = grouped[number]
        sent = next((r for r in records if r.kind is LinkEventKind.SENT), None)
        if sent is None:
            continue
        model = by_id[sent.link]
        attempts = tuple(
            Attempt(
                tick=r.tick,
                number=r.attempt,
                passed=r.kind is LinkEventKind.ATTEMPT_PASSED,
                reason=r.reason,
            )
            for r in records
            if r.kind in (LinkEventKind.ATTEMPT_PASSED, LinkEventKind.ATTEMPT_LOST)
        )
        passed = next((a for a in attempts if a.passed), None)
        delivered = None
        if passed is not None:
            delivered = passed.tick + whole_ticks(model.latency_s, view.dt_s)
        found.append(
            Message(
                number=number,
                link_id=sent.link,
                event=sent.event,
                sender=model.sender,
                receiver=model.receiver,
                sent_tick=sent.tick,
                attempts=attempts,
                delivered_tick=delivered,
            )
        )
    return tuple(found)


def ledger_disagreements(
    view: RunView, models: tuple[LinkModel, ...], statistics_from: int
) -> tuple[Disagreement, ...]:
    """Return every entry of the ledger that the model and the states do not bear out.

    Args:
        view: The run.
        models: Links of the specification.
        statistics_from: Attempts in range that a link needs before its losses are compared with
            its loss probability (99 % interval).
    """
    found: list[Disagreement] = []
    known = {model.link_id: model for model in models}
    for record in view.trace.links:
        if record.link not in known:
            found.append(_at(record, 'belongs to no link of the specification'))
        elif (record.sender, record.receiver) != (
            known[record.link].sender,
            known[record.link].receiver,
        ):
            found.append(_at(record, 'names another sender or receiver than its link'))
    for model in models:
        records = [r for r in view.trace.links if r.link == model.link_id]
        if records and view.has(model.sender) and view.has(model.receiver):
            found += _geometry(view, model, records)
            found += _course(view, model, records)
            found += _statistics(model, records, statistics_from)
    return tuple(sorted(found, key=lambda item: (item.tick, item.subject, item.text)))


def _at(record: LinkRecord, text: str) -> Disagreement:
    return Disagreement(
        tick=record.tick,
        subject=f'message {record.message} on {record.link}',
        text=f'{record.kind.name} {text}',
    )


def _geometry(view: RunView, model: LinkModel, records: list[LinkRecord]) -> list[Disagreement]:
    apart = distance(view, model.sender, model.receiver)
    sight = radio_sight_series(view, model.sender, model.receiver)
    found = []
    for record in records:
        if not 0 <= record.tick < view.ticks:
            found.append(_at(record, 'lies outside the recorded ticks'))
            continue
        here, free = float(apart[record.tick]), bool(sight[record.tick])
        if abs(record.distance_m - here) > DISTANCE_GUARD_M:
            found.append(_at(record, f'claims {record.distance_m} m, the states give {here} m'))
        if record.line_of_sight is not free:
            found.append(_at(record, f'claims line of sight {record.line_of_sight}, it is {free}'))
        in_range = here <= (model.range_sight_m if free else model.range_blocked_m)
        in_range &= not is_out(model.outage_s, record.tick, view.dt_s)
        if record.kind is LinkEventKind.ATTEMPT_PASSED and not in_range:
            found.append(_at(record, f'passed out of range, at {here} m'))
        if record.kind is LinkEventKind.ATTEMPT_LOST:
            by_range = record.reason is LossReason.RANGE
            if by_range is in_range:
                where = 'in range' if in_range else 'out of range'
                found.append(_at(record, f'lost for {record.reason.name} while {where}'))
    return found


def _course(view: RunView, model: LinkModel, records: list[LinkRecord]) -> list[Disagreement]:
    """Check the order in time of one link's messages: attempts, retransmissions, receipt."""
    spacing = max(1, whole_ticks(model.interval_s, view.dt_s))
    claims = {
        (r.message, kind): r
        for r in records
        for kind in (LinkEventKind.DELIVERED, LinkEventKind.FAILED)
        if r.kind is kind
    }
    found = []
    once = (LinkEventKind.SENT, LinkEventKind.DELIVERED, LinkEventKind.FAILED)
    seen = set()
    for record in records:
        if record.kind in once and (record.message, record.kind) in seen:
            found.append(_at(record, 'of this message a second time'))
        seen.add((record.message, record.kind))
    complete = messages(view, (model,))
    numbers = {message.number for message in complete}
    for record in records:
        if record.message not in numbers and record.kind is not LinkEventKind.SENT:
            found.append(_at(record, 'of a message that was never sent'))
    for message in complete:
        subject = f'message {message.number} on {model.link_id}'
        attempts = message.attempts
        for k, attempt in enumerate(attempts):
            due = message.sent_tick + k * spacing
            if attempt.tick != due:
                text = f'attempt {k} at tick {attempt.tick}, due at tick {due}'
                found.append(Disagreement(tick=attempt.tick, subject=subject, text=text))
            if attempt.passed and k + 1 < len(attempts):
                text = f'attempt {k + 1} after attempt {k} had passed'
                found.append(Disagreement(tick=attempt.tick, subject=subject, text=text))
            if attempt.number != k:
                text = f'attempt {k} is numbered {attempt.number}'
                found.append(Disagreement(tick=attempt.tick, subject=subject, text=text))
        again = message.sent_tick + len(attempts) * spacing
        lost = not any(attempt.passed for attempt in attempts)
        if lost and len(attempts) <= model.retransmissions and again < view.ticks:
            text = f'attempt {len(attempts)} was due at tick {again}, none is recorded'
            found.append(Disagreement(tick=again, subject=subject, text=text))
        if len(attempts) > 1 + model.retransmissions:
            text = f'{len(attempts)} attempts, the link allows {1 + model.retransmissions}'
            found.append(Disagreement(tick=message.sent_tick, subject=subject, text=text))
        claim = claims.get((message.number, LinkEventKind.DELIVERED))
        due_tick = message.delivered_tick
        if claim is not None and claim.tick != due_tick:
            due_text = 'no attempt passed' if due_tick is None else f'due at tick {due_tick}'
            found.append(_at(claim, f'at tick {claim.tick}, {due_text}'))
        if claim is None and due_tick is not None and due_tick < view.ticks:
            text = f'passed, but no receipt is recorded at tick {due_tick}'
            found.append(Disagreement(tick=due_tick, subject=subject, text=text))
        failed = claims.get((message.number, LinkEventKind.FAILED))
        if failed is not None and (
            due_tick is not None or len(attempts) < 1 + model.retransmissions
        ):
            found.append(_at(failed, 'claimed although the message could still arrive'))
    return found


def _statistics(
    model: LinkModel, records: list[LinkRecord], statistics_from: int
) -> list[Disagreement]:
    lost = sum(r.reason is LossReason.RANDOM for r in records)
    passed = sum(r.kind is LinkEventKind.ATTEMPT_PASSED for r in records)
    attempts = lost + passed
    # What fades is lost with a chance of its own each time: its draws are compared one by one.
    if model.fades or attempts < statistics_from:
        return []
    low, high = binomial_interval(attempts, model.loss)
    if low <= lost <= high:
        return []
    text = (
        f'{lost} of {attempts} attempts lost by chance, the 99 % interval for a loss of '
        f'{model.loss} is {low} to {high}'
    )
    return [Disagreement(tick=records[-1].tick, subject=f'link {model.link_id}', text=text)]


def binomial_interval(attempts: int, probability: float) -> tuple[int, int]:
    """Return the central 99 % interval of a binomial count, from exact arithmetic.

    The least `low` and greatest `high` that leave at most 0.5 % of the probability outside on
    each side.
    """
    p = Fraction(probability)
    mass = [comb(attempts, k) * p**k * (1 - p) ** (attempts - k) for k in range(attempts + 1)]
    tail = Fraction(5, 1000)
    low, below = 0, Fraction(0)
    while below + mass[low] <= tail:
        below += mass[low]
        low += 1
    high, above = attempts, Fraction(0)
    while above + mass[high] <= tail:
        above += mass[high]
        high -= 1
    return low, high
