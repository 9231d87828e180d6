# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Which flown mission each annotated mission is."""

from __future__ import annotations

import itertools
from dataclasses import dataclass

from aurora_bench.checker import missions
from aurora_bench.checker.answers import Judged, Outcome, all_of, cannot_tell, does_not
from aurora_bench.checker.case import Case, Requirement
from aurora_bench.checker.events import happened
from aurora_bench.checker.flight import Flight
from aurora_bench.checker.phases import Segment, segments

MOST_MISSIONS = 6
SCORE = {Outcome.HOLDS: 100, Outcome.CANNOT_TELL: 1, Outcome.DOES_NOT: 0}


@dataclass(frozen=True, slots=True)
class Flown:
    """The answer to an annotated mission of one UAV, and what was flown as it."""

    judged: Judged
    segment: Segment | None


def mission(case: Case, requirement: Requirement) -> Judged:
    """Return whether an annotated mission was flown (by all UAVs of a group)."""
    gone = case.missing(requirement.get('uav'), requirement.get('target'))
    if gone:
        return does_not(f'there is no {gone}')
    uavs = case.bodies(requirement.get('uav'))
    if not uavs:
        return does_not(f'there is no UAV {requirement.get("uav")!r}')
    return all_of([flown(case, requirement, uav).judged for uav in uavs])


def flown(case: Case, requirement: Requirement, uav: str) -> Flown:
    """Return the flown mission of one UAV that an annotated one stands for.

    Top-level missions of one UAV stand for different flown ones, as well as possible in their
    order; a mission inside of any_of takes the best.
    """
    table = _table(case, uav)
    key = id(requirement)
    if key in table:
        return table[key]
    options = segments(case.scene, uav)
    answers = [(_judge(case, requirement, uav, s), s) for s in options]
    if not answers:
        return Flown(does_not(f'{uav} flies no mission'), None)
    judged, segment = max(answers, key=lambda a: (SCORE[a[0].outcome], -a[1].number))
    return Flown(judged, segment)


def _table(case: Case, uav: str) -> dict[int, Flown]:
    key = ('missions', uav)
    if key not in case.memory:
        case.memory[key] = _assign(case, uav)
    found = case.memory[key]
    assert isinstance(found, dict)
    return found


def _assign(case: Case, uav: str) -> dict[int, Flown]:
    asked = [
        r
        for r in case.annotation.requirements
        if r['kind'] == 'mission' and uav in case.bodies(r.get('uav')) and not r.get('negate')
    ][:MOST_MISSIONS]
    options: list[Segment | None] = list(segments(case.scene, uav)[:MOST_MISSIONS])
    answers = {
        (i, s.number): _judge(case, r, uav, s)
        for i, r in enumerate(asked)
        for s in options
        if s is not None
    }
    options += [None] * max(0, len(asked) - len(options))
    best: tuple[float, tuple[Segment | None, ...]] = (-1.0, ())
    for choice in itertools.permutations(options, len(asked)):
        score = float(
            sum(SCORE[answers[i, s.number].outcome] for i, s in enumerate(choice) if s is not None)
        )
        numbers = [s.number for s in choice if s is not None]
        score += 0.1 * (numbers == sorted(numbers))
        if score > best[0]:
            best = (score, choice)
    return {
        id(r): Flown(
            answers[i, s.number] if s is not None else does_not(f'{uav} flies no such mission'), s
        )
        for i, (r, s) in enumerate(zip(asked, best[1], strict=True))
    }


def _judge(case: Case, requirement: Requirement, uav: str, segment: Segment) -> Judged:
    if case.unknown_place(requirement.get('target')):
        known = missions.judge(
            flight(case, {**requirement, 'target': None}, uav, segment),
            {
                **requirement,
                'target': None,
            },
        )
        doubt = cannot_tell(f'no place {requirement["target"]!r} in the recorded world')
        return all_of([known, doubt])
    return missions.judge(flight(case, requirement, uav, segment), requirement)


def flight(case: Case, requirement: Requirement, uav: str, segment: Segment) -> Flight:
    """Return a flown mission as it is judged: up to where an annotated climb changes it."""
    return Flight(
        scene=case.scene,
        uav=uav,
        segment=segment,
        targets=case.things(requirement.get('target')),
        variation=case.variation,
        until=_until(case, uav, segment),
    )


def _until(case: Case, uav: str, segment: Segment) -> int:
    end = segment.end
    for event in case.annotation.flat():
        action = event.get('action') or {}
        if event['kind'] != 'event' or action.get('do') != 'ascend':
            continue
        if uav not in case.bodies(action.get('uav')):
            continue
        start = happened(case, event).start_s
        if start is not None and segment.start < case.scene.tick(start) < end:
            end = case.scene.tick(start)
    return end


def spans(case: Case) -> dict[str, tuple[float, float]]:
    """Return start and end of the flown mission of every annotated one that was flown."""
    found = {}
    for ref, requirement in case.annotation.missions.items():
        for uav in case.bodies(requirement.get('uav'))[:1]:
            segment = flown(case, requirement, uav).segment
            if segment is not None:
                times, last = case.scene.times, case.scene.recording.ticks - 1
                found[ref] = (float(times[segment.start]), float(times[min(segment.end, last)]))
    return found
