# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Options of `aurora export`, `bag standard` and `sign`: a run for others."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from aurora_cli.finish import Json, finish
from aurora_cli.output import UsageProblem

_RunOrBag = Annotated[str, typer.Argument(metavar='RUN_OR_BAG', help='Run folder, run id or bag.')]
_Iteration = Annotated[
    int | None, typer.Option(min=0, help='Repair iteration, from 0; default: the one reported.')
]
_FORMATS = 'csv, parquet, plan (QGroundControl), sumo or openscenario'


def add_export_commands(app: typer.Typer, bag: typer.Typer) -> None:
    """Add the commands to the command line and to its group of bags."""
    app.command('export')(export)
    bag.command('standard')(standard_bag)


def add_sign_command(app: typer.Typer) -> None:
    """Add the command to the command line."""
    app.command('sign')(sign)


def export(
    run_or_bag: _RunOrBag,
    form: Annotated[str, typer.Option('--to', metavar='FORMAT', help=f'One of {_FORMATS}.')],
    out: Annotated[
        Path | None,
        typer.Option('-o', '--out', metavar='FOLDER', help='Default: <bag>.FORMAT.'),
    ] = None,
    iteration: _Iteration = None,
    as_json: Json = False,
) -> None:
    """Write a run in a format that other programs read."""

    def command() -> int:
        from aurora_cli.commands.export import ExportFormat, export_command

        if form not in set(ExportFormat):
            raise UsageProblem(f'--to takes one of {_FORMATS}, found {form}')
        return export_command(run_or_bag, ExportFormat(form), out, iteration, as_json=as_json)

    finish(command, as_json=as_json)


def standard_bag(
    run_or_bag: _RunOrBag,
    out: Annotated[
        Path | None,
        typer.Option('-o', '--out', metavar='FOLDER', help='Default: <bag>.standard.'),
    ] = None,
    iteration: _Iteration = None,
    as_json: Json = False,
) -> None:
    """Write a run as a bag of standard topics, for Foxglove, RViz and other tools."""

    def command() -> int:
        from aurora_cli.commands.standard_bag import standard_command

        return standard_command(run_or_bag, out, iteration, as_json=as_json)

    finish(command, as_json=as_json)


def sign(
    run: Annotated[str, typer.Argument(metavar='RUN', help='Run folder or run id.')],
    key: Annotated[
        Path, typer.Option(metavar='FILE', help='Ed25519 private key (OpenSSH or PEM).')
    ],
    new_key: Annotated[
        bool, typer.Option('--new-key', help='Make FILE and FILE.pub first.')
    ] = False,
    runs: Annotated[Path, typer.Option(help='Folder of the run folders.')] = Path('runs'),
    as_json: Json = False,
) -> None:
    """Sign every file of a run; aurora verify --trusted finds any change."""

    def command() -> int:
        from aurora_cli.commands.sign import sign_command

        return sign_command(run, key, runs, new_key=new_key, as_json=as_json)

    finish(command, as_json=as_json)
