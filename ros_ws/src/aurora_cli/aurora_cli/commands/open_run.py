# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`aurora open`: the report of a run in a browser."""

from __future__ import annotations

import os
import webbrowser
from pathlib import Path

from aurora_cli.output import UsageProblem, answer_console, print_json, quiet_stdout, say
from aurora_core.errors import ReportError
from aurora_core.report.outputs import add_picture, write_page
from aurora_core.report.run_documents import Unreadable, read_document
from aurora_core.report.run_folder import (
    PICTURE,
    REPORT,
    REPORT_HTML,
    SIGNED,
    RunFolder,
    is_run_id,
)
from aurora_core.report.run_report import RunReport
from aurora_core.report.terminal import line


def open_command(run: str | None, root: Path, *, as_json: bool) -> int:
    """Show `report.html` of a run with its picture, made first where they are not there.

    Without a screen its address is printed alone.

    Raises:
        UsageProblem: There is no such run.
        AuroraError: The run has no report, or its page cannot be written.
    """
    folder = _folder(run, root)
    page = folder / REPORT_HTML
    if not (page.exists() and (folder / PICTURE).exists()):
        with quiet_stdout():
            _make(folder)
    address = page.absolute().as_uri()
    if as_json:
        print_json({'run': folder.name, 'page': str(page), 'url': address})
        return 0
    line(answer_console(), address)
    if _has_screen():
        with quiet_stdout():
            opened = webbrowser.open(address)
        if not opened:
            say('aurora: no browser was found; open the address above in one')
    return 0


def _make(folder: Path) -> None:
    """Make the page with its picture, or draw the picture into the page that is there.

    Raises:
        AuroraError: There is no page, and none can be made.
    """
    report = read_document(folder / REPORT, RunReport)
    has_page = (folder / REPORT_HTML).exists()
    try:
        if (folder / SIGNED).exists():
            raise ReportError(
                f'{folder.name} is signed and stays as it is',
                hint='aurora picture RUN -o FILE draws it elsewhere',
            )
        if isinstance(report, Unreadable):
            raise ReportError(
                f'{folder.name} has no report: {report.why}',
                hint='aurora doctor --fix closes a run that was cut short',
            )
        run = RunFolder(folder.parent, folder.name)
        if has_page:
            add_picture(report, run)
        else:
            write_page(report, run, picture=True)
    except ReportError as err:
        # A run that may not be written to, or under another name: its page is shown as it is.
        if not has_page:
            raise
        say(f'aurora: no picture was drawn: {err.message}')


def _has_screen() -> bool:
    return any(os.environ.get(name) for name in ('DISPLAY', 'WAYLAND_DISPLAY', 'BROWSER'))


def _folder(run: str | None, root: Path) -> Path:
    """Return the folder of a run, the last one when none is named."""
    if run is not None:
        for folder in (Path(run), root / run):
            if folder.is_dir():
                return folder.resolve()
        raise UsageProblem(f'{run} is neither a run folder nor a run in {root}')
    found = sorted(p for p in root.glob('*') if is_run_id(p.name) and p.is_dir())
    if not found:
        raise UsageProblem(f'there is no run in {root} yet: aurora run "..." makes one')
    return found[-1].resolve()
