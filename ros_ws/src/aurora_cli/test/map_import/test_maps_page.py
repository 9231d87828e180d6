# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The commands of docs/maps.md do what the page says, and its figures are those of the code."""

from __future__ import annotations

import re
import shlex
import shutil
from collections.abc import Callable
from pathlib import Path
from types import SimpleNamespace

from aurora_cli.map_import import frame, osm_buildings, source
from aurora_core.files import XML_BYTES

PAGE = (Path(__file__).resolve().parents[5] / 'docs' / 'maps.md').read_text(encoding='utf-8')


def test_commands(
    own: Path, here: Path, files: SimpleNamespace, call: Callable[..., SimpleNamespace]
) -> None:
    shutil.copy(files.osm, here / 'old_town.osm.gz')
    (block,) = re.findall(r'```bash\n(.*?)```', PAGE, re.DOTALL)
    for command in block.splitlines():
        done = call(*shlex.split(command)[1:])
        expected = int(' doctor ' in command)
        assert done.code == expected, f'{command}: {done.err}'
    assert (here / 'old_town.png').read_bytes().startswith(b'\x89PNG')


def test_figures() -> None:
    assert f'more than {source.MOST_NODES:,} nodes' in PAGE
    assert f'{XML_BYTES >> 20} MiB' in PAGE
    assert f'more than {frame.MOST_EXTENT_M / 1000.0:.0f} km' in PAGE
    assert f'`levels` ({osm_buildings.LEVEL_M:.0f} m each' in PAGE
    assert f'`default` ({osm_buildings.DEFAULT_M:.0f} m)' in PAGE
