# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Requests in which one thing that nobody states is at fault, drawn from a seed.

The other open values are drawn as well, and the faulty one stands in the request as its default:
there is no good value to go back to. A fault of place pins the first realisation to a street that
was drawn. Where what is at fault is stated, or belongs to a link, it is locked: nothing may mend
it. Which kinds there are is said in `kinds`.
"""

from __future__ import annotations

import random
from collections.abc import Mapping
from itertools import count, islice
from typing import Any

from aurora_bench.repair.kinds import KINDS, PLACE, Kind, Span
from aurora_core.document import Document
from aurora_core.outcomes.repair import ValueEdit, with_values
from aurora_core.pipeline.functions import parse_stage
from aurora_core.pipeline.knowledge import Knowledge
from aurora_core.spec.scenario import ScenarioSpec

_LOCKED_EVERY = 3


class Fault(Document):
    """A request with a fault.

    Attributes:
        key: The same for every draw of a fault.
        kind: What is wrong with it.
        prompt: What is asked.
        good_prompt: The same without the fault, where the prompt states it.
        values: Open values, by the end of their path.
        cause: Which of them is at fault, by the end of its path; the place; or a word.
        good: A value in its place with which the request is to hold; None for a place or a word.
        place: Which street the first realisation is pinned to, of all; None: to none.
        mends: Repair may mend it; False: the lock stands in the way.
        seed: Of the run.
    """

    key: str
    kind: str
    prompt: str
    good_prompt: str
    values: Mapping[str, float]
    cause: str
    good: float | None = None
    place: float | None = None
    mends: bool = True
    seed: int


class Draws(Document):
    """A fault that is drawn until it bites.

    Attributes:
        key: Unique in a campaign, the same when it is repeated.
        kind: Name of its kind.
        number: Place in the campaign.
        seed: Of the campaign.
    """

    key: str
    kind: str
    number: int
    seed: int

    def drawn(self, attempt: int) -> Fault:
        """Return a draw, the same one for a number."""
        kind = next(k for k in KINDS if k.name == self.kind)
        begin = f'{self.seed}:{self.number}'
        return _drawn(kind, self.key, random.Random(f'{begin}:{attempt}' if attempt else begin))


def faults(number: int, seed: int) -> tuple[Draws, ...]:
    """Return faults of all kinds in turn, the same ones for a seed.

    Locked ones come in every third round: all that can be shown of them is that they stay.
    """
    turns = (kind for turn in count() for kind in KINDS if kind.mends or turn % _LOCKED_EVERY == 0)
    return tuple(
        Draws(key=f'{kind.name} {k}', kind=kind.name, number=k, seed=seed)
        for k, kind in enumerate(islice(turns, number))
    )


def _drawn(kind: Kind, key: str, draw: random.Random) -> Fault:
    words: dict[str, str] = {}
    numbers: dict[str, float] = {}
    for name, choice in kind.words.items():
        first = choice[0]
        if isinstance(first, int):
            numbers[name] = draw.randint(first, int(choice[1]))
            words[name] = f'{numbers[name]:g}'
        else:
            words[name] = str(draw.choice(choice))
    values = {end: _value(span, numbers, draw) for end, span in kind.values.items()}
    good = None if kind.good is None else _value(kind.good, numbers, draw)
    stated = kind.cause in words
    other = {**words, kind.cause: f'{good:g}'} if stated else words
    return Fault(
        key=key,
        kind=kind.name,
        prompt=kind.prompt.format(**words),
        good_prompt=kind.prompt.format(**other),
        values=values,
        cause=kind.cause,
        good=None if stated else good,
        place=draw.random() if kind.cause == PLACE else None,
        mends=kind.mends,
        seed=draw.randint(1, 99),
    )


def _value(span: Span, numbers: Mapping[str, float], draw: random.Random) -> float:
    times = numbers[span.of] if span.of else 1.0
    more = numbers[span.above] if span.above else 0.0
    return round(draw.uniform(times * span.low + more, times * span.high), 2)


def with_fault(
    known: Knowledge, fault: Fault, map_name: str, *, good: bool = False
) -> tuple[ScenarioSpec, str]:
    """Return the request with its fault as if the faulty values were what is usual.

    Args:
        known: What is installed here.
        fault: The fault.
        map_name: Map of the run.
        good: With the good value in the place of the faulty one.

    Returns:
        The request and the whole path of the cause.

    Raises:
        LookupError: The prompt is not read, or has no such values.
    """
    prompt = fault.good_prompt if good else fault.prompt
    graph = parse_stage(known, prompt, map_name, fault.seed).agsg
    if graph is None:
        raise LookupError(f'{prompt!r} is not read')
    rows = {row.path: row for row in graph.parameters}
    paths: dict[str, Any] = {
        end: next((path for path in rows if path.endswith(end)), None) for end in fault.values
    }
    if None in paths.values():
        raise LookupError(f'{prompt!r} lacks one of {", ".join(fault.values)}')
    values = {**fault.values}
    if good and fault.good is not None:
        values[fault.cause] = fault.good
    edits = tuple(
        ValueEdit(
            path=paths[end],
            requested=rows[paths[end]].requested,
            realised=value,
            provenance=rows[paths[end]].provenance,
        )
        for end, value in values.items()
    )
    changed = with_values(graph.spec, edits).model_copy(update={'reader': ''})
    return changed, str(paths.get(fault.cause, fault.cause))
