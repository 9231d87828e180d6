# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`aurora run`: one prompt through the whole chain."""

from __future__ import annotations

from pathlib import Path

from aurora_cli.answers import Run, new_folder, run_request
from aurora_cli.files import full_path
from aurora_cli.interrupts import Interrupts
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
from aurora_cli.requests import RunOptions, beside_of, checked, unreadable, with_prompt
from aurora_core.errors import AuroraError, PromptError
from aurora_core.pipeline.stages import RunControl, RunRequest
from aurora_core.report.build import build_report
from aurora_core.report.outputs import write_report
from aurora_core.report.run_folder import MANIFEST, PROMPT
from aurora_core.report.status import exit_code
from aurora_core.report.terminal import print_report
from aurora_core.report.unfinished import close_unfinished


def run_command(
    argument: str | None,
    prompt_file: Path | None,
    options: RunOptions,
    *,
    picture: bool,
    quiet: bool,
    as_json: bool,
) -> int:
    """Run a prompt and return the exit code.

    Raises:
        UsageProblem: Options or prompt source are wrong.
        AuroraError: The run folder cannot be written, or the graph cannot be reached.
    """
    request = checked(options)
    raw = prompt_bytes(argument, prompt_file)
    root = full_path(options.out)
    with quiet_stdout():
        for run_id in close_unfinished(root):
            say(f'aurora: closed the unfinished run {run_id} as error')
        ready = with_prompt(request, raw)
        if isinstance(ready, PromptError):
            done = _unreadable(request, raw, ready, root)
        else:
            with (
                Interrupts() as interrupts,
                beside_of(options) as beside,
                RunProgress(quiet=quiet) as progress,
            ):
                control = RunControl(progress=progress.update, cancelled=interrupts.cancelled)
                jobs = options.elsewhere.jobs
                done = run_request(ready, root, control, _say, beside, jobs)
    if as_json:
        print_json(done.report)
        say(f'aurora: run folder {done.folder}')
    else:
        print_report(done.report, answer_console(), done.folder, brief=quiet)
    # The verdict first: nobody waits for page and picture to hear it.
    if (picture or not done.has_page) and not _page_written(done, picture=picture):
        return BROKEN
    return int(exit_code(done.status))


def _say(text: str) -> None:
    say(f'aurora: {text}')


def _page_written(done: Run, *, picture: bool) -> bool:
    """Write the page of a run that has been told, and its picture; Ctrl-C spares the picture."""
    try:
        with quiet_stdout():
            done.write_page(picture=picture)
    except KeyboardInterrupt:
        if picture:
            say(f'aurora: no picture was drawn; aurora picture {done.folder} does it')
    except AuroraError as err:
        print_error(err, as_json=False)
        return False
    return True


def _unreadable(request: RunRequest, raw: bytes, err: PromptError, root: Path) -> Run:
    folder, manifest = new_folder(root)
    folder.create()
    folder.write_json(MANIFEST, {**manifest, 'request': request.model_dump(mode='json')})
    folder.write_bytes(PROMPT, raw)
    report = build_report(unreadable(request, raw, err, folder.run_id))
    write_report(report, folder)
    return Run(report=report, folder=folder.path)
