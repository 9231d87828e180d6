# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The retrieval benchmark: its queries, its figures, its files."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from aurora_bench.retrieval.__main__ import main
from aurora_bench.retrieval.measure import Found, hit_rate, mean_reciprocal_rank
from aurora_bench.retrieval.queries import KINDS, Query, read_set


def found(*ranks: int | None) -> list[Found]:
    query = Query(kind=KINDS[0], wanted='car', query='auto')
    return [Found(query=query, rank=rank) for rank in ranks]


def test_figures_by_hand() -> None:
    ranks = found(1, 2, 4, None)
    assert [hit_rate(ranks, depth) for depth in (1, 3, 5)] == [0.25, 0.5, 0.75]
    assert mean_reciprocal_rank(ranks) == pytest.approx((1 + 1 / 2 + 1 / 4) / 4)


def test_at_least_sixty_queries_over_all_kinds_none_twice() -> None:
    queries, _ = read_set()
    assert len(queries) >= 60
    assert {query.kind for query in queries} == set(KINDS)
    assert len({query.query for query in queries}) == len(queries)


def test_results_are_written(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(['--results', str(tmp_path)]) == 0
    document = json.loads((tmp_path / 'retrieval.json').read_text(encoding='utf-8'))
    words = document['ways']['words']
    assert 0.3 < words['hit']['1'] <= words['hit']['3'] <= words['hit']['5'] <= 1.0
    assert 'hit@1' in (tmp_path / 'retrieval.md').read_text(encoding='utf-8')
    assert 'hit@5' in capsys.readouterr().out
