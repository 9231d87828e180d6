# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Read the documents of a run folder; what cannot be read is told, never raised."""

from __future__ import annotations

import json
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import TypeVar

from pydantic import BaseModel, ValidationError

from aurora_core.files import DOCUMENT_BYTES, read_bytes

_SHOWN = 120
_Document = TypeVar('_Document', bound=BaseModel)


@dataclass(frozen=True, slots=True, kw_only=True)
class Unreadable:
    """A document that is not there, or is none.

    Attributes:
        missing: There is no such file.
        why: For people, with the name of the file.
    """

    missing: bool
    why: str


def read_stored(path: Path) -> bytes | Unreadable:
    """Return the bytes of a file of a run folder."""
    try:
        return read_bytes(path, DOCUMENT_BYTES)
    except FileNotFoundError:
        return Unreadable(missing=True, why=f'{path.name} is missing')
    except OSError as err:
        what = err.strerror or str(err)
        return Unreadable(missing=False, why=f'{path.name} cannot be read: {what}')


def read_document(
    path: Path, kind: type[_Document], read: Callable[[bytes], _Document] | None = None
) -> _Document | Unreadable:
    """Return a document of a run folder, read as its type reads it unless told otherwise."""
    data = read_stored(path)
    if isinstance(data, Unreadable):
        return data
    try:
        json.loads(data, object_pairs_hook=_once)
        return kind.model_validate_json(data) if read is None else read(data)
    except ValidationError as err:
        first = err.errors(include_url=False, include_input=False)[0]
        where = '.'.join(str(part) for part in first['loc'])
        why = f'{where}: {first["msg"]}' if where else str(first['msg'])
        return _none(path, why)
    # A document of another make can be nested, or hold numbers, beyond what Python reads.
    except (RecursionError, ValueError, OverflowError, MemoryError) as err:
        return _none(path, f'{type(err).__name__}: {err}')


def _once(pairs: list[tuple[str, object]]) -> dict[str, object]:
    """Return an object whose names are told once: of two values readers take different ones."""
    found = dict(pairs)
    if len(found) < len(pairs):
        names = [name for name, _ in pairs]
        twice = next(name for name in names if names.count(name) > 1)
        raise ValueError(f'it tells {twice!r} twice')
    return found


def _none(path: Path, why: str) -> Unreadable:
    shown = why if len(why) <= _SHOWN else f'{why[:_SHOWN]}...'
    return Unreadable(missing=False, why=f'{path.name} is not what a run writes: {shown}')
