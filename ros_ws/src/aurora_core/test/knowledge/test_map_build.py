# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The shipped maps are what their build scripts make."""

from __future__ import annotations

import gzip
import os
import shutil
import subprocess
import sys
import sysconfig
from pathlib import Path

import pytest

import aurora_core

MAPS = next(
    folder
    for folder in (parent / 'config' / 'maps' for parent in Path(__file__).resolve().parents)
    if folder.is_dir()
)


def _has_netconvert() -> bool:
    beside = Path(sysconfig.get_path('scripts')) / 'netconvert'
    return beside.exists() or shutil.which('netconvert') is not None


@pytest.mark.skipif(not _has_netconvert(), reason='netconvert (eclipse-sumo) is not installed')
@pytest.mark.parametrize('name', ['downtown', 'junction'])
def test_build_script_makes_the_shipped_files(name: str, tmp_path: Path) -> None:
    package_folder = str(Path(aurora_core.__file__).resolve().parents[1])
    subprocess.run(
        [sys.executable, str(MAPS / f'build_{name}.py'), '--out', str(tmp_path / name)],
        check=True,
        env=os.environ | {'PYTHONPATH': package_folder},
        stdout=subprocess.DEVNULL,
    )
    shipped = {path.name: path.read_bytes() for path in (MAPS / name).iterdir()}
    built = {path.name: path.read_bytes() for path in (tmp_path / name).iterdir()}
    assert sorted(built) == sorted(shipped)
    net, shipped_net = (gzip.decompress(files['net.xml.gz']) for files in (built, shipped))
    assert net.startswith(b'<net ')
    assert net == shipped_net
    for file in built:
        assert built[file] == shipped[file], file
