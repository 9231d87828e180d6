# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Conditions in the shape in which they were recorded before are read for ever."""

from __future__ import annotations

import json
import lzma
from pathlib import Path
from typing import Any

import pytest

from aurora_core.errors import VerificationError
from aurora_core.judging.codec import conditions_from_json
from aurora_core.judging.registry import KINDS
from aurora_core.outcomes.condition import conditions_to_json

_FILE = Path(__file__).parent / 'recorded' / 'conditions.json.xz'
ROWS: list[dict[str, Any]] = json.loads(lzma.decompress(_FILE.read_bytes()))


def _read(row: dict[str, Any]) -> dict[str, Any]:
    (condition,) = conditions_from_json(json.dumps([row]))
    (again,) = json.loads(conditions_to_json((condition,)))
    return dict(again)


def _recorded(quantity: str, aspect: str) -> dict[str, Any]:
    rows = (row['recorded'] for row in ROWS)
    wanted = (quantity, aspect)
    found: dict[str, Any] = next(
        row for row in rows if (row['quantity'], row['arguments']['aspect']) == wanted
    )
    return found


# Kinds that there were not when the conditions were recorded.
SINCE = {
    'angle_swept', 'at_place', 'battery', 'braking_deceleration', 'came_nearer', 'clearance',
    'climb_after_phase', 'climb_delay', 'delivered_at', 'distance_fraction', 'done_delay',
    'driver_waits', 'event_climb_rate', 'gust_blown', 'gust_speed', 'hardest_braking',
    'lane_kept_after', 'longest_standstill', 'message_text', 'motion_time',
    'moving_before_action', 'never_delivered', 'never_sent', 'outage', 'phase_after_event',
    'report_gap', 'report_latency', 'return_distance', 'side_fraction', 'speed_once_there',
    'standing_time', 'time_headway', 'time_to_collision', 'traffic', 'undone', 'vertical_speed',
    'way_altitude', 'wind_blown', 'wind_course', 'wind_from', 'wind_speed',
}  # fmt: skip


def test_every_kind_was_recorded_before() -> None:
    assert {row['arguments']['kind'] for row in ROWS} == set(KINDS) - SINCE


@pytest.mark.parametrize('row', ROWS, ids=lambda row: str(row['recorded']['id']))
def test_what_was_recorded_is_read_with_the_arguments_of_its_quantity(row: dict[str, Any]) -> None:
    now = _read(row['recorded'])
    assert now == row['recorded'] | {'arguments': row['arguments']}
    assert _read(now) == now


def test_what_was_recorded_before_actions_were_judged_is_read_too() -> None:
    row = _recorded('event_delay', 'within')
    del row['arguments']['actions']
    assert 'actions' not in _read(row)['arguments']['event_tolerances']


@pytest.mark.parametrize(
    ('change', 'text'),
    [
        ({'aspect': 'sideways'}, "no aspect 'sideways'"),
        ({'wanted': 3.0}, 'turn left has no wanted'),
        ({'brake_mps2': 3.0}, 'turn left has no brake_mps2'),
        ({'surprise': 0.0}, 'turn left has no surprise'),
        ({'high': 'soon'}, 'within_s'),
        ({'kind': 'nothing'}, "'nothing': unknown"),
        ({'kind': 'crossing', 'horizon_s': 60.0}, 'crossing is not what it is about'),
    ],
)
def test_arguments_that_mean_nothing_are_refused(change: dict[str, Any], text: str) -> None:
    row = _recorded('turn', 'left')
    arguments = row['arguments'] | change
    if 'kind' in change:
        arguments = {'window': 'run', 'touchdown_m': 0.3, **change}
    with pytest.raises(VerificationError, match=text):
        _read(row | {'arguments': arguments})
