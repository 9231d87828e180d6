# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""A message that something waits for is sent, unless it is sent anyway."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest

from aurora_core.planning.complete import telling
from aurora_core.spec.parameter import Parameter
from aurora_core.spec.scenario import ScenarioSpec, SendMessage

Make = Callable[..., Parameter]
STARTS = {'do': 'start', 'agent': 'van1'}
WARNS = {'do': 'send_message', 'sender': 'rsu1', 'receiver': 'van1'}


def _spec(make: Make, sender: str | None, *more: dict[str, Any], linked: bool) -> ScenarioSpec:
    waits = {'on': 'message_received', 'by': 'van1', 'sender': sender}
    numbers = {'loss': make(0.0, '1'), 'latency_s': make(0.1, 's')}
    tries = {'retransmissions': make(3.0, '1'), 'retransmission_interval_s': make(0.2, 's')}
    link = {'id': 'l1', 'sender': 'rsu1', 'receiver': 'van1', **numbers, **tries}
    return ScenarioSpec.model_validate(
        {
            'prompt': 'x',
            'agents': [{'id': 'van1', 'type': 'van'}, {'id': 'rsu1', 'type': 'rsu'}],
            'events': [{'id': 'e1', 'trigger': waits, 'action': STARTS}, *more],
            'links': [link] if linked else [],
        }
    )


def test_somebody_sends_what_is_waited_for(parameter: Make) -> None:
    told = telling(_spec(parameter, 'rsu1', linked=False))
    (added,) = told.events[1:]
    assert added.trigger is None
    assert added.action == SendMessage(do='send_message', sender='rsu1', receiver='van1')
    (link,) = told.links
    assert (link.sender, link.receiver) == ('rsu1', 'van1')
    assert telling(told) == told


@pytest.mark.parametrize(
    ('sender', 'more', 'linked'),
    [('rsu1', ({'id': 'e2', 'action': WARNS},), True), ('rsu1', (), True), (None, (), False)],
)
def test_nothing_is_sent_twice_or_by_nobody(
    sender: str | None, more: tuple[dict[str, Any], ...], linked: bool, parameter: Make
) -> None:
    spec = _spec(parameter, sender, *more, linked=linked)
    assert telling(spec) is spec
