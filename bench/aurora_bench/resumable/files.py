# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Prompt files of a campaign, and the lines of its output that programs read."""

from __future__ import annotations

import hashlib
from collections import Counter
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from aurora_bench.prompts.documents import read_documents
from aurora_bench.prompts.format import AnnotatedPrompt, beyond
from aurora_bench.prompts.reading import read_prompts
from aurora_bench.results import ResultsError
from aurora_core.document import Document
from aurora_core.files import DOCUMENT_BYTES, read_bytes
from aurora_core.report.share import Share


class PromptFile(Document):
    """A prompt file.

    Attributes:
        name: Folder and name: enough to tell files apart, without the machine's own paths.
        sha256: Digest of its bytes (hex).
        prompts: What it holds.
        documents: The same as plain values, in the same order.
    """

    name: str
    sha256: str
    prompts: tuple[AnnotatedPrompt, ...]
    documents: tuple[dict[str, Any], ...]

    @property
    def beyond(self) -> int:
        """Number of requirements that no field of an annotation holds."""
        return sum(len(beyond(prompt)) for prompt in self.prompts)


def read_files(paths: Sequence[Path]) -> tuple[PromptFile, ...]:
    """Return the prompt files of a campaign.

    Raises:
        ResultsError: One cannot be read or is no prompt file, two have the same name, or an id
            stands for two prompts of a file.
    """
    files = [_read(path) for path in paths]
    for name, times in Counter(file.name for file in files).items():
        if times > 1:
            raise ResultsError(f'{name} is given twice: results would count it twice')
    return tuple(files)


def _read(path: Path) -> PromptFile:
    prompts = read_prompts(path)
    for ident, times in Counter(prompt.id for prompt in prompts).items():
        if times > 1:
            raise ResultsError(f'{path} has two prompts of the id {ident}')
    resolved = path.resolve()
    return PromptFile(
        name=f'{resolved.parent.name}/{resolved.name}',
        sha256=hashlib.sha256(read_bytes(path, DOCUMENT_BYTES)).hexdigest(),
        prompts=prompts,
        documents=tuple(read_documents(path)),
    )


def file_line(file: PromptFile) -> str:
    """Return the line about one file that stands above the last line."""
    return f'{file.name}  sha256 {file.sha256}  beyond {file.beyond}'


def verdict_line(what: str, share: Share, of: str, silent: int, unchecked: Share) -> str:
    """Return the last line of a measurement that judges runs.

    Args:
        what: What is counted, e.g. `realised`.
        share: How many of how many.
        of: Word behind the number of trials, with a blank before it, or ''.
        silent: Runs that were verified and that the checker contradicts.
        unchecked: Requirements of verified runs that the checker cannot decide, of all of them.
    """
    low, high = share.interval
    return (
        f'{what} {share.met} of {share.total}{of}  {share.value:.3f} [{low:.3f}, {high:.3f}]  '
        f'silent failures {silent}  unchecked {unchecked.met} of {unchecked.total}'
    )
