# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Theta and omega: every parameter of a specification, its path and the node that owns it."""

from __future__ import annotations

from collections.abc import Iterator

from pydantic import BaseModel

from aurora_core.spec.parameter import Parameter
from aurora_core.spec.reference import ENVIRONMENT_ID
from aurora_core.spec.scenario import ScenarioSpec


def parameters_of(spec: ScenarioSpec) -> Iterator[tuple[str, str, Parameter]]:
    """Yield path, owning node and parameter, in the order of the specification."""
    yield from walk(spec, '', ENVIRONMENT_ID)


def walk(value: object, path: str, owner: str) -> Iterator[tuple[str, str, Parameter]]:
    """Yield every parameter below a value.

    Args:
        value: A part of a specification.
        path: Where it is; items of a list are named by their id, else by their number.
        owner: Node that owns it, unless the value says otherwise.
    """
    if isinstance(value, Parameter):
        yield path, owner, value
    elif isinstance(value, BaseModel):
        # Triggers and actions name bodies, but belong to their event.
        inside_event = path.endswith(('/trigger', '/action'))
        owner = owner if inside_event else owner_of(value, owner)
        for name in type(value).model_fields:
            yield from walk(getattr(value, name), f'{path}/{name}'.lstrip('/'), owner)
    elif isinstance(value, tuple):
        for index, item in enumerate(value):
            yield from walk(item, item_path(path, index, item), owner)


def owner_of(value: BaseModel, otherwise: str) -> str:
    """Return the node that owns a value: a mission's parameters belong to its UAV."""
    owner = getattr(value, 'uav', None) or getattr(value, 'id', None) or otherwise
    return str(owner)


def item_path(path: str, index: int, item: object) -> str:
    """Return the path of an item of a list."""
    return f'{path}/{getattr(item, "id", None) or index}'


def element_of(path: str) -> str:
    """Return the id of the element that a parameter states something about (`m1`, `world`)."""
    parts = path.split('/')
    return ENVIRONMENT_ID if parts[0] == 'world' else parts[1]
