# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Outcome of grounding: a graph, or why no place was found ("not found" is not "proven no")."""

from __future__ import annotations

from pydantic import Field

from aurora_core.document import Document, omitted
from aurora_core.outcomes.agsg import Agsg
from aurora_core.spec.parameter import Span


class Unjudged(Document):
    """A stated value or choice that no condition depends on.

    Attributes:
        element: Id in the specification, `world` for the environment.
        path: Where it stands in the specification.
        what: For people.
        span: Where the prompt states it, None where that is not known.
    """

    element: str
    path: str
    what: str
    span: Span | None = None


class GroundingFailure(Document):
    """Why nothing was found: the demand that failed most often, and where it was tried.

    Attributes:
        reason: What failed most often; `road` where no street had room for the vehicles.
        tried: At how many places.
        rejected_by: At how many of them each demand failed.
        words: For people: what could not be placed, and what would fit.
    """

    reason: str
    tried: int
    rejected_by: dict[str, int]
    words: str = omitted('')

    @property
    def told(self) -> str:
        """What to tell a person."""
        if not self.words:
            return f'{self.reason}; {self.tried} tried'
        return self.words if self.tried == 0 else f'{self.words}; {self.tried} places tried'


class GroundingOutcome(Document):
    """Exactly one of graph and failure is set.

    Attributes:
        agsg: It travels beside this document, not in it.
        unsupported: What nobody carries out or judges yet, as `id: what`.
        unjudged: What is stated and no condition of the run depends on.
    """

    agsg: Agsg | None = Field(default=None, exclude=True)
    failure: GroundingFailure | None = None
    unsupported: tuple[str, ...] = ()
    unjudged: tuple[Unjudged, ...] = ()
