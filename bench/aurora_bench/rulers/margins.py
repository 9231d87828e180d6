# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""By how much a run holds: the least of the margins that say so."""

from __future__ import annotations

import json
from collections.abc import Iterable

from aurora_core.report.run_report import ConditionReport
from aurora_core.spec.quantity import QuantityName

# Whole numbers, and what is so or not, where they are no share: met exactly or not at all.
_WHOLE = frozenset(
    {
        QuantityName.ATTEMPTS,
        QuantityName.COUNT,
        QuantityName.DELIVERED,
        QuantityName.DELIVERY_LATENCY,
        QuantityName.MESSAGE_TEXT,
        QuantityName.PRESENCE,
        QuantityName.WAYPOINTS_VISITED,
        QuantityName.WORLD_SETTING,
    }
)
# One phase follows at once on the other: its margin is a tick in every run.
_AT_ONCE = 'phase_order'


def least_margin(rows: Iterable[ConditionReport], conditions: str) -> tuple[float | None, str]:
    """Return the least normalised margin, and the id of its condition.

    A condition that holds and can do so in one way only has no margin of its own and is left out.

    Args:
        rows: Conditions with their margins.
        conditions: The same as JSON text, with what they measure.

    Returns:
        Both; None and '' where no condition has a margin.
    """
    bare = {row['id'] for row in json.loads(conditions) if _is_bare(row)}
    own = [
        (row.normalised, row.id)
        for row in rows
        if row.normalised is not None and not (row.satisfied and row.id in bare)
    ]
    return min(own, default=(None, ''))


def _is_bare(row: dict[str, object]) -> bool:
    arguments = row['arguments']
    assert isinstance(arguments, dict)
    counts = row['unit'] == '1' and row['quantity'] in _WHOLE
    return counts or arguments.get('kind') == _AT_ONCE
