# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`aurora graph`: the scenario graph of a run or a prompt, as picture or text, and its queries."""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from aurora_cli.bags import find_bag
from aurora_cli.files import write_file
from aurora_cli.installed import installed
from aurora_cli.output import (
    UsageProblem,
    answer_console,
    print_json,
    quiet_stdout,
    say,
)
from aurora_cli.prompt_input import prompt_bytes
from aurora_cli.requests import RunOptions, checked, with_prompt
from aurora_core.agsg.document import agsg_from_json
from aurora_core.agsg.export import TEXT_WRITERS
from aurora_core.agsg.influence import Influence, conditions_affected, parameters_affecting
from aurora_core.errors import PromptError, SpecError
from aurora_core.files import DOCUMENT_BYTES, read_bytes
from aurora_core.outcomes.agsg import Agsg
from aurora_core.outcomes.feasibility import Feasibility
from aurora_core.pipeline import functions
from aurora_core.pipeline.stages import RunRequest
from aurora_core.pipeline.verification import load_bag
from aurora_core.report.run_folder import StageFile, is_run_id
from aurora_core.report.status import Status, exit_code
from aurora_core.report.terminal import print_table

_PICTURES = ('.png', '.svg')
_FILE = re.compile(r'agsg\.(\d+)\.json')


@dataclass(frozen=True, slots=True, kw_only=True)
class GraphOptions:
    """Options of `aurora graph` as typed.

    Attributes:
        output: File to write.
        why: Condition or parameter to ask about.
        iteration: Repair iteration of a run; the last one when None.
        run: Seed and map of a prompt.
    """

    output: Path | None
    why: str | None
    iteration: int | None
    run: RunOptions


class _NotUnderstood(Exception):  # noqa: N818  (an outcome with an exit code)
    """There is no graph: why, and the status that says so."""

    def __init__(self, status: Status, text: str) -> None:
        super().__init__(text)
        self.status = status


def graph_command(run_or_prompt: str, options: GraphOptions, *, as_json: bool) -> int:
    """Write the graph, answer the query, and return the exit code.

    Raises:
        UsageProblem: Nothing is asked for, the file name ends in no known way, or there is no
            such run.
        AuroraError: The graph cannot be read, or the file cannot be written.
    """
    if options.output is None and options.why is None:
        raise UsageProblem('give a file to write (-o FILE) or something to ask about (--why ID)')
    endings = (*_PICTURES, *(f'.{name}' for name in TEXT_WRITERS))
    if options.output is not None and options.output.suffix.lower() not in endings:
        raise UsageProblem(f'-o takes {", ".join(endings)}, found {options.output}')
    try:
        with quiet_stdout():
            agsg = _graph(run_or_prompt, options)
            if options.output is not None:
                write_file(options.output, _content(agsg, options.output.suffix.lower()))
    except _NotUnderstood as err:
        say(f'aurora: {err}')
        if as_json:
            print_json({'status': err.status.value, 'why': str(err)})
        return int(exit_code(err.status))
    influences = () if options.why is None else _influences(agsg, options.why)
    if as_json:
        print_json(_facts(agsg, options, influences))
        return 0
    if options.output is not None:
        say(f'aurora: wrote {options.output}')
    if options.why is not None:
        _print_influences(options.why, influences)
    return 0


def _content(agsg: Agsg, ending: str) -> bytes:
    if ending not in _PICTURES:
        return TEXT_WRITERS[ending[1:]](agsg).encode('utf-8')
    # Imported here: a text needs no drawing library.
    from aurora_core.report.picture.draw import png_bytes, svg_bytes
    from aurora_core.report.picture.graph_picture import draw_graph

    figure = draw_graph(agsg)
    return svg_bytes(figure) if ending == '.svg' else png_bytes(figure)


def _graph(text: str, options: GraphOptions) -> Agsg:
    path = Path(text)
    try:
        if not path.exists() and is_run_id(text):
            path = Path('runs') / text
        there = path.exists()
    except OSError:  # a prompt is longer than any file name
        there = False
    if there:
        return _of_run(path, options.iteration)
    if is_run_id(text) or ('/' in text and ' ' not in text):
        raise UsageProblem(f'there is no run {text}')
    return _of_prompt(text, options.run)


def _of_run(path: Path, iteration: int | None) -> Agsg:
    numbers = sorted(int(m[1]) for f in path.glob('*') if (m := _FILE.fullmatch(f.name)))
    if path.is_file() and path.suffix == '.json':
        file = path
    elif numbers:
        wanted = numbers[-1] if iteration is None else iteration
        if wanted not in numbers:
            raise UsageProblem(f'{path} has no graph of iteration {wanted}')
        file = path / StageFile.AGSG.name_at(wanted)
    else:
        return load_bag(find_bag(str(path), iteration).bag)[1]
    try:
        return agsg_from_json(read_bytes(file, DOCUMENT_BYTES))
    except (OSError, ValueError) as err:
        raise SpecError(f'{file} holds no graph: {err}', hint='name another run') from err


def _of_prompt(text: str, options: RunOptions) -> Agsg:
    ready = with_prompt(checked(options), prompt_bytes(text, None))
    if isinstance(ready, PromptError):
        raise _NotUnderstood(Status.NOT_UNDERSTOOD, str(ready))
    return _grounded(ready)


def _grounded(request: RunRequest) -> Agsg:
    """Return the graph as far as the prompt comes: grounded, or only parsed."""
    known = installed()
    outcome = functions.parse_stage(known, request.prompt, request.map_name, request.seed)
    parsed = outcome.agsg
    if parsed is None:
        if outcome.refusals:
            words = '; '.join(refusal.sentence() for refusal in outcome.refusals)
            raise _NotUnderstood(Status.INFEASIBLE, words)
        raise _NotUnderstood(Status.NOT_UNDERSTOOD, outcome.question or 'no scenario was read')
    if functions.check_stage(known, parsed).result is Feasibility.INFEASIBLE:
        say('aurora: the request breaks a limit (see aurora check): the graph is not grounded')
        return parsed
    grounded = functions.ground_stage(known, parsed, request.seed).agsg
    if grounded is None:
        say('aurora: there is no place for it on the map: the graph is not grounded')
    return grounded or parsed


def _influences(agsg: Agsg, asked: str) -> tuple[Influence, ...]:
    if any(row.path == asked for row in agsg.parameters):
        return conditions_affected(agsg, asked)
    return parameters_affecting(agsg, asked)


def _facts(agsg: Agsg, options: GraphOptions, influences: tuple[Influence, ...]) -> dict[str, Any]:
    return {
        'graph': None if options.output is None else str(options.output),
        'stage': agsg.stage.value,
        'sha256': agsg.sha256,
        'nodes': len(agsg.nodes),
        'edges': len(agsg.edges),
        'parameters': len(agsg.parameters),
        'influences': [influence.model_dump(mode='json') for influence in influences],
    }


def _print_influences(asked: str, influences: tuple[Influence, ...]) -> None:
    print_table(
        f'What {asked} hangs together with, the nearest first',
        ('parameter', 'condition', 'distance', 'provenance', 'way'),
        [
            (
                influence.parameter,
                influence.condition,
                str(influence.distance),
                influence.provenance.value,
                ' > '.join(influence.way),
            )
            for influence in influences
        ],
        answer_console(),
    )
