# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`python -m aurora_bench.fidelity [FILE…]`: parse every prompt and score the specification."""

from __future__ import annotations

import argparse
import sys
import time
from collections.abc import Sequence
from pathlib import Path

from aurora_bench.fidelity.answer import answer
from aurora_bench.fidelity.prompt_file import prompt_file
from aurora_bench.fidelity.summary import Judged, as_json, judge, last_line, tables
from aurora_bench.fidelity.timing import seconds_per_prompt, timing_table
from aurora_bench.interrupt import stop_on_sigterm
from aurora_bench.machine import machine_facts
from aurora_bench.progress import Progress
from aurora_bench.prompts.shipped import first_files
from aurora_bench.results import ResultsError, markdown_table, write_results
from aurora_bench.seeds import seed_option
from aurora_core.errors import ConfigError
from aurora_core.pipeline.stages import RunRequest
from aurora_llm.parse import check_model_name


def main(arguments: Sequence[str] | None = None) -> int:
    """Score files; return 0, 64 when one cannot be read, 4 when a recorded reply is missing."""
    stop_on_sigterm()
    parser = argparse.ArgumentParser(prog='aurora_bench.fidelity', description=__doc__)
    parser.add_argument(
        'files',
        nargs='*',
        type=Path,
        default=first_files('tune'),
        metavar='FILE',
        help='prompts, one JSON object a line (default: the first 200 shipped ones to tune on)',
    )
    parser.add_argument('--model', default='offline', help='who parses, as in aurora run')
    parser.add_argument(
        '--transcripts', type=Path, default=None, help='recorded replies in place of the models'
    )
    parser.add_argument('--history', type=Path, default=None, help='past runs; nothing is added')
    parser.add_argument('--map', default='downtown', help='map that the prompts are read against')
    parser.add_argument('--seed', type=seed_option, default=1)
    parser.add_argument('--only', default='', help='prompts whose id begins so')
    parser.add_argument('--results', type=Path, default=None, help='folder for JSON and Markdown')
    parser.add_argument('--name', default='fidelity', help='of the files of results')
    options = parser.parse_args(arguments)
    machine = machine_facts()
    try:
        check_model_name(options.model)
        files = [prompt_file(path) for path in options.files]
        everything = [prompt for file in files for prompt in file.prompts]
    except (ResultsError, ConfigError) as err:
        sys.stderr.write(f'{err}\n')
        return 64
    prompts = [p for p in everything if p.id.startswith(options.only)]
    progress = Progress('fidelity', len(prompts))
    judged: list[Judged] = []
    seconds: list[float] = []
    for prompt in prompts:
        request = RunRequest(
            prompt=prompt.prompt,
            map_name=options.map,
            seed=options.seed,
            model=options.model,
            transcripts=options.transcripts,
            history=options.history,
            history_frozen=True,
        )
        try:
            begin = time.perf_counter()
            given = answer(request)
            seconds.append(time.perf_counter() - begin)
            done = judge(prompt, given)
        except ConfigError as err:
            sys.stderr.write(f'{prompt.id}: {err}\n')
            return 4
        judged.append(done)
        kinds = ', '.join(f'{m.kind} ({m.told})' for m in done.misses)
        progress.step(f'{prompt.id}: {f"missed: {kinds}" if kinds else "all met"}')
    warm = seconds[1:]  # the first prompt loads map and lexicon
    shown = (*tables(judged), timing_table(warm))
    sys.stdout.write('\n\n'.join(markdown_table(table) for table in shown) + '\n\n')
    if options.results is not None:
        names = [file.name for file in files]
        document = {
            'files': names,
            'prompt_files': [
                {'name': file.name, 'sha256': file.sha256, 'beyond': file.beyond} for file in files
            ],
            'model': options.model,
            'seconds_per_prompt': seconds_per_prompt(warm),
            **as_json(judged),
        }
        _, written = write_results(
            options.results,
            options.name,
            document,
            title=f'Fidelity of {options.model} on {", ".join(names)}',
            tables=shown,
            notes=(*(f'`{file.line}`' for file in files), f'`{last_line(judged)}`'),
            machine=machine,
        )
        progress.note(f'see {written}')
    sys.stdout.write(
        ''.join(f'{line}\n' for line in (*(f.line for f in files), last_line(judged)))
    )
    return 0


if __name__ == '__main__':
    sys.exit(main())
