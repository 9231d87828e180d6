# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The knowledge base of a run: records made from what parser, grounding and checks read."""

from __future__ import annotations

from collections.abc import Sequence

from aurora_core.knowledge.map_folders import list_maps
from aurora_core.parsing.data_files import read_data
from aurora_core.parsing.values import unsaid_values
from aurora_core.pipeline.history import history_of
from aurora_core.pipeline.knowledge import Knowledge
from aurora_core.pipeline.stages import RunRequest
from aurora_core.retrieval.assets import asset_records
from aurora_core.retrieval.background import Amounts, Background
from aurora_core.retrieval.ranking import MakeRanker
from aurora_core.retrieval.record import Record
from aurora_core.retrieval.registries import registry_records
from aurora_core.retrieval.retriever import Retriever
from aurora_core.retrieval.spawns import spawn_records

# Sections of the lexicon whose keys are assets.
_SECTIONS = ('agents', 'weather', 'time_of_day')


def registries(known: Knowledge, map_name: str) -> tuple[Record, ...]:
    """Return what is shown with every prompt."""
    measured = known.measured(map_name)
    return registry_records(
        limits=known.limits,
        types=known.types,
        map_model=known.map(map_name),
        maps=list_maps(),
        unsaid=unsaid_values(),
        measured=None if measured is None else measured.records,
    )


def map_records(known: Knowledge, map_name: str) -> tuple[Record, ...]:
    """Return assets and the spawn examples of a map."""
    return (
        *asset_records(known.types, known.limits, _words(), known.uav),
        *spawn_records(known.map(map_name)),
    )


def background(
    known: Knowledge, request: RunRequest, makers: Sequence[MakeRanker], amounts: Amounts
) -> Background:
    """Return what a model is shown with the prompt of a request.

    Args:
        known: What every stage of the run reads.
        request: Prompt, map and history.
        makers: How to make the rankers.
        amounts: How many records of each kind.

    Raises:
        ConfigError: The history cannot be read.
    """
    always = registries(known, request.map_name)
    history = history_of(request)
    episodes = history.episodes() if history is not None else ()
    records = (*map_records(known, request.map_name), *(one.record() for one in episodes))
    retriever = Retriever(records, makers, amounts.fusion_k)
    selected, retrieval = retriever.retrieve(request.prompt, amounts.most, always)
    return Background(registries=always, selected=selected, retrieval=retrieval)


def _words() -> dict[str, tuple[str, ...]]:
    lexicon = read_data('lexicon.yaml')
    words = {key: tuple(phrases) for name in _SECTIONS for key, phrases in lexicon[name].items()}
    return {**words, 'uav': tuple(lexicon['uav'])}
