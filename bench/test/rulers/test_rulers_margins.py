# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The least margin of a run is that of a condition that could hold by more or by less."""

from __future__ import annotations

import json
from typing import Any

from aurora_bench.rulers.margins import least_margin
from aurora_core.report.run_report import ConditionReport
from aurora_core.spec.parameter import Provenance

COUNT = {'id': 'scene.uav', 'unit': '1', 'quantity': 'count', 'arguments': {'kind': 'count'}}
ORDER = {
    'id': 'm1.order', 'unit': 's', 'quantity': 'mission_completed',
    'arguments': {'kind': 'phase_order'},
}  # fmt: skip
SEEN = {
    'id': 'm1.visible', 'unit': '1', 'quantity': 'visible_fraction',
    'arguments': {'kind': 'visible_fraction'},
}  # fmt: skip


def row(condition: dict[str, Any], normalised: float | None) -> ConditionReport:
    return ConditionReport(
        id=condition['id'], sentence='', formula='', implied=True, op='>=', threshold=0.0,
        provenance=Provenance.INFERRED, unit=condition['unit'], margin=normalised,
        normalised=normalised, satisfied=normalised is not None and normalised >= 0.0,
        exercised=True,
    )  # fmt: skip


def test_exact_counts_and_what_follows_at_once_have_none_of_their_own() -> None:
    rows = [row(COUNT, 0.0), row(ORDER, 0.05), row(SEEN, 0.7)]
    assert least_margin(rows, json.dumps([COUNT, ORDER, SEEN])) == (0.7, 'm1.visible')
    assert least_margin(rows[:2], json.dumps([COUNT, ORDER])) == (None, '')


def test_a_count_that_does_not_hold_is_the_least() -> None:
    rows = [row(COUNT, -1.0), row(SEEN, 0.7)]
    assert least_margin(rows, json.dumps([COUNT, SEEN])) == (-1.0, 'scene.uav')
