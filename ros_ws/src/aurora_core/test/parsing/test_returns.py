# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""How a flight ends: when it returns, after what, and not before; how high it flies to a place."""

from __future__ import annotations

import pytest

from aurora_core.outcomes.parse import ParseContext
from aurora_core.parsing.parser import parse_offline
from aurora_core.spec.scenario import Event, ScenarioSpec, UavAction
from aurora_core.spec.vocabulary import ClauseStatus

CONTEXT = ParseContext(map_name='downtown', landmark_names=('central_park', 'clock_tower'), seed=1)


def _read(prompt: str) -> ScenarioSpec:
    spec = parse_offline(prompt, CONTEXT).spec
    assert spec is not None
    return spec


def _is_whole(spec: ScenarioSpec) -> bool:
    return all(c.status is not ClauseStatus.NOT_ENCODED for c in spec.clauses)


def _flight(event: Event) -> tuple[str, str, float]:
    """What a UAV does, after what kind of cause, how much later."""
    cause = '' if event.trigger is None else event.trigger.on
    return getattr(event.action, 'do', ''), cause, event.waits_s


def _flights(spec: ScenarioSpec) -> list[tuple[str, str, float]]:
    return [_flight(e) for e in spec.events if isinstance(e.action, UavAction)]


@pytest.mark.parametrize(
    ('prompt', 'flights'),
    [
        ('A drone tracks a van until it stops; then it lands.', [('land', 'event_done', 0.0)]),
        (
            'A drone tracks the van; when the van stops it returns to its start.',
            [('return_home', 'event_done', 0.0)],
        ),
    ],
)
def test_a_flight_ends_as_it_is_told(prompt: str, flights: list[tuple[str, str, float]]) -> None:
    spec = _read(prompt)
    assert _flights(spec) == flights
    assert _is_whole(spec)


@pytest.mark.parametrize(
    'prompt',
    [
        'At 40 s a drone that tracks the bus returns home and lands.',
        'At 40 s the drone tracking the bus lands.',
        'At 50 s the drone hovering over Central Park returns home.',
    ],
)
def test_a_clock_that_ends_a_flight_does_not_begin_it(prompt: str) -> None:
    assert not _is_whole(_read(prompt))


@pytest.mark.parametrize(
    'prompt',
    [
        'At 40 s a drone starts tracking the bus.',
        'At 40 s a drone tracks the bus for 20 s and then returns home.',
        'A drone tracks the bus; at 60 s it returns home and lands.',
    ],
)
def test_a_clock_that_begins_a_flight_may(prompt: str) -> None:
    assert _is_whole(_read(prompt))


@pytest.mark.parametrize(
    ('words', 'level'),
    [
        ('flies to the Clock Tower at 60 m', True),
        ('flies to the Clock Tower at 60 m and hovers there for 20 s', True),
        ('flies to the Clock Tower and hovers there at 60 m for 20 s', False),
        ('hovers over the Clock Tower at 60 m for 20 s', False),
        ('circles the Clock Tower at 60 m', False),
        ('flies to the Clock Tower', False),
    ],
)
def test_a_height_told_of_the_way_is_that_of_the_way(words: str, level: bool) -> None:
    spec = _read(f'A drone tracks a van for 20 s, then {words}.')
    assert spec.missions[-1].has_a_level_way is level
    assert _is_whole(spec)
