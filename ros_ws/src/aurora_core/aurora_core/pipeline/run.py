# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Run a prompt through all stages: the only file that knows their order.

Every stage's document is written when the stage ends: a crash leaves all finished ones readable.
Whatever breaks becomes the run's status `error`; the folder always ends with a report.
"""

from __future__ import annotations

import logging
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import replace
from itertools import islice
from pathlib import Path
from types import MappingProxyType
from typing import Any

from aurora_core.errors import AuroraError, hint_for, hint_of_limits
from aurora_core.outcomes.agsg import Agsg
from aurora_core.outcomes.feasibility import Feasibility
from aurora_core.outcomes.grounding import GroundingOutcome
from aurora_core.outcomes.parse import ParseOutcome
from aurora_core.outcomes.repair import Attempt, Proposal, ProposalOutcome, RepairPlan, Step
from aurora_core.outcomes.verdict import VerdictStatus
from aurora_core.pipeline.ahead import Ahead
from aurora_core.pipeline.beside import Beside
from aurora_core.pipeline.documents import write_again, write_grounded
from aurora_core.pipeline.history import learned_of, remember, remember_lessons
from aurora_core.pipeline.knowledge import Knowledge
from aurora_core.pipeline.relaxing import relaxed
from aurora_core.pipeline.repairing import (
    Realisation,
    best_of,
    confirmation,
    nothing_left,
    realised,
    repair_report,
    to_fit,
    why_not,
)
from aurora_core.pipeline.stages import ExecutionResult, RunControl, RunRequest, Stages
from aurora_core.pipeline.verification import load_bag
from aurora_core.ports.clock import SteadyClock
from aurora_core.repair.experience import RepairEpisode, estimates, lessons
from aurora_core.repair.revise import revised_to_fit
from aurora_core.report.build import build_report
from aurora_core.report.facts import ExecutionFacts, RunFacts
from aurora_core.report.outputs import write_outputs
from aurora_core.report.run_folder import (
    MANIFEST,
    PROMPT,
    RETRIEVAL,
    TRANSCRIPT,
    RunFolder,
    StageFile,
)
from aurora_core.report.run_report import BagReport, RepairReport, RunReport

_LOG = logging.getLogger(__name__)

# Share of a run's progress at which each stage begins.
_BEGINS = {
    'parse': 0.0,
    'check': 0.05,
    'ground': 0.08,
    'execute': 0.2,
    'verify': 0.9,
    'repair': 0.92,
    'report': 0.95,
    'done': 1.0,
}


# Executes candidates of repair, whatever the engine of the run.
_LOCAL = 'local'
# What repair goes on after: a candidate that cannot be decided is none that holds.
_GO_ON = (VerdictStatus.VIOLATED, VerdictStatus.INCONCLUSIVE)


class _Cancelled(Exception):  # noqa: N818  (control flow inside this file only)
    pass


class _Run:
    """One run in progress: the facts so far and the folder they go to."""

    def __init__(
        self,
        request: RunRequest,
        stages: Stages,
        known: Knowledge,
        folder: RunFolder,
        control: RunControl,
        clock: SteadyClock,
        facts: RunFacts,
        beside: Beside | None,
    ) -> None:
        self.request = request
        self.stages = stages
        self.known = known
        self.folder = folder
        self.control = control
        self.clock = clock
        self.facts = facts
        self.beside = beside
        self.ahead: Ahead | None = None
        self.taught: RepairEpisode | None = None
        self._dt_s = 0.0
        self._timing: dict[str, float] = {}
        # Of the time for repair: what is over, and what an iteration takes of it.
        self._share: tuple[float, float] | None = None

    def progress(self, name: str, fraction: float, sim_s: float) -> None:
        """Tell how far the run has come; it does not go back with a repair."""
        if self._share is not None:
            over, part = self._share
            length = _BEGINS['report'] - _BEGINS['repair']
            fraction = _BEGINS['repair'] + length * (over + part * fraction)
        self.control.progress(name, fraction, sim_s)

    def note(self, **changes: Any) -> None:
        """Add facts."""
        self.facts = replace(self.facts, **changes)

    @contextmanager
    def stage(self, name: str) -> Iterator[None]:
        """Time a stage; a cancel takes effect before it begins."""
        if self.control.cancelled():
            raise _Cancelled
        self.progress(name, _BEGINS[name], 0.0)
        begin = self.clock.seconds()
        try:
            yield
        finally:
            spent = self.clock.seconds() - begin
            self._timing[name] = self._timing.get(name, 0.0) + spent
            self.note(timing=dict(self._timing))

    def prepare(self) -> None:
        """Load what the report quotes: limits, time step, digest of the map."""
        known = self.known
        self._dt_s = known.settings.run.dt_s
        self.note(limits=known.limits)
        self.note(map_digest=known.map(self.request.map_name).digest)

    def through(self) -> None:
        """Take the prompt as far as it gets."""
        graph = self.understand()
        if graph is None:
            return
        grounding, proposal = self.place(graph)
        if grounding.agsg is None:
            return
        write_grounded(self.folder, grounding.agsg)
        # A graph has the processors for itself until there is something to repair.
        if self.beside is not None and self.budget() and self.request.engine == _LOCAL:
            self.beside.prepare()
        first = self.execute(grounding, 0, proposal)
        if first.verdict.status is VerdictStatus.VIOLATED:
            self.repair(graph, first)
            self.relax()

    def understand(self) -> Agsg | None:
        """Parse and check the stated numbers; None when the run ends here."""
        with self.stage('parse'):
            outcome = self.stages.parse(self.request)
            self.note(parse=outcome)
        if outcome.model_calls:
            self.folder.write_lines(TRANSCRIPT, outcome.model_calls)
        if outcome.retrieval is not None:
            self.folder.write_json(RETRIEVAL, outcome.retrieval.model_dump(mode='json'))
        graph = outcome.agsg
        if graph is None:
            return None
        self.folder.write_stage(StageFile.SPEC, 0, graph.spec)
        self.folder.write_stage(StageFile.AGSG, 0, graph)
        with self.stage('check'):
            feasibility = self.stages.check(graph, self.request)
            self.note(feasibility=feasibility)
        self.folder.write_stage(StageFile.FEASIBILITY, 0, feasibility)
        return None if feasibility.result is Feasibility.INFEASIBLE else graph

    def ground(self, graph: Agsg, plan: RepairPlan | None = None) -> GroundingOutcome:
        """Find places, schedule and conditions; the graph is missing when there is no place."""
        with self.stage('ground'):
            if plan is None:
                outcome = self.stages.ground(graph, self.request)
                self.note(grounding=outcome)
                return outcome
            if self.ahead is not None:
                return self.ahead.ground(graph, plan)
            return self.stages.ground(graph, self.request, plan)

    def place(self, graph: Agsg) -> tuple[GroundingOutcome, Proposal | None]:
        """Ground a request; where there is no place, revise what it leaves open until one is."""
        outcome = self.ground(graph)
        if outcome.failure is None or not self.budget():
            return outcome, None
        repair = self.known.repair
        if Step.SYMBOLIC not in repair.escalation:
            return outcome, None
        found = revised_to_fit(graph, outcome.failure, repair)
        for proposal in islice(found, repair.placements):
            again = self.ground(graph, proposal.plan)
            self._tell(to_fit(proposal, again))
            if again.agsg is not None:
                self.note(grounding=again)
                return again, proposal
        return outcome, None

    def execute(
        self,
        grounding: GroundingOutcome,
        iteration: int,
        proposal: Proposal | None = None,
        next_ones: Iterator[Agsg] | None = None,
    ) -> Realisation:
        """Run in lockstep and judge the trace; `next_ones`: what may be executed ahead."""
        graph = grounding.agsg
        assert graph is not None  # who found no place has nothing to execute
        bag = self.folder.bag_path(iteration)
        share = _BEGINS['verify'] - _BEGINS['execute']
        inner = RunControl(
            progress=lambda name, done, sim_s: self.progress(
                name, _BEGINS['execute'] + share * done, sim_s
            ),
            cancelled=self.control.cancelled,
        )
        with self.stage('execute'):
            result, engine = self.executed(graph, bag, inner, next_ones)
            execution = self._execution(result, bag.name)
            self.note(execution=execution, iterations=iteration + 1)
            made = BagReport(
                bag=bag.name,
                iteration=iteration,
                ticks=result.ticks,
                trace_sha256=result.trace_sha256,
                graph_sha256=graph.sha256,
            )
            self.note(bags=(*self.facts.bags, made))
        if result.outcome == 'cancelled':
            raise _Cancelled
        with self.stage('verify'):
            verdict = self.stages.verify(graph, bag)
            self.note(verdict=verdict)
        self.folder.write_stage(StageFile.VERDICT, iteration, verdict)
        return Realisation(
            attempt=realised(iteration, grounding, verdict, proposal),
            grounding=grounding,
            execution=execution,
            verdict=verdict,
            engine=engine,
        )

    def executed(
        self, graph: Agsg, bag: Path, control: RunControl, next_ones: Iterator[Agsg] | None
    ) -> tuple[ExecutionResult, str]:
        """Execute beside this process where that can be, else here; tell with which engine."""
        if self.ahead is not None and next_ones is not None:
            found = self.ahead.execute(graph, bag, control, next_ones)
            if found is not None:
                return found, _LOCAL
            if control.cancelled():
                raise _Cancelled
        done = self.stages.execute(graph, bag, self.request, control)
        return done, self.request.engine

    def repair(self, graph: Agsg, first: Realisation) -> None:
        """Realise a violated request otherwise, until it holds or the budget is spent.

        The run is judged by its best realisation, the earliest one among equals; the request and
        what it is judged by stay as they are. Where another engine executed that one, the engine
        of the run executes it again.
        """
        budget = self.budget()
        made = [first]
        taught = learned_of(self.request)
        known = {'learned': taught.moves, 'errors': taught.errors}
        past = [first.attempt.model_copy(update=known)]
        tries = self.known.repair.groundings if budget else 0
        counting: list[Realisation] = []
        is_local = self.request.engine == _LOCAL
        # What a model would revise is not asked of it before its turn; in a graph it is not asked.
        if self.beside is not None and (self.request.model == 'offline' or not is_local):
            if not is_local and tries:
                self.beside.prepare()
            run_id = self.folder.run_id
            self.ahead = Ahead(self.beside, self.stages, self.request, run_id, self.known)
        try:
            while tries and len(made) <= budget and made[-1].verdict.status in _GO_ON:
                tries -= 1
                slots = budget + (self.ahead is not None and not is_local)
                self._share = (len(made) - 1) / slots, 1.0 / slots
                if not self.attempt(graph, made, past, tries):
                    break
            best = best_of(made, self.request.engine)
            if best.engine != self.request.engine:
                self._share = budget / (budget + 1), 1.0 / (budget + 1)
                counting = self.confirm(best, made)
        except (_Cancelled, KeyboardInterrupt):
            self._drop(len(made))
            raise
        finally:
            if self.ahead is not None:
                self.ahead.drop()
            best = best_of(counting or made, self.request.engine)
            self.note(grounding=best.grounding, execution=best.execution, verdict=best.verdict)
            self.note(iterations=len(made))
            conditions = first.graph.conditions
            if not counting or counting is made:
                self.taught = RepairEpisode(
                    id=self.folder.run_id,
                    lessons=lessons(past, conditions),
                    missed=estimates(past, conditions),
                )
            self._share = None

    def confirm(self, best: Realisation, made: list[Realisation]) -> list[Realisation]:
        """Execute a candidate of another engine in that of the run; return what counts then.

        Both give the same trace. Where they do not, only what the engine of the run made counts.
        """
        iteration = len(made)
        graph = best.graph.model_copy(update={'iteration': iteration})
        write_again(self.folder, graph, self.facts.feasibility)
        done = self.execute(best.grounding.model_copy(update={'agsg': graph}), iteration)
        made.append(done)
        told = confirmation(best, done)
        self._tell(told)
        self.folder.write_stage(StageFile.EDITS, iteration, told)
        if done.execution.trace_sha256 == best.execution.trace_sha256:
            return made
        return [one for one in made if one.engine == self.request.engine]

    def relax(self) -> None:
        """Look with which stated numbers the run would hold, where whoever asks wants to know."""
        facts = self.facts
        violated = facts.verdict is not None and facts.verdict.status is VerdictStatus.VIOLATED
        if not (self.request.allow_relax and violated):
            return
        assert facts.verdict is not None
        assert facts.execution is not None  # what has a verdict was executed
        with self.stage('repair'):
            content, graph = load_bag(self.folder.path / facts.execution.bag)
            self.note(relaxed=relaxed(self.known, graph, facts.verdict, content))

    def budget(self) -> int:
        """Return how many co-simulations repair may spend.

        Injected faults test what is said of them: unless it is asked for, nothing goes round them.
        """
        if self.request.repair is not None:
            return self.request.repair
        return 0 if self.request.faults else self.known.repair.unasked

    def attempt(
        self, graph: Agsg, made: list[Realisation], past: list[Attempt], tries: int
    ) -> bool:
        """Try the next proposal; False when there is none. `tries`: how many may follow it."""
        iteration = len(made)
        best = best_of(made, self.request.engine)
        bag = self.folder.path / best.execution.bag
        with self.stage('repair'):
            proposal = self.stages.propose(best.graph, best.verdict, bag, tuple(past))
            self.record_calls(proposal)
        if proposal.outcome is not ProposalOutcome.EDITED:
            self._tell(nothing_left(iteration, proposal))
            return False
        again = graph.model_copy(update={'iteration': iteration})
        grounding = self.ground(again, proposal.plan)
        network = self.known.map(self.request.map_name).network
        unfit = why_not(iteration, proposal, grounding, made[0].grounding, best, past, network)
        if unfit is not None:
            attempt, why = unfit
            past.append(attempt)
            self._tell(repair_report(proposal, attempt, best, why))
            return True
        assert grounding.agsg is not None  # `why_not` tells
        write_again(self.folder, grounding.agsg, self.facts.feasibility)
        next_ones = None
        if self.ahead is not None:
            given = proposal, grounding
            found = self.ahead.following(graph, bag, made, past, given, tries)
            next_ones = islice(found, max(0, self.budget() - iteration))
        done = self.execute(grounding, iteration, proposal, next_ones)
        made.append(done)
        past.append(done.attempt)
        told = repair_report(proposal, done.attempt, best)
        if done.engine != self.request.engine:
            told = told.model_copy(update={'engine': done.engine})
        self._tell(told)
        self.folder.write_stage(StageFile.EDITS, iteration, told)
        return True

    def record_calls(self, proposal: Proposal) -> None:
        """Put what models were asked for a proposal to the other calls of the run."""
        parse = self.facts.parse
        if proposal.model_calls and parse is not None:
            calls = (*parse.model_calls, *proposal.model_calls)
            fields = {name: getattr(parse, name) for name in ParseOutcome.model_fields}
            self.note(parse=ParseOutcome(**{**fields, 'model_calls': calls}))
            self.folder.write_lines(TRANSCRIPT, calls)

    def _tell(self, told: RepairReport) -> None:
        self.note(repairs=(*self.facts.repairs, told))

    def _drop(self, iteration: int) -> None:
        """Take away what an iteration that was not finished has left."""
        self.folder.discard(iteration)
        self.note(bags=tuple(b for b in self.facts.bags if b.iteration < iteration))

    def _execution(self, result: ExecutionResult, name: str) -> ExecutionFacts:
        return ExecutionFacts(
            bag=name,
            ticks=result.ticks,
            dt_s=self._dt_s,
            trace_sha256=result.trace_sha256,
            motion_sha256=result.motion_sha256,
        )


def run(
    request: RunRequest,
    stages: Stages,
    known: Knowledge,
    folder: RunFolder,
    control: RunControl,
    clock: SteadyClock,
    *,
    versions: Mapping[str, str] = MappingProxyType({}),
    manifest: Mapping[str, Any] = MappingProxyType({}),
    outputs: Callable[[RunReport, RunFolder], None] = write_outputs,
    beside: Beside | None = None,
) -> RunReport:
    """Run a prompt and return its report, which is also written to the folder.

    Args:
        request: Prompt and options.
        stages: The engine.
        known: What its stages work with.
        folder: Where everything is written; created here.
        control: Progress and cancel.
        clock: For the timings.
        versions: Versions of the product and of what decides results.
        manifest: Facts about the process, written first (an unfinished run is found by them).
        outputs: Writes what the run leaves for people; campaigns need no pictures.
        beside: Processes that execute candidates of repair; the result is the same without.

    Raises:
        ReportError: The folder cannot be written.
        KeyboardInterrupt: Never: an interrupt becomes the status `cancelled`.
    """
    folder.create()
    asked = request.model_dump(mode='json')
    folder.write_json(MANIFEST, {**manifest, 'run_id': folder.run_id, 'request': asked})
    folder.write_text(PROMPT, request.prompt)
    facts = RunFacts(
        run_id=folder.run_id,
        prompt=request.prompt,
        engine=request.engine,
        model=request.model,
        map_name=request.map_name,
        seed=request.seed,
        versions=versions,
        faults=request.faults,
    )
    state = _Run(request, stages, known, folder, control, clock, facts, beside)
    try:
        state.prepare()
        state.through()
    except (_Cancelled, KeyboardInterrupt):
        state.note(cancelled=True)
    except AuroraError as err:
        state.note(error=err)
    except Exception as err:  # noqa: BLE001  (a defect of ours must not lose the run's report)
        # Too little memory is no defect: where it came to light helps nobody.
        defect = not hint_of_limits(err)
        _LOG.error('run %s broke', folder.run_id, exc_info=defect)
        text = f'{type(err).__name__}: {err}'
        state.note(error=AuroraError(text, hint=hint_for(err)))
    control.progress('report', _BEGINS['report'], 0.0)
    report = build_report(state.facts)
    outputs(report, folder)
    _keep(request, report, state)
    control.progress('done', _BEGINS['done'], 0.0)
    return report


def _keep(request: RunRequest, report: RunReport, state: _Run) -> None:
    """Put a run into the history; it stands, whether that succeeds or not."""
    parse = state.facts.parse
    try:
        remember(request, report, parse.spec if parse is not None else None)
        remember_lessons(request, report, state.taught)
    except AuroraError as err:
        _LOG.warning('run %s is not in the history: %s', report.run_id, err)
