# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Compiles what each tick of the air simulator does, which also runs without (as plain Python)."""

from __future__ import annotations

import hashlib
import os
import shlex
import shutil
import sysconfig
from pathlib import Path

from console import run_logged, say
from layout import Layout
from stamps import digest_files, read_stamp, write_stamp

NATIVE_STAMP = 'native.json'
# Module, its C file, and the Python files that it is equal to; the module tells these names.
MODULES = {
    'aurora_uav_flight': ('flight.c', 'control.py multirotor.py parameters.py'),
    'aurora_uav_wire': ('wire.c', 'wire.py'),
}
# No contraction: a * b + c rounds twice, as it does in Python.
_FLAGS = ('-O2', '-fPIC', '-shared', '-ffp-contract=off')


def ensure_native(layout: Layout) -> None:
    """Compile what has changed; a compiler that cannot is no failure."""
    package = layout.packages().get('aurora_uav_sim')
    if package is None:
        return
    folder = layout.install / 'lib' / f'python{layout.python_tag}' / 'site-packages'
    targets = {
        name: folder / f'{name}{sysconfig.get_config_var("EXT_SUFFIX")}' for name in MODULES
    }
    compiler = os.environ.get('CC') or shutil.which('gcc') or 'cc'
    flags = [*_FLAGS, *shlex.split(os.environ.get('CFLAGS', '')), _FLAGS[-1]]
    digests = {name: digest_files(_files(package, name)) for name in MODULES}
    wanted = {
        target.name: f'{digests[name]} {compiler} {" ".join(flags)}'
        for name, target in targets.items()
    }
    stamp = layout.install / NATIVE_STAMP
    if read_stamp(stamp) == wanted and all(target.is_file() for target in targets.values()):
        return
    folder.mkdir(parents=True, exist_ok=True)
    log = layout.logs / 'native.log'
    for name, target in targets.items():
        source, *equal_to = _files(package, name)
        digest = hashlib.sha256(b''.join(file.read_bytes() for file in equal_to)).hexdigest()
        made = target.with_suffix('.new')
        command = [
            *shlex.split(compiler), *flags, f'-DSOURCES="{digest}"',
            f'-DEQUAL_TO="{MODULES[name][1]}"', '-I', sysconfig.get_paths()['include'],
            '-o', str(made), str(source), '-lm',
        ]  # fmt: skip
        if run_logged(command, log, label=f'compiling {source.name}') != 0:
            for old in targets.values():
                old.unlink(missing_ok=True)
            say(f'{source.name} could not be compiled: it runs as plain Python (log: {log})')
            return
        # Whole or not at all: a process that flies with the old one keeps it.
        made.replace(target)
    write_stamp(stamp, wanted)


def _files(package: Path, name: str) -> list[Path]:
    """Return the C file of a module and the Python files that it is equal to."""
    source, equal_to = MODULES[name]
    folder = package / 'aurora_uav_sim'
    return [package / 'native' / source, *(folder / file for file in equal_to.split())]
