# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The one table: promise, target, cases tried, cases that held, when and by what."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from aurora_bench.machine import Machine
from aurora_bench.results import Table, write_results
from aurora_bench.trust.counted import COUNTED
from aurora_bench.trust.part import NEVER, Found
from aurora_core.document import Document

PROMISES = {
    'R1': 'nothing acknowledged is ever lost',
    'R2': 'a damaged bag is never a pass and never a crash',
    'R3': 'same request and seed, same trace',
    'R4': 'live verdict = replayed verdict',
    'R5': 'no false pass',
    'R6': 'any node may die at any moment',
    'R7': 'nothing is left behind',
    'R8': 'start and stop always work',
    'R9': 'bad input is refused with a reason',
    'R10': 'bad MAVLink cannot harm',
    'R11': 'a mission is taken whole or not at all',
    'R12': 'a model may misbehave in any way',
    'R13': 'failsafes as documented',
    'R14': 'interoperable',
    'R15': 'SUMO faults are contained',
    'R16': 'time is sane',
    'R17': 'parallel runs do not mix',
    'R18': 'full disk: an error that says so',
    'R19': 'stays small over time',
    'R20': 'orders in a prompt do nothing',
    'R21': 'locked supply chain',
    'R22': 'code quality',
}
# What keeps a number from its target that is no failure.
_WHY = {
    'R2': '`make bench-bags` with --truncations 200 --flips 1000 takes an hour',
    'R19': '100 runs of ten prompts in one process; the graph of 500 is not tried',
}
# Lines that try a part of what their promise says, however many cases they have: never `met`.
_IN_PART = {
    'failsafes, as tests': 'single tests; six phases by three seeds of each are not tried',
    'MAVSDK, as tests': 'one client, pinned; no QGroundControl by hand',
    'SUMO faults, as tests': 'tests of the client, by their names; no crash inside libsumo, no '
    'vehicle that SUMO loses in the middle of a run',
    'clocks, as tests': 'tests of clocks and silences, by their names',
    'clocks moved': 'the local engine; under libfaketime no run of a graph came to its end',
}


class Entry(Document):
    """A line of the table.

    Attributes:
        ident: R1 to R22.
        name: What is tried.
        wanted: Cases that the target asks for.
        least: Share of the cases that has to hold.
        found: Cases tried and held.
        when: Date and version, '' when it was never tried.
        how: The command.
    """

    ident: str
    name: str
    wanted: int
    least: float = 1.0
    found: Found
    when: str
    how: str

    @property
    def kept(self) -> bool:
        """Whether the promise held wherever it was tried."""
        found = self.found
        enough = found.held >= self.least * found.tried
        return found.tried > 0 and enough and not found.figures.get(NEVER)

    @property
    def result(self) -> str:
        """In a word or two."""
        if not self.found.tried:
            return 'not tried'
        if not self.kept:
            return 'NOT HELD'
        if self.found.tried < self.wanted:
            return 'held, fewer tried'
        return 'held, in part' if self.name in _IN_PART else 'met'


def write_table(
    results: Path, entries: Sequence[Entry], kept: dict[str, Any], machine: Machine
) -> int:
    """Write `trust.json` and `trust.md`; return 1 when a promise did not hold.

    Args:
        results: Folder of the results, where those of other benchmarks lie, too.
        entries: Of the campaign's own parts.
        kept: The same as plain values, to go on from.
        machine: Facts of this call.
    """
    counted = []
    for one in COUNTED:
        found, when = one.found(results)
        counted.append(
            Entry(
                ident=one.ident,
                name=one.name,
                wanted=one.wanted,
                found=found,
                when=when,
                how=f'make bench-{one.bench}',
            )
        )
    lines = sorted([*entries, *counted], key=lambda entry: int(entry.ident[1:]))
    told = {line.ident for line in lines}
    rows = [_row(line) for line in lines]
    rows += [(i, PROMISES[i], '–', 0, 0, 0, 'not tried', '') for i in PROMISES if i not in told]
    failures = [
        (line.ident, line.name, failure) for line in lines for failure in line.found.failures
    ]
    short = [
        (line.ident, line.name, _reason(line))
        for line in lines
        if line.kept and line.result != 'met'
    ]
    tables = [
        Table(
            headings=(
                'id', 'promise', 'tried', 'target', 'count', 'held', 'result', 'counted on'
            ),
            rows=rows,
        )
    ]  # fmt: skip
    if failures:
        tables.append(
            Table(headings=('id', 'tried', 'case'), rows=failures, caption='What did not hold')
        )
    if short:
        tables.append(
            Table(
                headings=('id', 'tried', 'why'),
                rows=short,
                caption='Fewer than the target, or a part of it',
            )
        )
    write_results(
        results,
        'trust',
        {'parts': kept, 'lines': [line.model_dump(mode='json') for line in lines]},
        title='What is promised, and how often it was tried',
        tables=tables,
        notes=(
            'A case holds when all of what the promise says was so. Target and count are numbers '
            'of cases; a promise with a share (R11) holds with that share. Lines with another '
            'date are read from what their own benchmark left.',
        ),
        machine=machine,
    )
    for line in lines:
        sys.stderr.write(
            f'{line.ident:4} {line.name}: {line.found.held} of {line.found.tried} held, '
            f'target {line.wanted}: {line.result}\n'
        )
    return int(any(line.found.tried and not line.kept for line in lines))


def _reason(line: Entry) -> str:
    default = f'`{line.how}`, with `--whole`'
    return _IN_PART.get(line.name) or _WHY.get(line.ident, default)


def _row(line: Entry) -> tuple[str | int, ...]:
    found = line.found
    figures = ''.join(f', {name} {value:g}' for name, value in found.figures.items())
    return (
        line.ident,
        PROMISES[line.ident],
        f'{line.name}{figures}',
        line.wanted,
        found.tried,
        found.held,
        line.result,
        line.when,
    )
