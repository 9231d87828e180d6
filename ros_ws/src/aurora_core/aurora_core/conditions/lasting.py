# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Conditions on how long a ground agent does something, and what is judged by a stated time."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from aurora_core.conditions.placements import placement_id
from aurora_core.grounding.places import has_point
from aurora_core.judging.build import Inputs
from aurora_core.judging.quantities import behavior_time
from aurora_core.outcomes.condition import Condition
from aurora_core.spec.parameter import Bound
from aurora_core.spec.parking import parks_after
from aurora_core.spec.scenario import Behavior, GroundAgent
from aurora_core.spec.stated import is_stated
from aurora_core.spec.vocabulary import MOVING, STANDING, BehaviorKind


def stands_for(
    inputs: Inputs, agent: GroundAgent, behavior: Behavior, name: str
) -> Condition | None:
    """Return that an agent stands for a stated time; None where it does not, or without one."""
    if behavior.duration_s is None or behavior.kind not in STANDING:
        return None
    place = behavior.target if has_point(behavior.target) else None
    moved = behavior.kind is BehaviorKind.STOP or parks_after(inputs.spec, agent) is not None
    duration = behavior.duration_s
    return behavior_time.stands(inputs, agent, behavior, duration, place, name, moved=moved)


def moves_for(
    inputs: Inputs, agent: GroundAgent, behavior: Behavior, name: str
) -> Iterator[Condition]:
    """Yield that an agent moves for a stated time, as fast and as near as is stated."""
    if behavior.duration_s is not None and behavior.kind in MOVING:
        kept = [name] if behavior.kind is BehaviorKind.FOLLOW else []
        kept += [f'{name}.speed'] if is_stated(behavior.speed_mps) else []
        distances = stated_distances(inputs, agent, behavior)
        kept += [f'{placed}.distance_kept' for _, placed in distances]
        yield behavior_time.moves(inputs, agent, behavior, behavior.duration_s, tuple(kept), name)


def as_long(inputs: Inputs, behavior: Behavior) -> Inputs:
    """Return what a tailgating is judged by: the time that is stated for it goes before."""
    duration, t = behavior.duration_s, inputs.tolerances
    if duration is None or behavior.kind is not BehaviorKind.TAILGATE:
        return inputs
    slack_s = t.duration_s.of(duration.value, approximate=duration.approximate)
    hold_s = duration.value - (slack_s if duration.bound is Bound.EXACTLY else 0.0)
    changed = {'tailgate_hold_s': max(0.0, hold_s)}
    return replace(inputs, tolerances=t.model_copy(update=changed))


def stated_distances(
    inputs: Inputs, agent: GroundAgent, behavior: Behavior
) -> Iterator[tuple[float, str]]:
    """Yield the distances that are stated for a following (m), and the ids of their placements."""
    other = inputs.agent(behavior.target or '')
    if behavior.kind is not BehaviorKind.FOLLOW or other is None:
        return
    pair = {agent.id, other.id}
    for one in (agent, other):
        for index, p in enumerate(one.placements):
            if p.of in pair and p.distance_m is not None and p.keeps_distance:
                yield p.distance_m.value, placement_id(one, index)
