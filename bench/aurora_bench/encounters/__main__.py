# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`python -m aurora_bench.encounters --results docs/bench`: do two meet who are to?

Exit code: 0; 4 when the campaign broke.
"""

from __future__ import annotations

import argparse
import sys
import tempfile
from collections.abc import Sequence
from contextlib import closing
from pathlib import Path
from statistics import median

import numpy as np

from aurora_bench.encounters.pairs import KINDS, Pair, pairs
from aurora_bench.interrupt import stop_on_sigterm
from aurora_bench.machine import machine_facts
from aurora_bench.progress import Progress
from aurora_bench.results import Table, markdown_table, write_results
from aurora_bench.rulers.readback import read_back_line
from aurora_bench.rulers.runs import RealiseWork
from aurora_bench.rulers.trial import JudgedTrial, Trial, judged_trials
from aurora_core.errors import AuroraError
from aurora_core.trace.bag_reader import read_bag
from aurora_core.trace.definitions import message_definitions

_BROKEN = 4
_LIMIT_S = 120.0
# Samples of a recording that are compared, per second.
_SAMPLES_HZ = 5.0


def apart_s(bag: Path, pair: Pair) -> float | None:
    """Return how many seconds lie between two bodies where their ways come together.

    Returns:
        Of all points at which both have been, the least time between them; None where there is no
        such point.
    """
    trace = read_bag(bag, message_definitions()).trace
    step = max(1, round(1.0 / (_SAMPLES_HZ * trace.roster.dt_s)))
    rows = [trace.roster.agent_index(name) for name in (pair.one, pair.other)]
    if None in rows:
        return None
    one, other = (trace.ground[::step, row, :2] for row in rows if row is not None)
    gaps_m = np.linalg.norm(one[:, None] - other[None], axis=2)
    first, then = np.nonzero(gaps_m <= pair.within_m)
    if len(first) == 0:
        return None
    return float(np.abs(first - then).min() * step * trace.roster.dt_s)


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the pairs, write the table; return the exit code."""
    stop_on_sigterm()
    options = _parser().parse_args(arguments)
    machine = machine_facts()
    chosen = list(pairs(options.count, options.seed))
    trials = [_trial(pair) for pair in chosen]
    progress = Progress('encounters', len(trials))
    judged: dict[int, JudgedTrial] = {}
    missed: dict[int, float | None] = {}
    with tempfile.TemporaryDirectory(prefix='aurora_encounters_') as folder:
        place = options.keep or Path(folder)
        work = RealiseWork(folder=place, keep=True, map_name=options.map, repair=0)
        runs = judged_trials(work, trials, jobs=options.jobs, limit_s=_LIMIT_S)
        with closing(runs) as answers:
            for index, result in answers:
                trial = trials[index]
                judged[index] = result
                bags = sorted((place / trial.folder).glob('*/bag.0'))
                missed[index] = apart_s(bags[-1], chosen[index]) if bags else None
                told = 'met' if result.right else f'{result.cause}: {", ".join(result.words)}'
                progress.step(f'{trial.prompt.id}: {told}, {missed[index]} s apart')
    rows = []
    for kind in KINDS:
        own = [k for k, pair in enumerate(chosen) if pair.kind == kind]
        right = [k for k in own if judged[k].right]
        apart = [s for k in right if (s := missed[k]) is not None]
        rows.append(
            (
                kind, len(own), len(right), median(apart) if apart else None,
                max(apart, default=None), sum(bool(judged[k].contradictions) for k in own),
            )
        )  # fmt: skip
    right_all = sum(t.right for t in judged.values())
    table = Table(
        headings=(
            'encounter', 'pairs', 'realised', 'seconds apart, median', 'greatest',
            'contradicted by the checker',
        ),
        rows=rows,
    )  # fmt: skip
    found = [t.placed for t in judged.values() if t.placed is not None]
    last = f'realised {right_all} of {len(trials)} encounters on {options.map}'
    try:
        write_results(
            options.results,
            'encounters',
            {
                'map': options.map,
                'seed': options.seed,
                'pairs': [
                    {'kind': p.kind, 'apart_s': missed[k], **judged[k].model_dump(mode='json')}
                    for k, p in enumerate(chosen)
                ],
            },
            title='Two who are to meet',
            tables=(table,),
            notes=(
                'Seconds apart: of all points at which both have been, the least time between '
                'them. Of realised pairs.',
                f'`{read_back_line(found)}`  \n`{last}`',
            ),
            machine=machine,
        )
    except AuroraError as err:
        sys.stderr.write(f'encounters: {err.component}: {err}\n')
        return _BROKEN
    sys.stdout.write(f'{markdown_table(table)}\n\n{read_back_line(found)}\n{last}\n')
    return 0


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(prog='aurora_bench.encounters', description=__doc__)
    parser.add_argument('--count', type=int, default=100)
    parser.add_argument('--seed', type=int, default=1, help='of the numbers in the requests')
    parser.add_argument('--map', default='downtown')
    parser.add_argument('--jobs', type=int, default=1)
    parser.add_argument('--results', type=Path, default=Path('docs/bench'), metavar='DIR')
    parser.add_argument('--keep', type=Path, default=None, metavar='FOLDER', help='keep the runs')
    return parser


def _trial(pair: Pair) -> Trial:
    ident = pair.cell.ident
    return Trial(
        key=ident, file='encounters', prompt=pair.cell.prompt(), document=pair.cell.document(),
        seed=1, folder=ident,
    )  # fmt: skip


if __name__ == '__main__':
    sys.exit(main())
