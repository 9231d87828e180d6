# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Select the records of each kind that fit a prompt, and keep the scores."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from aurora_core.outcomes.retrieval import Hit, RecordKind, Retrieval
from aurora_core.retrieval.ranking import MakeRanker, fuse, ranks
from aurora_core.retrieval.record import Record, corpus_sha256

_KEPT = 10  # per kind, in what is archived


class Retriever:
    """An index over the records of one map and one history.

    Args:
        records: Those that may be selected; each kind is ranked by itself.
        makers: One per ranker.
        fusion_k: Constant of reciprocal rank fusion.
    """

    def __init__(
        self, records: Sequence[Record], makers: Sequence[MakeRanker], fusion_k: float
    ) -> None:
        self._by_kind = {
            kind: sorted((r for r in records if r.kind is kind), key=lambda r: r.id)
            for kind in RecordKind
        }
        self._rankers = {
            kind: [make([record.text for record in rows]) for make in makers]
            for kind, rows in self._by_kind.items()
            if rows
        }
        self._fusion_k = fusion_k
        self._sha256 = corpus_sha256(records)

    def rank(self, query: str, kind: RecordKind) -> tuple[tuple[Record, Hit], ...]:
        """Return the records of a kind that have any likeness to the query, best first."""
        rows = self._by_kind[kind]
        if not rows:
            return ()
        scores = {ranker.name: ranker.scores(query) for ranker in self._rankers[kind]}
        places = {name: ranks(values) for name, values in scores.items()}
        fused = fuse(places, self._fusion_k)
        order = sorted(fused, key=lambda i: (-fused[i], rows[i].id))
        return tuple(
            (
                rows[i],
                Hit(
                    kind=kind,
                    id=rows[i].id,
                    fused=fused[i],
                    ranks={name: place[i] for name, place in places.items() if i in place},
                    scores={name: round(float(v[i]), 6) for name, v in scores.items()},
                    selected=False,
                ),
            )
            for i in order
        )

    def retrieve(
        self, query: str, most: Mapping[RecordKind, int], registries: Sequence[Record] = ()
    ) -> tuple[tuple[Record, ...], Retrieval]:
        """Return the best records of each kind, and the scores of the best.

        Args:
            query: The prompt.
            most: How many of each kind.
            registries: What is shown beside them, for its digest.
        """
        chosen: list[Record] = []
        hits: list[Hit] = []
        for kind in sorted(most):
            for i, (record, hit) in enumerate(self.rank(query, kind)[: max(_KEPT, most[kind])]):
                selected = i < most[kind]
                hits.append(Hit(**{**dict(hit), 'selected': selected}))
                if selected:
                    chosen.append(record)
        names = next(([r.name for r in rankers] for rankers in self._rankers.values()), [])
        retrieval = Retrieval(
            query=query,
            rankers=tuple(names),
            fusion_k=self._fusion_k,
            corpus_sha256=self._sha256,
            registries_sha256=corpus_sha256(registries),
            hits=tuple(hits),
        )
        return tuple(chosen), retrieval
