# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`aurora map measure`: what a map and the vehicles do in the simulators, for the records."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from aurora_cli.commands.maps import known_map
from aurora_cli.map_measure.measure import Measured, measure
from aurora_cli.output import answer_console, print_json, quiet_stdout, say
from aurora_core.knowledge.map_records import Failure
from aurora_core.report.terminal import line


def map_measure_command(name: str, *, as_json: bool) -> int:
    """Measure a map and the vehicle models, and say what came of it.

    Raises:
        UsageProblem: There is no such map.
        AuroraError: The map is damaged, a simulator fails, or the records cannot be written.
    """
    model = known_map(name)
    with quiet_stdout():
        done = measure(model, lambda step: say(f'aurora: {step}'))
    if as_json:
        print_json(_facts(done))
        return 0
    console = answer_console()
    for text in _lines(done):
        line(console, text)
    return 0


def _facts(done: Measured) -> dict[str, Any]:
    return {
        'name': done.model.name,
        'digest': done.model.digest,
        'records': done.records.model_dump(mode='json'),
        'types': [record.model_dump(mode='json') for record in done.types],
        'multirotor': done.multirotor.model_dump(mode='json'),
        'lower_limits': list(done.lower_limits),
        'files': [str(path) for path in done.files],
        'seconds': {step: round(value, 2) for step, value in done.seconds.items()},
    }


def _lines(done: Measured) -> Iterator[str]:
    records, uav = done.records, done.multirotor
    yield f'{done.model.name}: {records.samples} lane samples'
    for row in records.spawns:
        yield f'  {row.type_name} stands at {row.stands} of {row.tried}'
        yield from _failures(row.failures)
    for what, walk in (('sidewalks', records.sidewalks), ('crossings', records.crossings)):
        yield f'  {what}: {walk.walked} of {walk.tried} walked'
        yield from _failures(walk.failures)
    for part in records.parts:
        yield (
            f'  {part.vehicle_class}: {part.largest_share:.1%} of {part.length_km:.1f} km hang '
            'together'
        )
    yield f'vehicles: {len(done.types)} types driven'
    yield (
        f'multirotor: {uav.speed_mps:.1f} m/s, climb {uav.climb_mps:.1f} m/s, descent '
        f'{uav.descent_mps:.1f} m/s, hover for {uav.hover_s / 60.0:.1f} min'
    )
    shortest = min(uav.endurances, key=lambda row: row.endurance_s)
    yield (
        f'  its battery lasts {shortest.endurance_s / 60.0:.1f} min at {shortest.speed_mps:g} m/s '
        f'in a wind of {shortest.mean_mps:g} m/s; messages reach {uav.reach_sight_m:g} m, past a '
        f'wall {uav.reach_blocked_m:g} m'
    )
    yield from (f'  {text}' for text in done.lower_limits)
    for path in done.files:
        yield f'wrote {path}'
    yield 'seconds: ' + ', '.join(f'{k} {v:.1f}' for k, v in done.seconds.items())


def _failures(failures: tuple[Failure, ...]) -> Iterator[str]:
    for failure in failures:
        yield f'    not {failure.place}: {failure.why}'
