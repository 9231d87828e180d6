# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`aurora bench feasibility`: requests on both sides of every limit, refused or not, and why.

Hand-made families (`families.yaml`) are read from their words and built from their annotation;
feasible requests of the shipped prompts are pushed over one limit at a time (`pushes.py`). With
`--references` every feasible reference is checked as it is: none may be refused.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

from aurora_bench.feasibility.corrupt import Corrupted, corrupted
from aurora_bench.feasibility.families import Case, family_cases, typed_cases
from aurora_bench.feasibility.judge import Judged, judged
from aurora_bench.feasibility.pushes import push_cases
from aurora_bench.machine import machine_facts
from aurora_bench.progress import Progress
from aurora_bench.prompts.reading import read_prompts
from aurora_bench.prompts.reference_names import NotExpressibleError
from aurora_bench.prompts.reference_spec import reference_spec
from aurora_bench.prompts.shipped import tune_files
from aurora_bench.results import Goal, Table, markdown_table, write_results
from aurora_bench.rulers.runs import on_map
from aurora_cli.installed import installed
from aurora_core.spec.scenario import ScenarioSpec

# Who says it: the offline reader, or a specification.
_READ = ('prompt', 'typed', 'second')
_SOURCES = (*_READ, 'annotation', 'push', 'reference')


def main(arguments: Sequence[str] | None = None) -> int:
    """Measure, print tables and goals; return 0 when every goal is met, else 1."""
    parser = argparse.ArgumentParser(prog='aurora bench feasibility', description=__doc__)
    parser.add_argument('--map', default='downtown')
    parser.add_argument('--each', type=int, default=6, help='requests per push')
    parser.add_argument('--corrupted', type=int, default=200, help='corrupted certificates')
    parser.add_argument('--seed', type=int, default=1, help='of the corruptions')
    parser.add_argument('--references', action='store_true', help='check every reference as it is')
    parser.add_argument('--results', type=Path, default=None, help='folder for JSON and Markdown')
    parser.add_argument('--name', default='feasibility', help='of the files of results')
    options = parser.parse_args(arguments)
    known = installed()
    known.map(options.map)
    references = tuple(_references(options.map))
    cases = [*family_cases(), *typed_cases(), *push_cases(references, options.each)]
    if options.references:
        cases += [Case(id=i, source='reference', prompt=s.prompt, because=(), spec=s)
                  for i, s in references]  # fmt: skip
    progress = Progress('feasibility', len(cases))
    results = []
    for case in cases:
        result = judged(known, options.map, case)
        results.append(result)
        progress.step(f'{case.source} {case.id}: {result.said} {", ".join(result.reasons)}')
    broken = corrupted(results, options.corrupted, options.seed)
    goals, tables = _goals(results, broken), (_totals(results), _reasons(results), _wrong(results))
    for table in tables:
        sys.stdout.write(f'{markdown_table(table)}\n\n')
    for bad in (b for b in broken if b.accepted):
        sys.stdout.write(f'accepted though corrupted: {bad.id}: {bad.what}\n')
    for goal in goals:
        word = 'met' if goal.met else 'NOT MET'
        sys.stdout.write(f'{goal.name}: {goal.figure} (goal {goal.target}; {word})\n')
    if options.results is not None:
        write_results(
            options.results,
            options.name,
            {'map': options.map, 'cases': [_document(r) for r in results]},
            title='Feasible or not, with proofs',
            goals=goals,
            tables=tables,
            machine=machine_facts(),
        )
    return 0 if all(goal.met for goal in goals) else 1


def _references(map_name: str) -> Iterator[tuple[str, ScenarioSpec]]:
    """Yield what the feasible prompts to tune on say, without a reader."""
    for path in tune_files():
        for prompt in read_prompts(path):
            try:
                yield prompt.id, on_map(reference_spec(prompt, judged=True), map_name)
            except NotExpressibleError:
                continue


def _share(part: int, whole: int) -> str:
    return f'{part} of {whole} ({part / whole:.3f})' if whole else 'none'


def _goals(results: Sequence[Judged], broken: Sequence[Corrupted]) -> tuple[Goal, ...]:
    over = [r for r in results if r.case.must_be_refused]
    kept = [r for r in results if not r.case.must_be_refused]
    refused = [r for r in over if r.refused]
    false = sum(r.refused for r in kept)
    proofs = [valid for r in results for valid in r.valid]
    seconds = sorted(r.check_s for r in results)
    busy = sorted(r.check_cpu_s for r in results)
    rejected = sum(not b.accepted for b in broken)
    wrong = sum(not r.right_reason for r in refused)
    return (
        Goal(
            name='refused of what cannot be',
            target='at least 0.98',
            figure=_share(len(refused), len(over)),
            met=len(refused) >= 0.98 * len(over),
        ),
        Goal(
            name='refused of what can be',
            target='at most 0.01',
            figure=_share(false, len(kept)),
            met=false <= 0.01 * len(kept),
        ),
        Goal(name='refused for another reason', target='none', figure=str(wrong), met=wrong == 0),
        Goal(
            name='certificates that the re-check accepts',
            target='all',
            figure=_share(sum(proofs), len(proofs)),
            met=all(proofs),
        ),
        Goal(
            name='corrupted certificates that it rejects',
            target='all',
            figure=_share(rejected, len(broken)),
            met=rejected == len(broken),
        ),
        Goal(
            name='seconds per verdict (p50, p99, max)',
            target='at most 2',
            figure=_quantiles(seconds),
            met=seconds[-1] <= 2.0,
        ),
        Goal(
            name='processor seconds per verdict (p50, p99, max)',
            target='at most 2',
            figure=_quantiles(busy),
            met=busy[-1] <= 2.0,
        ),
    )


def _quantiles(ordered: Sequence[float]) -> str:
    return ', '.join(f'{_quantile(ordered, q):.4f}' for q in (0.5, 0.99, 1.0))


def _quantile(ordered: Sequence[float], share: float) -> float:
    return ordered[min(len(ordered) - 1, int(share * len(ordered)))]


def _totals(results: Sequence[Judged]) -> Table:
    rows = []
    for source in _SOURCES:
        over = [r for r in results if r.case.source == source and r.case.must_be_refused]
        kept = [r for r in results if r.case.source == source and not r.case.must_be_refused]
        if over or kept:
            unread = sum(r.said == 'not read' for r in (*over, *kept))
            refused = sum(r.refused for r in over)
            false = sum(r.refused for r in kept)
            rows.append((source, len(over), refused, len(kept), false, unread))
    return Table(
        headings=('source', 'cannot be', 'refused', 'can be', 'refused though', 'not read'),
        rows=rows,
        caption='Requests',
    )


def _reasons(results: Sequence[Judged]) -> Table:
    rows = []
    for reason in sorted({r.case.because[0] for r in results if r.case.must_be_refused}):
        over = [r for r in results if r.case.because[:1] == (reason,)]
        right = sum(r.refused and r.right_reason for r in over)
        rows.append((reason, len(over), sum(r.refused for r in over), right))
    return Table(
        headings=('reason', 'cannot be', 'refused', 'for that reason'),
        rows=rows,
        caption='By reason',
    )


def _wrong(results: Sequence[Judged]) -> Table:
    rows = [
        (f'{r.case.source} {r.case.id}', '/'.join(r.case.because) or 'can be',
         ' '.join((r.said, *r.reasons)))
        for r in results
        if r.refused is not r.case.must_be_refused or (r.refused and not r.right_reason)
        or not all(r.valid)
    ]  # fmt: skip
    return Table(headings=('request', 'expected', 'said'), rows=rows, caption='Not as it should')


def _document(result: Judged) -> dict[str, Any]:
    return {
        'id': result.case.id,
        'source': result.case.source,
        'prompt': result.case.prompt,
        'because': list(result.case.because),
        'said': result.said,
        'reasons': list(result.reasons),
        'valid': list(result.valid),
        'check_s': round(result.check_s, 4),
        'check_cpu_s': round(result.check_cpu_s, 4),
    }


if __name__ == '__main__':
    sys.exit(main())
