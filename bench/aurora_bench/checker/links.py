# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Radio links, judged on the ledger (what chance decided) and on the recorded positions."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from aurora_bench.checker import limits
from aurora_bench.checker.answers import (
    Judged,
    all_of,
    cannot_tell,
    decide,
    does_not,
    graded,
    holds,
)
from aurora_bench.checker.case import Case, Requirement
from aurora_bench.checker.recording import LinkEntry, LinkKind

# With fewer draws a share of losses says nothing but that it is not impossible.
LEAST_DRAWS = 20
TAIL = 0.005


@dataclass(frozen=True, slots=True)
class Delivery:
    """One message: when it was sent and received, and if it was given up."""

    sent_s: float
    received_s: float | None
    failed: bool


def deliveries(case: Case, sender: Any, receiver: Any) -> list[Delivery]:
    """Return the messages from one name to another, in the order of sending."""
    entries = _entries(case, sender, receiver)
    found = []
    for sent in (e for e in entries if e.kind is LinkKind.SENT):
        own = [e for e in entries if e.message == sent.message]
        got = [e.time_s for e in own if e.kind is LinkKind.DELIVERED]
        failed = any(e.kind is LinkKind.FAILED for e in own)
        found.append(Delivery(sent.time_s, min(got, default=None), failed))
    return found


def _entries(case: Case, sender: Any, receiver: Any) -> list[LinkEntry]:
    senders, receivers = case.bodies(sender), case.bodies(receiver)
    return [
        e for e in case.scene.recording.ledger if e.sender in senders and e.receiver in receivers
    ]


def link(case: Case, requirement: Requirement) -> Judged:
    """Return whether a link behaves as annotated."""
    sender, receiver = requirement.get('sender'), requirement.get('receiver')
    gone = case.missing(sender, receiver)
    if gone or not case.bodies(sender) or not case.bodies(receiver):
        return does_not(f'there is no {gone or (sender, receiver)}')
    entries = _entries(case, sender, receiver)
    parts = []
    if requirement.get('loss') is not None:
        parts.append(_loss(entries, float(requirement['loss'])))
    if requirement.get('latency_s') is not None:
        parts.append(_latency(case, entries, requirement))
    if requirement.get('range_m') is not None:
        parts.append(_range(case, entries, float(requirement['range_m'])))
    if requirement.get('retransmissions') is not None:
        parts.append(_retransmissions(entries, int(requirement['retransmissions'])))
    if requirement.get('outage_s') is not None:
        parts.append(_outage(entries, requirement['outage_s']))
    if requirement.get('rate_hz') is not None:
        parts.append(_rate(entries, float(requirement['rate_hz'])))
    if not parts:
        return graded(bool(entries), True, f'{len(entries)} entries in the ledger')
    return all_of(parts)


def binomial_tail(lost: int, draws: int, chance: float) -> float:
    """Return the smaller of P(at most so many) and P(at least so many)."""
    mass = [
        math.comb(draws, k) * chance**k * (1.0 - chance) ** (draws - k) for k in range(draws + 1)
    ]
    return min(math.fsum(mass[: lost + 1]), math.fsum(mass[lost:]))


def _loss(entries: Sequence[LinkEntry], loss: float) -> Judged:
    lost = sum(e.kind is LinkKind.ATTEMPT_LOST and e.reason == 1 for e in entries)
    draws = lost + sum(e.kind is LinkKind.ATTEMPT_PASSED for e in entries)
    why = f'{lost} of {draws} transmissions lost by chance, asked {loss:.0%}'
    if not draws:
        return cannot_tell(why)
    likely = (
        binomial_tail(lost, min(draws, 1000), loss) >= TAIL
        if draws <= 1000
        else (abs(lost / draws - loss) <= 2.58 * math.sqrt(loss * (1.0 - loss) / draws))
    )
    return graded(likely and draws >= LEAST_DRAWS, likely, why)


def _latency(case: Case, entries: Sequence[LinkEntry], requirement: Requirement) -> Judged:
    asked = float(requirement['latency_s'])
    slack = limits.LATENCY_STEPS * case.scene.dt_s + 1e-9
    own = case.variation.get(f'{requirement.get("id")}.latency_s')
    low, high = (float(own[0]), float(own[1])) if own else (asked, asked)
    found = []
    for got in (e for e in entries if e.kind is LinkKind.DELIVERED):
        passed = [
            e.time_s
            for e in entries
            if e.kind is LinkKind.ATTEMPT_PASSED and e.message == got.message
        ]
        if passed:
            found.append(got.time_s - passed[-1])
    if not found:
        return cannot_tell(f'no message was received, asked {asked:g} s')
    why = f'{len(found)} messages took {min(found):.3f} to {max(found):.3f} s, asked {asked:g} s'
    return decide(min(found) >= low - slack and max(found) <= high + slack, why)


def _range(case: Case, entries: Sequence[LinkEntry], reach: float) -> Judged:
    scene, inside, beyond, wrong = case.scene, 0, 0, []
    slack = limits.REALISED_SHARE * reach
    for e in entries:
        if e.kind not in (LinkKind.ATTEMPT_LOST, LinkKind.ATTEMPT_PASSED):
            continue
        away = float(scene.distance(e.sender, e.receiver)[scene.tick(e.time_s)])
        out_of_range = e.kind is LinkKind.ATTEMPT_LOST and e.reason == 2
        if (out_of_range and away < reach - slack) or (not out_of_range and away > reach + slack):
            wrong.append(round(away, 1))
        inside += away <= reach
        beyond += away > reach
    why = f'{inside} transmissions within {reach:g} m, {beyond} beyond'
    if wrong:
        return does_not(f'{why}, decided otherwise at {wrong[:3]} m')
    return graded(beyond > 0, True, why)


def _retransmissions(entries: Sequence[LinkEntry], most: int) -> Judged:
    attempts = [e for e in entries if e.kind in (LinkKind.ATTEMPT_LOST, LinkKind.ATTEMPT_PASSED)]
    highest = max((e.attempt for e in attempts), default=-1)
    failed = [e.message for e in entries if e.kind is LinkKind.FAILED]
    tries = [sum(e.message == m for e in attempts) for m in failed]
    why = f'up to {max(highest, 0)} retransmissions, given up after {tries}, asked {most}'
    if highest > most or any(t != most + 1 for t in tries):
        return does_not(why)
    return holds(why) if failed else cannot_tell(why)


def _outage(entries: Sequence[LinkEntry], outage: Any) -> Judged:
    start, end = float(outage[0]) + limits.OUTAGE_S, float(outage[1]) - limits.OUTAGE_S
    inside = [e for e in entries if start <= e.time_s <= end]
    passed = sum(e.kind is LinkKind.ATTEMPT_PASSED for e in inside)
    lost = sum(e.kind is LinkKind.ATTEMPT_LOST for e in inside)
    why = f'{passed} passed and {lost} lost in the outage'
    return does_not(why) if passed else graded(lost > 0, True, why)


def _rate(entries: Sequence[LinkEntry], rate_hz: float) -> Judged:
    times = np.array([e.time_s for e in entries if e.kind is LinkKind.SENT])
    if len(times) < 3:
        return graded(False, len(times) > 0, f'{len(times)} messages sent, asked {rate_hz:g} Hz')
    rate = (len(times) - 1) / float(times[-1] - times[0])
    why = f'{rate:.3f} messages per second, asked {rate_hz:g}'
    return decide(abs(rate - rate_hz) <= limits.RATE_SHARE * rate_hz, why)
