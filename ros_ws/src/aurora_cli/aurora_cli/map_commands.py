# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Options of `aurora map`. What a command does is imported when it is called."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from aurora_cli.finish import Json, finish

maps = typer.Typer(help='Maps: bundled ones and your own.', rich_markup_mode=None)


@maps.command('list')
def list_maps(as_json: Json = False) -> None:
    """List the maps, bundled ones and your own."""

    def command() -> int:
        from aurora_cli.commands.maps import list_command

        return list_command(as_json=as_json)

    finish(command, as_json=as_json)


@maps.command('show')
def show_map(
    name: Annotated[str, typer.Argument(help='Name of the map.')],
    picture: Annotated[
        Path | None, typer.Option(metavar='FILE', help='Draw it into a PNG or SVG file.')
    ] = None,
    as_json: Json = False,
) -> None:
    """Show what a map has."""

    def command() -> int:
        from aurora_cli.commands.maps import show_command

        return show_command(name, picture, as_json=as_json)

    finish(command, as_json=as_json)


@maps.command('import')
def import_map(
    file: Annotated[
        Path, typer.Argument(help='OpenStreetMap extract, SUMO network or OpenDRIVE file.')
    ],
    name: Annotated[
        str | None, typer.Option(help='Name of the map; default: made of the name of the file.')
    ] = None,
    measured: Annotated[
        bool, typer.Option('--measure/--no-measure', help='Try the map out in the simulators.')
    ] = True,
    as_json: Json = False,
) -> None:
    """Make a map of a file, for --map, and measure it; it goes into your own folder of maps."""

    def command() -> int:
        from aurora_cli.commands.map_import import import_command

        return import_command(file, name, measured=measured, as_json=as_json)

    finish(command, as_json=as_json)


@maps.command('doctor')
def examine_map(
    name: Annotated[str, typer.Argument(help='Name of the map.')], as_json: Json = False
) -> None:
    """Say which requests a map cannot serve, and why."""

    def command() -> int:
        from aurora_cli.commands.map_doctor import map_doctor_command

        return map_doctor_command(name, as_json=as_json)

    finish(command, as_json=as_json)


@maps.command('measure')
def measure_map(
    name: Annotated[str, typer.Argument(help='Name of the map.')], as_json: Json = False
) -> None:
    """Measure a map and the vehicle models in the simulators; minutes at most."""

    def command() -> int:
        from aurora_cli.commands.map_measure import map_measure_command

        return map_measure_command(name, as_json=as_json)

    finish(command, as_json=as_json)
