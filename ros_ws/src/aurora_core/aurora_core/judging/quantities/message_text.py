# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Whether a message says what it is asked to say."""

from __future__ import annotations

from typing import Literal

from aurora_core.judging.build import Inputs, Source, Target, condition
from aurora_core.judging.evaluation import Context, Evaluation, at_tick
from aurora_core.judging.happening import never_happened
from aurora_core.judging.quantity import OfEvent
from aurora_core.outcomes.condition import Condition
from aurora_core.spec.parameter import Provenance
from aurora_core.spec.quantity import QuantityName
from aurora_core.spec.scenario import Event
from aurora_core.trace.records import ScenarioEventKind


class MessageText(OfEvent):
    """How many times the message of an event was sent with other words than asked.

    Attributes:
        text: The words.
    """

    name = QuantityName.MESSAGE_TEXT
    kind: Literal['message_text'] = 'message_text'
    text: str

    def measure(self, context: Context, condition: Condition) -> Evaluation:
        """Return the number; the words are recorded with the event, when it is sent."""
        sent = [
            record
            for record in context.view.trace.events
            if record.kind is ScenarioEventKind.ACTION and record.subject == self.event
        ]
        if not sent:
            return never_happened(context, condition, f'no message of {self.event} was sent')
        other = [record for record in sent if record.detail != self.text]
        said = (other or sent)[0]
        story = (
            f'{self.event} said "{said.detail}"' if said.detail else f'{self.event} said nothing'
        )
        return at_tick(said.tick, float(len(other)), story, ('events',))


def implied(inputs: Inputs, event: Event, text: str) -> Condition:
    """Return that the message of an event says the words that are asked.

    Args:
        inputs: What every derivation needs.
        event: The event.
        text: The words.
    """
    return condition(
        id=f'{event.id}.text',
        sentence=f'the message of {event.id} says "{text}"',
        signal=f'other_words({event.id})',
        of=(),
        target=Target(op='<', threshold=1.0, unit='1'),
        arguments=MessageText(**inputs.of_event(event.id), text=text),
        source=Source(ids=(event.id,), spans=(event.span,), provenance=Provenance.EXPLICIT),
        every_sample=False,
    )
