# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`aurora verify`: recompute every margin from a bag alone."""

from __future__ import annotations

from dataclasses import replace

from aurora_cli.bags import find_bag
from aurora_cli.output import answer_console, print_json, quiet_stdout
from aurora_core.pipeline.functions import load_bag, verify_content
from aurora_core.report.recorded_trace import believed, recorded_trace
from aurora_core.report.run_folder import StageFile
from aurora_core.report.terminal import print_verify
from aurora_core.report.verify_report import (
    Comparison,
    VerifyReport,
    compare,
    read_recorded,
    verify_exit_code,
)
from aurora_core.trace.hashing import trace_sha256


def verify_command(run_or_bag: str, iteration: int | None, *, as_json: bool) -> int:
    """Verify a bag and return the exit code.

    Raises:
        UsageProblem: There is no such run or bag.
        AuroraError: The bag holds nothing that could be judged.
    """
    found = find_bag(run_or_bag, iteration)
    with quiet_stdout():
        content, agsg = load_bag(found.bag)
        trace = content.trace
        sha256 = trace_sha256(trace, content.world)
        if found.run is not None:
            trace = believed(trace, sha256, recorded_trace(found.run, found.bag.name))
        verdict = verify_content(replace(content, trace=trace), agsg)
        recorded: Comparison | None = None
        if found.run is not None and found.iteration is not None:
            name = StageFile.VERDICT.name_at(found.iteration)
            written = read_recorded(found.run / name)
            if written is not None:
                recorded = compare(written, verdict, name)
        report = VerifyReport(
            bag=str(found.bag),
            ticks=trace.ticks,
            trace_sha256=sha256,
            verdict=verdict,
            recorded=recorded,
        )
    if as_json:
        print_json(report)
    else:
        print_verify(report, answer_console())
    return int(verify_exit_code(report))
