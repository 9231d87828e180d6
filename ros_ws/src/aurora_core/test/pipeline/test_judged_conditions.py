# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Which conditions a grounded request is judged by, and what of it is left as incomplete."""

from __future__ import annotations

from aurora_core.agsg.build import build_agsg
from aurora_core.judging.codec import conditions_from_json
from aurora_core.pipeline.functions import ground_stage, parse_stage
from aurora_core.pipeline.knowledge import installed_knowledge

_KNOWN = installed_knowledge()


def _grounded(prompt: str) -> tuple[set[str], tuple[str, ...]]:
    """Return the ids of the conditions, and what is missing."""
    spec = parse_stage(_KNOWN, prompt, 'downtown', 1).spec
    assert spec is not None
    digest = _KNOWN.map('downtown').digest
    outcome = ground_stage(_KNOWN, build_agsg(spec, map_digest=digest), 1)
    assert outcome.agsg is not None
    return {c.id for c in conditions_from_json(outcome.agsg.texts.conditions)}, outcome.unsupported


def test_a_manoeuvre_that_nobody_carries_out_is_incomplete_and_not_judged() -> None:
    conditions, missing = _grounded('A bicycle changes lane; a drone tracks it.')
    assert missing == ('bicycle1: behaviour change_lane',)
    assert 'bicycle1.change_lane' not in conditions
    assert 'm1.tracked' in conditions


def test_a_driving_speed_and_a_deadline_of_an_alert_are_judged() -> None:
    conditions, missing = _grounded(
        'A van drives at 8 m/s. A tracking drone alerts the ego car when the van comes within '
        '20 m. The alert must arrive within 1 s.'
    )
    assert missing == ()
    assert {'van1.drive.speed', 'c1.holds'} <= conditions


def test_the_distances_of_three_drones_are_judged() -> None:
    conditions, missing = _grounded(
        'Three drones hover over City Hall at 50 m. The drones stay at least 15 m apart.'
    )
    assert missing == ()
    assert 'c1.holds' in conditions
