# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`FeasibilityVerdict`: feasible, infeasible with a certificate, or unknown."""

from __future__ import annotations

from enum import StrEnum

from pydantic import FiniteFloat

from aurora_core.spec.parameter import Document, Span


class Feasibility(StrEnum):
    """`unknown` goes on to execution, flagged; `infeasible` needs a certificate."""

    FEASIBLE = 'feasible'
    INFEASIBLE = 'infeasible'
    UNKNOWN = 'unknown'


class Certificate(Document):
    """Proof of infeasibility that separate code can check again.

    Attributes:
        kind: limit_exceeded, missing_element, unsupported, contradiction or
            geometric_contradiction (a stated flight against the map).
        reason: `because` of the contract (altitude_limit, comm_range, ...).
        path: Element or parameter of the specification.
        requested: Stated value (SI), when the proof is about a number.
        limit_name: Name in limits.json.
        limit: Its value.
        nearest: Nearest feasible value.
        listing: Closed list that lacks the element (missing_element, unsupported).
    """

    kind: str
    reason: str
    path: str
    requested: FiniteFloat | None = None
    unit: str = ''
    limit_name: str = ''
    limit: FiniteFloat | None = None
    nearest: FiniteFloat | None = None
    word: str = ''
    listing: tuple[str, ...] = ()
    span: Span | None = None
    sentence: str


class FeasibilityVerdict(Document):
    """Outcome of the check."""

    result: Feasibility
    certificates: tuple[Certificate, ...] = ()
    notes: tuple[str, ...] = ()
