# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Conditions that say the same in another form (`equivalences.py`)."""

from __future__ import annotations

from dataclasses import replace

from aurora_bench.fidelity.chains import seconds_from_start
from aurora_bench.fidelity.events import condition_fields
from aurora_bench.fidelity.fields import Case, Subject
from aurora_bench.prompts.format import ConditionRequirement
from aurora_core.spec.parameter import Bound


def is_at_time(case: Case) -> bool:
    """Whether the time that an event is to have is the time that sets it off."""
    r = case.requirement
    if not isinstance(r, ConditionRequirement) or (r.quantity, r.op) != ('event_time', '=='):
        return False
    if len(r.of) != 1 or (r.hold_s, r.by_s, r.fraction) != (None, None, None):
        return False
    spec, moments = case.subject.spec, case.subject.binding.moments_of(r.of[0])
    times = [seconds_from_start(event, spec) for event in spec.events if event.id in moments]
    return any(case.rule.counts('value', float(r.value), time_s) for time_s in times)


def is_within_horizon(case: Case) -> bool:
    """Whether the deadline of the landing is the duration of the scenario."""
    r, spec = case.requirement, case.subject.spec
    if not isinstance(r, ConditionRequirement) or r.by_s is None:
        return False
    if r.quantity not in ('landed', 'mission_completed') or (r.op, r.value) != ('==', True):
        return False
    if (r.hold_s, r.fraction) != (None, None):
        return False
    horizon_s = spec.world.duration_s
    if horizon_s is None or horizon_s.bound is Bound.AT_LEAST:
        return False
    if not case.rule.counts('by_s', r.by_s, horizon_s):
        return False
    without = replace(case, requirement=r.model_copy(update={'by_s': None}))
    return _said(without, case.subject)


# Quantities of one body: of several it is said of each.
_OF_ONE = frozenset(
    {
        'altitude', 'speed', 'hover_drift', 'waypoints_visited', 'mission_completed', 'landed',
    }
)  # fmt: skip


def is_of_each_member(case: Case) -> bool:
    """Whether what is asked of a group is said of each member, or turned round."""
    r, subject = case.requirement, case.subject
    if not isinstance(r, ConditionRequirement) or r.quantity not in _OF_ONE:
        return False
    singles = [
        condition.model_copy(update={'of': (of,)})
        for condition in subject.spec.conditions
        for of in (condition.of if condition.quantity in _OF_ONE else ())
    ]
    spec = subject.spec.model_copy(update={'conditions': tuple(singles)})
    members = [(name, member) for name in r.of for member in sorted(subject.binding.of(name))]

    def says_of(name: str, member: str) -> bool:
        binding = subject.binding
        bodies = {**binding.bodies, name: frozenset({member})}
        one = replace(subject, spec=spec, binding=replace(binding, bodies=bodies))
        return _said(replace(case, requirement=r.model_copy(update={'of': (name,)})), one)

    return bool(members) and all(says_of(name, member) for name, member in members)


_SHARES = frozenset({'visible_fraction', 'tracked_fraction', 'delivery_ratio'})


def is_whole_share(case: Case) -> bool:
    """Whether "at least all" is said as "exactly all", or turned round."""
    r = case.requirement
    if not isinstance(r, ConditionRequirement) or r.quantity not in _SHARES:
        return False
    same = {1.0: ('==', '>='), 0.0: ('==', '<=')}.get(float(r.value), ())
    return r.op in same and any(
        _said(replace(case, requirement=r.model_copy(update={'op': op})), case.subject)
        for op in same
    )


def _said(case: Case, subject: Subject) -> bool:
    r = case.requirement
    assert isinstance(r, ConditionRequirement)
    return all(condition_fields(r, subject, case.rule).values())
