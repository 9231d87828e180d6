# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`python -m aurora_bench.online --results docs/bench`: margins while a run goes on.

Exit code: 0; 1 when a margin at the end is not that of the offline evaluation; 4 when the
campaign broke. Goals of speed are stated as met or not and do not fail.
"""

from __future__ import annotations

import argparse
import sys
import tempfile
from collections.abc import Iterator, Sequence
from dataclasses import asdict
from pathlib import Path

from aurora_bench.interrupt import stop_on_sigterm
from aurora_bench.lockstep.scenarios import Configuration, prompt
from aurora_bench.machine import machine_facts
from aurora_bench.online.measure import Cost, of_formulas, of_run
from aurora_bench.progress import Progress
from aurora_bench.results import Goal, Table, goal_table, markdown_table, write_results
from aurora_cli.installed import installed
from aurora_cli.local_engine import LocalStages
from aurora_core.errors import AuroraError
from aurora_core.judging.codec import conditions_from_json
from aurora_core.pipeline.verification import load_bag
from aurora_system_tests.local_runs import run_prompt

_BROKEN = 4
_GOAL_MS = 1.0
_GOAL_CONDITIONS = 50
_STEPS = (1, 10, 20)
# The one that the goal is stated for: half a second of the run between two looks.
_GOAL_STEP = 10


def main(arguments: Sequence[str] | None = None) -> int:
    """Measure and write the results; return the exit code."""
    stop_on_sigterm()
    parser = argparse.ArgumentParser(prog='python -m aurora_bench.online', description=__doc__)
    parser.add_argument('--agents', type=int, nargs='+', default=[10, 30, 100], help='of the runs')
    parser.add_argument('--seconds', type=int, default=60, help='simulated time of the runs')
    parser.add_argument('--results', type=Path, default=Path('docs/bench'), help='folder')
    options = parser.parse_args(arguments)
    machine = machine_facts()
    progress = Progress('online', len(_STEPS) * (1 + len(options.agents)))
    costs = []
    try:
        for cost in _measured(options.agents, options.seconds):
            costs.append(cost)
            progress.step(
                f'{cost.what}, every {cost.step} ticks: {cost.mean_ms:.3g} ms a tick'
                + ('' if cost.equal else ', NOT EQUAL at the end')
            )
        found = _goals(costs)
        _, written = write_results(
            options.results,
            'online',
            {'costs': [asdict(cost) for cost in costs]},
            title='Margins while a run goes on',
            goals=found,
            tables=(_table(costs),),
            notes=(),
            machine=machine,
        )
    except AuroraError as err:
        sys.stderr.write(f'online: {err.component}: {err}\n')
        return _BROKEN
    sys.stdout.write(markdown_table(goal_table(found)) + '\n')
    progress.note(f'written: {written}')
    return int(not all(cost.equal for cost in costs))


def _measured(agents: Sequence[int], seconds: int) -> Iterator[Cost]:
    for step in _STEPS:
        yield of_formulas(20 * seconds, 0.05, step)
    for count in agents:
        text = prompt(Configuration(agents=count, uavs=1, seconds=seconds))
        with tempfile.TemporaryDirectory(prefix='aurora_online_') as folder:
            _, bag = run_prompt('online', text, 1, Path(folder), LocalStages(installed()))
            content, agsg = load_bag(bag)
        conditions = conditions_from_json(content.world.conditions_json)
        for step in _STEPS:
            yield of_run(content.trace, content.world, conditions, agsg.spec, step)


def _goals(costs: Sequence[Cost]) -> tuple[Goal, ...]:
    equal = sum(cost.equal for cost in costs)
    runs = [c for c in costs if c.what != 'formulas' and c.step == _GOAL_STEP]
    enough = [c for c in runs if c.conditions >= _GOAL_CONDITIONS]
    alone = next(c for c in costs if c.what == 'formulas' and c.step == 1)
    timed = [('formulas alone, one sample at a time', alone)]
    timed += [(f'{c.what}, a look every {_GOAL_STEP} ticks', c) for c in enough[:1]]
    return (
        Goal(
            name='margins at the end equal to those of the offline evaluation, bit by bit',
            target=f'= {len(costs)}',
            figure=str(equal),
            met=equal == len(costs),
        ),
        *(
            Goal(
                name=f'{name} [ms per tick]',
                target=f'at most {_GOAL_MS:g} for {_GOAL_CONDITIONS}',
                figure=f'{cost.mean_ms:.3g} for {cost.conditions}',
                met=cost.mean_ms <= _GOAL_MS,
            )
            for name, cost in timed
        ),
    )


def _table(costs: Sequence[Cost]) -> Table:
    return Table(
        headings=(
            'what is followed',
            'how many',
            'ticks between looks',
            'ms per tick',
            'longest look [ms]',
            'equal at the end',
        ),
        rows=tuple(
            (
                cost.what,
                cost.conditions,
                cost.step,
                f'{cost.mean_ms:.3g}',
                f'{cost.worst_ms:.3g}',
                'yes' if cost.equal else 'NO',
            )
            for cost in costs
        ),
        caption='Wall time of everything: signals, windows, bounds, verdicts.',
    )


if __name__ == '__main__':
    sys.exit(main())
