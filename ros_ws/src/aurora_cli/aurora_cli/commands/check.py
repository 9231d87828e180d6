# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`aurora check`: parse, ground and judge feasibility; nothing is simulated."""

from __future__ import annotations

from pathlib import Path

from aurora_cli.answers import check_facts
from aurora_cli.files import write_file
from aurora_cli.installed import installed
from aurora_cli.output import UsageProblem, answer_console, print_json, quiet_stdout, say
from aurora_cli.prompt_input import prompt_bytes
from aurora_cli.requests import RunOptions, checked, unreadable, with_prompt
from aurora_core.errors import PromptError
from aurora_core.grounding.sites import TriedSite
from aurora_core.outcomes.grounded import GroundedScenario
from aurora_core.report.check_report import build_check, check_exit_code
from aurora_core.report.terminal import print_check
from aurora_core.spec.scenario import ScenarioSpec

_ENDINGS = ('.png', '.svg')


def check_command(
    argument: str | None,
    prompt_file: Path | None,
    options: RunOptions,
    picture: Path | None,
    *,
    quiet: bool,
    as_json: bool,
) -> int:
    """Check a prompt, draw where it would happen, and return the exit code.

    Raises:
        UsageProblem: Options or prompt source are wrong, or the picture's name ends neither way.
    """
    if picture is not None and picture.suffix.lower() not in _ENDINGS:
        raise UsageProblem(f'--picture takes a name that ends with .png or .svg, found {picture}')
    request = checked(options)
    raw = prompt_bytes(argument, prompt_file)
    ready = with_prompt(request, raw)
    with quiet_stdout():
        if isinstance(ready, PromptError):
            facts = unreadable(request, raw, ready, '')
        else:
            facts = check_facts(ready)
        report = build_check(facts)
        graph = facts.graph
        grounded = graph.grounding if graph is not None else None
        if picture is not None and graph is not None and grounded:
            _draw(graph.spec, grounded, report.result.value, picture)
    if picture is not None and grounded is None:
        say('aurora: there is no place to draw')
    elif picture is not None:
        say(f'aurora: wrote {picture}')
    if as_json:
        print_json(report)
    else:
        print_check(report, answer_console(), brief=quiet)
    return int(check_exit_code(report.result))


def _draw(spec: ScenarioSpec, grounded: GroundedScenario, result: str, picture: Path) -> None:
    """Ground a request once more, for the sites that were looked at, and draw it."""
    # Drawing takes longer to load than a check without a picture takes.
    from aurora_core.report.picture.check_picture import draw_check
    from aurora_core.report.picture.draw import png_bytes, svg_bytes

    tried: list[TriedSite] = []
    installed().grounder(grounded.map_name).ground(spec, grounded.seed, tried=tried)
    model = installed().map(grounded.map_name)
    figure = draw_check(spec, grounded, model, tried, result)
    writer = png_bytes if picture.suffix.lower() == '.png' else svg_bytes
    write_file(picture, writer(figure))
