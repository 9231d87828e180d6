# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`aurora picture`: draw any recorded run."""

from __future__ import annotations

from pathlib import Path

from pydantic import ValidationError

from aurora_cli.bags import find_bag
from aurora_cli.files import write_file
from aurora_cli.output import UsageProblem, print_json, quiet_stdout, say
from aurora_core.conditions.condition import conditions_from_json
from aurora_core.files import DOCUMENT_BYTES, read_bytes
from aurora_core.monitor.verify import verify
from aurora_core.pipeline.functions import load_bag
from aurora_core.report.picture.caption import Caption
from aurora_core.report.picture.draw import draw_picture, png_bytes, svg_bytes
from aurora_core.report.run_folder import REPORT
from aurora_core.report.run_report import RunReport

_WRITERS = {'.png': png_bytes, '.svg': svg_bytes}


def picture_command(run_or_bag: str, output: Path, iteration: int | None, *, as_json: bool) -> int:
    """Draw a run into a PNG or SVG file and return the exit code.

    Raises:
        UsageProblem: There is no such run or bag, or the file name ends neither way.
        AuroraError: The bag cannot be read, or the file cannot be written.
    """
    writer = _WRITERS.get(output.suffix.lower())
    if writer is None:
        raise UsageProblem(f'-o takes a name that ends with .png or .svg, found {output}')
    found = find_bag(run_or_bag, iteration)
    with quiet_stdout():
        content, agsg = load_bag(found.bag)
        report = _report(found.run) if found.run is not None else None
        # The report tells of the last iteration; an earlier bag speaks for itself.
        if report is not None and (report.trace is None or report.trace.bag != found.bag.name):
            report = None
        if report is not None:
            caption = Caption.of_report(report)
        else:
            conditions = conditions_from_json(content.world.conditions_json)
            verdict = verify(content.trace, content.world, conditions, agsg.spec)
            caption = Caption.of_verdict(agsg.spec.prompt, verdict)
        figure = draw_picture(content.trace, content.world, caption, spec=agsg.spec)
        write_file(output, writer(figure))
    if as_json:
        print_json({'bag': str(found.bag), 'picture': str(output)})
    else:
        say(f'aurora: wrote {output}')
    return 0


def _report(run: Path) -> RunReport | None:
    try:
        return RunReport.model_validate_json(read_bytes(run / REPORT, DOCUMENT_BYTES))
    except (OSError, ValidationError):
        return None
