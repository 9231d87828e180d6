# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""How often, and how soon, a link sends a lost message again."""

from __future__ import annotations

from itertools import pairwise
from typing import Literal

import numpy as np
from pydantic import FiniteFloat

from aurora_core.judging.build import Inputs, Source, Target, condition, number
from aurora_core.judging.evaluation import Context, Evaluation, Missing, at_tick
from aurora_core.judging.messages import attempts_on_link, link_model
from aurora_core.judging.quantity import OfLink
from aurora_core.outcomes.condition import Condition
from aurora_core.spec.quantity import QuantityName
from aurora_core.spec.scenario import Link


class Attempts(OfLink):
    """Number of attempts that a message has too many or too few.

    Attributes:
        again: Stated number of retransmissions.
    """

    name = QuantityName.ATTEMPTS
    kind: Literal['attempts'] = 'attempts'
    again: FiniteFloat

    def measure(self, context: Context, condition: Condition) -> Evaluation:
        """Return the worst message; one that arrived needs no more attempts."""
        sent = attempts_on_link(context, condition, self.link)
        if isinstance(sent, Missing):
            return sent
        allowed = 1 + link_model(context, condition, self.link).retransmissions
        off = []
        for message in sent:
            arrived = any(attempt.passed for attempt in message.attempts)
            excess = len(message.attempts) - allowed
            off.append(float(max(0, excess) if arrived else abs(excess)))
        worst = int(np.argmax(off))
        story = f'message {sent[worst].number} was tried {len(sent[worst].attempts)} times'
        return at_tick(sent[worst].attempts[-1].tick, off[worst], story, ('comm',))


class AttemptInterval(OfLink):
    """How far the interval between attempts is off, seconds.

    Attributes:
        interval_s: Stated interval.
    """

    name = QuantityName.ATTEMPTS
    kind: Literal['attempt_interval'] = 'attempt_interval'
    interval_s: FiniteFloat

    def measure(self, context: Context, condition: Condition) -> Evaluation:
        """Return the worst interval; what was never repeated is never off."""
        sent = attempts_on_link(context, condition, self.link)
        if isinstance(sent, Missing):
            return sent
        ticks, off = [sent[0].attempts[0].tick], [0.0]
        for message in sent:
            tried = [attempt.tick for attempt in message.attempts]
            for before, after in pairwise(tried):
                ticks.append(after)
                off.append(abs(context.time_s(after - before) - self.interval_s))
        worst = int(np.argmax(off))
        story = (
            f'{len(off) - 1} attempts were repeated, the interval was off by {off[worst]:.2f} s'
        )
        return at_tick(ticks[worst], off[worst], story, ('comm',))


def stated_number(inputs: Inputs, link: Link) -> Condition:
    """Return that a link sends again as often as the prompt says."""
    again = link.retransmissions
    return condition(
        id=f'{link.id}.retransmissions',
        sentence=f'{link.id} sends a lost message up to {number(again.value)} times again',
        signal=f'attempts_off({link.id})',
        of=(link.sender, link.receiver),
        target=Target(op='<=', threshold=0.0, unit='1'),
        arguments=Attempts(**inputs.common, link=link.id, again=again.value),
        source=Source(ids=(link.id,), spans=(again.span,), provenance=again.provenance),
        every_sample=False,
    )


def stated_interval(inputs: Inputs, link: Link) -> Condition:
    """Return that a link sends again as soon as the prompt says."""
    interval = link.retransmission_interval_s
    return condition(
        id=f'{link.id}.interval',
        sentence=f'{link.id} sends again every {number(interval.value)} s',
        signal=f'interval_off({link.id})',
        of=(link.sender, link.receiver),
        target=Target(
            op='<=', threshold=inputs.tolerances.duration_s.of(interval.value), unit='s'
        ),
        arguments=AttemptInterval(**inputs.common, link=link.id, interval_s=interval.value),
        source=Source(ids=(link.id,), spans=(interval.span,), provenance=interval.provenance),
        every_sample=False,
    )
