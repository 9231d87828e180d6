# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`aurora map list` and `aurora map show`."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from aurora_cli.files import write_file
from aurora_cli.output import UsageProblem, answer_console, print_json, quiet_stdout, say
from aurora_core.errors import ConfigError, MapError
from aurora_core.knowledge.map_folders import bundled_maps, list_maps, own_maps
from aurora_core.knowledge.map_model import MapModel, load_map
from aurora_core.knowledge.map_records import MeasuredMap
from aurora_core.pipeline.knowledge import installed_knowledge
from aurora_core.report.lane_facts import along_lanes, hidden_at_corners, seen_from_air
from aurora_core.report.terminal import line, print_table

# A longer list has a line for each.
_IN_ONE_LINE = 8


def list_command(*, as_json: bool) -> int:
    """List the maps, bundled ones and own ones; an own one that is damaged is said to be.

    Raises:
        AuroraError: A bundled map is damaged.
    """
    maps = [{**summary(load_map(name)), 'own': False} for name in bundled_maps()]
    for name in own_maps():
        try:
            maps.append({**summary(load_map(name)), 'own': True})
        except MapError as err:
            say(f'aurora: map: {err}')
    maps.sort(key=lambda entry: str(entry['name']))
    if as_json:
        print_json({'maps': maps})
        return 0
    print_table(
        'Maps',
        ('name', 'whose', 'size', 'licence', 'what it shows'),
        [
            (
                entry['name'],
                'own' if entry['own'] else 'bundled',
                f'{entry["width_m"]:.0f} m x {entry["height_m"]:.0f} m',
                entry['licence'],
                entry['description'],
            )
            for entry in maps
        ],
        answer_console(),
    )
    return 0


def known_map(name: str) -> MapModel:
    """Return a map that the user named.

    Raises:
        UsageProblem: There is no such map.
        MapError: It is damaged.
    """
    known = list_maps()
    if name not in known:
        raise UsageProblem(f'there is no map {name}; there are {", ".join(known)}')
    return load_map(name)


def measured_on(model: MapModel) -> MeasuredMap | str:
    """Return the records of a map, or in words why there are none to use."""
    try:
        found = installed_knowledge().measured(model.name)
    except ConfigError as err:
        return f'no longer: {err}'
    return found or f'no (aurora map measure {model.name})'


def show_command(name: str, picture: Path | None, *, as_json: bool) -> int:
    """Show what a map has, and draw it when asked.

    Raises:
        UsageProblem: There is no such map, or the picture's name ends neither way.
        AuroraError: The map is damaged, or the picture cannot be written.
    """
    if picture is not None and picture.suffix.lower() not in ('.png', '.svg'):
        raise UsageProblem(f'--picture takes a name that ends with .png or .svg, found {picture}')
    model = known_map(name)
    facts = _facts(model)
    if picture is not None:
        _draw(model, picture)
        facts['picture'] = str(picture)
    if as_json:
        print_json(facts)
        return 0
    console = answer_console()
    for key, value in facts.items():
        name = key.replace('_', ' ')
        if isinstance(value, list) and len(value) > _IN_ONE_LINE:
            # Each by itself, for eyes and for grep.
            line(console, f'{name:<18} {len(value)}:')
            for one in value:
                line(console, f'  {one}')
            continue
        shown = ', '.join(str(v) for v in value) if isinstance(value, list) else value
        line(console, f'{name:<18} {shown}')
    return 0


def _draw(model: MapModel, picture: Path) -> None:
    from aurora_core.report.picture.draw import png_bytes, svg_bytes
    from aurora_core.report.picture.map_picture import draw_map

    with quiet_stdout():
        figure = draw_map(model)
        data = svg_bytes(figure) if picture.suffix.lower() == '.svg' else png_bytes(figure)
    write_file(picture, data)
    say(f'aurora: wrote {picture}')


def summary(model: MapModel) -> dict[str, Any]:
    west, south, east, north = model.bounds_m
    return {
        'name': model.name,
        'version': model.version,
        'description': model.description,
        'licence': model.licence,
        'digest': model.digest,
        'width_m': round(east - west, 1),
        'height_m': round(north - south, 1),
    }


def _facts(model: MapModel) -> dict[str, Any]:
    network = model.network
    lanes = network.driving_lanes('passenger')
    tallest = max(model.buildings, key=lambda b: (b.height_m, b.id), default=None)
    found = measured_on(model)
    return {
        **summary(model),
        'folder': str(model.folder),
        'origin_lat_deg': model.origin_lat_deg,
        'origin_lon_deg': model.origin_lon_deg,
        'bounds_m': list(model.bounds_m),
        'streets': list(network.street_names),
        'driving_lanes': len(lanes),
        'driving_lanes_km': round(sum(lane.arc_length_m for lane in lanes) / 1000.0, 3),
        'junctions': len(network.junctions),
        'signalised': sum(j.has_signal for j in network.junctions.values()),
        'crossings': len(network.crossings),
        'buildings': len(model.buildings),
        'tallest_building_m': tallest.height_m if tallest is not None else None,
        'landmarks': [f'{mark.name} ({mark.kind})' for mark in model.landmarks],
        'areas': [f'{area.name} ({area.kind})' for area in model.areas],
        'no_fly_zones': [
            f'{zone.name} ({zone.floor_m:g} to {zone.ceiling_m:g} m)' for zone in model.zones
        ],
        'bus_stops': [stop.name or stop.id for stop in model.bus_stops],
        'parking_places': sum(len(area.places) for area in model.parking_areas),
        'measured': 'yes' if isinstance(found, MeasuredMap) else found,
        **(_measured(found) if isinstance(found, MeasuredMap) else {}),
    }


def _measured(found: MeasuredMap) -> dict[str, Any]:
    """Return what the records say of the streets: what can be asked on this map, and seen."""
    return {
        'along_lanes': along_lanes(found.samples),
        'seen_from_air': seen_from_air(found.records),
        'hidden_at_corners': hidden_at_corners(found.records),
    }
