# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Compiled twins of modules of this package, where `make setup` could make them.

A twin does what its Python files do, bit for bit. It is used only when it was compiled beside
these very files: whoever changes a line runs the changed one at once. `AURORA_PLAIN_FLIGHT=1`
leaves all of them out.
"""

from __future__ import annotations

import hashlib
import os
from importlib import import_module
from pathlib import Path
from typing import Any

PLAIN_VARIABLE = 'AURORA_PLAIN_FLIGHT'


def twin(name: str) -> Any | None:
    """Return a compiled module, None where there is none for these files.

    Args:
        name: Module; its `EQUAL_TO` names the files, its `SOURCES` is the digest of them all.
    """
    if os.environ.get(PLAIN_VARIABLE):
        return None
    try:
        found = import_module(name)
    except ImportError:
        return None
    files = (Path(__file__).parent / file for file in found.EQUAL_TO.split())
    digest = hashlib.sha256(b''.join(file.read_bytes() for file in files)).hexdigest()
    return found if digest == found.SOURCES else None
