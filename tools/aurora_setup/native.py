# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Compiles the physics step of the air simulator, which also runs without (as plain Python)."""

from __future__ import annotations

import hashlib
import os
import shlex
import shutil
import sysconfig

from console import run_logged, say
from layout import Layout
from stamps import digest_files, read_stamp, write_stamp

NATIVE_STAMP = 'native.json'
MODULE = 'aurora_uav_flight'
# What is compiled is equal to these files: `aurora_uav_sim/compiled.py` checks it.
_FILES = ('control.py', 'multirotor.py', 'parameters.py')
# No contraction: a * b + c rounds twice, as it does in Python.
_FLAGS = ('-O2', '-fPIC', '-shared', '-ffp-contract=off')


def ensure_native(layout: Layout) -> None:
    """Compile what has changed; a compiler that cannot is no failure."""
    package = layout.packages().get('aurora_uav_sim')
    if package is None:
        return
    source = package / 'native' / 'flight.c'
    equal_to = [package / 'aurora_uav_sim' / name for name in _FILES]
    folder = layout.install / 'lib' / f'python{layout.python_tag}' / 'site-packages'
    target = folder / f'{MODULE}{sysconfig.get_config_var("EXT_SUFFIX")}'
    compiler = os.environ.get('CC') or shutil.which('gcc') or 'cc'
    flags = [*_FLAGS, *shlex.split(os.environ.get('CFLAGS', '')), _FLAGS[-1]]
    wanted = {target.name: f'{digest_files([source, *equal_to])} {compiler} {" ".join(flags)}'}
    stamp = layout.install / NATIVE_STAMP
    if read_stamp(stamp) == wanted and target.is_file():
        return
    digest = hashlib.sha256(b''.join(file.read_bytes() for file in equal_to)).hexdigest()
    folder.mkdir(parents=True, exist_ok=True)
    made = target.with_suffix('.new')
    command = [
        *shlex.split(compiler), *flags, f'-DSOURCES="{digest}"',
        '-I', sysconfig.get_paths()['include'], '-o', str(made), str(source), '-lm',
    ]  # fmt: skip
    log = layout.logs / 'native.log'
    if run_logged(command, log, label='compiling the physics step') != 0:
        target.unlink(missing_ok=True)
        say(f'the physics step could not be compiled: it runs as plain Python (log: {log})')
        return
    # Whole or not at all: a process that flies with the old one keeps it.
    made.replace(target)
    write_stamp(stamp, wanted)
