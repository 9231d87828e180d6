# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`DiffReport`: where two recorded runs part, from what they were made of to their margins."""

from __future__ import annotations

import json
import math
from collections.abc import Iterator
from dataclasses import dataclass, fields
from typing import Any, Literal

import numpy as np
from pydantic import FiniteFloat

from aurora_core.document import Document
from aurora_core.knowledge.world import WorldModel
from aurora_core.outcomes.agsg import Agsg
from aurora_core.outcomes.verdict import Verdict
from aurora_core.report.status import ExitCode
from aurora_core.trace.bag_content import BagContent
from aurora_core.trace.compare import Value, ValueDifference, compare_traces
from aurora_core.trace.hashing import trace_sha256
from aurora_core.trace.trace import Integrity

# Differences of the last state beyond these say nothing new.
_FINAL = 20
_SHOWN = 200


class DiffSide(Document):
    """One of the runs.

    Attributes:
        bag: Folder of its bag.
        ticks: Samples of its trace.
        trace_sha256: Trace hash (hex).
        integrity: State of the recording.
        note: What is damaged, for people.
    """

    bag: str
    ticks: int
    trace_sha256: str
    integrity: Integrity
    note: str = ''


class InputDifference(Document):
    """Something that the runs were made of: name, and both values as text."""

    name: str
    first: str
    second: str


class PlacedDifference(Document):
    """A value at a tick; a number that is not finite is text.

    Attributes:
        body: Id of the agent or UAV, or of what a record is about.
    """

    tick: int
    time_s: FiniteFloat
    topic: str
    body: str
    quantity: str
    first: FiniteFloat | str | None
    second: FiniteFloat | str | None


class TopicDifference(Document):
    """How much of a topic differs."""

    topic: str
    differing_ticks: int
    first: PlacedDifference


class MarginDifference(Document):
    """A condition whose margin (or the lack of one) differs.

    Attributes:
        difference: Second less first, None when one has no margin.
        what: Other fields that differ.
    """

    condition: str
    first: FiniteFloat | None
    second: FiniteFloat | None
    difference: FiniteFloat | None
    unit: str
    what: str = ''


class DiffReport(Document):
    """Everything in which two runs differ.

    Attributes:
        equal: Same trace hash, same margins to the last bit.
        inputs: Prompt, specification, seed, map, world, roster.
        first_difference: First differing value of the ticks that both have.
        topics: Topics with a difference, in order of cause.
        final: Differences of the states at the last common tick (the first 20).
        margins: None when a bag has no conditions to compare.
    """

    schema_version: Literal[1] = 1
    equal: bool
    first: DiffSide
    second: DiffSide
    inputs: tuple[InputDifference, ...]
    first_difference: PlacedDifference | None
    topics: tuple[TopicDifference, ...]
    final: tuple[PlacedDifference, ...]
    margins: tuple[MarginDifference, ...] | None


@dataclass(frozen=True, slots=True, kw_only=True)
class DiffRun:
    """A run as it was read; `agsg` and `verdict` are None when the bag has no graph."""

    bag: str
    content: BagContent
    agsg: Agsg | None
    verdict: Verdict | None


def diff_report(first: DiffRun, second: DiffRun) -> DiffReport:
    """Compare two runs."""
    a, b = first.content, second.content
    found = compare_traces(a.trace, b.trace)
    dt_s = a.trace.roster.dt_s

    def placed(value: ValueDifference) -> PlacedDifference:
        return PlacedDifference(
            tick=value.tick,
            time_s=value.tick * dt_s,
            topic=value.topic,
            body=value.body,
            quantity=value.quantity,
            first=_json(value.first),
            second=_json(value.second),
        )

    margins = None
    if first.verdict is not None and second.verdict is not None:
        margins = tuple(_margins(first.verdict, second.verdict))
    sides = _side(first), _side(second)
    return DiffReport(
        equal=sides[0].trace_sha256 == sides[1].trace_sha256 and not margins,
        first=sides[0],
        second=sides[1],
        inputs=(
            *_requests(first.agsg, second.agsg),
            *_worlds(a.world, b.world),
            *(_input(*entry) for entry in found.roster),
        ),
        first_difference=None if found.first is None else placed(found.first),
        topics=tuple(
            TopicDifference(topic=s.topic, differing_ticks=s.ticks, first=placed(s.first))
            for s in found.streams
        ),
        final=tuple(placed(value) for value in found.final[:_FINAL]),
        margins=margins,
    )


def diff_exit_code(report: DiffReport) -> ExitCode:
    """Return the exit code of `aurora diff`: 0 equal, 1 different."""
    return ExitCode.OK if report.equal else ExitCode.VIOLATED


def _side(run: DiffRun) -> DiffSide:
    trace = run.content.trace
    return DiffSide(
        bag=run.bag,
        ticks=trace.ticks,
        trace_sha256=trace_sha256(trace, run.content.world),
        integrity=trace.integrity,
        note=trace.integrity_note,
    )


def _json(value: Value) -> float | str | None:
    return repr(value) if isinstance(value, float) and not math.isfinite(value) else value


def _input(name: str, first: object, second: object) -> InputDifference:
    texts = [value if isinstance(value, str) else repr(value) for value in (first, second)]
    return InputDifference(name=name, first=texts[0][:_SHOWN], second=texts[1][:_SHOWN])


def _requests(first: Agsg | None, second: Agsg | None) -> Iterator[InputDifference]:
    if first is None or second is None:
        if first is not second:
            yield _input('graph', *('there' if x is not None else 'none' for x in (first, second)))
        return
    if first.spec.prompt != second.spec.prompt:
        yield _input('prompt', first.spec.prompt, second.spec.prompt)
    yield from _documents('specification', first.texts.spec, second.texts.spec, {'prompt'})
    yield from _documents('grounding', first.texts.grounding, second.texts.grounding)
    yield from _documents('schedule', first.texts.schedule, second.texts.schedule)


def _documents(
    name: str, first: str, second: str, aside: set[str] | None = None
) -> Iterator[InputDifference]:
    """Name the fields of a JSON object that differ."""
    if first == second:
        return
    try:
        a, b = json.loads(first or '{}'), json.loads(second or '{}')
    except ValueError:
        a, b = first, second
    if not isinstance(a, dict) or not isinstance(b, dict):
        yield _input(name, first, second)
        return
    for key in sorted({*a, *b} - (aside or set())):
        if a.get(key) != b.get(key):
            label = key if key == 'seed' else f'{name}: {key}'
            yield _input(label, *(json.dumps(x.get(key), ensure_ascii=False) for x in (a, b)))


def _worlds(first: WorldModel, second: WorldModel) -> Iterator[InputDifference]:
    for entry in fields(WorldModel):
        a, b = getattr(first, entry.name), getattr(second, entry.name)
        if _same(a, b):
            continue
        if isinstance(a, tuple) and isinstance(b, tuple):
            changed = sum(not _same(x, y) for x, y in zip(a, b, strict=False))
            texts = [f'{len(x)} ({changed} of the common ones differ)' for x in (a, b)]
            yield _input(f'world: {entry.name}', *texts)
        else:
            yield _input(f'world: {entry.name}', str(a), str(b))


def _same(a: Any, b: Any) -> bool:
    """Compare values that may hold arrays."""
    if isinstance(a, np.ndarray) or isinstance(b, np.ndarray):
        return np.array_equal(a, b)
    if isinstance(a, tuple) and isinstance(b, tuple):
        return len(a) == len(b) and all(_same(x, y) for x, y in zip(a, b, strict=True))
    if type(a) is type(b) and hasattr(a, '__dataclass_fields__'):
        return all(_same(getattr(a, f.name), getattr(b, f.name)) for f in fields(a))
    return bool(a == b)


def _margins(first: Verdict, second: Verdict) -> Iterator[MarginDifference]:
    ours = {result.id: result for result in first.results}
    theirs = {result.id: result for result in second.results}
    for name in dict.fromkeys((*ours, *theirs)):
        a, b = ours.get(name), theirs.get(name)
        if a is None or b is None:
            there = a or b
            yield MarginDifference(
                condition=name,
                first=None if a is None else a.margin,
                second=None if b is None else b.margin,
                difference=None,
                unit='' if there is None else there.unit,
                what='only in the second run' if a is None else 'only in the first run',
            )
            continue
        left, right = a.model_dump(mode='json'), b.model_dump(mode='json')
        what = [key for key in left if left[key] != right[key]]
        if what:
            both = a.margin is not None and b.margin is not None
            difference = (b.margin or 0.0) - (a.margin or 0.0) if both else None
            finite = difference is not None and math.isfinite(difference)
            yield MarginDifference(
                condition=name,
                first=a.margin,
                second=b.margin,
                difference=difference if finite else None,
                unit=a.unit,
                what=', '.join(what),
            )
