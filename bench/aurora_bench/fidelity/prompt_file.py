# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""A prompt file as figures name it: which bytes were measured, and what of them is not scored."""

from __future__ import annotations

import hashlib
from dataclasses import dataclass
from pathlib import Path

from aurora_bench.fidelity.denominator import beyond
from aurora_bench.prompts.format import AnnotatedPrompt
from aurora_bench.prompts.reading import read_prompts


@dataclass(frozen=True, kw_only=True)
class PromptFile:
    """One prompt file.

    Attributes:
        name: With its folder, which says who may look.
        sha256: Of its bytes.
        prompts: In its order.
    """

    name: str
    sha256: str
    prompts: tuple[AnnotatedPrompt, ...]

    @property
    def beyond(self) -> int:
        """How many requirements ask for something that no field of the format holds."""
        return sum(len(beyond(prompt)) for prompt in self.prompts)

    @property
    def line(self) -> str:
        """The file in one line of the output."""
        return f'{self.name}  sha256 {self.sha256}  beyond {self.beyond}'


def prompt_file(path: Path) -> PromptFile:
    """Read a prompt file.

    Raises:
        ResultsError: It cannot be read, or a line is not a prompt.
    """
    prompts = read_prompts(path)
    return PromptFile(
        name=f'{path.parent.name}/{path.name}',
        sha256=hashlib.sha256(path.read_bytes()).hexdigest(),
        prompts=prompts,
    )
