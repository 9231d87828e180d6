# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Promises that other benchmarks count already: read from what they left in the results folder."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from aurora_bench.trust.part import NOTHING, Found
from aurora_core.files import DOCUMENT_BYTES, read_json

_Result = dict[str, Any]


@dataclass(frozen=True, slots=True, kw_only=True)
class Counted:
    """A promise and the benchmark that counts it.

    Attributes:
        ident: The promise, R1 to R22.
        name: What is tried.
        wanted: How many cases the target asks for.
        bench: `make bench-<this>`.
        read: Counts the cases in its results.
    """

    ident: str
    name: str
    wanted: int
    bench: str
    read: Callable[[_Result], Found]

    def found(self, folder: Path) -> tuple[Found, str]:
        """Return what was counted and when, nothing and '' where the benchmark left nothing."""
        path = folder / f'{self.bench}.json'
        try:
            result = read_json(path, DOCUMENT_BYTES)
            return self.read(result), _when(result)
        except (OSError, ValueError, KeyError, TypeError):
            return NOTHING, ''


def _when(result: _Result) -> str:
    machine = result['machine']
    return f'{machine["date_utc"][:10]}, version {machine["versions"]["aurora"]}'


def _cases(cases: Iterable[tuple[bool, str]]) -> Found:
    listed = list(cases)
    bad = tuple(what for good, what in listed if not good)
    return Found(tried=len(listed), held=len(listed) - len(bad), failures=bad[:20])


def _deaths(result: _Result) -> Found:
    return _cases((c['held'], json.dumps(c['cell'])) for c in result['cells'])


def _nothing_left(result: _Result) -> Found:
    return _cases(
        (not c['left'] and c['next_equal'], json.dumps(c['cell'])) for c in result['cells']
    )


def _up_and_down(result: _Result) -> Found:
    return _cases((r['held'], r['ending']) for r in result['updown'])


def _kills(result: _Result) -> Found:
    return _cases(
        (not k['problem'] and k['lost_s'] <= 1.0 + 1e-9, f'killed at {k["killed_s"]} s')
        for k in result['kills']
    )


def _whole(result: _Result) -> Found:
    return _cases((k['held'], f'graph {k["number"]}, {k["planned"]}') for k in result['whole'])


def _in_stages(result: _Result) -> Found:
    return _cases((c['held'], json.dumps(c['death'])) for c in result['cells'])


def _guided(result: _Result) -> Found:
    parts = [part for each in result['parts'].values() for part in each]
    tried = sum(part['tried'] for part in parts)
    bad = [where for part in parts for where in part['found']]
    bad += [part['problem'] for part in parts if part['problem']]
    slowest = max(part['slowest_s'] for part in parts)
    return Found(
        tried=tried,
        held=tried - len(bad),
        failures=tuple(bad[:20]),
        figures={'slowest [s]': round(slowest, 2)},
    )


def _damaged(result: _Result) -> Found:
    return _cases(
        (d['exit_code'] != 0 and d['integrity'] != 'intact' and bool(d['text']), d['name'])
        for d in result['damaged']
    )


def _repeated(result: _Result) -> Found:
    return Found(
        tried=sum(case['runs'] for case in result['cases']),
        held=sum(case['runs'] for case in result['cases'] if len(case['outcomes']) == 1),
    )


def _replayed(result: _Result) -> Found:
    same = ('live_equals_bag', 'bag_equals_recomputation', 'replay_equals_bag', 'one_trace_hash')
    return _cases((all(run[name] for name in same), run['prompt']) for run in result['runs'])


def _mutants(result: _Result) -> Found:
    kinds = result['kinds'].values()
    return Found(
        tried=sum(kind['judged'] for kind in kinds), held=sum(kind['good'] for kind in kinds)
    )


def _fuzzed(result: _Result) -> Found:
    halves = (result['prompts'], result['replies'])
    tried = sum(half['tried'] for half in halves)
    return Found(
        tried=tried,
        held=tried - sum(len(half['failures']) for half in halves),
        figures={'slowest [s]': round(max(half['slowest_s'] for half in halves), 2)},
    )


def _parallel(result: _Result) -> Found:
    return _cases((run['equal'] and not run['problem'], run['prompt']) for run in result['runs'])


def _endurance(result: _Result) -> Found:
    grown = result['memory_mib'][-1] / result['memory_mib'][result['early_runs'] - 1] - 1.0
    good = all(goal['met'] for goal in result['goals'])
    return Found(
        tried=result['runs'],
        held=result['runs'] if good else 0,
        figures={'memory grown [%]': round(100.0 * grown, 1)},
    )


COUNTED = (
    Counted(ident='R1', name='recorders killed, recovered', wanted=200, bench='bags', read=_kills),
    Counted(ident='R1', name='graphs killed whole', wanted=200, bench='deaths', read=_whole),
    Counted(ident='R2', name='damaged bags', wanted=1200, bench='bags', read=_damaged),
    Counted(
        ident='R3', name='runs repeated, equal', wanted=100, bench='endurance', read=_repeated
    ),
    Counted(
        ident='R4', name='live, bag and replay equal', wanted=30, bench='replay', read=_replayed
    ),
    Counted(ident='R5', name='altered runs', wanted=500, bench='mutation', read=_mutants),
    Counted(ident='R6', name='nodes that die in a run', wanted=63, bench='faults', read=_deaths),
    Counted(
        ident='R6', name='nodes that die from start to repair', wanted=168, bench='deaths',
        read=_in_stages,
    ),
    Counted(
        ident='R7', name='nothing left, next run equal', wanted=144, bench='faults',
        read=_nothing_left,
    ),
    Counted(ident='R8', name='up and down', wanted=200, bench='faults', read=_up_and_down),
    Counted(
        ident='R9', name='damaged prompts and replies', wanted=20_000, bench='fuzz', read=_fuzzed
    ),
    Counted(
        ident='R9', name='inputs led to new code', wanted=6_000_000, bench='guided', read=_guided
    ),
    Counted(
        ident='R17', name='runs of four graphs at once', wanted=40, bench='graphs', read=_parallel
    ),
    Counted(
        ident='R19', name='runs in one process', wanted=500, bench='endurance', read=_endurance
    ),
)  # fmt: skip
