# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`python -m aurora_bench.fuzz`: damaged prompts and replies (docs/bench/README.md)."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence
from pathlib import Path

from aurora_bench.fuzz.campaign import LIMIT_S, Tally, fuzz_prompts, fuzz_replies
from aurora_bench.interrupt import stop_on_sigterm
from aurora_bench.machine import machine_facts
from aurora_bench.progress import Progress
from aurora_bench.prompts.reading import read_prompts
from aurora_bench.prompts.shipped import first_files
from aurora_bench.results import Goal, Table, goal_table, markdown_table, write_results
from aurora_cli.installed import installed
from aurora_core.pipeline.functions import parse_context

_FIRST = 20


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the campaign; return 1 when any text broke a promise."""
    stop_on_sigterm()
    parser = argparse.ArgumentParser(prog='aurora_bench.fuzz', description=__doc__)
    parser.add_argument('--prompts', type=int, default=20_000, help='mutated prompts')
    parser.add_argument('--replies', type=int, default=5_000, help='mutated model replies')
    parser.add_argument(
        '--seed', type=int, default=1, help='of the first text; then one more each'
    )
    parser.add_argument('--results', type=Path, default=None, help='folder for JSON and Markdown')
    options = parser.parse_args(arguments)
    machine = machine_facts()
    progress = Progress('fuzz')
    originals = [p.prompt for path in first_files('tune') for p in read_prompts(path)]
    context = parse_context(installed(), 'downtown', 1)
    read = fuzz_prompts(originals, context, options.prompts, options.seed, progress.note)
    judged = fuzz_replies(context, options.replies, options.seed, progress.note)
    halves = {'prompts': read, 'replies': judged}
    goals = tuple(_goal(name, what, half) for name, half in halves.items() for what in _PROMISES)
    tables = tuple(t for name, half in halves.items() for t in _tables(name, half))
    sys.stdout.write(markdown_table(goal_table(goals)) + '\n')
    if options.results is not None:
        _, written = write_results(
            options.results,
            'fuzz',
            {
                'seed': options.seed,
                'limit_s': LIMIT_S,
                **{name: half.model_dump(mode='json') for name, half in halves.items()},
            },
            title='Damaged prompts and damaged model replies',
            goals=goals,
            tables=tables,
            machine=machine,
        )
        progress.note(f'see {written}')
    return 1 if read.failures or judged.failures else 0


_PROMISES = {
    'crash': 'crashes',
    'hang': f'longer than {LIMIT_S:g} s of processor time',
    'numbers': 'numbers invented, changed or dropped in silence',
}


def _goal(name: str, what: str, half: Tally) -> Goal:
    found = sum(f.what == what for f in half.failures)
    return Goal(
        name=f'{name}: {_PROMISES[what]}',
        target=f'0 of {half.tried}',
        figure=str(found),
        met=found == 0,
    )


def _tables(name: str, half: Tally) -> tuple[Table, ...]:
    shown: list[Table] = [
        Table(
            headings=('answer', 'number'),
            rows=tuple(half.outcomes.items()),
            caption=f'{name}: {half.tried} tried, the slowest took {half.slowest_s:.2f} s',
        ),
        Table(headings=('mutation', 'number'), rows=tuple(half.mutations.items())),
    ]
    if half.failures:
        rows = tuple(
            (f.seed, f.what, f.detail, repr(f.text[:120])) for f in half.failures[:_FIRST]
        )
        shown.append(
            Table(
                headings=('seed', 'what', 'detail', 'text'),
                rows=rows,
                caption=f'{name}: the first failures',
            )
        )
    return tuple(shown)


if __name__ == '__main__':
    sys.exit(main())
