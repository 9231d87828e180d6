# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Run netconvert, which turns road descriptions into SUMO networks."""

from __future__ import annotations

import importlib.util
import os
import shutil
import signal
import subprocess
import sysconfig
from collections.abc import Sequence
from contextlib import suppress
from pathlib import Path

from aurora_core.errors import MapError, ReportError

# A city centre takes it 2 s and 0.1 GiB, a city of 400,000 nodes 21 s and 0.5 GiB; one digit that
# is another one can have it lay out lanes without end.
_LIMIT_S = 300.0
_PROCESSOR_S = 60
_MEMORY_KIB = 2 << 20
_LIMITED = f'ulimit -v {_MEMORY_KIB}; ulimit -t {_PROCESSOR_S}; exec "$@"'
_END = b'</net>'
_TYPEMAP_FOLDERS = ('data/typemap', 'share/sumo/data/typemap')
_HINT = 'install the package eclipse-sumo of the version in requirements/ (`make setup` does)'


def run_netconvert(
    options: Sequence[str], *, typemaps: Sequence[str], out: Path, given: Path
) -> Path:
    """Write a network.

    Args:
        options: Input files and what is to be made of them.
        typemaps: Names of netconvert's own type files, without `.typ.xml`.
        out: Network to write; a log is written beside it.
        given: File as the user named it, for messages.

    Returns:
        `out`.

    Raises:
        MapError: netconvert is missing, fails, takes longer than five minutes, finds no road, or
            has no room for the network.
    """
    command = [_program(), *options, '--output-file', str(out)]
    if typemaps:
        folder = _typemap_folder()
        command += ['--type-files', ','.join(str(folder / f'{n}.typ.xml') for n in typemaps)]
    log = out.with_suffix('.log')
    with log.open('wb') as stream:
        # In a session of its own: Ctrl-C reaches us, and we stop it.
        process = subprocess.Popen(
            ['/bin/sh', '-c', _LIMITED, 'netconvert', *command],
            stdin=subprocess.DEVNULL,
            stdout=stream,
            stderr=stream,
            cwd=out.parent,
            start_new_session=True,
        )
        try:
            code = process.wait(timeout=_LIMIT_S)
        except subprocess.TimeoutExpired as err:
            raise MapError(
                f'{given}: netconvert was not done after {_LIMIT_S:.0f} s',
                hint='import a smaller part',
            ) from err
        finally:
            if process.poll() is None:
                # It is started by a script of its wheel, which would leave it behind.
                with suppress(ProcessLookupError):
                    os.killpg(process.pid, signal.SIGKILL)
                process.wait()
    if code != 0 or not out.is_file():
        raise MapError(
            f'{given} gives no road network: {_first_error(log, given)}',
            hint='import a file that has streets for cars',
        )
    if not _is_whole(out):  # it does not notice that a disk is full
        raise MapError(
            f'{given}: netconvert could not write all of its network',
            hint='make room, or name another folder with AURORA_MAPS',
        )
    return out


def write_opendrive(network: Path, out: Path) -> None:
    """Write a network as OpenDRIVE, in its own coordinates.

    Raises:
        ReportError: netconvert is missing, fails or has no room.
    """
    command = [_program(), '-s', str(network), '--opendrive-output', str(out)]
    try:
        done = subprocess.run(
            ['/bin/sh', '-c', _LIMITED, 'netconvert', *command],
            stdin=subprocess.DEVNULL,
            capture_output=True,
            text=True,
            errors='replace',
            timeout=_LIMIT_S,
            check=False,
        )
    except subprocess.TimeoutExpired as err:
        raise ReportError(f'netconvert did not write {out} in {_LIMIT_S:.0f} s') from err
    if done.returncode != 0 or not out.is_file():
        said = (done.stderr.strip().splitlines() or ['it says nothing'])[0]
        raise ReportError(f'netconvert cannot write {out}: {said}', hint=_HINT)


def _is_whole(network: Path) -> bool:
    with network.open('rb') as stream:
        stream.seek(max(0, network.stat().st_size - len(_END) - 8))
        return stream.read().rstrip().endswith(_END)


def _first_error(log: Path, given: Path) -> str:
    text = log.read_text(encoding='utf-8', errors='replace')[:100_000]
    lines = [line.strip() for line in text.splitlines() if line.strip()]
    errors = [line.removeprefix('Error:').strip() for line in lines if line.startswith('Error')]
    found = (errors or ['netconvert crashes on it, or is not done in its time'])[0]
    if found.startswith('std::bad_alloc'):
        found = 'netconvert finds no end of it in its memory'
    return found.replace(str(log.parent / 'source'), given.name)[:200].rstrip('.')


def _program() -> str:
    beside = Path(sysconfig.get_path('scripts')) / 'netconvert'
    found = str(beside) if beside.exists() else shutil.which('netconvert')
    if found is None:
        raise MapError('netconvert is not installed', hint=_HINT)
    return found


def _typemap_folder() -> Path:
    """Return the folder with netconvert's type files: SUMO_HOME, the wheel, the system."""
    spec = importlib.util.find_spec('sumo')
    homes = [Path(place) for place in (spec.submodule_search_locations or ())] if spec else []
    named = os.environ.get('SUMO_HOME')
    for home in [*homes, *([Path(named)] if named else []), Path('/usr')]:
        for below in _TYPEMAP_FOLDERS:
            if (home / below / 'osmNetconvert.typ.xml').is_file():
                return home / below
    raise MapError("netconvert's type files are not installed", hint=_HINT)
