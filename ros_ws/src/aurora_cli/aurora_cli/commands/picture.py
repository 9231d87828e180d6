# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`aurora picture`: draw any recorded run."""

from __future__ import annotations

from dataclasses import dataclass, replace
from enum import StrEnum
from pathlib import Path

from aurora_cli.bags import find_bag
from aurora_cli.files import write_file
from aurora_cli.installed import installed
from aurora_cli.output import UsageProblem, print_json, quiet_stdout, say
from aurora_core.knowledge.world import WorldModel
from aurora_core.pipeline.verification import load_bag
from aurora_core.pipeline.verify_run import verify_found
from aurora_core.report.find_bag import FoundBag
from aurora_core.report.picture.draw import draw_picture, png_bytes, svg_bytes
from aurora_core.report.picture.paper import (
    draw_paper,
    moment_lines,
    paper_bytes,
    told_moments,
)
from aurora_core.report.picture.video import gif_bytes
from aurora_core.report.run_documents import read_document
from aurora_core.report.run_folder import PICTURE, REPORT, SIGNED
from aurora_core.report.run_report import RunReport
from aurora_core.report.scene.caption import Caption
from aurora_core.report.scene.tracks import tracks_of
from aurora_core.report.status import Status
from aurora_core.report.verify_report import VerifyOutcome, VerifyReport
from aurora_core.spec.scenario import ScenarioSpec
from aurora_core.trace.trace import Trace

_STATUS = {
    VerifyOutcome.VERIFIED: Status.VERIFIED,
    VerifyOutcome.MARGINS_HOLD: Status.INCOMPLETE,
    VerifyOutcome.VIOLATED: Status.VIOLATED,
}
_WRITERS = {'.png': png_bytes, '.svg': svg_bytes}


class PictureStyle(StrEnum):
    """What the picture is for."""

    SCREEN = 'screen'
    PAPER = 'paper'


_ENDINGS = {PictureStyle.SCREEN: ('.png', '.svg'), PictureStyle.PAPER: ('.pdf', '.svg', '.png')}


@dataclass(frozen=True, slots=True, kw_only=True)
class PictureOptions:
    """What is drawn, and where to.

    Attributes:
        output: The file; None: beside the report.
        iteration: Of a run folder, None for the one reported.
        style: What the picture is for.
        columns: Columns of a page that a figure for a paper is as wide as, 1 or 2.
        video: An animation of the map instead.
    """

    output: Path | None = None
    iteration: int | None = None
    style: PictureStyle = PictureStyle.SCREEN
    columns: int = 1
    video: bool = False


def picture_command(run_or_bag: str, options: PictureOptions, *, as_json: bool) -> int:
    """Draw a run into a file and return the exit code.

    Args:
        run_or_bag: What is drawn.
        options: How.
        as_json: Answer with a JSON document.

    Raises:
        UsageProblem: There is no such run or bag, the file name ends otherwise, or none is given
            for what has no run folder or is not what its report tells of.
        AuroraError: The bag cannot be read, or the file cannot be written.
    """
    endings = ('.gif',) if options.video else _ENDINGS[options.style]
    output = options.output
    if output is not None and output.suffix.lower() not in endings:
        known = ' or '.join(endings)
        raise UsageProblem(f'-o takes a name that ends with {known} here, found {output}')
    found = find_bag(run_or_bag, options.iteration)
    if output is None:
        if found.run is None or options.iteration is not None:
            raise UsageProblem('of a bag alone or of an iteration, say where to: -o FILE')
        if (found.run / SIGNED).exists():
            raise UsageProblem('the run is signed and stays as it is, say where to: -o FILE')
        if options.video or options.style is PictureStyle.PAPER:
            output = found.run / f'{"video" if options.video else "figure"}{endings[0]}'
        else:
            output = found.run / PICTURE
    with quiet_stdout():
        content, agsg = load_bag(found.bag)
        trace, world, spec = content.trace, content.world, agsg.spec
        caption = _caption(verify_found(installed(), found, content, agsg), found)
        lines = _draw(output, trace, world, caption, spec, options)
    if as_json:
        print_json({'bag': str(found.bag), 'picture': str(output), 'caption': list(lines)})
        return 0
    say(f'aurora: wrote {output}')
    for line in lines:
        say(f'  {line}')
    return 0


def _draw(
    output: Path,
    trace: Trace,
    world: WorldModel,
    caption: Caption,
    spec: ScenarioSpec,
    options: PictureOptions,
) -> tuple[str, ...]:
    """Write the picture and return the words that it leaves to its caption."""
    suffix = output.suffix.lower()
    if options.video:
        moments = told_moments(trace, world, tracks_of(trace), spec, caption)
        write_file(output, gif_bytes(trace, world, moments))
        return ()
    if options.style is PictureStyle.SCREEN:
        write_file(output, _WRITERS[suffix](draw_picture(trace, world, caption, spec=spec)))
        return ()
    figure = draw_paper(trace, world, caption, spec=spec, columns=options.columns)
    write_file(output, paper_bytes(figure, suffix))
    return moment_lines(trace, world, caption, spec)


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
