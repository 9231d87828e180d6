# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What the checker says: three outcomes, the reasons, and how several of them become one."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from enum import StrEnum


class CheckerError(Exception):
    """The recording or the annotation cannot be read; the message ends with what to do."""


class Outcome(StrEnum):
    """What a recording says about a requirement."""

    HOLDS = 'holds'
    DOES_NOT = 'does_not'
    CANNOT_TELL = 'cannot_tell'


@dataclass(frozen=True, slots=True, kw_only=True)
class Answer:
    """The answer to one requirement of the annotation.

    Attributes:
        requirement: Its `id`.
        kind: Its `kind`.
        why: The figures behind the outcome, for people.
    """

    requirement: str
    kind: str
    outcome: Outcome
    why: str


@dataclass(frozen=True, slots=True, kw_only=True)
class Checked:
    """The answers of one recording.

    Attributes:
        answers: One per top-level requirement, in the order of the annotation.
        binding: Each name of the annotation with the bodies of the roster that it stands for.
    """

    answers: tuple[Answer, ...]
    binding: Mapping[str, tuple[str, ...]]


@dataclass(frozen=True, slots=True)
class Judged:
    """An outcome with its figures."""

    outcome: Outcome
    why: str


def holds(why: str) -> Judged:
    """Return that it holds."""
    return Judged(Outcome.HOLDS, why)


def does_not(why: str) -> Judged:
    """Return that it does not hold."""
    return Judged(Outcome.DOES_NOT, why)


def cannot_tell(why: str) -> Judged:
    """Return that the states do not decide it."""
    return Judged(Outcome.CANNOT_TELL, why)


def decide(true: bool, why: str) -> Judged:
    """Return holds or does not."""
    return holds(why) if true else does_not(why)


def graded(surely: bool, possibly: bool, why: str) -> Judged:
    """Return holds when surely so, does not when not even possibly so, else cannot tell."""
    if surely:
        return holds(why)
    return cannot_tell(why) if possibly else does_not(why)


def all_of(parts: Sequence[Judged]) -> Judged:
    """Return the worst: one failure fails all, one doubt leaves all in doubt."""
    for outcome in (Outcome.DOES_NOT, Outcome.CANNOT_TELL):
        hit = [part.why for part in parts if part.outcome is outcome]
        if hit:
            return Judged(outcome, '; '.join(hit))
    return holds('; '.join(part.why for part in parts if part.why) or 'nothing to be judged')


def any_of(parts: Sequence[Judged]) -> Judged:
    """Return the best: one that holds suffices, all failing fails."""
    for outcome in (Outcome.HOLDS, Outcome.CANNOT_TELL):
        for part in parts:
            if part.outcome is outcome:
                return part
    return does_not(' / '.join(dict.fromkeys(part.why for part in parts)) or 'no reading given')


def negated(judged: Judged) -> Judged:
    """Return the answer to the opposite."""
    match judged.outcome:
        case Outcome.HOLDS:
            return does_not(f'must not be so, but: {judged.why}')
        case Outcome.DOES_NOT:
            return holds(f'is not so: {judged.why}')
        case Outcome.CANNOT_TELL:
            return judged
