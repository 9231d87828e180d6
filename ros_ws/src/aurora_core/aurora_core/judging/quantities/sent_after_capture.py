# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""How long after its ascent or capture a UAV sends an alert."""

from __future__ import annotations

from typing import Literal

from aurora_core.judging.build import Inputs, Source, Target, condition
from aurora_core.judging.evaluation import Context, Evaluation, Missing, at_tick
from aurora_core.judging.messages import messages_of_event
from aurora_core.judging.quantity import OfEvent
from aurora_core.outcomes.condition import Condition, MissionArguments
from aurora_core.outcomes.verdict import Reason
from aurora_core.spec.quantity import QuantityName
from aurora_core.spec.scenario import Event, SendMessage
from aurora_core.spec.vocabulary import MissionMode


class SentAfterCapture(OfEvent):
    """Time from the sender's ascent or capture to the first message of an event, seconds.

    Of a message that is sent from the ground again it is the time since the last one in the air,
    negative.

    Attributes:
        after: What it has to have finished.
    """

    name = QuantityName.SENT_AFTER_CAPTURE
    kind: Literal['sent_after_capture'] = 'sent_after_capture'
    missions: tuple[MissionArguments, ...]
    after: Literal['ascent', 'capture']

    def measure(self, context: Context, condition: Condition) -> Evaluation:
        """Return that time, negative for a message that was sent too early."""
        sent = messages_of_event(context, condition, self.event)
        if isinstance(sent, Missing):
            return sent
        flight = context.flight(self.missions[0], self.touchdown_m)
        ready, down = flight.ascent_end_tick, flight.landed_tick
        if self.after == 'capture':
            tracking = [m for m in self.missions if m.mode is MissionMode.TRACK]
            ready = context.phase(tracking[0], self.touchdown_m).capture_tick
        first, sender = min(message.sent_tick for message in sent), condition.of[0]
        if ready is None:
            story = f'{self.event} was sent, but {sender} never finished its {self.after}'
            return Missing(reason=Reason.EMPTY_PHASE, story=story, tick=first)
        if down is not None and first >= down:
            value = context.time_s(down - 1 - first)
            story = (
                f'{sender} sent {self.event} from the ground at {context.time_s(first):.2f} s, '
                f'it was down at {context.time_s(down):.2f} s'
            )
            return at_tick(first, value, story, ('comm', f'uav/state[{sender}]'))
        value = context.time_s(first - ready)
        story = (
            f'{sender} sent {self.event} at {context.time_s(first):.2f} s, {value:.2f} s after '
            f'its {self.after}'
        )
        return at_tick(first, value, story, ('comm', f'uav/state[{sender}]'))


def implied(
    inputs: Inputs,
    event: Event,
    action: SendMessage,
    missions: tuple[MissionArguments, ...],
    source: Source,
) -> Condition:
    """Return that a UAV sends an alert once it is up, or has captured what it tracks."""
    tracks = any(mission.mode is MissionMode.TRACK for mission in missions)
    after: Literal['ascent', 'capture'] = 'capture' if tracks else 'ascent'
    return condition(
        id=f'{event.id}.after_{after}',
        sentence=f'{action.sender} sends {event.id} only after its {after}',
        signal=f'sent_after_{after}({event.id})',
        of=(action.sender,),
        target=Target(op='>=', threshold=0.0, unit='s'),
        arguments=SentAfterCapture(**inputs.of_event(event.id), missions=missions, after=after),
        source=source,
        every_sample=False,
    )
