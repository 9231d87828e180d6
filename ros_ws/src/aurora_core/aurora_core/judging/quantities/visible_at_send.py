# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Whether a UAV sees who an alert is about when it sends it."""

from __future__ import annotations

from typing import Literal

import numpy as np

from aurora_core.judging.build import Inputs, Source, Target, condition
from aurora_core.judging.evaluation import Context, Evaluation, Measured, Missing
from aurora_core.judging.messages import messages_of_event
from aurora_core.judging.quantity import OfEvent
from aurora_core.outcomes.condition import Condition
from aurora_core.spec.quantity import QuantityName
from aurora_core.spec.scenario import Event


class VisibleAtSend(OfEvent):
    """Sight margin to the actor at each first transmission, metres."""

    name = QuantityName.VISIBLE_AT_SEND
    kind: Literal['visible_at_send'] = 'visible_at_send'

    def measure(self, context: Context, condition: Condition) -> Evaluation:
        """Return one margin per message."""
        sent = messages_of_event(context, condition, self.event)
        if isinstance(sent, Missing):
            return sent
        ticks = np.array([message.sent_tick for message in sent], dtype=np.intp)
        ticks = ticks[ticks < context.view.ticks]
        if len(ticks) == 0:
            return context.short(condition)
        gone = context.gone(condition, ticks)
        if gone is not None:
            return gone
        margin = context.sight(condition.of[0], condition.of[1]).margin_m
        topics = ('comm', 'ground/state', 'world')
        return Measured(ticks=ticks, values=margin[ticks], evidence=topics, provisional=True)


def implied(inputs: Inputs, event: Event, sender: str, actor: str, source: Source) -> Condition:
    """Return that a UAV sees whom it alerts about."""
    return condition(
        id=f'{event.id}.actor_visible',
        sentence=f'{sender} sees {actor} when it sends {event.id}',
        signal=f'sight_margin({sender},{actor})',
        of=(sender, actor),
        target=Target(op='>', threshold=0.0, unit='m'),
        arguments=VisibleAtSend(**inputs.of_event(event.id)),
        source=source,
    )
