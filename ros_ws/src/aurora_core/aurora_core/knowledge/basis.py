# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`Basis`: version, limits, tolerances and settings that a run was made with; it travels in the
grounding, so that a recording can be judged by what it was made with on any machine.
"""

from __future__ import annotations

import hashlib
import json
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Self

from pydantic import JsonValue, ValidationError

from aurora_core.document import Document, first_problem
from aurora_core.errors import ConfigError
from aurora_core.knowledge.limits import Limits, Tolerances
from aurora_core.knowledge.settings import Settings

Table = dict[str, JsonValue]


@dataclass(frozen=True, slots=True, kw_only=True)
class Tables:
    """The three tables of a basis, read."""

    limits: Limits
    tolerances: Tolerances
    settings: Settings


class Basis(Document):
    """What a run was made with, as plain JSON: another version may know other entries.

    Attributes:
        version: Of AURORA.
    """

    version: str
    limits: Table
    tolerances: Table
    settings: Table

    @classmethod
    def of(cls, version: str, tables: Tables) -> Self:
        """Return the basis of a version and its tables."""
        return cls(
            version=version,
            limits=tables.limits.model_dump(mode='json'),
            tolerances=tables.tolerances.model_dump(mode='json'),
            settings=tables.settings.model_dump(mode='json'),
        )

    def tables(self) -> Tables:
        """Return the tables.

        Raises:
            ConfigError: They have other entries than this version knows.
        """
        try:
            return Tables(
                limits=Limits.model_validate(self.limits),
                tolerances=Tolerances.model_validate(self.tolerances),
                settings=Settings.model_validate(self.settings),
            )
        except ValidationError as err:
            raise ConfigError(
                f'the recorded configuration cannot be read by this version: {first_problem(err)}',
                hint='judge it with the version that recorded it',
            ) from err

    @property
    def sha256(self) -> str:
        """Digest (hex) over all of it."""
        text = json.dumps(self.model_dump(mode='json'), sort_keys=True, separators=(',', ':'))
        return hashlib.sha256(text.encode('utf-8')).hexdigest()

    def differences(self, here: Basis) -> tuple[str, ...]:
        """Return what differs from the basis that is installed, value by value, for people."""
        ours = dict(_flat(self.model_dump(mode='json')))
        theirs = dict(_flat(here.model_dump(mode='json')))
        return tuple(
            f'{name} {ours.get(name, "none")} (here {theirs.get(name, "none")})'
            for name in dict.fromkeys((*ours, *theirs))
            if ours.get(name, '') != theirs.get(name, '')
        )


def _flat(value: Mapping[str, JsonValue], above: str = '') -> Iterator[tuple[str, str]]:
    """Yield every value with its path, as JSON text."""
    for key, item in value.items():
        if isinstance(item, dict):
            yield from _flat(item, f'{above}{key}.')
        else:
            yield f'{above}{key}', json.dumps(item, ensure_ascii=False)
