# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""One trial: a prompt run once with one seed, and what came of it."""

from __future__ import annotations

from collections.abc import Generator, Iterator, Mapping, Sequence
from contextlib import closing
from enum import StrEnum
from typing import Any

from pydantic import FiniteFloat

from aurora_bench.prompts.format import AnnotatedPrompt, Category, Feasibility
from aurora_bench.resumable.files import PromptFile
from aurora_bench.rulers.checking import Said
from aurora_bench.rulers.readback import ReadBack
from aurora_cli.pool import Lost, Work, run_tasks
from aurora_core.document import Document


class Cause(StrEnum):
    """Why a trial did not end as it should, the first that applies."""

    ERROR = 'error'  # something broke, or a worker died or took too long
    CONTRADICTED = 'contradicted'  # verified, and the checker shows that it does not hold
    ACCEPTED = 'accepted'  # to be refused, and verified
    NOT_REFUSED = 'not refused'  # to be refused, and ended otherwise
    OTHER_REASON = 'other reason'  # refused for a reason that is not annotated
    READING = 'reading'  # a question, or a clause that was not encoded
    CAPABILITY = 'capability'  # no specification says it, or nothing runs or judges it yet
    GROUNDING = 'grounding'  # no place, no plan, or refused
    CONDITION = 'condition'  # it was run, and a condition does not hold


class Trial(Document):
    """A prompt and a seed.

    Attributes:
        key: Unique in a campaign, the same when it is repeated.
        file: Name of the prompt file.
        prompt: What is asked.
        document: The same, as the file's line has it.
        folder: Where the run goes, below the campaign's folder.
    """

    key: str
    file: str
    seed: int
    prompt: AnnotatedPrompt
    document: Mapping[str, Any]
    folder: str


def trials_of(
    file: PromptFile,
    pairs: Sequence[tuple[AnnotatedPrompt, Mapping[str, Any]]],
    seeds: Sequence[int],
    folder: str,
) -> Iterator[Trial]:
    """Yield prompts of a file with every seed.

    Args:
        file: Where they stand.
        pairs: Each with its line in the file.
        seeds: Of the runs.
        folder: Runs go below it.
    """
    for prompt, document in pairs:
        for seed in seeds:
            yield Trial(
                key=f'{file.sha256[:16]}:{prompt.id}:{seed}',
                file=file.name,
                seed=seed,
                prompt=prompt,
                document=document,
                folder=f'{folder}/{prompt.id}-{seed}',
            )


class JudgedTrial(Document):
    """What came of a trial; equal for equal requests but for the seconds.

    Attributes:
        status: Of the run; `not_expressible` and `lost` where there was none.
        right: It ended as it should.
        cause: None when it is right.
        words: What exactly, in words that are the same for many prompts.
        summary: What the run's report says.
        said: The checker's answers; () for a run that is not verified.
        margin: Least normalised one, see `margins`; None where there is none.
        margin_of: Condition that has it.
        placed: Where bodies stood at t = 0, None where nothing was recorded.
        trace_sha256: '' without a trace.
        motion_sha256: '' without a trace.
        repairs: Co-simulations that repair spent.
        repaired: The first realisation did not hold, and another one does.
        seconds: Wall seconds by stage.
    """

    file: str
    id: str
    category: Category
    feasibility: Feasibility
    seed: int
    status: str
    right: bool
    cause: Cause | None = None
    words: tuple[str, ...] = ()
    summary: str = ''
    said: tuple[Said, ...] = ()
    margin: FiniteFloat | None = None
    margin_of: str = ''
    placed: ReadBack | None = None
    trace_sha256: str = ''
    motion_sha256: str = ''
    repairs: int = 0
    repaired: bool = False
    seconds: Mapping[str, FiniteFloat] = {}

    @property
    def contradictions(self) -> tuple[Said, ...]:
        """Annotated requirements that the checker shows not to hold."""
        return tuple(s for s in self.said if s.outcome == 'does_not')


def judged(
    trial: Trial, *, status: str, cause: Cause | None, words: tuple[str, ...] = (), **more: Any
) -> JudgedTrial:
    """Return what came of a trial; without a cause it is right.

    Args:
        trial: The prompt and its seed.
        status: Of the run.
        cause: Why it did not end as it should.
        words: What exactly.
        more: Other fields of `JudgedTrial`.
    """
    return JudgedTrial(
        file=trial.file,
        id=trial.prompt.id,
        category=trial.prompt.category,
        feasibility=trial.prompt.feasibility,
        seed=trial.seed,
        status=status,
        right=cause is None,
        cause=cause,
        words=words,
        **more,
    )


def lost(trial: Trial, why: str) -> JudgedTrial:
    """Return the result of a trial whose worker gave none."""
    return judged(trial, status='lost', cause=Cause.ERROR, words=(why,), summary=why)


def judged_trials(
    work: Work[Trial, JudgedTrial], trials: Sequence[Trial], *, jobs: int, limit_s: float
) -> Generator[tuple[int, JudgedTrial], None, None]:
    """Yield how trials ended, as they end, each with its place among them.

    It is closed by whoever leaves it early: a worker that is still at it writes into its folder.

    Args:
        work: How they are run.
        trials: Which.
        jobs: Worker processes.
        limit_s: Wall seconds of one; whoever takes longer is lost.
    """
    with closing(run_tasks(work, trials, jobs=jobs, limit_s=limit_s)) as answers:
        for index, answer in answers:
            yield index, lost(trials[index], answer.why) if isinstance(answer, Lost) else answer
