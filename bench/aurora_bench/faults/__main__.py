# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Nodes that die in every phase of a run, up and down, many prompts in one graph."""

from __future__ import annotations

import argparse
import sys
import tempfile
from pathlib import Path

from aurora_bench.faults.client import Client, trace_hash
from aurora_bench.faults.live_graph import CampaignError, LiveGraph
from aurora_bench.faults.matrix import PROMPT, Cell, CellResult, cells, run_cell
from aurora_bench.faults.prompts import PromptRounds, run_prompts
from aurora_bench.faults.report import write_report
from aurora_bench.faults.updown import Round, run_round
from aurora_bench.interrupt import stop_on_sigterm
from aurora_bench.progress import Progress
from aurora_core.errors import AuroraError
from aurora_ros.testing.domains import own_domain
from aurora_ros.testing.partner import partner


def main(argv: list[str] | None = None) -> int:
    """Run the campaign; 1 when something does not hold."""
    options = _options(argv)
    stop_on_sigterm()
    chosen = cells(options.only) if options.matrix else []
    steps = len(chosen) + options.updown + (options.prompts + 1 if options.prompts else 0)
    progress = Progress('faults', steps)
    results: list[CellResult] = []
    rounds: list[Round] = []
    prompts: PromptRounds | None = None
    with tempfile.TemporaryDirectory(prefix='aurora-faults-') as name, own_domain() as domain:
        graph = LiveGraph(Path(name), domain)
        try:
            for number in range(options.updown):
                rounds.append(run_round(graph, number))
                progress.step(f'up and down: {rounds[-1].model_dump_json()}')
            if chosen or options.prompts:
                graph.up()
                with partner(domain) as play:
                    client = Client(play)
                    results = _matrix(graph, client, chosen, progress)
                    if options.prompts:
                        prompts = run_prompts(graph, client, options.prompts, progress)
        finally:
            graph.down()
    held = write_report(options.results, results, rounds, prompts)
    return 0 if held else 1


def _matrix(
    graph: LiveGraph, client: Client, chosen: list[Cell], progress: Progress
) -> list[CellResult]:
    if not chosen:
        return []
    reference = client.run(PROMPT)
    expected = trace_hash(reference.result)
    if not expected:
        raise CampaignError(f'the prompt of the campaign gave no trace: {reference.error}')
    results = []
    for cell in chosen:
        try:
            result = run_cell(graph, client, cell, expected)
        except CampaignError as err:
            result = CellResult(cell=cell, note=str(err))
        results.append(result)
        progress.step(
            f'{cell.name}: {"held" if result.held else "NOT HELD"} {result.status} '
            f'{result.named} noticed after {result.noticed_s} s, answer {result.seconds} s '
            f'(hit at {result.hit_at}), then '
            f'{result.next_status} after {result.next_s} s {result.left or ""} {result.note}'
            f'{"" if result.held else " | " + result.message}'
        )
    return results


def _options(argv: list[str] | None) -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog='python -m aurora_bench.faults', description=__doc__)
    parser.add_argument('--results', type=Path, default=Path('docs/bench'), metavar='FOLDER')
    parser.add_argument(
        '--only', nargs='+', default=(), metavar='WORD',
        help='only the cells whose name (component-SIGNAL-phase) holds one of the words',
    )  # fmt: skip
    parser.add_argument('--no-matrix', dest='matrix', action='store_false', help='no cells at all')
    parser.add_argument('--updown', type=int, default=50, metavar='N', help='starts and stops')
    parser.add_argument('--prompts', type=int, default=20, metavar='N', help='different prompts')
    return parser.parse_args(argv)


if __name__ == '__main__':
    try:
        sys.exit(main())
    except AuroraError as err:
        sys.stderr.write(f'faults: {err}\n')
        sys.exit(1)
