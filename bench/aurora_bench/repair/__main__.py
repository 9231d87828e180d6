# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`aurora bench repair`: faults with known causes, and whether repair finds and mends them."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence
from contextlib import closing
from pathlib import Path
from statistics import median

from aurora_bench.interrupt import stop_on_sigterm
from aurora_bench.machine import machine_facts
from aurora_bench.progress import Progress
from aurora_bench.repair.campaign import Episode, RepairWork
from aurora_bench.repair.faults import KINDS, Fault, faults
from aurora_bench.results import Goal, Table, markdown_table, write_results
from aurora_bench.resumable.pool import Lost, run_tasks
from aurora_core.report.share import Share

_TITLE = 'Faults with known causes that repair finds and mends'


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the campaign; return 0, or 1 when a trial was lost."""
    stop_on_sigterm()
    parser = argparse.ArgumentParser(prog='aurora bench repair', description=_TITLE)
    parser.add_argument('--number', type=int, default=200, help='faults, of all kinds in turn')
    parser.add_argument('--kinds', default='', help='only kinds with these words (commas)')
    parser.add_argument('--no-replay', action='store_true', help='repair without the surrogate')
    parser.add_argument('--seed', type=int, default=1, help='of what is drawn')
    parser.add_argument('--repair', type=int, default=None, metavar='N', help='as aurora run')
    parser.add_argument('--map', default='downtown')
    parser.add_argument('--jobs', type=int, default=1, help='worker processes')
    parser.add_argument('--limit-s', type=float, default=600.0, help='wall seconds of a trial')
    parser.add_argument('--results', type=Path, default=None, help='folder for JSON and Markdown')
    parser.add_argument(
        '--resume', action='store_true', help='go on with a campaign that was cut short'
    )
    parser.add_argument('--name', default='repair', help='of the files of results')
    options = parser.parse_args(arguments)
    machine = machine_facts()
    drawn = faults(options.number, options.seed)
    words = options.kinds.split(',')
    tasks = tuple(fault for fault in drawn if any(word in fault.kind for word in words))
    kept = None if options.results is None else options.results / f'{options.name}.part.jsonl'
    found = {} if kept is None or not options.resume else _before(kept, tasks)
    begun = [k for k in range(len(tasks)) if k not in found]
    progress = Progress('repair', len(begun))
    lost: dict[str, str] = {}
    work = RepairWork(map_name=options.map, budget=options.repair, replay=not options.no_replay)
    todo = [tasks[k] for k in begun]
    answers = run_tasks(work, todo, jobs=options.jobs, limit_s=options.limit_s)
    with closing(answers) as results:
        for number, result in results:
            index = begun[number]
            if isinstance(result, Lost):
                lost[tasks[index].key] = result.why
                progress.step(f'{tasks[index].key}: {result.why}')
            else:
                found[index] = result
                if kept is not None:
                    _keep(kept, result)
                progress.step(f'{result.key}: {_told(result)}')
    episodes = [found[k] for k in sorted(found)]
    table, line = kinds_table(episodes), last_line(episodes)
    sys.stdout.write(f'{markdown_table(table)}\n\n{line}\n')
    if options.results is not None:
        write_results(
            options.results,
            options.name,
            {
                'seed': options.seed,
                'lost': lost,
                'episodes': [episode.model_dump(mode='json') for episode in episodes],
                'last_line': line,
            },
            title=_TITLE,
            goals=goals(episodes),
            tables=(table,),
            notes=(f'`{line}`',),
            machine=machine,
        )
    if kept is not None and not lost:
        kept.unlink(missing_ok=True)
    return 1 if lost else 0


def _keep(path: Path, episode: Episode) -> None:
    """Add an episode to what a campaign that is cut short leaves behind."""
    path.parent.mkdir(parents=True, exist_ok=True)
    with path.open('a', encoding='utf-8') as file:
        file.write(f'{episode.model_dump_json()}\n')


def _before(path: Path, tasks: Sequence[Fault]) -> dict[int, Episode]:
    """Return the episodes that a campaign left, by their place among the tasks."""
    if not path.exists():
        return {}
    lines = path.read_text(encoding='utf-8').splitlines()
    done = {e.key: e for e in map(Episode.model_validate_json, lines)}
    return {k: done[task.key] for k, task in enumerate(tasks) if task.key in done}


def _told(episode: Episode) -> str:
    if not episode.showed:
        return f'{episode.status}, no fault shows'
    word = 'repaired' if episode.repaired else 'not repaired'
    return f'{word} with {episode.simulations} ({", ".join(episode.steps)})'


def kinds_table(episodes: Sequence[Episode]) -> Table:
    """Return what came of each kind of fault."""
    rows = []
    for kind in KINDS:
        own = [e for e in episodes if e.kind == kind]
        shown = [e for e in own if e.showed]
        spent = [e.simulations for e in shown if e.repaired]
        rows.append(
            (
                kind,
                len(own),
                len(shown),
                sum(e.repaired for e in shown),
                sum(e.localized for e in shown),
                median(spent) if spent else None,
            )
        )
    return Table(
        headings=('fault', 'drawn', 'violated', 'repaired', 'cause in first 3', 'median runs'),
        rows=tuple(rows),
        caption='Violated: while the same request holds with a good value in its place',
    )


def goals(episodes: Sequence[Episode]) -> tuple[Goal, ...]:
    """Return the goals of repair and whether they are met."""
    shown, locked = _shown(episodes)
    mended = [e for e in shown if e.repaired]
    share, near = (
        Share(met=len(mended), total=len(shown)),
        Share(met=sum(e.localized for e in shown), total=len(shown)),
    )
    spent = median(e.simulations for e in mended) if mended else 0.0
    kept = sum(e.preserved for e in (*shown, *locked))
    refused = sum(not e.repaired for e in locked)
    times = median(e.times for e in shown) if shown else 0.0
    return (
        _goal('repaired', '>= 0.85', f'{share.value:.3f}', share.value >= 0.85),
        _goal('median co-simulations', '<= 2', f'{spent:g}', bool(mended) and spent <= 2),
        _goal('cause among the first three', '>= 0.95', f'{near.value:.3f}', near.value >= 0.95),
        _goal(
            'request unchanged',
            'all',
            f'{kept} of {len(shown) + len(locked)}',
            kept == len(shown) + len(locked),
        ),
        _goal(
            'locked faults stay violated',
            'all',
            f'{refused} of {len(locked)}',
            bool(locked) and refused == len(locked),
        ),
        _goal('median episode in first realisations', '<= 3', f'{times:.2f}', times <= 3.0),
    )


def _shown(episodes: Sequence[Episode]) -> tuple[list[Episode], list[Episode]]:
    """Return the faults that show: those that repair may mend, and those that are locked."""
    shown = [e for e in episodes if e.showed]
    return [e for e in shown if e.mends], [e for e in shown if not e.mends]


def _goal(name: str, target: str, figure: str, met: bool) -> Goal:
    return Goal(name=name, target=target, figure=figure, met=met)


def last_line(episodes: Sequence[Episode]) -> str:
    """Return the line that programs read."""
    shown, _ = _shown(episodes)
    mended = [e for e in shown if e.repaired]
    share = Share(met=len(mended), total=len(shown))
    low, high = share.interval
    spent = f'{median(e.simulations for e in mended):g}' if mended else '-'
    return (
        f'repaired {share.met} of {share.total} faults  {share.value:.3f} [{low:.3f}, {high:.3f}]'
        f'  median co-simulations {spent}  cause among first three '
        f'{sum(e.localized for e in shown)} of {len(shown)}  request unchanged '
        f'{sum(e.preserved for e in shown)} of {len(shown)}'
    )


if __name__ == '__main__':
    sys.exit(main())
