# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The frame of an imported map: ENU metres about the middle of its roads."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from xml.etree import ElementTree as Xml

import numpy as np
import numpy.typing as npt
import pyproj
from pyproj.exceptions import ProjError

from aurora_core.errors import MapError
from aurora_core.files import XML_BYTES, read_bytes

# PX4's default home, as the bundled maps have it: where a file says nothing of the Earth.
UNPLACED_DEG = (47.397742, 8.545594)
# One transverse Mercator is true to 0.02 % so far from its middle.
MOST_EXTENT_M = 60_000.0
_POINTS = ('shape', 'outlineShape', 'customShape', 'contour')
_POINTED = frozenset({'junction', 'lane', 'edge', 'poly', 'poi'})
# Within this of latitude 0, longitude 0 there is sea: a frame of an invented place.
_NULL_ISLAND_DEG = 0.5

FloatArray = npt.NDArray[np.float64]
Turn = Callable[[FloatArray], FloatArray]


@dataclass(frozen=True, slots=True, kw_only=True)
class Frame:
    """Where a map lies.

    Args:
        lat_deg: Latitude of the origin.
        lon_deg: Longitude of the origin.
        is_placed: False when the file does not say where on Earth it is.
    """

    lat_deg: float
    lon_deg: float
    is_placed: bool

    @property
    def projection(self) -> str:
        """The transverse Mercator whose origin and true north are the map's own (PROJ)."""
        return (
            f'+proj=tmerc +lat_0={self.lat_deg:.6f} +lon_0={self.lon_deg:.6f} +k=1 +x_0=0 +y_0=0 '
            '+datum=WGS84 +units=m +no_defs'
        )

    def to_map(self) -> pyproj.Transformer:
        """Return what turns longitude and latitude (degrees) into map metres."""
        return pyproj.Transformer.from_crs('EPSG:4326', self.projection, always_xy=True)


def frame_about(lat_deg: float, lon_deg: float, *, is_placed: bool = True) -> Frame:
    """Return the frame about a point, rounded so that its text is exact."""
    return Frame(lat_deg=round(lat_deg, 6), lon_deg=round(lon_deg, 6), is_placed=is_placed)


def reframe(path: Path, given: Path) -> tuple[Xml.Element, Frame]:
    """Return a network turned into the frame about its middle, with that frame.

    The way is x, y of the file → longitude and latitude by its own projection → map metres, so
    that a network in UTM is turned by its grid convergence and y is true north. Where the file
    has no projection, or one about latitude 0 and longitude 0, it is only moved.

    Args:
        path: Network as netconvert wrote it.
        given: File as the user named it, for messages.

    Raises:
        MapError: It reaches farther than one frame is true, or its coordinates are none.
    """
    root = Xml.fromstring(read_bytes(path, XML_BYTES))  # nosec B314
    location = root.find('location')
    if location is None:
        raise MapError(f'{given} says nothing of its coordinates', hint='export it again')
    try:
        west, south, east, north = (float(v) for v in location.attrib['convBoundary'].split(','))
        offset = np.array([float(v) for v in location.attrib['netOffset'].split(',')])
    except (KeyError, ValueError) as err:
        raise MapError(f'{given} has a damaged <location>', hint='export it again') from err
    if not all(map(math.isfinite, (west, south, east, north))):
        raise MapError(f'{given} has coordinates that are none', hint='export it again')
    if max(east - west, north - south) > MOST_EXTENT_M:
        raise MapError(
            f'{given} reaches over {max(east - west, north - south) / 1000.0:.0f} km, more than '
            f'the {MOST_EXTENT_M / 1000.0:.0f} km of a map',
            hint='cut out a smaller part',
        )
    middle = np.array([[(west + east) / 2.0, (south + north) / 2.0]])
    frame, turn = _turn(location.get('projParameter', '!'), offset, middle)
    _move(root, turn)
    _relocate(location, frame, turn(np.array([[west, south], [east, north]])))
    return root, frame


def _turn(projection: str, offset: FloatArray, middle: FloatArray) -> tuple[Frame, Turn]:
    unplaced = frame_about(*UNPLACED_DEG, is_placed=False)
    shift = np.round(middle[0], 2)
    if projection.strip() in ('', '!', '-'):
        return unplaced, lambda points: points - shift
    try:
        # CARLA's nets name a grid file of heights, which a plane map does not need.
        plain = ' '.join(p for p in projection.split() if not p.startswith('+geoidgrids'))
        back = pyproj.Transformer.from_crs(plain, 'EPSG:4326', always_xy=True)
        lon_deg, lat_deg = back.transform(*(middle[0] - offset))
    except ProjError:
        return unplaced, lambda points: points - shift
    known = math.isfinite(lat_deg) and math.isfinite(lon_deg) and abs(lat_deg) < 85.0
    if not known or max(abs(lat_deg), abs(lon_deg)) < _NULL_ISLAND_DEG:
        return unplaced, lambda points: points - shift
    frame = frame_about(lat_deg, lon_deg)
    forth = frame.to_map()

    def turn(points: FloatArray) -> FloatArray:
        degrees = back.transform(points[:, 0] - offset[0], points[:, 1] - offset[1])
        return np.column_stack(forth.transform(*degrees))

    return frame, turn


def _move(root: Xml.Element, turn: Turn) -> None:
    """Turn every point of a network, all at once."""
    slots: list[tuple[Xml.Element, str, int]] = []
    values: list[tuple[float, float]] = []
    for element in root.iter():
        for name in _POINTS:
            text = element.get(name, '').split()
            if text:
                pairs = [pair.split(',') for pair in text]
                values += [(float(pair[0]), float(pair[1])) for pair in pairs]
                slots.append((element, name, len(pairs)))
        if element.tag in _POINTED and 'x' in element.attrib and 'y' in element.attrib:
            values.append((float(element.attrib['x']), float(element.attrib['y'])))
            slots.append((element, '', 1))
    if not values:
        return
    turned = turn(np.array(values))
    at = 0
    for element, name, count in slots:
        points = turned[at : at + count]
        at += count
        if name:
            element.set(name, ' '.join(f'{x:.2f},{y:.2f}' for x, y in points))
        else:
            element.set('x', f'{points[0][0]:.2f}')
            element.set('y', f'{points[0][1]:.2f}')


def _relocate(location: Xml.Element, frame: Frame, corners: FloatArray) -> None:
    bounds = ','.join(f'{v:.2f}' for v in corners.reshape(-1))
    back = pyproj.Transformer.from_crs(frame.projection, 'EPSG:4326', always_xy=True)
    degrees = np.column_stack(back.transform(corners[:, 0], corners[:, 1])).reshape(-1)
    location.attrib.clear()
    location.set('netOffset', '0.00,0.00')
    location.set('convBoundary', bounds)
    location.set('origBoundary', ','.join(f'{v:.6f}' for v in degrees))
    location.set('projParameter', frame.projection)
