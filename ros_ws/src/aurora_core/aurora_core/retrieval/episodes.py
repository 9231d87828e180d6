# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Past episodes: verified runs, one file each in a folder, that later prompts may be like."""

from __future__ import annotations

import os
import re
from pathlib import Path

from pydantic import FiniteFloat, ValidationError

from aurora_core.document import Document
from aurora_core.errors import ConfigError
from aurora_core.files import DOCUMENT_BYTES, read_bytes
from aurora_core.outcomes.retrieval import RecordKind
from aurora_core.retrieval.record import Record

_NAME = re.compile(r'[A-Za-z0-9][A-Za-z0-9_-]*')
_VERIFIED = 'verified'


class Episode(Document):
    """What is kept of a run.

    Attributes:
        status: Of the run; only `verified` is taken into a store.
        elements: What the request became, in words (`track car1`, `tailgate`).
        conditions: Sentences of its success conditions.
        worst_normalised: The least normalised margin.
        trace_sha256: Digest of the recording that shows it.
    """

    id: str
    prompt: str
    map_name: str
    status: str
    elements: tuple[str, ...]
    conditions: tuple[str, ...]
    worst_normalised: FiniteFloat | None
    trace_sha256: str

    def record(self) -> Record:
        """Return it as a record."""
        data = self.model_dump(mode='json', exclude={'id', 'status'})
        return Record(
            kind=RecordKind.EPISODE,
            id=self.id,
            text=f'{self.prompt} [{", ".join(self.elements)}]',
            source=f'run {self.id}',
            data=data,
        )


class EpisodeStore:
    """A folder with one JSON file per episode.

    Args:
        folder: Made when the first episode comes.
        frozen: Nothing is taken in: what one run of a campaign learns must not help the next.
    """

    def __init__(self, folder: Path, *, frozen: bool = False) -> None:
        self.folder = folder
        self.frozen = frozen

    def add(self, episode: Episode) -> bool:
        """Take an episode in and return True; False when it is not verified, or all is frozen.

        Raises:
            ConfigError: The folder cannot be written.
        """
        if self.frozen or episode.status != _VERIFIED:
            return False
        if not _NAME.fullmatch(episode.id):
            raise ConfigError(f'an episode needs an id that can name a file, found {episode.id!r}')
        target = self.folder / f'{episode.id}.json'
        # Written whole: another process may be reading.
        temporary = self.folder / f'.writing-{os.getpid()}-{episode.id}'
        try:
            self.folder.mkdir(parents=True, exist_ok=True)
            temporary.write_text(episode.model_dump_json(indent=2) + '\n', encoding='utf-8')
            temporary.replace(target)
        except OSError as err:
            raise ConfigError(
                f'the history {self.folder} cannot be written: {err}',
                hint='name a folder that you may write, or freeze the history',
            ) from err
        return True

    def episodes(self) -> tuple[Episode, ...]:
        """Return all episodes by id; a folder that is not there has none.

        Raises:
            ConfigError: A file in it is no episode of a verified run.
        """
        found = []
        for path in sorted(self.folder.glob('*.json')):
            try:
                episode = Episode.model_validate_json(read_bytes(path, DOCUMENT_BYTES))
            except (OSError, ValidationError) as err:
                raise ConfigError(f'{path} is no episode: {err}', hint='remove the file') from err
            if episode.status != _VERIFIED:
                raise ConfigError(
                    f'{path}: expected a verified run, found {episode.status}',
                    hint='remove the file',
                )
            found.append(episode)
        return tuple(found)
