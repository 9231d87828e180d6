# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What a worker of a ruler does: run one trial in the local engine and judge how it ended."""

from __future__ import annotations

import os
import shutil
import time
from abc import ABC, abstractmethod
from collections.abc import Mapping
from dataclasses import dataclass, field
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

from aurora_bench.prompts.format import AnnotatedPrompt, RejectRequirement, flat
from aurora_bench.prompts.reference_names import NotExpressibleError
from aurora_bench.prompts.reference_spec import reference_spec
from aurora_bench.rulers.causes import Found, cause_of, reasons
from aurora_bench.rulers.checking import Check, Said, asked_of, independent_checker
from aurora_bench.rulers.margins import least_margin
from aurora_bench.rulers.readback import ReadBack, read_back
from aurora_bench.rulers.trial import Cause, JudgedTrial, Trial, judged
from aurora_bench.rulers.watched import WatchedStages
from aurora_cli.clock import MonotonicClock
from aurora_cli.installed import installed
from aurora_core.errors import AuroraError
from aurora_core.outcomes.feasibility import CheckStage
from aurora_core.pipeline.run import run
from aurora_core.pipeline.stages import RunControl, RunRequest
from aurora_core.report.outputs import write_report
from aurora_core.report.run_folder import RunFolder, new_run_id
from aurora_core.report.run_report import RunReport
from aurora_core.report.status import Status
from aurora_core.spec.scenario import ScenarioSpec


def run_into(
    place: Path, request: RunRequest, stages: WatchedStages, control: RunControl | None = None
) -> tuple[RunReport, RunFolder]:
    """Run a request in the local engine into a folder of its own below a place."""
    folder = RunFolder(place, new_run_id(datetime.now(UTC), os.urandom(3)))
    report = run(
        request,
        stages,
        stages.known,
        folder,
        control or RunControl(),
        MonotonicClock(),
        outputs=write_report,
    )
    return report, folder


@dataclass(kw_only=True)
class RunWork(ABC):
    """How trials are run; sent to every worker.

    Attributes:
        folder: Runs go below it.
        keep: They stay there.
        map_name: Map of the runs.
        repair: Co-simulations that repair may spend; None: as the command.
        check: The checker; None: the independent one.
    """

    folder: Path
    keep: bool = False
    map_name: str = 'downtown'
    repair: int | None = None
    check: Check | None = None
    _seconds: dict[str, float] = field(default_factory=dict, init=False)

    def prepare(self) -> None:
        """Load what every run needs: simulator, map, configuration, checker."""
        import libsumo  # noqa: F401  (takes seconds; a run would wait for it)

        installed().map(self.map_name)
        if self.check is None:
            self.check = independent_checker()

    def __call__(self, trial: Trial) -> JudgedTrial:
        """Run one trial; its folder goes, whatever happens, unless it is kept."""
        self._seconds = {}
        begin, cpu_begin = time.perf_counter(), time.process_time()
        place = self.folder / trial.folder
        shutil.rmtree(place, ignore_errors=True)  # of a campaign that was cut short
        try:
            place.mkdir(parents=True)
            result = self.judge(trial, place)
        finally:
            if not self.keep:
                shutil.rmtree(place, ignore_errors=True)
        self._seconds['all'] = time.perf_counter() - begin
        # Wall time says little on a machine with other work on it.
        self._seconds['processor'] = time.process_time() - cpu_begin
        return result.model_copy(update={'seconds': self._seconds})

    @abstractmethod
    def judge(self, trial: Trial, place: Path) -> JudgedTrial:
        """Run a trial into a folder and judge it."""

    def ran(self, request: RunRequest, place: Path, stages: WatchedStages) -> Ran:
        """Run a request into a folder and remember how long its stages took."""
        report, folder = run_into(place, request, stages)
        self._seconds.update(report.timing)
        return Ran(report, stages, folder.path)

    def verified(self, trial: Trial, ran: Ran) -> JudgedTrial:
        """Judge a run that had to be verified."""
        report = ran.report
        said: tuple[Said, ...] = ()
        found: Found | None = None
        if report.status is Status.VERIFIED:
            said, found = self._checked(trial, ran)
        else:
            found = cause_of(report, ran.stages.grounding)
        margin, margin_of = least_margin(report.conditions, _derived(ran))
        return judged(
            trial,
            status=report.status.value,
            cause=found[0] if found is not None else None,
            words=found[1] if found is not None else (),
            summary=report.summary,
            said=said,
            margin=margin,
            margin_of=margin_of,
            placed=_placed(ran),
            trace_sha256=report.trace.sha256 if report.trace is not None else '',
            motion_sha256=report.trace.motion_sha256 if report.trace is not None else '',
            repairs=max(0, report.metrics.iterations - 1),
            repaired=_repaired(report),
        )

    def _checked(self, trial: Trial, ran: Ran) -> tuple[tuple[Said, ...], Found | None]:
        """Let the checker contradict a verified run; one that breaks has confirmed nothing."""
        assert self.check is not None
        assert ran.report.trace is not None
        bag = ran.folder / ran.report.trace.bag
        begin = time.perf_counter()
        try:
            said = asked_of(self.check, bag, trial.document)
        except Exception as err:  # noqa: BLE001  (a checker that breaks must not end the campaign)
            return (), (Cause.ERROR, (f'checker: {type(err).__name__}: {err}',))
        finally:
            self._seconds['checker'] = time.perf_counter() - begin
        wrong = tuple(dict.fromkeys(s.kind for s in said if s.outcome == 'does_not'))
        return said, (Cause.CONTRADICTED, wrong) if wrong else None


@dataclass(frozen=True)
class Ran:
    """A run that is over, while its folder is still there.

    Attributes:
        report: What it says of itself.
        stages: The engine that it ran in.
        folder: Its run folder.
    """

    report: RunReport
    stages: WatchedStages
    folder: Path


@dataclass(kw_only=True)
class RealiseWork(RunWork):
    """Runs the reference of every annotation."""

    def judge(self, trial: Trial, place: Path) -> JudgedTrial:
        """Build the reference and run it."""
        begin = time.perf_counter()
        try:
            spec = on_map(reference_spec(trial.prompt, judged=True), self.map_name)
        except NotExpressibleError as err:
            return judged(
                trial,
                status='not_expressible',
                cause=Cause.CAPABILITY,
                words=(str(err),),
                summary=f'The annotation cannot be written as a specification: {err}',
            )
        finally:
            self._seconds['reference'] = time.perf_counter() - begin
        request = RunRequest(
            prompt=trial.prompt.prompt,
            seed=trial.seed,
            map_name=self.map_name,
            repair=self.repair,
        )
        return self.verified(trial, self.ran(request, place, WatchedStages(spec)))


@dataclass(kw_only=True)
class OutcomeWork(RunWork):
    """Runs every prompt from its text.

    Attributes:
        model: Who reads, as in `aurora run`.
        transcripts: Recorded replies in place of the models.
        without: Levels of the check that are left out.
    """

    model: str = 'offline'
    transcripts: Path | None = None
    without: frozenset[CheckStage] = frozenset()

    def stages(self) -> WatchedStages:
        """Return the engine of the next run."""
        return WatchedStages(without=self.without)

    def judge(self, trial: Trial, place: Path) -> JudgedTrial:
        """Run the prompt."""
        request = RunRequest(
            prompt=trial.prompt.prompt,
            seed=trial.seed,
            map_name=self.map_name,
            model=self.model,
            transcripts=self.transcripts,
            history_frozen=True,
            repair=self.repair,
        )
        ran = self.ran(request, place, self.stages())
        if trial.prompt.feasibility != 'infeasible':
            return self.verified(trial, ran)
        found = refusal_cause(trial.prompt, ran.report)
        return judged(
            trial,
            status=ran.report.status.value,
            cause=found[0] if found is not None else None,
            words=found[1] if found is not None else (),
            summary=ran.report.summary,
        )


def _derived(ran: Ran) -> str:
    """Return the conditions of a run as JSON text."""
    grounding = ran.stages.grounding
    grounded = None if grounding is None else grounding.agsg
    return grounded.texts.conditions or '[]' if grounded is not None else '[]'


def _placed(ran: Ran) -> ReadBack | None:
    outcome, trace = ran.stages.grounding, ran.report.trace
    agsg = None if outcome is None else outcome.agsg
    # What repair grounded again is not what was remembered.
    if trace is None or agsg is None or agsg.grounding is None or ran.report.repairs:
        return None
    try:
        return read_back(ran.folder / trace.bag, agsg.grounding)
    except AuroraError:
        return None  # a damaged bag has its own words in the report


def _repaired(report: RunReport) -> bool:
    """Tell whether a run was verified by another realisation than its first one."""
    return report.status is Status.VERIFIED and report.metrics.iterations > 1


def refusal_cause(prompt: AnnotatedPrompt, report: RunReport) -> Found | None:
    """Return why a run that had to be refused is not right; None when it is.

    One of the annotated reasons suffices: several are several fair readings.
    """
    wanted = {r.because for r in flat(prompt.requirements) if isinstance(r, RejectRequirement)}
    given = reasons(report)
    if wanted.intersection(given):
        return None
    if given:
        return Cause.OTHER_REASON, tuple(f'{", ".join(sorted(wanted))}: {g}' for g in given)
    if report.status in (Status.VERIFIED, Status.VERIFIED_AS_EDITED):
        return Cause.ACCEPTED, tuple(sorted(wanted))
    if report.status in (Status.ERROR, Status.CANCELLED):
        return cause_of(report, None)
    return Cause.NOT_REFUSED, (report.status.value,)


def on_map(spec: ScenarioSpec, map_name: str) -> ScenarioSpec:
    """Return a specification that lies on a map unless its annotation names another one."""
    values: Mapping[str, Any] = {'map_name': map_name}
    if 'map_name' in spec.world.model_fields_set:
        return spec
    return spec.model_copy(update={'world': spec.world.model_copy(update=values)})
