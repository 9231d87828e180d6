# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Turn what was typed into a request that the pipeline takes."""

from __future__ import annotations

from contextlib import AbstractContextManager, nullcontext
from dataclasses import dataclass
from pathlib import Path
from typing import cast

from pydantic import ValidationError

from aurora_cli.beside.chosen import HERE, Elsewhere, chosen
from aurora_cli.files import full_path
from aurora_cli.output import UsageProblem
from aurora_core.errors import ConfigError, PromptError
from aurora_core.execution.faults import Fault
from aurora_core.knowledge.map_folders import list_maps
from aurora_core.outcomes.parse import ParseOutcome
from aurora_core.parsing.text import check_prompt_text
from aurora_core.pipeline.beside import Beside
from aurora_core.pipeline.stages import RunRequest
from aurora_core.ports.model_name import RECORDED, without_secrets
from aurora_core.report.facts import RunFacts
from aurora_core.report.versions import product_versions
from aurora_core.spec.seed import check_seed
from aurora_llm.parse import check_model_name


@dataclass(frozen=True, slots=True, kw_only=True)
class RunOptions:
    """Options of `aurora run` and `aurora check` as typed."""

    engine: str = 'local'
    model: str = 'offline'
    history: Path | None = None
    freeze_history: bool = False
    transcripts: Path | None = None
    seed: int = 1
    map_name: str = 'downtown'
    out: Path = Path('runs')
    allow_relax: bool = False
    repair: int | None = None
    faults: tuple[str, ...] = ()
    elsewhere: Elsewhere = HERE
    autopilot: str = ''


def beside_of(options: RunOptions) -> AbstractContextManager[Beside | None]:
    """Give who executes candidates beside this process; a graph has processes of its own."""
    return nullcontext() if options.engine == 'ros' else chosen(options.elsewhere)


def checked(options: RunOptions) -> RunRequest:
    """Return the request without its prompt.

    Raises:
        UsageProblem: An option names something that is not there.
    """
    try:
        check_model_name(options.model)
    except ConfigError as err:
        raise UsageProblem(f'--model {without_secrets(options.model)}: {err}') from err
    if options.transcripts is not None and not options.transcripts.is_dir():
        raise UsageProblem(f'--transcripts: there is no folder {options.transcripts}')
    if options.engine not in ('local', 'ros'):
        raise UsageProblem(f'--engine is local or ros, found {options.engine}')
    if options.engine == 'ros' and options.elsewhere.dask is not None:
        raise UsageProblem(
            '--dask is for the local engine: that of a graph is a parameter of its orchestrator'
        )
    if options.autopilot and options.engine != 'local':
        raise UsageProblem('--autopilot is for the local engine: leave --engine out')
    if options.autopilot and options.elsewhere != HERE:
        raise UsageProblem('--autopilot flies one run at a time: leave --jobs and --dask out')
    try:
        check_seed(options.seed)
    except ValueError as err:
        raise UsageProblem(f'--seed {options.seed}: {err}') from err
    known = list_maps()
    if options.map_name not in known:
        raise UsageProblem(f'there is no map {options.map_name}; there are {", ".join(known)}')
    return RunRequest.model_validate(
        {
            'prompt': '',
            'map_name': options.map_name,
            'seed': options.seed,
            'engine': options.engine,
            'model': _absolute(options.model),
            'history': _absolute_folder(options.history),
            'history_frozen': options.freeze_history,
            'transcripts': _absolute_folder(options.transcripts),
            'allow_relax': options.allow_relax,
            # Each realisation is flown in real time: only as many as are asked for.
            'repair': 0 if options.autopilot and options.repair is None else options.repair,
            'autopilot': options.autopilot,
            'faults': tuple(fault(text) for text in options.faults),
        }
    )


def _absolute(model: str) -> str:
    """Name a recording by its full path: the graph was started in another folder."""
    if not model.startswith(RECORDED):
        return model
    return f'{RECORDED}{full_path(Path(model.removeprefix(RECORDED)))}'


def _absolute_folder(folder: Path | None) -> Path | None:
    return full_path(folder) if folder is not None else None


def fault(text: str) -> Fault:
    """Return the fault of a `--fault` option.

    Raises:
        UsageProblem: The text is not the JSON of one.
    """
    try:
        return Fault.model_validate_json(text)
    except ValidationError as err:
        first = err.errors()[0]
        where = '.'.join(str(part) for part in first['loc'])
        raise UsageProblem(
            f'--fault takes JSON such as {{"kind": "link_loss", "subject": "*", "value": 1.0}}; '
            f'{where + ": " if where else ""}{first["msg"]}'
        ) from err


def with_prompt(request: RunRequest, raw: bytes) -> RunRequest | PromptError:
    """Return the request with its prompt, or why the bytes cannot be one."""
    try:
        prompt = check_prompt_text(raw)
    except PromptError as err:
        return err
    return RunRequest.model_validate({**request.model_dump(), 'prompt': prompt})


def unreadable(request: RunRequest, raw: bytes, err: PromptError, run_id: str) -> RunFacts:
    """Return the facts of a run whose prompt cannot be read: a question, no traceback."""
    question = f'What is to be simulated? {err.message[:1].upper()}{err.message[1:]}'
    if err.hint:
        question += f'; {err.hint}'
    return RunFacts(
        run_id=run_id,
        prompt=_legible(raw),
        engine=cast(str, request.engine),
        model=request.model,
        map_name=request.map_name,
        seed=request.seed,
        versions=product_versions(),
        faults=request.faults,
        parse=ParseOutcome(question=question),
    )


def _legible(raw: bytes) -> str:
    r"""Return a prompt that cannot be read as text that can: every unreadable byte as `\xNN`.

    `prompt.txt` holds the bytes. A NUL would cut the text where ROS carries it.
    """
    return raw.decode('utf-8', 'backslashreplace').replace('\x00', r'\x00')
