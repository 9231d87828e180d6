# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Write into a grounding what repair made otherwise."""

from __future__ import annotations

from collections.abc import Iterator

from aurora_core.outcomes.grounded import GroundedScenario, RealisedValue
from aurora_core.outcomes.repair import RepairPlan


def repaired(grounded: GroundedScenario, plan: RepairPlan) -> GroundedScenario:
    """Return a grounding of an edited request with its plan, and what was requested at first.

    Args:
        grounded: Of the request with the values of the plan in it.
        plan: The plan.
    """
    return grounded.model_copy(update={'realised': tuple(_rows(grounded, plan)), 'repair': plan})


def _rows(grounded: GroundedScenario, plan: RepairPlan) -> Iterator[RealisedValue]:
    edits = {edit.path: edit for edit in plan.values}
    for row in grounded.realised:
        edit = edits.pop(row.path, None)
        yield row if edit is None else row.model_copy(update={'requested': edit.requested})
    for edit in edits.values():
        yield RealisedValue(**edit.model_dump())
