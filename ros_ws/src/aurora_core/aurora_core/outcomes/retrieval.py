# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What was selected for a prompt, and the scores behind it."""

from __future__ import annotations

from enum import StrEnum

from pydantic import FiniteFloat

from aurora_core.document import Document


class RecordKind(StrEnum):
    """What a record is about; selection is made within each kind that is not a registry."""

    REGISTRY = 'registry'  # always shown
    ASSET = 'asset'
    SPAWN = 'spawn'
    EPISODE = 'episode'


class Hit(Document):
    """How a record fared.

    Attributes:
        fused: Reciprocal rank fusion score.
        ranks: By ranker, from 1 within the kind; a ranker that saw no likeness is left out.
        scores: By ranker.
        selected: Shown to the model.
    """

    kind: RecordKind
    id: str
    fused: FiniteFloat
    ranks: dict[str, int]
    scores: dict[str, FiniteFloat]
    selected: bool


class Retrieval(Document):
    """What was selected for a prompt, and why; the document `retrieval.json`.

    Attributes:
        rankers: Names with versions; one alone when the embedding model is not installed.
        fusion_k: Constant of the fusion.
        corpus_sha256: Digest of all records that could be selected: history included.
        registries_sha256: Digest of those that are always shown.
        hits: The best of each kind, best first.
    """

    query: str
    rankers: tuple[str, ...]
    fusion_k: FiniteFloat
    corpus_sha256: str
    registries_sha256: str
    hits: tuple[Hit, ...]
