# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What a worker of a campaign does with one task."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from aurora_bench.campaign.episode import EpisodeStages
from aurora_bench.campaign.plan import Plan, Task
from aurora_bench.campaign.program_runs import check_containment, program_run
from aurora_bench.campaign.record import CampaignRun, Ending, Tried, identity
from aurora_bench.fidelity.answer import Answer
from aurora_bench.fidelity.score import score
from aurora_bench.fidelity.summary import field_share, requirement_share
from aurora_bench.prompts.format import AnnotatedPrompt
from aurora_bench.rulers.checking import Said, asked_of, independent_checker
from aurora_bench.rulers.readback import distances
from aurora_bench.rulers.runs import OutcomeWork, Ran
from aurora_bench.rulers.trial import JudgedTrial, Trial
from aurora_core.errors import AuroraError
from aurora_core.files import DOCUMENT_BYTES, read_bytes, read_json
from aurora_core.outcomes.grounded import AnchorScore
from aurora_core.outcomes.verdict import VerdictStatus
from aurora_core.pipeline.stages import RunRequest
from aurora_core.report.build import refusal_certificate
from aurora_core.report.run_folder import StageFile
from aurora_core.report.run_report import ChangeKind, RunReport
from aurora_core.report.status import Status


@dataclass(kw_only=True)
class CampaignWork:
    """Runs tasks of a plan; sent to every worker.

    Attributes:
        plan: Of the campaign.
        folder: Runs go below it.
    """

    plan: Plan
    folder: Path

    def prepare(self) -> None:
        """Load what every run needs."""
        _Watched(folder=self.folder, map_name=self.plan.map).prepare()
        if any(c.writes_program for c in self.plan.configurations):
            check_containment()

    def __call__(self, task: Task) -> CampaignRun:
        """Run one task; its folder goes, whatever happens."""
        folder = self.folder / task.reader.name / task.configuration.value
        if task.configuration.writes_program:
            return program_run(self.plan, task, folder, independent_checker())
        work = _Watched(
            folder=folder,
            map_name=self.plan.map,
            repair=task.configuration.repair(self.plan.repair),
            model=task.reader.model,
            transcripts=task.reader.transcripts,
            without=task.configuration.without,
        )
        work.prepare()
        judged = work(task.trial)
        values: dict[str, Any] = {
            **identity(task),
            'status': judged.status,
            'right': judged.right,
            'cause': judged.cause,
            'said': judged.said,
            'seconds': judged.seconds,
            **work.facts,
        }
        return CampaignRun(**values)


@dataclass(kw_only=True)
class _Watched(OutcomeWork):
    """The ruler's run, of which more is kept while its folder is there."""

    facts: dict[str, Any] = field(default_factory=dict)
    _ran: Ran | None = None

    def stages(self) -> EpisodeStages:
        """Return an engine that remembers every realisation."""
        return EpisodeStages(self.without)

    def ran(self, request: RunRequest, place: Path, stages: Any) -> Ran:
        """Run, and remember the run."""
        self._ran = super().ran(request, place, stages)
        return self._ran

    def judge(self, trial: Trial, place: Path) -> JudgedTrial:
        """Judge a run and take down what tables and figures need."""
        judged = super().judge(trial, place)
        assert self._ran is not None  # `judge` runs it
        self.facts = facts_of(self._ran, trial.prompt)
        engine, trace = self._ran.stages, self._ran.report.trace
        if isinstance(engine, EpisodeStages):
            self._seconds.update({f'again {k}': s for k, s in engine.again_s.items()})
            self.facts['measured'] = None if trace is None else engine.measured.get(trace.bag)
        passed = self.facts['final'] is VerdictStatus.VERIFIED
        if passed and not judged.said and trial.prompt.feasibility != 'infeasible':
            self.facts['said'] = self._asked(self._ran, trial.document)
        return judged

    def _asked(self, ran: Ran, document: Mapping[str, Any]) -> tuple[Said, ...]:
        """Ask the checker of a run that claims less than verified."""
        trace = ran.report.trace
        assert self.check is not None
        assert trace is not None
        try:
            return asked_of(self.check, ran.folder / trace.bag, document)
        except Exception as err:  # noqa: BLE001  (a checker that breaks must not end the campaign)
            why = f'{type(err).__name__}: {err}'
            return (Said(requirement='', kind='checker', outcome='cannot_tell', why=why),)


def facts_of(ran: Ran, prompt: AnnotatedPrompt) -> dict[str, Any]:
    """Return the fields of a record that come from a run and its folder."""
    report = ran.report
    trace, first = report.trace, None
    if (ran.folder / StageFile.VERDICT.name_at(0)).is_file():
        verdict = read_json(ran.folder / StageFile.VERDICT.name_at(0), DOCUMENT_BYTES)
        first = VerdictStatus(verdict['status'])
    scores = score(prompt, _answer(ran)).requirements
    whole, fields = requirement_share(scores), field_share(scores)
    ending, why = _ending(report, ran)
    return {
        'ending': ending,
        'why': why,
        'first': first,
        'final': None if trace is None else trace.verdict,
        'met': whole.met,
        'requirements': whole.total,
        'fields_met': fields.met,
        'fields': fields.total,
        'request_kept': _is_request_kept(ran.folder, report),
        'conditions': report.metrics.conditions,
        'satisfied': report.metrics.satisfied,
        'margin': report.metrics.worst_normalised,
        'margins': _margins(report),
        'tried': tuple(
            Tried(
                kind=r.kind,
                outcome=r.outcome,
                edits=len(r.edits),
                of_conditions=sum(e.change is ChangeKind.CONDITION for e in r.edits),
            )
            for r in report.repairs
        ),
        'simulations': report.metrics.iterations,
        'anchor': _anchor(ran.folder, report),
        'placed_m': _placed(ran),
        'trace_sha256': '' if trace is None else trace.sha256,
        'motion_sha256': '' if trace is None else trace.motion_sha256,
        'simulated_s': report.metrics.simulated_s,
    }


def _ending(report: RunReport, ran: Ran) -> tuple[Ending, str]:
    if report.status in (Status.ERROR, Status.CANCELLED):
        error = report.error
        return Ending.FAILED, report.status.value if error is None else error.component
    if report.trace is not None and report.trace.verdict is not None:
        return Ending.COMPLETED, ''
    if report.status is Status.INFEASIBLE:
        reasons = () if report.feasibility is None else report.feasibility.certificates
        return Ending.DECLINED, 'refused: ' + ', '.join(dict.fromkeys(c.reason for c in reasons))
    if report.status is Status.NOT_UNDERSTOOD:
        return Ending.DECLINED, 'question'
    failure = None if ran.stages.grounding is None else ran.stages.grounding.failure
    return Ending.DECLINED, 'no place' if failure is None else f'no place: {failure.reason}'


def _answer(ran: Ran) -> Answer:
    """Return what the run answers to its prompt: a request, a refusal or a question."""
    outcome = ran.stages.outcome
    if outcome is None:
        return Answer(error=ran.report.summary)
    if outcome.spec is None:
        return Answer(
            clauses=outcome.clauses,
            reasons=tuple(refusal_certificate(r).reason for r in outcome.refusals),
            question=outcome.question or '',
        )
    refused = ran.report.status is Status.INFEASIBLE and ran.report.feasibility is not None
    certificates = ran.report.feasibility.certificates if ran.report.feasibility else ()
    return Answer(
        spec=outcome.spec,
        clauses=outcome.spec.clauses or outcome.clauses,
        reasons=tuple(c.reason for c in certificates) if refused else (),
    )


def _is_request_kept(folder: Path, report: RunReport) -> bool:
    names = [StageFile.SPEC.name_at(k) for k in range(report.metrics.iterations)]
    specs = {
        read_bytes(folder / n, DOCUMENT_BYTES) for n in names if (folder / n).is_file()
    }  # fmt: skip
    return len(specs) <= 1


def _margins(report: RunReport) -> dict[str, float]:
    """Return the least margin by what a condition asks: `tracked` of `m1.tracked`."""
    least: dict[str, float] = {}
    for row in report.conditions:
        element, _, what = row.id.partition('.')
        name = 'stated' if not row.implied else what.rstrip('0123456789') or element
        if row.margin is not None:
            least[name] = min(row.margin, least.get(name, row.margin))
    return dict(sorted(least.items()))


def _anchor(folder: Path, report: RunReport) -> AnchorScore | None:
    if report.trace is None:
        return None
    iteration = int(report.trace.bag.rpartition('.')[2])
    grounding = read_json(folder / StageFile.GROUNDING.name_at(iteration), DOCUMENT_BYTES)
    return AnchorScore.model_validate(grounding['score'])


def _placed(ran: Ran) -> dict[str, tuple[float, ...]]:
    """Return how far agents of the first realisation stand from their places, by type."""
    outcome = ran.stages.grounding
    agsg = None if outcome is None else outcome.agsg
    bag = ran.folder / 'bag.0'
    if agsg is None or agsg.grounding is None or not bag.is_dir():
        return {}
    found: dict[str, list[float]] = {}
    try:
        for agent, apart_m in distances(bag, agsg.grounding):
            found.setdefault(agent.type_name, []).append(apart_m)
    except AuroraError:
        return {}  # a damaged bag has its own words in the report
    return {name: tuple(values) for name, values in sorted(found.items())}
