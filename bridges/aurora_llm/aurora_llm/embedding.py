# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Rank texts by the mean of their word vectors, with the vectors of the wheel `wordllama`.

Only its two data files are read: importing its code would set up logging for the whole process,
and may look for files on the network. A package that is not installed is no error: retrieval is by
words alone then.
"""

from __future__ import annotations

import importlib.util
from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from importlib.metadata import version
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from aurora_core.retrieval.ranking import FloatArray, LexicalRanker, MakeRanker

_PACKAGE = 'wordllama'
_WEIGHTS = Path('weights', 'l2_supercat_256.safetensors')
_TOKENIZER = Path('tokenizers', 'l2_supercat_tokenizer_config.json')


@dataclass(frozen=True, kw_only=True)
class WordVectors:
    """Vectors of pieces of words.

    Attributes:
        name: Package and version.
        table: Shape (pieces, dimensions).
        tokenizer: Cuts a text into pieces.
    """

    name: str
    table: npt.NDArray[np.float32]
    tokenizer: Any

    def embed(self, text: str) -> npt.NDArray[np.float32]:
        """Return the mean vector of a text at unit length; zeros for a text without pieces."""
        pieces = self.tokenizer.encode(text, add_special_tokens=False).ids
        if not pieces:
            return np.zeros(self.table.shape[1], dtype=np.float32)
        mean = self.table[pieces].mean(axis=0)
        length = np.linalg.norm(mean)
        return np.asarray(mean / length if length > 0.0 else mean, dtype=np.float32)


class EmbeddingRanker:
    """Cosine likeness of mean word vectors.

    Args:
        vectors: The model.
        texts: What is ranked.
    """

    def __init__(self, vectors: WordVectors, texts: Sequence[str]) -> None:
        self._vectors = vectors
        self._matrix = np.stack([vectors.embed(text) for text in texts])

    @property
    def name(self) -> str:
        """Name and version, for the record."""
        return self._vectors.name

    def scores(self, query: str) -> FloatArray:
        """Return the cosine with every text."""
        return np.asarray(self._matrix @ self._vectors.embed(query), dtype=np.float64)


@lru_cache(maxsize=1)
def installed_vectors() -> WordVectors | None:
    """Return the vectors of the installed package (read once), None without it."""
    spec = importlib.util.find_spec(_PACKAGE)
    if spec is None or not spec.submodule_search_locations:
        return None
    folder = Path(spec.submodule_search_locations[0])
    if not (folder / _WEIGHTS).is_file() or not (folder / _TOKENIZER).is_file():
        return None
    # Imported here: only a prompt for a language model needs them.
    from safetensors.numpy import load_file
    from tokenizers import Tokenizer

    tokenizer = Tokenizer.from_file(str(folder / _TOKENIZER))
    tokenizer.no_truncation()
    tokenizer.no_padding()
    (table,) = load_file(folder / _WEIGHTS).values()
    return WordVectors(
        name=f'{_PACKAGE} {version(_PACKAGE)}',
        table=table.astype(np.float32),
        tokenizer=tokenizer,
    )


def rankers(*, embedding: bool) -> tuple[MakeRanker, ...]:
    """Return how to make the rankers: words, and vectors where wanted and installed."""
    vectors = installed_vectors() if embedding else None
    if vectors is None:
        return (LexicalRanker,)
    return (LexicalRanker, lambda texts: EmbeddingRanker(vectors, texts))
