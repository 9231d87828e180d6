# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`python -m aurora_bench.trust --results docs/bench` (also: `make bench-trust`)."""

from __future__ import annotations

import argparse
import sys
import tempfile
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from aurora_bench.interrupt import stop_on_sigterm
from aurora_bench.machine import machine_facts
from aurora_bench.progress import Progress
from aurora_bench.results import ResultsError
from aurora_bench.resumable.code import code_digest
from aurora_bench.resumable.journal import Journal, JournalHead
from aurora_bench.trust import (
    clocks,
    disk,
    documents,
    machinery,
    mavlink,
    model,
    orders,
    surroundings,
)
from aurora_bench.trust.part import NOTHING, Found, Part
from aurora_bench.trust.table import Entry, write_table
from aurora_core.files import DOCUMENT_BYTES, read_json

PARTS = (
    Part(
        ident='R9', name='damaged documents', wanted=50_000, usual=10_000, chunk=1_000,
        run=documents.documents,
    ),
    Part(
        ident='R10', name='MAVLink frames without the key', wanted=1_000_000, usual=100_000,
        chunk=10_000, run=mavlink.frames,
    ),
    Part(
        ident='R11', name='uploads, 10 % lost', wanted=1_000, usual=200, chunk=20, least=0.999,
        run=mavlink.uploads_10,
    ),
    Part(
        ident='R11', name='uploads, 20 % lost', wanted=1_000, usual=200, chunk=20, least=0.97,
        run=mavlink.uploads_20,
    ),
    Part(
        ident='R11', name='uploads, link cut', wanted=1_000, usual=200, chunk=20,
        run=mavlink.uploads_cut,
    ),
    Part(
        ident='R12', name='hostile model servers', wanted=120, usual=36, chunk=18,
        run=model.model_servers,
    ),
    Part(
        ident='R12', name='hostile model servers, in repair', wanted=120, usual=36, chunk=12,
        run=model.revisions,
    ),
    Part(
        ident='R13', name='failsafes, as tests', wanted=126, usual=1, chunk=1,
        run=machinery.failsafes,
    ),
    Part(ident='R14', name='MAVSDK, as tests', wanted=8, usual=1, chunk=1, run=machinery.clients),
    Part(
        ident='R15', name='SUMO faults, as tests', wanted=30, usual=1, chunk=1,
        run=machinery.sumo,
    ),
    Part(ident='R16', name='clocks, as tests', wanted=25, usual=1, chunk=1, run=machinery.clocks),
    Part(ident='R16', name='clocks moved', wanted=33, usual=6, chunk=1, run=clocks.moved),
    Part(
        ident='R16', name='time zones and languages', wanted=12, usual=12, chunk=4,
        run=surroundings.places,
    ),
    Part(
        ident='R18', name='little memory, few files', wanted=16, usual=16, chunk=4,
        run=surroundings.limits,
    ),
    Part(ident='R18', name='full disks', wanted=20, usual=20, chunk=1, run=disk.full_disk),
    Part(
        ident='R20', name='orders in prompts', wanted=300, usual=300, chunk=30,
        run=orders.injections,
    ),
    Part(
        ident='R20', name='orders in replies of models', wanted=50, usual=50, chunk=10,
        run=orders.model_replies,
    ),
    Part(
        ident='R20', name='orders in past episodes', wanted=100, usual=100, chunk=20,
        run=orders.past_episodes,
    ),
    Part(
        ident='R20', name='orders in repair', wanted=50, usual=50, chunk=10, run=orders.repairs
    ),
    Part(
        ident='R21', name='locked packages', wanted=1, usual=1, chunk=1,
        run=machinery.supply_chain,
    ),
    Part(
        ident='R22', name='lint and types', wanted=2, usual=1, chunk=1, run=machinery.findings
    ),
    Part(
        ident='R22', name='coverage of the core', wanted=2, usual=1, chunk=1,
        run=machinery.coverage,
    ),
    Part(
        ident='R22', name='error codes provoked', wanted=18, usual=1, chunk=1,
        run=machinery.provoked,
    ),
)  # fmt: skip


def main(arguments: Sequence[str] | None = None) -> int:
    """Run parts of the campaign and write the table; return 1 when a case did not hold."""
    stop_on_sigterm()
    parser = argparse.ArgumentParser(prog='aurora_bench.trust', description=__doc__)
    parser.add_argument('--results', type=Path, default=Path('docs/bench'), metavar='FOLDER')
    parser.add_argument('--only', action='append', metavar='NAME', help='an id or part of a name')
    parser.add_argument(
        '--whole', action='store_true', help='as many cases as the target asks for'
    )
    parser.add_argument('--table', action='store_true', help='write the table anew, try nothing')
    options = parser.parse_args(arguments)
    machine = machine_facts()
    kept = _kept(options.results)
    digest = code_digest()
    for part in () if options.table else _chosen(options.only):
        count = max(part.usual, part.wanted) if options.whole and part.usual > 1 else part.usual
        found = _run(part, count, options.results, digest)
        kept[part.name] = {
            'found': found.model_dump(mode='json'),
            'when': f'{machine.date_utc[:10]}, version {machine.versions["aurora"]}',
        }
        # After each: what is done is not lost when the next one is broken off.
        write_table(options.results, _entries(kept), kept, machine)
    return write_table(options.results, _entries(kept), kept, machine)


def _chosen(only: Sequence[str] | None) -> list[Part]:
    chosen = [
        part
        for part in PARTS
        if only is None or any(word == part.ident or word in part.name for word in only)
    ]
    if not chosen:
        raise ResultsError(f'no part is meant by {only}; there are {[p.name for p in PARTS]}')
    return chosen


def _run(part: Part, count: int, results: Path, digest: str) -> Found:
    """Try the cases of a part, going on where an earlier call was broken off."""
    progress = Progress(f'trust {part.ident}', -(-count // part.chunk))
    head = JournalHead(
        campaign='trust',
        files={},
        options={'part': part.name, 'code': digest, 'count': str(count)},
    )
    stem = part.name.replace(' ', '_').replace(',', '').replace('%', 'percent')
    path = results / f'trust.{stem}.journal.jsonl'
    total = NOTHING
    with (
        tempfile.TemporaryDirectory(prefix='aurora_trust_') as name,
        Journal(path, head, resume=True) as journal,
    ):
        folder = Path(name).resolve()
        for first in range(0, count, part.chunk):
            key = str(first)
            if key not in journal.finished:
                found = part.run(first, min(part.chunk, count - first), folder)
                journal.add(key, found.model_dump(mode='json'))
                journal.finished[key] = found.model_dump(mode='json')
            total = total.plus(Found.model_validate(journal.finished[key]))
            progress.step(f'{part.name}: {total.held} of {total.tried}')
    path.unlink()
    return total


def _kept(results: Path) -> dict[str, Any]:
    """Return what earlier calls have found, by the name of the part."""
    path = results / 'trust.json'
    return dict(read_json(path, DOCUMENT_BYTES)['parts']) if path.exists() else {}


def _entries(kept: dict[str, Any]) -> list[Entry]:
    return [
        Entry(
            ident=part.ident,
            name=part.name,
            wanted=part.wanted,
            least=part.least,
            found=Found.model_validate(kept[part.name]['found']) if part.name in kept else NOTHING,
            when=kept[part.name]['when'] if part.name in kept else '',
            how=f'make bench-trust, part {part.name}',
        )
        for part in PARTS
    ]


if __name__ == '__main__':
    sys.exit(main())
