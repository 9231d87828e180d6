# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What past episodes of repair taught: which move helped which quantity, and how often.

It only orders what is tried. What a run begins with is part of its input and travels with its
first attempt, so that the same run with the same history makes the same attempts.
"""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path

from pydantic import ValidationError

from aurora_core.document import Document
from aurora_core.errors import ConfigError
from aurora_core.files import DOCUMENT_BYTES, read_bytes
from aurora_core.outcomes.condition import Condition
from aurora_core.outcomes.repair import Attempt
from aurora_core.repair.helps import ANCHOR

_FOLDER = 'repairs'
# A move that never helped is still tried, only later.
_LEAST = 0.2


class Lesson(Document):
    """A move and what came of it for one quantity.

    Attributes:
        move: See `move`.
        helped: The margin of a condition on the quantity became better.
    """

    move: str
    helped: bool


class RepairEpisode(Document):
    """The lessons of one run."""

    id: str
    lessons: tuple[Lesson, ...]


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


def learned(history: Path) -> dict[str, float]:
    """Return how much more a move counts than usual, by its name.

    Source: rule of succession: the share of moves that helped, with one of each kind added, in
    halves.

    Raises:
        ConfigError: A file of the history is no episode.
    """
    tried: dict[str, list[bool]] = {}
    for path in sorted((history / _FOLDER).glob('*.json')):
        try:
            episode = RepairEpisode.model_validate_json(read_bytes(path, DOCUMENT_BYTES))
        except (OSError, ValidationError) as err:
            raise ConfigError(f'{path} is no episode: {err}', hint='remove the file') from err
        for lesson in episode.lessons:
            tried.setdefault(lesson.move, []).append(lesson.helped)
    return {name: _factor(helped) for name, helped in sorted(tried.items())}


def _factor(helped: Sequence[bool]) -> float:
    return max(_LEAST, 2.0 * (1 + sum(helped)) / (2 + len(helped)))


def weight(known: Mapping[str, float], quantity: str, field: str, direction: int) -> float:
    """Return how much more a move counts than usual, 1 where nothing is known of it."""
    return known.get(move(quantity, field, direction), 1.0)
