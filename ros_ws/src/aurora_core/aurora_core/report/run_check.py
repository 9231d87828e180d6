# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""A bag in a run folder against everything else in the folder: is it the one of that run?

A bag proves its own margins, not whose they are. Run id, prompt, map, seed, limits, faults, the
documents of its iteration, trace hash and verdict have to be those of the folder. Who rewrites all
of these in agreement is not found here: that takes a signature (`signed_run`).
"""

from __future__ import annotations

import hashlib
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from aurora_core.agsg.document import agsg_from_json
from aurora_core.document import Document, first_difference
from aurora_core.judging.evaluation import Context
from aurora_core.outcomes.agsg import Agsg
from aurora_core.outcomes.feasibility import Feasibility, FeasibilityVerdict
from aurora_core.outcomes.grounded import GroundedScenario
from aurora_core.outcomes.schedule import Schedule
from aurora_core.outcomes.verdict import Verdict, VerdictStatus
from aurora_core.ports.model_name import OFFLINE
from aurora_core.report.attempts import attempt_doubts
from aurora_core.report.build import restated
from aurora_core.report.comparison import Comparison, compare
from aurora_core.report.doubts import Doubt, altered, trace_doubts, unknown
from aurora_core.report.facts import RunFacts
from aurora_core.report.manifest import Manifest
from aurora_core.report.run_documents import Unreadable, read_document, read_stored
from aurora_core.report.run_folder import (
    MANIFEST,
    PICTURE,
    PROMPT,
    REPORT,
    REPORT_HTML,
    StageFile,
    is_run_id,
)
from aurora_core.report.run_report import (
    BagReport,
    ClauseReport,
    RelaxedReport,
    RunReport,
    TraceReport,
)
from aurora_core.report.status import CLAIMS_NOTHING, Status
from aurora_core.report.versions import AURORA_VERSION
from aurora_core.spec.scenario import ScenarioSpec
from aurora_core.spec.vocabulary import ClauseStatus
from aurora_core.trace.bag_content import BagContent
from aurora_core.trace.hashing import TraceHashes
from aurora_core.trace.records import ScenarioEventKind
from aurora_core.trace.trace import Integrity

_SHOWN = 40


class RunCheck(Document):
    """What a run folder says of a bag in it.

    Attributes:
        run_id: As the report has it, else the name of the folder.
        status: Of the report, None when it cannot be believed to be the one of this run.
        doubts: Why the bag cannot be believed to be the one of this run.
    """

    run_id: str
    status: Status | None
    doubts: tuple[Doubt, ...] = ()


@dataclass(frozen=True, slots=True, kw_only=True)
class JudgedBag:
    """A bag, and what was found out about it from itself alone.

    Attributes:
        content: What it holds.
        agsg: Graph in it.
        hashes: Of its trace.
        verdict: Of the bag.
        clauses: Of the prompt in it, with what became of each.
        facts: What a report tells of a run, as far as the bag gives it.
        context: In which it was judged, None measures anew what the page shows.
        relaxed: Works out with which stated numbers it would hold.
    """

    content: BagContent
    agsg: Agsg
    hashes: TraceHashes
    verdict: Verdict
    clauses: tuple[ClauseReport, ...]
    facts: RunFacts
    context: Context | None = None
    relaxed: Callable[[], RelaxedReport | None] = lambda: None


def unread(clauses: Sequence[ClauseReport]) -> tuple[ClauseReport, ...]:
    """Return the clauses that make a run incomplete."""
    fine = (ClauseStatus.ENCODED, ClauseStatus.NO_REQUIREMENT)
    return tuple(clause for clause in clauses if clause.status not in fine)


def check_run(
    run: Path, iteration: int | None, bag: JudgedBag
) -> tuple[RunCheck, Comparison | None]:
    """Hold a bag against the run folder that it lies in.

    Args:
        run: Run folder.
        iteration: Of the bag, None when its name is not that of a bag of the run.
        bag: The bag.

    Returns:
        What the folder says, and its verdict against the one of the bag, when it has one.
    """
    manifest = read_document(run / MANIFEST, Manifest)
    report = read_document(run / REPORT, RunReport)
    run_id = _run_id(run, manifest, report)
    # A report of another run says nothing of this one.
    foreign = isinstance(report, RunReport) and report.run_id != run_id
    own = report if isinstance(report, RunReport) and not foreign else None
    doubts = list(_identity(run_id, manifest, report, str(bag.content.agsg_message.run_id)))
    doubts += _prompts(run, manifest, report, bag.agsg.spec.prompt)
    if isinstance(manifest, Manifest):
        doubts += _asked(manifest, own, bag)
    comparison: Comparison | None = None
    if iteration is None:
        doubts.append(altered('it lies in a run folder, but has not the name of a bag of the run'))
    else:
        doubts += _stages(run, iteration, bag)
        found, comparison = _verdict(run, iteration, bag)
        doubts += found
        if own is not None:
            doubts += _report(run, own, iteration, bag)
            doubts += _beside(run, own, iteration, bag)
    check = RunCheck(
        run_id=run_id, status=None if own is None else own.status, doubts=tuple(doubts)
    )
    return check, comparison


def _run_id(run: Path, manifest: Manifest | Unreadable, report: RunReport | Unreadable) -> str:
    """Return whose folder it is: a folder may be renamed, a name that is a run id says it."""
    name = run.absolute().name
    if is_run_id(name):
        return name
    if isinstance(manifest, Manifest) and manifest.run_id:
        return manifest.run_id
    return report.run_id if isinstance(report, RunReport) else ''


def _identity(
    run_id: str, manifest: Manifest | Unreadable, report: RunReport | Unreadable, recorded: str
) -> Iterator[Doubt]:
    if isinstance(manifest, Unreadable):
        yield unknown(manifest.why)
    elif manifest.run_id not in ('', run_id):
        yield altered(f'{MANIFEST} is of run {_short(manifest.run_id)}, not of {run_id}')
    if isinstance(report, Unreadable):
        why = ': the run was not finished, or its report was taken away' * report.missing
        yield unknown(f'{report.why}{why}')
    elif report.run_id != run_id:
        yield unknown(f'{REPORT} is of run {_short(report.run_id)}, not of {run_id}')
    if run_id and recorded != run_id:
        yield altered(f'the bag is of run {_short(recorded)}, not of {run_id}')


def _differs(where: str, what: str, there: object, recorded: object) -> Iterator[Doubt]:
    if there != recorded:
        told = [_short(value) for value in (there, recorded)]
        yield altered(f'{where} has {what} {told[0]}, the bag {told[1]}')


def _short(value: object) -> str:
    text = str(value)
    return text if len(text) <= _SHOWN else f'{text[:_SHOWN]}...'


def _prompts(
    run: Path, manifest: Manifest | Unreadable, report: RunReport | Unreadable, prompt: str
) -> Iterator[Doubt]:
    stored = read_stored(run / PROMPT)
    if isinstance(stored, Unreadable):
        yield unknown(stored.why)
    elif stored != prompt.encode('utf-8', 'surrogatepass'):
        yield from _differs(PROMPT, 'the prompt', stored.decode('utf-8', 'replace'), prompt)
    if not isinstance(manifest, Unreadable):
        if manifest.request.prompt is None:
            yield unknown(f'{MANIFEST} does not tell the prompt')
        else:
            yield from _differs(MANIFEST, 'the prompt', manifest.request.prompt, prompt)
    if not isinstance(report, Unreadable):
        yield from _differs(REPORT, 'the prompt', report.prompt, prompt)


def _asked(manifest: Manifest, report: RunReport | None, bag: JudgedBag) -> Iterator[Doubt]:
    """Compare what was asked for with the bag and the report."""
    request = manifest.request
    for name in ('map_name', 'seed', 'engine', 'faults'):
        if name not in request.model_fields_set:
            yield unknown(f'{MANIFEST} does not tell {name}')
    yield from _differs(MANIFEST, 'the map', request.map_name, bag.agsg.map_name)
    seed = bag.agsg.grounding.seed if bag.agsg.grounding is not None else None
    yield from _differs(MANIFEST, 'the seed', request.seed, seed)
    if request.model == OFFLINE and not bag.agsg.spec.reader:
        # What it has read could be read again.
        yield altered(f'{MANIFEST} says that the offline parser read the prompt, the bag does not')
    if report is not None:
        for what, asked, told in (
            ('engine', request.engine, report.engine),
            ('model', request.model, report.model),
            ('injected faults', request.faults, report.faults),
        ):
            if asked != told:
                yield altered(f'{MANIFEST} and {REPORT} differ in the {what}')


def _stages(run: Path, iteration: int, bag: JudgedBag) -> Iterator[Doubt]:
    """Compare the documents of the stages with the graph in the bag."""
    agsg = bag.agsg
    if agsg.iteration != iteration:
        yield altered(f'the graph in the bag is of iteration {agsg.iteration}')
    name = StageFile.AGSG.name_at(iteration)
    graph = read_document(run / name, Agsg, agsg_from_json)
    if isinstance(graph, Unreadable):
        yield unknown(graph.why)
    elif graph != agsg:
        yield altered(f'{name} is not the graph in the bag')
    name = StageFile.SPEC.name_at(iteration)
    spec = read_document(run / name, ScenarioSpec)
    if isinstance(spec, Unreadable):
        yield unknown(spec.why)
    elif spec != agsg.spec:
        yield altered(f'{name} is not the request in the bag')
    for stage, kind, value in (
        (StageFile.GROUNDING, GroundedScenario, agsg.grounding),
        (StageFile.SCHEDULE, Schedule, agsg.schedule),
    ):
        name = stage.name_at(iteration)
        stored = read_document(run / name, kind)
        if isinstance(stored, Unreadable):
            yield unknown(stored.why)
        elif stored != value:
            yield altered(f'{name} is not the {stage.value} in the bag')


def _verdict(
    run: Path, iteration: int, bag: JudgedBag
) -> tuple[tuple[Doubt, ...], Comparison | None]:
    """Compare the verdict of the run with the one of the bag, bit by bit."""
    name = StageFile.VERDICT.name_at(iteration)
    recorded = read_document(run / name, Verdict)
    if isinstance(recorded, Unreadable):
        return (unknown(recorded.why),), None
    return (), compare(recorded, bag.verdict, name)


def _report(run: Path, report: RunReport, iteration: int, bag: JudgedBag) -> Iterator[Doubt]:
    """Compare a report with a bag of its run."""
    name = f'bag.{iteration}'
    listed = report.bags
    if listed is None:
        # Of an older version: it tells of the last bag alone.
        trace = report.trace
        listed = () if trace is None else (_of_trace(trace, report.digests.agsg, iteration),)
        if report.versions.get('aurora') == AURORA_VERSION:
            yield altered(f'{REPORT} lists no bags')
        if not any(entry.bag == name for entry in listed):
            yield unknown(f'{REPORT} is of an older version and tells nothing of {name}')
    elif not listed:
        yield unknown(f'{REPORT} tells of no bag: the run ended before one was finished')
    elif not any(entry.bag == name for entry in listed):
        names = ', '.join(entry.bag for entry in listed)
        yield altered(f'{REPORT} lists no {name}; the bags of the run are: {names}')
    for entry in listed:
        if entry.bag == name:
            hashes = bag.hashes
            yield from trace_doubts(bag.verdict, hashes.trace_sha256, entry.trace_sha256, REPORT)
            where = f'{REPORT}, {name},'
            yield from _differs(where, 'the graph', entry.graph_sha256, bag.agsg.sha256)
            yield from _differs(where, 'ticks', entry.ticks, bag.content.trace.ticks)
    yield from _request(report, bag)
    yield from attempt_doubts(run, report, iteration)
    judged = _judged(report, listed)
    if judged is not None and judged.bag == name:
        yield from _by_which_judged(report, judged, len(listed), bag)
    elif judged is not None and not (run / judged.bag).exists():
        yield unknown(f'{judged.bag}, by which the run was judged, is missing')


def _judged(report: RunReport, listed: Sequence[BagReport]) -> BagReport | None:
    """Return the bag that a report is about: of the best realisation."""
    named = '' if report.trace is None else report.trace.bag
    own = [entry for entry in listed if entry.bag == named]
    return own[0] if own else (listed[-1] if listed else None)


def _beside(run: Path, report: RunReport, iteration: int, bag: JudgedBag) -> Iterator[Doubt]:
    """Compare what is in the folder beside a report with the report.

    A report that tells of no bag was written later, for a run that had not been finished.
    """
    if report.bags == ():
        return
    name = StageFile.FEASIBILITY.name_at(iteration)
    feasibility = read_document(run / name, FeasibilityVerdict)
    if isinstance(feasibility, Unreadable):
        yield unknown(feasibility.why)
    elif feasibility != report.feasibility:
        yield altered(f'{name} is not the feasibility of {REPORT}')
    page = read_stored(run / REPORT_HTML)
    if isinstance(page, Unreadable) and not page.missing:
        yield unknown(page.why)
    # A page shows the bag that the run was judged by; another version lays it out otherwise.
    of_bag = report.trace is None or report.trace.bag == f'bag.{iteration}'
    if 'aurora' not in report.versions:
        yield unknown(f'{REPORT} does not tell the version that made its page')
    same = of_bag and report.versions.get('aurora') == AURORA_VERSION
    if same and not isinstance(page, Unreadable):
        from aurora_core.report.html import report_html
        from aurora_core.report.page.recorded import recorded

        seen = None
        if report.trace is not None:
            seen = recorded(report, bag.content, bag.agsg, bag.context)
        picture = read_stored(run / PICTURE)
        drawn = () if isinstance(picture, Unreadable) else (picture,)
        # A picture is drawn when somebody looks, and the page made again with it.
        pages = (report_html(report, shown, seen) for shown in (*drawn, None))
        if all(page != made.encode('utf-8') for made in pages):
            yield altered(f'{REPORT_HTML} is not the page of {REPORT}, {PICTURE} and the bag')


def _of_trace(trace: TraceReport, graph_sha256: str, iteration: int) -> BagReport:
    return BagReport(
        bag=trace.bag,
        iteration=iteration,
        ticks=trace.ticks,
        trace_sha256=trace.sha256,
        graph_sha256=graph_sha256,
    )


def _request(report: RunReport, bag: JudgedBag) -> Iterator[Doubt]:
    """Compare what a report says that was asked for with what the bag was made from."""
    world, grounded = bag.content.world, bag.agsg.grounding
    if grounded is None:
        yield altered('the graph in the bag is not grounded')
        return
    prompt = bag.agsg.spec.prompt.encode('utf-8', 'surrogatepass')
    for what, told, recorded in (
        ('the map', report.map, bag.agsg.map_name),
        ('the digest of the map', report.digests.map, world.map_digest),
        ('the seed', report.seed, grounded.seed),
        ('the digest of the prompt', report.digests.prompt, hashlib.sha256(prompt).hexdigest()),
    ):
        yield from _differs(REPORT, what, told, recorded)
    if report.limits != world.limits:
        yield altered(f'{REPORT} has other limits than the bag')
    version = report.versions.get('aurora')
    if grounded.basis is not None and version is not None:
        yield from _differs(REPORT, 'the version', version, grounded.basis.version)
    yield from _faults(report, bag)


def _faults(report: RunReport, bag: JudgedBag) -> Iterator[Doubt]:
    """Compare the faults of a report with those that the bag says were injected."""
    trace = bag.content.trace
    injected = {(e.subject, e.detail) for e in trace.events if e.kind is ScenarioEventKind.FAULT}
    told = {(fault.subject, fault.told()) for fault in report.faults}
    for subject, detail in sorted(injected - told):
        kind = detail.partition(' ')[0]
        yield altered(f'{REPORT} tells of no injected fault {kind} on {subject}')
    # One acts from the first tick that is not before it.
    acted = {
        (fault.subject, fault.told())
        for fault in report.faults
        if fault.at_s <= trace.time_s(trace.ticks - 2)
    }
    for subject, detail in sorted(acted - injected):
        kind = detail.partition(' ')[0]
        yield altered(f'{REPORT} tells of a fault {kind} on {subject}, the bag of none')


def _by_which_judged(
    report: RunReport, entry: BagReport, executions: int, bag: JudgedBag
) -> Iterator[Doubt]:
    """Compare what a report claims with the bag that it was judged by."""
    feasibility = report.feasibility
    if feasibility is not None and feasibility.result is Feasibility.INFEASIBLE:
        yield altered(f'{REPORT} says infeasible of what was executed')
    if report.question is not None:
        yield altered(f'{REPORT} asks a question of what was executed')
    if report.error is not None and report.status is not Status.ERROR:
        yield altered(f'{REPORT} tells of an error and of a status that has none')
    trace = report.trace
    if trace is None or (trace.bag, trace.sha256) != (entry.bag, entry.trace_sha256):
        yield altered(f'{REPORT} contradicts itself about {entry.bag}')
    elif trace.verdict is None and report.status not in CLAIMS_NOTHING:
        yield altered(f'{REPORT} tells no verdict of {entry.bag}')
    else:
        yield from _claims(trace, entry, bag)
    spec = hashlib.sha256(bag.agsg.spec.canonical_json().encode('utf-8')).hexdigest()
    yield from _differs(REPORT, 'the digest of the request', report.digests.spec, spec)
    yield from _differs(REPORT, 'the digest of the graph', report.digests.agsg, bag.agsg.sha256)
    if [(c.text, c.status) for c in report.clauses] != [(c.text, c.status) for c in bag.clauses]:
        yield altered(f'{REPORT} has other clauses than the bag gives')
    if bag.verdict.integrity is not Integrity.INTACT or report.status in CLAIMS_NOTHING:
        return
    again = None if report.relaxed is None else bag.relaxed()
    facts = replace(bag.facts, iterations=executions, relaxed=again)
    if report.relaxed != again:
        yield altered(f'{REPORT} has other relaxed values than the bag gives')
    found = first_difference(report, restated(report, facts))
    if found is not None:
        path, told, given = found
        yield altered(f'{REPORT} has {path} {_short(told)}, the bag gives {_short(given)}')
    allowed = _MAY_CLAIM.get(bag.verdict.status, frozenset())
    if again is not None and again.verdict is VerdictStatus.VERIFIED:
        allowed |= {Status.VERIFIED_AS_EDITED}
    if report.status not in allowed:
        yield altered(
            f'{REPORT} says {report.status.value}, the bag shows {bag.verdict.status.value}'
        )
    if report.status is Status.VERIFIED and (unread(bag.clauses) or not bag.clauses):
        yield altered(f'{REPORT} says verified, but not all of the prompt is encoded')


def _claims(trace: TraceReport, entry: BagReport, bag: JudgedBag) -> Iterator[Doubt]:
    """Compare what a report says of the recording with the recording."""
    if bag.verdict.integrity is not Integrity.INTACT:
        return
    ticks = bag.content.trace.ticks
    yield from _differs(REPORT, 'the ticks', (trace.ticks, entry.ticks), (ticks, ticks))
    if trace.motion_sha256:
        yield from _differs(
            REPORT, 'the motion hash', trace.motion_sha256, bag.hashes.motion_sha256
        )
    if trace.verdict is None:
        return
    yield from _differs(REPORT, 'the integrity', trace.integrity.value, Integrity.INTACT.value)
    # What cannot be decided here may have been decided by another configuration.
    if bag.verdict.status is not VerdictStatus.INCONCLUSIVE:
        told, found = trace.verdict, bag.verdict.status
        yield from _differs(REPORT, 'the verdict', told.value, found.value)
        # What is installed here may be told beside it.
        more = set(trace.notes) - set(bag.verdict.notes)
        if more or trace.cross_check != bag.verdict.cross_check:
            yield altered(f'{REPORT} has other findings than the bag gives')


_HOLDS = frozenset({Status.VERIFIED, Status.INCOMPLETE})
_MAY_CLAIM = {
    VerdictStatus.VERIFIED: _HOLDS,
    VerdictStatus.VIOLATED: frozenset({Status.VIOLATED}),
    # What cannot be decided here may have been decided by another configuration.
    VerdictStatus.INCONCLUSIVE: _HOLDS | {Status.VIOLATED},
}
