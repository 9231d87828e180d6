# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`python -m aurora_bench.deaths --results docs/bench` (also: `make bench-deaths`).

Broken off, it goes on where it was: what is done is in `deaths.journal.jsonl` beside the results.
"""

from __future__ import annotations

import argparse
import sys
import tempfile
from collections.abc import Sequence
from pathlib import Path

from aurora_bench.deaths.report import write_report
from aurora_bench.deaths.stages import Death, DeathResult, Undisturbed, deaths, strike
from aurora_bench.deaths.whole import SeenClock, WholeKill, WholeKiller
from aurora_bench.faults.client import Client
from aurora_bench.faults.live_graph import CampaignError, LiveGraph
from aurora_bench.interrupt import stop_on_sigterm
from aurora_bench.machine import machine_facts
from aurora_bench.progress import Progress
from aurora_bench.resumable.code import code_digest
from aurora_bench.resumable.journal import Journal, JournalHead
from aurora_core.errors import AuroraError
from aurora_core.trace.definitions import message_definitions
from aurora_ros import interfaces as on
from aurora_ros.testing.domains import own_domain
from aurora_ros.testing.partner import partner


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the campaign; 1 when something does not hold."""
    stop_on_sigterm()
    parser = argparse.ArgumentParser(prog='aurora_bench.deaths', description=__doc__)
    parser.add_argument('--results', type=Path, default=Path('docs/bench'), metavar='FOLDER')
    parser.add_argument('--seed', type=int, default=1)
    parser.add_argument('--kills', type=int, default=200, help='graphs that are killed whole')
    parser.add_argument(
        '--only', nargs='*', default=None, metavar='WORD',
        help='only deaths whose name (node-SIGNAL-stage) holds one of the words; none without',
    )  # fmt: skip
    options = parser.parse_args(arguments)
    chosen = deaths() if options.only is None else deaths(options.only) if options.only else []
    head = JournalHead(
        campaign='deaths',
        files={},
        options={'code': code_digest(), 'seed': str(options.seed)},
    )
    path = options.results / 'deaths.journal.jsonl'
    with Journal(path, head, resume=True) as journal:
        _run(chosen, options, journal)
    results = [DeathResult.model_validate(journal.finished[one.name]) for one in chosen]
    kills = [
        WholeKill.model_validate(journal.finished[f'whole {number}'])
        for number in range(options.kills)
    ]
    held = write_report(options.results, results, kills, machine_facts())
    path.unlink()
    return int(not held)


def _run(chosen: Sequence[Death], options: argparse.Namespace, journal: Journal) -> None:
    todo = [one for one in chosen if one.name not in journal.finished]
    kills = [n for n in range(options.kills) if f'whole {n}' not in journal.finished]
    if not todo and not kills:
        return
    progress = Progress('deaths', len(todo) + len(kills))
    with tempfile.TemporaryDirectory(prefix='aurora-deaths-') as name, own_domain() as domain:
        graph = LiveGraph(Path(name), domain)
        try:
            with partner(domain) as play:
                clock = SeenClock()
                play.on(on.CLOCK, clock.on_clock)
                client = Client(play)
                known = Undisturbed(graph, client)
                for one in todo:
                    try:
                        result = strike(graph, client, known, one)
                    except CampaignError as err:
                        result = DeathResult(death=one, note=str(err))
                    _keep(journal, one.name, result)
                    progress.step(f'{"held" if result.held else "NOT HELD"} {result}')
                killer = WholeKiller(graph, client, known, clock, message_definitions())
                for number in kills:
                    kill = killer.kill(number, options.seed)
                    _keep(journal, f'whole {number}', kill)
                    progress.step(f'{"held" if kill.held else "NOT HELD"} {kill}')
        finally:
            graph.down()


def _keep(journal: Journal, key: str, result: DeathResult | WholeKill) -> None:
    values = result.model_dump(mode='json')
    journal.add(key, values)
    journal.finished[key] = values


if __name__ == '__main__':
    try:
        sys.exit(main())
    except AuroraError as err:
        sys.stderr.write(f'deaths: {err}\n')
        sys.exit(1)
