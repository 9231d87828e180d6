# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Options of what helps a newcomer: `aurora --version`, `examples`, `new`, `open`."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from aurora_cli.finish import Json, finish

_Map = Annotated[str, typer.Option('--map', help='Map, see: aurora map list.')]


def add_help_commands(app: typer.Typer) -> None:
    """Add `--version` and the commands to the command line."""
    app.callback()(_options)
    app.command('examples')(examples)
    app.command('new')(new)
    app.command('open')(open_run)


def _version(wanted: bool) -> None:
    if not wanted:
        return
    from aurora_core.report.versions import product_versions

    first, *others = product_versions().items()
    typer.echo(f'{first[0]} {first[1]} (' + ', '.join(f'{k} {v}' for k, v in others) + ')')
    raise typer.Exit


def _options(
    version: Annotated[
        bool,
        typer.Option(
            '--version', help='Say which version this is.', callback=_version, is_eager=True
        ),
    ] = False,
) -> None:
    pass


def examples(
    number: Annotated[
        int | None, typer.Argument(metavar='[NUMBER]', help='Print this one alone.')
    ] = None,
    category: Annotated[
        str | None, typer.Option(metavar='NAME', help='Those of one category.')
    ] = None,
    as_json: Json = False,
) -> None:
    """List prompts that verify; `aurora examples 3 | aurora run -` runs the third."""

    def command() -> int:
        from aurora_cli.commands.examples import examples_command

        return examples_command(number, category, as_json=as_json)

    finish(command, as_json=as_json)


def new(
    output: Annotated[
        Path | None, typer.Option('-o', '--output', metavar='FILE', help='Write it there too.')
    ] = None,
    map_name: _Map = 'downtown',
) -> None:
    """Ask for the pieces of a scenario and write the prompt."""

    def command() -> int:
        from aurora_cli.commands.new import new_command

        return new_command(output, map_name)

    finish(command, as_json=False)


def open_run(
    run: Annotated[
        str | None,
        typer.Argument(metavar='[RUN]', help='Run folder or run id; default: the last.'),
    ] = None,
    runs: Annotated[Path, typer.Option(help='Folder of the run folders.')] = Path('runs'),
    as_json: Json = False,
) -> None:
    """Open the report of a run in a browser."""

    def command() -> int:
        from aurora_cli.commands.open_run import open_command

        return open_command(run, runs, as_json=as_json)

    finish(command, as_json=as_json)
