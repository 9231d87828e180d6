# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`aurora map import`."""

from __future__ import annotations

import time
from pathlib import Path
from typing import Any

from aurora_cli.commands.maps import summary
from aurora_cli.map_import.importer import Imported, import_map, name_of
from aurora_cli.map_measure.measure import measure
from aurora_cli.output import UsageProblem, answer_console, print_json, quiet_stdout, say
from aurora_core.knowledge.map_folders import is_map_name
from aurora_core.knowledge.map_records import MapRecords
from aurora_core.report.map_gaps import map_gaps
from aurora_core.report.terminal import line


def import_command(
    file: Path, name: str | None, *, measured: bool = True, as_json: bool = False
) -> int:
    """Import a file, measure the map, and say what came of it.

    A map that cannot be measured stays, and can be used and measured later.

    Args:
        file: OSM extract, SUMO network or OpenDRIVE file.
        name: Of the map; None makes one of the file's.
        measured: Measure it, too.
        as_json: Print one JSON document.

    Raises:
        UsageProblem: There is no such file, or the name will not do.
        AuroraError: The file cannot become a map, or the map cannot be written.
    """
    if not file.exists():
        raise UsageProblem(f'there is no file {file}')
    wanted = name if name is not None else name_of(file)
    if not is_map_name(wanted):
        raise UsageProblem(
            f'a map cannot be named {wanted!r}: give a --name of small letters, digits, _ and -'
        )
    done = import_map(file, wanted, lambda step: say(f'aurora: {step}'))
    seconds = dict(done.seconds)
    records = None
    if measured:
        begin_s = time.monotonic()
        with quiet_stdout():
            records = measure(
                done.model, lambda step: say(f'aurora: measure: {step}'), again=False
            ).records
        seconds['measure'] = round(time.monotonic() - begin_s, 3)
    facts = {
        **_facts(done, records),
        'seconds': seconds,
        'measured': 'no' if records is None else 'yes',
    }
    if as_json:
        print_json(facts)
        return 0
    console = answer_console()
    model = done.model
    line(console, f'{model.name}: {facts["roads"]}, {len(model.buildings)} buildings, '
         f'{len(model.landmarks)} landmarks')  # fmt: skip
    line(console, f'digest {model.digest}')
    line(console, f'in {model.folder}')
    for gap in facts['gaps']:
        line(console, f'  {gap}')
    line(console, 'seconds: ' + ', '.join(f'{k} {v:.1f}' for k, v in seconds.items()))
    first = '' if records is not None else f'Measure it: aurora map measure {model.name}; '
    line(console, f'{first}Use it: --map {model.name}; more: aurora map show {model.name}')
    return 0


def _facts(done: Imported, records: MapRecords | None) -> dict[str, Any]:
    network = done.model.network
    lanes = network.driving_lanes('passenger')
    gaps = [gap.text for gap in map_gaps(done.model, records)]
    if done.is_guessed:
        gaps.append(
            'walkways and crossings: guessed by netconvert along streets that may have them'
        )
    if not done.is_placed:
        gaps.append('place on Earth: the file names none; the origin is a stand-in')
    return {
        **summary(done.model),
        'kind': done.kind.value,
        'folder': str(done.model.folder),
        'roads': f'{sum(lane.arc_length_m for lane in lanes) / 1000.0:.1f} km of lanes, '
        f'{len(network.street_names)} street names',
        'buildings': len(done.model.buildings),
        'landmarks': len(done.model.landmarks),
        'gaps': gaps,
    }
