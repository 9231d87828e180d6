# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The kinds of faults, one a row: what is asked, what is drawn, and which of it is at fault."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

VEHICLES = ('car', 'van', 'bus', 'truck', 'motorcycle')
SMALL = ('car', 'van', 'motorcycle')
LARGE = ('bus', 'truck')
ALTITUDE, STANDOFF = 'missions/m1/altitude_m', 'missions/m1/standoff_m'
GAP, RADIUS = 'placements/0/distance_m', 'missions/m1/radius_m'
PACE = 'missions/m1/speed_mps'
LATENCY, LOSS = 'links/link1/latency_s', 'links/link1/loss'
PLACE = 'grounding/anchor'

Words = Mapping[str, tuple[str, ...] | tuple[int, int]]


@dataclass(frozen=True, slots=True, kw_only=True)
class Span:
    """Where a value is drawn from.

    Attributes:
        low: Lower end ...
        high: ... and upper one.
        of: Number of the prompt that both ends are shares of; '' where they are values.
        above: Number of the prompt that the lower end is above.
    """

    low: float
    high: float
    of: str = ''
    above: str = ''


@dataclass(frozen=True, slots=True, kw_only=True)
class Kind:
    """What is wrong with a request.

    Attributes:
        name: Of the kind.
        prompt: What is asked, with names of `words` in braces.
        words: Words to choose from, or the range of a whole number, by name.
        values: Open values that are drawn, by the end of their path.
        cause: Which of them is at fault; a place; or a word that states the fault.
        good: What stands there in the request that holds; None for a place.
        mends: Repair may mend it; False: what is at fault is locked.
    """

    name: str
    prompt: str
    words: Words = field(default_factory=dict)
    values: Mapping[str, Span] = field(default_factory=dict)
    cause: str
    good: Span | None = None
    mends: bool = True


_FAR = Span(low=120.0, high=195.0)
_CLOSE = Span(low=15.0, high=30.0)
_LOW_FLIGHT = Span(low=15.0, high=35.0)
_NEAR_GROUND = Span(low=15.0, high=30.0)
_OUT_OF_REACH = Span(low=15.0, high=118.0, above='reach')
_HALF = Span(low=0.45, high=0.55, of='reach')
_PAIR: Words = {'who': SMALL, 'whom': LARGE}
_ONE: Words = {'vehicle': VEHICLES}

KINDS: tuple[Kind, ...] = (
    Kind(
        name='start gap too large to follow',
        prompt='A {who} follows a {whom}.',
        words=_PAIR,
        values={GAP: _FAR},
        cause=GAP,
        good=_CLOSE,
    ),
    Kind(
        name='start gap too large to follow, watched',
        prompt='A {who} follows a {whom} while a drone tracks the {whom}.',
        words=_PAIR,
        values={GAP: _FAR, ALTITUDE: Span(low=25.0, high=60.0)},
        cause=GAP,
        good=_CLOSE,
    ),
    Kind(
        name='standoff out of reach of a trigger',
        prompt=(
            'A drone tracks a {vehicle}. When the drone comes within {reach} meters of the '
            '{vehicle}, the drone alerts the ego car.'
        ),
        words={**_ONE, 'reach': (35, 55)},
        values={STANDOFF: Span(low=20.0, high=120.0, above='reach'), ALTITUDE: _NEAR_GROUND},
        cause=STANDOFF,
        good=Span(low=0.1, high=0.3, of='reach'),
    ),
    Kind(
        name='flight too slow for its time',
        prompt='A drone flies a rectangle and lands within {seconds} seconds.',
        words={'seconds': (120, 150)},
        values={PACE: Span(low=1.0, high=1.6), ALTITUDE: Span(low=25.0, high=60.0)},
        cause=PACE,
        good=Span(low=7.0, high=10.0),
    ),
    Kind(
        name='altitude out of reach of a trigger',
        prompt=(
            'A {vehicle} approaches an intersection. A drone hovers over the intersection. When '
            'the {vehicle} comes within {reach} meters of the drone, the {vehicle} brakes.'
        ),
        words={**_ONE, 'reach': (35, 55)},
        values={ALTITUDE: _OUT_OF_REACH},
        cause=ALTITUDE,
        good=_HALF,
    ),
    Kind(
        name='altitude among the vehicles',
        prompt='A drone tracks a {whom}.',
        words={'whom': LARGE},
        values={ALTITUDE: Span(low=3.0, high=3.9), STANDOFF: Span(low=0.0, high=2.0)},
        cause=ALTITUDE,
        good=Span(low=20.0, high=50.0),
    ),
    Kind(
        name='hover above the distance it has to keep',
        prompt='A drone hovers near a {whom} and stays within {reach} meters of it.',
        words={'whom': LARGE, 'reach': (40, 60)},
        values={ALTITUDE: Span(low=10.0, high=115.0, above='reach')},
        cause=ALTITUDE,
        good=_HALF,
    ),
    Kind(
        name='standoff beyond the distance it has to keep',
        prompt='A drone tracks a {vehicle} and stays within {reach} meters of it.',
        words={**_ONE, 'reach': (40, 60)},
        values={STANDOFF: Span(low=25.0, high=145.0, above='reach'), ALTITUDE: _LOW_FLIGHT},
        cause=STANDOFF,
        good=Span(low=0.2, high=0.4, of='reach'),
    ),
    Kind(
        name='altitude that loses sight',
        prompt=(
            'In fog, a drone hovers over an intersection and sees a {vehicle} for {seconds} '
            'seconds.'
        ),
        words={**_ONE, 'seconds': (3, 6)},
        values={ALTITUDE: Span(low=82.0, high=119.0)},
        cause=ALTITUDE,
        good=Span(low=20.0, high=40.0),
    ),
    Kind(
        name='standoff that loses sight',
        prompt='In fog, a drone tracks a {vehicle}.',
        words=_ONE,
        values={STANDOFF: Span(low=85.0, high=140.0), ALTITUDE: _LOW_FLIGHT},
        cause=STANDOFF,
        good=Span(low=0.0, high=20.0),
    ),
    Kind(
        name='orbit too wide for its time',
        prompt='A drone orbits the City Hall.',
        values={RADIUS: Span(low=125.0, high=149.0), ALTITUDE: Span(low=40.0, high=80.0)},
        cause=RADIUS,
        good=Span(low=25.0, high=45.0),
    ),
    Kind(
        name='route through a tower',
        prompt='A drone orbits the Signal Tower.',
        values={RADIUS: Span(low=5.0, high=10.0), ALTITUDE: Span(low=40.0, high=80.0)},
        cause=RADIUS,
        good=Span(low=40.0, high=50.0),
    ),
    Kind(
        name='street that hides what is tracked',
        prompt='A drone tracks a {vehicle} at {alt} meters altitude, {away} meters behind it.',
        words={**_ONE, 'alt': (12, 20), 'away': (60, 90)},
        cause=PLACE,
    ),
    Kind(
        name='target too fast (locked)',
        prompt='A drone tracks a {whom} for 60 seconds. The {whom} drives at {pace} m/s.',
        words={'whom': ('car', 'motorcycle'), 'pace': (21, 28)},
        cause='pace',
        good=Span(low=6.0, high=9.0),
        mends=False,
    ),
    Kind(
        name='link too slow (locked)',
        prompt=(
            'A drone tracks a {vehicle} and alerts the ego car within 2 seconds when the '
            '{vehicle} brakes.'
        ),
        words=_ONE,
        values={LATENCY: Span(low=3.0, high=9.0), ALTITUDE: _LOW_FLIGHT},
        cause=LATENCY,
        good=Span(low=0.1, high=0.1),
        mends=False,
    ),
    Kind(
        name='link that loses all (locked)',
        prompt=(
            'A drone tracks a {vehicle} and alerts the ego car within 2 seconds when the '
            '{vehicle} brakes.'
        ),
        words=_ONE,
        values={LOSS: Span(low=1.0, high=1.0), ALTITUDE: _LOW_FLIGHT},
        cause=LOSS,
        good=Span(low=0.0, high=0.0),
        mends=False,
    ),
    Kind(
        name='wind too strong for the drift bound (locked)',
        prompt=(
            'In a wind of {wind} m/s, a drone hovers over an intersection for 30 seconds. '
            'Horizontal drift during the hover shall be less than 1 m.'
        ),
        words={'wind': (16, 22)},
        cause='wind',
        good=Span(low=1.0, high=2.0),
        mends=False,
    ),
)
