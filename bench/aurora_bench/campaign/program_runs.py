# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What a worker does with a task of B1 to B3: a program is written, run contained, and checked.

The paper calls such a run completed and unverifiable. The independent checker needs no
specification: it judges what was recorded by the annotation alone.
"""

from __future__ import annotations

import shutil
import time
from pathlib import Path
from typing import Any

from aurora_bench.campaign.plan import Plan, Task
from aurora_bench.campaign.record import CampaignRun, Ending, identity
from aurora_bench.campaign.written import write_program
from aurora_bench.prompts.format import RejectRequirement, flat
from aurora_bench.rulers.checking import Check, Said, asked_of
from aurora_bench.rulers.trial import Cause
from aurora_bench.sandbox.process import chosen_way
from aurora_bench.sandbox.program import ProgramRun, run_program
from aurora_cli.installed import installed
from aurora_core.errors import AuroraError
from aurora_core.pipeline.stages import RunRequest

UNVERIFIABLE = 'completed_unverifiable'


def check_containment() -> None:
    """Find out how programs are contained here, before the first one is written.

    Raises:
        SandboxError: They are not.
    """
    chosen_way()


def program_run(plan: Plan, task: Task, folder: Path, check: Check) -> CampaignRun:
    """Write, run and check one program; its folder goes, whatever happens.

    Args:
        plan: Of the campaign.
        task: What is run.
        folder: The run goes below it.
        check: The checker.

    Raises:
        ConfigError: The model cannot be used, or its reply is not recorded.
        SandboxError: Nothing contains a program.
    """
    seconds: dict[str, float] = {}
    begin, cpu_begin = time.perf_counter(), time.process_time()
    place = folder / task.trial.folder
    shutil.rmtree(place, ignore_errors=True)
    try:
        values = _values(plan, task, place, check, seconds)
    finally:
        shutil.rmtree(place, ignore_errors=True)
    seconds['all'] = time.perf_counter() - begin
    seconds['processor'] = time.process_time() - cpu_begin
    return CampaignRun(**identity(task), **values, seconds=seconds)


def _values(
    plan: Plan, task: Task, place: Path, check: Check, seconds: dict[str, float]
) -> dict[str, Any]:
    request = RunRequest(
        prompt=task.trial.prompt.prompt,
        seed=task.trial.seed,
        map_name=plan.map,
        model=task.reader.model,
        transcripts=task.reader.transcripts,
        history_frozen=True,
    )
    known = installed()
    begin = time.perf_counter()
    written = write_program(task.configuration, known, request)
    seconds['parse'] = time.perf_counter() - begin
    if not written.program:
        return _failed(written.why)
    begin, bag = time.perf_counter(), place / 'bag.0'
    try:
        ran = run_program(
            written.program, known=known, map_name=plan.map, seed=task.trial.seed, bag=bag
        )
    except AuroraError as err:
        return _failed(err.component)
    finally:
        seconds['execute'] = time.perf_counter() - begin
    begin = time.perf_counter()
    values = _judged(task, ran, bag, check)
    seconds['checker'] = time.perf_counter() - begin
    return values


def _judged(task: Task, ran: ProgramRun, bag: Path, check: Check) -> dict[str, Any]:
    prompt = task.trial.prompt
    recorded = {
        'simulations': int(ran.begun),
        'simulated_s': ran.simulated_s if ran.begun else None,
        'trace_sha256': ran.trace_sha256,
        'motion_sha256': ran.motion_sha256,
    }
    wanted = {r.because for r in flat(prompt.requirements) if isinstance(r, RejectRequirement)}
    if ran.refused:
        right = ran.refused in wanted
        cause = None if right else Cause.OTHER_REASON if wanted else Cause.GROUNDING
        return {
            'status': 'infeasible', 'ending': Ending.DECLINED, 'why': f'refused: {ran.refused}',
            'right': right, 'cause': cause, **recorded,
        }  # fmt: skip
    if not ran.completed:
        return {**_failed(_why(ran)), **recorded}
    found = {'status': UNVERIFIABLE, 'ending': Ending.COMPLETED, **recorded}
    if wanted:
        return {**found, 'cause': Cause.NOT_REFUSED}
    said = _said(check, bag, task)
    wrong = any(s.outcome == 'does_not' for s in said)
    broken = any(s.kind == 'checker' for s in said)
    cause = Cause.CONTRADICTED if wrong else Cause.ERROR if broken else None
    return {**found, 'said': said, 'right': cause is None, 'cause': cause}


def _said(check: Check, bag: Path, task: Task) -> tuple[Said, ...]:
    try:
        return asked_of(check, bag, task.trial.document)
    except Exception as err:  # noqa: BLE001  (a checker that breaks must not end the campaign)
        why = f'{type(err).__name__}: {err}'
        return (Said(requirement='', kind='checker', outcome='cannot_tell', why=why),)


def _why(ran: ProgramRun) -> str:
    """Return how a program ended in few words: of an exception its name."""
    if ran.end.value == 'finished':
        return 'program: nothing simulated'
    last = ran.told.strip().splitlines()[-1:] or ['']
    name = last[0].partition(':')[0].rpartition('.')[2].strip()
    return f'program: {ran.end.value}' + (f', {name}' if name.isidentifier() else '')


def _failed(why: str) -> dict[str, Any]:
    return {'status': 'error', 'ending': Ending.FAILED, 'why': why, 'cause': Cause.ERROR}
