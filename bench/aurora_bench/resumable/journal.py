# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Finished trials of a campaign, one a line, on the disk before the next one counts.

The first line says what the campaign measures: files with their digests and options. A journal of
anything else is refused, so that two measurements never become one.
"""

from __future__ import annotations

import json
import os
from collections.abc import Mapping
from pathlib import Path
from types import TracebackType
from typing import Any, Self

from pydantic import ValidationError

from aurora_core.document import Document
from aurora_core.errors import AuroraError
from aurora_core.files import read_bytes

JOURNAL_VERSION = 1
_JOURNAL_BYTES = 1 << 30
_ENDING = '.journal.jsonl'


class JournalError(AuroraError):
    """A journal cannot be written, or is that of another campaign."""

    default_component = 'bench'


class JournalHead(Document):
    """What a campaign measures.

    Attributes:
        campaign: Name of the command.
        files: Digest by the name of each prompt file.
        options: All that a trial depends on beside its prompt and seed.
    """

    journal_version: int = JOURNAL_VERSION
    campaign: str
    files: Mapping[str, str]
    options: Mapping[str, str]


def journal_path(place: Path, name: str) -> Path:
    """Return the journal that a path means: a file, or that of this name in a folder."""
    return place if place.suffix == '.jsonl' else place / f'{name}{_ENDING}'


class Journal:
    """A journal that is open for writing; `finished` holds what was there, by key."""

    def __init__(self, path: Path, head: JournalHead, *, resume: bool) -> None:
        """Open or begin a journal.

        Args:
            path: Its file; the folder is made.
            head: Of this campaign.
            resume: Go on with the one that is there. False: begin anew, unless an unfinished one
                is there.

        Raises:
            JournalError: It cannot be written, is of something else, or would be lost.
        """
        self.path = path
        self.finished: dict[str, Any] = {}
        self._is_ended = False
        try:
            path.parent.mkdir(parents=True, exist_ok=True)
            kept = self._read(head) if path.exists() else 0
            if not resume and self.finished and not self._is_ended:
                raise JournalError(
                    f'{path} holds {len(self.finished)} trials of a campaign that was not ended',
                    hint=f'go on with --resume {path}, or delete it',
                )
            if not resume:
                self.finished, kept = {}, 0
            # Not append: what a crash has left of a line goes.
            self._stream = path.open('r+b' if path.exists() else 'x+b')
            self._stream.truncate(kept)
            self._stream.seek(kept)
            if kept == 0:
                self._write(head.model_dump(mode='json'))
        except OSError as err:
            raise JournalError(
                f'{path} cannot be written: {err.strerror or err}',
                hint='choose another place with --resume',
            ) from err

    def add(self, key: str, result: Mapping[str, Any]) -> None:
        """Keep a result; it is on the disk when this returns."""
        self._write({'key': key, 'result': dict(result)})

    def end(self) -> None:
        """Say that nothing is missing: a later campaign may begin anew here."""
        self._write({'ended': True})

    def _write(self, line: Mapping[str, Any]) -> None:
        text = json.dumps(line, ensure_ascii=False, allow_nan=False)
        self._stream.write(text.encode() + b'\n')
        self._stream.flush()
        os.fsync(self._stream.fileno())

    def _read(self, head: JournalHead) -> int:
        """Take in what is there and return how many of its bytes are whole lines."""
        data = read_bytes(self.path, _JOURNAL_BYTES)
        whole = data.rfind(b'\n') + 1
        lines = data[:whole].splitlines()
        if not lines:
            return 0
        try:
            self._check(JournalHead.model_validate_json(lines[0]), head)
            for line in lines[1:]:
                entry = json.loads(line)
                if 'key' in entry:
                    self.finished[str(entry['key'])] = entry['result']
                self._is_ended = 'ended' in entry
        except (ValidationError, ValueError, TypeError, KeyError) as err:
            raise JournalError(f'{self.path} is no journal of a campaign: {err}') from err
        return whole

    def _check(self, found: JournalHead, head: JournalHead) -> None:
        ours, theirs = head.model_dump(mode='json'), found.model_dump(mode='json')
        for name in ours:
            if ours[name] != theirs[name]:
                raise JournalError(
                    f'{self.path} is of another campaign: its {name.replace("_", " ")} is '
                    f'{_short(theirs[name])}, not {_short(ours[name])}',
                    hint='give another --resume or --results, or repeat it as it was begun',
                )

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        value: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self._stream.close()


def _short(value: object) -> str:
    if isinstance(value, dict):
        return ', '.join(f'{name} {str(item)[:12]}' for name, item in sorted(value.items()))
    return str(value)
