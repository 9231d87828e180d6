# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""A run that goes on: the same signals as of a recorded one, worked out for what is new alone."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from aurora_core.errors import VerificationError
from aurora_core.knowledge.world import WorldModel
from aurora_core.quantities.view import RunView, Series
from aurora_core.trace.roster import Roster
from aurora_core.trace.trace import Trace


@dataclass(slots=True)
class _Grown:
    """A series so far, and what goes on with it."""

    compute: Callable[[RunView], Series]
    values: Series
    ticks: int


class GrowingView(RunView):
    """A run so far; `extend` adds ticks.

    Args:
        start: The run from its first tick on, at least one.
        world: Its world.
    """

    def __init__(self, start: Trace, world: WorldModel) -> None:
        super().__init__(_checked(start, start.roster), world)
        self._grown: dict[tuple[str, ...], _Grown] = {}

    def extend(self, more: Trace) -> None:
        """Add the ticks that follow, with the claims that came with them.

        Raises:
            VerificationError: They are of another roster, or states are missing in them.
        """
        so_far = self.trace
        more = _checked(more, so_far.roster)
        self.trace = replace(
            so_far,
            ground=np.concatenate((so_far.ground, more.ground)),
            uav=np.concatenate((so_far.uav, more.uav)),
            uav_commands=np.concatenate((so_far.uav_commands, more.uav_commands)),
            ground_commands=so_far.ground_commands + more.ground_commands,
            links=so_far.links + more.links,
            sights=so_far.sights + more.sights,
            events=so_far.events + more.events,
        )

    def series(
        self, key: tuple[str, ...], compute: Callable[[RunView], Series], *, before: int = 0
    ) -> Series:
        """Return series of the run so far; only what is new is computed."""
        grown = self._grown.get(key)
        if grown is None:
            grown = _Grown(compute, compute(self._part(0)), self.ticks)
            self._grown[key] = grown
        elif grown.ticks < self.ticks:
            overlap = min(before, grown.ticks)
            new = grown.compute(self._part(grown.ticks - overlap))
            grown.values = tuple(
                np.concatenate((old, more[overlap:]))
                for old, more in zip(grown.values, new, strict=True)
            )
            grown.ticks = self.ticks
        return grown.values

    def _part(self, start: int) -> RunView:
        return RunView(self.trace.states(start, self.ticks), self.world, self.geometry)


def _checked(part: Trace, roster: Roster) -> Trace:
    """Return a part of a run.

    Raises:
        VerificationError: It is of another run, has no tick, or states are missing in it.
    """
    if part.roster != roster:
        raise VerificationError('a run goes on with the roster that it began with')
    arrays = (part.ground, part.uav, part.uav_commands)
    if part.ticks == 0 or part.missing_ticks or not all(np.isfinite(a).all() for a in arrays):
        raise VerificationError(
            'a run that goes on needs every state of at least one tick',
            hint='hand over ticks once all of their states are there',
        )
    return part
