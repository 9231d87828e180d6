# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Values made from files once, at set-up, so that not every process makes them again.

The files stay the only truth. A compiled value carries the digest of all that it was made from
(data and code); one that is missing, stale or damaged is made anew in memory. Only `write` writes,
so that an installation may be read-only.
"""

from __future__ import annotations

import hashlib
import importlib.util
import marshal
import os
import sys
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

_SUFFIX = '.compiled'
_DIGEST_BYTES = hashlib.sha256().digest_size


@dataclass(frozen=True, slots=True, kw_only=True)
class Compiled:
    """A value that is made from files.

    Attributes:
        name: Of its file, which lies where Python keeps the byte code of the first source.
        sources: Everything that decides the value: data files, and modules that make it.
        key: What else decides it, such as the digest of a map that was read.
        make: Makes it; nothing but None, numbers, text, bytes, code, tuples, lists, dicts, sets.
    """

    name: str
    sources: tuple[Path, ...]
    make: Callable[[], Any]
    key: str = ''

    @property
    def path(self) -> Path:
        """Where it is kept."""
        beside = Path(importlib.util.cache_from_source(str(self.sources[0].with_suffix('.py'))))
        return beside.with_name(f'{self.name}.{sys.implementation.cache_tag}{_SUFFIX}')

    def value(self) -> Any:
        """Return the value, a new one with each call.

        Raises:
            Exception: Whatever `make` raises.
        """
        try:
            kept = self.path.read_bytes()
            key = self._digest()
        except (OSError, NotImplementedError):
            return self.make()
        digest, payload = kept[_DIGEST_BYTES : 2 * _DIGEST_BYTES], kept[2 * _DIGEST_BYTES :]
        if kept[:_DIGEST_BYTES] != key or hashlib.sha256(payload).digest() != digest:
            return self.make()
        return marshal.loads(payload)  # nosec B302

    def write(self) -> Path:
        """Make the value and keep it; a reader sees the old one or the new one.

        Raises:
            OSError: The folder cannot be written.
            Exception: Whatever `make` raises.
        """
        payload = marshal.dumps(self.make())
        data = self._digest() + hashlib.sha256(payload).digest() + payload
        path = self.path
        path.parent.mkdir(parents=True, exist_ok=True)
        temporary = path.with_name(f'{path.name}.{os.getpid()}')
        try:
            temporary.write_bytes(data)
            temporary.replace(path)
        finally:
            temporary.unlink(missing_ok=True)
        return path

    def _digest(self) -> bytes:
        total = hashlib.sha256()
        for data in (self.key.encode(), *(source.read_bytes() for source in self.sources)):
            total.update(len(data).to_bytes(8, 'little'))
            total.update(data)
        return total.digest()
