# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`aurora run`: one prompt through the whole chain."""

from __future__ import annotations

import os
from datetime import UTC, datetime
from pathlib import Path

from aurora_cli.clock import MonotonicClock
from aurora_cli.installed import installed
from aurora_cli.interrupts import Interrupts
from aurora_cli.local_engine import LocalStages
from aurora_cli.output import (
    BROKEN,
    answer_console,
    print_error,
    print_json,
    quiet_stdout,
    say,
)
from aurora_cli.progress import RunProgress
from aurora_cli.prompt_input import prompt_bytes
from aurora_cli.requests import RunOptions, checked, unreadable, with_prompt
from aurora_core.errors import AuroraError, PromptError
from aurora_core.pipeline.run import run
from aurora_core.pipeline.stages import RunControl, RunRequest
from aurora_core.report.build import build_report
from aurora_core.report.manifest import manifest_facts
from aurora_core.report.outputs import write_outputs, write_page, write_report
from aurora_core.report.process import this_process
from aurora_core.report.run_folder import MANIFEST, PROMPT, RunFolder, new_run_id
from aurora_core.report.run_report import RunReport
from aurora_core.report.status import exit_code
from aurora_core.report.terminal import print_report
from aurora_core.report.unfinished import close_unfinished
from aurora_core.report.versions import product_versions


def run_command(
    argument: str | None, prompt_file: Path | None, options: RunOptions, *, as_json: bool
) -> int:
    """Run a prompt and return the exit code.

    Raises:
        UsageProblem: Options or prompt source are wrong.
        AuroraError: The run folder cannot be written, or the graph cannot be reached.
    """
    request = checked(options)
    stages: LocalStages | None = None
    raw = prompt_bytes(argument, prompt_file)
    root = options.out.absolute()
    with quiet_stdout():
        for run_id in close_unfinished(root):
            say(f'aurora: closed the unfinished run {run_id} as error')
        ready = with_prompt(request, raw)
        if isinstance(ready, PromptError):
            report, folder = _unreadable(request, raw, ready, root)
        elif ready.engine == 'ros':
            from aurora_cli.ros_client import run_over_ros

            with Interrupts() as interrupts, RunProgress() as progress:
                control = RunControl(progress=progress.update, cancelled=interrupts.cancelled)
                report, folder = run_over_ros(ready, root, control)
        else:
            stages = LocalStages(installed())
            report, folder = _local(ready, root, stages)
    if as_json:
        print_json(report)
        say(f'aurora: run folder {folder}')
    else:
        print_report(report, answer_console(), folder)
    # The verdict first: drawing the picture takes as long as the flight.
    if stages is not None and not _page_written(report, folder, stages):
        return BROKEN
    return int(exit_code(report.status))


def _page_written(report: RunReport, folder: Path, stages: LocalStages) -> bool:
    """Write picture and page of a run that has been told; Ctrl-C spares the picture."""
    try:
        with quiet_stdout():
            write_page(report, RunFolder(folder.parent, folder.name), stages.verified)
    except KeyboardInterrupt:
        say(f'aurora: no picture was drawn; aurora picture {folder} -o FILE does it')
    except AuroraError as err:
        print_error(err, as_json=False)
        return False
    return True


def _local(request: RunRequest, root: Path, stages: LocalStages) -> tuple[RunReport, Path]:
    folder, started = _new_folder(root)
    versions = product_versions()
    with Interrupts() as interrupts, RunProgress() as progress:
        report = run(
            request,
            stages,
            stages.known,
            folder,
            RunControl(progress=progress.update, cancelled=interrupts.cancelled),
            MonotonicClock(),
            versions=versions,
            manifest=manifest_facts(started, this_process(), versions),
            outputs=write_report,
        )
    return report, folder.path


def _unreadable(
    request: RunRequest, raw: bytes, err: PromptError, root: Path
) -> tuple[RunReport, Path]:
    folder, started = _new_folder(root)
    folder.create()
    manifest = manifest_facts(started, this_process(), product_versions())
    folder.write_json(MANIFEST, {**manifest, 'request': request.model_dump(mode='json')})
    folder.write_bytes(PROMPT, raw)
    report = build_report(unreadable(request, raw, err, folder.run_id))
    write_outputs(report, folder)
    return report, folder.path


def _new_folder(root: Path) -> tuple[RunFolder, datetime]:
    started = datetime.now(UTC)
    return RunFolder(root, new_run_id(started, os.urandom(3))), started
