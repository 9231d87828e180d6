# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`aurora bench repair`: faults with known causes, and whether repair finds and mends them."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence
from contextlib import ExitStack, closing
from pathlib import Path
from typing import Any

import yaml

from aurora_bench.interrupt import stop_on_sigterm
from aurora_bench.machine import machine_facts
from aurora_bench.progress import Progress
from aurora_bench.repair.campaign import Episode, RepairWork, with_settings
from aurora_bench.repair.faults import Draws, faults
from aurora_bench.repair.tables import (
    goals,
    kinds_table,
    last_line,
    steps_table,
    surrogate_table,
)
from aurora_bench.results import markdown_table, write_results
from aurora_bench.resumable.code import code_digest
from aurora_bench.resumable.journal import Journal, JournalError, JournalHead, journal_path
from aurora_cli.pool import Lost, run_tasks
from aurora_core.repair.settings import load_repair_settings
from aurora_core.report.versions import product_versions

_TITLE = 'Faults with known causes that repair finds and mends'
USAGE = 64
INTERRUPTED = 130


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the campaign; return 0, or 1 when a trial was lost."""
    stop_on_sigterm()
    options = _parser().parse_args(arguments)
    try:
        settings = _settings(options)
        work = RepairWork(map_name=options.map, budget=options.repair, settings=settings)
        with_settings(load_repair_settings(), settings)
    except (ValueError, yaml.YAMLError) as err:
        sys.stderr.write(f'--set: {err}\n')
        return USAGE
    words = options.kinds.split(',')
    drawn = faults(options.number, options.seed)
    tasks = tuple(fault for fault in drawn if any(word in fault.kind for word in words))
    machine = machine_facts()
    lost: dict[str, str] = {}
    found: dict[str, Episode] = {}
    try:
        with ExitStack() as stack:
            journal = _journal(options, settings)
            if journal is not None:
                stack.enter_context(journal)
            _campaign(work, tasks, options, journal, found, lost)
            if journal is not None and not lost:
                journal.end()
    except JournalError as err:
        sys.stderr.write(f'{err}\n')
        return USAGE
    except KeyboardInterrupt:
        sys.stderr.write('cancelled; --resume goes on with what the journal holds\n')
        return INTERRUPTED
    _tell([found[t.key] for t in tasks if t.key in found], lost, options, settings, machine)
    return 1 if lost else 0


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(prog='aurora bench repair', description=_TITLE)
    parser.add_argument('--number', type=int, default=200, help='faults, of all kinds in turn')
    parser.add_argument('--kinds', default='', help='only kinds with these words (commas)')
    parser.add_argument('--no-replay', action='store_true', help='repair without the surrogate')
    parser.add_argument(
        '--set',
        action='append',
        default=[],
        metavar='NAME=VALUE',
        help='another value in config/repair.yaml, such as lambda_sem=0 or weights.inferred=1',
    )
    parser.add_argument('--seed', type=int, default=1, help='of what is drawn')
    parser.add_argument('--repair', type=int, default=None, metavar='N', help='as aurora run')
    parser.add_argument('--map', default='downtown')
    parser.add_argument('--jobs', type=int, default=1, help='worker processes')
    parser.add_argument('--limit-s', type=float, default=900.0, help='wall seconds of a trial')
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
    parser.add_argument('--name', default='repair', help='of the files of results')
    return parser


def _settings(options: argparse.Namespace) -> dict[str, Any]:
    """Return what of the settings is another value in this campaign."""
    found: dict[str, Any] = {'surrogate.candidates': 0} if options.no_replay else {}
    for text in options.set:
        name, equals, value = text.partition('=')
        if not equals:
            raise ValueError(f'NAME=VALUE is needed, found {text!r}')
        found[name] = yaml.safe_load(value)
    return found


def _journal(options: argparse.Namespace, settings: dict[str, Any]) -> Journal | None:
    """Open the journal; its head holds all that an episode depends on beside its key."""
    place = options.resume or options.results
    if place is None:
        return None
    head = JournalHead(
        campaign='repair',
        files={},
        options={
            'seed': str(options.seed),
            'map': options.map,
            'repair': str(options.repair),
            'settings': str(sorted(settings.items())),
            **product_versions(),
            'code': code_digest(),
        },
    )
    return Journal(journal_path(place, options.name), head, resume=options.resume is not None)


def _campaign(
    work: RepairWork,
    tasks: Sequence[Draws],
    options: argparse.Namespace,
    journal: Journal | None,
    found: dict[str, Episode],
    lost: dict[str, str],
) -> None:
    """Work off what the journal does not hold yet."""
    finished = {} if journal is None else journal.finished
    found |= {t.key: Episode.model_validate(finished[t.key]) for t in tasks if t.key in finished}
    todo = [task for task in tasks if task.key not in found]
    progress = Progress('repair', len(todo))
    answers = run_tasks(work, todo, jobs=options.jobs, limit_s=options.limit_s)
    with closing(answers) as results:
        for number, result in results:
            key = todo[number].key
            if isinstance(result, Lost):
                lost[key] = result.why
                progress.step(f'{key}: {result.why}')
                continue
            found[key] = result
            if journal is not None:
                journal.add(key, result.model_dump(mode='json'))
            progress.step(f'{key}: {_told(result)}')


def _told(episode: Episode) -> str:
    if not episode.showed:
        return f'says nothing of repair: {", ".join(episode.useless)}'
    word = 'repaired' if episode.repaired else f'{episode.status}, not repaired'
    cause = 'cause found' if episode.localized else f'first {", ".join(episode.named)}'
    told = f'{word} with {episode.simulations} ({", ".join(episode.steps)}); {cause}'
    return told if episode.preserved else f'{told}; CHANGED {", ".join(episode.changed)}'


def _tell(
    episodes: Sequence[Episode],
    lost: dict[str, str],
    options: argparse.Namespace,
    settings: dict[str, Any],
    machine: Any,
) -> None:
    tables = (kinds_table(episodes), steps_table(episodes), surrogate_table(episodes))
    line = last_line(episodes)
    sys.stdout.write(''.join(f'{markdown_table(table)}\n\n' for table in tables) + f'{line}\n')
    if options.results is None:
        return
    write_results(
        options.results,
        options.name,
        {
            'seed': options.seed,
            'map': options.map,
            'repair': options.repair,
            'settings': settings,
            'lost': lost,
            'episodes': [episode.model_dump(mode='json') for episode in episodes],
            'last_line': line,
        },
        title=_TITLE,
        goals=goals(episodes),
        tables=tables,
        notes=(f'`{line}`',),
        machine=machine,
    )


if __name__ == '__main__':
    sys.exit(main())
