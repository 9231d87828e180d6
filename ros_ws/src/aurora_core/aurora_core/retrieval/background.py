# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What a model is shown beside the prompt and its instructions."""

from __future__ import annotations

import json
from collections.abc import Sequence

from pydantic import NonNegativeInt, PositiveFloat

from aurora_core.document import Document
from aurora_core.outcomes.retrieval import RecordKind, Retrieval
from aurora_core.retrieval.record import Record


class Amounts(Document):
    """How many records of each kind are shown, and the constant that fuses the rankings."""

    assets: NonNegativeInt
    spawns: NonNegativeInt
    episodes: NonNegativeInt
    fusion_k: PositiveFloat

    @property
    def most(self) -> dict[RecordKind, int]:
        """By kind."""
        return {
            RecordKind.ASSET: self.assets,
            RecordKind.SPAWN: self.spawns,
            RecordKind.EPISODE: self.episodes,
        }


class Background(Document):
    """Registries, the selected records, and how they were selected."""

    registries: tuple[Record, ...] = ()
    selected: tuple[Record, ...] = ()
    retrieval: Retrieval | None = None

    def registries_text(self) -> str:
        """Return the registries as one JSON object."""
        return _json({record.id: record.data for record in self.registries})

    def selected_text(self) -> str:
        """Return the selected records as one JSON object of lists by kind."""
        kinds = (RecordKind.ASSET, RecordKind.SPAWN, RecordKind.EPISODE)
        return _json({kind.value: _shown(self.selected, kind) for kind in kinds})


def _shown(records: Sequence[Record], kind: RecordKind) -> list[dict[str, object]]:
    return [{'id': record.id, **record.data} for record in records if record.kind is kind]


def _json(value: object) -> str:
    return json.dumps(value, ensure_ascii=False, sort_keys=True)
