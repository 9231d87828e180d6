# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`aurora check`: parse, ground and judge feasibility; nothing is simulated."""

from __future__ import annotations

from pathlib import Path

from aurora_cli.answers import check_facts
from aurora_cli.output import answer_console, print_json, quiet_stdout
from aurora_cli.prompt_input import prompt_bytes
from aurora_cli.requests import RunOptions, checked, unreadable, with_prompt
from aurora_core.errors import PromptError
from aurora_core.report.check_report import build_check, check_exit_code
from aurora_core.report.terminal import print_check


def check_command(
    argument: str | None, prompt_file: Path | None, options: RunOptions, *, as_json: bool
) -> int:
    """Check a prompt and return the exit code.

    Raises:
        UsageProblem: Options or prompt source are wrong.
    """
    request = checked(options)
    raw = prompt_bytes(argument, prompt_file)
    ready = with_prompt(request, raw)
    with quiet_stdout():
        if isinstance(ready, PromptError):
            facts = unreadable(request, raw, ready, '')
        else:
            facts = check_facts(ready)
        report = build_check(facts)
    if as_json:
        print_json(report)
    else:
        print_check(report, answer_console())
    return int(check_exit_code(report.result))
