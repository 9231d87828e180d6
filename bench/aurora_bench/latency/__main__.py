# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`python -m aurora_bench.latency --results docs/bench`: how long one answer takes.

Exit code: 0; 1 when a goal is not met; 4 when a command or a run broke.
"""

from __future__ import annotations

import argparse
import importlib.util
import json
import subprocess
import sys
import tempfile
from collections.abc import Sequence
from pathlib import Path

import aurora_core.document
from aurora_bench.interrupt import stop_on_sigterm
from aurora_bench.latency.cold import IMPORTS as IMPORT_COMMAND
from aurora_bench.latency.cold import aurora, timed
from aurora_bench.latency.summary import CHECK, IMPORTS, RUN, Measured, goals, notes, tables
from aurora_bench.latency.warm import WarmProcess
from aurora_bench.machine import busy_share, machine_facts
from aurora_bench.progress import Progress
from aurora_bench.results import ResultsError, goal_table, markdown_table, write_results
from aurora_core.errors import AuroraError

PROMPT = (
    'A drone ascends to 40 meters and then follows a motorcycle as it drives through the streets.'
)
_BROKEN = 4


def main(arguments: Sequence[str] | None = None) -> int:
    """Measure, write the results, print goals and tables; return the exit code."""
    stop_on_sigterm()
    parser = argparse.ArgumentParser(prog='python -m aurora_bench.latency', description=__doc__)
    add = parser.add_argument
    add('--prompt', default=PROMPT, help='one UAV and one vehicle, unless said otherwise')
    add('--rounds', type=_count, default=7, help='of each cold command')
    add('--processes', type=_count, default=3, help='warm processes')
    add('--runs', type=_count, default=4, help='of each warm process, beside the first one')
    add('--results', type=Path, default=Path('docs/bench'), help='folder for the results')
    options = parser.parse_args(arguments)
    machine = machine_facts()
    progress = Progress('latency', options.rounds + options.processes)
    try:
        measured = measure(options, progress)
        found, shown = goals(measured), tables(measured)
        files = write_results(
            options.results,
            'latency',
            _document(options.prompt, measured),
            title='How long one answer takes',
            goals=found,
            tables=shown,
            notes=(f'Prompt: "{options.prompt}" {_bytecode()}', *notes(measured)),
            machine=machine,
        )
    except AuroraError as err:
        sys.stderr.write(f'latency: {err.component}: {err}\n')
        return _BROKEN
    for table in (goal_table(found), *shown):
        sys.stdout.write(markdown_table(table) + '\n\n')
    progress.note('written: ' + ', '.join(str(path) for path in files))
    return int(any(goal.met is False for goal in found))


def _count(text: str) -> int:
    if not text.isdecimal() or int(text) < 1:
        raise argparse.ArgumentTypeError(f'expected a count from 1 on, found {text!r}')
    return int(text)


def measure(options: argparse.Namespace, progress: Progress) -> Measured:
    """Run the cold commands by turns, then the warm processes.

    Raises:
        ResultsError: A command broke.
    """
    measured = Measured()
    with tempfile.TemporaryDirectory(prefix='aurora-latency-') as name:
        folder = Path(name)
        commands = {
            IMPORTS: IMPORT_COMMAND,
            CHECK: aurora(('check', options.prompt)),
            RUN: aurora(('run', '--json', '--out', name, options.prompt)),
        }
        for command in commands.values():  # what is on the disk only is read once before
            timed(command, folder)
        measured.busy.append(busy_share())
        for _ in range(options.rounds):
            for key, command in commands.items():
                measured.cold[key].append(timed(command, folder))
            spent = ', '.join(f'{samples[-1].cpu_s:.2f}' for samples in measured.cold.values())
            progress.step(f'cold: {spent} s CPU for {", ".join(commands)}')
        for _ in range(options.processes):
            measured.processes.append(_warm(options.prompt, folder, options.runs + 1))
            last = measured.later[-1]
            progress.step(f'warm: {last.status}, {last.total.cpu_s:.2f} s CPU')
        measured.busy.append(busy_share())
    return measured


def _warm(prompt: str, folder: Path, runs: int) -> WarmProcess:
    done = subprocess.run(
        [sys.executable, '-m', 'aurora_bench.latency.warm', str(folder), str(runs), prompt],
        check=False,
        stdin=subprocess.DEVNULL,
        capture_output=True,
        text=True,
    )
    if done.returncode != 0:
        raise ResultsError(f'a warm process ended with {done.returncode}: {done.stderr[-400:]}')
    # Simulators may have printed before.
    return WarmProcess.model_validate(json.loads(done.stdout.splitlines()[-1]))


def _document(prompt: str, measured: Measured) -> dict[str, object]:
    return {
        'prompt': prompt,
        'busy': measured.busy,
        'quiet': measured.is_quiet,
        'bytecode': _bytecode(),
        'cold': {
            name: [sample.model_dump() for sample in samples]
            for name, samples in measured.cold.items()
        },
        'warm': [process.model_dump() for process in measured.processes],
    }


def _bytecode() -> str:
    """Say whether the sources were compiled beforehand, as set-up does."""
    compiled = importlib.util.cache_from_source(str(aurora_core.document.__file__))
    if Path(compiled).exists():
        return '(sources compiled beforehand, as set-up does)'
    return '(sources compiled anew in every process: set-up has not compiled them)'


if __name__ == '__main__':
    sys.exit(main())
