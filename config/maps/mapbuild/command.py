# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The command line shared by the map build scripts."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

from mapbuild.write_map import MapPlan, write_map


def run(plan: MapPlan, maps_folder: Path) -> int:
    """Build a map from the command line and say what came out.

    Args:
        plan: The map.
        maps_folder: Folder that gets the map's folder unless `--out` names another.

    Returns:
        Exit code.
    """
    parser = argparse.ArgumentParser(description=f'Build the map {plan.name}.')
    parser.add_argument('--out', type=Path, help='folder to write instead of the shipped one')
    arguments = parser.parse_args()
    folder = arguments.out or maps_folder / plan.name
    manifest = write_map(plan, folder)
    size = sum(file.size_bytes for file in manifest.files)
    sys.stdout.write(f'{folder}: {size} bytes, digest {manifest.digest}\n')
    return 0
