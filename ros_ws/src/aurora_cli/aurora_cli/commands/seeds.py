# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`aurora run --seeds N`: one prompt with several seeds; how robust is it?"""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from pathlib import Path

from aurora_cli.answers import Run, run_request
from aurora_cli.files import full_path
from aurora_cli.interrupts import Interrupts
from aurora_cli.output import UsageProblem, answer_console, print_json, quiet_stdout, say
from aurora_cli.progress import RunProgress
from aurora_cli.prompt_input import prompt_bytes
from aurora_cli.requests import RunOptions, beside_of, checked, with_prompt
from aurora_core.errors import PromptError
from aurora_core.pipeline.stages import RunControl, RunRequest
from aurora_core.report.run_report import ConditionReport
from aurora_core.report.share import Share
from aurora_core.report.status import ExitCode, Status, exit_code
from aurora_core.report.summary import margin_value
from aurora_core.report.terminal import line, print_table
from aurora_core.report.unfinished import close_unfinished
from aurora_core.spec.seed import check_seed

MOST = 10_000
# The first that applies is the exit code of all of them (contract: `--seeds N`).
_WORST_FIRST = (
    ExitCode.CANCELLED,
    ExitCode.BROKEN,
    ExitCode.VIOLATED,
    ExitCode.INFEASIBLE,
    ExitCode.NOT_DONE,
)


def seeds_command(
    argument: str | None,
    prompt_file: Path | None,
    options: RunOptions,
    count: int,
    *,
    quiet: bool,
    as_json: bool,
) -> int:
    """Run a prompt with `count` seeds from `options.seed` on, and return the exit code.

    Quiet: no progress and no table, the share that is verified alone.
    No page is made: `aurora open RUN` makes that of a run.

    Raises:
        UsageProblem: Options, prompt source or the number of seeds are wrong.
        AuroraError: A run folder cannot be written, or the graph cannot be reached.
    """
    first = checked(options)
    if not 1 <= count <= MOST:
        raise UsageProblem(f'--seeds takes 1 to {MOST}, found {count}')
    try:
        check_seed(options.seed + count - 1)
    except ValueError as err:
        raise UsageProblem(f'--seeds {count} from --seed {options.seed}: {err}') from err
    request = with_prompt(first, prompt_bytes(argument, prompt_file))
    if isinstance(request, PromptError):
        raise UsageProblem(f'--seeds needs a prompt that can be read: {request.message}')
    runs = _run_all(request, count, options, quiet=quiet)
    statuses = [run.status for run in runs]
    if as_json:
        print_json({'runs': [_row(run) for run in runs], **_summary(statuses, count)})
    else:
        _print(runs, count, quiet=quiet)
    return worst_exit_code(statuses, all_run=len(runs) == count)


def worst_exit_code(statuses: Sequence[Status], *, all_run: bool) -> int:
    """Return the exit code of several runs: the worst one, or that they were cut short."""
    codes = {exit_code(status) for status in statuses}
    if not all_run:
        codes.add(ExitCode.CANCELLED)
    return int(next((code for code in _WORST_FIRST if code in codes), ExitCode.OK))


def _run_all(request: RunRequest, count: int, options: RunOptions, *, quiet: bool) -> list[Run]:
    done: list[Run] = []
    root, jobs = full_path(options.out), options.elsewhere.jobs
    with quiet_stdout(), Interrupts() as interrupts, beside_of(options) as beside:
        for run_id in close_unfinished(root):
            say(f'aurora: closed the unfinished run {run_id} as error')
        for seed in range(request.seed, request.seed + count):
            one = request.model_copy(update={'seed': seed})
            with RunProgress(stages=False, quiet=quiet) as progress:
                control = RunControl(progress=progress.update, cancelled=interrupts.cancelled)
                run = run_request(one, root, control, _say, beside, jobs)
            done.append(run)
            if not quiet:
                said = run.status.value.replace('_', ' ').upper()
                say(f'aurora: seed {seed} ({len(done)} of {count}): {said}  {run.folder}')
            if interrupts.cancelled():
                break
    return done


def _say(text: str) -> None:
    say(f'aurora: {text}')


def _worst(run: Run) -> ConditionReport | None:
    """Return the condition of the prompt with the least normalised margin.

    One that is met to the dot (a count, an order) says nothing about robustness.
    """
    rows = [
        row
        for row in run.conditions
        if row.source and row.normalised is not None and not (row.satisfied and row.margin == 0.0)
    ]
    return min(rows, key=lambda row: (row.normalised or 0.0, row.id), default=None)


def _row(run: Run) -> dict[str, object]:
    worst = _worst(run)
    trace = run.trace
    return {
        'seed': run.report.seed,
        'status': run.status.value,
        'run_id': run.report.run_id,
        'folder': str(run.folder),
        'worst': None
        if worst is None
        else {'condition': worst.id, 'margin': worst.margin, 'unit': worst.unit},
        'motion_sha256': None if trace is None else trace.motion_sha256,
    }


def _summary(statuses: Sequence[Status], count: int) -> dict[str, object]:
    share = Share(met=statuses.count(Status.VERIFIED), total=len(statuses))
    return {
        'asked': count,
        'verified': share.met,
        'of': share.total,
        'pass_probability': share.value,
        'interval_95': share.interval,
    }


def _print(runs: Sequence[Run], count: int, *, quiet: bool) -> None:
    console = answer_console()
    share = Share(met=sum(run.status is Status.VERIFIED for run in runs), total=len(runs))
    low, high = share.interval
    others = Counter(run.status for run in runs if run.status is not Status.VERIFIED)
    rest = ''.join(
        f', {status.value.replace("_", " ")} {number}' for status, number in others.most_common()
    )
    line(
        console,
        f'verified {share.met} of {share.total} seeds  {share.value:.3f} [{low:.3f}, {high:.3f}]'
        f'{rest}' + (f'; {count - len(runs)} not run' if len(runs) < count else ''),
    )
    if quiet:
        return
    print_table(
        'Seeds',
        ('seed', 'verdict', 'least margin', 'of', 'run'),
        [
            (
                str(run.report.seed),
                run.status.value.replace('_', ' '),
                '' if (w := _worst(run)) is None else margin_value(w.margin, w.unit, w.reason),
                '' if w is None else w.sentence,
                run.folder.name,
            )
            for run in runs
        ],
        console,
        right=(0, 2),
        bad=[k for k, run in enumerate(runs) if run.status is Status.VIOLATED],
    )
