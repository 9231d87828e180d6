# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`aurora picture`: draw any recorded run."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from aurora_cli.bags import find_bag
from aurora_cli.files import write_file
from aurora_cli.installed import installed
from aurora_cli.output import UsageProblem, print_json, quiet_stdout, say
from aurora_core.pipeline.verification import load_bag
from aurora_core.pipeline.verify_run import verify_found
from aurora_core.report.find_bag import FoundBag
from aurora_core.report.picture.draw import draw_picture, png_bytes, svg_bytes
from aurora_core.report.run_documents import read_document
from aurora_core.report.run_folder import PICTURE, REPORT
from aurora_core.report.run_report import RunReport
from aurora_core.report.scene.caption import Caption
from aurora_core.report.status import Status
from aurora_core.report.verify_report import VerifyOutcome, VerifyReport

_STATUS = {
    VerifyOutcome.VERIFIED: Status.VERIFIED,
    VerifyOutcome.MARGINS_HOLD: Status.INCOMPLETE,
    VerifyOutcome.VIOLATED: Status.VIOLATED,
}
_WRITERS = {'.png': png_bytes, '.svg': svg_bytes}


def picture_command(
    run_or_bag: str, output: Path | None, iteration: int | None, *, as_json: bool
) -> int:
    """Draw a run into a PNG or SVG file and return the exit code.

    Args:
        run_or_bag: What is drawn.
        output: The file; None: `picture.png` in the run folder.
        iteration: Of a run folder, None for the one reported.
        as_json: Answer with a JSON document.

    Raises:
        UsageProblem: There is no such run or bag, the file name ends neither way, or none is given
            for what has no run folder or is not what its report tells of.
        AuroraError: The bag cannot be read, or the file cannot be written.
    """
    if output is not None and output.suffix.lower() not in _WRITERS:
        raise UsageProblem(f'-o takes a name that ends with .png or .svg, found {output}')
    found = find_bag(run_or_bag, iteration)
    if output is None:
        if found.run is None or iteration is not None:
            raise UsageProblem('of a bag alone or of an iteration, say where to: -o FILE')
        output = found.run / PICTURE
    with quiet_stdout():
        content, agsg = load_bag(found.bag)
        caption = _caption(verify_found(installed(), found, content, agsg), found)
        figure = draw_picture(content.trace, content.world, caption, spec=agsg.spec)
        write_file(output, _WRITERS[output.suffix.lower()](figure))
    if as_json:
        print_json({'bag': str(found.bag), 'picture': str(output)})
    else:
        say(f'aurora: wrote {output}')
    return 0


def _caption(verified: VerifyReport, found: FoundBag) -> Caption:
    """Return the words of the run when the bag is the one it was judged by, else the bag's."""
    run = verified.run
    if run is not None and found.run is not None and not run.doubts:
        report = read_document(found.run / REPORT, RunReport)
        # The report tells of the last iteration; an earlier bag speaks for itself.
        if (
            isinstance(report, RunReport)
            and report.trace is not None
            and report.trace.sha256 == verified.trace_sha256
        ):
            return Caption.of_report(report)
    caption = Caption.of_verdict(verified.prompt, verified.verdict)
    return replace(caption, status=_STATUS.get(verified.outcome, Status.INCONCLUSIVE))
