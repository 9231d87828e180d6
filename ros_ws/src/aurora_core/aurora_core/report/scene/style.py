# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Colours and sizes of the picture, in one place."""

from __future__ import annotations

from typing import Any

from aurora_core.report.scene.story import Tone
from aurora_core.report.scene.tracks import Track
from aurora_core.report.status import Status

PAPER = '#ffffff'
INK = '#1c2430'
FAINT = '#66707d'
GROUND = '#eeece5'
ROAD = '#ffffff'
ROAD_EDGE = '#d3cfc3'
CROSSING = '#8d939b'
BUILDING_LOW = '#d8d2c4'
BUILDING_HIGH = '#6d6a72'
BUILDING_EDGE = '#a39d8f'
NO_FLY = '#d0312d'
BACKGROUND_AGENT = '#98a0ab'
# Light enough that the ways of the ground agents show on top of it, darker with height.
ALTITUDE_STEPS = ('#ffe9a3', '#b5dfa5', '#6cc0c4', '#7d86dd')

# Told apart also by people who see few colours (Okabe and Ito's set, the yellow left out).
AGENT_COLOURS = ('#d55e00', '#0072b2', '#a3337f', '#00805f', '#8a5a00', '#4b55c4', '#b3123f')
# Lines of UAVs in the diagrams.
UAV_COLOURS = ('#2c3440', '#a3337f', '#8a5a00', '#4b55c4', '#00805f', '#b3123f')
EGO_COLOUR = '#0072b2'

TONE_COLOURS = {
    Tone.FLIGHT: '#2f6f4f',
    Tone.MOTION: '#5b6675',
    Tone.EVENT: '#7a3fa0',
    Tone.FAULT: '#b35900',
    Tone.FAILURE: '#c01f1f',
}

STATUS_COLOURS = {
    Status.VERIFIED: '#1b7f4b',
    Status.VERIFIED_AS_EDITED: '#1b7f4b',
    Status.INCOMPLETE: '#b7791f',
    Status.VIOLATED: '#c01f1f',
    Status.INCONCLUSIVE: '#b7791f',
    Status.INFEASIBLE: '#8a3ea8',
    Status.NOT_UNDERSTOOD: '#5b6675',
    Status.ERROR: '#7a1010',
    Status.CANCELLED: '#5b6675',
}

RC: dict[Any, Any] = {
    'font.family': 'DejaVu Sans',
    'font.size': 9.0,
    'axes.edgecolor': '#b9bec6',
    'axes.linewidth': 0.8,
    'axes.labelcolor': FAINT,
    'text.color': INK,
    'xtick.color': FAINT,
    'ytick.color': FAINT,
    'svg.fonttype': 'path',
    # Ids inside an SVG come from this text instead of a random number.
    'svg.hashsalt': 'aurora',
    'path.simplify': True,
    'text.parse_math': False,
}


def colours_of(tracks: tuple[Track, ...]) -> dict[str, str]:
    """Return a colour per body: the ego's is fixed, background traffic is grey."""
    colours: dict[str, str] = {}
    flown = {track.name for track in tracks if track.is_uav}
    free = [colour for colour in AGENT_COLOURS if colour != EGO_COLOUR]
    for track in tracks:
        if track.is_uav:
            index = sum(name in flown for name in colours)
            colours[track.name] = UAV_COLOURS[index % len(UAV_COLOURS)]
        elif track.is_background:
            colours[track.name] = BACKGROUND_AGENT
        elif track.entry.role == 'ego':
            colours[track.name] = EGO_COLOUR
        else:
            colours[track.name] = free[len(colours) % len(free)]
    return colours
