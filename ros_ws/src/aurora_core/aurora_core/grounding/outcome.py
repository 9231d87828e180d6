# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Outcome of grounding: a graph, or why no place was found ("not found" is not "proven no")."""

from __future__ import annotations

from aurora_core.agsg.graph import Agsg
from aurora_core.spec.parameter import Document


class GroundingFailure(Document):
    """Why nothing was found: the demand that failed most often, and where it was tried."""

    reason: str
    tried: int
    rejected_by: dict[str, int]


class GroundingOutcome(Document):
    """Exactly one of the two is set."""

    agsg: Agsg | None = None
    failure: GroundingFailure | None = None
    unsupported: tuple[str, ...] = ()
