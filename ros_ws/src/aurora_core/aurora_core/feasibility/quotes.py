# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Which clauses of the prompt exclude each other: a proof in the user's own words."""

from __future__ import annotations

from collections.abc import Iterator

from aurora_core.document import Document
from aurora_core.outcomes.feasibility import Certificate, FactSource
from aurora_core.spec.parameter import Parameter, Span
from aurora_core.spec.scenario import ScenarioSpec
from aurora_core.spec.vocabulary import ClauseStatus

# Joins two things and says nothing of either.
_JOINS = 'and'


def with_clauses(spec: ScenarioSpec, certificate: Certificate) -> Certificate:
    """Return a certificate with the clauses that it rests on, in the order of the prompt.

    Args:
        spec: The request that is refused.
        certificate: Why; its facts and bounds say what it needs, and nothing that it does not.
    """
    spans = {_clause(spec, span) for path in paths_of(certificate) for span in _spans(spec, path)}
    ordered = sorted(spans, key=lambda s: (s.start, s.end))
    told = tuple(spec.prompt[s.start : s.end] for s in ordered)
    return certificate.model_copy(update={'clauses': tuple(t for t in told if t.strip())})


def rests_on_unread(spec: ScenarioSpec, certificate: Certificate) -> bool:
    """Tell whether a proof rests on a number that stands in words which were not understood.

    `12 m above it`, read as a height above ground: whoever reads admits it, and it proves nothing.
    """
    unread = list(unread_spans(spec))
    numbers = (at for path in paths_of(certificate) for at in _spans(spec, path, numbers=True))
    return any(u.start <= at.start and at.end <= u.end for at in numbers for u in unread)


def unread_spans(spec: ScenarioSpec) -> Iterator[Span]:
    """Yield the words of the prompt that were not understood.

    A lone `and` is none: what it joins was read, or is told of by itself.
    """
    for clause in spec.clauses:
        if clause.status is ClauseStatus.NOT_ENCODED and clause.text.lower() != _JOINS:
            yield clause.span


def paths_of(certificate: Certificate) -> Iterator[str]:
    """Yield the paths of the request that a proof names."""
    yield certificate.path
    yield from (bound.of for bound in certificate.chain)
    yield from (f.path for f in certificate.facts if f.source is FactSource.REQUEST)


def _spans(spec: ScenarioSpec, path: str, *, numbers: bool = False) -> Iterator[Span]:
    """Yield where the prompt says what stands at a path, or else what that is part of.

    Args:
        spec: The request.
        path: Of an element, or of a part of one.
        numbers: Only where a number stands there.
    """
    node: object = spec
    found: Span | None = None
    for part in path.split('/'):
        node = inside(node, part)
        span = getattr(node, 'span', None)
        found = span if isinstance(span, Span) else found
    if found is not None and (isinstance(node, Parameter) or not numbers):
        yield found


def inside(node: object, part: str) -> object:
    """Return what is called so inside a part of a request: a field, an id, an index."""
    if isinstance(node, tuple):
        named = next((e for e in node if getattr(e, 'id', None) == part), None)
        if named is None and part.isdigit() and int(part) < len(node):
            return node[int(part)]
        return named
    return getattr(node, part, None) if isinstance(node, Document) else None


def _clause(spec: ScenarioSpec, span: Span) -> Span:
    """Return the smallest clause that holds words; those of two clauses stand for themselves."""
    around = [
        c.span
        for c in spec.clauses
        if c.status is not ClauseStatus.NOT_ENCODED
        and c.span.start <= span.start
        and span.end <= c.span.end
    ]
    return min(around, key=lambda s: s.end - s.start, default=span)
