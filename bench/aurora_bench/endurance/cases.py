# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Runs of different kinds, repeated in turn: what is the same must come out the same."""

from __future__ import annotations

from aurora_core.pipeline.stages import RunRequest

_VAN = (
    'A van tailgates the ego car closely, closing from 45 meters; a tracking drone alerts the ego '
    'when the van comes within 20 meters.'
)
_BUS = (
    'A bus drives ahead of the ego car and an ambulance follows behind it while two background '
    'cars circulate; a drone tracks the bus from 35 meters.'
)
_REQUESTS: tuple[dict[str, object], ...] = (
    {
        'prompt': 'In clear weather at midday, a drone flies a rectangular survey route at 30 '
        'meters altitude over the streets around the ego car.'
    },
    {
        'prompt': 'A drone ascends to 40 meters and then follows a motorcycle as it drives '
        'through the streets.'
    },
    {'prompt': _BUS},
    {'prompt': _VAN},
    {
        'prompt': 'In heavy rain and strong wind, a drone hovers over the intersection at 30 '
        'meters for 20 seconds.'
    },
    {
        'prompt': 'Two drones: one drone hovers over the intersection at 40 meters and another '
        'drone follows a truck at 30 meters altitude.'
    },
    {
        'prompt': _BUS,
        'faults': ({'kind': 'target_removed', 'subject': 'bus1', 'at_s': 20.0},),
    },
    {
        'prompt': _VAN,
        'seed': 2,
        'faults': ({'kind': 'link_loss', 'subject': '*', 'at_s': 0.0},),
    },
    # No run of the simulators: refused, and not understood.
    {'prompt': 'A drone hovers over the intersection at 500 ft.'},
    {'prompt': 'Boil the potatoes for twenty minutes.'},
)


def cases() -> tuple[RunRequest, ...]:
    """Return the requests, in the order in which they are repeated."""
    return tuple(RunRequest.model_validate(request) for request in _REQUESTS)
