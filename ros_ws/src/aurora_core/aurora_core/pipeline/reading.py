# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Does a recorded request say what its prompt says?

The offline parser is a pure function of the prompt and the names on the map: what it has read, it
reads again. What somebody else has read, or another version of the parser, is held against the
words: clauses stand where they say and leave no word out, and a stated value stands in its words.
"""

from __future__ import annotations

import hashlib
from collections.abc import Iterator, Sequence
from functools import lru_cache
from itertools import groupby
from pathlib import Path
from typing import Any

import aurora_core
from aurora_core.document import first_difference
from aurora_core.errors import AuroraError
from aurora_core.knowledge.limits import Limits
from aurora_core.outcomes.parse import ParseContext
from aurora_core.parsing.atoms import ACTORS, Atom, AtomKind, NounKind
from aurora_core.parsing.coverage import in_no_clause
from aurora_core.parsing.landmarks import landmark_phrases
from aurora_core.parsing.measures import ANGLE, LENGTH, SPEED, TIME, Measure
from aurora_core.parsing.parser import parse_offline
from aurora_core.parsing.tagging import tag
from aurora_core.parsing.tokens import tokenize
from aurora_core.planning.complete import complete
from aurora_core.spec.parameter import Parameter, Provenance, Span, Unit
from aurora_core.spec.scenario import Clause, ScenarioSpec

# What decides how a prompt is read: code, words and defaults.
_PACKAGES = ('parsing', 'planning', 'spec')
_SUFFIXES = ('.py', '.yaml')
# Other units, such as that of a share, are told in too many ways (`one in twenty`).
_DIMENSIONS = {
    Unit.METRE: LENGTH,
    Unit.SECOND: TIME,
    Unit.METRE_PER_SECOND: SPEED,
    Unit.DEGREE: ANGLE,
}
_DOING = (AtomKind.VERB, AtomKind.UNKNOWN)
_NAMED = ACTORS - {NounKind.PRONOUN}
# A reader may round `60 feet` to 18.29 m.
_ROUNDING = 0.01
_SHOWN = 60


@lru_cache(maxsize=1)
def parser_digest() -> str:
    """Return the digest (hex) of the offline parser that is installed."""
    root = Path(aurora_core.__file__).parent
    total = hashlib.sha256()
    for package in _PACKAGES:
        for file in sorted(f for f in (root / package).rglob('*') if f.suffix in _SUFFIXES):
            data = file.read_bytes()
            total.update(f'{file.relative_to(root)} {len(data)}\n'.encode())
            total.update(data)
    return total.hexdigest()


def doubts_of_reading(
    spec: ScenarioSpec, limits: Limits, context: ParseContext | None
) -> Iterator[str]:
    """Yield where a request is not what its prompt says.

    Args:
        spec: As recorded, completed.
        limits: It was completed with.
        context: The map that it was read against, None when that is not here.
    """
    if context is not None and spec.reader == parser_digest():
        yield from _read_again(spec, limits, context)
    else:
        yield from _beside_the_words(spec, () if context is None else context.landmark_names)


def _read_again(spec: ScenarioSpec, limits: Limits, context: ParseContext) -> Iterator[str]:
    try:
        again = parse_offline(spec.prompt, context).spec
    except AuroraError as err:
        yield f'the recorded prompt cannot be read: {err.message}'
        return
    if again is None:
        yield 'the parser makes no request of the recorded prompt'
        return
    whole = complete(again, limits).model_copy(update={'reader': spec.reader})
    found = first_difference(spec, whole)
    if found is not None:
        path, recorded, read = found
        yield f'{path} is recorded as {_short(recorded)}, the prompt gives {_short(read)}'


def _beside_the_words(spec: ScenarioSpec, landmarks: tuple[str, ...]) -> Iterator[str]:
    for k, clause in enumerate(spec.clauses):
        words = _words(spec, clause.span)
        if clause.text != words:
            yield f'clauses/{k} is recorded as {_short(clause.text)}, there stands {_short(words)}'
    atoms = tag(tokenize(spec.prompt), landmark_phrases(landmarks)).atoms
    for span in in_no_clause(atoms, spec.clauses) if spec.clauses else ():
        yield f'no clause holds {_short(_words(spec, span))}'
    for span in _untold(atoms, spec.clauses) if spec.clauses else ():
        yield f'no clause holds {_short(_words(spec, span))}'
    measures = [atom.measure for atom in atoms if atom.measure is not None]
    for path, parameter in _parameters(spec, ''):
        stated = [m for m in measures if _states(m, parameter)]
        if len(stated) == 1 and not _says(stated[0], parameter.value):
            told = _short(spec.prompt[stated[0].start : stated[0].end])
            yield f'{path} is recorded as {parameter.value:g}, the prompt states {told} there'


def _untold(atoms: Sequence[Atom], clauses: Sequence[Clause]) -> Iterator[Span]:
    """Yield stretches in no clause in which somebody does something; small words may be left."""
    for told, stretch in groupby(atoms, lambda atom: any(_meet(atom, c.span) for c in clauses)):
        words = list(stretch)
        named = any(w.noun is not None and w.noun.kind in _NAMED for w in words)
        if not told and named and any(w.kind in _DOING for w in words):
            yield Span(start=words[0].start, end=words[-1].end)


def _states(measure: Measure, parameter: Parameter) -> bool:
    """Return whether a measure of its kind stands where a value says that it is stated."""
    span = parameter.span
    if span is None or parameter.provenance is not Provenance.EXPLICIT:
        return False
    return measure.dimension == _DIMENSIONS.get(parameter.unit) and _meet(measure, span)


def _meet(one: Atom | Measure, other: Span) -> bool:
    return one.start < other.end and other.start < one.end


def _says(measure: Measure, value: float) -> bool:
    """Return whether a stated number can mean a value; a nought is stated without numbers.

    A value may lie between two stated ends, and a diameter is two radii.
    """
    meant = [m for m in (measure.value, measure.upper, measure.second) if m is not None]
    low, high = min(meant), max(meant)
    return value == 0 or any(
        low / size * (1 - _ROUNDING) <= abs(value) <= high / size * (1 + _ROUNDING)
        for size in (1, 2)
    )


def _parameters(value: Any, path: str) -> Iterator[tuple[str, Parameter]]:
    if isinstance(value, Parameter):
        yield path, value
    elif isinstance(value, tuple):
        for k, member in enumerate(value):
            yield from _parameters(member, f'{path}/{getattr(member, "id", k)}')
    elif hasattr(value, 'model_fields_set'):
        for name, member in value:
            yield from _parameters(member, f'{path}/{name}'.strip('/'))


def _words(spec: ScenarioSpec, span: Span) -> str:
    return spec.prompt[span.start : span.end]


def _short(value: object) -> str:
    if value is None:
        return 'nothing'
    text = repr(value) if isinstance(value, str) else str(value)
    return text if len(text) <= _SHOWN else f'{text[:_SHOWN]}...'
