# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`aurora campaign run FILE.yaml`: every run of a plan, resumed where it was left."""

from __future__ import annotations

import argparse
import sys
import tempfile
import time
from collections.abc import Callable, Sequence
from contextlib import closing
from datetime import timedelta
from pathlib import Path

from aurora_bench.campaign.plan import Plan, Task, files_of, read_plan, tasks_of
from aurora_bench.campaign.pooled import Answers, on_pool
from aurora_bench.campaign.record import CampaignRun, lost_run
from aurora_bench.campaign.results import Campaign, plan_values, write_campaign
from aurora_bench.campaign.runs import CampaignWork
from aurora_bench.machine import machine_facts
from aurora_bench.progress import Progress
from aurora_bench.resumable.code import code_digest, files_digest
from aurora_bench.resumable.files import PromptFile
from aurora_bench.resumable.journal import Journal, JournalHead
from aurora_cli.pool import Lost, Work
from aurora_core.document import canonical_json
from aurora_core.report.versions import product_versions

MakeWork = Callable[[Plan, Path], Work[Task, CampaignRun]]


def _campaign_work(plan: Plan, folder: Path) -> CampaignWork:
    return CampaignWork(plan=plan, folder=folder)


def run_campaign(options: argparse.Namespace, make_work: MakeWork = _campaign_work) -> int:
    """Run a plan to its end and write its files.

    Args:
        options: `file`, `out`, `jobs`, `dask`, `so_far`.
        make_work: How a task is done, of the plan and the folder of the runs.

    Returns:
        0; 1 when runs are quarantined.

    Raises:
        AuroraError: The plan, a prompt file, the journal or the workers are not in order.
        KeyboardInterrupt: By the user; what was done is in the journal.
    """
    plan = read_plan(options.file)
    files = files_of(plan)
    tasks = tasks_of(plan, files)
    machine = machine_facts()
    campaign = _empty(plan, files)
    head = JournalHead(
        campaign=f'campaign {plan.name}',
        files=campaign.files,
        options={
            # More seeds are more runs of the same campaign: the key of each run names its seed.
            'plan': canonical_json({k: v for k, v in campaign.plan.items() if k != 'seeds'}),
            'transcripts': canonical_json(campaign.transcripts),
            'code': campaign.code,
            **campaign.versions,
        },
    )
    path = options.out / f'{plan.name}.journal.jsonl'
    progress = Progress(f'campaign {plan.name}', len(tasks))
    with (
        Journal(path, head, resume=True) as journal,
        tempfile.TemporaryDirectory(prefix='aurora_campaign_', ignore_cleanup_errors=True) as name,
    ):
        runs, lost = _all(make_work(plan, Path(name)), tasks, plan, journal, options, progress)
        if not lost:
            journal.end()
    found = campaign.model_copy(
        update={
            'quarantined': dict(sorted(lost.items())),
            'runs': tuple(r.model_copy(update={'seconds': {}}) for r in runs),
        }
    )
    digest = write_campaign(options.out, found, runs, machine)
    for key, why in sorted(lost.items()):
        if not options.so_far:
            progress.note(f'quarantined {key}: {why}; the same command tries it again')
    sys.stdout.write(f'{len(runs)} runs  quarantined {len(lost)}  table sha256 {digest}\n')
    return int(bool(lost))


def _empty(plan: Plan, files: Sequence[PromptFile]) -> Campaign:
    """Return a campaign before its first run, with the digests of all that goes in."""
    return Campaign(
        plan=plan_values(plan),
        files={f.name: f.sha256 for f in files},
        code=code_digest(),
        versions=product_versions(),
        transcripts={
            r.name: files_digest(
                [
                    (p.relative_to(r.transcripts).as_posix(), p)
                    for p in r.transcripts.rglob('*')
                    if p.is_file()
                ]
            )
            for r in plan.readers
            if r.transcripts is not None
        },
        runs=(),
    )


def _all(
    work: Work[Task, CampaignRun],
    tasks: Sequence[Task],
    plan: Plan,
    journal: Journal,
    options: argparse.Namespace,
    progress: Progress,
) -> tuple[tuple[CampaignRun, ...], dict[str, str]]:
    """Return every run in the order of the plan, and why some are lost, by key."""
    done = {
        t.key: CampaignRun.model_validate(journal.finished[t.key])
        for t in tasks
        if t.key in journal.finished
    }
    lost: dict[str, str] = {}
    for task in tasks:
        if task.key in done:
            progress.step('from the journal')
    left = [t for t in tasks if t.key not in done]
    if options.so_far:
        lost = {t.key: 'not run yet' for t in left}
        return tuple(done[t.key] for t in tasks if t.key in done), lost
    limit_s = plan.limit_s
    answers: Answers[CampaignRun]
    if options.dask is None:
        answers = on_pool(work, left, jobs=options.jobs, limit_s=limit_s, note=progress.note)
    else:
        # Imported here: it takes a second that a campaign on the pool does not need.
        from aurora_bench.campaign.dask_workers import on_dask

        answers = on_dask(
            work,
            left,
            address=options.dask,
            jobs=options.jobs,
            limit_s=limit_s,
            note=progress.note,
        )
    begun_s = time.monotonic()
    with closing(answers):
        for number, (index, answer) in enumerate(answers, start=1):
            task = left[index]
            if isinstance(answer, Lost):
                lost[task.key] = answer.why
                done[task.key] = lost_run(task, answer.why)
            else:
                done[task.key] = answer
                journal.add(task.key, answer.model_dump(mode='json'))
            left_s = (time.monotonic() - begun_s) / number * (len(left) - number)
            # No verdicts here: some prompts are held out, and nobody is to look at single ones.
            progress.step(f'{task.configuration.value}; {timedelta(seconds=round(left_s))} left')
    return tuple(done[t.key] for t in tasks), lost
