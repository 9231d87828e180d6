# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`python -m aurora_cli.prepare`: do once, at set-up, what every command would do anew.

Writes the byte code of our packages and of the libraries that a run imports, and what is compiled
of the words of the parser, of messages, maps and the page of reports. Everything works without it,
more slowly.
"""

from __future__ import annotations

import compileall
import importlib
import importlib.util
import sys
from collections.abc import Iterable
from pathlib import Path

from aurora_core.compiled import Compiled
from aurora_core.grounding.spots import compiled_area
from aurora_core.knowledge.map_folders import bundled_maps
from aurora_core.knowledge.map_model import load_map
from aurora_core.parsing.data_files import NAMES, compiled_data
from aurora_core.parsing.lexicon import compiled_table
from aurora_core.report.html import compiled_page
from aurora_core.trace.definitions import compiled_definitions, definitions_folder

# The nodes are imported in processes of their own: only their byte code is needed.
PACKAGES = (
    'aurora',
    'aurora_bringup',
    'aurora_cli',
    'aurora_core',
    'aurora_llm',
    'aurora_nodes',
    'aurora_ros',
    'aurora_ros2cli',
    'aurora_sumo_bridge',
    'aurora_sync',
    'aurora_uav_bridge',
    'aurora_uav_sim',
)
# Between them they import every library that a check and a run need; importing compiles it.
IMPORTED = (
    'aurora_cli.commands.check',
    'aurora_cli.commands.run',
    'aurora_cli.local_run',
    'aurora_sumo_bridge.sumo_client',
    'aurora_uav_bridge.mavlink_client',
    'aurora_uav_sim.mavlink_server',
    'aurora_core.report.picture.draw',
    'matplotlib.backends.backend_agg',
    'matplotlib.backends.backend_svg',
    'scipy.optimize',
    'yaml',
)


def compiled_values() -> tuple[Compiled, ...]:
    """Return everything that set-up makes from files, beside byte code."""
    areas = [compiled_area(load_map(name)) for name in bundled_maps()]
    words = (*(compiled_data(name) for name in NAMES), compiled_table())
    messages = compiled_definitions(definitions_folder())
    return (*words, messages, compiled_page(), *areas)


def package_folders(names: Iterable[str]) -> list[Path]:
    """Return the folders of those packages that are installed."""
    specs = [importlib.util.find_spec(name) for name in names]
    return [
        Path(folder)
        for spec in specs
        if spec is not None
        for folder in spec.submodule_search_locations or ()
    ]


def main() -> int:
    """Write everything; return 1 when a module of ours is no Python."""
    sys.dont_write_bytecode = False
    good = [compileall.compile_dir(f, quiet=1) for f in package_folders(PACKAGES)]
    for name in IMPORTED:
        importlib.import_module(name)
    for value in compiled_values():
        value.write()
    return 0 if all(good) else 1


if __name__ == '__main__':
    sys.exit(main())
