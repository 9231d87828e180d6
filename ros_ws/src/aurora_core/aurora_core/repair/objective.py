# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What an edit costs: equation 5 of the paper."""

from __future__ import annotations

from collections.abc import Iterable

from aurora_core.outcomes.agsg import AgsgParameter
from aurora_core.repair.settings import RepairSettings


def objective(
    margins: Iterable[float],
    edits: Iterable[tuple[AgsgParameter, float]],
    settings: RepairSettings,
) -> float:
    """Return the hinge on the worst margin plus what the edits change of the request's values.

    Source: paper, eq. (5).

    Args:
        margins: Normalised, of all conditions, as expected.
        edits: Parameters and by how much each is moved from what is requested, in its unit.
        settings: epsilon*, lambda_sem and w.
    """
    hinge = max(0.0, settings.epsilon - min(margins, default=0.0))
    change = sum(
        settings.weights.of(row.provenance) * abs(shift) / (row.high - row.low)
        for row, shift in edits
    )
    return hinge + settings.lambda_sem * change
