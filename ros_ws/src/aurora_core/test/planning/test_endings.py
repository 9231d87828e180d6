# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Who returns home and lands does not land before it returns."""

from __future__ import annotations

from aurora_core.outcomes.parse import ParseContext
from aurora_core.parsing.parser import parse_offline
from aurora_core.planning.endings import landing
from aurora_core.spec.scenario import ScenarioSpec


def _waits(prompt: str) -> list[tuple[str, float]]:
    spec = parse_offline(prompt, ParseContext()).spec
    assert spec is not None
    ended: ScenarioSpec = landing(spec)
    return [(getattr(e.action, 'do', ''), e.waits_s) for e in ended.events if e.action]


def test_a_landing_waits_as_long_as_the_return_that_it_belongs_to() -> None:
    told = '15 s after the van stops the drone returns home and lands.'
    assert ('land', 15.0) in _waits(f'A drone tracks the van; {told}')


def test_a_landing_alone_keeps_its_moment() -> None:
    assert _waits('A drone tracks the van. 15 s after the van stops the drone lands.')[-1] == (
        'land',
        15.0,
    )
    assert _waits('A drone tracks the van. When the van stops the drone lands.')[-1] == (
        'land',
        0.0,
    )
