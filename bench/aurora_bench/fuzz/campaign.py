# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Run mutated prompts through the offline parser and mutated replies through the model check."""

from __future__ import annotations

import random
import signal
import time
from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from types import FrameType
from typing import Any

from aurora_bench.fuzz import prompts as of_prompts
from aurora_bench.fuzz import replies as of_replies
from aurora_bench.fuzz.judge import faults
from aurora_core.document import Document
from aurora_core.errors import PromptError
from aurora_core.outcomes.parse import ParseContext, ParseOutcome
from aurora_core.parsing.data_files import read_data
from aurora_core.parsing.llm.check import judge
from aurora_core.parsing.llm.facts import PromptFacts
from aurora_core.parsing.parser import parse_offline

# Processor seconds for one text, on any machine of the last ten years; above it counts as a hang.
LIMIT_S = 10.0
_SHOWN = 300


class Failure(Document):
    """One text that broke a promise.

    Attributes:
        seed: With it alone the text is made again.
        mutations: What was done to the original.
        text: The prompt, or the reply.
        what: crash, hang or numbers.
        detail: In words.
    """

    seed: int
    mutations: tuple[str, ...]
    text: str
    what: str
    detail: str


class Tally(Document):
    """What came of one half of the campaign."""

    tried: int
    failures: tuple[Failure, ...]
    outcomes: dict[str, int]
    mutations: dict[str, int]
    slowest_s: float


class _Hang(BaseException):
    """The limit of one text is over; no `except Exception` may swallow it."""


@contextmanager
def _limited(seconds: float) -> Iterator[None]:
    """Raise in this thread after so many processor seconds."""

    def stop(_number: int, _frame: FrameType | None) -> None:
        raise _Hang

    before = signal.signal(signal.SIGVTALRM, stop)
    signal.setitimer(signal.ITIMER_VIRTUAL, seconds)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_VIRTUAL, 0.0)
        signal.signal(signal.SIGVTALRM, before)


Case = tuple[tuple[str, ...], str, Callable[[], tuple[str, list[str]]]]


def fuzz_prompts(
    originals: Sequence[str],
    context: ParseContext,
    number: int,
    seed: int,
    said: Callable[[str], None],
) -> Tally:
    """Parse mutated prompts; each has a seed of its own."""

    def case(one: int) -> Case:
        names, text = of_prompts.mutated(random.Random(one), originals)

        def answer() -> tuple[str, list[str]]:
            try:
                outcome = parse_offline(text, context)
            except PromptError:
                return 'no prompt', []
            return _kind(outcome), list(faults(text, outcome))

        return names, text, answer

    return _run(case, number, seed, said)


def fuzz_replies(
    context: ParseContext, number: int, seed: int, said: Callable[[str], None]
) -> Tally:
    """Judge mutated replies to the shipped examples of prompts."""
    rows: list[dict[str, Any]] = read_data('llm/examples.yaml')['examples']
    known = [(PromptFacts(row['prompt'], context), typed(row['answer'])) for row in rows]

    def case(one: int) -> Case:
        draw = random.Random(one)
        facts, answer = draw.choice(known)
        name, text = of_replies.mutated(draw, answer)

        def answered() -> tuple[str, list[str]]:
            judgement = judge(text, facts)
            if judgement.outcome is None:
                return 'objections', [] if judgement.complaints else ['refused without a reason']
            return _kind(judgement.outcome), list(faults(facts.prompt, judgement.outcome))

        return (name,), text, answered

    return _run(case, number, seed, said)


def typed(value: Any) -> Any:
    """Give the words of a YAML file read as text their numbers and truth values back."""
    if isinstance(value, dict):
        return {key: typed(inner) for key, inner in value.items()}
    if isinstance(value, list):
        return [typed(inner) for inner in value]
    if value in ('true', 'false'):
        return value == 'true'
    try:
        return int(value)
    except ValueError:
        pass
    try:
        return float(value)
    except ValueError:
        return value


def _kind(outcome: ParseOutcome) -> str:
    if outcome.refusals:
        return 'refused'
    if outcome.spec is None:
        return 'question'
    unread = any(c.status.value == 'not_encoded' for c in outcome.clauses)
    return 'incomplete' if unread else 'complete'


def _run(
    case: Callable[[int], Case], number: int, seed: int, said: Callable[[str], None]
) -> Tally:
    outcomes: Counter[str] = Counter()
    mutations: Counter[str] = Counter()
    failures: list[Failure] = []
    slowest = 0.0
    for one in range(seed, seed + number):
        names, text, answer = case(one)
        mutations.update(names)
        begun = time.process_time()
        wrong: list[tuple[str, str]] = []
        try:
            with _limited(LIMIT_S):
                kind, found = answer()
            wrong = [('numbers', detail) for detail in found]
        except _Hang:
            kind, wrong = 'hang', [('hang', f'more than {LIMIT_S:g} s')]
        # Whatever a damaged text makes the product raise is what this campaign looks for.
        except Exception as err:  # noqa: BLE001
            kind, wrong = 'crash', [('crash', f'{type(err).__name__}: {err}'[:_SHOWN])]
        slowest = max(slowest, time.process_time() - begun)
        outcomes[kind] += 1
        failures += [
            Failure(seed=one, mutations=names, text=text[:_SHOWN], what=what, detail=detail)
            for what, detail in wrong
        ]
        done = one - seed + 1
        if done % 1000 == 0:
            said(f'{done} of {number}, {len(failures)} failures')
    return Tally(
        tried=number,
        failures=tuple(failures),
        outcomes=dict(sorted(outcomes.items())),
        mutations=dict(sorted(mutations.items())),
        slowest_s=slowest,
    )
