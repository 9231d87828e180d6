# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Asking many prompts, side by side, each once per seed; what is known is not asked again."""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from contextlib import closing
from pathlib import Path

from pydantic import FiniteFloat

from aurora_bench.fidelity.answer import Answer, answer
from aurora_bench.prompts.format import AnnotatedPrompt
from aurora_bench.resumable.journal import Journal
from aurora_cli.installed import installed
from aurora_cli.pool import Lost, run_tasks
from aurora_core.document import Document
from aurora_core.errors import ConfigError
from aurora_core.pipeline.stages import RunRequest


class Question(Document):
    """A prompt with a seed.

    Attributes:
        key: Unique in a campaign.
    """

    key: str
    prompt: AnnotatedPrompt
    request: RunRequest


class Told(Document):
    """What was answered to a question, and how long it took.

    Attributes:
        config: Why nothing could be answered: a recorded reply is missing.
    """

    answer: Answer
    seconds: FiniteFloat
    config: str = ''


class AskWork:
    """What a worker does: it reads and checks."""

    def __init__(self, map_name: str) -> None:
        self._map_name = map_name

    def prepare(self) -> None:
        """Load the map, and read once, so that no prompt waits for the lexicon."""
        installed().map(self._map_name)
        answer(RunRequest(prompt='A drone hovers at 40 m.', map_name=self._map_name))

    def __call__(self, question: Question) -> Told:
        """Ask."""
        begin = time.perf_counter()
        try:
            given = answer(question.request)
        except ConfigError as err:
            return Told(answer=Answer(), seconds=0.0, config=str(err))
        return Told(answer=given, seconds=time.perf_counter() - begin)


def ask(
    questions: Sequence[Question],
    work: AskWork,
    *,
    jobs: int,
    limit_s: float,
    journal: Journal | None,
    step: Callable[[Question, Told], None],
) -> tuple[Told, ...]:
    """Return what was answered, in the order of the questions.

    Args:
        questions: What is asked.
        work: How.
        jobs: Worker processes.
        limit_s: Wall seconds that an answer may take; without one it counts as an error.
        journal: What is there is taken over, the rest is added.
        step: Called with each as it is known.

    Raises:
        ConfigError: A recorded reply is missing; what the product would say is not known.
    """
    finished = journal.finished if journal is not None else {}
    known = {q.key: Told.model_validate(finished[q.key]) for q in questions if q.key in finished}
    for question in questions:
        if question.key in known:
            step(question, known[question.key])
    left = [q for q in questions if q.key not in known]
    with closing(run_tasks(work, left, jobs=jobs, limit_s=limit_s)) as results:
        for index, result in results:
            question = left[index]
            told = result
            if isinstance(told, Lost):
                told = Told(answer=Answer(error=told.why), seconds=0.0)
            if told.config:
                raise ConfigError(f'{question.prompt.id}: {told.config}')
            known[question.key] = told
            if journal is not None:
                journal.add(question.key, told.model_dump(mode='json'))
            step(question, told)
    return tuple(known[q.key] for q in questions)


def question(
    prompt: AnnotatedPrompt,
    digest: str,
    seed: int,
    *,
    map_name: str,
    model: str,
    transcripts: Path | None,
    history: Path | None,
) -> Question:
    """Return a prompt as it is asked; the history takes nothing in."""
    return Question(
        key=f'{digest[:16]}:{prompt.id}:{seed}',
        prompt=prompt,
        request=RunRequest(
            prompt=prompt.prompt,
            map_name=map_name,
            seed=seed,
            model=model,
            transcripts=transcripts,
            history=history,
            history_frozen=True,
        ),
    )
