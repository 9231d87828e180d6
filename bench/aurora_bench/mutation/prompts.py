# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What is recorded: missions, relations, events and links of every kind."""

from __future__ import annotations

from aurora_system_tests.planted_bugs import PROMPTS

# These end verified: a change that breaks something must show.
SOUND = {
    **PROMPTS,
    'survey': (
        'In clear weather at midday, a drone flies a rectangular survey route at 30 meters '
        'altitude over the streets around the ego car.'
    ),
    'motorcycle': (
        'A drone ascends to 40 meters and then follows a motorcycle as it drives through the '
        'streets.'
    ),
    'truck': (
        'A truck tailgates the ego car closely, closing from 50 meters; a tracking drone alerts '
        'the ego when the truck comes within 25 meters.'
    ),
    'sight': 'A drone tracks the bus from 40 meters and alerts the ego car when it sees the bus.',
    'brake': (
        'A truck drives 30 meters ahead of the ego car and brakes after 20 seconds; a drone '
        'tracks the truck at 40 meters.'
    ),
    'two trackers': 'Two drones track the ego car at 40 meters.',
    'parked': (
        'A van is parked 20 meters behind the ego car; a drone hovers over the van at 30 meters '
        'for 10 seconds.'
    ),
    'ahead': (
        'A taxi drives 30 meters ahead of the ego car; a drone tracks the taxi from 40 meters for '
        '40 seconds.'
    ),
    'stop': 'A drone tracks the ego car at 35 meters; after 25 seconds the ego car stops.',
}

# These end violated, for reasons of their own: only for changes that do no harm.
FAILING = {
    'occluded': (
        'A drone follows a bus at 40 meters and reports to the ego car when it loses sight of the '
        'bus.'
    ),
    'far behind': (
        'A van follows the ego car 45 m behind it. The van stays within 30 m of the ego car.'
    ),
}
