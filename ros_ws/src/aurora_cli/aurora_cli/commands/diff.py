# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`aurora diff`: where two recorded runs part."""

from __future__ import annotations

from dataclasses import replace

from aurora_cli.bags import find_bag
from aurora_cli.installed import installed
from aurora_cli.output import answer_console, print_json, quiet_stdout
from aurora_core.agsg.message import read_agsg
from aurora_core.pipeline.verify_run import verify_found
from aurora_core.report.diff_report import DiffRun, diff_exit_code, diff_report
from aurora_core.report.diff_terminal import print_diff
from aurora_core.trace.bag_reader import read_bag
from aurora_core.trace.definitions import message_definitions


def diff_command(first: str, second: str, iteration: int | None, *, as_json: bool) -> int:
    """Compare two runs and return the exit code.

    Raises:
        UsageProblem: There is no such run or bag.
        AuroraError: A bag cannot be read.
    """
    with quiet_stdout():
        report = diff_report(_read(first, iteration), _read(second, iteration))
    if as_json:
        print_json(report)
    else:
        print_diff(report, answer_console())
    return int(diff_exit_code(report))


def _read(run_or_bag: str, iteration: int | None) -> DiffRun:
    found = find_bag(run_or_bag, iteration)
    content = read_bag(found.bag, message_definitions())
    agsg = verdict = None
    if content.agsg_message is not None:
        agsg = read_agsg(content.agsg_message)
        if content.trace.ticks:
            verified = verify_found(installed(), found, content, agsg, as_recorded=True)
            verdict = verified.verdict
            if verified.run is not None and verified.run.doubts:
                # Compared all the same, but as what it is.
                note = '; '.join(doubt.text for doubt in verified.run.doubts)
                note = f'{content.trace.integrity_note}; {note}'.removeprefix('; ')
                trace = replace(content.trace, integrity=verdict.integrity, integrity_note=note)
                content = replace(content, trace=trace)
    return DiffRun(bag=str(found.bag), content=content, agsg=agsg, verdict=verdict)
