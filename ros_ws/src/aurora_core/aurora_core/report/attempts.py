# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The attempts of a run, as a report lists them, against what is in its folder."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from aurora_core.agsg.message import read_agsg
from aurora_core.errors import AuroraError, BagError
from aurora_core.report.doubts import Doubt, altered, unknown
from aurora_core.report.run_documents import Unreadable, read_document
from aurora_core.report.run_folder import REPORT, StageFile
from aurora_core.report.run_report import BagReport, RepairReport, RunReport
from aurora_core.report.status import CLAIMS_NOTHING
from aurora_core.trace.bag_reader import read_bag
from aurora_core.trace.definitions import message_definitions
from aurora_core.trace.hashing import trace_hashes


def attempt_doubts(run: Path, report: RunReport, iteration: int) -> Iterator[Doubt]:
    """Tell where the attempts of a run are not all there: they are numbered from 0."""
    if not report.bags:
        return
    names = [entry.bag for entry in report.bags]
    numbers = [entry.iteration for entry in report.bags]
    if names != [f'bag.{number}' for number in range(len(names))] or numbers != [
        *range(len(names))
    ]:
        yield altered(f'{REPORT} does not list the attempts one by one: {", ".join(names)}')
    repaired = [repair.bag for repair in report.repairs if repair.bag is not None]
    # What broke off in an attempt has its bag, and nothing to tell of it.
    expected = names[1 : len(repaired) + 1] if report.status in CLAIMS_NOTHING else names[1:]
    if repaired != expected:
        yield altered(f'the repairs in {REPORT} are not those of its bags: {", ".join(repaired)}')
    told = {repair.iteration: repair for repair in report.repairs if repair.bag is not None}
    for number in range(len(names)):
        name = StageFile.EDITS.name_at(number)
        edits = read_document(run / name, RepairReport)
        if isinstance(edits, RepairReport) and edits != told.get(number):
            yield altered(f'{name} is not what {REPORT} tells of that attempt')
        elif isinstance(edits, Unreadable) and number in told:
            yield unknown(edits.why)
    for entry in report.bags:
        if entry.iteration != iteration:
            yield from _earlier(run, entry)


def _earlier(run: Path, entry: BagReport) -> Iterator[Doubt]:
    """Compare the bag of another attempt than the judged one with what the report lists."""
    name = f'bag.{entry.iteration}'
    if not (run / name).exists():
        yield unknown(f'{name}, which {REPORT} lists, is missing')
        return
    try:
        content = read_bag(run / name, message_definitions())
    except BagError as err:
        yield unknown(f'{name}: {err}')
        return
    try:
        graph = read_agsg(content.agsg_message)
    except AuroraError as err:
        yield unknown(f'{name}: {err}')
        return
    found = BagReport(
        bag=entry.bag,
        iteration=graph.iteration,
        ticks=content.trace.ticks,
        trace_sha256=trace_hashes(content.trace, content.world).trace_sha256,
        graph_sha256=graph.sha256,
    )
    if found != entry:
        yield altered(f'{name} is not the attempt that {REPORT} lists')
