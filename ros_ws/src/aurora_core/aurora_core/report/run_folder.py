# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The folder of one run: a file is written whole, so a crash leaves finished stages readable."""

from __future__ import annotations

import json
import os
import re
import shutil
from collections.abc import Sequence
from datetime import UTC, datetime
from enum import StrEnum
from pathlib import Path
from typing import Any

from pydantic import BaseModel

from aurora_core.errors import ReportError, hint_of_limits
from aurora_core.report.visible import visible_json

MANIFEST = 'manifest.json'
PROMPT = 'prompt.txt'
REPORT = 'report.json'
REPORT_HTML = 'report.html'
TRANSCRIPT = 'transcript.jsonl'
RETRIEVAL = 'retrieval.json'
PICTURE = 'picture.png'
SIGNED = 'signed.json'
SIGNATURE = 'signed.sig'

_RUN_ID = re.compile(r'\d{8}T\d{6}Z-[0-9a-f]{6}')
_TEMPORARY_PREFIX = '.writing-'


class StageFile(StrEnum):
    """Documents of one repair iteration; the file is `<name>.<k>.json`."""

    SPEC = 'spec'
    AGSG = 'agsg'
    GROUNDING = 'grounding'
    SCHEDULE = 'schedule'
    FEASIBILITY = 'feasibility'
    VERDICT = 'verdict'
    EDITS = 'edits'

    def name_at(self, iteration: int) -> str:
        """Return the file name at a repair iteration (from 0)."""
        return f'{self.value}.{iteration}.json'


_PARTS = (MANIFEST, PROMPT, REPORT, REPORT_HTML, TRANSCRIPT, RETRIEVAL, PICTURE)
_STAGE = re.compile(rf'(?:{"|".join(StageFile)})\.\d+\.json|bag\.\d+')


def is_part_of_run(name: str) -> bool:
    """Tell whether a file or folder of this name in a run folder is taken for one of the run."""
    return name in _PARTS or _STAGE.fullmatch(name) is not None


def new_run_id(utc: datetime, entropy: bytes) -> str:
    """Return a run id, `YYYYMMDDTHHMMSSZ-` and 6 hex digits.

    Args:
        utc: Aware time of the start.
        entropy: At least 3 bytes; the first 3 tell runs of one second apart.

    Raises:
        ReportError: The time has no zone, or there is too little entropy.
    """
    if utc.tzinfo is None:
        raise ReportError('a run id needs a time with a zone', hint='pass datetime.now(UTC)')
    if len(entropy) < 3:
        raise ReportError(f'a run id needs 3 bytes of entropy, found {len(entropy)}')
    return f'{utc.astimezone(UTC):%Y%m%dT%H%M%SZ}-{entropy[:3].hex()}'


def is_run_id(text: str) -> bool:
    """Tell whether a text has the form of a run id."""
    return _RUN_ID.fullmatch(text) is not None


class RunFolder:
    """Writes and names the files of one run.

    Args:
        root: Folder of all runs.
        run_id: See `new_run_id`.

    Raises:
        ReportError: The id does not have the form of one.
    """

    def __init__(self, root: Path, run_id: str) -> None:
        if not is_run_id(run_id):
            raise ReportError(
                f'a run id looks like 20260131T120000Z-0a1b2c, found {run_id!r}',
                hint='use new_run_id',
            )
        self.root = root
        self.run_id = run_id

    @property
    def path(self) -> Path:
        """The folder itself."""
        return self.root / self.run_id

    def create(self) -> None:
        """Make the folder; it must not exist yet.

        Raises:
            ReportError: It exists, or it cannot be made.
        """
        try:
            self.root.mkdir(parents=True, exist_ok=True)
            self.path.mkdir()
        except FileExistsError as err:
            raise ReportError(
                f'{err.filename} exists already', hint='choose another output folder'
            ) from err
        except OSError as err:
            raise _cannot_write(self.path, err) from err

    def bag_path(self, iteration: int) -> Path:
        """Return where the bag of an iteration is (the recorder makes it)."""
        return self.path / f'bag.{iteration}'

    def discard(self, iteration: int) -> None:
        """Take away the bag and the documents of an iteration, as far as there are any.

        Raises:
            ReportError: Something cannot be removed.
        """
        bag = self.bag_path(iteration)
        try:
            for kind in StageFile:
                self.file(kind.name_at(iteration)).unlink(missing_ok=True)
            if bag.exists():
                shutil.rmtree(bag)
        except OSError as err:
            raise ReportError(f'{self.path} cannot be tidied: {err.strerror or err}') from err

    def file(self, name: str) -> Path:
        """Return the path of a file of the run.

        Raises:
            ReportError: The name would leave the folder.
        """
        if Path(name).name != name or name in ('', '.', '..'):
            raise ReportError(f'expected the name of a file in {self.path}, found {name!r}')
        return self.path / name

    def write_bytes(self, name: str, data: bytes) -> Path:
        """Write a file whole: temporary name, fsync, rename.

        Returns:
            Its path.

        Raises:
            ReportError: No room, no permission, no folder; what was there before stays.
        """
        target = self.file(name)
        temporary = self.path / f'{_TEMPORARY_PREFIX}{name}'
        try:
            try:
                with temporary.open('wb') as stream:
                    stream.write(data)
                    stream.flush()
                    os.fsync(stream.fileno())
                temporary.replace(target)
                _sync_folder(self.path)
            finally:
                temporary.unlink(missing_ok=True)
        except OSError as err:
            raise _cannot_write(target, err) from err
        return target

    def write_text(self, name: str, text: str) -> Path:
        """Write text as UTF-8, byte for byte (no newline is changed or added).

        Raises:
            ReportError: As `write_bytes`; or the text is not valid Unicode.
        """
        try:
            data = text.encode('utf-8')
        except UnicodeEncodeError as err:
            raise ReportError(f'{name} is to hold a text that is not valid Unicode') from err
        return self.write_bytes(name, data)

    def write_json(self, name: str, document: BaseModel | dict[str, Any] | list[Any]) -> Path:
        """Write a document or plain JSON values, indented for people.

        Raises:
            ReportError: As `write_bytes`; or a number is not finite.
        """
        return self.write_text(name, json_text(document))

    def write_lines(self, name: str, documents: Sequence[BaseModel]) -> Path:
        """Write documents as JSON Lines, one a line.

        Raises:
            ReportError: As `write_text`.
        """
        return self.write_text(name, ''.join(d.model_dump_json() + '\n' for d in documents))

    def write_stage(self, kind: StageFile, iteration: int, document: BaseModel | str) -> Path:
        """Write the document of a stage at an iteration.

        Args:
            kind: Which one.
            iteration: From 0.
            document: Value, or its canonical JSON text (kept byte for byte).

        Raises:
            ReportError: As `write_json`.
        """
        text = document if isinstance(document, str) else json_text(document)
        return self.write_text(kind.name_at(iteration), text)


def json_text(document: BaseModel | dict[str, Any] | list[Any]) -> str:
    """Return the JSON text of a document, two blanks of indentation, newline at the end.

    Who reads it in a terminal sees direction marks of a prompt as escapes.

    Raises:
        ReportError: A number is not finite, or a value has no JSON form.
    """
    value = document.model_dump(mode='json') if isinstance(document, BaseModel) else document
    try:
        text = json.dumps(value, indent=2, ensure_ascii=False, allow_nan=False)
    except (ValueError, TypeError) as err:
        raise ReportError(f'a document cannot be written as JSON: {err}') from err
    return visible_json(text) + '\n'


def _sync_folder(path: Path) -> None:
    # Without it a power cut can undo the rename.
    descriptor = os.open(path, os.O_RDONLY)
    try:
        os.fsync(descriptor)
    finally:
        os.close(descriptor)


def _cannot_write(path: Path, err: OSError) -> ReportError:
    return ReportError(
        f'{path} cannot be written: {err.strerror or err}',
        hint=hint_of_limits(err) or 'choose a folder that you may write with --out',
    )
