# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""How far an event of a run has come."""

from __future__ import annotations

from dataclasses import dataclass

from aurora_core.execution.observe import Observation
from aurora_core.geometry.kernel import norm2
from aurora_core.quantities.actions import CROSSED_M
from aurora_core.quantities.instant import Point3
from aurora_core.spec.scenario import AgentAction, Event, UavAction


def shows_after(event: Event) -> int:
    """Return how many ticks after it is due an action shows in the record.

    A message is sent at once. What an agent is told shows in its state one tick later. A UAV
    begins a phase with its next step, whose command belongs to the tick after.
    """
    if isinstance(event.action, UavAction):
        return 2
    return 1 if isinstance(event.action, AgentAction) else 0


@dataclass(slots=True)
class EventState:
    """How far an event has come.

    Attributes:
        acted: Its action was ordered.
        before_mps: Speed of the agent when it was, None when it has no speed to get to.
        climbs: A UAV on a mission goes on at another altitude.
        flies: Mission that somebody waits for a UAV to capture.
        lane: Lane that the agent is to leave, None when it is to keep its lane.
        stepped_on: Where a person that crosses stepped onto the carriageway.
        drove_on: Who stands, or brakes to a standstill, was let drive on for it.
        done: Its action is complete.
    """

    event: Event
    triggered_tick: int | None = None
    acted: bool = False
    before_mps: float | None = None
    climbs: bool = False
    flies: str | None = None
    lane: int | None = None
    stepped_on: Point3 | None = None
    drove_on: bool = False
    done: bool = False


def has_crossed(state: EventState, person: str, seen: Observation) -> bool:
    """Tell whether a person has left the carriageway on the other side; note where it began."""
    point = seen.position(person)
    if point is None:
        return False
    on = seen.on_carriageway(person)
    if state.stepped_on is None:
        state.stepped_on = point if on else None
        return False
    x, y, _ = state.stepped_on
    return not on and norm2(point[0] - x, point[1] - y) >= CROSSED_M
