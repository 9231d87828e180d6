# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What repair hands on: how a request is to be realised otherwise, and why.

A plan never changes the request. It says which places a grounding may not take again, and which
values that nobody states are realised otherwise; both travel in the grounding
(`GroundedScenario`), so that a recording tells what it was made with.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from enum import StrEnum
from typing import Any

from pydantic import BaseModel, FiniteFloat, TypeAdapter, ValidationError

from aurora_core.document import Document
from aurora_core.errors import SpecError
from aurora_core.ports.language_model import ModelCall
from aurora_core.spec.parameter import Parameter, Provenance
from aurora_core.spec.scenario import ScenarioSpec


class Step(StrEnum):
    """The steps of the escalation, in their order."""

    ONE = 'one_parameter'
    SEARCH = 'search'
    GROUNDING = 'grounding'
    SYMBOLIC = 'symbolic'


class Anchor(Document):
    """Where a scene was put.

    Attributes:
        lane: Of its origin.
        position_m: Arc length there.
        whole_road: To be avoided is all of its street; otherwise what is near that place.
    """

    lane: str
    position_m: FiniteFloat
    whole_road: bool = True


class ValueEdit(Document):
    """A value that nobody states, realised otherwise.

    Attributes:
        path: In the specification.
        requested: As the request has it, in its unit.
        realised: As it is carried out and judged.
        provenance: Default or inferred.
    """

    path: str
    requested: FiniteFloat
    realised: FiniteFloat
    provenance: Provenance


class RepairPlan(Document):
    """How a request is to be grounded otherwise than at first.

    Attributes:
        avoided: Where the scene may not be.
        kept: Where it is to stay; None: at the best place that is left.
        values: What is realised otherwise.
    """

    avoided: tuple[Anchor, ...] = ()
    kept: Anchor | None = None
    values: tuple[ValueEdit, ...] = ()


class Implicated(Document):
    """Something that can be at fault for violated conditions.

    Attributes:
        field: Path of a parameter, or a field of the grounding (`grounding/anchor`).
        score: How much speaks for it; compares within one localization.
        direction: Whether more (1) or less (-1) of it should help; 0: not known, or no number.
        aim: A value with which it can come true, where the evidence gives one.
        conditions: Violated conditions that it can affect.
        reason: In English.
    """

    field: str
    score: FiniteFloat
    direction: int = 0
    aim: FiniteFloat | None = None
    conditions: tuple[str, ...]
    reason: str


class AttemptOutcome(StrEnum):
    """What came of one attempt."""

    VERIFIED = 'verified'
    VIOLATED = 'violated'
    INCONCLUSIVE = 'inconclusive'
    PLACED = 'placed'  # a request that had no place has one; the first realisation is there
    NO_PLACE = 'no_place'  # grounding found none; nothing was simulated
    REFUSED = 'refused'  # the request would have been judged otherwise; nothing was simulated
    SAME_SCENE = 'same_scene'  # it gives a scene that was tried already; nothing was simulated
    DISPLACED = 'displaced'  # somebody would stand as wrong as before; nothing was simulated
    UNSHOWN = 'unshown'  # a stated speed would not show either; nothing was simulated


class Attempt(Document):
    """One realisation of the request, and what came of it.

    Attributes:
        step: None for the first one, which is no repair.
        anchor: Where the scene was put; None where there was no place.
        scene: Digest (hex) of the grounded scene; '' where there was no place.
        margins: Normalised margin of every condition; None without one.
        predicted: Normalised margins that were expected of it; {} where nothing was.
        failed: Conditions that do not hold, or were not exercised.
        learned: Of the first one: what past episodes taught of moves (`repair.experience`).
        errors: Of the first one: what they taught of the replay, by quantity (normalised).
    """

    iteration: int
    step: Step | None = None
    plan: RepairPlan = RepairPlan()
    outcome: AttemptOutcome
    anchor: Anchor | None = None
    scene: str = ''
    margins: Mapping[str, FiniteFloat | None] = {}
    predicted: Mapping[str, FiniteFloat] = {}
    failed: tuple[str, ...] = ()
    learned: Mapping[str, FiniteFloat] = {}
    errors: Mapping[str, FiniteFloat] = {}

    @property
    def simulated(self) -> bool:
        """Whether a co-simulation was spent on it."""
        return self.outcome in (
            AttemptOutcome.VERIFIED,
            AttemptOutcome.VIOLATED,
            AttemptOutcome.INCONCLUSIVE,
        )

    @property
    def rank(self) -> tuple[int, int, float]:
        """Order of attempts, the best one greatest: verdict, what fails, worst margin."""
        verdicts = (AttemptOutcome.INCONCLUSIVE, AttemptOutcome.VIOLATED, AttemptOutcome.VERIFIED)
        place = verdicts.index(self.outcome) if self.outcome in verdicts else -1
        known = [margin for margin in self.margins.values() if margin is not None]
        return place, -len(self.failed), min(known, default=0.0)


_PAST: TypeAdapter[tuple[Attempt, ...]] = TypeAdapter(tuple[Attempt, ...])


def past_json(past: tuple[Attempt, ...]) -> str:
    """Return attempts as JSON text; `past_of` reads it."""
    return _PAST.dump_json(past).decode('utf-8')


def past_of(text: str) -> tuple[Attempt, ...]:
    """Return the attempts of a JSON text.

    Raises:
        SpecError: It is none.
    """
    try:
        return _PAST.validate_json(text)
    except ValidationError as err:
        raise SpecError(f'past_json is not valid: {err}') from err


class ProposalOutcome(StrEnum):
    """Whether there is something to try."""

    EDITED = 'edited'
    EXHAUSTED = 'exhausted'  # nothing that could help is left to try
    OUT_OF_SCOPE = 'out_of_scope'  # only what is locked could help


class Proposal(Document):
    """What repair proposes after a violated verdict.

    Attributes:
        step: Of the escalation; None when nothing is proposed.
        plan: The whole plan of the next iteration, earlier edits that stay included.
        implicated: The ranked result of the fault localization.
        predicted: Normalised margins that the surrogate expects; {} without one.
        reason: Why this is tried, or why nothing is, in English.
        model_calls: Every call to a language model for it.
    """

    outcome: ProposalOutcome
    step: Step | None = None
    plan: RepairPlan = RepairPlan()
    implicated: tuple[Implicated, ...] = ()
    predicted: Mapping[str, FiniteFloat] = {}
    reason: str
    model_calls: tuple[ModelCall, ...] = ()


def with_values(spec: ScenarioSpec, values: tuple[ValueEdit, ...]) -> ScenarioSpec:
    """Return a request with other values in the place of what nobody states.

    Args:
        spec: The request; it is not changed.
        values: What is realised otherwise.

    Raises:
        SpecError: A value is stated, is outside its domain, or is not in the request.
    """
    if not values:
        return spec
    wanted = {edit.path: edit for edit in values}
    if len(wanted) != len(values):
        raise SpecError('a value is realised in two ways at once')
    used: set[str] = set()
    changed = _changed(spec, '', lambda path, now: _realised(wanted, path, now), used)
    missing = sorted(wanted.keys() - used)
    if missing:
        raise SpecError(f'the request has no {missing[0]}')
    return ScenarioSpec.model_validate(changed.model_dump())


def restated(spec: ScenarioSpec, values: Mapping[str, float]) -> ScenarioSpec:
    """Return another request: with other numbers in the place of what the prompt states.

    Args:
        spec: The request; it is not changed.
        values: By path, in the unit of the parameter.

    Raises:
        SpecError: The request has no such number.
    """
    used: set[str] = set()

    def stated(path: str, now: Parameter) -> Parameter | None:
        return now.model_copy(update={'value': values[path]}) if path in values else None

    changed = _changed(spec, '', stated, used)
    missing = sorted(values.keys() - used)
    if missing:
        raise SpecError(f'the request has no {missing[0]}')
    return ScenarioSpec.model_validate(changed.model_dump())


def _changed(
    value: Any, path: str, other: Callable[[str, Parameter], Parameter | None], used: set[str]
) -> Any:
    """Return a value with other parameters, where there is another one for its path."""
    if isinstance(value, Parameter):
        found = other(path, value)
        if found is None:
            return value
        used.add(path)
        return found
    if isinstance(value, BaseModel):
        fields = {
            name: _changed(getattr(value, name), f'{path}/{name}'.lstrip('/'), other, used)
            for name in type(value).model_fields
        }
        return value.model_copy(update=fields)
    if isinstance(value, tuple):
        return tuple(
            _changed(item, f'{path}/{getattr(item, "id", None) or k}', other, used)
            for k, item in enumerate(value)
        )
    return value


def _realised(
    wanted: Mapping[str, ValueEdit], path: str, parameter: Parameter
) -> Parameter | None:
    edit = wanted.get(path)
    return None if edit is None else _moved(parameter, edit)


def _moved(parameter: Parameter, edit: ValueEdit) -> Parameter:
    if parameter.provenance is Provenance.EXPLICIT:
        raise SpecError(f'{edit.path} is stated by the prompt and cannot be realised otherwise')
    if (edit.requested, edit.provenance) != (parameter.value, parameter.provenance):
        raise SpecError(f'{edit.path} is not what the edit says that it changes')
    if not parameter.low <= edit.realised <= parameter.high:
        raise SpecError(
            f'{edit.path} = {edit.realised:g} is outside [{parameter.low:g}, {parameter.high:g}]'
        )
    return parameter.model_copy(update={'value': edit.realised})
