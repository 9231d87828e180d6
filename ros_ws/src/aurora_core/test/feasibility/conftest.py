# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Gives the tests of this folder the requests of its other files, by their names."""

from __future__ import annotations

import importlib.util
import sys
from pathlib import Path

_FOLDER = Path(__file__).resolve().parent

for _name in ('time_pairs', 'requests_by_hand'):
    if _name not in sys.modules:
        _spec = importlib.util.spec_from_file_location(_name, _FOLDER / f'{_name}.py')
        assert _spec is not None
        assert _spec.loader is not None
        _module = importlib.util.module_from_spec(_spec)
        sys.modules[_name] = _module
        _spec.loader.exec_module(_module)
