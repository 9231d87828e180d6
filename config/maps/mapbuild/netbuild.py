# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Run netconvert and make its output reproducible."""

from __future__ import annotations

import shutil
import subprocess
import sysconfig
import tempfile
from pathlib import Path

from mapbuild.plain_xml import write_plain
from mapbuild.streets import StreetPlan

FLAGS = (
    '--crossings.guess',
    '--walkingareas',
    '--no-turnarounds.except-deadend',
    '--junctions.corner-detail',
    '5',
    '--tls.default-type',
    'static',
    '--tls.cycle.time',
    '60',
    '--output.street-names',
    # Node coordinates are already the map frame; without this netconvert would move them.
    '--offset.disable-normalization',
)


def projection(origin_lat_deg: float, origin_lon_deg: float) -> str:
    """Return the transverse Mercator whose origin and true north are the map's own.

    UTM would turn the map by the grid convergence, tens of metres over a city.
    """
    return (
        f'+proj=tmerc +lat_0={origin_lat_deg} +lon_0={origin_lon_deg} +k=1 +x_0=0 +y_0=0 '
        '+datum=WGS84 +units=m +no_defs'
    )


def location_element(
    origin_lat_deg: float,
    origin_lon_deg: float,
    extent_m: tuple[float, float, float, float],
    lonlat_extent_deg: tuple[float, float, float, float],
) -> str:
    """Return the `<location>` element that pins the frame (with plain XML, --proj would not)."""
    bounds = ','.join(f'{v:.2f}' for v in extent_m)
    degrees = ','.join(f'{v:.6f}' for v in lonlat_extent_deg)
    return (
        f'<location netOffset="0.00,0.00" convBoundary="{bounds}" origBoundary="{degrees}" '
        f'projParameter="{projection(origin_lat_deg, origin_lon_deg)}"/>'
    )


def build_net(plan: StreetPlan, stem: str, location: str) -> bytes:
    """Return the network XML from `<net` on, without dates and local paths.

    Raises:
        RuntimeError: When netconvert is missing, fails or warns.
    """
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        files = write_plain(plan, folder, stem, location)
        out = folder / f'{stem}.net.xml'
        command = [_netconvert()]
        for option, path in files.items():
            command += [f'--{option}', str(path)]
        command += [*FLAGS, '--output-file', str(out)]
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        if done.returncode != 0 or done.stderr.strip():
            raise RuntimeError(f'netconvert did not build {stem} cleanly:\n{done.stderr}')
        return strip_header(out.read_bytes())


def strip_header(net_xml: bytes) -> bytes:
    """Return the document from `<net` on: the comment before it has the date and local paths."""
    return net_xml[net_xml.index(b'<net ') :]


def _netconvert() -> str:
    beside = Path(sysconfig.get_path('scripts')) / 'netconvert'
    found = str(beside) if beside.exists() else shutil.which('netconvert')
    if found is None:
        raise RuntimeError('netconvert not found: install the eclipse-sumo package')
    return found
