# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`python -m aurora_bench.judged [FILE…]`: what requests state and no condition depends on.

Every prompt is read by the offline parser and grounded; nothing is simulated. Each explicit number
and stated choice is then changed in turn: it is judged when a condition changes with it. What is
not is counted by field; the product calls its clause `not_judged`.
"""

from __future__ import annotations

import argparse
import sys
from collections import Counter
from collections.abc import Sequence
from contextlib import closing
from pathlib import Path

from aurora_bench.interrupt import stop_on_sigterm
from aurora_bench.judged.sweep import Asked, Found, Sweep
from aurora_bench.machine import machine_facts
from aurora_bench.progress import Progress
from aurora_bench.prompts.reading import read_prompts
from aurora_bench.prompts.shipped import first_files
from aurora_bench.results import ResultsError, Table, markdown_table, write_results
from aurora_cli.pool import Lost, run_tasks

# Searching a place for a crowd takes long on a slow machine.
_LIMIT_S = 600.0


def main(arguments: Sequence[str] | None = None) -> int:
    """Sweep files; return 0, 64 when one cannot be read, 1 when a prompt could not be asked."""
    stop_on_sigterm()
    parser = argparse.ArgumentParser(prog='aurora_bench.judged', description=__doc__)
    parser.add_argument('files', nargs='*', type=Path, default=first_files('tune'), metavar='FILE')
    parser.add_argument('--map', default='downtown')
    parser.add_argument('--seed', type=int, default=1)
    parser.add_argument('--jobs', type=int, default=1, help='worker processes')
    parser.add_argument('--results', type=Path, default=None, help='folder for JSON and Markdown')
    parser.add_argument('--name', default='judged', help='of the files of results')
    options = parser.parse_args(arguments)
    machine = machine_facts()
    try:
        prompts = [p for path in options.files for p in read_prompts(path)]
    except ResultsError as err:
        sys.stderr.write(f'{err}\n')
        return 64
    tasks = [Asked(id=p.id, prompt=p.prompt) for p in prompts]
    progress = Progress('judged', len(tasks))
    found: dict[int, Found] = {}
    lost: dict[str, str] = {}
    work = Sweep(options.map, options.seed)
    with closing(run_tasks(work, tasks, jobs=options.jobs, limit_s=_LIMIT_S)) as results:
        for index, result in results:
            if isinstance(result, Lost):
                lost[tasks[index].id] = result.why
            else:
                found[index] = result
            told = result.why if isinstance(result, Lost) else ', '.join(result.open)
            progress.step(f'{tasks[index].id}: {told or "-"}')
    swept = [found[k] for k in sorted(found)]
    shown = (_outcomes(swept), _fields(swept))
    sys.stdout.write('\n\n'.join(markdown_table(table) for table in shown) + '\n\n')
    line = _last_line(swept)
    if options.results is not None:
        names = [f'{path.parent.name}/{path.name}' for path in options.files]
        document = {
            'files': names,
            'lost': lost,
            'prompts': {tasks[k].id: found[k].model_dump() for k in sorted(found)},
        }
        write_results(
            options.results,
            options.name,
            document,
            title=f'Stated and judged: {", ".join(names)}',
            tables=shown,
            notes=(f'`{line}`',),
            machine=machine,
        )
    sys.stdout.write(f'{line}\n')
    return 1 if lost else 0


def _outcomes(results: Sequence[Found]) -> Table:
    counts = Counter(r.outcome for r in results)
    rows = tuple((name, str(number)) for name, number in sorted(counts.items()))
    return Table(headings=('outcome', 'prompts'), rows=rows, caption='Prompts')


def _fields(results: Sequence[Found]) -> Table:
    silent = Counter(name for r in results for name in r.open)
    admitted = Counter(name for r in results for name in r.admitted)
    rows = tuple(
        (name, str(silent[name]), str(admitted[name]))
        for name in sorted({*silent, *admitted}, key=lambda n: (-silent[n], n))
    )
    return Table(
        headings=('field', 'not judged', 'not carried out'),
        rows=rows,
        caption='Fields that no condition depends on',
    )


def _last_line(results: Sequence[Found]) -> str:
    stated = sum(r.stated for r in results)
    silent = sum(len(r.open) for r in results)
    prompts = sum(bool(r.open) for r in results)
    return f'stated {stated}  judged by nothing {silent}  in {prompts} prompts'


if __name__ == '__main__':
    sys.exit(main())
