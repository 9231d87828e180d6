# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What a request states and no condition of its run depends on.

A condition depends on a value of the specification when it is another one, or none, with another
value. So every explicit parameter and every stated choice is changed in turn and the conditions
are derived again, from the same plan: what leaves all conditions as they were could be anything
in the run, and nobody would notice. Nothing is declared here that could be forgotten.

What the monitor takes from the specification while it measures is no part of a condition's text:
the conditions about an event depend on its trigger, and on who is to do what.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Container, Iterator, Mapping, Sequence
from dataclasses import dataclass
from enum import Enum
from operator import attrgetter
from typing import Any, Literal, get_args, get_origin

from pydantic import BaseModel
from pydantic.fields import FieldInfo

from aurora_core.agsg.parameters import element_of, item_path
from aurora_core.errors import AuroraError
from aurora_core.outcomes.condition import Condition
from aurora_core.outcomes.grounding import Unjudged
from aurora_core.spec.parameter import Bound, Parameter, Provenance, Span
from aurora_core.spec.reference import is_place
from aurora_core.spec.scenario import GroundAgent, ScenarioSpec
from aurora_core.spec.vocabulary import Place

# Derives the conditions of a specification from the plan of the run.
Derive = Callable[[ScenarioSpec], Sequence[Condition]]

# Derives those of what one ground agent does and of where it is placed, by its id.
DeriveOfAgent = Callable[[ScenarioSpec, str], Sequence[Condition]]

# These say nothing about the run: names, where a word stands, who chose it, and roles, which
# nobody can see.
NO_CHOICE = frozenset(
    {
        'id',
        'group',
        'role',
        'prompt',
        'clauses',
        'distance_at_start',
        'reader',
        'schema_version',
        'target_inferred',
        'prohibitions',
        'seed',
    }
)


@dataclass(frozen=True, slots=True, kw_only=True)
class _Facet:
    """Something stated: where, its values that differ, and how to say it.

    Attributes:
        keys: Way into the document of the specification.
        others: Documents of other values to try in its place, best ones first.
        is_number: It is a parameter.
    """

    path: str
    keys: tuple[str | int, ...]
    others: tuple[Any, ...]
    what: str
    span: Span | None
    is_number: bool = False


# What a condition asks for; words and sources are aside.
_ASIDE = {'sentence', 'spans', 'spec_ids', 'provenance', 'implied', 'scale', 'signal'}
_asked = attrgetter(*(name for name in Condition.model_fields if name not in _ASIDE))


def unjudged(
    spec: ScenarioSpec,
    conditions: Sequence[Condition],
    derive: Derive,
    derive_of_agent: DeriveOfAgent | None = None,
) -> tuple[Unjudged, ...]:
    """Return what a specification states and no condition depends on.

    Args:
        spec: The request.
        conditions: Those of the run.
        derive: How they were derived; called with specifications that differ in one value.
        derive_of_agent: The same for one agent alone. In a crowd hardly anybody else's conditions
            depend on what is stated of it, so that all of them need not be derived.
    """
    known = _by_id(conditions)
    about = {c.arguments.event for c in conditions if c.arguments.event is not None}
    about |= {name for c in conditions for name in c.of}
    found = []
    for facet in _facets(spec):
        if _read_with(facet, spec) in about:
            continue
        if derive_of_agent is not None and _own_depend(spec, facet, derive_of_agent):
            continue
        if _depends(spec, facet, known, derive):
            continue
        found.append(
            Unjudged(
                element=element_of(facet.path),
                path=facet.path,
                what=facet.what,
                span=facet.span,
            )
        )
    return tuple(found)


def paths_stated(spec: ScenarioSpec) -> tuple[str, ...]:
    """Return where explicit parameters and stated choices stand in a specification."""
    return tuple(facet.path for facet in _facets(spec))


def conditions_depending(
    spec: ScenarioSpec, conditions: Sequence[Condition], derive: Derive, paths: Container[str]
) -> Mapping[str, frozenset[str]]:
    """Return, by path of what is stated, the ids of the conditions that depend on it.

    Args:
        spec: The request.
        conditions: Those of the run.
        derive: How they were derived.
        paths: Where what is asked about stands, of `paths_stated`.
    """
    known = _by_id(conditions)
    found: dict[str, frozenset[str]] = {}
    for facet in _facets(spec):
        if facet.path not in paths:
            continue
        ids: set[str] = set()
        event = _read_with(facet, spec)
        if event is not None:
            ids |= {c.id for c in conditions if event == c.arguments.event or event in c.of}
        for other in _changed(spec, facet, derive):
            if other is None:
                # No plan has it: what is judged of the element is judged on one that fits.
                ids |= _own(known, facet)
                continue
            ids |= _differing(known, other) | _spanning(facet, known, other)
        found[facet.path] = frozenset(ids)
    return found


def _read_with(facet: _Facet, spec: ScenarioSpec) -> str | None:
    """Return the event with which the monitor reads a value itself, None where it does not.

    The numbers of an action it does not read: they have conditions of their own.
    """
    if facet.keys[0] != 'events' or len(facet.keys) < 4:
        return None
    read = facet.keys[2] == 'trigger' or not facet.is_number
    return spec.events[int(facet.keys[1])].id if read else None


def _own_depend(spec: ScenarioSpec, facet: _Facet, derive: DeriveOfAgent) -> bool:
    """Tell whether a facet belongs to an agent whose own conditions are others when it changes.

    Their ids are the agent's, so that nothing else could stand for one that is gone.
    """
    if facet.keys[0] != 'agents':
        return False
    agent = spec.agents[int(facet.keys[1])].id
    known = _by_id(derive(spec, agent))
    found = _changed(spec, facet, lambda asked: derive(asked, agent))
    return any(other is None or _differing(known, other) for other in found)


def _depends(
    spec: ScenarioSpec, facet: _Facet, known: Mapping[str, Condition], derive: Derive
) -> bool:
    """Tell whether a condition is another one, or is gone, when a facet is changed."""
    tried = False
    for other in _changed(spec, facet, derive):
        tried = True
        if other is None or _differing(known, other) or _spanning(facet, known, other):
            return True
    # What cannot be otherwise is judged with the element that it belongs to.
    return not tried


def _changed(
    spec: ScenarioSpec, facet: _Facet, derive: Derive
) -> Iterator[Mapping[str, Condition] | None]:
    """Yield the conditions with each other value; None: the plan does not allow the value."""
    for other in facet.others:
        try:
            changed = _spec_with(spec, facet.keys, other)
        except ValueError:
            continue
        try:
            yield _by_id(derive(changed))
        except AuroraError:
            yield None


def _by_id(conditions: Sequence[Condition]) -> dict[str, Condition]:
    return {c.id: c for c in conditions}


def _differing(known: Mapping[str, Condition], other: Mapping[str, Condition]) -> set[str]:
    """Return which conditions ask for something else, or are gone."""
    return {
        name
        for name, condition in known.items()
        if name not in other or _asked(other[name]) != _asked(condition)
    }


def _own(known: Mapping[str, Condition], facet: _Facet) -> set[str]:
    element = element_of(facet.path)
    return {name for name, condition in known.items() if element in condition.spec_ids}


def _spanning(
    facet: _Facet, known: Mapping[str, Condition], other: Mapping[str, Condition]
) -> set[str]:
    """Return the conditions of an order that another one would have beside more of them.

    An order has one for every mission up to its second one: one that begins earlier, or ends
    later, asks for all that this one asks for.
    """
    mine = _own(known, facet) if facet.keys[0] == 'orders' else set()
    return mine if mine and _own(other, facet) > mine else set()


def _spec_with(spec: ScenarioSpec, keys: tuple[str | int, ...], other: Any) -> ScenarioSpec:
    """Return a specification with another value at a place of it.

    Raises:
        ValueError: It does not fit there.
    """
    if keys[0] != 'agents':
        return ScenarioSpec.model_validate(_with(spec, keys, other))
    # Of a crowd, only who is another one is validated.
    agent = spec.agents[int(keys[1])]
    return spec.with_agent(GroundAgent.model_validate(_with(agent, keys[2:], other)))


def _with(value: Any, keys: tuple[str | int, ...], other: Any) -> Any:
    """Return what is validated to a value with another one at a place of it.

    What does not lie on the way there is taken over as it is, and not validated again.
    """
    if not keys:
        return other
    key, rest = keys[0], keys[1:]
    if isinstance(value, tuple):
        return tuple(_with(v, rest, other) if k == key else v for k, v in enumerate(value))
    fields = {name: getattr(value, name) for name in type(value).model_fields}
    return {**fields, key: _with(fields[str(key)], rest, other)}


def _facets(spec: ScenarioSpec) -> Iterator[_Facet]:
    """Yield every explicit parameter and every stated choice, in their order."""
    for name in type(spec).model_fields:
        if name not in NO_CHOICE:
            yield from _below(getattr(spec, name), name, (name,), None, spec)


def _below(
    value: Any,
    path: str,
    keys: tuple[str | int, ...],
    span: Span | None,
    spec: ScenarioSpec,
) -> Iterator[_Facet]:
    if isinstance(value, Parameter):
        yield from _number(value, path, keys)
    elif isinstance(value, BaseModel):
        span = getattr(value, 'span', None) or span
        for name, info in type(value).model_fields.items():
            part = getattr(value, name)
            if name in NO_CHOICE or name.endswith('span') or part is None:
                continue
            inside = (f'{path}/{name}', (*keys, name))
            if isinstance(part, Parameter | BaseModel | tuple):
                yield from _below(part, *inside, span, spec)
            elif info.is_required() or part != info.default:
                others = [] if info.is_required() else [info.default]
                yield _Facet(
                    path=inside[0],
                    keys=inside[1],
                    others=(*others, *_others(part, info, spec)),
                    what=f'{name.replace("_", " ")} {getattr(part, "value", part)}',
                    span=getattr(value, f'{name}_span', None) or span,
                )
    elif isinstance(value, tuple) and value and isinstance(value[0], str):
        shorter = [list(value[:-1]), list(value[1:])]
        others = [[word] for word in _other_words(value[0], spec) if word not in value]
        what = f'{keys[-1]} {", ".join(value)}'
        yield _Facet(path=path, keys=keys, others=(*others, *shorter), what=what, span=span)
    elif isinstance(value, tuple):
        for index, item in enumerate(value):
            yield from _below(item, item_path(path, index, item), (*keys, index), span, spec)


def _number(value: Parameter, path: str, keys: tuple[str | int, ...]) -> Iterator[_Facet]:
    """Yield an explicit parameter with other numbers, inside its domain where that leaves room."""
    if value.provenance is not Provenance.EXPLICIT:
        return
    step = max(1.0, 0.5 * abs(value.value))
    numbers = (value.value - step, value.value + step, (value.low + value.high) / 2.0)
    dumped = value.model_dump(mode='json')
    others = [
        {**dumped, 'value': number}
        for number in numbers
        if math.isfinite(number) and number != value.value and number >= 0.0
    ]
    name = path.rsplit('/', 1)[-1]
    bound = '' if value.bound is Bound.EXACTLY else f'{value.bound.value.replace("_", " ")} '
    yield _Facet(
        path=path,
        keys=keys,
        others=tuple(others),
        what=f'{name} = {bound}{value.value:g} {value.unit.value}',
        span=value.span,
        is_number=True,
    )


def _others(value: Any, info: FieldInfo, spec: ScenarioSpec) -> list[Any]:
    """Return what else a stated word, flag or reference could be."""
    if isinstance(value, bool):
        return [not value]
    listed = (info.json_schema_extra or {}) if not callable(info.json_schema_extra) else {}
    words = [*_words(info.annotation), *listed.get('enum', ())]  # type: ignore[misc]
    if words:
        return [word for word in words if word != value]
    return _other_words(value, spec) if isinstance(value, str) else []


def _words(annotation: Any) -> Iterator[str]:
    """Yield the words that an annotation allows: of enums and literals, also in unions."""
    if isinstance(annotation, type) and issubclass(annotation, Enum):
        yield from (member.value for member in annotation)
    for part in get_args(annotation):
        if isinstance(part, str) and get_origin(annotation) is Literal:
            yield part
        else:
            yield from _words(part)


def _other_words(value: str, spec: ScenarioSpec) -> list[str]:
    """Return what a reference could lead to besides: others of its kind, or other places."""
    if is_place(value):
        return [place.value for place in Place if place.value != value]
    bodies = [agent.id for agent in spec.agents] + [uav.id for uav in spec.uavs]
    kinds = (bodies, [e.id for e in spec.events], [m.id for m in spec.missions])
    # A group of bodies, or an order of an event and a mission.
    named = next((kind for kind in kinds if value in kind), bodies)
    others = [name for kind in kinds if kind is not named for name in kind]
    return [name for name in (*named, *others) if name != value]
