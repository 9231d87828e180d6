# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Requests in which one value that nobody states is at fault, drawn from a seed.

The other open values are drawn as well, and the faulty one stands in the request as its default:
there is no good value to go back to.
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
GAP = 'placements/0/distance_m'


class Fault(Document):
    """A request with a fault.

    Attributes:
        kind: What is wrong with it.
        prompt: What is asked.
        values: Open values, by the end of their path.
        cause: Which of them is at fault, by the end of its path.
        good: A value in its place with which the request is to hold.
        seed: Of the run.
    """

    key: str
    kind: str
    prompt: str
    values: Mapping[str, float]
    cause: str
    good: float
    seed: int


@dataclass(frozen=True, slots=True)
class _Drawn:
    prompt: str
    values: dict[str, float]
    cause: str
    good: float


def _follow_from_afar(draw: random.Random) -> _Drawn:
    prompt = f'A {draw.choice(_FOLLOWERS)} follows a {draw.choice(_LEADERS)}.'
    return _Drawn(prompt, {GAP: draw.uniform(120.0, 195.0)}, GAP, draw.uniform(15.0, 30.0))


def _watched_follow_from_afar(draw: random.Random) -> _Drawn:
    who, whom = draw.choice(_FOLLOWERS), draw.choice(_LEADERS)
    prompt = f'A {who} follows a {whom} while a drone tracks the {whom}.'
    values = {GAP: draw.uniform(120.0, 195.0), ALTITUDE: draw.uniform(25.0, 60.0)}
    return _Drawn(prompt, values, GAP, draw.uniform(15.0, 30.0))


def _trigger(draw: random.Random, reach_m: int) -> str:
    vehicle = draw.choice(_VEHICLES)
    return (
        f'A drone tracks a {vehicle} and alerts the ego car when the {vehicle} comes within '
        f'{reach_m} meters of the drone.'
    )


def _too_high_for_its_trigger(draw: random.Random) -> _Drawn:
    reach_m = draw.randint(30, 60)
    values = {
        ALTITUDE: draw.uniform(reach_m + 15.0, 118.0),
        STANDOFF: draw.uniform(0.0, 0.4 * reach_m),
    }
    return _Drawn(_trigger(draw, reach_m), values, ALTITUDE, 0.7 * reach_m)


def _too_far_for_its_trigger(draw: random.Random) -> _Drawn:
    reach_m = draw.randint(40, 60)
    values = {
        ALTITUDE: draw.uniform(15.0, 0.6 * reach_m),
        STANDOFF: draw.uniform(reach_m + 15.0, 120.0),
    }
    return _Drawn(_trigger(draw, reach_m), values, STANDOFF, 0.5 * reach_m)


def _hover_out_of_reach(draw: random.Random) -> _Drawn:
    vehicle, reach_m = draw.choice(_VEHICLES), draw.randint(40, 60)
    prompt = (
        f'A drone alerts the ego car when a {vehicle} comes within {reach_m} meters of the drone.'
    )
    values = {ALTITUDE: draw.uniform(reach_m + 20.0, 118.0)}
    return _Drawn(prompt, values, ALTITUDE, 0.6 * reach_m)


KINDS: Mapping[str, Callable[[random.Random], _Drawn]] = {
    'start gap too large to follow': _follow_from_afar,
    'start gap too large to follow, watched': _watched_follow_from_afar,
    'altitude out of reach of a trigger': _too_high_for_its_trigger,
    'standoff out of reach of a trigger': _too_far_for_its_trigger,
    'reporter out of reach of its trigger': _hover_out_of_reach,
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
    spec = parse_stage(known, fault.prompt, map_name, fault.seed).spec
    graph = parse_stage(known, fault.prompt, map_name, fault.seed).agsg
    if spec is None or graph is None:
        raise LookupError(f'{fault.prompt!r} is not read')
    rows = {row.path: row for row in graph.parameters}
    paths: dict[str, Any] = {
        end: next((path for path in rows if path.endswith(end)), None) for end in fault.values
    }
    if None in paths.values():
        raise LookupError(f'{fault.prompt!r} lacks one of {", ".join(fault.values)}')
    values = {**fault.values, fault.cause: fault.good} if good else fault.values
    edits = tuple(
        ValueEdit(
            path=paths[end],
            requested=rows[paths[end]].requested,
            realised=value,
            provenance=rows[paths[end]].provenance,
        )
        for end, value in values.items()
    )
    changed = with_values(spec, edits).model_copy(update={'reader': ''})
    return changed, str(paths[fault.cause])
