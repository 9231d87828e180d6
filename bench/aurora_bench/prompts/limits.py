# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Annotated numbers against the limits of the simulated world and the declared feasibility."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from aurora_bench.prompts.findings import Finding, Rule
from aurora_bench.prompts.format import (
    AgentRequirement,
    AnnotatedPrompt,
    BehaviorRequirement,
    ConditionRequirement,
    LinkRequirement,
    MissionRequirement,
    UavRequirement,
    WorldRequirement,
    flat,
)
from aurora_core.document import Document
from aurora_core.knowledge.agent_types import AgentTypeRecord
from aurora_core.knowledge.limits import Limits

# "At or just inside": within a tenth of the limit, or of the least value for lower limits.
_NEAR = 0.10


class _Use(Document):
    """A number and the limit it has to keep."""

    path: str
    name: str
    value: float
    low: float | None = None
    high: float | None = None

    def is_broken(self) -> bool:
        slack = 1e-6
        return (self.low is not None and self.value < self.low - slack) or (
            self.high is not None and self.value > self.high + slack
        )

    def is_near(self) -> bool:
        return any(
            limit is not None and abs(self.value - limit) <= _NEAR * abs(limit)
            for limit in (self.low, self.high)
        )


def check_limits(
    prompt: AnnotatedPrompt, limits: Limits, types: Mapping[str, AgentTypeRecord]
) -> Iterator[Finding]:
    """Find feasible prompts beyond a limit, boundary ones far from all, and wrong refusals."""
    requirements = flat(prompt.requirements)
    rejects = [r for r in requirements if r.kind == 'reject']
    for name in ('boundary', 'infeasible'):
        if (prompt.category == name) != (prompt.feasibility == name):
            yield _error(prompt, f'is {prompt.feasibility} in category {prompt.category}')
    if prompt.feasibility == 'infeasible':
        if not rejects:
            yield _error(prompt, 'is infeasible and has no requirement of kind reject')
        return
    if rejects:
        yield _error(prompt, f'is {prompt.feasibility} and asks for a refusal')
    uses = [*_uses(prompt, limits, types)]
    for use in uses:
        if use.is_broken():
            bounds = f'[{use.low if use.low is not None else ""}, {use.high or ""}]'
            yield Finding(
                where=prompt.id,
                rule=Rule.LIMIT,
                text=f'{use.path} = {use.value:g} is outside {use.name} {bounds}',
            )
    if prompt.feasibility == 'boundary' and not any(use.is_near() for use in uses):
        yield Finding(
            where=prompt.id,
            rule=Rule.FEASIBILITY,
            text='is boundary, but no annotated number is near a limit that this check knows',
            is_error=False,
        )


def _uses(
    prompt: AnnotatedPrompt, limits: Limits, types: Mapping[str, AgentTypeRecord]
) -> Iterator[_Use]:
    requirements = flat(prompt.requirements)
    kind_of = {r.ref: r.type.value for r in requirements if isinstance(r, AgentRequirement)}
    for r in requirements:
        if isinstance(r, MissionRequirement):
            yield from _mission(r, limits)
        elif isinstance(r, BehaviorRequirement) and r.speed_mps is not None:
            record = types.get(kind_of.get(r.agent, ''))
            is_person = record is not None and record.is_person
            general = (
                limits.pedestrian_speed_max_mps if is_person else limits.vehicle_speed_max_mps
            )
            high = min(general, record.max_speed_mps) if record is not None else general
            yield _Use(path=f'{r.id}.speed_mps', name='ground speed', value=r.speed_mps, high=high)
        elif isinstance(r, WorldRequirement) and r.field == 'duration_s':
            yield _Use(
                path=f'{r.id}.value',
                name='duration',
                value=float(r.value),
                low=limits.duration_min_s,
                high=limits.duration_max_s,
            )
        elif isinstance(r, ConditionRequirement) and r.quantity == 'separation':
            low = limits.separation_min_m if r.op in ('>=', '>', '==') else None
            if low is not None:
                yield _Use(path=r.id, name='separation', value=float(r.value), low=low)
    yield from _counts(prompt, limits)
    yield from _ranges(prompt, limits)


def _mission(r: MissionRequirement, limits: Limits) -> Iterator[_Use]:
    for field, low, high in (
        ('altitude_m', limits.uav_altitude_min_m, limits.uav_altitude_max_m),
        ('standoff_m', None, limits.uav_standoff_max_m),
        ('speed_mps', None, limits.uav_speed_max_mps),
        ('duration_s', None, limits.uav_endurance_s),
    ):
        value = getattr(r, field)
        for number in value if isinstance(value, tuple) else (value,):
            if number is not None:
                yield _Use(path=f'{r.id}.{field}', name=field, value=number, low=low, high=high)


def _counts(prompt: AnnotatedPrompt, limits: Limits) -> Iterator[_Use]:
    top = prompt.requirements
    uavs = sum(r.count for r in top if isinstance(r, UavRequirement))
    agents = sum(r.count for r in top if isinstance(r, AgentRequirement))
    yield _Use(path='UAVs', name='count', value=uavs, high=limits.uavs_max)
    yield _Use(path='ground agents', name='count', value=agents, high=limits.agents_max)


def _ranges(prompt: AnnotatedPrompt, limits: Limits) -> Iterator[_Use]:
    """Camera and radio: the slant distance of a mission to its target."""
    world = {r.field: str(r.value) for r in prompt.requirements if isinstance(r, WorldRequirement)}
    sensing = limits.sensing_range(world.get('weather', 'clear'), world.get('time_of_day', 'noon'))
    missions = [r for r in flat(prompt.requirements) if isinstance(r, MissionRequirement)]
    links = [r for r in flat(prompt.requirements) if isinstance(r, LinkRequirement)]
    for r in missions:
        if r.target is None or r.mode.value == 'navigate' or r.altitude_m is None:
            continue
        # Of a range of altitudes the nearer one can always be flown.
        altitude_m = r.altitude_m[0] if isinstance(r.altitude_m, tuple) else r.altitude_m
        slant = (altitude_m**2 + (r.standoff_m or 0.0) ** 2) ** 0.5
        yield _Use(path=f'{r.id} slant range', name='sensing range', value=slant, high=sensing)
        for link in links:
            if link.range_m is not None and {link.sender, link.receiver} == {r.uav, r.target}:
                yield _Use(
                    path=f'{r.id} to {r.target}',
                    name='radio range',
                    value=slant,
                    high=link.range_m,
                )


def _error(prompt: AnnotatedPrompt, text: str) -> Finding:
    return Finding(where=prompt.id, rule=Rule.FEASIBILITY, text=text)
