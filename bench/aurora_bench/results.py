# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Results of a benchmark or campaign: one JSON file and one Markdown file, each written whole.

```python
write_results(
    folder,
    'endurance',
    {'rounds': 20, 'leaks': 0},
    title='Endurance',
    goals=(Goal(name='rounds without a leak', target='= 20', figure='20', met=True),),
    tables=(Table(headings=('round', 'memory [MiB]'), rows=((1, 210.5),)),),
)
```
"""

from __future__ import annotations

import os
import sys
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from aurora_bench.machine import Machine, machine_facts
from aurora_core.document import Document
from aurora_core.errors import AuroraError
from aurora_core.report.run_folder import json_text

RESULTS_VERSION = 1

Cell = str | int | float | bool | None


class ResultsError(AuroraError):
    """Results cannot be written."""

    default_component = 'bench'


class Goal(Document):
    """Something that must hold, and what was found.

    Attributes:
        name: What is asked.
        target: The bound in words, e.g. "at least 40".
        figure: What was found, e.g. "51.3"; "not measured" when it was not.
        met: None when that cannot be said.
    """

    name: str
    target: str
    figure: str
    met: bool | None


@dataclass(frozen=True, kw_only=True)
class Table:
    """A Markdown table; columns of numbers are aligned to the right.

    Attributes:
        headings: One per column.
        rows: Cells; a float is written with 4 significant digits, None as a dash.
        caption: A line above the table.
    """

    headings: Sequence[str]
    rows: Sequence[Sequence[Cell]]
    caption: str = ''

    def __post_init__(self) -> None:
        for row in self.rows:
            if len(row) != len(self.headings):
                raise ResultsError(
                    f'expected {len(self.headings)} cells in a row of the table, found {len(row)}'
                )


def write_results(
    folder: Path,
    name: str,
    results: Mapping[str, Any],
    *,
    title: str,
    tables: Sequence[Table] = (),
    goals: Sequence[Goal] = (),
    notes: Sequence[str] = (),
    machine: Machine | None = None,
) -> tuple[Path, Path]:
    """Write `<name>.json` and `<name>.md` with the facts of the machine.

    Args:
        folder: Made if it is not there.
        name: Of the benchmark.
        results: Plain JSON values.
        title: Heading of the Markdown file.
        tables: Into the Markdown file.
        goals: Into both files.
        notes: Paragraphs for the Markdown file, after the tables.
        machine: Facts taken at the beginning; None takes them now.

    Returns:
        Path of the JSON file and of the Markdown file.

    Raises:
        ResultsError: A file cannot be written.
        ReportError: A value has no JSON form (NaN, infinity, an object).
    """
    facts = machine_facts() if machine is None else machine
    document = {
        'benchmark': name,
        'results_version': RESULTS_VERSION,
        'machine': facts.model_dump(mode='json'),
        'goals': [goal.model_dump(mode='json') for goal in goals],
        **results,
    }
    sections = [f'# {title}', machine_line(facts)]
    if goals:
        sections.append(markdown_table(goal_table(goals)))
    for table in tables:
        sections.append(markdown_table(table))
    sections += notes
    json_file, markdown_file = folder / f'{name}.json', folder / f'{name}.md'
    write_whole(json_file, json_text(document).encode('utf-8'))
    write_whole(markdown_file, ('\n\n'.join(sections) + '\n').encode('utf-8'))
    return json_file, markdown_file


def write_whole(path: Path, data: bytes) -> None:
    """Write a file under a temporary name and rename it: a reader never sees a part of it.

    Raises:
        ResultsError: It cannot be written; what was there before stays.
    """
    temporary = path.with_name(f'.writing-{os.getpid()}-{path.name}')
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        try:
            with temporary.open('wb') as stream:
                stream.write(data)
                stream.flush()
                os.fsync(stream.fileno())
            temporary.replace(path)
        finally:
            temporary.unlink(missing_ok=True)
    except OSError as err:
        raise ResultsError(
            f'{path} cannot be written: {err.strerror or err}',
            hint='choose a folder that you may write with --results',
        ) from err


def goal_table(goals: Sequence[Goal]) -> Table:
    """Return the goals as a table."""
    words = {True: 'met', False: 'NOT MET', None: 'not judged'}
    return Table(
        headings=('goal', 'target', 'found', ''),
        rows=tuple((goal.name, goal.target, goal.figure, words[goal.met]) for goal in goals),
    )


def told_goals(goals: Sequence[Goal]) -> int:
    """Say on standard error how each goal came out; return the exit code, 1 where one is not."""
    for goal in goals:
        sys.stderr.write(f'{goal.name}: {goal.figure} (target {goal.target})\n')
    return int(any(goal.met is False for goal in goals))


def markdown_table(table: Table) -> str:
    """Return a table as Markdown that is readable as plain text too."""
    cells = [[cell_text(cell) for cell in row] for row in table.rows]
    texts = [[_escaped(heading) for heading in table.headings], *cells]
    widths = [max(3, *(len(row[k]) for row in texts)) for k in range(len(table.headings))]
    right = [
        bool(table.rows) and all(_is_number(row[k]) for row in table.rows)
        for k in range(len(table.headings))
    ]
    rule = [('-' * (w - 1) + ':') if r else '-' * w for w, r in zip(widths, right, strict=True)]
    lines = []
    for row in (texts[0], rule, *texts[1:]):
        padded = [
            text.rjust(width) if is_right else text.ljust(width)
            for text, width, is_right in zip(row, widths, right, strict=True)
        ]
        lines.append('| ' + ' | '.join(padded) + ' |')
    if table.caption:
        lines = [table.caption, '', *lines]
    return '\n'.join(lines)


def machine_line(machine: Machine) -> str:
    """Return the facts of a machine as one line."""
    load = ', '.join(f'{value:.1f}' for value in machine.load_average)
    return (
        f'{machine.date_utc} · {machine.cores} cores, {machine.cpu} · '
        f'{machine.memory_mib / 1024:.0f} GiB · {machine.system} · Python {machine.python} · '
        f'load average {load}'
    )


def cell_text(cell: Cell) -> str:
    """Return a cell as text: 4 significant digits, yes and no, a dash for nothing."""
    if cell is None:
        return '–'
    if isinstance(cell, bool):
        return 'yes' if cell else 'no'
    if isinstance(cell, float):
        return f'{cell:.0f}' if abs(cell) >= 1000.0 else f'{cell:.4g}'
    return _escaped(str(cell))


def _escaped(text: str) -> str:
    return text.replace('|', '\\|').replace('\n', ' ')


def _is_number(cell: Cell) -> bool:
    return cell is None or (isinstance(cell, int | float) and not isinstance(cell, bool))
