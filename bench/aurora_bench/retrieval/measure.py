# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Hit rates, mean reciprocal rank and time of one way to retrieve."""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence

from pydantic import NonNegativeFloat

from aurora_bench.retrieval.queries import Query
from aurora_core.document import Document
from aurora_core.retrieval.ranking import MakeRanker
from aurora_core.retrieval.record import Record
from aurora_core.retrieval.retriever import Retriever

DEPTHS = (1, 3, 5)


class Found(Document):
    """Where the wanted record of a query stood; None: it was not like the query at all."""

    query: Query
    rank: int | None


class Outcome(Document):
    """What one way to retrieve gave.

    Attributes:
        build_ms: Making the index.
        query_ms: Median time of one query within one kind.
    """

    name: str
    found: tuple[Found, ...]
    build_ms: NonNegativeFloat
    query_ms: NonNegativeFloat


def measure(
    name: str,
    makers: Sequence[MakeRanker],
    queries: Sequence[Query],
    records: Sequence[Record],
    fusion_k: float,
    clock: Callable[[], float] = time.perf_counter,
) -> Outcome:
    """Ask every query once."""
    begin = clock()
    retriever = Retriever(records, makers, fusion_k)
    build_s = clock() - begin
    found, times = [], []
    for query in queries:
        begin = clock()
        ranked = retriever.rank(query.query, query.kind)
        times.append(clock() - begin)
        ids = [record.id for record, _ in ranked]
        rank = ids.index(query.wanted) + 1 if query.wanted in ids else None
        found.append(Found(query=query, rank=rank))
    return Outcome(
        name=name,
        found=tuple(found),
        build_ms=build_s * 1e3,
        query_ms=sorted(times)[len(times) // 2] * 1e3,
    )


def hit_rate(found: Sequence[Found], depth: int) -> float:
    """Return the share of queries whose record is among the first `depth`."""
    return sum(1 for f in found if f.rank is not None and f.rank <= depth) / len(found)


def mean_reciprocal_rank(found: Sequence[Found]) -> float:
    """Return the mean of 1 / rank, 0 where the record was not found."""
    return sum(1.0 / f.rank for f in found if f.rank is not None) / len(found)
