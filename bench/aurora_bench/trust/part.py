# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""A part of the campaign: numbered cases, each of which holds or is told."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from pydantic import Field

from aurora_core.document import Document

# More failures of one part say nothing more.
MOST_TOLD = 20
# A figure of what must not be once, though a share of the cases may fail.
NEVER = 'never allowed'


class Found(Document):
    """What some cases of a part showed.

    Attributes:
        tried: Cases.
        held: Those in which the promise was kept.
        failures: The first that were not, in words.
        figures: The largest of what else was measured, by name.
    """

    tried: int
    held: int
    failures: tuple[str, ...] = ()
    figures: dict[str, float] = Field(default_factory=dict)

    def plus(self, other: Found) -> Found:
        """Return both together."""
        names = self.figures.keys() | other.figures.keys()
        return Found(
            tried=self.tried + other.tried,
            held=self.held + other.held,
            failures=(*self.failures, *other.failures)[:MOST_TOLD],
            figures={
                name: max(f.figures[name] for f in (self, other) if name in f.figures)
                for name in sorted(names)
            },
        )


NOTHING = Found(tried=0, held=0)


@dataclass(frozen=True, slots=True, kw_only=True)
class Part:
    """Cases that are counted for one promise.

    Attributes:
        ident: The promise, R1 to R22.
        name: What is tried, for people; unique in the campaign.
        wanted: How many cases the target asks for.
        usual: How many are tried unless more are asked for.
        chunk: Cases that are kept together in the journal.
        least: Share of the cases that has to hold.
        run: Tries the cases from a number on, so many, in an empty folder.
    """

    ident: str
    name: str
    wanted: int
    usual: int
    chunk: int
    run: Callable[[int, int, Path], Found]
    least: float = 1.0


class Counter:
    """Counts cases."""

    def __init__(self) -> None:
        self._tried, self._held = 0, 0
        self._failures: list[str] = []
        self._figures: dict[str, float] = {}

    def add(self, problem: str) -> None:
        """Count a case; '' when it held."""
        self._tried += 1
        self._held += not problem
        if problem and len(self._failures) < MOST_TOLD:
            self._failures.append(problem[:300])

    def figure(self, name: str, value: float) -> None:
        """Keep the largest of a measurement."""
        self._figures[name] = max(value, self._figures.get(name, value))

    def found(self) -> Found:
        """Return what was counted."""
        return Found(
            tried=self._tried,
            held=self._held,
            failures=tuple(self._failures),
            figures=self._figures,
        )
