# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Every quantity has its file, and every kind of arguments can be read back."""

from __future__ import annotations

import pkgutil
from importlib import import_module

import pytest

from aurora_core.judging import quantities
from aurora_core.judging.quantity import Quantity
from aurora_core.judging.registry import KINDS
from aurora_core.spec.quantity import QuantityName

FILES = {module.name for module in pkgutil.iter_modules(quantities.__path__)}


def _concrete(kind: type[Quantity]) -> set[type[Quantity]]:
    found = set() if getattr(kind, '__abstractmethods__', None) else {kind}
    return found.union(*(_concrete(one) for one in kind.__subclasses__()))


@pytest.mark.parametrize('name', list(QuantityName))
def test_every_quantity_has_a_file_of_its_name(name: QuantityName) -> None:
    module = import_module(f'{quantities.__name__}.{name.value}')
    own = [kind for kind in KINDS.values() if kind.__module__ == module.__name__]
    assert own
    assert {kind.name for kind in own} == {name}
    assert all(kind.__doc__ for kind in own)


def test_every_file_is_known() -> None:
    assert {kind.__module__.rpartition('.')[2] for kind in KINDS.values()} == FILES


def test_every_kind_is_known_by_a_name_of_its_own() -> None:
    found = {one for kind in Quantity.__subclasses__() for one in _concrete(kind)}
    assert set(KINDS.values()) == found
    assert all(kind.model_fields['kind'].default == name for name, kind in KINDS.items())
