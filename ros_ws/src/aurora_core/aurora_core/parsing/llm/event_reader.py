# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Causes and effects of a reading as those of the specification."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from pydantic import TypeAdapter

from aurora_core.parsing.llm.numbers import StatedNumbers
from aurora_core.parsing.llm.reading import EventReading
from aurora_core.spec.scenario import EventAction, Trigger

# What `subject`, `other` and `value` are called, and the line in `defaults.yaml` of the value.
_TRIGGERS: dict[str, tuple[str, str, str, str]] = {
    'distance_below': ('a', 'b', 'value_m', 'trigger_distance'),
    'distance_above': ('a', 'b', 'value_m', 'trigger_distance'),
    'time': ('', '', 'at_s', 'trigger_time'),
    'altitude_reached': ('uav', '', 'value_m', 'altitude'),
    'visible': ('observer', 'target', '', ''),
    'occluded': ('observer', 'target', '', ''),
    'arrives': ('who', 'place', '', ''),
    'message_received': ('by', 'sender', '', ''),
    'speed_below': ('who', '', 'value_mps', 'trigger_speed'),
    'speed_above': ('who', '', 'value_mps', 'trigger_speed'),
    'event_done': ('', 'event', 'after_s', 'trigger_time'),
    'mission_done': ('uav', '', '', ''),
}
# The same for `subject` and `value` of an effect.
_UAV_ACTIONS = ('land', 'ascend', 'change_mission')

_TRIGGER: TypeAdapter[Trigger] = TypeAdapter(Trigger)
_ACTION: TypeAdapter[EventAction] = TypeAdapter(EventAction)


def trigger_of(
    said: EventReading, reference: Callable[[str], str], numbers: StatedNumbers
) -> Trigger:
    """Return the cause of an event.

    Raises:
        ValueError: A field is missing, or one is there that this cause does not have.
    """
    subject, other, value, parameter = _TRIGGERS[said.trigger.on]
    fields: dict[str, Any] = {'on': said.trigger.on}
    given = said.trigger
    _put(fields, subject, given.subject and reference(given.subject), f'{said.id}.subject')
    _put(fields, other, given.other and reference(given.other), f'{said.id}.other')
    if given.value is not None:
        where = f'{said.id}.trigger.value'
        known = numbers.parameter(parameter, given.value, where) if parameter else given.value
        _put(fields, value, known, where)
    return _TRIGGER.validate_python(fields)


def action_of(
    said: EventReading, reference: Callable[[str], str], numbers: StatedNumbers
) -> EventAction:
    """Return the effect of an event.

    Raises:
        ValueError: A field is missing, or one is there that this effect does not have.
    """
    given = said.action
    message, flies = given.do == 'send_message', given.do in _UAV_ACTIONS
    fields: dict[str, Any] = {'do': given.do}
    fields['sender' if message else 'uav' if flies else 'agent'] = reference(given.subject)
    _put(
        fields,
        'receiver' if message else '',
        given.receiver and reference(given.receiver),
        f'{said.id}.action.receiver',
    )
    _put(
        fields,
        'mission' if flies else '',
        given.mission and reference(given.mission),
        f'{said.id}.action.mission',
    )
    if given.value is not None:
        where = f'{said.id}.action.value'
        name = 'altitude' if flies else 'ground_speed'
        known = numbers.parameter(name, given.value, where)
        _put(fields, '' if message else 'altitude_m' if flies else 'value_mps', known, where)
    return _ACTION.validate_python(fields)


def _put(fields: dict[str, Any], name: str, value: object, where: str) -> None:
    if value is None:
        return
    if not name:
        raise ValueError(f'{where}: expected null for {fields.get("on") or fields.get("do")}')
    fields[name] = value
