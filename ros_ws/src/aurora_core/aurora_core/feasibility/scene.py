# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Refuse scenes that the prompt's own count closes to what it names."""

from __future__ import annotations

from collections.abc import Iterator

from aurora_core.feasibility.certificates import contradiction
from aurora_core.feasibility.facts import says
from aurora_core.outcomes.feasibility import Certificate, Fact, Rule
from aurora_core.spec.parameter import Bound, Span
from aurora_core.spec.requirements import UAV_TYPE, SceneCount, types_counted
from aurora_core.spec.scenario import ScenarioSpec
from aurora_core.spec.stated import is_stated

# Kinds that the vehicles of a traffic density are of, whatever they are.
_TRAFFIC = frozenset({'vehicle', 'body'})


def check_scene(spec: ScenarioSpec, *, own: bool = False) -> Iterator[Certificate]:
    """Return counts that leave out what the prompt names, or the traffic that it asks for.

    Args:
        spec: The request.
        own: What the words of the count brought in are bodies beside those named elsewhere. That
            may well be, and proves nothing.
    """
    for count in spec.counts:
        number = count.value
        if not is_stated(number) or number.bound is Bound.AT_LEAST:
            continue
        named = _named(spec, count, own=own)
        density = spec.world.traffic_density
        # However thin, a traffic has a vehicle.
        more = density is not None and count.kind in _TRAFFIC
        if len(named) + more <= number.value:
            continue
        what = f'{len(named)} are named' if named else 'none is named'
        traffic = ', and the traffic has more' if more else ''
        yield contradiction(
            Rule.SCENE,
            'count',
            f'counts/{count.id}',
            f'the scene has {number.value:g} of the kind {count.kind}; {what}{traffic}.',
            count.span or number.span,
            (
                *says(f'counts/{count.id}/kind', count.kind),
                *says(f'counts/{count.id}/value', number),
                *named,
                *(says('world/traffic_density', density.value) if more and density else ()),
            ),
        )


def _named(spec: ScenarioSpec, count: SceneCount, *, own: bool) -> tuple[Fact, ...]:
    """Return the bodies of the scene that a count is about.

    "Exactly 3 vehicles": what these words themselves brought in may be what is named elsewhere.
    """
    kinds, told = types_counted(count.kind), count.value.span
    taken_up = _taken_up(spec, told) if own else frozenset()
    agents = (f for a in spec.agents if a.type.value in kinds
              and (a.id in taken_up or not _within(a.span, told))
              for f in says(f'agents/{a.id}/type', a.type.value))  # fmt: skip
    uavs = (f for u in spec.uavs if UAV_TYPE in kinds and not _within(u.span, told)
            for f in says(f'uavs/{u.id}/id', u.id))  # fmt: skip
    return (*agents, *uavs)


def _taken_up(spec: ScenarioSpec, told: Span | None) -> frozenset[str]:
    """Return who does something, or is told of by others, in words outside of these."""
    found = {m.target for m in spec.missions}
    for agent in spec.agents:
        for place in (p for p in agent.placements if not _within(p.span, told)):
            found |= {agent.id, place.of}
        for deed in (b for b in agent.behaviors if not _within(b.span, told)):
            found |= {agent.id, deed.target}
    return frozenset(name for name in found if name is not None)


def _within(span: Span | None, other: Span | None) -> bool:
    if span is None or other is None:
        return False
    return span.start < other.end and other.start < span.end
