# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`Judgement`: a verdict and what it is about; two of one run are held against each other."""

from __future__ import annotations

from dataclasses import dataclass

from aurora_core.outcomes.verdict import Finding, Verdict, VerdictStatus
from aurora_core.pipeline.knowledge import Knowledge
from aurora_core.pipeline.verification import graph_of, verify_content
from aurora_core.ports.progress import Progress, quietly
from aurora_core.report.comparison import compare
from aurora_core.trace.bag_reader import BagContent
from aurora_core.trace.hashing import trace_sha256


@dataclass(frozen=True, slots=True, kw_only=True)
class Judgement:
    """What was found out about one execution.

    Attributes:
        run_id: Of the run.
        iteration: Repair iteration.
        graph_sha256: Of the scenario graph.
        trace_sha256: Trace hash (hex).
        last_tick: Last tick of the trace.
        end_s: Simulated time of it.
        verdict: Margins.
    """

    run_id: str
    iteration: int
    graph_sha256: str
    trace_sha256: str
    last_tick: int
    end_s: float
    verdict: Verdict


def judge(
    known: Knowledge, content: BagContent, where: str, progress: Progress = quietly
) -> Judgement:
    """Compute every margin of a run.

    Args:
        known: What is installed here.
        content: Its messages, from a bag or from the wire.
        where: Where they come from, for errors.
        progress: Called whenever a piece of the work is done.

    Raises:
        VerificationError: There is no graph, or the conditions do not fit the trace.
    """
    graph = graph_of(content, where)
    trace = content.trace
    last_tick = max(0, trace.ticks - 1)
    return Judgement(
        run_id=str(content.agsg_message.run_id),
        iteration=graph.iteration,
        graph_sha256=graph.sha256,
        trace_sha256=trace_sha256(trace, content.world),
        last_tick=last_tick,
        end_s=trace.time_s(last_tick),
        verdict=verify_content(known, content, graph, progress=progress),
    )


@dataclass(frozen=True, slots=True, kw_only=True)
class LiveOutcome:
    """What the monitor made of a run that it heard.

    Attributes:
        run_id: Of the run.
        iteration: Repair iteration.
        judgement: None when it could not be judged.
        problem: Why not.
    """

    run_id: str
    iteration: int
    judgement: Judgement | None = None
    problem: str = ''


def reconcile(bag: Judgement, live: LiveOutcome | None) -> Verdict:
    """Return the bag's verdict; inconclusive when the live one of the same run is another.

    Args:
        bag: From the recording.
        live: Of the run that the monitor heard last, if it heard one.
    """
    if live is None or (live.run_id, live.iteration) != (bag.run_id, bag.iteration):
        return bag.verdict
    differences = _differences(bag, live)
    if not differences:
        return bag.verdict
    findings = tuple(
        Finding(
            kind='live',
            subject=subject,
            tick=bag.last_tick,
            time_s=bag.end_s,
            text=f'what was heard live and the bag differ on {subject}: {text}',
        )
        for subject, text in differences.items()
    )
    verdict = bag.verdict
    return Verdict(
        status=VerdictStatus.INCONCLUSIVE,
        results=verdict.results,
        cross_check=(*verdict.cross_check, *findings),
        integrity=verdict.integrity,
        notes=verdict.notes,
    )


def _differences(bag: Judgement, live: LiveOutcome) -> dict[str, str]:
    """Return what differs, each with both values."""
    heard = live.judgement
    if heard is None:
        return {'verdict': f'live none ({live.problem}), bag {bag.verdict.status.value}'}
    found = {
        item.condition: f'{item.what} (live margin {item.recorded!r}, bag {item.recomputed!r})'
        for item in compare(heard.verdict, bag.verdict, 'live').differences
    }
    if heard.trace_sha256 != bag.trace_sha256:
        found['trace'] = f'hash live {heard.trace_sha256}, bag {bag.trace_sha256}'
    return found
