# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The port to processes, here or elsewhere, that execute candidates of repair beside a run."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Protocol

from aurora_core.knowledge.basis import Basis
from aurora_core.outcomes.agsg import Agsg
from aurora_core.pipeline.stages import ExecutionResult, RunRequest


@dataclass(frozen=True, slots=True, kw_only=True)
class Candidate:
    """A realisation that is to be executed.

    Attributes:
        graph: Grounded.
        request: Of the run: seed and faults.
        run_id: Of the run; its recording names it.
        basis: What the run is made with: another one would give another trace.
    """

    graph: Agsg
    request: RunRequest
    run_id: str
    basis: Basis


@dataclass(frozen=True, slots=True, kw_only=True)
class Recorded:
    """A candidate that was executed.

    Attributes:
        result: What is said of the execution; its path is that of who executed.
        files: Contents of the bag by file name.
    """

    result: ExecutionResult
    files: Mapping[str, bytes]


class Pending(Protocol):
    """A candidate that was given away."""

    def wait(self, seconds: float) -> Recorded | None:
        """Return what was recorded; None when it is not there after so long.

        Raises:
            AuroraError: It will not come.
        """

    def drop(self) -> None:
        """Take it back: nobody needs it."""


class Beside(Protocol):
    """Processes that execute candidates, each one at a time."""

    @property
    def places(self) -> int:
        """How many candidates are executed at a time at most."""

    def prepare(self) -> None:
        """Begin to load what an execution needs; nobody waits for it."""

    def begin(self, candidate: Candidate) -> Pending | None:
        """Give a candidate away; None when nobody is free.

        Raises:
            AuroraError: Nobody can take any.
        """
