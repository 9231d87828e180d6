# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Which flown mission each annotated mission is."""

from __future__ import annotations

import itertools
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from aurora_bench.checker import limits, missions
from aurora_bench.checker.answers import Judged, Outcome, all_of, cannot_tell, does_not
from aurora_bench.checker.case import Case, Requirement
from aurora_bench.checker.events import STATES, happened, trigger_of
from aurora_bench.checker.flight import Flight, asked_altitude
from aurora_bench.checker.phases import Segment, segments

MOST_MISSIONS = 6
# What ends the mission that a UAV is on, and how near to that event its end is (s).
ENDS_MISSIONS = ('change_mission', 'land', 'return_home', 'hand_over')
CUT_S = 0.5
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
    order; a mission inside of any_of, or of an event, takes the best of the others.
    """
    table = _table(case, uav)
    key = id(requirement)
    if key in table:
        return table[key]
    taken = {one.segment.number for one in table.values() if one.segment is not None}
    options = segments(case.scene, uav)
    options = tuple(s for s in options if s.number not in taken) or options
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
    bounds = [
        float(other['value'])
        for other in case.annotation.flat()
        if other.get('quantity') == 'hover_drift'
        and other.get('op') in ('<', '<=')
        and not other.get('negate')
        and uav in [body for name in other.get('of') or () for body in case.bodies(name)]
    ]
    if bounds:
        requirement = {**requirement, missions.DRIFT: min(bounds)}
    if case.unknown_place(requirement.get('target')):
        known = missions.judge(
            flight(case, {**requirement, 'target': None}, uav, segment),
            {
                **requirement,
                'target': None,
                missions.SOMEWHERE: True,
            },
        )
        doubt = cannot_tell(f'no place {requirement["target"]!r} in the recorded world')
        return all_of([known, doubt])
    return missions.judge(flight(case, requirement, uav, segment), requirement)


def flight(case: Case, requirement: Requirement, uav: str, segment: Segment) -> Flight:
    """Return a flown mission as it is judged: up to where an annotated climb changes it."""
    climbs = list(_climbs(case, requirement, uav, segment))
    return Flight(
        scene=case.scene,
        uav=uav,
        segment=segment,
        targets=case.things(requirement.get('target')),
        variation=case.variation,
        until=min((segment.end, *climbs)),
        climbs=bool(climbs),
        cut=_is_cut(case, uav, segment),
    )


def _is_cut(case: Case, uav: str, segment: Segment) -> bool:
    """Tell whether an annotated event of a UAV happens just when one of its missions ends.

    What waits for the end of that mission itself cuts nothing.
    """
    if not segment.closed:
        return False
    end_s = float(case.scene.times[segment.end])
    for event in case.annotation.flat():
        action, trigger = event.get('action') or {}, event.get('trigger') or {}
        ends = event['kind'] == 'event' and action.get('do') in ENDS_MISSIONS
        waits = trigger.get('on') in (None, 'mission_done')
        if not ends or waits or uav not in case.bodies(action.get('uav')):
            continue
        if action.get('do') == 'hand_over':  # its end does not show in what the other one does
            when = trigger_of(case, event)
            late_s = limits.ONSET_S + CUT_S
            if any(i.early_s - CUT_S <= end_s <= i.late_s + late_s for i in when):
                return True
            continue
        found = happened(case, event)
        fits = found.judged.outcome is not Outcome.DOES_NOT or action['do'] == 'change_mission'
        if fits and found.start_s is not None and abs(found.start_s - end_s) <= CUT_S:
            return True
    return False


def _climbs(case: Case, requirement: Requirement, uav: str, segment: Segment) -> Iterator[int]:
    """Yield when annotated climbs begin while a mission is flown.

    What somebody does that triggers one before that does so once the UAV has come to the altitude
    of the mission; a clock does not wait. One in an earlier mission is over with that.
    """
    first = segments(case.scene, uav)[0].number
    for event in case.annotation.flat():
        action = event.get('action') or {}
        if event['kind'] != 'event' or action.get('do') != 'ascend':
            continue
        if uav not in case.bodies(action.get('uav')):
            continue
        start = happened(case, event).start_s
        if start is None or case.scene.tick(start) >= segment.end:
            continue
        if case.scene.tick(start) <= segment.start and segment.number > first:
            continue
        waits = (event.get('trigger') or {}).get('on') in STATES
        if case.scene.tick(start) > segment.start or not waits:
            yield max(case.scene.tick(start), segment.start + 1)
        elif (arrived := _arrival(case, requirement, uav, segment)) is not None:
            yield arrived + 1


def _arrival(case: Case, requirement: Requirement, uav: str, segment: Segment) -> int | None:
    """Return when a UAV is at the annotated altitude of a mission, from its start on."""
    asked = asked_altitude(requirement, case.variation)
    if asked is None:
        return segment.start
    height = case.scene.altitude(uav)[segment.start : segment.end]
    low, high = asked.low - asked.slack, asked.high + asked.slack
    there = np.flatnonzero((height >= low) & (height <= high))
    return segment.start + int(there[0]) if len(there) else None


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
