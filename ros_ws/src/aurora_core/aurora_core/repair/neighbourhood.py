# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The check that an edit stays inside its neighbourhood N(S_k), over the whole graph.

What is moved has to be in the localization that the edit answers to. All else may only follow:
with the scene at its place a body, a realised value or a condition is another one where the
graph's edges lead to it from the owner of something that was moved; at another place everything
may that stands on the map. The request itself is the same, value by value.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Collection, Iterable, Iterator

from aurora_core.mission.plan import UavPlan
from aurora_core.outcomes.agsg import Agsg, AgsgParameter
from aurora_core.outcomes.grounded import GroundedAgent, GroundedScenario
from aurora_core.repair.helps import ANCHOR
from aurora_core.repair.realised_values import here_of
from aurora_core.spec.parameter import Provenance

# What a condition judges; a horizon that nobody states may come later with a longer flight.
_JUDGED = ('quantity', 'op', 'of', 'threshold', 'tolerance', 'hold_s', 'fraction')
# Fields of a parameter's row that belong to the request.
_ASKED = ('owner', 'requested', 'low', 'high', 'unit', 'provenance', 'span')


def outside(before: Agsg, after: Agsg, admissible: Collection[str]) -> Iterator[str]:
    """Yield what an edit changed that is not in its neighbourhood, and does not follow from it.

    Args:
        before: The realisation that the edit was proposed after.
        after: What came of it, grounded.
        admissible: Fields of the localization of `before`.
    """
    ours, theirs = before.grounding, after.grounding
    if ours is None or theirs is None:
        yield 'one of both is not grounded'
        return
    if before.spec != after.spec:
        yield 'the request is another one'
    rows = {row.path: row for row in after.parameters}
    yield from _of_the_request(before.parameters, rows)
    moved = [
        row
        for row in before.parameters
        if row.path in rows and here_of(row, before) != here_of(rows[row.path], after)
    ]
    for row in moved:
        if row.path not in admissible:
            yield f'{row.path} is moved and is not in the neighbourhood'
        elif row.provenance is Provenance.EXPLICIT:
            yield f'{row.path} is moved and is stated'
    if _place(ours) != _place(theirs):
        if ANCHOR not in admissible:
            yield f'{ANCHOR} is moved and is not in the neighbourhood'
        return  # all that stands on the map follows from where the scene is
    follows = _awaited(before, _downstream(before, (row.owner for row in moved)))
    yield from _bodies(before, ours, theirs, follows)
    for row in before.parameters:
        other = rows.get(row.path)
        if other is not None and row.realised != other.realised and row.owner not in follows:
            yield f'{row.path} is realised otherwise and nothing that was moved leads to it'
    yield from _judged(before, after, follows)


def _of_the_request(
    before: Iterable[AgsgParameter], after: dict[str, AgsgParameter]
) -> Iterator[str]:
    known = set(after)
    for row in before:
        known.discard(row.path)
        other = after.get(row.path)
        if other is None:
            yield f'{row.path} is gone'
            continue
        for name in _ASKED:
            if getattr(row, name) != getattr(other, name):
                yield f'{row.path} has another {name}'
    for path in sorted(known):
        yield f'{path} is new'


def _bodies(
    agsg: Agsg, before: GroundedScenario, after: GroundedScenario, follows: frozenset[str]
) -> Iterator[str]:
    """Yield bodies that are placed otherwise; traffic of nobody keeps clear of what flies."""
    asked = {node.id for node in agsg.nodes}
    flies = any(uav.id in follows for uav in before.uavs)
    ours, theirs = _placed(before), _placed(after)
    for name in sorted({*ours, *theirs}):
        if _alike(ours.get(name), theirs.get(name)):
            continue
        if not (name in follows if name in asked else flies):
            yield f'{name} is placed otherwise and nothing that was moved leads to it'


def _placed(grounded: GroundedScenario) -> dict[str, GroundedAgent | UavPlan]:
    bodies: tuple[GroundedAgent | UavPlan, ...] = (*grounded.agents, *grounded.uavs)
    return {body.id: body for body in bodies}


def _alike(ours: GroundedAgent | UavPlan | None, theirs: GroundedAgent | UavPlan | None) -> bool:
    """Tell whether a body is where it was; a route is planned as long as the run may last."""
    if not (isinstance(ours, GroundedAgent) and isinstance(theirs, GroundedAgent)):
        return ours == theirs
    common = min(len(ours.edges), len(theirs.edges))
    if ours.edges[:common] != theirs.edges[:common]:
        return False
    way = {'edges': (), 'route_xy_m': ()}
    return ours.model_copy(update=way) == theirs.model_copy(update=way)


def _judged(before: Agsg, after: Agsg, follows: frozenset[str]) -> Iterator[str]:
    now = {condition.id: condition for condition in after.conditions}
    ends = tuple(None if a.schedule is None else a.schedule.horizon_s for a in (before, after))
    for condition in before.conditions:
        other = now.get(condition.id)
        if other is None:
            yield f'nothing judges {condition.id} any more'
        elif condition.id not in follows:
            for name in _JUDGED:
                ours, theirs = getattr(condition, name), getattr(other, name)
                # What is to happen before the run ends: that a stated end stays is in the lock.
                at_the_end = name == 'threshold' and (ours, theirs) == ends
                if ours != theirs and not at_the_end:
                    yield f'{condition.id} has another {name} and nothing moved leads to it'


def _downstream(agsg: Agsg, owners: Iterable[str]) -> frozenset[str]:
    """Return the nodes that depend on some, these included."""
    led: dict[str, list[str]] = {}
    for edge in agsg.edges:
        led.setdefault(edge.source, []).append(edge.target)
    found = set(owners)
    waiting = deque(found)
    while waiting:
        for target in led.get(waiting.popleft(), ()):
            if target not in found:
                found.add(target)
                waiting.append(target)
    return frozenset(found)


def _awaited(agsg: Agsg, follows: frozenset[str]) -> frozenset[str]:
    """Return some nodes with those that their events wait for: these are seated to bring them."""
    events = {event.id for event in agsg.spec.events} & follows
    return follows | {edge.source for edge in agsg.edges if edge.target in events}


def _place(grounded: GroundedScenario) -> tuple[str, float]:
    return grounded.anchor_lane, grounded.anchor_position_m
