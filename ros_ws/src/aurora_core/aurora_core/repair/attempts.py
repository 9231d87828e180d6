# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What a verdict says of an attempt: which of several is the best is decided by it."""

from __future__ import annotations

from aurora_core.outcomes.grounded import GroundedScenario
from aurora_core.outcomes.repair import Anchor, Attempt, AttemptOutcome
from aurora_core.outcomes.verdict import Verdict, VerdictStatus
from aurora_core.repair.localize import violated

_OUTCOMES = {
    VerdictStatus.VERIFIED: AttemptOutcome.VERIFIED,
    VerdictStatus.VIOLATED: AttemptOutcome.VIOLATED,
    VerdictStatus.INCONCLUSIVE: AttemptOutcome.INCONCLUSIVE,
}


def anchor_of(grounded: GroundedScenario) -> Anchor:
    """Return where a scene was put."""
    return Anchor(lane=grounded.anchor_lane, position_m=grounded.anchor_position_m)


def judged_attempt(iteration: int, verdict: Verdict) -> Attempt:
    """Return what is remembered of a realisation by its verdict alone."""
    return Attempt(
        iteration=iteration,
        outcome=_OUTCOMES[verdict.status],
        margins={row.id: row.normalised for row in verdict.results},
        failed=tuple(row.id for row in violated(verdict)),
    )
