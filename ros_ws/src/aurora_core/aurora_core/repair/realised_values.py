# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The values that a realisation was grounded with."""

from __future__ import annotations

from aurora_core.outcomes.agsg import Agsg, AgsgParameter


def here_of(row: AgsgParameter, agsg: Agsg) -> float:
    """Return the value of a parameter in a realisation, in its unit."""
    plan = None if agsg.grounding is None else agsg.grounding.repair
    edits = () if plan is None else plan.values
    return next((edit.realised for edit in edits if edit.path == row.path), row.requested)
