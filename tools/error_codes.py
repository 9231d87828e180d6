# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""A plugin of pytest that notes which error codes the tests provoke: `-p error_codes`.

Each process writes a file into the folder that AURORA_CODES_FOLDER names (`tools/coverage.sh`).
"""

from __future__ import annotations

import functools
import json
import os
from pathlib import Path
from typing import Any

from aurora_core.errors import AuroraError

VARIABLE = 'AURORA_CODES_FOLDER'
_made: set[int] = set()


def pytest_configure() -> None:
    """Note the code of every error that is made from now on."""
    original = AuroraError.__init__

    @functools.wraps(original)
    def noting(self: AuroraError, *arguments: Any, **options: Any) -> None:
        original(self, *arguments, **options)
        _made.add(self.code)

    AuroraError.__init__ = noting  # type: ignore[method-assign]


def pytest_sessionfinish() -> None:
    """Write down what was noted."""
    folder = os.environ.get(VARIABLE, '')
    if folder:
        Path(folder, f'{os.getpid()}.json').write_text(json.dumps(sorted(_made)))


def noted(folder: Path) -> set[int]:
    """Return the codes that all processes have noted."""
    return {code for path in folder.glob('*.json') for code in json.loads(path.read_text())}
