# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Samples of what a link's stated parameters imply: its range, and how often it sends again."""

from __future__ import annotations

from itertools import pairwise

import numpy as np

from aurora_core.monitor.evaluation import Context, Evaluation, Measured, Missing, at_tick
from aurora_core.monitor.measure_events import link_model, never_happened
from aurora_core.outcomes.condition import Condition
from aurora_core.quantities import motion
from aurora_core.quantities.ledger import Message
from aurora_core.trace.records import LossReason


def _sent(context: Context, condition: Condition) -> tuple[Message, ...] | Missing:
    """Return the messages of a link, each with its attempts inside the record."""
    link = condition.arguments.link
    if not context.complete(condition):
        return context.short(condition)
    sent = tuple(m for m in context.messages if m.link_id == link and m.attempts)
    if not sent:
        return never_happened(context, condition, f'no message was sent on {link}')
    return sent


def measure_link_range(context: Context, condition: Condition) -> Evaluation:
    """Metres by which each attempt was on the right side of the range.

    One that passed, or was lost by chance, inside it; one that was lost for its distance outside.
    """
    sent = _sent(context, condition)
    if isinstance(sent, Missing):
        return sent
    apart = motion.distance(context.view, *condition.of)
    range_m = condition.arguments.wanted
    ticks, slack = [], []
    for attempt in (a for message in sent for a in message.attempts):
        if attempt.tick < context.view.ticks:
            inside_m = range_m - float(apart[attempt.tick])
            out_of_range = not attempt.passed and attempt.reason is LossReason.RANGE
            ticks.append(attempt.tick)
            slack.append(-inside_m if out_of_range else inside_m)
    return Measured(
        ticks=np.array(ticks, dtype=np.intp), values=np.array(slack), evidence=('comm', 'state')
    )


def measure_attempts(context: Context, condition: Condition) -> Evaluation:
    """`count`: attempts that a message has too many or too few; `interval`: seconds off it."""
    sent = _sent(context, condition)
    if isinstance(sent, Missing):
        return sent
    if condition.arguments.aspect == 'interval':
        return _intervals(context, condition, sent)
    allowed = 1 + link_model(context, condition).retransmissions
    off = []
    for message in sent:
        arrived = any(attempt.passed for attempt in message.attempts)
        excess = len(message.attempts) - allowed
        off.append(float(max(0, excess) if arrived else abs(excess)))
    worst = int(np.argmax(off))
    story = f'message {sent[worst].number} was tried {len(sent[worst].attempts)} times'
    return at_tick(sent[worst].attempts[-1].tick, off[worst], story, ('comm',))


def _intervals(context: Context, condition: Condition, sent: tuple[Message, ...]) -> Evaluation:
    wanted_s = condition.arguments.wanted
    ticks, off = [sent[0].attempts[0].tick], [0.0]
    for message in sent:
        tried = [attempt.tick for attempt in message.attempts]
        for before, after in pairwise(tried):
            ticks.append(after)
            off.append(abs(context.time_s(after - before) - wanted_s))
    worst = int(np.argmax(off))
    story = f'{len(off) - 1} attempts were repeated, the interval was off by {off[worst]:.2f} s'
    return at_tick(ticks[worst], off[worst], story, ('comm',))
