# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`aurora check`: parse, ground and judge feasibility; nothing is simulated."""

from __future__ import annotations

from pathlib import Path

from aurora_cli.installed import installed
from aurora_cli.output import answer_console, print_json, quiet_stdout
from aurora_cli.prompt_input import prompt_bytes
from aurora_cli.requests import RunOptions, checked, unreadable, with_prompt
from aurora_core.errors import AuroraError, PromptError
from aurora_core.outcomes.feasibility import Feasibility
from aurora_core.pipeline import functions
from aurora_core.pipeline.stages import RunRequest
from aurora_core.report.check_report import build_check, check_exit_code
from aurora_core.report.facts import RunFacts
from aurora_core.report.terminal import print_check
from aurora_llm.parse import read_prompt


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
            facts = _facts(ready)
        report = build_check(facts)
    if as_json:
        print_json(report)
    else:
        print_check(report, answer_console())
    return int(check_exit_code(report.result))


def _facts(request: RunRequest) -> RunFacts:
    parse = feasibility = grounding = None
    error: AuroraError | None = None
    try:
        known = installed()
        parse = read_prompt(known, request)
        if parse.agsg is not None:
            feasibility = functions.check_stage(known, parse.agsg)
            if feasibility.result is not Feasibility.INFEASIBLE:
                grounding = functions.ground_stage(known, parse.agsg, request.seed)
    except AuroraError as err:
        error = err
    return RunFacts(
        run_id='',
        prompt=request.prompt,
        model=request.model,
        map_name=request.map_name,
        seed=request.seed,
        parse=parse,
        feasibility=feasibility,
        grounding=grounding,
        error=error,
    )
