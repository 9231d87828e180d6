# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Files of one name are checked in different rounds, all of them once."""

from __future__ import annotations

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from typecheck import rounds_of


def test_files_of_one_name_are_kept_apart(tmp_path: Path) -> None:
    package = tmp_path / 'a' / 'pack'
    package.mkdir(parents=True)
    (package / '__init__.py').touch()
    (tmp_path / 'b').mkdir()
    inside = [package / '__init__.py', package / 'conftest.py']
    loose = [
        tmp_path / 'a' / 'conftest.py',
        tmp_path / 'b' / 'conftest.py',
        tmp_path / 'b' / 'x.py',
    ]

    rounds = rounds_of([*inside, *loose])

    assert rounds == [[*inside, loose[0], loose[2]], [loose[1]]]
