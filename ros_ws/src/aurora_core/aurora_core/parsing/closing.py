# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Numbers that close the scene: `exactly two cars` says that there is no third one."""

from __future__ import annotations

from collections.abc import Sequence
from functools import lru_cache

from aurora_core.parsing.atoms import Atom, NounKind, NounPhrase
from aurora_core.parsing.lexicon import read_data
from aurora_core.parsing.scene import Scene
from aurora_core.parsing.values import stated
from aurora_core.spec.parameter import Span
from aurora_core.spec.requirements import SceneCount
from aurora_core.spec.vocabulary import ClauseStatus


def close_scene(scene: Scene, atoms: Sequence[Atom]) -> None:
    """Add to a scene the numbers that close it, each to the clause that states it."""
    words = _words()
    for noun in (atom.noun for atom in atoms if atom.noun is not None):
        phrase = scene.prompt[noun.start : noun.end]
        kind = _kind(noun)
        if kind is None or noun.count == 0 or not phrase.lower().startswith(words):
            continue
        name = scene.new_id('count')
        span = Span(start=noun.start, end=noun.end)
        number = stated('scene_count', float(noun.count), noun.start, noun.end)
        scene.counts.append(
            SceneCount.model_validate({'id': name, 'kind': kind, 'value': number, 'span': span})
        )
        for clause in scene.clauses:
            inside = clause.span.start <= span.start and span.end <= clause.span.end
            if inside and clause.status is ClauseStatus.ENCODED:
                clause.ids[name] = None


@lru_cache(maxsize=1)
def _words() -> tuple[str, ...]:
    return tuple(read_data('lexicon.yaml')['closing'])


def _kind(noun: NounPhrase) -> str | None:
    """Return what a phrase counts, None when it names no kind of body."""
    if noun.kind is NounKind.AGENT:
        return noun.key
    return {NounKind.UAV: 'uav', NounKind.VEHICLE: 'vehicle'}.get(noun.kind)
