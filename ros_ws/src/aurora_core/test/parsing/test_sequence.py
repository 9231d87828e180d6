# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What causes an event when no `when` says it."""

from __future__ import annotations

import pytest

from aurora_core.outcomes.parse import ParseContext
from aurora_core.parsing.parser import parse_offline
from aurora_core.spec.scenario import EventDoneTrigger, MessageTrigger, VisibilityTrigger


def _triggers(prompt: str) -> list[type]:
    outcome = parse_offline(prompt, ParseContext())
    assert outcome.spec is not None
    return [type(e.trigger) for e in outcome.spec.events]


@pytest.mark.parametrize(
    'prompt',
    [
        'Drone A spots a truck, alerts drone B, and B sends the ego a message.',
        'UAV A sees the bus, sends a message to UAV B, and B informs the ego.',
        'Drone A sees a child, warns drone B, and then B warns the ego.',
    ],
)
def test_a_relay_waits_for_the_message(prompt: str) -> None:
    assert _triggers(prompt) == [VisibilityTrigger, MessageTrigger]


def test_who_was_told_acts_on_the_message_and_others_after_the_event() -> None:
    told = _triggers('The RSU sends the ego a message at 12 s, then the ego slows to 5 m/s.')
    assert told[1] is MessageTrigger
    after = _triggers('The truck brakes at 20 s, whereupon the van stops.')
    assert after[1] is EventDoneTrigger


def test_one_event_told_twice_is_one() -> None:
    prompt = 'Until the bus stops, the drone hovers over the ego; once it has, it lands.'
    outcome = parse_offline(prompt, ParseContext())
    assert outcome.spec is not None
    landings = [e for e in outcome.spec.events if getattr(e.action, 'do', '') == 'land']
    assert len(landings) == 1


@pytest.mark.parametrize(
    'prompt',
    [
        'The pedestrian crosses after he has crossed, and until the bus stops he waits.',
        'A UAV patrols a 150 by 100 m rectangle until it spots it; from then on it follows.',
    ],
)
def test_nothing_causes_itself_or_starts_what_was_not_understood(prompt: str) -> None:
    outcome = parse_offline(prompt, ParseContext())
    assert outcome.spec is not None or outcome.question
    for event in outcome.spec.events if outcome.spec is not None else ():
        assert getattr(event.trigger, 'event', None) != event.id
