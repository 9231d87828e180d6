# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`python -m aurora_bench.matrix --results docs/bench`: every word of the catalogue, carried out.

The cells are made from the vocabulary, the format of annotations and the map's landmarks: a word
that is new there is a row here. Exit code: 0; 4 when the campaign broke.
"""

from __future__ import annotations

import argparse
import sys
import tempfile
from collections.abc import Mapping, Sequence
from contextlib import closing
from pathlib import Path

from pydantic import ValidationError

from aurora_bench.interrupt import stop_on_sigterm
from aurora_bench.machine import machine_facts
from aurora_bench.matrix import air, ground, meetings
from aurora_bench.matrix.cells import Cell
from aurora_bench.progress import Progress
from aurora_bench.results import Goal, Table, goal_table, markdown_table, write_results
from aurora_bench.resumable.code import code_digest
from aurora_bench.resumable.journal import Journal, JournalHead, journal_path
from aurora_bench.rulers.readback import read_back_line
from aurora_bench.rulers.runs import RealiseWork
from aurora_bench.rulers.trial import JudgedTrial, Trial, judged_trials
from aurora_cli.installed import installed
from aurora_core.errors import AuroraError

_BROKEN = 4
_MAPS = ('downtown', 'helsinki')
_LIMIT_S = 120.0


def cells_of(map_name: str) -> tuple[Cell, ...]:
    """Return every cell of a map, in a fixed order."""
    model = installed().map(map_name)
    landmark, other = (mark.name for mark in model.landmarks[:2])
    return (
        *ground.behaviours(),
        *ground.triggers(landmark),
        *ground.actions(landmark),
        *ground.relations(landmark),
        *meetings.meetings(landmark),
        *air.missions(landmark),
        *air.patterns(landmark),
        *air.sides(),
        *air.links(),
        *air.observers(landmark),
        *air.worlds(landmark),
        *air.zones(landmark, other),
    )


def main(arguments: Sequence[str] | None = None) -> int:
    """Run every cell, write the tables; return the exit code."""
    stop_on_sigterm()
    options = _parser().parse_args(arguments)
    machine = machine_facts()
    asked = [(name, cell) for name in options.maps for cell in cells_of(name)]
    chosen = [(m, c) for m, c in asked if c.ident.startswith(options.only)]
    trials = {_key(m, c): _trial(m, c) for m, c in chosen if c.parts}
    progress = Progress('matrix', len(trials))
    place = options.resume or options.results
    head = JournalHead(campaign='matrix', files={}, options={'code': code_digest()})
    try:
        with (
            tempfile.TemporaryDirectory(prefix='aurora_matrix_') as folder,
            Journal(
                journal_path(place, 'matrix'), head, resume=options.resume is not None
            ) as journal,
        ):
            judged = {
                key: JudgedTrial.model_validate(journal.finished[key])
                for key in trials
                if key in journal.finished
            }
            for name in options.maps:
                left = [t for key, t in trials.items() if t.file == name and key not in judged]
                work = RealiseWork(
                    folder=options.keep or Path(folder), keep=options.keep is not None,
                    map_name=name, repair=0,
                )  # fmt: skip
                runs = judged_trials(work, left, jobs=options.jobs, limit_s=_LIMIT_S)
                with closing(runs) as answers:
                    for index, result in answers:
                        key = left[index].key
                        judged[key] = result
                        journal.add(key, result.model_dump(mode='json'))
                        progress.step(f'{key}: {shown(result)}')
            journal.end()
        goals = goals_of(chosen, judged)
        tables = [t for name in options.maps for t in tables_of(name, chosen, judged)]
        write_results(
            options.results,
            'matrix',
            {'cells': {key: t.model_dump(mode='json') for key, t in judged.items()}},
            title='What the catalogue can say, carried out',
            goals=goals,
            tables=tables,
            notes=(
                'A number is the least normalised margin of a verified run that the independent '
                'checker does not contradict, with its condition; exact counts, what is so or not '
                'and that one phase follows on another have none of their own. Cells of one '
                'word are empty for the reason given.',
                f'`{_placed(judged)}`',
            ),
            machine=machine,
        )
    except AuroraError as err:
        sys.stderr.write(f'matrix: {err.component}: {err}\n')
        return _BROKEN
    sys.stdout.write(''.join(f'{markdown_table(table)}\n\n' for table in tables))
    sys.stdout.write(f'{_placed(judged)}\n')
    sys.stdout.write(markdown_table(goal_table(goals)) + '\n')
    return 0


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(prog='aurora_bench.matrix', description=__doc__)
    parser.add_argument('--maps', nargs='+', default=_MAPS)
    parser.add_argument('--jobs', type=int, default=1)
    parser.add_argument('--only', default='', help='cells whose id begins so')
    parser.add_argument('--results', type=Path, default=Path('docs/bench'), metavar='DIR')
    parser.add_argument('--resume', type=Path, default=None, help='go on with its journal')
    parser.add_argument('--keep', type=Path, default=None, metavar='FOLDER', help='keep the runs')
    return parser


def _placed(judged: Mapping[str, JudgedTrial]) -> str:
    return read_back_line([t.placed for t in judged.values() if t.placed is not None])


def _key(map_name: str, cell: Cell) -> str:
    return f'{map_name}:{cell.ident}'


def _trial(map_name: str, cell: Cell) -> Trial:
    """Return the run of a cell.

    Raises:
        AuroraError: The cell is no valid annotation.
    """
    try:
        prompt = cell.prompt()
    except ValidationError as err:
        raise AuroraError(f'{cell.ident}: {err}') from err
    return Trial(
        key=_key(map_name, cell), file=map_name, prompt=prompt, document=cell.document(), seed=1,
        folder=f'{map_name}/{cell.ident}',
    )  # fmt: skip


def shown(result: JudgedTrial) -> str:
    """Return what a cell shows: the least margin and whose it is, or what did not hold."""
    if result.right:
        return 'yes' if result.margin is None else f'{result.margin:.2g} ({result.margin_of})'
    cause = '' if result.cause is None else result.cause.value
    return f'{cause}: {", ".join(result.words)}' if result.words else cause


def goals_of(
    asked: Sequence[tuple[str, Cell]], judged: Mapping[str, JudgedTrial]
) -> tuple[Goal, ...]:
    """Return what is asked of the matrix, and what was found."""
    goals = []
    for name in dict.fromkeys(m for m, _ in asked):
        cells = [c for m, c in asked if m == name]
        runs = [judged[_key(name, c)] for c in cells if c.parts]
        bare = sum(not c.parts and not c.why_empty for c in cells)
        right = sum(r.right for r in runs)
        silent = sum(bool(r.contradictions) for r in runs)
        goals += [
            Goal(
                name=f'{name}: cells realised', target=f'all of {len(runs)}',
                figure=f'{right}', met=right == len(runs),
            ),
            Goal(
                name=f'{name}: verified, and the checker contradicts', target='0',
                figure=f'{silent}', met=silent == 0,
            ),
            Goal(
                name=f'{name}: empty cells without a reason', target='0', figure=f'{bare}',
                met=bare == 0,
            ),
        ]  # fmt: skip
    return tuple(goals)


def tables_of(
    map_name: str, asked: Sequence[tuple[str, Cell]], judged: Mapping[str, JudgedTrial]
) -> list[Table]:
    """Return the tables of one map: a row a word, a column for whom it is said of."""
    cells = [c for m, c in asked if m == map_name]
    tables = []
    for table in dict.fromkeys(c.table for c in cells):
        mine = {(c.row, c.column): c for c in cells if c.table == table}
        columns = list(dict.fromkeys(c for _, c in mine))
        rows = []
        for row in dict.fromkeys(r for r, _ in mine):
            texts = []
            for column in columns:
                cell = mine.get((row, column))
                if cell is None:
                    texts.append('not of these')
                elif cell.parts:
                    texts.append(shown(judged[_key(map_name, cell)]))
                else:
                    texts.append(cell.why_empty)
            rows.append((row, *texts))
        caption = f'{table}, on {map_name}'
        tables.append(Table(headings=(table, *columns), rows=rows, caption=caption))
    return tables


if __name__ == '__main__':
    sys.exit(main())
