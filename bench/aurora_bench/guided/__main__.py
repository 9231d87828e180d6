# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`python -m aurora_bench.guided --results docs/bench` (also: `make bench-guided`).

Each kind of input is tried in parts; broken off, the campaign goes on with the next part.
"""

from __future__ import annotations

import argparse
import json
import re
import subprocess
import sys
import tempfile
from collections.abc import Sequence
from pathlib import Path

from aurora_bench.guided.corpus import keep, keep_found, kept
from aurora_bench.guided.fuzzer import FuzzerError, environment
from aurora_bench.guided.targets import TARGETS, Target
from aurora_bench.guided.worker import BOUNDS_S
from aurora_bench.interrupt import stop_on_sigterm
from aurora_bench.machine import machine_facts
from aurora_bench.progress import Progress
from aurora_bench.results import Goal, Table, told_goals, write_results
from aurora_bench.resumable.code import code_digest
from aurora_bench.resumable.journal import Journal, JournalHead
from aurora_core.document import Document
from aurora_core.errors import AuroraError

ROOT = Path(__file__).resolve().parents[3]
LIMIT_S = 1.0
_LONGEST_S = 7200.0


class Part(Document):
    """What one fuzzer found.

    Attributes:
        tried: Inputs.
        counts: Of them by the upper bounds of how long they took; the last one is above all.
        slowest_s: Processor time of the slowest, with the code instrumented.
        edges: Edges of the code that were reached.
        found: What was raised that must not be, by where, with the input (hex).
        problem: How the fuzzer itself ended, '' when as it should.
    """

    tried: int
    counts: tuple[int, ...]
    slowest_s: float
    edges: int
    found: dict[str, dict[str, str]]
    problem: str = ''


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the campaign; return 1 when anything was found."""
    stop_on_sigterm()
    parser = argparse.ArgumentParser(prog='aurora_bench.guided', description=__doc__)
    parser.add_argument('--results', type=Path, default=Path('docs/bench'), metavar='FOLDER')
    parser.add_argument('--only', nargs='+', choices=tuple(TARGETS), default=tuple(TARGETS))
    parser.add_argument('--runs', type=int, default=20_000, help='inputs of each part')
    parser.add_argument('--parts', type=int, default=1, help='parts of each kind')
    parser.add_argument('--keep', action='store_true', help='keep what reaches new code')
    options = parser.parse_args(arguments)
    head = JournalHead(
        campaign='guided',
        files={},
        options={'code': code_digest(), 'runs': str(options.runs)},
    )
    path = options.results / 'guided.journal.jsonl'
    surroundings = environment(ROOT)
    progress = Progress('guided', len(options.only) * options.parts)
    parts: dict[str, list[Part]] = {name: [] for name in options.only}
    with Journal(path, head, resume=True) as journal:
        for name in options.only:
            for number in range(options.parts):
                key = f'{name} {number}'
                if key not in journal.finished:
                    part = _run(TARGETS[name], number + 1, options, surroundings)
                    journal.add(key, part.model_dump(mode='json'))
                    journal.finished[key] = part.model_dump(mode='json')
                part = Part.model_validate(journal.finished[key])
                parts[name].append(part)
                progress.step(
                    f'{name}: {part.tried} inputs, {part.edges} edges, {len(part.found)} found '
                    f'{part.problem}'
                )
    code = _report(options.results, parts)
    path.unlink()
    return code


def _run(
    target: Target, seed: int, options: argparse.Namespace, surroundings: dict[str, str]
) -> Part:
    with tempfile.TemporaryDirectory(prefix='aurora_guided_') as name:
        folder = Path(name).resolve()
        fresh, seeds = folder / 'fresh', folder / 'seeds'
        for one in (fresh, seeds):
            one.mkdir()
        for k, data in enumerate((*target.seeds(), *kept(target.name))):
            (seeds / f'{k:05d}').write_bytes(data[: target.most_bytes])
        words = folder / 'words'
        words.write_text(''.join(map(_entry, target.words())), encoding='ascii')
        common = ['--runs', str(options.runs), '--seed', str(seed), '--words', str(words)]
        command = [sys.executable, '-m', 'aurora_bench.guided.worker', target.name]
        done = subprocess.run(
            [*command, str(folder / 'tally.json'), str(fresh), str(seeds), *common],
            env=surroundings, capture_output=True, text=True, errors='replace',
            timeout=_LONGEST_S, check=False,
        )  # fmt: skip
        try:
            tally = json.loads((folder / 'tally.json').read_text())
        except OSError as err:
            raise FuzzerError(f'{target.name}: {done.stderr.strip()[-800:]}') from err
        problem = '' if done.returncode == 0 else f'it ended with {done.returncode}'
        for path in folder.glob('*-*'):
            if path.name.startswith(('crash-', 'timeout-', 'oom-')):
                problem = f'{path.name.partition("-")[0]} on {path.read_bytes().hex()[:400]}'
        for finding in tally['found'].values():
            if options.keep:
                keep_found(target.name, bytes.fromhex(finding['input']))
        if options.keep:
            # The fuzzer writes what reaches an edge that nothing before it has reached.
            keep(target.name, (path.read_bytes() for path in fresh.iterdir()))
        return Part(**tally, edges=_edges(done.stderr), problem=problem)


def _entry(word: str) -> str:
    """Return a word as libFuzzer reads one."""
    safe = ''.join(
        chr(byte) if 32 < byte < 127 and byte not in b'"\\' else f'\\x{byte:02x}'
        for byte in word.encode('utf-8')
    )
    return f'"{safe}"\n'


def _edges(said: str) -> int:
    """Return what libFuzzer has told last of the edges that were reached."""
    found = re.findall(r' cov: (\d+)', said)
    return int(found[-1]) if found else 0


def _report(results: Path, parts: dict[str, list[Part]]) -> int:
    rows, goals, findings = [], [], []
    for name, these in parts.items():
        tried = sum(part.tried for part in these)
        found = {where: each for part in these for where, each in part.found.items()}
        problems = [part.problem for part in these if part.problem]
        p99_s = _p99_s(these)
        slowest_s = max(part.slowest_s for part in these)
        edges = max(part.edges for part in these)
        rows.append((name, tried, edges, len(kept(name)), len(found), p99_s, round(slowest_s, 3)))
        findings += [
            (name, where, each['says'], each['input'][:80]) for where, each in found.items()
        ]
        findings += [(name, 'the fuzzer', problem, '') for problem in problems]
        goals += [
            Goal(
                name=f'{name}: nothing raised that must not be, no hang',
                target=f'0 of {tried}',
                figure=str(len(found) + len(problems)),
                met=not found and not problems,
            ),
            Goal(
                name=f'{name}: p99 of one input',
                target=f'under {LIMIT_S:g} s',
                figure=f'{p99_s:g} s',
                met=p99_s < LIMIT_S,
            ),
        ]
    headings = ('input', 'tried', 'edges', 'kept', 'found', 'p99 [s]', 'slowest [s]')
    tables = [Table(headings=headings, rows=rows, caption='Inputs by kind')]
    if findings:
        columns = ('input', 'where', 'says', 'bytes (hex)')
        tables.append(Table(headings=columns, rows=findings, caption='What was found'))
    write_results(
        results,
        'guided',
        {'parts': {n: [p.model_dump(mode='json') for p in each] for n, each in parts.items()}},
        title='Inputs changed towards code that none has reached',
        goals=goals,
        tables=tables,
        notes=(
            'atheris (libFuzzer) over the Python of AURORA; processor time with the code '
            'instrumented, which is some times as slow. Of maps what is read before and after '
            'netconvert, which is not called.',
        ),
        machine=machine_facts(),
    )
    return told_goals(goals)


def _p99_s(parts: Sequence[Part]) -> float:
    """Return an upper bound of the time of 99 of 100 inputs."""
    counts = [sum(column) for column in zip(*(part.counts for part in parts), strict=True)]
    below, total = 0, sum(counts)
    for bound_s, count in zip((*BOUNDS_S, float('inf')), counts, strict=True):
        below += count
        if below >= 0.99 * total:
            return round(bound_s, 4)
    return float('inf')


if __name__ == '__main__':
    try:
        sys.exit(main())
    except AuroraError as err:
        sys.stderr.write(f'guided: {err}\n')
        sys.exit(1)
