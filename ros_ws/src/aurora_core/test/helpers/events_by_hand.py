# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Events that tests write by hand, and what became of them in a scene."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from aurora_core.knowledge.map_types import Building
from aurora_core.spec.parameter import Parameter, Provenance, Unit
from aurora_core.spec.scenario import DistanceTrigger, Event, TimeTrigger
from aurora_core.trace.records import ScenarioEventKind

Make = Callable[..., Parameter]
Build = Callable[..., Any]

WALL = Building(
    id='wall',
    ring=((40.0, -50.0), (60.0, -50.0), (60.0, 50.0), (40.0, 50.0)),
    holes=(),
    height_m=100.0,
    height_source='',
    kind='block',
    name='',
)


def event_of(trigger: Any, action: Any = None, **fields: Any) -> Event:
    """Return an event that a trigger begins."""
    return Event(id=fields.pop('id', 'e1'), trigger=trigger, action=action, **fields)


def triggered(scene: Any) -> list[tuple[int, str]]:
    """Return tick and id of each event that has begun."""
    return [(tick, subject) for tick, subject, _ in scene.notes(ScenarioEventKind.TRIGGERED)]


NOW = TimeTrigger(
    on='time',
    at_s=Parameter(value=0.0, unit=Unit.SECOND, low=0.0, high=9.0, provenance=Provenance.DEFAULT),
)


def distance_event(kind: Any, parameter: Make, other: str = 'ego') -> Event:
    """Return an event that begins by how far the van is from somebody."""
    return event_of(DistanceTrigger(on=kind, a='van1', b=other, value_m=parameter(20.0)))
