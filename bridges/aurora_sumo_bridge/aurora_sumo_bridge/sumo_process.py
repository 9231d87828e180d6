# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The one simulation that a process may hold: start line, ownership, errors, silence.

libsumo keeps its simulation in global variables: a second `start` silently replaces the first.
So the first session owns the library until it is closed, and anyone else is refused.
"""

from __future__ import annotations

import contextlib
import gzip
import os
import sys
import tempfile
import weakref
from collections.abc import Iterator
from pathlib import Path
from typing import IO
from xml.parsers import expat

import libsumo

from aurora_core.errors import GroundSimulatorError
from aurora_core.files import MAP_BYTES, open_regular

# Lateral time of a lane change: without it SUMO jumps 3 m sideways in one step.
LANE_CHANGE_DURATION_S = 3
LARGEST_SEED = 2**31 - 1
ERROR_LINES_KEPT = 6
# The root element stands right at the beginning.
_FIRST_BYTES = 4096

_owner: weakref.ref[SumoProcess] | None = None


class SumoProcess:
    """A started SUMO that is this process's only one.

    Args:
        net_path: Network (`.net.xml` or `.net.xml.gz`).
        vtypes_path: Additional file with the vTypes.
        dt_s: Step length, whole milliseconds.
        seed: SUMO's random seed.

    Raises:
        GroundSimulatorError: Another session is open, a file is missing or damaged, a number is
            out of range, or SUMO refuses.
    """

    def __init__(self, *, net_path: Path, vtypes_path: Path, dt_s: float, seed: int) -> None:
        self._open = False
        arguments = start_arguments(
            net_path=net_path, vtypes_path=vtypes_path, dt_s=dt_s, seed=seed
        )
        # libsumo dies of a segmentation fault, not of an exception, on a net without a version.
        check_xml_root(net_path, {'net'})
        check_xml_root(vtypes_path, {'additional', 'routes'})
        _take_ownership(self)
        self._open = True
        with tempfile.TemporaryFile() as noise:
            try:
                with _stderr_to(noise):
                    libsumo.start(arguments)
            except libsumo.TraCIException as err:
                self.close()
                raise GroundSimulatorError(
                    f'SUMO does not start with net {net_path.name} and vTypes '
                    f'{vtypes_path.name}: {err}{_tail(noise)}',
                    hint='check the map folder and the vTypes file',
                ) from err
            except BaseException:
                self.close()
                raise
            # A healthy start is silent, so whatever was said came from another thread.
            noise.seek(0)
            sys.stderr.write(noise.read().decode('utf-8', errors='replace'))

    @property
    def is_open(self) -> bool:
        return self._open

    def close(self) -> None:
        """Free the simulation and the ownership; safe to call twice."""
        global _owner
        if not self._open:
            return
        self._open = False
        _owner = None
        if libsumo.isLoaded():
            libsumo.close()


def start_arguments(*, net_path: Path, vtypes_path: Path, dt_s: float, seed: int) -> list[str]:
    """Return SUMO's command line.

    Raises:
        GroundSimulatorError: Step length or seed cannot be given to SUMO, or a path has a comma
            (SUMO would read two files).
    """
    step_ms = round(dt_s * 1000.0) if 0.0 < dt_s <= 1.0 else 0
    if step_ms < 1 or abs(step_ms / 1000.0 - dt_s) > 1e-12:
        raise GroundSimulatorError(
            f'step length {dt_s!r} s: SUMO counts whole milliseconds from 0.001 s to 1 s'
        )
    if not 0 <= seed <= LARGEST_SEED:
        raise GroundSimulatorError(f'seed {seed}: SUMO takes 0 to {LARGEST_SEED}')
    for path in (net_path, vtypes_path):
        if ',' in str(path):
            raise GroundSimulatorError(f'path {path} has a comma, which SUMO takes as a list')
    return [
        'sumo',
        *('--net-file', str(net_path)),
        *('--additional-files', str(vtypes_path)),
        *('--step-length', f'{step_ms / 1000.0:.3f}'),
        *('--seed', str(seed)),
        # Teleports hide failures: nobody is moved after a jam or a collision.
        *('--time-to-teleport', '-1'),
        *('--collision.action', 'warn'),
        *('--collision.check-junctions', 'true'),
        *('--default.speeddev', '0'),
        *('--pedestrian.striping.dawdling', '0'),
        *('--lanechange.duration', str(LANE_CHANGE_DURATION_S)),
        *('--no-step-log', 'true'),
        *('--no-warnings', 'true'),
        *('--xml-validation', 'never'),
    ]


def check_xml_root(path: Path, roots: set[str]) -> None:
    """Raise unless the file opens, is XML and begins with one of the root elements.

    A net must also name its version.

    Raises:
        GroundSimulatorError: Missing, unreadable, not XML, another root, no version.
    """
    found: list[tuple[str, dict[str, str]]] = []

    def first_element(name: str, attributes: dict[str, str]) -> None:
        if not found:
            found.append((name, attributes))

    parser = expat.ParserCreate()
    parser.StartElementHandler = first_element
    try:
        with open_regular(path, MAP_BYTES) as file:
            stream = gzip.GzipFile(fileobj=file) if path.suffix == '.gz' else file
            while not found:
                chunk = stream.read(_FIRST_BYTES)
                parser.Parse(chunk, not chunk)
                if not chunk:
                    break
    except (OSError, EOFError, expat.ExpatError) as err:
        raise GroundSimulatorError(f'{path} cannot be read as XML: {err}') from err
    name, attributes = found[0] if found else ('nothing', {})
    if name not in roots:
        raise GroundSimulatorError(
            f'{path} begins with <{name}>, expected <{"> or <".join(sorted(roots))}>'
        )
    if name == 'net' and not attributes.get('version'):
        raise GroundSimulatorError(f'{path} is a net without a version; SUMO would crash on it')


def _take_ownership(session: SumoProcess) -> None:
    global _owner
    holder = _owner() if _owner is not None else None
    if holder is not None and holder.is_open:
        raise GroundSimulatorError(
            'another SUMO client of this process is loaded: libsumo holds one simulation',
            hint='close it first, or use a second process',
        )
    if libsumo.isLoaded():
        if _owner is None:
            raise GroundSimulatorError(
                'libsumo is already running in this process, started by someone else',
                hint='close it with libsumo.close() first',
            )
        # The former owner was dropped without close: its simulation is nobody's.
        libsumo.close()
    _owner = weakref.ref(session)


@contextlib.contextmanager
def _stderr_to(stream: IO[bytes]) -> Iterator[None]:
    """Send file descriptor 2 to a file: SUMO writes past Python's `sys.stderr`."""
    sys.stderr.flush()
    saved = os.dup(2)
    try:
        os.dup2(stream.fileno(), 2)
        yield
    finally:
        sys.stderr.flush()
        os.dup2(saved, 2)
        os.close(saved)


def _tail(noise: IO[bytes]) -> str:
    noise.seek(0)
    lines = noise.read().decode('utf-8', errors='replace').split('\n')
    once = dict.fromkeys(line.strip() for line in lines if line.strip())
    said = list(once)[:ERROR_LINES_KEPT]
    return f'; SUMO says: {" | ".join(said)}' if said else ''
