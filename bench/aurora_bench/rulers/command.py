# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The commands of the rulers: options, campaign, tables, last line."""

from __future__ import annotations

import argparse
import sys
import tempfile
from collections.abc import Callable, Iterator, Sequence
from contextlib import ExitStack, closing, contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from aurora_bench.interrupt import stop_on_sigterm
from aurora_bench.machine import Machine, machine_facts
from aurora_bench.progress import Progress
from aurora_bench.prompts.format import AnnotatedPrompt, beyond
from aurora_bench.prompts.shipped import first_files
from aurora_bench.results import ResultsError, markdown_table, write_results
from aurora_bench.resumable.code import code_digest
from aurora_bench.resumable.files import PromptFile, file_line, read_files, verdict_line
from aurora_bench.resumable.journal import Journal, JournalError, JournalHead, journal_path
from aurora_bench.rulers.anywhere import place_names, places_of_maps
from aurora_bench.rulers.readback import read_back_line
from aurora_bench.rulers.summary import (
    as_json,
    detail_tables,
    mean_seconds,
    repair_line,
    right_share,
    silent_failures,
    total_tables,
    unchecked_share,
)
from aurora_bench.rulers.trial import JudgedTrial, Trial, judged_trials, trials_of
from aurora_bench.seeds import seeds_option
from aurora_cli.pool import PoolError, Work
from aurora_core.errors import AuroraError, ConfigError, MapError
from aurora_core.knowledge.map_folders import list_maps
from aurora_core.report.run_folder import json_text
from aurora_core.report.versions import product_versions

USAGE = 64
BROKEN = 4
INTERRUPTED = 130


@dataclass(frozen=True, kw_only=True)
class Ruler:
    """What a command measures.

    Attributes:
        name: Of the command.
        about: One sentence.
        word: What a right trial is called in tables and in the last line.
        of: Word behind the number of trials in the last line.
        takes: Whether a prompt is measured.
        work: Makes the work from the options and the campaign's folder.
        add_options: Adds options of its own.
        check_options: Raises `ConfigError` when they are wrong.
        own_options: Its options that a result depends on.
    """

    name: str
    about: str
    word: str
    of: str
    takes: Callable[[AnnotatedPrompt], bool]
    work: Callable[[argparse.Namespace, Path], Work[Trial, JudgedTrial]]
    add_options: Callable[[argparse.ArgumentParser], None] = lambda _parser: None
    check_options: Callable[[argparse.Namespace], None] = lambda _options: None
    own_options: tuple[str, ...] = field(default=())


def measure(ruler: Ruler, arguments: Sequence[str] | None) -> int:
    """Run a campaign and print what it gives.

    Returns:
        0; 64 when options or files are wrong; 4 when it cannot be carried out; 130 after Ctrl-C.
    """
    stop_on_sigterm()
    parser = _parser(ruler)
    options = parser.parse_args(arguments)
    try:
        _check(options)
        ruler.check_options(options)
        files = read_files(options.files)
    except (ResultsError, ConfigError, MapError) as err:
        sys.stderr.write(f'{err}\n')
        return USAGE
    machine, code = machine_facts(), code_digest()
    trials = tuple(_trials(ruler, files, options))
    progress = Progress(ruler.name, len(trials))
    try:
        with ExitStack() as stack:
            journal = _journal(ruler, files, options, code)
            if journal is not None:
                stack.enter_context(journal)
            folder = stack.enter_context(_folder(ruler, options.keep))
            work = ruler.work(options, folder)
            judged = _campaign(work, trials, options, journal, progress)
            if journal is not None:
                journal.end()
    except KeyboardInterrupt:
        progress.note('cancelled; --resume goes on with what the journal holds')
        return INTERRUPTED
    except (JournalError, PoolError) as err:
        sys.stderr.write(f'{err}\n')
        # A journal of something else is a mistake of whoever gave it.
        return USAGE if isinstance(err, JournalError) else BROKEN
    try:
        _tell(ruler, files, judged, options, code, machine, progress)
    except AuroraError as err:
        sys.stderr.write(f'{err}\n')
        return BROKEN
    return 0


def _parser(ruler: Ruler) -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(prog=f'aurora bench {ruler.name}', description=ruler.about)
    parser.add_argument(
        'files',
        nargs='*',
        type=Path,
        default=first_files('tune'),
        metavar='FILE',
        help='prompts, one JSON object a line (default: the first 200 shipped ones to tune on)',
    )
    parser.add_argument(
        '--seeds',
        type=seeds_option,
        default=(1,),
        metavar='1,2,3',
        help='each prompt with each of them',
    )
    parser.add_argument('--jobs', type=int, default=1, metavar='N', help='worker processes')
    parser.add_argument(
        '--repair',
        type=int,
        default=None,
        metavar='N',
        help='runs that repair may spend on each (default: as aurora run; 0: none)',
    )
    parser.add_argument('--map', default='downtown', help='map of the runs')
    parser.add_argument('--only', default='', help='prompts whose id begins so')
    parser.add_argument(
        '--first',
        type=int,
        default=None,
        metavar='N',
        help='of each file the first N of the prompts that are measured',
    )
    parser.add_argument(
        '--anywhere',
        action='store_true',
        help='only prompts that name no landmark and no street of a bundled map',
    )
    parser.add_argument(
        '--limit-s', type=float, default=600.0, help='wall seconds that a trial may take'
    )
    parser.add_argument(
        '--results', type=Path, default=None, metavar='FOLDER', help='for JSON, Markdown, journal'
    )
    parser.add_argument(
        '--resume',
        type=Path,
        default=None,
        metavar='PLACE',
        help='go on with the journal in this folder or file; begun where there is none',
    )
    parser.add_argument('--keep', type=Path, default=None, metavar='FOLDER', help='keep the runs')
    parser.add_argument('--name', default=ruler.name, help='of the files of results')
    parser.add_argument('--totals', action='store_true', help='show no single prompt')
    parser.add_argument('--json', action='store_true', help='one JSON document, no tables')
    ruler.add_options(parser)
    return parser


def _check(options: argparse.Namespace) -> None:
    if options.jobs < 1:
        raise ConfigError(f'--jobs needs at least 1 worker, found {options.jobs}')
    if options.repair is not None and options.repair < 0:
        raise ConfigError(f'--repair needs a number from 0 on, found {options.repair}')
    if not options.limit_s > 0.0:
        raise ConfigError(f'--limit-s needs more than 0 s, found {options.limit_s:g}')
    if options.map not in list_maps():
        raise ConfigError(f'there is no map {options.map!r}', hint='see aurora map list')


def _trials(
    ruler: Ruler, files: Sequence[PromptFile], options: argparse.Namespace
) -> Iterator[Trial]:
    """Yield every prompt with every seed: a prompt and a seed are one trial."""
    named = places_of_maps() if options.anywhere else frozenset()
    for file in files:
        pairs = [
            (prompt, document)
            for prompt, document in zip(file.prompts, file.documents, strict=True)
            if prompt.id.startswith(options.only)
            and ruler.takes(prompt)
            and named.isdisjoint(place_names(document.get('requirements')))
        ]
        name = Path(file.name).stem
        yield from trials_of(file, pairs[: options.first], options.seeds, name)


def _journal(
    ruler: Ruler, files: Sequence[PromptFile], options: argparse.Namespace, code: str
) -> Journal | None:
    place = options.resume or options.results
    if place is None:
        return None
    own = {name: str(getattr(options, name)) for name in ruler.own_options}
    head = JournalHead(
        campaign=ruler.name,
        files={file.name: file.sha256 for file in files},
        options={
            'map': options.map,
            'repair': str(options.repair),
            **own,
            **product_versions(),
            'code': code,
        },
    )
    path = journal_path(place, options.name)
    return Journal(path, head, resume=options.resume is not None)


@contextmanager
def _folder(ruler: Ruler, keep: Path | None) -> Iterator[Path]:
    """Give the folder of all runs; a temporary one goes, also what a killed worker has left."""
    if keep is not None:
        yield keep.absolute()
        return
    with tempfile.TemporaryDirectory(
        prefix=f'aurora_{ruler.name}_', ignore_cleanup_errors=True
    ) as name:
        yield Path(name)


def _campaign(
    work: Work[Trial, JudgedTrial],
    trials: Sequence[Trial],
    options: argparse.Namespace,
    journal: Journal | None,
    progress: Progress,
) -> tuple[JudgedTrial, ...]:
    """Return the result of every trial in the order of the prompts, whoever was done first."""
    finished = journal.finished if journal is not None else {}
    judged = {
        t.key: JudgedTrial.model_validate(finished[t.key]) for t in trials if t.key in finished
    }
    for trial in trials:
        if trial.key in judged:
            progress.step(f'{_shown(judged[trial.key], options)} (from the journal)')
    left = [t for t in trials if t.key not in judged]
    # Closed before anything else goes: a worker that is still at it would write into the folder.
    trials_run = judged_trials(work, left, jobs=options.jobs, limit_s=options.limit_s)
    with closing(trials_run) as answers:
        for index, result in answers:
            key = left[index].key
            judged[key] = result
            if journal is not None:
                journal.add(key, result.model_dump(mode='json'))
            progress.step(_shown(result, options))
    return tuple(judged[t.key] for t in trials)


def _shown(result: JudgedTrial, options: argparse.Namespace) -> str:
    if options.totals:
        return 'done'
    words = f': {", ".join(result.words)}' if result.words else ''
    told = 'right' if result.cause is None else f'{result.cause.value}{words}'
    seed = f' seed {result.seed}' if len(options.seeds) > 1 else ''
    return f'{result.id}{seed}: {result.status}; {told}'


def _tell(
    ruler: Ruler,
    files: Sequence[PromptFile],
    judged: Sequence[JudgedTrial],
    options: argparse.Namespace,
    code: str,
    machine: Machine,
    progress: Progress,
) -> None:
    """Print tables (or JSON), write results, print the lines that programs read."""
    wall_s = progress.elapsed_s
    last = verdict_line(
        ruler.word,
        right_share(judged),
        ruler.of,
        len(silent_failures(judged)),
        unchecked_share(judged),
    )
    placed = [t.placed for t in judged if t.placed is not None]
    head = [read_back_line(placed)] if placed else []
    head += [repair_line(ruler.word, judged)] if judged else []
    head += [file_line(file) for file in files]
    document: dict[str, Any] = {
        'files': [
            {'name': f.name, 'sha256': f.sha256, 'prompts': len(f.prompts), 'beyond': f.beyond}
            for f in files
        ],
        'code': code,
        'map': options.map,
        'seeds': list(options.seeds),
        'jobs': options.jobs,
        'limit_s': options.limit_s,
        'repair': options.repair,
        'wall_s': wall_s,
        **{name: str(getattr(options, name)) for name in ruler.own_options},
        **as_json(judged, details=not options.totals),
        'last_line': last,
    }
    if not options.totals:
        document['beyond'] = {
            f.name: {p.id: [r.text for r in beyond(p)] for p in f.prompts if beyond(p)}
            for f in files
        }
    tables = total_tables(judged, ruler.word) if judged else ()
    if not options.totals:
        tables += detail_tables(judged)
    if options.results is not None:
        _, written = write_results(
            options.results,
            options.name,
            document,
            title=ruler.about,
            tables=tables,
            notes=('\n'.join(f'`{line}`  ' for line in (*head, last)),),
            machine=machine,
        )
        progress.note(f'see {written}')
    mean = mean_seconds(judged).get('all', 0.0) if judged else 0.0
    progress.note(f'{len(judged)} trials, {options.jobs} jobs, {mean:.2f} s a trial')
    if options.json:
        sys.stdout.write(json_text({'benchmark': ruler.name, **document}) + '\n')
        return
    sys.stdout.write(''.join(f'{markdown_table(table)}\n\n' for table in tables))
    sys.stdout.write(''.join(f'{line}\n' for line in (*head, last)))
