# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Name every requirement that an answer misses, and whether the user was told."""

from __future__ import annotations

from collections.abc import Iterator
from enum import StrEnum

from aurora_bench.fidelity.answer import Answer
from aurora_bench.fidelity.evidence import evidence, speaks_of
from aurora_bench.fidelity.score import PromptScore
from aurora_bench.prompts.format import AnnotatedPrompt
from aurora_core.document import Document
from aurora_core.spec.scenario import Clause
from aurora_core.spec.vocabulary import ClauseStatus


class Told(StrEnum):
    """What the user learns of a miss."""

    SILENT = 'silent'  # its clause is called encoded, or no clause speaks of it
    DISMISSED = 'dismissed'  # its clause is called `no_requirement`: wrongly, and just as silent
    ADMITTED = (
        'admitted'  # its clause, or the part that speaks of it, is `not_encoded`; a question
    )
    REFUSED = 'refused'  # a feasible request was refused
    BROKEN = 'broken'  # the product raised an error


class Miss(Document):
    """One requirement that is not wholly met.

    Attributes:
        prompt_id: Of the prompt.
        requirement_id: In the prompt.
        kind: Of the requirement.
        fields: Annotated fields that do not hold.
        told: See `Told`.
        clause: Text of the clause that it was looked for in; empty when none was found.
    """

    prompt_id: str
    requirement_id: str
    kind: str
    fields: tuple[str, ...]
    told: Told
    clause: str = ''


def misses(prompt: AnnotatedPrompt, answer: Answer, score: PromptScore) -> Iterator[Miss]:
    """Return every miss of one answer."""
    by_id = {requirement.id: requirement for requirement in prompt.requirements}
    for result in score.requirements:
        if result.is_met:
            continue
        requirement = by_id[result.id]
        lost = tuple(name for name, held in result.fields.items() if not held)
        clauses = evidence(prompt, requirement, lost, answer.clauses)
        told_of = [
            c
            for c in answer.clauses
            if c in clauses
            or (any(_holds(own, c) for own in clauses) and speaks_of(prompt, requirement, c.text))
        ]
        statuses = {clause.status for clause in told_of}
        if answer.error:
            told = Told.BROKEN
        elif answer.question or (answer.spec is None and not answer.reasons):
            told = Told.ADMITTED
        elif answer.reasons and prompt.feasibility != 'infeasible':
            told = Told.REFUSED
        elif ClauseStatus.NOT_ENCODED in statuses:
            told = Told.ADMITTED
        elif statuses == {ClauseStatus.NO_REQUIREMENT}:
            told = Told.DISMISSED
        else:
            told = Told.SILENT
        yield Miss(
            prompt_id=prompt.id,
            requirement_id=requirement.id,
            kind=result.kind,
            fields=lost,
            told=told,
            clause=clauses[0].text if clauses else '',
        )


def _holds(outer: Clause, inner: Clause) -> bool:
    """A part of a clause that was not understood is listed as a clause of its own."""
    return outer.span.start <= inner.span.start and inner.span.end <= outer.span.end
