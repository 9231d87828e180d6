# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What an annotation can say and no specification can: refused by name, never left out.

A reference that silently said less than its annotation would be easier to realise than the
request.
"""

from __future__ import annotations

from collections.abc import Iterator

from aurora_bench.prompts.format import (
    Action,
    ConditionRequirement,
    CountRequirement,
    EventRequirement,
    MissionRequirement,
    Requirement,
)
from aurora_bench.prompts.reference_names import NotExpressibleError
from aurora_core.spec.requirements import STATED_QUANTITIES
from aurora_core.spec.vocabulary import Pattern


def check_sayable(r: Requirement) -> None:
    """Check that the schema of specifications has a place for all that a requirement states.

    Raises:
        NotExpressibleError: It has none for something, which is named without the requirement's
            own ids, so that the causes of many prompts can be counted.
    """
    for what in _unsayable(r):
        raise NotExpressibleError(f'no specification can say: {what}')


def _unsayable(r: Requirement) -> Iterator[str]:
    if isinstance(r, CountRequirement) and (r.type is None or r.scope != 'scene'):
        yield 'count of what has a name'
    elif isinstance(r, MissionRequirement):
        yield from (f'mission {what}' for what in _of_flight(r))
    elif isinstance(r, ConditionRequirement) and r.quantity not in STATED_QUANTITIES:
        yield f'condition {r.quantity}'
    elif isinstance(r, EventRequirement):
        if r.once is False:
            yield 'event once'
        if r.action is not None:
            yield from (f'action {what}' for what in _of_flight(r.action))


def _of_flight(flight: MissionRequirement | Action) -> Iterator[str]:
    if isinstance(flight, Action) and flight.avoid:
        yield 'avoid'
    if flight.pattern is not None and flight.pattern not in set(Pattern):
        yield f'pattern {flight.pattern}'
    goes = flight.pattern in (None, Pattern.WAYPOINTS) and flight.waypoint_count is None
    if flight.start is not None and not (goes and (flight.end or flight.target)):
        yield 'start of a pattern'
    if flight.end is not None and flight.target not in (None, flight.end):
        yield 'end of a pattern'
    if isinstance(flight.altitude_m, tuple):
        yield 'altitude_m from low to high'
