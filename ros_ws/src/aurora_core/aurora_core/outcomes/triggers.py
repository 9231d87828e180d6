# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""A request as it is realised: what nobody states is moved to where a grounding can meet it."""

from __future__ import annotations

from aurora_core.outcomes.grounded import GroundedScenario
from aurora_core.outcomes.repair import with_values
from aurora_core.spec.parameter import Parameter, Provenance
from aurora_core.spec.scenario import Event, ScenarioSpec, Trigger

# The numbers of triggers that a grounding can put in or out of reach.
VALUES = ('value_m', 'value_mps', 'at_s')


def trigger_path(event: str, name: str) -> str:
    """Return the path of a number of a trigger in the specification."""
    return f'events/{event}/trigger/{name}'


def movable(trigger: Trigger | None) -> tuple[str, Parameter] | None:
    """Return the number of a trigger that may be moved, with its name; None for a stated one."""
    for name in VALUES:
        value = getattr(trigger, name, None)
        if isinstance(value, Parameter) and value.provenance is Provenance.DEFAULT:
            return name, value
    return None


def as_realised(spec: ScenarioSpec, grounded: GroundedScenario) -> ScenarioSpec:
    """Return a request with the triggers and repaired values that its grounding was given.

    Only what nobody states is moved, and inside its domain, whatever a recorded grounding says.

    Args:
        spec: The request; it is not changed.
        grounded: Its grounding.

    Raises:
        SpecError: A repaired value is stated, is outside its domain, or is not in the request.
    """
    if grounded.repair is not None:
        spec = with_values(spec, grounded.repair.values)
    moved = {row.path: row.realised for row in grounded.realised}
    events = tuple(_realised(event, moved) for event in spec.events)
    if events == spec.events:
        return spec
    return ScenarioSpec.model_validate({**dict(spec), 'events': events})


def _realised(event: Event, moved: dict[str, float]) -> Event:
    found = movable(event.trigger)
    if found is None or event.trigger is None:
        return event
    name, value = found
    realised = moved.get(trigger_path(event.id, name), value.value)
    if realised == value.value or not value.low <= realised <= value.high:
        return event
    number = {**value.model_dump(), 'value': realised}
    trigger = {**event.trigger.model_dump(), name: number}
    return Event.model_validate({**dict(event), 'trigger': trigger})
