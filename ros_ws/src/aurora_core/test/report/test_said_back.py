# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The request said back: who does what to whom, every stated number, what was assumed."""

from __future__ import annotations

import pytest

from aurora_core.outcomes.parse import ParseContext
from aurora_core.parsing.coverage import parameters
from aurora_core.parsing.parser import parse_offline
from aurora_core.report.said_back import ElementReport, said_back
from aurora_core.spec.parameter import Provenance

CONTEXT = ParseContext(landmark_names=('City Hall', 'Harbor Market'))


def _said(prompt: str) -> dict[str, ElementReport]:
    spec = parse_offline(prompt, CONTEXT).spec
    assert spec is not None
    return {one.id: one for one in said_back(spec)}


@pytest.mark.parametrize(
    ('prompt', 'name', 'text', 'assumed'),
    [
        (
            'A van tailgates the ego car, closing from 45 meters.',
            'van1',
            'van1 is a van; at the start 45 m behind ego; tailgates ego, closing from 45 m',
            '',
        ),
        (
            'A drone hovers over City Hall for 20 s.',
            'm1',
            'uav1 hovers over City Hall, duration 20 s',
            'altitude 30 m',
        ),
        (
            'A drone tracks a van and alerts the ego car when the van comes within 20 m of it.',
            'e1',
            'when van1 comes within 20 m of ego (between their centres), uav1 sends a message to '
            'ego',
            '',
        ),
        (
            'A drone flies from Harbor Market to City Hall at 50 m.',
            'm1',
            'uav1 flies from Harbor Market to City Hall, altitude 50 m',
            'speed 8 m/s',
        ),
        ('At night in fog a car drives.', 'world', 'downtown: fog weather, night', ''),
        (
            'Two drones hover over City Hall at 40 m and 60 m and stay at least 15 m apart.',
            'c1',
            'separation of uav1 and uav2: at least 15 m, on mission from capture on',
            '',
        ),
        (
            'A truck stops at Harbor Market.',
            'truck1',
            'truck1 is a truck; stops at Harbor Market',
            '',
        ),
    ],
)
def test_an_element_is_a_sentence(prompt: str, name: str, text: str, assumed: str) -> None:
    said = _said(prompt)[name]
    assert (said.text, said.assumed) == (text, assumed)


@pytest.mark.parametrize(
    'prompt',
    [
        'A bus drives at 8 m/s; a drone tracks it at 40 m with a standoff of 25 m for 50 s.',
        'A drone flies a rectangle of 120 m by 80 m at 45 m with 7 m/s over Harbor Market.',
        'The link from the drone to the ego loses 20 % and takes 0.5 s; at 15 s the drone alerts '
        'the ego.',
        'A drone climbs to 60 m after 12 s; the distance of a van to the ego stays below 35 m.',
        'A drone orbits City Hall with a radius of 55 m, 3 times, in a wind of 6 m/s.',
        'At 25 s a car brakes. 4 s later the drone warns the ego.',
    ],
)
def test_no_stated_number_goes_unsaid(prompt: str) -> None:
    spec = parse_offline(prompt, CONTEXT).spec
    assert spec is not None
    said = ' '.join(one.text for one in said_back(spec))
    stated = [p for p in parameters(spec) if p.provenance is Provenance.EXPLICIT]
    assert stated
    for number in stated:
        assert f'{number.value:.6g}' in said
