# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The clock of an autopilot that kept its own time in a run, as the recording carries it."""

from __future__ import annotations

import json
from collections.abc import Iterable, Mapping
from typing import Annotated

from pydantic import Field, FiniteFloat, TypeAdapter, ValidationError

from aurora_core.document import Document

# Name of the record in the bag; the last one counts.
AIR_CLOCKS = 'aurora/air_clocks'
_KEY = 'clocks'
_LIMIT_BYTES = 1 << 16

_NonNegative = Annotated[FiniteFloat, Field(ge=0.0)]


class AirClock(Document):
    """What was known of the clock of a UAV's autopilot at the end of its run.

    Attributes:
        uav_id: Of the UAV.
        offset_s: The clock's time less that of this machine.
        drift_ppm: By how many millionths it ran faster.
        drift_sigma_ppm: Standard deviation of that.
        uncertainty_s: Most that the time of a recorded state of the UAV was wrong by: two standard
            deviations of the offset, half the shortest round trip, rounding of the stamps.
        round_trips: TIMESYNC questions that were answered.
        shortest_s: The shortest round trip.
        longest_s: The longest one.
        steps: How often the clock was found set or stopped.
        latest_s: Most that the states of a tick were complete after its time.
    """

    uav_id: str
    offset_s: FiniteFloat
    drift_ppm: FiniteFloat
    drift_sigma_ppm: _NonNegative
    uncertainty_s: _NonNegative
    round_trips: int
    shortest_s: _NonNegative
    longest_s: _NonNegative
    steps: int = 0
    latest_s: _NonNegative = 0.0

    def sentence(self) -> str:
        """Return it in words."""
        drift = f'{self.drift_ppm:+.0f} ± {2.0 * self.drift_sigma_ppm:.0f} ppm'
        steps = f', set {self.steps} times on the way' if self.steps else ''
        return (
            f'clock of {self.uav_id}: {self.offset_s:+.4f} s from ours, drift {drift}, times '
            f'known to ±{1e3 * self.uncertainty_s:.1f} ms ({self.round_trips} round trips of '
            f'{1e3 * self.shortest_s:.1f} to {1e3 * self.longest_s:.1f} ms{steps}); states '
            f'complete at most {1e3 * self.latest_s:.0f} ms after their tick'
        )


def paced_lines(clocks: Iterable[AirClock]) -> tuple[str, ...]:
    """Return what a report says of a run with such clocks; () where there are none."""
    lines = tuple(clock.sentence() for clock in clocks)
    first = 'real time, autopilots with clocks of their own: no two such runs are bit-identical'
    return (first, *lines) if lines else ()


_CLOCKS = TypeAdapter(tuple[AirClock, ...])


def clocks_note(clocks: Iterable[AirClock]) -> dict[str, str]:
    """Return the record of a bag."""
    return {_KEY: json.dumps([clock.model_dump(mode='json') for clock in clocks])}


def read_clocks(note: Mapping[str, str]) -> tuple[AirClock, ...]:
    """Return the clocks of a record.

    Raises:
        ValueError: It is none that was written here.
    """
    text = note.get(_KEY, '')
    if len(text) > _LIMIT_BYTES:
        raise ValueError('longer than any')
    try:
        clocks = _CLOCKS.validate_json(text)
    except ValidationError as err:
        raise ValueError(str(err)) from err
    if not clocks:
        raise ValueError('no clock in it')
    return clocks
