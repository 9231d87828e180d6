# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What the quantities of messages share: which messages, that there are none, which link."""

from __future__ import annotations

from aurora_core.errors import VerificationError
from aurora_core.judging.evaluation import Context, Missing
from aurora_core.judging.happening import never_happened
from aurora_core.outcomes.condition import Condition
from aurora_core.quantities.ledger import LinkModel, Message


def messages_of_event(
    context: Context, condition: Condition, event_id: str
) -> tuple[Message, ...] | Missing:
    """Return the messages of an event, at least one."""
    sent = tuple(message for message in context.messages if message.event == event_id)
    return sent or _none_sent(context, condition, event_id)


def messages_of_link(
    context: Context, condition: Condition, link_id: str
) -> tuple[Message, ...] | Missing:
    """Return the messages of a link, at least one, once no more can follow."""
    sent = tuple(message for message in context.messages if message.link_id == link_id)
    if not sent:
        return _none_sent(context, condition, link_id)
    return sent if context.complete(condition) else context.short(condition)


def attempts_on_link(
    context: Context, condition: Condition, link_id: str
) -> tuple[Message, ...] | Missing:
    """Return the messages of a link with attempts inside the record, at least one."""
    if not context.complete(condition):
        return context.short(condition)
    sent = tuple(m for m in context.messages if m.link_id == link_id and m.attempts)
    if not sent:
        return never_happened(context, condition, f'no message was sent on {link_id}')
    return sent


def _none_sent(context: Context, condition: Condition, of: str) -> Missing:
    return never_happened(context, condition, f'no message of {of} was sent')


def link_model(context: Context, condition: Condition, link_id: str | None) -> LinkModel:
    """Return the link that a condition is about.

    Raises:
        VerificationError: The specification has none of this name.
    """
    for model in context.links:
        if model.link_id == link_id:
            return model
    raise VerificationError(f'condition {condition.id} names no link of the specification')
