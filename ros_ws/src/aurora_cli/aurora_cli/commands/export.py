# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`aurora export`: a recorded run in the formats of other programs."""

from __future__ import annotations

import shutil
import tempfile
from collections.abc import Callable
from dataclasses import dataclass
from datetime import UTC, datetime
from enum import StrEnum
from json import dumps
from pathlib import Path

from aurora_cli.bags import find_bag
from aurora_cli.files import write_file
from aurora_cli.output import UsageProblem, print_json, quiet_stdout, say
from aurora_core.errors import ReportError
from aurora_core.knowledge.map_model import MapModel, load_map
from aurora_core.outcomes.agsg import Agsg
from aurora_core.outcomes.grounded import GroundedScenario
from aurora_core.pipeline.verification import load_bag
from aurora_core.report.export.tables import Table
from aurora_core.report.find_bag import FoundBag
from aurora_core.report.run_folder import is_run_id
from aurora_core.trace.bag_content import BagContent


class ExportFormat(StrEnum):
    """What can be written."""

    CSV = 'csv'
    PARQUET = 'parquet'
    PLAN = 'plan'
    SUMO = 'sumo'
    OPENSCENARIO = 'openscenario'


_UNITS = 'the unit ends the name of a column; ENU map frame, metres above ground'


@dataclass(frozen=True, slots=True, kw_only=True)
class _Given:
    """What an export is made of, and the folder that it goes to."""

    found: FoundBag
    content: BagContent
    agsg: Agsg
    folder: Path


def export_command(
    run_or_bag: str, form: ExportFormat, out: Path | None, iteration: int | None, *, as_json: bool
) -> int:
    """Write the files into a new folder and return the exit code.

    Args:
        run_or_bag: What is exported.
        form: As what.
        out: Folder to create; None: beside the bag.
        iteration: Of a run folder, None for the one reported.
        as_json: Answer with a JSON document.

    Raises:
        UsageProblem: There is no such run or bag, or the folder exists.
        AuroraError: The bag cannot be read, its map is not installed, or nothing can be written.
    """
    found = find_bag(run_or_bag, iteration)
    folder = out if out is not None else found.bag.with_name(f'{found.bag.name}.{form}')
    if folder.exists():
        raise UsageProblem(f'{folder} exists: name another folder with -o')
    with quiet_stdout():
        content, agsg = load_bag(found.bag)
        try:
            folder.mkdir(parents=True)
        except OSError as err:
            raise ReportError(
                f'{folder} cannot be created: {err.strerror or err}', hint='name another folder'
            ) from err
        try:
            notes = _WRITERS[form](_Given(found=found, content=content, agsg=agsg, folder=folder))
        except BaseException:
            # Half an export is none.
            shutil.rmtree(folder, ignore_errors=True)
            raise
    files = sorted(path.name for path in folder.iterdir())
    if as_json:
        document = {'bag': str(found.bag), 'format': form.value, 'folder': str(folder)}
        print_json({'schema_version': 1, **document, 'files': files, 'notes': notes})
        return 0
    say(f'aurora: wrote {folder}: {", ".join(files)}')
    for note in notes:
        say(f'        {note}')
    return 0


def _tables(given: _Given) -> tuple[Table, ...]:
    # Imported here: other formats judge nothing.
    from aurora_core.monitor.signals_for_plot import signals_for_plot
    from aurora_core.monitor.verify import context_of
    from aurora_core.report.export.tables import tables_of

    trace, agsg = given.content.trace, given.agsg
    context = context_of(trace, given.content.world, agsg.conditions, agsg.realised_spec)
    return tables_of(trace, signals_for_plot(context))


def _write_csv(given: _Given) -> list[str]:
    from aurora_core.report.export.tables import csv_text

    for table in _tables(given):
        write_file(given.folder / f'{table.name}.csv', csv_text(table).encode())
    return [_UNITS]


def _write_parquet(given: _Given) -> list[str]:
    """Write the tables as CSV, and these as Parquet, with the types of their columns."""
    import duckdb

    from aurora_core.report.export.tables import csv_text

    # One thread: rows keep their order, and equal rows give equal bytes.
    with tempfile.TemporaryDirectory() as place, duckdb.connect(config={'threads': 1}) as base:
        for table in _tables(given):
            source = Path(place) / f'{table.name}.csv'
            source.write_bytes(csv_text(table).encode())
            types = {n: 'VARCHAR' if n in table.texts else 'DOUBLE' for n in table.columns}
            goal = given.folder / f'{table.name}.parquet'
            try:
                rows = base.read_csv(str(source), header=True, columns=types)
                rows.write_parquet(str(goal), compression='zstd')
            except duckdb.Error as err:
                raise ReportError(
                    f'{goal} cannot be written: {err}', hint='make room, or name another folder'
                ) from err
    return [_UNITS]


def _write_plans(given: _Given) -> list[str]:
    from aurora_core.report.export.flight_plan import flight_plan

    trace, world = given.content.trace, given.content.world
    notes = []
    for row, entry in enumerate(trace.roster.uavs):
        try:
            plan = flight_plan(trace, world, row)
        except ReportError as err:
            notes.append(err.message)
            continue
        text = dumps(plan, indent=2, allow_nan=False)
        write_file(given.folder / f'{entry.body_id}.plan', f'{text}\n'.encode())
    if len(notes) == len(trace.roster.uavs):
        raise ReportError('nobody flies in this run', hint='a plan is of a flight')
    return [*notes, 'waypoints of the flight as it was flown; altitudes above home']


def _write_sumo(given: _Given) -> list[str]:
    from aurora_core.knowledge.measured_on import vtypes_path
    from aurora_core.report.export.sumo_folder import (
        CONFIGURATION,
        RECORDED,
        ROUTES,
        configuration_text,
        recorded_text,
        routes_text,
    )

    trace, grounded = given.content.trace, _grounding(given)
    model = _map(given)
    vtypes = vtypes_path().read_bytes()
    routes = routes_text(trace, grounded.agents, model.network, vtypes)
    net = f'{model.name}.net.xml.gz'
    configuration = configuration_text(
        net=net,
        dt_s=trace.roster.dt_s,
        seed=grounded.seed,
        end_s=trace.time_s(max(trace.ticks - 1, 0)),
    )
    write_file(given.folder / net, model.net_path.read_bytes())
    write_file(given.folder / ROUTES, routes.encode())
    write_file(given.folder / CONFIGURATION, configuration.encode())
    write_file(given.folder / RECORDED, recorded_text(trace).encode())
    return [
        f'sumo -c {given.folder / CONFIGURATION} drives from the same places on the same routes, '
        'without the commands of the executor',
        f'{RECORDED} is the motion as it was recorded',
    ]


def _write_openscenario(given: _Given) -> list[str]:
    from aurora_cli.map_import.netconvert import write_opendrive
    from aurora_core.report.export.open_scenario import open_scenario

    model = _map(given)
    run = given.found.run
    name = run.name if run is not None else given.found.bag.name
    roads = f'{model.name}.xodr'
    text = open_scenario(
        given.content.trace,
        name=name,
        prompt=given.agsg.spec.prompt,
        date=_date(name),
        road_file=roads,
    )
    write_opendrive(model.net_path, given.folder / roads)
    write_file(given.folder / 'scenario.xosc', text.encode())
    return ['everybody follows the recorded trajectory in time; coordinates are those of the map']


def _date(name: str) -> str:
    """Return when a run began, from its id; a bag alone does not tell."""
    if not is_run_id(name):
        return '1970-01-01T00:00:00Z'
    begun = datetime.strptime(name.partition('-')[0], '%Y%m%dT%H%M%SZ')
    return begun.replace(tzinfo=UTC).isoformat(timespec='seconds').replace('+00:00', 'Z')


def _grounding(given: _Given) -> GroundedScenario:
    if given.agsg.grounding is None:
        raise ReportError('the recording holds no grounding', hint='run the scenario again')
    return given.agsg.grounding


def _map(given: _Given) -> MapModel:
    """Return the map of a run.

    Raises:
        AuroraError: It is not installed, or another one of its name is.
    """
    world = given.content.world
    model = load_map(world.map_name)
    if model.digest != world.map_digest:
        raise ReportError(
            f'the map {world.map_name} that is installed is another one than the run had',
            hint='install the map of the run',
        )
    return model


_WRITERS: dict[ExportFormat, Callable[[_Given], list[str]]] = {
    ExportFormat.CSV: _write_csv,
    ExportFormat.PARQUET: _write_parquet,
    ExportFormat.PLAN: _write_plans,
    ExportFormat.SUMO: _write_sumo,
    ExportFormat.OPENSCENARIO: _write_openscenario,
}
