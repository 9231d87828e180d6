# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`python -m aurora_bench.bags --results docs/bench` (also: `make bench-bags`)."""

from __future__ import annotations

import argparse
import contextlib
import io
import resource
import sys
import tempfile
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

from aurora_bench.bags.damage import Case, Damager
from aurora_bench.bags.judge import Judgement, judge
from aurora_bench.interrupt import stop_on_sigterm
from aurora_bench.machine import machine_facts
from aurora_bench.progress import Progress
from aurora_bench.results import Goal, Table, told_goals, write_results
from aurora_cli.main import run_command_line
from aurora_core.trace.definitions import message_definitions

PROMPT = (
    'A van tailgates the ego car closely, closing from 45 meters; a tracking drone alerts the ego '
    'when the van comes within 20 meters.'
)
# Beyond what the process holds before the first damaged bag.
MEMORY_LIMIT_MIB = 300
SECONDS_LIMIT = 5.0
LOST_LIMIT_S = 1.0

Judged = tuple[Case, Judgement]


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the campaign; return 1 when something that must hold does not."""
    stop_on_sigterm()
    parser = argparse.ArgumentParser(prog='aurora_bench.bags', description=__doc__)
    parser.add_argument('--results', type=Path, default=Path('docs/bench'), metavar='FOLDER')
    parser.add_argument('--seed', type=int, default=1)
    parser.add_argument('--kills', type=int, default=50, help='recorders killed in the ROS graph')
    parser.add_argument('--truncations', type=int, default=100)
    parser.add_argument('--flips', type=int, default=200)
    parser.add_argument('--altered', type=int, default=20, help='messages altered, each twice')
    options = parser.parse_args(arguments)
    machine = machine_facts()
    results: dict[str, Any] = {'seed': options.seed}
    with tempfile.TemporaryDirectory(prefix='aurora_bags_') as name:
        folder = Path(name).resolve()
        goals, tables = _damages(folder, options, results)
        if options.kills:
            more, table = _kills(folder, options, results)
            goals += more
            tables.append(table)
    write_results(
        options.results,
        'bags',
        results,
        title='Damaged recordings',
        goals=goals,
        tables=tables,
        notes=(
            'Each damaged bag is judged by `aurora verify` in one process. A flipped bit counts '
            'wherever it is, also where no message is: the digest covers the whole file.',
            'A recorder is killed (SIGKILL) when an observer of the clock sees a random time; '
            'what it had not handed to the operating system by then is lost.',
        ),
        machine=machine,
    )
    return told_goals(goals)


def _damages(
    folder: Path, options: argparse.Namespace, results: dict[str, Any]
) -> tuple[list[Goal], list[Table]]:
    bag = _record(folder)
    intact = judge(bag)
    damager = Damager(bag, folder / 'damaged', message_definitions(), options.seed)
    cases = _all(damager, options)
    progress = Progress('bags')
    before = _peak_mib()
    judged: list[Judged] = []
    for case in cases:
        judgement = judge(case.path)
        judged.append((case, judgement))
        if len(judged) % 25 == 0:
            progress.note(f'{len(judged)} damaged bags judged')
    grown = _peak_mib() - before
    results['damaged'] = [
        {
            'kind': case.kind,
            'name': case.name,
            'exit_code': judgement.code,
            'status': judgement.status,
            'integrity': judgement.integrity,
            'text': judgement.text[:300],
            'cpu_s': round(judgement.seconds, 4),
        }
        for case, judgement in judged
    ]
    results['peak_memory_growth_mib'] = grown
    for case, judgement in judged:
        if not _right(case, judgement):
            progress.note(f'NOT AS IT MUST BE: {case.kind}, {case.name}: {judgement}')
    slowest = max(judgement.seconds for _, judgement in judged)
    goals = [
        Goal(
            name='the bag before it is damaged',
            target='exit code 0, intact',
            figure=f'exit code {intact.code}, {intact.integrity}',
            met=intact.code == 0 and intact.integrity == 'intact',
        ),
        _count('no crash', judged, lambda _case, found: not found.crashed),
        _count('never a pass, never called intact', judged, lambda _case, found: found.refused),
        _count('the damage is named', judged, lambda _case, found: found.named),
        _count(
            'called what it is',
            [pair for pair in judged if pair[0].integrity],
            lambda case, found: found.integrity in ('', case.integrity),
        ),
        Goal(
            name='memory beyond that for the intact bag',
            target=f'at most {MEMORY_LIMIT_MIB} MiB',
            figure=f'{grown:.0f} MiB',
            met=grown <= MEMORY_LIMIT_MIB,
        ),
        Goal(
            name='processor time for one bag',
            target=f'at most {SECONDS_LIMIT:g} s',
            figure=f'{slowest:.2f} s (intact: {intact.seconds:.2f} s)',
            met=slowest <= SECONDS_LIMIT,
        ),
    ]
    return goals, [_by_kind(judged), _others(judged)]


def _all(damager: Damager, options: argparse.Namespace) -> Iterator[Case]:
    yield from damager.truncations(options.truncations)
    yield from damager.flips(options.flips)
    yield from damager.flips_without_metadata(max(1, options.flips // 10))
    yield from damager.one_message_altered(options.altered)
    yield from damager.others()


def _right(case: Case, judgement: Judgement) -> bool:
    called = not case.integrity or judgement.integrity in ('', case.integrity)
    return judgement.refused and judgement.named and called


def _count(name: str, judged: Sequence[Judged], holds: Any) -> Goal:
    good = sum(bool(holds(case, judgement)) for case, judgement in judged)
    return Goal(
        name=name,
        target=f'{len(judged)} of {len(judged)}',
        figure=f'{good} of {len(judged)}',
        met=good == len(judged),
    )


def _by_kind(judged: Sequence[Judged]) -> Table:
    rows = []
    for kind in dict.fromkeys(case.kind for case, _ in judged):
        found = [judgement for case, judgement in judged if case.kind == kind]
        states = [judgement.integrity or 'nothing to judge' for judgement in found]
        counts = ', '.join(f'{state} {states.count(state)}' for state in sorted(set(states)))
        seconds = sorted(judgement.seconds for judgement in found)
        rows.append((kind, len(found), counts, seconds[len(seconds) // 2], seconds[-1]))
    return Table(
        headings=('damage', 'bags', 'called', 'median CPU [s]', 'most CPU [s]'),
        rows=rows,
        caption='Damaged bags by kind',
    )


def _others(judged: Sequence[Judged]) -> Table:
    return Table(
        headings=('bag', 'called', 'said'),
        rows=[
            (case.name, judgement.integrity or 'nothing to judge', judgement.text[:160])
            for case, judgement in judged
            if case.kind == 'other'
        ],
        caption='Other damage',
    )


def _kills(
    folder: Path, options: argparse.Namespace, results: dict[str, Any]
) -> tuple[list[Goal], Table]:
    # Needs rclpy: without kills the campaign runs without ROS.
    from aurora_bench.bags.kills import kill_recorders

    progress = Progress('bags', options.kills)
    kills = []
    for kill in kill_recorders(folder, options.kills, options.seed, message_definitions()):
        kills.append(kill)
        progress.step(
            f'killed at {kill.killed_s:.2f} s, complete to {kill.recovered_s:.2f} s '
            f'(lost {kill.lost_s:.2f} s), run: {kill.status} {kill.component} {kill.problem}'
        )
    results['kills'] = [
        {
            'killed_s': kill.killed_s,
            'recovered_s': kill.recovered_s,
            'lost_s': round(kill.lost_s, 6),
            'status': kill.status,
            'component': kill.component,
            'problem': kill.problem,
        }
        for kill in kills
    ]
    lost = sorted(kill.lost_s for kill in kills)
    within = sum(kill.lost_s <= LOST_LIMIT_S + 1e-9 for kill in kills)
    clean = sum(not kill.problem for kill in kills)
    named = sum(kill.component == 'recorder' for kill in kills)
    goals = [
        Goal(
            name='recorder killed: recovered to within 1 s of simulated time',
            target=f'{len(kills)} of {len(kills)}',
            figure=f'{within} of {len(kills)} (most lost: {lost[-1]:.2f} s)',
            met=within == len(kills),
        ),
        Goal(
            name='recorder killed: original untouched, values those of the undisturbed run, '
            'read by rosbags, never intact',
            target=f'{len(kills)} of {len(kills)}',
            figure=f'{clean} of {len(kills)}',
            met=clean == len(kills),
        ),
        Goal(
            name='recorder killed: the run ends as error naming the recorder',
            target=f'{len(kills)} of {len(kills)}',
            figure=f'{named} of {len(kills)}',
            met=named == len(kills),
        ),
    ]
    rows = [(kill.killed_s, kill.recovered_s, round(kill.lost_s, 3)) for kill in kills]
    headings = ('killed at [s]', 'complete to [s]', 'lost [s]')
    return goals, Table(headings=headings, rows=rows, caption='Killed recorders, simulated time')


def _record(folder: Path) -> Path:
    """Record the scenario with the local engine and return its bag, away from its run."""
    with contextlib.redirect_stdout(io.StringIO()):
        run_command_line(['run', PROMPT, '--out', str(folder / 'runs'), '--json'])
    bag = next((folder / 'runs').glob('*/bag.0'))
    return bag.rename(folder / 'bag.0')


def _peak_mib() -> float:
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024


if __name__ == '__main__':
    sys.exit(main())
