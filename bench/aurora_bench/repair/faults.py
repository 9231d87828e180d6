# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Requests in which one thing that nobody states is at fault, drawn from a seed.

The other open values are drawn as well, and the faulty one stands in the request as its default:
there is no good value to go back to. A fault of place pins the first realisation to a street that
was drawn. A fault of a link is locked: nothing may mend it.
"""

from __future__ import annotations

import random
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

from aurora_core.document import Document
from aurora_core.outcomes.repair import ValueEdit, with_values
from aurora_core.pipeline.functions import parse_stage
from aurora_core.pipeline.knowledge import Knowledge
from aurora_core.spec.scenario import ScenarioSpec

_VEHICLES = ('car', 'van', 'bus', 'truck', 'motorcycle')
_FOLLOWERS = ('car', 'van', 'motorcycle')
_LEADERS = ('bus', 'truck')
ALTITUDE, STANDOFF = 'missions/m1/altitude_m', 'missions/m1/standoff_m'
GAP, RADIUS = 'placements/0/distance_m', 'missions/m1/radius_m'
LATENCY, LOSS = 'links/link1/latency_s', 'links/link1/loss'
PLACE = 'grounding/anchor'


class Fault(Document):
    """A request with a fault.

    Attributes:
        kind: What is wrong with it.
        prompt: What is asked.
        values: Open values, by the end of their path.
        cause: Which of them is at fault, by the end of its path, or the place.
        good: A value in its place with which the request is to hold; 0 for a place.
        places: Numbers that streets are drawn with, one after the other, until one shows a fault.
        mends: Repair may mend it; False: the lock stands in the way.
        seed: Of the run.
    """

    key: str
    kind: str
    prompt: str
    values: Mapping[str, float]
    cause: str
    good: float
    places: tuple[float, ...] = ()
    mends: bool = True
    seed: int


@dataclass(frozen=True, slots=True)
class _Drawn:
    prompt: str
    values: dict[str, float]
    cause: str
    good: float
    places: tuple[float, ...] = ()
    mends: bool = True


def _follow_from_afar(draw: random.Random) -> _Drawn:
    prompt = f'A {draw.choice(_FOLLOWERS)} follows a {draw.choice(_LEADERS)}.'
    return _Drawn(prompt, {GAP: draw.uniform(120.0, 195.0)}, GAP, draw.uniform(15.0, 30.0))


def _watched_follow_from_afar(draw: random.Random) -> _Drawn:
    who, whom = draw.choice(_FOLLOWERS), draw.choice(_LEADERS)
    prompt = f'A {who} follows a {whom} while a drone tracks the {whom}.'
    values = {GAP: draw.uniform(120.0, 195.0), ALTITUDE: draw.uniform(25.0, 60.0)}
    return _Drawn(prompt, values, GAP, draw.uniform(15.0, 30.0))


def _approach_out_of_reach(draw: random.Random) -> _Drawn:
    vehicle, reach_m = draw.choice(_VEHICLES), draw.randint(35, 55)
    prompt = (
        f'A {vehicle} approaches an intersection. A drone hovers over the intersection. When the '
        f'{vehicle} comes within {reach_m} meters of the drone, the {vehicle} brakes.'
    )
    values = {ALTITUDE: draw.uniform(reach_m + 15.0, 118.0)}
    return _Drawn(prompt, values, ALTITUDE, 0.5 * reach_m)


def _alert_out_of_reach(draw: random.Random) -> _Drawn:
    vehicle, reach_m = draw.choice(_VEHICLES), draw.randint(40, 60)
    prompt = (
        f'A drone hovers over an intersection and alerts the ego car when a {vehicle} comes '
        f'within {reach_m} meters of the drone.'
    )
    values = {ALTITUDE: draw.uniform(reach_m + 20.0, 118.0)}
    return _Drawn(prompt, values, ALTITUDE, 0.5 * reach_m)


def _patrol_out_of_reach(draw: random.Random) -> _Drawn:
    vehicle, reach_m = draw.choice(_VEHICLES), draw.randint(40, 60)
    prompt = (
        f'A drone patrols a street and alerts the ego car when a {vehicle} comes within '
        f'{reach_m} meters of the drone.'
    )
    values = {ALTITUDE: draw.uniform(reach_m + 20.0, 118.0)}
    return _Drawn(prompt, values, ALTITUDE, 0.6 * reach_m)


def _among_the_vehicles(draw: random.Random) -> _Drawn:
    values = {ALTITUDE: draw.uniform(3.0, 3.9), STANDOFF: draw.uniform(0.0, 2.0)}
    prompt = f'A drone tracks a {draw.choice(_LEADERS)}.'
    return _Drawn(prompt, values, ALTITUDE, draw.uniform(20.0, 50.0))


def _hover_above_its_bound(draw: random.Random) -> _Drawn:
    within_m = draw.randint(40, 60)
    vehicle = draw.choice(_LEADERS)
    prompt = f'A drone hovers near a {vehicle} and stays within {within_m} meters of it.'
    values = {ALTITUDE: draw.uniform(within_m + 10.0, 115.0)}
    return _Drawn(prompt, values, ALTITUDE, 0.5 * within_m)


def _too_high_to_see(draw: random.Random) -> _Drawn:
    seconds = draw.randint(3, 6)
    prompt = (
        f'A drone hovers over an intersection and sees a {draw.choice(_VEHICLES)} for '
        f'{seconds} seconds.'
    )
    return _Drawn(prompt, {ALTITUDE: draw.uniform(112.0, 119.0)}, ALTITUDE, draw.uniform(20, 40))


def _orbit_too_wide(draw: random.Random) -> _Drawn:
    values = {RADIUS: draw.uniform(110.0, 148.0), ALTITUDE: draw.uniform(40.0, 80.0)}
    return _Drawn('A drone orbits the City Hall.', values, RADIUS, draw.uniform(25.0, 45.0))


def _places(draw: random.Random) -> tuple[float, ...]:
    return tuple(draw.random() for _ in range(2))


def _pair_split(draw: random.Random) -> _Drawn:
    who, whom = draw.choice(_FOLLOWERS), draw.choice(_LEADERS)
    prompt = f'A {who} follows a {whom} for 30 seconds.'
    return _Drawn(prompt, {GAP: draw.uniform(15.0, 40.0)}, PLACE, 0.0, _places(draw))


def _no_turn_there(draw: random.Random) -> _Drawn:
    side = draw.choice(('left', 'right'))
    prompt = f'A {draw.choice(_VEHICLES)} turns {side} at an intersection while a drone watches.'
    return _Drawn(prompt, {ALTITUDE: draw.uniform(20.0, 90.0)}, PLACE, 0.0, _places(draw))


def _road_too_fast(draw: random.Random) -> _Drawn:
    prompt = f'A drone tracks a {draw.choice(_VEHICLES)} for 40 seconds.'
    values = {ALTITUDE: draw.uniform(20.0, 90.0), STANDOFF: draw.uniform(10.0, 60.0)}
    return _Drawn(prompt, values, PLACE, 0.0, _places(draw))


def _message(draw: random.Random) -> str:
    vehicle = draw.choice(_VEHICLES)
    return (
        f'A drone tracks a {vehicle} and alerts the ego car within 2 seconds when the {vehicle} '
        'brakes.'
    )


def _link_too_slow(draw: random.Random) -> _Drawn:
    values = {LATENCY: draw.uniform(3.0, 9.0), ALTITUDE: draw.uniform(15.0, 35.0)}
    return _Drawn(_message(draw), values, LATENCY, 0.1, mends=False)


def _link_that_loses_all(draw: random.Random) -> _Drawn:
    values = {LOSS: 1.0, ALTITUDE: draw.uniform(15.0, 35.0)}
    return _Drawn(_message(draw), values, LOSS, 0.0, mends=False)


KINDS: Mapping[str, Callable[[random.Random], _Drawn]] = {
    'start gap too large to follow': _follow_from_afar,
    'start gap too large to follow, watched': _watched_follow_from_afar,
    'altitude out of reach of a trigger': _approach_out_of_reach,
    'reporter out of reach of its trigger': _alert_out_of_reach,
    'patrol out of reach of its trigger': _patrol_out_of_reach,
    'altitude among the vehicles': _among_the_vehicles,
    'hover above the distance it has to keep': _hover_above_its_bound,
    'altitude that loses sight': _too_high_to_see,
    'orbit too wide for its time': _orbit_too_wide,
    'street whose signals split a pair': _pair_split,
    'street without the turn': _no_turn_there,
    'street that leaves the tracker behind': _road_too_fast,
    'link too slow (locked)': _link_too_slow,
    'link that loses all (locked)': _link_that_loses_all,
}


def faults(number: int, seed: int) -> tuple[Fault, ...]:
    """Return faults of all kinds in turn, the same ones for a seed."""
    found = []
    for k in range(number):
        kind = tuple(KINDS)[k % len(KINDS)]
        draw = random.Random(f'{seed}:{k}')
        drawn = KINDS[kind](draw)
        values = {path: round(value, 2) for path, value in drawn.values.items()}
        found.append(
            Fault(
                key=f'{kind} {k}',
                kind=kind,
                prompt=drawn.prompt,
                values=values,
                cause=drawn.cause,
                good=round(drawn.good, 2),
                places=drawn.places,
                mends=drawn.mends,
                seed=draw.randint(1, 99),
            )
        )
    return tuple(found)


def with_fault(
    known: Knowledge, fault: Fault, map_name: str, *, good: bool = False
) -> tuple[ScenarioSpec, str]:
    """Return the request with its fault as if the faulty values were what is usual.

    Args:
        known: What is installed here.
        fault: The fault.
        map_name: Map of the run.
        good: With the good value in the place of the faulty one.

    Returns:
        The request and the whole path of the cause.

    Raises:
        LookupError: The prompt is not read, or has no such values.
    """
    graph = parse_stage(known, fault.prompt, map_name, fault.seed).agsg
    if graph is None:
        raise LookupError(f'{fault.prompt!r} is not read')
    rows = {row.path: row for row in graph.parameters}
    paths: dict[str, Any] = {
        end: next((path for path in rows if path.endswith(end)), None) for end in fault.values
    }
    if None in paths.values():
        raise LookupError(f'{fault.prompt!r} lacks one of {", ".join(fault.values)}')
    values = {**fault.values}
    if good and fault.cause in values:
        values[fault.cause] = fault.good
    edits = tuple(
        ValueEdit(
            path=paths[end],
            requested=rows[paths[end]].requested,
            realised=value,
            provenance=rows[paths[end]].provenance,
        )
        for end, value in values.items()
    )
    changed = with_values(graph.spec, edits).model_copy(update={'reader': ''})
    return changed, str(paths.get(fault.cause, fault.cause))
