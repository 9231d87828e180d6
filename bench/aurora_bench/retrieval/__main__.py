# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`python -m aurora_bench.retrieval`: hit rates with words, with vectors, and with both."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence
from importlib.metadata import distribution
from pathlib import Path

from aurora_bench.interrupt import stop_on_sigterm
from aurora_bench.machine import machine_facts
from aurora_bench.progress import Progress
from aurora_bench.results import Cell, ResultsError, Table, markdown_table, write_results
from aurora_bench.retrieval.measure import (
    DEPTHS,
    Outcome,
    hit_rate,
    mean_reciprocal_rank,
    measure,
)
from aurora_bench.retrieval.queries import KINDS, read_set
from aurora_core.retrieval.ranking import LexicalRanker, MakeRanker
from aurora_llm.embedding import rankers
from aurora_llm.settings import load_model_settings

_PACKAGES = ('bm25s', 'wordllama')


def main(arguments: Sequence[str] | None = None) -> int:
    """Measure; return 0, or 64 when the queries do not fit the records."""
    stop_on_sigterm()
    parser = argparse.ArgumentParser(prog='aurora_bench.retrieval', description=__doc__)
    parser.add_argument('--results', type=Path, default=None, help='folder for JSON and Markdown')
    options = parser.parse_args(arguments)
    machine = machine_facts()
    try:
        queries, records = read_set()
    except ResultsError as err:
        sys.stderr.write(f'{err}\n')
        return 64
    fusion_k = load_model_settings().retrieval.fusion_k
    ways = _ways()
    progress = Progress('retrieval', len(ways))
    outcomes = []
    for name, makers in ways.items():
        outcome = measure(name, makers, queries, records, fusion_k)
        outcomes.append(outcome)
        progress.step(f'{name}: hit@1 {hit_rate(outcome.found, 1):.3f}')
    sizes = {name: _installed_mib(name) for name in _PACKAGES}
    tables = (*_tables(outcomes), _size_table(sizes))
    sys.stdout.write('\n\n'.join(markdown_table(table) for table in tables) + '\n')
    if options.results is not None:
        document = {
            'queries': len(queries),
            'records': {kind.value: sum(r.kind is kind for r in records) for kind in KINDS},
            'fusion_k': fusion_k,
            'installed_mib': sizes,
            'ways': {o.name: _as_json(o) for o in outcomes},
        }
        _, written = write_results(
            options.results,
            'retrieval',
            document,
            title='Retrieval of records by paraphrase',
            tables=tables,
            notes=(_missed(outcomes[-1]),),
            machine=machine,
        )
        progress.note(f'see {written}')
    return 0


def _ways() -> dict[str, tuple[MakeRanker, ...]]:
    """Return the ways to compare; the product's own is the last."""
    ways: dict[str, tuple[MakeRanker, ...]] = {'words': (LexicalRanker,)}
    both = rankers(embedding=True)
    if len(both) > 1:
        ways |= {'vectors': both[1:], 'words and vectors, fused': both}
    return ways


def _tables(outcomes: Sequence[Outcome]) -> tuple[Table, ...]:
    headings = ('way', 'kind', 'queries', *(f'hit@{d}' for d in DEPTHS), 'MRR')
    rows: list[tuple[Cell, ...]] = []
    for outcome in outcomes:
        for kind in (None, *KINDS):
            found = [f for f in outcome.found if kind in (None, f.query.kind)]
            rates = [round(hit_rate(found, depth), 3) for depth in DEPTHS]
            mrr = round(mean_reciprocal_rank(found), 3)
            name = 'all' if kind is None else kind.value
            rows.append((outcome.name, name, len(found), *rates, mrr))
    times = tuple((o.name, round(o.build_ms, 2), round(o.query_ms, 3)) for o in outcomes)
    return (
        Table(headings=headings, rows=rows, caption='Each query is ranked within its kind.'),
        Table(headings=('way', 'making the index [ms]', 'one query [ms]'), rows=times),
    )


def _size_table(sizes: dict[str, float]) -> Table:
    return Table(headings=('package', 'installed [MiB]'), rows=tuple(sizes.items()))


def _as_json(outcome: Outcome) -> dict[str, object]:
    return {
        'hit': {str(depth): hit_rate(outcome.found, depth) for depth in DEPTHS},
        'mrr': mean_reciprocal_rank(outcome.found),
        **outcome.model_dump(mode='json', exclude={'name'}),
    }


def _missed(outcome: Outcome) -> str:
    late = [f for f in outcome.found if f.rank is None or f.rank > DEPTHS[-1]]
    told = '; '.join(f'"{f.query.query}" ({f.query.wanted}: {f.rank})' for f in late)
    return f'Not among the first {DEPTHS[-1]} with {outcome.name}: {told or "none"}.'


def _installed_mib(package: str) -> float:
    try:
        files = distribution(package).files or ()
    except ModuleNotFoundError:
        return 0.0
    paths = (Path(str(file.locate())) for file in files)
    return round(sum(path.stat().st_size for path in paths if path.is_file()) / 2**20, 1)


if __name__ == '__main__':
    sys.exit(main())
