# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`aurora verify`: recompute every margin from a bag alone."""

from __future__ import annotations

import re
from pathlib import Path

from aurora_cli.bags import find_bag
from aurora_cli.files import write_file
from aurora_cli.installed import installed
from aurora_cli.output import answer_console, print_json, quiet_stdout, say
from aurora_core.errors import AuroraError, ReportError
from aurora_core.monitor.signals_for_plot import signals_for_plot
from aurora_core.monitor.verify import context_of
from aurora_core.outcomes.agsg import Agsg
from aurora_core.outcomes.verdict import Verdict
from aurora_core.pipeline.verification import load_bag
from aurora_core.pipeline.verify_run import verify_found
from aurora_core.report.terminal import print_unjudged, print_verify
from aurora_core.trace.bag_reader import BagContent


def verify_command(
    run_or_bag: str,
    iteration: int | None,
    plots: Path | None,
    *,
    as_recorded: bool,
    as_json: bool,
    trusted: Path | None = None,
) -> int:
    """Verify a bag and return the exit code.

    Args:
        run_or_bag: What to verify.
        iteration: Repair iteration of a run.
        plots: Folder for a picture of each condition over time, None for none.
        as_recorded: Judge by the recorded version, limits, tolerances, settings and map, though
            they are others here.
        as_json: Print one JSON document.
        trusted: File of public keys by one of which the run has to be signed.

    Raises:
        UsageProblem: There is no such run or bag, or no such key.
        AuroraError: The bag holds nothing that could be judged.
    """
    found = find_bag(run_or_bag, iteration)
    verifier = None
    if trusted is not None:
        # Imported here: most verdicts need no key.
        from aurora_cli.signing import load_trusted

        verifier = load_trusted(trusted)
    try:
        with quiet_stdout():
            content, agsg = load_bag(found.bag)
            report = verify_found(
                installed(), found, content, agsg, as_recorded=as_recorded, trusted=verifier
            )
    except AuroraError as err:
        if not as_json:
            print_unjudged(found.bag, err, answer_console())
        raise
    if plots is not None:
        with quiet_stdout():
            _write_plots(content, agsg, report.verdict, plots)
    if as_json:
        print_json(report)
    else:
        print_verify(report, answer_console())
    return int(report.outcome.exit_code)


def _write_plots(content: BagContent, agsg: Agsg, verdict: Verdict, folder: Path) -> None:
    """Write `<number>_<condition>.png` and `.svg` for each condition that has samples.

    Raises:
        ReportError: The folder cannot be written.
    """
    # Imported here: a verdict alone needs no drawing library.
    from aurora_core.report.picture.condition_plot import draw_condition, flight_of
    from aurora_core.report.picture.draw import png_bytes, svg_bytes

    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as err:
        raise ReportError(
            f'{folder} cannot be created: {err.strerror or err}', hint='name another folder'
        ) from err
    spec = agsg.realised_spec
    signals = signals_for_plot(context_of(content.trace, content.world, agsg.conditions, spec))
    results = {result.id: result for result in verdict.results}
    bodies = {condition.id: condition.of for condition in agsg.conditions}
    for number, signal in enumerate(signals, start=1):
        say(f'aurora: plot {number} of {len(signals)}: {signal.condition_id}')
        flight = flight_of(content.trace, bodies[signal.condition_id])
        figure = draw_condition(signal, results[signal.condition_id], flight)
        # Ids out of a bag must not name another folder.
        name = f'{number:03}_{re.sub(r"[^A-Za-z0-9._-]", "_", signal.condition_id)}'
        write_file(folder / f'{name}.png', png_bytes(figure))
        write_file(folder / f'{name}.svg', svg_bytes(figure))
