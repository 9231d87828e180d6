# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Places at which a body would stand as wrong as before, which shows before a co-simulation."""

from __future__ import annotations

from collections.abc import Iterator

from aurora_core.outcomes.agsg import Agsg, AgsgParameter
from aurora_core.outcomes.verdict import Verdict
from aurora_core.repair.localize import violated
from aurora_core.spec.parameter import Provenance
from aurora_core.spec.quantity import QuantityName

# Nearer to what is asked than before by less than this is no better (m).
_LEAST_M = 0.01


def still_displaced(before: Agsg, verdict: Verdict, after: Agsg) -> Iterator[str]:
    """Yield what a scene would have as wrong at t = 0 as the one that it is to mend.

    Args:
        before: The realisation that is to be mended.
        verdict: Of its trace.
        after: What came of an edit, grounded.
    """
    conditions = {condition.id: condition for condition in before.conditions}
    ours = {row.path: row for row in before.parameters}
    theirs = {row.path: row for row in after.parameters}
    for result in violated(verdict):
        condition = conditions.get(result.id)
        if condition is None or condition.quantity is not QuantityName.PLACEMENT:
            continue
        begin = f'agents/{condition.of[0]}/placements/'
        for path, row in ours.items():
            asked = path.startswith(begin) and row.requested == condition.threshold
            if not asked or row.provenance is not Provenance.EXPLICIT or path not in theirs:
                continue
            was_m, is_m = _off_m(row), _off_m(theirs[path])
            if was_m > (condition.tolerance or 0.0) and is_m > was_m - _LEAST_M:
                yield (
                    f'{result.id} would miss there as well: {path} would be '
                    f'{theirs[path].realised:.3g} instead of {row.requested:.3g}'
                )


def _off_m(row: AgsgParameter) -> float:
    return 0.0 if row.realised is None else abs(row.realised - row.requested)
