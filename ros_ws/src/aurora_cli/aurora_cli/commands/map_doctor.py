# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`aurora map doctor`: which requests a map cannot serve; 0 when none, else 1."""

from __future__ import annotations

from aurora_cli.commands.maps import known_map, measured_on
from aurora_cli.output import answer_console, print_json
from aurora_core.report.map_gaps import MapGap, map_gaps
from aurora_core.report.terminal import line


def map_doctor_command(name: str, *, as_json: bool) -> int:
    """Say what a map lacks, and for which requests.

    Raises:
        UsageProblem: There is no such map.
        AuroraError: The map is damaged.
    """
    model = known_map(name)
    found = measured_on(model)
    gaps = map_gaps(model, None if isinstance(found, str) else found.records)
    if isinstance(found, str):
        gaps += (MapGap(f'measured: {found}', 'vehicles are placed where none was tried before'),)
    if as_json:
        print_json(
            {
                'name': model.name,
                'digest': model.digest,
                'gaps': [{'lacks': gap.lacks, 'means': gap.means} for gap in gaps],
            }
        )
        return int(bool(gaps))
    console = answer_console()
    for gap in gaps:
        line(console, f'{model.name}: {gap.text}')
    if not gaps:
        line(console, f'{model.name}: lacks nothing that requests need')
    return int(bool(gaps))
