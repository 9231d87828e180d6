# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Numbers that close the scene: `exactly two cars` says that there is no third one."""

from __future__ import annotations

from collections.abc import Sequence
from functools import lru_cache

from aurora_core.parsing.atoms import Atom, AtomKind, NounKind, NounPhrase
from aurora_core.parsing.data_files import read_data
from aurora_core.parsing.resolver import Resolver
from aurora_core.parsing.scene import Scene
from aurora_core.parsing.values import inferred, stated
from aurora_core.spec.parameter import Parameter, Span
from aurora_core.spec.requirements import SceneCount
from aurora_core.spec.vocabulary import AgentType, ClauseStatus


def close_scene(
    scene: Scene, atoms: Sequence[Atom], tagged: Sequence[Atom], resolver: Resolver
) -> None:
    """Add to a scene the numbers that close it, each to the clause that states it.

    `no truck`, `no other bicycle`, `no other traffic`: those that are named are all.

    Args:
        scene: What was read.
        atoms: As they were read.
        tagged: As they were told: of `exactly two vehicles, a car and a van` the sum is not read.
        resolver: Of the names.
    """
    left_out = {(a.start, a.end) for a in atoms if a.kind is AtomKind.FILL}
    sums = (a for a in tagged if a.noun is not None and (a.start, a.end) in left_out)
    for atom in (*atoms, *sums):
        noun = atom.noun
        if atom.kind is AtomKind.NO_TRAFFIC:
            _close(scene, 'vehicle', Span(start=atom.start, end=atom.end))
        elif noun is not None and noun.kind is NounKind.AGENT and resolver.denied(noun):
            _close(scene, noun.key, Span(start=noun.start, end=noun.end))
        elif noun is not None and noun.count > 0 and _is_exact(scene, noun):
            kind = _kind(noun)
            if kind is not None:
                span = Span(start=noun.start, end=noun.end)
                number = stated('scene_count', float(noun.count), noun.start, noun.end)
                _add(scene, kind, number, span)


def _close(scene: Scene, kind: str, span: Span) -> None:
    """Say that there are as many of a kind as are named."""
    no_vehicles = (AgentType.PEDESTRIAN, AgentType.RSU)
    named = [
        agent
        for agent in scene.agents
        if (agent.type not in no_vehicles if kind == 'vehicle' else agent.type.value == kind)
    ]
    _add(scene, kind, inferred('scene_count', float(len(named)), span), span)


def _add(scene: Scene, kind: str, number: Parameter, span: Span) -> None:
    name = scene.new_id('count')
    scene.counts.append(
        SceneCount.model_validate({'id': name, 'kind': kind, 'value': number, 'span': span})
    )
    for clause in scene.clauses:
        inside = clause.span.start <= span.start and span.end <= clause.span.end
        if inside and clause.status is ClauseStatus.ENCODED:
            clause.ids[name] = None


def _is_exact(scene: Scene, noun: NounPhrase) -> bool:
    return scene.prompt[noun.start : noun.end].lower().startswith(_words())


@lru_cache(maxsize=1)
def _words() -> tuple[str, ...]:
    return tuple(read_data('lexicon.yaml')['closing'])


def _kind(noun: NounPhrase) -> str | None:
    """Return what a phrase counts, None when it names no kind of body."""
    if noun.kind is NounKind.AGENT:
        return noun.key
    return {NounKind.UAV: 'uav', NounKind.VEHICLE: 'vehicle'}.get(noun.kind)
