# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`python -m aurora_bench.maps FILE… --results docs/bench`: any map to a verdict, by commands.

Exit code: 0; 1 when a map gets no verdict or a bad file another answer than a refusal; 4 when the
campaign broke.
"""

from __future__ import annotations

import argparse
import sys
import tempfile
from collections.abc import Sequence
from dataclasses import asdict
from pathlib import Path

from aurora_bench.interrupt import stop_on_sigterm
from aurora_bench.machine import machine_facts
from aurora_bench.maps.hostile import CLASSES, NAMES
from aurora_bench.maps.journeys import STEPS, Journey, Refused, journey, refusals
from aurora_bench.progress import Progress
from aurora_bench.results import Goal, Table, goal_table, markdown_table, write_results
from aurora_core.errors import AuroraError
from aurora_core.knowledge.config_files import config_path
from aurora_core.knowledge.map_folders import bundled_maps
from aurora_core.knowledge.map_model import NET_NAME

PROMPT = 'A drone tracks a car for 15 seconds at 60 m.'
MOST_SECONDS = 60.0
MOST_MIB = 2048.0
_BROKEN = 4


def main(arguments: Sequence[str] | None = None) -> int:
    """Take files all the way, write the results; return the exit code."""
    stop_on_sigterm()
    options = _parser().parse_args(arguments)
    machine = machine_facts()
    progress = Progress('maps', len(options.files) + len(CLASSES) + len(NAMES))
    with tempfile.TemporaryDirectory(prefix='aurora_maps_') as temporary:
        folder = Path(temporary)
        journeys = []
        for number, file in enumerate(options.files, 1):
            journeys.append(journey(file, number, options.prompt, folder))
            progress.step(f'{file.name}: {journeys[-1].problem or journeys[-1].status}')
        bad = folder / 'bad'
        bad.mkdir()
        refused = refusals(bad, progress.step)
    goals = goals_of(journeys, refused)
    try:
        files = write_results(
            options.results,
            'maps',
            {
                'prompt': options.prompt,
                'journeys': [asdict(one) for one in journeys],
                'refused': [asdict(one) for one in refused],
            },
            title='Any map to a verdict, and files that are no map',
            goals=goals,
            tables=(_journeys(journeys), _refusals(refused)),
            notes=(f'Prompt on every map: "{options.prompt}" Each step is a process of its own.',),
            machine=machine,
        )
    except AuroraError as err:
        sys.stderr.write(f'maps: {err.component}: {err}\n')
        return _BROKEN
    sys.stdout.write(markdown_table(_journeys(journeys)) + '\n')
    sys.stdout.write(markdown_table(goal_table(goals)) + '\n')
    progress.note('written: ' + ', '.join(str(path) for path in files))
    return int(any(goal.met is False for goal in goals))


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(prog='aurora_bench.maps', description=__doc__)
    parser.add_argument(
        'files',
        nargs='*',
        type=Path,
        default=[config_path('maps', name, NET_NAME) for name in bundled_maps()],
        metavar='FILE',
        help='OpenStreetMap, SUMO network or OpenDRIVE (default: networks of the bundled maps)',
    )
    parser.add_argument('--prompt', default=PROMPT, help='what is to happen on each map')
    parser.add_argument('--results', type=Path, default=Path('docs/bench'), metavar='DIR')
    return parser


def goals_of(journeys: Sequence[Journey], refused: Sequence[Refused]) -> tuple[Goal, ...]:
    """Return what is asked, with what was found."""
    whole = sum(one.is_whole for one in journeys)
    clear = sum(not one.problem for one in refused)
    slowest = max((one.seconds for one in refused), default=0.0)
    largest = max((one.peak_mib for one in refused), default=0.0)
    return (
        Goal(
            name='files imported, measured, checked, run to a verified verdict and verified again',
            target=f'all of {len(journeys)}',
            figure=f'{whole}',
            met=whole == len(journeys),
        ),
        Goal(
            name='files and names that will not do end in one clear line and leave nothing',
            target=f'all of {len(refused)}',
            figure=f'{clear}',
            met=clear == len(refused),
        ),
        Goal(
            name='seconds and memory that such a file takes at most',
            target=f'<= {MOST_SECONDS:g} s, <= {MOST_MIB:g} MiB',
            figure=f'{slowest:.1f} s, {largest:.0f} MiB',
            met=slowest <= MOST_SECONDS and largest <= MOST_MIB,
        ),
    )


def _journeys(journeys: Sequence[Journey]) -> Table:
    headings = ('file', 'holds', 'roads', 'buildings', 'vehicles stand at')
    return Table(
        headings=(*headings, *(f'{step} [s]' for step in STEPS), 'ends', 'again', 'peak [MiB]'),
        rows=[
            (
                one.file,
                str(one.facts.get('kind', '')),
                str(one.facts.get('roads', '')),
                int(one.facts.get('buildings', 0)),
                f'{one.stands[0]} of {one.stands[1]}',
                *(one.seconds.get(step) for step in STEPS),
                one.problem or one.status,
                'the same' if one.same else 'no',
                round(one.peak_mib),
            )
            for one in journeys
        ],
    )


def _refusals(refused: Sequence[Refused]) -> Table:
    return Table(
        headings=('class', 'file or name', 'answer', 'seconds', 'peak [MiB]', 'wrong'),
        rows=[
            (one.kind, one.file, one.said, one.seconds, round(one.peak_mib), one.problem or '-')
            for one in refused
        ],
    )


if __name__ == '__main__':
    sys.exit(main())
