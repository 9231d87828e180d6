# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What a validator has found in a prompt file."""

from __future__ import annotations

from enum import StrEnum

from aurora_core.document import Document


class Rule(StrEnum):
    """What was broken."""

    JSON = 'json'
    FORMAT = 'format'
    DUPLICATE_ID = 'duplicate-id'
    DUPLICATE_PROMPT = 'duplicate-prompt'
    REQUIREMENT_ID = 'requirement-id'
    REFERENCE = 'reference'
    MEANING = 'meaning'
    VARIATION = 'variation'
    NOT_STATED = 'number-not-stated'
    NOT_ANNOTATED = 'number-not-annotated'
    LIMIT = 'limit'
    FEASIBILITY = 'feasibility'
    PARAPHRASE = 'paraphrase'
    DERIVED = 'number-derived'


class Finding(Document):
    """One finding.

    Attributes:
        where: Id of the prompt, or `line N` where it has none.
        rule: What was broken.
        text: What was expected and what was found.
        is_error: False for a note that a person should look at.
    """

    where: str
    rule: Rule
    text: str
    is_error: bool = True

    def __str__(self) -> str:
        mark = 'error' if self.is_error else 'note'
        return f'{mark}: {self.where}: {self.rule}: {self.text}'
