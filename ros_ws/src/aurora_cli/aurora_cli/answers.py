# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""One request checked or run in this process: the same for the command and for `import aurora`."""

from __future__ import annotations

import os
from collections.abc import Callable
from dataclasses import dataclass, replace
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

from aurora_cli.clock import MonotonicClock
from aurora_cli.installed import installed
from aurora_cli.local_engine import LocalStages
from aurora_core.errors import AuroraError
from aurora_core.judging.evaluation import Context
from aurora_core.outcomes.feasibility import Feasibility
from aurora_core.pipeline import functions
from aurora_core.pipeline.beside import Beside
from aurora_core.pipeline.run import run
from aurora_core.pipeline.stages import RunControl, RunRequest
from aurora_core.report.facts import RunFacts
from aurora_core.report.manifest import manifest_facts
from aurora_core.report.outputs import write_page, write_report
from aurora_core.report.process import this_process
from aurora_core.report.run_folder import REPORT_HTML, RunFolder, new_run_id
from aurora_core.report.run_report import ClauseReport, ConditionReport, RunReport, TraceReport
from aurora_core.report.status import Status
from aurora_core.report.versions import product_versions
from aurora_core.trace.bag_content import BagContent
from aurora_llm.parse import read_prompt


@dataclass(frozen=True, slots=True, kw_only=True, repr=False)
class Run:
    """A run that has ended.

    Attributes:
        report: All that is said about it; `report.json` holds the same.
        folder: Its run folder.
        content: Its bag as it was read back for the verdict: trace (metres, seconds, ENU), world.
            None where nothing was judged in this process.
        context: What was measured of it for the verdict; None where `content` is None.
    """

    report: RunReport
    folder: Path
    content: BagContent | None = None
    context: Context | None = None

    def __repr__(self) -> str:
        return f'<Run {self.status.value}: {self.folder}>'

    @property
    def status(self) -> Status:
        """What the run may claim."""
        return self.report.status

    @property
    def clauses(self) -> tuple[ClauseReport, ...]:
        """Every clause of the prompt and what became of it."""
        return self.report.clauses

    @property
    def conditions(self) -> tuple[ConditionReport, ...]:
        """Every condition with its margin, in its unit."""
        return self.report.conditions

    @property
    def trace(self) -> TraceReport | None:
        """The recording, with trace and motion hash; None when nothing was executed."""
        return self.report.trace

    @property
    def has_page(self) -> bool:
        """Whether `report.html` lies in the run folder."""
        return (self.folder / REPORT_HTML).exists()

    def write_page(self, *, picture: bool = False) -> None:
        """Write `report.html`.

        Args:
            picture: Draw `picture.png`, too, which takes longer than a short flight, and show it
                on the page.

        Raises:
            ReportError: The folder cannot be written.
            KeyboardInterrupt: The page was written without a picture.
        """
        folder = RunFolder(self.folder.parent, self.folder.name)
        write_page(self.report, folder, self.content, self.context, picture=picture)


def check_facts(request: RunRequest) -> RunFacts:
    """Parse, check and ground a request; what breaks is one of the facts."""
    found: dict[str, Any] = {}
    try:
        known = installed()
        found['parse'] = parse = read_prompt(known, request)
        if parse.agsg is not None:
            found['feasibility'] = feasibility = functions.check_stage(known, parse.agsg)
            if feasibility.result is not Feasibility.INFEASIBLE:
                found['grounding'] = functions.ground_stage(known, parse.agsg, request.seed)
    except AuroraError as err:
        found['error'] = err
    return RunFacts(
        run_id='',
        prompt=request.prompt,
        model=request.model,
        map_name=request.map_name,
        seed=request.seed,
        **found,
    )


def run_request(
    request: RunRequest,
    root: Path,
    control: RunControl,
    tell: Callable[[str], None] = lambda _: None,
    beside: Beside | None = None,
    jobs: int | None = None,
) -> Run:
    """Run a request with its engine; without the page, unless the graph made it.

    Args:
        request: Prompt and options.
        root: Folder of the run folders, absolute.
        control: Progress and cancel.
        tell: Takes what the user should know meanwhile.
        beside: Who executes candidates of repair beside this process, in the local engine.
        jobs: Processes that do so for the graph; None: as its configuration says.

    Raises:
        AuroraError: The run folder cannot be written, or the graph cannot be reached.
    """
    if request.engine == 'ros':
        from aurora_cli.ros_client import run_over_ros

        report, path = run_over_ros(request, root, control, tell, jobs)
        return Run(report=report, folder=path)
    return run_stages(request, LocalStages(installed()), root, control, beside)


def run_stages(
    request: RunRequest,
    stages: LocalStages,
    root: Path,
    control: RunControl,
    beside: Beside | None = None,
) -> Run:
    """Run a request with stages of this process; without the page.

    Args:
        request: Prompt and options.
        stages: What is called.
        root: Folder of the run folders, absolute.
        control: Progress and cancel.
        beside: Who executes candidates of repair beside this process; None: nobody.

    Raises:
        AuroraError: The run folder cannot be written.
    """
    folder, manifest = new_folder(root)
    report = run(
        request,
        stages,
        stages.known,
        folder,
        control,
        MonotonicClock(),
        versions=manifest['versions'],
        manifest=manifest,
        outputs=write_report,
        beside=beside,
    )
    done = Run(report=report, folder=folder.path)
    # The bag that the report is about, when it was the last one to be read.
    if report.trace is None or folder.path / report.trace.bag != stages.verified_bag:
        return done
    judged = stages.judged
    context = judged.context if judged is not None else None
    return replace(done, content=stages.verified, context=context)


def new_folder(root: Path) -> tuple[RunFolder, dict[str, Any]]:
    """Return a run folder with a new id, not created yet, and the first facts of its manifest."""
    started = datetime.now(UTC)
    folder = RunFolder(root, new_run_id(started, os.urandom(3)))
    return folder, manifest_facts(started, this_process(), product_versions())
