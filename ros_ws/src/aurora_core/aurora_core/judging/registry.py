# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Every kind of arguments, by the name under which it is recorded."""

from __future__ import annotations

import inspect
import pkgutil
from collections.abc import Iterator
from importlib import import_module

from aurora_core.judging import quantities
from aurora_core.judging.quantity import Quantity


def _kinds() -> Iterator[type[Quantity]]:
    """Yield the argument types of all files of `quantities`."""
    for file in pkgutil.iter_modules(quantities.__path__, f'{quantities.__name__}.'):
        for kind in vars(import_module(file.name)).values():
            own = inspect.isclass(kind) and kind.__module__ == file.name
            if own and issubclass(kind, Quantity) and not inspect.isabstract(kind):
                yield kind


KINDS: dict[str, type[Quantity]] = {kind.model_fields['kind'].default: kind for kind in _kinds()}
