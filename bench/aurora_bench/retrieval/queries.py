# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The queries of `queries.yaml` and the records that they are looked for in."""

from __future__ import annotations

from importlib.resources import files

import yaml

from aurora_bench.results import ResultsError
from aurora_cli.installed import installed
from aurora_core.document import Document
from aurora_core.outcomes.retrieval import RecordKind
from aurora_core.pipeline.background import map_records
from aurora_core.retrieval.episodes import Episode
from aurora_core.retrieval.record import Record

MAP = 'downtown'
KINDS = (RecordKind.ASSET, RecordKind.SPAWN, RecordKind.EPISODE)


class Query(Document):
    """Words, and the id of the record that they are about."""

    kind: RecordKind
    wanted: str
    query: str


def read_set() -> tuple[tuple[Query, ...], tuple[Record, ...]]:
    """Return queries and records.

    Raises:
        ResultsError: A query wants a record that is not there.
    """
    text = files('aurora_bench.retrieval').joinpath('queries.yaml').read_text(encoding='utf-8')
    data = yaml.safe_load(text)
    episodes = [_episode(name, prompt).record() for name, prompt in data['episodes'].items()]
    records = (*map_records(installed(), MAP), *episodes)
    queries = tuple(Query(kind=kind, **row) for kind in KINDS for row in data[kind.value])
    known = {(record.kind, record.id) for record in records}
    lacking = [query.wanted for query in queries if (query.kind, query.wanted) not in known]
    if lacking:
        raise ResultsError(f'queries.yaml wants records that are not there: {lacking}')
    return queries, records


def _episode(name: str, prompt: str) -> Episode:
    return Episode(
        id=name,
        prompt=prompt,
        map_name=MAP,
        status='verified',
        elements=(),
        conditions=(),
        worst_normalised=None,
        trace_sha256='',
    )
