# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What became of a certificate that was checked again."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum

# One step: whether it holds (None: it cannot be checked here), and what was looked at.
Step = tuple[bool | None, str]

_WORDS = {True: 'holds', False: 'FAILS', None: 'not checked'}


class Outcome(StrEnum):
    """`not_checked` is ignorance: it neither confirms nor refutes."""

    VALID = 'valid'
    REFUTED = 'refuted'
    NOT_CHECKED = 'not_checked'


@dataclass(frozen=True, slots=True, kw_only=True)
class Finding:
    """Outcome for one certificate.

    Attributes:
        outcome: Valid only when every step holds; refuted when one fails.
        steps: What was checked, each with its outcome.
    """

    outcome: Outcome
    steps: tuple[str, ...]

    @property
    def valid(self) -> bool:
        """Whether the proof holds."""
        return self.outcome is Outcome.VALID


def finding(steps: list[Step]) -> Finding:
    """Return the finding that steps amount to; no step at all shows nothing."""
    results = {holds for holds, _ in steps}
    if False in results:
        outcome = Outcome.REFUTED
    elif None in results or not steps:
        outcome = Outcome.NOT_CHECKED
    else:
        outcome = Outcome.VALID
    return Finding(outcome=outcome, steps=tuple(f'{_WORDS[h]}: {text}' for h, text in steps))
