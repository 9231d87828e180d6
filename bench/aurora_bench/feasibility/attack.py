# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`python -m aurora_bench.feasibility.attack`: try to realise what was proven impossible.

Certified requests of the families, as annotations and as the offline parser reads them, run in the
local engine as if they had not been refused: with other seeds, at other places of the map, and
with what nobody states drawn anew from its domain. The independent checker says whether a run is
what was asked, and the product whether it kept what every run has to keep: one such run refutes a
certificate, however often it was checked.

A number beyond a limit is left out: the limit says so, not the world. So are flights longer than
the battery, which take minutes to fly. Finished runs are kept in a journal; `--resume` goes on.
"""

from __future__ import annotations

import argparse
import dataclasses
import random
import shutil
import sys
import tempfile
import time
from collections import Counter
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from aurora_bench.campaign.code import code_digest
from aurora_bench.campaign.journal import Journal, JournalHead, journal_path
from aurora_bench.feasibility.families import Case, family_cases
from aurora_bench.feasibility.judge import judged
from aurora_bench.progress import Progress
from aurora_bench.results import Table, markdown_table, write_results
from aurora_bench.rulers.checking import Check, asked_of, independent_checker
from aurora_bench.rulers.runs import on_map
from aurora_cli.installed import installed
from aurora_cli.local_engine import LocalStages
from aurora_core.errors import AuroraError
from aurora_core.outcomes.feasibility import Rule
from aurora_core.outcomes.parse import ParseOutcome
from aurora_core.outcomes.repair import Anchor, RepairPlan
from aurora_core.pipeline.functions import parse_stage, understood
from aurora_core.pipeline.stages import RunControl, RunRequest
from aurora_core.spec.scenario import ScenarioSpec

# A number that nobody states is drawn anew this often; else it stays as it is. A place where an
# earlier run has been is avoided as often.
_DRAWN = 0.5
# Certificates of flights that last longer say little about placements and take hours to fly.
_LONGEST_S = 400.0
_MOST_AGENTS = 20
# What every run has to keep and no annotation says: clearance, separation, no-fly zones.
_SAFETY = 'safety.'
# How an attack can end; only the first one refutes a certificate.
REALISED = 'realised'
DENIED = 'denied'  # the checker denies a requirement
UNSAFE = 'unsafe'  # nothing is denied, but the run broke what every run has to keep
UNDECIDED = 'undecided'  # nothing is denied, and something cannot be told
NO_PLACE = 'no place'
ERROR = 'error'
_ENDS = (REALISED, DENIED, UNSAFE, UNDECIDED, NO_PLACE, ERROR)


def main(arguments: Sequence[str] | None = None) -> int:
    """Attack; return 0 when nothing was realised, else 1."""
    options = _options(arguments)
    chosen = _sample(_certified(options.map, options.only), options.each)
    head = JournalHead(
        campaign='attack',
        files={'code': code_digest()},
        options={'map': options.map, 'seed': str(options.seed)},
    )
    path = journal_path(options.resume or options.results or Path('/tmp'), options.name)
    told: dict[str, dict[str, Any]] = {}
    with (
        Journal(path, head, resume=options.resume is not None) as journal,
        tempfile.TemporaryDirectory(prefix='aurora_attack_') as place,
    ):
        told.update(journal.finished)
        _attack(chosen, options, Path(place), journal, told)
        if all(_key(case, k) in told for case in chosen for k in range(options.runs)):
            journal.end()
    ends = [_ends(case, told) for case in chosen]
    table = _table(chosen, ends)
    found, runs = sum(e[REALISED] for e in ends), sum(e.total() for e in ends)
    line = f'attacked {len(chosen)} requests, {runs} runs; realised {found}'
    sys.stdout.write(f'{markdown_table(table)}\n\n{line}\n')
    if options.results is not None:
        document = {'rows': [list(row) for row in table.rows], 'last_line': line}
        title = 'What was proven impossible, tried'
        write_results(options.results, options.name, document, title=title, tables=(table,))
    return 1 if found else 0


def _options(arguments: Sequence[str] | None) -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog='aurora_bench.feasibility.attack', description=__doc__)
    parser.add_argument('--map', default='downtown')
    parser.add_argument('--each', type=int, default=0,
                        help='requests per reason, read or annotated; 0: all')  # fmt: skip
    parser.add_argument('--runs', type=int, default=200, help='runs of each')
    parser.add_argument('--minutes', type=float, default=0.0, help='stop then; 0: never')
    parser.add_argument('--seed', type=int, default=1, help='of what is drawn')
    parser.add_argument('--only', default='', help='requests whose id begins so')
    parser.add_argument('--resume', type=Path, default=None, help='journal, or its folder')
    parser.add_argument('--results', type=Path, default=None, help='folder for JSON and Markdown')
    parser.add_argument('--name', default='feasibility_attack', help='of the files of results')
    return parser.parse_args(arguments)


def _certified(map_name: str, only: str) -> list[Case]:
    """Return requests that are refused and that a run could be long enough for."""
    known = installed()
    found = []
    for case in family_cases():
        if not case.document or not case.must_be_refused or not case.id.startswith(only):
            continue
        proofs = judged(known, map_name, case).certificates
        if not any(p.rule not in (Rule.LIMIT, Rule.COUNT, Rule.BATTERY) for p in proofs):
            continue
        spec = case.spec or parse_stage(known, case.prompt, map_name, 1).spec
        if spec is None:
            continue
        long = [m.duration_s for m in spec.missions if m.duration_s is not None]
        world = spec.world.duration_s
        length = sum(d.value for d in long) + (world.value if world is not None else 0.0)
        if length <= _LONGEST_S and len(spec.agents) <= _MOST_AGENTS:
            found.append(dataclasses.replace(case, spec=spec))
    return found


def _sample(cases: Sequence[Case], each: int) -> list[Case]:
    """Return so many requests of every reason and source: of both, other ones where it can be."""
    if each == 0:
        return list(cases)
    groups: dict[tuple[str, str], list[Case]] = {}
    for case in cases:
        groups.setdefault((case.because[0], case.source), []).append(case)
    return [
        case
        for (_, source), group in groups.items()
        for case in (group[:each] if source == 'annotation' else group[-each:])
    ]


def _key(case: Case, index: int) -> str:
    return f'{case.source}/{case.id}/{index}'


def _attack(
    cases: Sequence[Case],
    options: argparse.Namespace,
    place: Path,
    journal: Journal,
    told: dict[str, dict[str, Any]],
) -> None:
    """Run all cases in turn, so that however early it ends every one has been tried."""
    stages, check = LocalStages(installed()), independent_checker()
    left = [(c, k) for k in range(options.runs) for c in cases if _key(c, k) not in told]
    progress = Progress('attack', len(left))
    end = time.monotonic() + 60.0 * options.minutes if options.minutes else None
    for done, (case, k) in enumerate(left):
        if end is not None and time.monotonic() > end:
            progress.note(f'the time is over: {len(left) - done} runs are left')
            return
        places = [r['place'] for i in range(k) if (r := told.get(_key(case, i))) and r['place']]
        draw = random.Random(f'{options.seed} {case.id} {k}')
        result = _Attacked(stages, check, options.map, place).once(case, k, draw, places)
        told[_key(case, k)] = result
        journal.add(_key(case, k), result)
        minutes = progress.elapsed_s / (done + 1) * (len(left) - done - 1) / 60.0
        what = f'{case.source} {case.id} {k}: {result["ended"]} {", ".join(result["why"])}'
        progress.step(f'{what}; {minutes:.0f} min left')


@dataclasses.dataclass
class _Attacked:
    stages: LocalStages
    check: Check
    map_name: str
    place: Path

    def once(
        self, case: Case, index: int, draw: random.Random, places: Sequence[Mapping[str, Any]]
    ) -> dict[str, Any]:
        """Run a request once; the first time as it is, then varied and elsewhere.

        Args:
            case: The request, with its specification.
            index: Of the run; the seed is one more.
            draw: Draws what is varied.
            places: Where earlier runs have been.
        """
        assert case.spec is not None
        asked = on_map(case.spec, self.map_name)
        spec = asked if index == 0 else varied(asked, draw)
        distinct = {p['lane']: p for p in places}
        avoided = tuple(
            Anchor(lane=p['lane'], position_m=p['position_m'], whole_road=draw.random() < _DRAWN)
            for p in distinct.values()
            if draw.random() < _DRAWN
        )
        request = RunRequest(prompt=case.prompt, seed=index + 1, map_name=self.map_name)
        try:
            return self._run(case, spec, request, RepairPlan(avoided=avoided) if avoided else None)
        except AuroraError as err:
            return {'ended': ERROR, 'why': [str(err)], 'place': None}
        finally:
            shutil.rmtree(self.place / 'bag', ignore_errors=True)

    def _run(
        self, case: Case, spec: ScenarioSpec, request: RunRequest, plan: RepairPlan | None
    ) -> dict[str, Any]:
        outcome = understood(self.stages.known, ParseOutcome(spec=spec))
        assert outcome.agsg is not None
        grounding = self.stages.ground(outcome.agsg, request, plan)
        if grounding.agsg is None or grounding.agsg.grounding is None:
            why = [] if grounding.failure is None else [str(grounding.failure.reason)]
            return {'ended': NO_PLACE, 'why': why, 'place': None}
        at = grounding.agsg.grounding
        place = {'lane': at.anchor_lane, 'position_m': at.anchor_position_m}
        result = self.stages.execute(grounding.agsg, self.place / 'bag', request, RunControl())
        said = asked_of(self.check, result.bag, dict(case.document))
        denied = sorted({s.kind for s in said if s.outcome == 'does_not'})
        if denied:
            return {'ended': DENIED, 'why': denied, 'place': place}
        # Only what nothing is denied of is worth all the margins.
        verdict = self.stages.verify(grounding.agsg, result.bag)
        broken = [c.id for c in verdict.results if not c.satisfied]
        unsafe = [ident for ident in broken if ident.startswith(_SAFETY)]
        open_ = sorted({s.kind for s in said if s.outcome != 'holds'})
        ended = UNSAFE if unsafe else UNDECIDED if open_ or not said else REALISED
        return {'ended': ended, 'why': [*open_, *broken], 'place': place}


def _ends(case: Case, told: Mapping[str, Mapping[str, Any]]) -> Counter[str]:
    start = f'{case.source}/{case.id}/'
    return Counter(str(r['ended']) for key, r in told.items() if key.startswith(start))


def _table(cases: Sequence[Case], ends: Sequence[Counter[str]]) -> Table:
    rows: list[tuple[str | int, ...]] = [
        (c.id, c.source, '/'.join(c.because), e.total(), *(e[name] for name in _ENDS))
        for c, e in zip(cases, ends, strict=True)
    ]
    return Table(headings=('request', 'source', 'reason', 'runs', *_ENDS), rows=rows)


def varied(spec: ScenarioSpec, draw: random.Random) -> ScenarioSpec:
    """Return a request with some of what nobody states drawn anew from its domain."""

    def change(value: Any) -> Any:
        if isinstance(value, list):
            return [change(inner) for inner in value]
        if not isinstance(value, dict):
            return value
        if value.get('provenance') == 'default':
            low, high = value['low'], value['high']
            if low < high and draw.random() < _DRAWN:
                return {**value, 'value': round(draw.uniform(low, high), 1)}
            return value
        return {name: change(inner) for name, inner in value.items()}

    return ScenarioSpec.model_validate(change(spec.model_dump(mode='json')))


if __name__ == '__main__':
    sys.exit(main())
