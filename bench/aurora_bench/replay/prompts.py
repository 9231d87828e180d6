# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The prompts: missions, targets, weather, events, messages, and runs that fail."""

from __future__ import annotations

import json
from dataclasses import dataclass, field
from typing import Any


@dataclass(frozen=True, slots=True, kw_only=True)
class Case:
    """One run.

    Attributes:
        prompt: As typed.
        options: Beside it (seed, faults).
    """

    prompt: str
    options: dict[str, Any] = field(default_factory=dict)

    @property
    def options_json(self) -> str:
        """As the service takes them."""
        return json.dumps(self.options)


_FOLLOW = 'A drone ascends to {} meters and then follows a {} as it drives through the streets.'
_SURVEY = (
    '{}, a drone flies a rectangular survey route at {} meters altitude over the streets around '
    'the ego car.'
)
_TAILGATE = (
    'A {} tailgates the ego car closely, closing from {} meters; a tracking drone alerts the ego '
    'when the {} comes within {} meters.'
)
_CONVOY = (
    'A bus drives ahead of the ego car and an ambulance follows behind it while two background '
    'cars circulate; a drone tracks the bus from {} meters.'
)
_CROSSING = 'A pedestrian crosses in front of the ego car while a drone hovers at {} meters.'


def _fault(kind: str, subject: str, at_s: float) -> dict[str, Any]:
    return {'faults': [{'kind': kind, 'subject': subject, 'at_s': at_s}]}


CASES = (
    Case(prompt=_FOLLOW.format(40, 'motorcycle')),
    Case(prompt=_SURVEY.format('In clear weather at midday', 30)),
    Case(prompt=_CONVOY.format(35)),
    Case(prompt=_TAILGATE.format('van', 45, 'van', 20)),
    Case(prompt='A drone hovers at 20 meters for 5 seconds.'),
    Case(
        prompt=_FOLLOW.format(40, 'motorcycle'),
        options=_fault('target_removed', 'motorcycle1', 20.0),
    ),
    Case(prompt=_TAILGATE.format('van', 45, 'van', 20), options=_fault('link_loss', '*', 0.0)),
    Case(prompt=_CROSSING.format(30)),
    Case(prompt='A drone circles the bus at 40 meters.'),
    Case(prompt='Two drones hover at 30 meters for 5 seconds.'),
    Case(prompt=_FOLLOW.format(35, 'bus')),
    Case(prompt=_SURVEY.format('In light rain at dusk', 40)),
    Case(prompt='A drone hovers over the intersection at 60 meters for 10 seconds.'),
    Case(prompt=_TAILGATE.format('truck', 50, 'truck', 25)),
    Case(prompt=_CONVOY.format(35), options=_fault('target_removed', 'bus1', 20.0)),
    Case(prompt=_FOLLOW.format(45, 'truck')),
    Case(prompt='A drone orbits the ego car at 50 meters.'),
    Case(prompt=_SURVEY.format('In clear weather at midday', 50)),
    Case(prompt=_TAILGATE.format('van', 45, 'van', 20), options=_fault('keep_away', 'van1', 0.0)),
    Case(prompt=_CROSSING.format(45)),
)


def cases(count: int) -> list[Case]:
    """Return as many runs as asked: each prompt with seed 1, then all with seed 2, and so on."""
    made = []
    for index in range(count):
        case = CASES[index % len(CASES)]
        seed = 1 + index // len(CASES)
        made.append(Case(prompt=case.prompt, options={**case.options, 'seed': seed}))
    return made
