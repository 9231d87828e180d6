# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Write what a run leaves for people: report.json first, then the page; a picture when asked."""

from __future__ import annotations

from aurora_core.agsg.message import read_agsg
from aurora_core.errors import AuroraError
from aurora_core.judging.evaluation import Context
from aurora_core.outcomes.agsg import Agsg
from aurora_core.report.html import report_html
from aurora_core.report.run_folder import PICTURE, REPORT, REPORT_HTML, RunFolder
from aurora_core.report.run_report import RunReport
from aurora_core.report.scene.caption import Caption
from aurora_core.trace.bag_reader import BagContent, read_bag
from aurora_core.trace.definitions import message_definitions


def write_outputs(report: RunReport, folder: RunFolder) -> None:
    """Write `report.json` and `report.html`.

    Raises:
        ReportError: The folder cannot be written.
    """
    # First, since it closes the run; what follows can be made again from it and the bag.
    write_report(report, folder)
    write_page(report, folder)


def write_report(report: RunReport, folder: RunFolder) -> None:
    """Write `report.json` alone.

    Raises:
        ReportError: The folder cannot be written.
    """
    folder.write_json(REPORT, report)


def write_page(
    report: RunReport,
    folder: RunFolder,
    content: BagContent | None = None,
    context: Context | None = None,
    *,
    picture: bool = False,
) -> None:
    """Write `report.html`, and before it the picture of the run where one is wanted.

    Args:
        report: Of the run.
        folder: Of the run.
        content: Its bag, when somebody has read it already.
        context: In which that bag was judged, when somebody has.
        picture: Draw `picture.png`, too, and show it on the page; nothing where there is no bag.

    Raises:
        ReportError: The folder cannot be written.
        KeyboardInterrupt: The page was written without a picture, as it takes the most time.
    """
    drawn, shown = None, None
    try:
        content, agsg = _recorded(report, folder, content)
        if content is not None:
            # Imported here: a run that is refused has nothing to see.
            from aurora_core.report.page.recorded import recorded

            shown = recorded(report, content, agsg, context)
            if picture:
                drawn = _picture(report, content, agsg)
                folder.write_bytes(PICTURE, drawn)
    finally:
        folder.write_text(REPORT_HTML, report_html(report, drawn, shown))


def add_picture(report: RunReport, folder: RunFolder) -> None:
    """Write the picture and the page with it; what is there stays where no bag can be read.

    Raises:
        ReportError: The folder cannot be written.
    """
    content, _ = _recorded(report, folder, None)
    if content is not None:
        write_page(report, folder, content, picture=True)


def _recorded(
    report: RunReport, folder: RunFolder, content: BagContent | None
) -> tuple[BagContent | None, Agsg | None]:
    """Return the bag and the graph in it, None for what is not there or cannot be read."""
    if report.trace is None:
        return None, None
    try:
        if content is None:
            content = read_bag(folder.path / report.trace.bag, message_definitions())
        return content, None if content.agsg_message is None else read_agsg(content.agsg_message)
    except AuroraError:
        # A bag too damaged to read is told in the report; there is just nothing of it to see.
        return None, None


def _picture(report: RunReport, content: BagContent, agsg: Agsg | None) -> bytes:
    """Return the picture as PNG."""
    # Imported here: the drawing library takes longer to load than most runs do.
    from aurora_core.report.picture.draw import draw_picture, png_bytes

    spec = agsg.spec if agsg is not None else None
    figure = draw_picture(content.trace, content.world, Caption.of_report(report), spec=spec)
    return png_bytes(figure)
