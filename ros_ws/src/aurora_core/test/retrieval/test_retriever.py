# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What is selected, and what is archived about it."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import pytest

from aurora_core.outcomes.retrieval import RecordKind
from aurora_core.retrieval.ranking import FloatArray, LexicalRanker
from aurora_core.retrieval.record import Record
from aurora_core.retrieval.retriever import Retriever

MOST = {RecordKind.ASSET: 1, RecordKind.SPAWN: 2}


class Longest:
    """Likes long texts, whatever the query."""

    name = 'longest'

    def __init__(self, texts: Sequence[str]) -> None:
        self._texts = texts

    def scores(self, query: str) -> FloatArray:
        return np.array([float(len(text)) for text in self._texts])


def record(kind: RecordKind, name: str, text: str) -> Record:
    return Record(kind=kind, id=name, text=text, source='test', data={'text': text})


RECORDS = (
    record(RecordKind.ASSET, 'car', 'car, taxi'),
    record(RecordKind.ASSET, 'bus', 'bus, coach'),
    record(RecordKind.SPAWN, 'hall', 'city hall'),
    record(RecordKind.SPAWN, 'stop', 'bus stop at the city hall'),
    record(RecordKind.SPAWN, 'park', 'a park with many very old trees'),
)


def test_each_kind_is_selected_by_itself() -> None:
    retriever = Retriever(RECORDS, [LexicalRanker], 60.0)
    chosen, retrieval = retriever.retrieve('a bus at the city hall', MOST)
    assert [r.id for r in chosen] == ['bus', 'stop', 'hall']
    assert [h.id for h in retrieval.hits if h.selected] == ['bus', 'stop', 'hall']
    assert retrieval.query == 'a bus at the city hall'


def test_two_rankers_are_fused_and_both_are_archived() -> None:
    retriever = Retriever(RECORDS, [LexicalRanker, Longest], 60.0)
    chosen, retrieval = retriever.retrieve('the city hall', MOST)
    hits = {h.id: h for h in retrieval.hits}
    names = retrieval.rankers
    assert names[1] == 'longest'
    assert hits['park'].ranks == {'longest': 1}
    assert hits['stop'].fused == pytest.approx(1 / 62 + 1 / 62)
    assert [r.id for r in chosen if r.kind is RecordKind.SPAWN] == ['hall', 'stop']
    assert hits['park'].scores == {names[0]: 0.0, 'longest': 31.0}


def test_the_order_of_the_records_does_not_matter() -> None:
    query = 'a bus at the city hall'
    there = Retriever(RECORDS, [LexicalRanker, Longest], 60.0).retrieve(query, MOST)
    back = Retriever(RECORDS[::-1], [LexicalRanker, Longest], 60.0).retrieve(query, MOST)
    assert there == back


def test_digests_follow_the_records() -> None:
    one = Retriever(RECORDS, [LexicalRanker], 60.0).retrieve('bus', MOST)[1]
    other = Retriever(RECORDS[:-1], [LexicalRanker], 60.0).retrieve('bus', MOST)[1]
    shown = Retriever(RECORDS, [LexicalRanker], 60.0).retrieve('bus', MOST, RECORDS[:1])[1]
    assert one.corpus_sha256 != other.corpus_sha256
    assert one.registries_sha256 != shown.registries_sha256


def test_no_record_and_nothing_alike_select_nothing() -> None:
    assert Retriever((), [LexicalRanker], 60.0).retrieve('bus', MOST)[0] == ()
    assert Retriever(RECORDS, [LexicalRanker], 60.0).retrieve('zebra', MOST)[0] == ()
