# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`python -m aurora_bench.fidelity [FILE…]`: parse every prompt and score the specification."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence
from contextlib import ExitStack
from pathlib import Path

from aurora_bench.fidelity.asking import AskWork, Question, Told, ask, question
from aurora_bench.fidelity.summary import Judged, as_json, judge, last_line, tables
from aurora_bench.fidelity.timing import seconds_per_prompt, timing_table
from aurora_bench.interrupt import stop_on_sigterm
from aurora_bench.machine import Machine, machine_facts
from aurora_bench.progress import Progress
from aurora_bench.prompts.shipped import first_files
from aurora_bench.results import ResultsError, markdown_table, write_results
from aurora_bench.resumable.code import code_digest
from aurora_bench.resumable.files import PromptFile, file_line, read_files
from aurora_bench.resumable.journal import Journal, JournalError, JournalHead, journal_path
from aurora_bench.seeds import seeds_option
from aurora_cli.pool import PoolError
from aurora_core.errors import ConfigError
from aurora_core.report.run_folder import json_text
from aurora_core.report.versions import product_versions
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
    parser.add_argument(
        '--seeds', type=seeds_option, default=(1,), metavar='1,2,3', help='ask with each of them'
    )
    parser.add_argument('--jobs', type=int, default=1, metavar='N', help='worker processes')
    parser.add_argument('--limit-s', type=float, default=600.0, help='wall seconds of an answer')
    parser.add_argument(
        '--resume',
        type=Path,
        default=None,
        metavar='PLACE',
        help='go on with the journal in this folder or file; begun where there is none',
    )
    parser.add_argument('--only', default='', help='prompts whose id begins so')
    parser.add_argument('--totals', action='store_true', help='show no single prompt')
    parser.add_argument('--results', type=Path, default=None, help='folder for JSON and Markdown')
    parser.add_argument('--name', default='fidelity', help='of the files of results')
    parser.add_argument('--json', action='store_true', help='one JSON document, no tables')
    options = parser.parse_args(arguments)
    machine = machine_facts()
    try:
        check_model_name(options.model)
        if options.jobs < 1:
            raise ConfigError(f'--jobs needs at least 1 worker, found {options.jobs}')
        files = read_files(options.files)
    except (ResultsError, ConfigError) as err:
        sys.stderr.write(f'{err}\n')
        return 64
    questions = _questions(files, options)
    progress = Progress('fidelity', len(questions))
    judged: dict[str, Judged] = {}

    def step(asked: Question, told: Told) -> None:
        done = judge(asked.prompt, told.answer)
        judged[asked.key] = done
        kinds = ', '.join(f'{m.kind} ({m.told})' for m in done.misses)
        told_of = f'missed: {kinds}' if kinds else 'all met'
        progress.step('done' if options.totals else f'{asked.prompt.id}: {told_of}')

    try:
        with ExitStack() as stack:
            journal = _journal(files, options)
            if journal is not None:
                stack.enter_context(journal)
            work = AskWork(options.map)
            told = ask(
                questions,
                work,
                jobs=options.jobs,
                limit_s=options.limit_s,
                journal=journal,
                step=step,
            )
            if journal is not None:
                journal.end()
    except KeyboardInterrupt:
        progress.note('cancelled; --resume goes on with what the journal holds')
        return 130
    except JournalError as err:
        sys.stderr.write(f'{err}\n')
        return 64
    except (ConfigError, PoolError) as err:
        sys.stderr.write(f'{err}\n')
        return 4
    results = [judged[q.key] for q in questions]
    _tell(files, results, [t.seconds for t in told], options, machine, progress)
    return 0


def _questions(files: Sequence[PromptFile], options: argparse.Namespace) -> tuple[Question, ...]:
    return tuple(
        question(
            prompt,
            file.sha256,
            seed,
            map_name=options.map,
            model=options.model,
            transcripts=options.transcripts,
            history=options.history,
        )
        for file in files
        for prompt in file.prompts
        if prompt.id.startswith(options.only)
        for seed in options.seeds
    )


def _journal(files: Sequence[PromptFile], options: argparse.Namespace) -> Journal | None:
    if options.resume is None:
        return None
    head = JournalHead(
        campaign='fidelity',
        files={file.name: file.sha256 for file in files},
        options={
            'map': options.map,
            'model': options.model,
            **product_versions(),
            'code': code_digest(),
        },
    )
    return Journal(journal_path(options.resume, options.name), head, resume=True)


def _tell(
    files: Sequence[PromptFile],
    judged: Sequence[Judged],
    seconds: Sequence[float],
    options: argparse.Namespace,
    machine: Machine,
    progress: Progress,
) -> None:
    """Print tables (or JSON), write results, print the lines that programs read."""
    shown = (*tables(judged), timing_table(seconds)) if judged else ()
    last = last_line(judged)
    names = [file.name for file in files]
    document = {
        'files': names,
        'prompt_files': [
            {'name': file.name, 'sha256': file.sha256, 'beyond': file.beyond} for file in files
        ],
        'model': options.model,
        'seeds': list(options.seeds),
        'jobs': options.jobs,
        'wall_s': progress.elapsed_s,
        'seconds_per_prompt': seconds_per_prompt(seconds),
        **as_json(judged),
    }
    if options.results is not None:
        _, written = write_results(
            options.results,
            options.name,
            document,
            title=f'Fidelity of {options.model} on {", ".join(names)}',
            tables=shown,
            notes=(*(f'`{file_line(file)}`' for file in files), f'`{last}`'),
            machine=machine,
        )
        progress.note(f'see {written}')
    if options.json:
        text = json_text({'benchmark': 'fidelity', **document, 'last_line': last})
        sys.stdout.write(f'{text}\n')
        return
    if not options.totals:
        sys.stdout.write('\n\n'.join(markdown_table(table) for table in shown) + '\n\n')
    sys.stdout.write(''.join(f'{line}\n' for line in (*map(file_line, files), last)))


if __name__ == '__main__':
    sys.exit(main())
