# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Gives the tests of this folder the requests of `time_pairs`, by its name."""

from __future__ import annotations

import importlib.util
import sys
from pathlib import Path

_FILE = Path(__file__).resolve().parents[1] / 'feasibility' / 'time_pairs.py'

if 'time_pairs' not in sys.modules:
    _spec = importlib.util.spec_from_file_location('time_pairs', _FILE)
    assert _spec is not None
    assert _spec.loader is not None
    _module = importlib.util.module_from_spec(_spec)
    sys.modules['time_pairs'] = _module
    _spec.loader.exec_module(_module)
