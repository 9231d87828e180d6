# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Conditions, bodies and world of a recording against those that its own documents give.

Margins say nothing when the thresholds, the boxes or the buildings beside them were changed: a
digest stamped anew hides that, a derivation from the recorded request does not.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, fields
from typing import Any

import numpy as np

from aurora_core.knowledge.world import WorldModel
from aurora_core.outcomes.condition import Condition
from aurora_core.outcomes.grounding import Unjudged
from aurora_core.outcomes.verdict import Finding
from aurora_core.trace.roster import Roster, RosterEntry

# Both worlds hold the conditions, which are compared one by one.
_NOT_COMPARED = frozenset({'conditions_json'})
# More findings of one kind say nothing more.
_FINDINGS = 5


@dataclass(frozen=True, slots=True, kw_only=True)
class Plan:
    """What the recorded request and grounding give when they are worked out anew.

    Attributes:
        conditions: Derived with the recorded limits and tolerances.
        roster: Bodies of the recorded grounding.
        world: Of the installed map, with the recorded limits; where that map is not installed, the
            recorded one with what the grounding says of it.
        seed: Of the run.
        documents: Where the recorded documents do not fit each other.
        version: Of AURORA that recorded it.
        other_version: That is not the version that is installed.
        foreign: Every limit, tolerance, setting or map that is another here, for people.
        missing: What of the request nobody carries out, as `id: what`.
        unjudged: What the request states and no condition depends on.
    """

    conditions: tuple[Condition, ...]
    roster: Roster
    world: WorldModel
    seed: int
    documents: tuple[Finding, ...] = ()
    version: str = ''
    other_version: bool = False
    foreign: tuple[str, ...] = ()
    missing: tuple[str, ...] = ()
    unjudged: tuple[Unjudged, ...] = ()


@dataclass(frozen=True, slots=True, kw_only=True)
class NotComparable:
    """Nothing can be worked out anew.

    Attributes:
        why: For people.
    """

    why: str


@dataclass(frozen=True, slots=True, kw_only=True)
class Held:
    """A recording held against its plan.

    Attributes:
        findings: What speaks against believing it.
        notes: What is only told.
    """

    findings: tuple[Finding, ...] = ()
    notes: tuple[str, ...] = ()


def held_against(
    conditions: Sequence[Condition],
    roster: Roster,
    world: WorldModel,
    plan: Plan | NotComparable,
    *,
    as_recorded: bool,
) -> Held:
    """Hold a recording against what its own request and grounding give.

    Args:
        conditions: As recorded.
        roster: As recorded.
        world: As recorded.
        plan: The same, worked out anew.
        as_recorded: What is another here (version, limits, tolerances, settings, map) is only
            told; what another version of AURORA derives is not known here, so that is only told
            as well.
    """
    if isinstance(plan, NotComparable):
        if as_recorded:
            return Held(notes=(plan.why,))
        return Held(findings=(finding('configuration', 'record', plan.why),))
    found = plan_findings(conditions, roster, world, plan)
    if not as_recorded:
        foreign = [finding('configuration', text.partition(' ')[0], text) for text in plan.foreign]
        return Held(findings=(*found, *_few(foreign)))
    told = tuple(f'judged as recorded: {text}' for text in plan.foreign)
    if not plan.other_version:
        return Held(findings=found, notes=told)
    derived = tuple(f'this version derives it otherwise: {f.kind} {f.subject}' for f in found)
    return Held(notes=(*told, *derived))


def plan_findings(
    conditions: Sequence[Condition], roster: Roster, world: WorldModel, plan: Plan
) -> tuple[Finding, ...]:
    """Return where a recording is not what its own request and grounding give.

    Args:
        conditions: As recorded.
        roster: As recorded.
        world: As recorded.
        plan: The same, worked out anew.
    """
    return (
        *plan.documents,
        *_few(_conditions(conditions, plan.conditions)),
        *_few(_roster(roster, plan.roster)),
        *_few(_world(world, plan.world)),
    )


def _few(findings: Iterable[Finding]) -> list[Finding]:
    found = list(findings)
    if len(found) <= _FINDINGS:
        return found
    more = finding(found[0].kind, found[0].kind, f'and {len(found) - _FINDINGS} more')
    return [*found[:_FINDINGS], more]


def finding(kind: str, subject: str, text: str) -> Finding:
    """Return a finding about what was recorded before the first tick."""
    return Finding(kind=kind, subject=subject, tick=0, time_s=0.0, text=text)


def _conditions(recorded: Sequence[Condition], derived: Sequence[Condition]) -> Iterator[Finding]:
    ours = {condition.id: condition for condition in derived}
    theirs = {condition.id: condition for condition in recorded}
    for name in dict.fromkeys((*ours, *theirs)):
        if name not in theirs:
            yield finding('condition', name, 'the request implies it, it is not recorded')
        elif name not in ours:
            yield finding('condition', name, 'recorded, but the request does not imply it')
        elif ours[name] != theirs[name]:
            text = _difference(ours[name].model_dump(), theirs[name].model_dump())
            yield finding('condition', name, text)
    if list(theirs) != list(ours) and set(theirs) == set(ours):
        yield finding('condition', 'order', 'the conditions are recorded in another order')


def _difference(derived: Mapping[str, Any], recorded: Mapping[str, Any]) -> str:
    """Name the first field that differs, looking into nested ones."""
    for name in derived:
        ours, theirs = derived[name], recorded.get(name)
        if ours == theirs:
            continue
        if isinstance(ours, Mapping) and isinstance(theirs, Mapping):
            return f'{name}: {_difference(ours, theirs)}'
        return f'{name} is recorded as {_short(theirs)}, the request gives {_short(ours)}'
    return 'recorded with other fields than the request gives'


def _short(value: object) -> str:
    text = str(value)
    return text if len(text) <= 60 else f'{text[:57]}...'


def _roster(recorded: Roster, planned: Roster) -> Iterator[Finding]:
    if recorded.dt_s != planned.dt_s:
        text = f'time step recorded as {recorded.dt_s} s, the settings give {planned.dt_s} s'
        yield finding('roster', 'dt_s', text)
    ours = {entry.body_id: entry for entry in (*planned.agents, *planned.uavs)}
    theirs = {entry.body_id: entry for entry in (*recorded.agents, *recorded.uavs)}
    for name in dict.fromkeys((*ours, *theirs)):
        if name not in theirs:
            yield finding('roster', name, 'part of the grounding, not recorded')
        elif name not in ours:
            yield finding('roster', name, 'recorded, but not part of the grounding')
        elif ours[name] != theirs[name]:
            yield finding('roster', name, _difference(_values(ours[name]), _values(theirs[name])))
    if list(theirs) != list(ours) and set(theirs) == set(ours):
        yield finding('roster', 'order', 'the bodies are recorded in another order')


def _values(entry: RosterEntry) -> dict[str, object]:
    return {field.name: getattr(entry, field.name) for field in fields(entry)}


def _world(recorded: WorldModel, planned: WorldModel) -> Iterator[Finding]:
    for field in fields(planned):
        if field.name in _NOT_COMPARED:
            continue
        ours, theirs = getattr(planned, field.name), getattr(recorded, field.name)
        if _same(ours, theirs):
            continue
        if isinstance(ours, tuple) and isinstance(theirs, tuple):
            yield finding('world', field.name, _members(ours, theirs))
        else:
            text = f'recorded as {_short(theirs)}, map and grounding give {_short(ours)}'
            yield finding('world', field.name, text)


def _members(ours: tuple[object, ...], theirs: tuple[object, ...]) -> str:
    if len(ours) != len(theirs):
        return f'{len(theirs)} recorded, map and grounding give {len(ours)}'
    at = next(k for k, pair in enumerate(zip(ours, theirs, strict=True)) if not _same(*pair))
    names = ('id', 'surface_id', 'lane_id', 'junction_id', 'name')
    name = next((str(getattr(ours[at], n)) for n in names if hasattr(ours[at], n)), str(at))
    return f'{name} is recorded otherwise than map and grounding give it'


def _is_plain(value: object) -> bool:
    """Tell whether a tuple holds numbers or texts alone, as points do: they are of one kind."""
    while isinstance(value, tuple) and value:
        value = value[0]
    return isinstance(value, float | int | str)


def _same(a: object, b: object) -> bool:
    """Compare values of a world: numbers by their bits, arrays and tuples by their members."""
    if isinstance(a, np.ndarray) or isinstance(b, np.ndarray):
        return np.array_equal(np.asarray(a, dtype=np.float64), np.asarray(b, dtype=np.float64))
    if isinstance(a, tuple) and isinstance(b, tuple):
        if _is_plain(a) and _is_plain(b):
            return a == b
        return len(a) == len(b) and all(_same(x, y) for x, y in zip(a, b, strict=True))
    kind = type(a)
    if kind is type(b) and hasattr(kind, '__dataclass_fields__'):
        return all(_same(getattr(a, f), getattr(b, f)) for f in kind.__dataclass_fields__)
    return a == b
