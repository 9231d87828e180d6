# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What a run that was killed had finished: its realisations that were judged, and the best one."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from itertools import count

from aurora_core.agsg.document import agsg_from_json
from aurora_core.errors import AuroraError
from aurora_core.outcomes.agsg import Agsg
from aurora_core.outcomes.feasibility import FeasibilityVerdict
from aurora_core.outcomes.parse import ParseOutcome
from aurora_core.outcomes.verdict import Verdict
from aurora_core.repair.attempts import judged_attempt
from aurora_core.report.facts import ExecutionFacts, RunFacts
from aurora_core.report.run_documents import Unreadable, read_document
from aurora_core.report.run_folder import RunFolder, StageFile
from aurora_core.report.run_report import BagReport, RepairReport
from aurora_core.trace.bag_content import BagContent
from aurora_core.trace.bag_reader import read_bag
from aurora_core.trace.definitions import message_definitions
from aurora_core.trace.hashing import trace_hashes


@dataclass(frozen=True, slots=True, kw_only=True)
class _Finished:
    """A realisation that was executed and judged."""

    number: int
    graph: Agsg
    verdict: Verdict
    content: BagContent


def with_finished(facts: RunFacts, folder: RunFolder) -> RunFacts:
    """Return the facts of a run that was killed with what it had finished.

    What the realisation in hand has left is taken away, unless it is the first one: its recording
    is all that there is.

    Args:
        facts: Of the request.
        folder: Of the run.

    Raises:
        ReportError: The folder cannot be tidied.
    """
    try:
        made = list(_finished(folder))
    except AuroraError:
        return facts  # a recording that cannot be read is for whoever verifies it
    if not made:
        return facts
    if not folder.file(StageFile.VERDICT.name_at(len(made))).exists():
        folder.discard(len(made))
    told = tuple(_repairs(folder, len(made)))
    others = {repair.iteration for repair in told if repair.engine}
    best = max(
        made, key=lambda r: (judged_attempt(r.number, r.verdict).rank, r.number not in others)
    )
    spec = best.graph.spec
    return replace(
        facts,
        limits=best.content.world.limits,
        map_digest=best.graph.map_digest,
        parse=ParseOutcome(spec=spec, clauses=spec.clauses),
        feasibility=_feasibility(folder, best.number),
        agsg=best.graph,
        execution=_execution(folder, best),
        bags=tuple(_bag(folder, r) for r in made),
        verdict=best.verdict,
        iterations=len(made),
        repairs=told,
    )


def _finished(folder: RunFolder) -> Iterator[_Finished]:
    for k in count():
        verdict = read_document(folder.file(StageFile.VERDICT.name_at(k)), Verdict)
        graph = read_document(folder.file(StageFile.AGSG.name_at(k)), Agsg, agsg_from_json)
        if isinstance(verdict, Unreadable) or isinstance(graph, Unreadable):
            return
        content = read_bag(folder.bag_path(k), message_definitions())
        yield _Finished(number=k, graph=graph, verdict=verdict, content=content)


def _bag(folder: RunFolder, made: _Finished) -> BagReport:
    trace = made.content.trace
    return BagReport(
        bag=folder.bag_path(made.number).name,
        iteration=made.number,
        ticks=trace.ticks,
        trace_sha256=trace_hashes(trace, made.content.world).trace_sha256,
        graph_sha256=made.graph.sha256,
    )


def _execution(folder: RunFolder, made: _Finished) -> ExecutionFacts:
    trace = made.content.trace
    hashes = trace_hashes(trace, made.content.world)
    return ExecutionFacts(
        bag=folder.bag_path(made.number).name,
        ticks=trace.ticks,
        dt_s=trace.roster.dt_s,
        trace_sha256=hashes.trace_sha256,
        motion_sha256=hashes.motion_sha256,
    )


def _feasibility(folder: RunFolder, number: int) -> FeasibilityVerdict | None:
    name = StageFile.FEASIBILITY.name_at(number)
    found = read_document(folder.file(name), FeasibilityVerdict)
    return None if isinstance(found, Unreadable) else found


def _repairs(folder: RunFolder, made: int) -> Iterator[RepairReport]:
    for k in range(1, made):
        told = read_document(folder.file(StageFile.EDITS.name_at(k)), RepairReport)
        if not isinstance(told, Unreadable):
            yield told
