# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Put a map folder together, so that it is there whole or not at all."""

from __future__ import annotations

import os
import shutil
import tempfile
import time
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any
from xml.sax.saxutils import quoteattr

from aurora_core.errors import AuroraError, MapError
from aurora_core.knowledge.map_types import Area, Building, BusStop, Landmark
from aurora_core.knowledge.net_types import Points

_TEMPORARY = '.importing-'
_ABANDONED_S = 3600.0


@contextmanager
def new_folder(final: Path) -> Iterator[Path]:
    """Give a temporary folder beside the final one; it becomes that one when all goes well.

    Whatever stops the work (Ctrl-C, a full disk, a broken file) leaves nothing behind.

    Raises:
        MapError: There is no room, no permission, or the folder came to be meanwhile.
    """
    try:
        final.parent.mkdir(parents=True, exist_ok=True)
        _remove_abandoned(final.parent)
        scratch = Path(tempfile.mkdtemp(prefix=_TEMPORARY, dir=final.parent))
    except OSError as err:
        raise _unwritable(final, err) from err
    try:
        (scratch / 'map').mkdir()
        yield scratch
        if final.exists():
            raise MapError(
                f'{final} came to be during the import', hint='choose another name with --name'
            )
        os.rename(scratch / 'map', final)
    except OSError as err:
        if isinstance(err, AuroraError):
            raise
        raise _unwritable(final, err) from err
    finally:
        shutil.rmtree(scratch, ignore_errors=True)


def _remove_abandoned(folder: Path) -> None:
    """Remove what an import that was killed left behind; one that runs is younger."""
    for path in folder.glob(f'{_TEMPORARY}*'):
        if time.time() - path.stat().st_mtime > _ABANDONED_S:
            shutil.rmtree(path, ignore_errors=True)


def _unwritable(final: Path, err: OSError) -> MapError:
    return MapError(
        f'the map cannot be made in {final.parent}: {err.strerror or err}',
        hint='make room, or name another folder with AURORA_MAPS',
    )


def building_features(buildings: Sequence[Building]) -> list[dict[str, Any]]:
    """Return the features of `buildings.geojson`."""
    return [
        _polygon(
            {
                'id': b.id,
                'kind': b.kind,
                'height_m': b.height_m,
                'height_source': b.height_source,
                **({'name': b.name} if b.name else {}),
            },
            (b.ring, *b.holes),
        )
        for b in buildings
    ]


def area_features(areas: Sequence[Area]) -> list[dict[str, Any]]:
    """Return the features of `zones.geojson`; foreign files close no air."""
    return [_polygon({'id': a.id, 'name': a.name, 'kind': a.kind}, (a.ring,)) for a in areas]


def landmark_features(landmarks: Sequence[Landmark]) -> list[dict[str, Any]]:
    """Return the features of `landmarks.geojson`."""
    return [
        {
            'type': 'Feature',
            'properties': {
                'name': mark.name,
                'kind': mark.kind,
                'approach_lane_id': mark.approach_lane_id,
                'approach_pos_m': mark.approach_pos_m,
            },
            'geometry': {'type': 'Point', 'coordinates': [mark.x_m, mark.y_m]},
        }
        for mark in landmarks
    ]


def _polygon(properties: dict[str, Any], rings: Sequence[Points]) -> dict[str, Any]:
    closed = [[list(point) for point in (*ring, ring[0])] for ring in rings]
    geometry = {'type': 'Polygon', 'coordinates': closed}
    return {'type': 'Feature', 'properties': properties, 'geometry': geometry}


def write_stops(path: Path, stops: Sequence[BusStop]) -> None:
    """Write bus stops as a SUMO additional file.

    Raises:
        OSError: No room.
    """
    lines = [
        f'  <busStop id={quoteattr(s.id)} name={quoteattr(s.name)} lane={quoteattr(s.lane_id)} '
        f'startPos="{s.start_pos_m:.2f}" endPos="{s.end_pos_m:.2f}"/>\n'
        for s in stops
    ]
    path.write_text(f'<additional>\n{"".join(lines)}</additional>\n', encoding='utf-8')
