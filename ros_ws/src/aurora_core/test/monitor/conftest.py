# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Gives the tests of this folder the builder of synthetic runs and its cases."""

from __future__ import annotations

import importlib.util
import sys
from pathlib import Path
from types import ModuleType

import pytest

_FOLDER = Path(__file__).resolve().parents[1] / 'monitor'


def _load(name: str) -> ModuleType:
    if name not in sys.modules:
        spec = importlib.util.spec_from_file_location(name, _FOLDER / f'{name}.py')
        assert spec is not None
        assert spec.loader is not None
        module = importlib.util.module_from_spec(spec)
        sys.modules[name] = module
        spec.loader.exec_module(module)
    return sys.modules[name]


# Test modules of this folder import these by name, each after those that it imports itself.
for _name in ('trace_builder', 'trace_cases', 'kind_rows', 'action_cases'):
    _load(_name)


@pytest.fixture(scope='session')
def tb() -> ModuleType:
    """The names of `trace_builder` and of `trace_cases`."""
    both = ModuleType('tb')
    for name in ('trace_builder', 'trace_cases'):  # the second one imports the first
        vars(both).update({k: v for k, v in vars(_load(name)).items() if not k.startswith('__')})
    return both
