# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What past episodes of repair taught: which move helped which quantity, and how often; and how
far off the replay was.

It only orders what is tried. What a run begins with is part of its input and travels with its
first attempt, so that the same run with the same history makes the same attempts.
"""

from __future__ import annotations

import math
import os
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

from pydantic import FiniteFloat, ValidationError

from aurora_core.document import Document
from aurora_core.errors import ConfigError
from aurora_core.files import DOCUMENT_BYTES, read_bytes
from aurora_core.outcomes.condition import Condition
from aurora_core.outcomes.repair import Attempt
from aurora_core.repair.helps import ANCHOR
from aurora_core.repair.surrogate.replay import kind_of, missed

_FOLDER = 'repairs'
# A move that never helped is still tried, only later.
_LEAST = 0.2
# Of so many estimates of a quantity this share is within the error that is believed of them.
_ENOUGH, _WITHIN = 10, 0.9


class Lesson(Document):
    """A move and what came of it for one quantity.

    Attributes:
        move: See `move`.
        helped: The margin of a condition on the quantity became better.
    """

    move: str
    helped: bool


class RepairEpisode(Document):
    """The lessons of one run.

    Attributes:
        id: Of the run.
        lessons: Its moves.
        missed: By quantity, by how much each estimate of the replay was too good (normalised).
    """

    id: str
    lessons: tuple[Lesson, ...]
    missed: Mapping[str, tuple[FiniteFloat, ...]] = {}


@dataclass(frozen=True, slots=True, kw_only=True)
class Taught:
    """What a history teaches.

    Attributes:
        moves: How much more a move counts than usual, by its name.
        errors: How far off the replay was, by quantity (normalised).
    """

    moves: Mapping[str, float] = field(default_factory=dict)
    errors: Mapping[str, float] = field(default_factory=dict)


def move(quantity: str, field: str, direction: int) -> str:
    """Return the name of moving a field for a quantity, whatever the element is called."""
    return f'{quantity} {field if field == ANCHOR else field.rpartition("/")[2]} {direction:+d}'


def lessons(past: Sequence[Attempt], conditions: Sequence[Condition]) -> tuple[Lesson, ...]:
    """Return what the attempts of a run teach.

    Args:
        past: Everything that was tried, the first realisation included, in order.
        conditions: Of the request.
    """
    quantities = {condition.id: condition.quantity.value for condition in conditions}
    made = [attempt for attempt in past if attempt.simulated]
    found = []
    for k, attempt in enumerate(made[1:], start=1):
        before = max(made[:k], key=lambda a: a.rank)
        moves = list(_moves(before, attempt))
        for name in before.failed:
            if name in quantities:
                helped = _better(before.margins.get(name), attempt.margins.get(name))
                found += [
                    Lesson(move=move(quantities[name], field, way), helped=helped)
                    for field, way in moves
                ]
    return tuple(found)


def estimates(
    past: Sequence[Attempt], conditions: Sequence[Condition]
) -> dict[str, tuple[float, ...]]:
    """Return by how much each estimate of a run was too good, by quantity.

    Args:
        past: Everything that was tried, in order.
        conditions: Of the request.
    """
    kinds = {condition.id: kind_of(condition) for condition in conditions}
    found: dict[str, tuple[float, ...]] = {}
    for attempt in past:
        for name, expected in attempt.predicted.items():
            came = attempt.margins.get(name)
            if attempt.simulated and came is not None and name in kinds:
                off = round(missed(expected, came), 6)
                found[kinds[name]] = (*found.get(kinds[name], ()), off)
    return found


def _moves(before: Attempt, after: Attempt) -> Iterator[tuple[str, int]]:
    """Yield what was moved, and in which direction (0: to another place)."""
    if before.anchor != after.anchor:
        yield ANCHOR, 0
    old = {edit.path: edit.realised for edit in before.plan.values}
    for edit in after.plan.values:
        was = old.get(edit.path, edit.requested)
        if was != edit.realised:
            yield edit.path, 1 if edit.realised > was else -1


def _better(before: float | None, after: float | None) -> bool:
    return after is not None and (before is None or after > before)


def remember_repairs(history: Path, episode: RepairEpisode) -> None:
    """Keep the lessons of a run in a history.

    Raises:
        ConfigError: It cannot be written.
    """
    folder = history / _FOLDER
    target = folder / f'{episode.id}.json'
    # Written whole: another process may be reading.
    temporary = folder / f'.writing-{os.getpid()}-{episode.id}'
    try:
        folder.mkdir(parents=True, exist_ok=True)
        temporary.write_text(episode.model_dump_json(indent=2) + '\n', encoding='utf-8')
        temporary.replace(target)
    except OSError as err:
        raise ConfigError(
            f'the history {folder} cannot be written: {err}',
            hint='name a folder that you may write, or freeze the history',
        ) from err


def learned(history: Path) -> Taught:
    """Return what a history teaches: of moves, and of the replay where it was asked often enough.

    Source of the factors: rule of succession: the share of moves that helped, with one of each
    kind added, in halves.

    Raises:
        ConfigError: A file of the history is no episode.
    """
    tried: dict[str, list[bool]] = {}
    off: dict[str, list[float]] = {}
    for path in sorted((history / _FOLDER).glob('*.json')):
        try:
            episode = RepairEpisode.model_validate_json(read_bytes(path, DOCUMENT_BYTES))
        except (OSError, ValidationError) as err:
            raise ConfigError(f'{path} is no episode: {err}', hint='remove the file') from err
        for lesson in episode.lessons:
            tried.setdefault(lesson.move, []).append(lesson.helped)
        for quantity, values in episode.missed.items():
            off.setdefault(quantity, []).extend(values)
    return Taught(
        moves={name: _factor(helped) for name, helped in sorted(tried.items())},
        errors={
            name: sorted(values)[math.ceil(_WITHIN * len(values)) - 1]
            for name, values in sorted(off.items())
            if len(values) >= _ENOUGH
        },
    )


def _factor(helped: Sequence[bool]) -> float:
    return max(_LEAST, 2.0 * (1 + sum(helped)) / (2 + len(helped)))


def weight(known: Mapping[str, float], quantity: str, field: str, direction: int) -> float:
    """Return how much more a move counts than usual, 1 where nothing is known of it."""
    return known.get(move(quantity, field, direction), 1.0)
