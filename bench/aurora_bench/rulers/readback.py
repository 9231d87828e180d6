# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Where bodies stand in the recording, compared with where grounding put them."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from math import hypot
from pathlib import Path

from pydantic import FiniteFloat

from aurora_core.document import Document
from aurora_core.outcomes.grounded import GroundedAgent, GroundedScenario
from aurora_core.trace.bag_reader import read_bag
from aurora_core.trace.definitions import message_definitions

# How far off a body may be at t = 0, by the way it moves (m).
VEHICLES_M = 0.1
PERSONS_M = 0.5


class ReadBack(Document):
    """How far bodies of one run are from their places at t = 0.

    Attributes:
        vehicles, persons: How many.
        vehicles_m, persons_m: The farthest of them, metres.
        off: Those that are farther than they may be, as `id: metres`.
    """

    vehicles: int = 0
    persons: int = 0
    vehicles_m: FiniteFloat = 0.0
    persons_m: FiniteFloat = 0.0
    off: tuple[str, ...] = ()


def distances(bag: Path, grounded: GroundedScenario) -> Iterator[tuple[GroundedAgent, float]]:
    """Yield how far (m) each agent of a grounding is from its place in the first state."""
    trace = read_bag(bag, message_definitions()).trace
    rows = {agent.body_id: row for row, agent in enumerate(trace.roster.agents)}
    for agent in grounded.agents:
        if agent.id in rows:
            state = trace.ground[0, rows[agent.id]]
            yield agent, hypot(float(state[0]) - agent.x_m, float(state[1]) - agent.y_m)


def read_back(bag: Path, grounded: GroundedScenario) -> ReadBack:
    """Compare the first recorded states of a run with its grounding."""
    off, worst, count = [], [0.0, 0.0], [0, 0]
    for agent, apart_m in distances(bag, grounded):
        kind = int(agent.is_person)
        count[kind] += 1
        worst[kind] = max(worst[kind], apart_m)
        if apart_m > (PERSONS_M if agent.is_person else VEHICLES_M):
            off.append(f'{agent.id}: {apart_m:.2f} m')
    return ReadBack(
        vehicles=count[0],
        persons=count[1],
        vehicles_m=worst[0],
        persons_m=worst[1],
        off=tuple(off),
    )


def read_back_line(found: Sequence[ReadBack]) -> str:
    """Return in words how far bodies of many runs were from their places."""
    vehicles, persons = sum(one.vehicles for one in found), sum(one.persons for one in found)
    return (
        f'placed at t = 0: {vehicles} vehicles within '
        f'{max((one.vehicles_m for one in found), default=0.0):.3f} m '
        f'(asked {VEHICLES_M:g}), {persons} persons within '
        f'{max((one.persons_m for one in found), default=0.0):.3f} m (asked {PERSONS_M:g}); '
        f'{sum(len(one.off) for one in found)} off'
    )
