# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`python -m aurora_bench.replay`: margins live, from the bag and replayed, bit by bit."""

from __future__ import annotations

import argparse
import sys
import tempfile
from collections import Counter
from collections.abc import Sequence
from pathlib import Path

from aurora_bench.interrupt import stop_on_sigterm
from aurora_bench.machine import machine_facts
from aurora_bench.progress import Progress
from aurora_bench.replay.campaign import Campaign, Round
from aurora_bench.replay.prompts import cases
from aurora_bench.results import Goal, Table, write_results
from aurora_system_tests.graph import running_graph


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the campaign; return 1 when a margin differs."""
    stop_on_sigterm()
    parser = argparse.ArgumentParser(prog='aurora_bench.replay', description=__doc__)
    parser.add_argument('--prompts', type=int, default=30, help='how many runs')
    parser.add_argument('--results', type=Path, default=Path('docs/bench'), help='folder')
    options = parser.parse_args(arguments)
    machine = machine_facts()
    progress = Progress('replay', options.prompts)
    rounds: list[Round] = []
    with (
        tempfile.TemporaryDirectory(prefix='aurora_replay_') as folder,
        running_graph(Path(folder)) as graph,
    ):
        campaign = Campaign(graph)
        for case in cases(options.prompts):
            done = campaign.run(case)
            rounds.append(done)
            word = 'equal' if done.equal else f'NOT EQUAL {done.note}'
            progress.step(f'{done.status}, {done.conditions} margins, {word}: {case.prompt}')
    equal = sum(done.equal for done in rounds)
    goals = (
        Goal(
            name='runs with one set of margins live, from the bag and replayed, bit by bit',
            target=f'= {len(rounds)}',
            figure=str(equal),
            met=equal == len(rounds),
        ),
    )
    statuses = Counter(done.status for done in rounds)
    results = {
        'runs': [
            {
                'prompt': done.case.prompt,
                'options': done.case.options,
                'status': done.status,
                'conditions': done.conditions,
                'ticks': done.ticks,
                'live_equals_bag': done.live,
                'bag_equals_recomputation': done.bag,
                'replay_equals_bag': done.replayed,
                'one_trace_hash': done.hashes,
                'replay_exit_code': done.replay_code,
                'note': done.note,
            }
            for done in rounds
        ],
        'margins': sum(done.conditions for done in rounds),
        'statuses': dict(statuses),
    }
    table = Table(
        headings=('prompt', 'seed', 'fault', 'status', 'ticks', 'margins', 'equal'),
        rows=tuple(_row(done) for done in rounds),
        caption='Each run: live verdict, verdict of the bag, fresh computation, verdict heard in '
        'the replay; equal means every byte of the four.',
    )
    _, written = write_results(
        options.results,
        'replay',
        results,
        title='Live, from the bag and replayed',
        tables=(table,),
        goals=goals,
        machine=machine,
    )
    progress.note(f'{equal} of {len(rounds)} equal, {results["margins"]} margins; see {written}')
    return int(any(goal.met is False for goal in goals))


def _row(done: Round) -> tuple[str | int | None, ...]:
    faults = done.case.options.get('faults', [])
    return (
        done.case.prompt,
        int(done.case.options['seed']),
        faults[0]['kind'] if faults else None,
        done.status,
        done.ticks,
        done.conditions,
        'yes' if done.equal else f'NO: {done.note}',
    )


if __name__ == '__main__':
    sys.exit(main())
