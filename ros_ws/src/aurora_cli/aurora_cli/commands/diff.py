# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`aurora diff`: where two recorded runs part."""

from __future__ import annotations

from aurora_cli.bags import find_bag
from aurora_cli.output import answer_console, print_json, quiet_stdout
from aurora_core.agsg.build import derived
from aurora_core.agsg.message import read_agsg
from aurora_core.conditions.condition import conditions_from_json
from aurora_core.monitor.verify import verify
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
    bag = find_bag(run_or_bag, iteration).bag
    content = read_bag(bag, message_definitions())
    agsg = verdict = None
    if content.agsg_message is not None:
        agsg = read_agsg(content.agsg_message, derived)
        if content.trace.ticks:
            conditions = conditions_from_json(content.world.conditions_json)
            verdict = verify(content.trace, content.world, conditions, agsg.spec)
    return DiffRun(bag=str(bag), content=content, agsg=agsg, verdict=verdict)
