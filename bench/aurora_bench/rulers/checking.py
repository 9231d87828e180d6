# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What the independent checker says about a verified run, as a ruler keeps it."""

from __future__ import annotations

import importlib
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any, Literal, Protocol

from aurora_core.document import Document

_CHECKER = 'aurora_bench.checker'


class Said(Document):
    """The checker's answer about one requirement.

    Attributes:
        requirement: Id in the annotation.
        kind: Kind of the requirement.
        why: With numbers from the bag.
    """

    requirement: str
    kind: str
    outcome: Literal['holds', 'does_not', 'cannot_tell']
    why: str


class _Answer(Protocol):
    """An answer of `aurora_bench.checker`."""

    @property
    def requirement(self) -> str: ...
    @property
    def kind(self) -> str: ...
    @property
    def outcome(self) -> str: ...
    @property
    def why(self) -> str: ...


class _Checked(Protocol):
    @property
    def answers(self) -> Sequence[_Answer]: ...


# Takes a bag and one line of a prompt file.
Check = Callable[[Path, Mapping[str, Any]], _Checked]


def independent_checker() -> Check:
    """Return the checker.

    It is imported by name and only here: nothing of it is shared with what is judged.
    """
    check: Check = importlib.import_module(_CHECKER).check_bag
    return check


def asked_of(check: Check, bag: Path, document: Mapping[str, Any]) -> tuple[Said, ...]:
    """Return what the checker says about every requirement that counts (`beyond` does not)."""
    return tuple(
        Said.model_validate(
            {
                'requirement': answer.requirement,
                'kind': str(answer.kind),
                'outcome': str(answer.outcome),
                'why': answer.why,
            }
        )
        for answer in check(bag, document).answers
        if str(answer.kind) != 'beyond'
    )
