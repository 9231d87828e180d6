# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""All requirements of an annotation, under the binding of names that satisfies most of them."""

from __future__ import annotations

import functools
import itertools
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

from aurora_bench.checker import events, flown
from aurora_bench.checker.answers import (
    Answer,
    Checked,
    Judged,
    Outcome,
    any_of,
    cannot_tell,
    negated,
)
from aurora_bench.checker.behaviors import behavior
from aurora_bench.checker.case import Annotation, Case, Requirement
from aurora_bench.checker.conditions import condition
from aurora_bench.checker.links import link
from aurora_bench.checker.placements import placement
from aurora_bench.checker.read import read_bag
from aurora_bench.checker.recording import Body, Recording
from aurora_bench.checker.scene import Scene
from aurora_bench.checker.worlds import agent, count, world

# Bindings that are tried at most, and choices of one group among many bodies.
MOST_BINDINGS = 720
MOST_CHOICES = 60
POINTS = {Outcome.HOLDS: 1000, Outcome.CANNOT_TELL: 1, Outcome.DOES_NOT: 0}


def check_bag(bag: Path, prompt: Mapping[str, Any]) -> Checked:
    """Return what a recording says of every requirement of a prompt.

    Args:
        bag: Folder of a bag, or its .mcap file.
        prompt: One parsed line of a prompt file.

    Raises:
        CheckerError: The bag cannot be read, or the prompt has no requirements.
    """
    return check_recording(read_bag(bag), prompt)


def check_recording(recording: Recording, prompt: Mapping[str, Any]) -> Checked:
    """Return what a recording says of every requirement of a prompt.

    Raises:
        CheckerError: The prompt has no requirements.
    """
    annotation, scene = Annotation(prompt), Scene(recording)
    depends = [annotation.names_in(r) for r in annotation.requirements]
    known: dict[tuple[int, tuple[tuple[str, tuple[str, ...]], ...]], Judged] = {}
    best: tuple[int, list[Judged], Case] | None = None
    most = POINTS[Outcome.HOLDS] * len(depends)
    for binding in itertools.islice(_bindings(annotation, scene), MOST_BINDINGS):
        case = Case(scene, annotation, binding)
        judged = []
        for i, requirement in enumerate(annotation.requirements):
            own = tuple((n, binding.get(n, ())) for n in sorted(depends[i]))
            if requirement['kind'] in ('agent', 'uav', 'world', 'count'):
                own = tuple(sorted(binding.items()))
            if (i, own) not in known:
                known[i, own] = judge(case, requirement)
            judged.append(known[i, own])
        points = sum(POINTS[j.outcome] for j in judged)
        if best is None or points > best[0]:
            best = (points, judged, case)
        if points == most:
            break
    assert best is not None
    answers = tuple(
        Answer(requirement=str(r.get('id', '')), kind=str(r['kind']), outcome=j.outcome, why=j.why)
        for r, j in zip(annotation.requirements, best[1], strict=True)
    )
    return Checked(answers=answers, binding=dict(best[2].binding))


def _bindings(annotation: Annotation, scene: Scene) -> Iterator[Mapping[str, tuple[str, ...]]]:
    """Yield bindings of names to different bodies of fitting types, likely ones first.

    Bodies come in the order of the roster, those of the annotated role first (of equal bindings
    the first counts) and background traffic where
    nobody else is left; where there are too few, a name gets the rest.
    """
    names = list(annotation.bodies)
    bodies = list(scene.bodies.values())

    def extend(
        at: int, taken: frozenset[str], bound: dict[str, tuple[str, ...]]
    ) -> Iterator[Mapping[str, tuple[str, ...]]]:
        if at == len(names):
            yield dict(bound)
            return
        name = names[at]
        role = annotation.roles[name]
        free = [
            b.body_id
            for b in sorted(bodies, key=functools.partial(_unlikely, annotation, role))
            if b.type_name in annotation.bodies[name] and b.body_id not in taken
        ]
        own = [b for b in free if scene.bodies[b].role != 'background']
        free = own if len(own) >= annotation.counts[name] else free
        size = min(annotation.counts[name], len(free))
        for choice in itertools.islice(itertools.combinations(free, size), MOST_CHOICES):
            yield from extend(at + 1, taken | set(choice), {**bound, name: choice})

    yield from extend(0, frozenset(), {})


def _unlikely(annotation: Annotation, role: str, body: Body) -> tuple[bool, bool, bool]:
    """Return a key that puts bodies first of which the annotated role is the recorded one."""
    others = body.role in annotation.roles.values() and body.role != role
    return (body.role != role if role else others, others, body.role == 'background')


def judge(case: Case, requirement: Requirement) -> Judged:
    """Return the answer to one requirement under a binding."""
    judged = _judge(case, requirement)
    return negated(judged) if requirement.get('negate') else judged


def _judge(case: Case, requirement: Requirement) -> Judged:
    match requirement['kind']:
        case 'any_of':
            return any_of([judge(case, r) for r in requirement.get('any_of') or []])
        case 'beyond':
            return cannot_tell('beyond what the format can say')
        case 'reject':
            return cannot_tell('a refusal is not in a recording')
        case 'agent' | 'uav':
            return agent(case, requirement)
        case 'count':
            return count(case, requirement)
        case 'world':
            return world(case, requirement)
        case 'placement':
            return placement(case, requirement)
        case 'behavior':
            return behavior(case, requirement)
        case 'mission':
            return flown.mission(case, requirement)
        case 'link':
            return link(case, requirement)
        case 'event':
            return events.happened(case, requirement).judged
        case 'order':
            return events.ordered(case, requirement, flown.spans(case))
        case 'condition':
            return condition(case, requirement)
        case other:
            return cannot_tell(f'kind {other!r} is not known')
