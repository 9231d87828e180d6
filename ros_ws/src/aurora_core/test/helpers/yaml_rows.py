# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Tables of tests, kept as YAML; some have thousands of lines."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import yaml

# In C where there is one: a tenth of the time.
_LOADER = getattr(yaml, 'CSafeLoader', yaml.SafeLoader)


def rows_of(path: Path) -> Any:
    """Return what a YAML file holds."""
    return yaml.load(path.read_text(encoding='utf-8'), Loader=_LOADER)  # noqa: S506
