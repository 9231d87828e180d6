# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Compiles what every command would compile anew: byte code, the words of the parser, the maps."""

from __future__ import annotations

import os
from pathlib import Path

from console import SetupError, last_lines, run_logged, say
from layout import Layout
from stamps import SKIPPED_FOLDERS, digest_files, read_stamp, write_stamp
from workspace import build_environment

PREPARED_STAMP = 'prepared.json'
_SUFFIXES = ('.py', '.yaml')


def ensure_prepared(layout: Layout) -> None:
    """Prepare the packages of a built workspace, unless their sources are those of the last time.

    Raises:
        SetupError: If a module cannot be compiled or imported.
    """
    stamp = layout.install / PREPARED_STAMP
    maps = sorted((layout.root / 'config' / 'maps').glob('*/map.json'))
    others = [layout.run_lock, *maps]
    wanted = {'sources': digest_files(sources(layout)), 'others': digest_files(others)}
    if read_stamp(stamp) == wanted:
        return
    say('compiling the sources, the words of the parser and the maps')
    environment = build_environment(layout)
    # As setup.bash does it: the workspace's packages in front.
    folders = [layout.workspace / 'build' / name for name in layout.packages()]
    paths = [str(folder) for folder in folders if folder.is_dir()]
    environment['PYTHONPATH'] = os.pathsep.join([*paths, environment.get('PYTHONPATH', '')])
    environment['AURORA_CONFIG_DIR'] = str(layout.root / 'config')
    log = layout.logs / 'prepared.log'
    command = [str(layout.venv_python), '-m', 'aurora_cli.prepare']
    if run_logged(command, log, label='compiling', environment=environment) != 0:
        raise SetupError(
            f'the sources cannot be compiled; last lines of {log}:\n{last_lines(log)}'
        )
    write_stamp(stamp, wanted)


def sources(layout: Layout) -> list[Path]:
    """Return every module and data file that is compiled, sorted."""
    found: list[Path] = []
    for folder in layout.packages().values():
        for where, subfolders, files in os.walk(folder):
            subfolders[:] = [name for name in subfolders if name not in SKIPPED_FOLDERS]
            found += [Path(where) / name for name in files if name.endswith(_SUFFIXES)]
    return sorted(found)
