# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`python -m aurora_bench.feasibility.attack`: try to realise what was proven impossible.

Certified requests of the families, as annotations and as the offline parser reads them, run in the
local engine as if they had not been refused (`attempt.py`): with other seeds, at other places of
the map, with other plans. The independent checker says whether a run is what was asked, and the
product whether it kept what every run has to keep: one such run refutes a certificate, however
often it was checked.

A number beyond a limit is left out: the limit says so, not the world. So are flights longer than
`--longest` seconds. Finished runs are kept in a journal; `--resume` goes on.
"""

from __future__ import annotations

import argparse
import dataclasses
import random
import sys
import tempfile
import time
from collections import Counter
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from aurora_bench.feasibility.attempt import ENDS, REALISED, SEEDS, Attempts
from aurora_bench.feasibility.families import Case, family_cases
from aurora_bench.feasibility.judge import judged
from aurora_bench.progress import Progress
from aurora_bench.results import Table, markdown_table, write_results
from aurora_bench.resumable.code import code_digest
from aurora_bench.resumable.journal import Journal, JournalHead, journal_path
from aurora_bench.rulers.checking import independent_checker
from aurora_cli.installed import installed
from aurora_cli.local_engine import LocalStages
from aurora_core.outcomes.feasibility import Rule
from aurora_core.pipeline.functions import parse_stage

_MOST_AGENTS = 20
# Recordings are judged and thrown away: memory is good enough for them, where it is a folder.
_IN_MEMORY = Path('/dev/shm')


@dataclasses.dataclass(frozen=True, slots=True, kw_only=True)
class Certified:
    """A refused request that can be attacked.

    Attributes:
        case: With its specification.
        rule: By which it was refused first.
    """

    case: Case
    rule: Rule


def main(arguments: Sequence[str] | None = None) -> int:
    """Attack; return 0 when nothing was realised, else 1."""
    options = _options(arguments)
    chosen = _sample(_certified(options.map, options.only, options.longest), options.each)
    head = JournalHead(
        campaign='attack',
        files={'code': code_digest()},
        options={'map': options.map, 'seed': str(options.seed)},
    )
    path = journal_path(options.resume or options.results or Path('/tmp'), options.name)
    told: dict[str, dict[str, Any]] = {}
    memory = _IN_MEMORY if _IN_MEMORY.is_dir() else None
    with (
        Journal(path, head, resume=options.resume is not None) as journal,
        tempfile.TemporaryDirectory(prefix='aurora_attack_', dir=memory) as place,
    ):
        told.update(journal.finished)
        cases = [c.case for c in chosen]
        _attack(cases, options, Path(place), journal, told)
        if all(_key(case, k) in told for case in cases for k in range(options.runs)):
            journal.end()
    tables = _by_request(chosen, told), _by_rule(chosen, told)
    runs = [r for c in chosen for r in _runs(c.case, told)]
    found = sum(r['ended'] == REALISED for r in runs)
    line = f'attacked {len(chosen)} requests, {len(runs)} runs; realised {found}'
    for table in tables:
        sys.stdout.write(f'{markdown_table(table)}\n\n')
    sys.stdout.write(f'{line}\n')
    if options.results is not None:
        document = {'rows': [list(row) for row in tables[0].rows], 'last_line': line}
        title = 'What was proven impossible, tried'
        write_results(options.results, options.name, document, title=title, tables=tables)
    return 1 if found else 0


def _options(arguments: Sequence[str] | None) -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog='aurora_bench.feasibility.attack', description=__doc__)
    parser.add_argument('--map', default='downtown')
    parser.add_argument('--each', type=int, default=0, help='requests per rule; 0: all')
    parser.add_argument('--runs', type=int, default=200, help='runs of each')
    parser.add_argument('--minutes', type=float, default=0.0, help='stop then; 0: never')
    parser.add_argument('--longest', type=float, default=400.0,
                        help='seconds that stated phases may last together')  # fmt: skip
    parser.add_argument('--seed', type=int, default=1, help='of what is drawn')
    parser.add_argument('--only', default='', help='requests whose id begins so')
    parser.add_argument('--resume', type=Path, default=None, help='journal, or its folder')
    parser.add_argument('--results', type=Path, default=None, help='folder for JSON and Markdown')
    parser.add_argument('--name', default='feasibility_attack', help='of the files of results')
    return parser.parse_args(arguments)


def _certified(map_name: str, only: str, longest_s: float) -> list[Certified]:
    """Return requests that are refused and that a run could be long enough for."""
    known = installed()
    found = []
    for case in family_cases():
        if not case.document or not case.must_be_refused or not case.id.startswith(only):
            continue
        rules = [p.rule for p in judged(known, map_name, case).certificates]
        rule = next((r for r in rules if r not in (None, Rule.LIMIT, Rule.COUNT)), None)
        if rule is None:
            continue
        spec = case.spec or parse_stage(known, case.prompt, map_name, 1).spec
        if spec is None:
            continue
        long = [m.duration_s for m in spec.missions if m.duration_s is not None]
        world = spec.world.duration_s
        length = sum(d.value for d in long) + (world.value if world is not None else 0.0)
        if rule is Rule.BATTERY:
            length = max(length, known.limits.uav_endurance_s)
        if length <= longest_s and len(spec.agents) <= _MOST_AGENTS:
            found.append(Certified(case=dataclasses.replace(case, spec=spec), rule=rule))
    return found


def _sample(certified: Sequence[Certified], each: int) -> list[Certified]:
    """Return so many requests of every rule: one family after the other, read or annotated."""
    chosen = []
    for number, rule in enumerate(dict.fromkeys(c.rule for c in certified)):
        families: dict[str, list[Certified]] = {}
        for one in (c for c in certified if c.rule is rule):
            families.setdefault(one.case.id.rpartition('-refused-')[0], []).append(one)
        # One of each family, then another one: as a prompt and as an annotation in turn.
        turns = []
        for k, of in enumerate(families.values()):
            read = [c for c in of if c.case.source == 'prompt']
            built = [c for c in of if c.case.source != 'prompt']
            turns.append([*read, *built] if (number + k) % 2 else [*built, *read])
        longest = max(len(of) for of in turns)
        ordered = [of[k] for k in range(longest) for of in turns if k < len(of)]
        chosen += ordered[: each or None]
    return chosen


def _key(case: Case, index: int) -> str:
    return f'{case.source}/{case.id}/{index}'


def _attack(
    cases: Sequence[Case],
    options: argparse.Namespace,
    place: Path,
    journal: Journal,
    told: dict[str, dict[str, Any]],
) -> None:
    """Run one case after the other; fewer `--runs` at first try all of them."""
    attempts = Attempts(LocalStages(installed()), independent_checker(), options.map, place)
    left = [(c, k) for c in cases for k in range(options.runs) if _key(c, k) not in told]
    progress = Progress('attack', len(left))
    end = time.monotonic() + 60.0 * options.minutes if options.minutes else None
    for done, (case, k) in enumerate(left):
        if end is not None and time.monotonic() > end:
            progress.note(f'the time is over: {len(left) - done} runs are left')
            return
        plan = k // SEEDS
        earlier = [told[_key(case, i)] for i in range(plan * SEEDS)]
        draw = random.Random(f'{options.seed} {case.id} {plan}')
        result = attempts.once(case, k, draw, earlier)
        told[_key(case, k)] = result
        journal.add(_key(case, k), result)
        minutes = progress.elapsed_s / (done + 1) * (len(left) - done - 1) / 60.0
        what = f'{case.source} {case.id} {k}: {result["ended"]} {", ".join(result["why"])}'
        progress.step(f'{what}; {minutes:.0f} min left')


def _runs(case: Case, told: Mapping[str, Mapping[str, Any]]) -> list[Mapping[str, Any]]:
    start = f'{case.source}/{case.id}/'
    return [r for key, r in told.items() if key.startswith(start)]


def _counts(runs: Sequence[Mapping[str, Any]]) -> tuple[int, ...]:
    """Return how many runs there are, on how many lanes, and how they ended."""
    ends = Counter(str(r['ended']) for r in runs)
    lanes = {r['place']['lane'] for r in runs if r['place']}
    return len(runs), len(lanes), *(ends[name] for name in ENDS)


def _by_request(chosen: Sequence[Certified], told: Mapping[str, Mapping[str, Any]]) -> Table:
    rows: list[tuple[str | int, ...]] = [
        (c.case.id, c.case.source, c.rule.value, *_counts(_runs(c.case, told))) for c in chosen
    ]
    return Table(
        headings=('request', 'source', 'rule', 'runs', 'roads', *ENDS),
        rows=rows,
        caption='By request',
    )


def _by_rule(chosen: Sequence[Certified], told: Mapping[str, Mapping[str, Any]]) -> Table:
    rows: list[tuple[str | int, ...]] = []
    for rule in dict.fromkeys(c.rule for c in chosen):
        of = [c.case for c in chosen if c.rule is rule]
        runs, _, *ends = _counts([r for case in of for r in _runs(case, told)])
        rows.append(
            (rule.value, '/'.join(sorted({c.because[0] for c in of})), len(of), runs, *ends)
        )
    return Table(
        headings=('rule', 'reason', 'requests', 'runs', *ENDS), rows=rows, caption='By rule'
    )


if __name__ == '__main__':
    sys.exit(main())
