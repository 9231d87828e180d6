# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Relations of two bodies that are told with motion: they hold along the route, too."""

from __future__ import annotations

import numpy as np

from aurora_bench.checker import limits
from aurora_bench.checker.answers import Judged, graded, holds
from aurora_bench.checker.case import Case, Requirement
from aurora_bench.checker.numbers import Wanted, wanted
from aurora_bench.checker.pairs import STEP_S
from aurora_bench.checker.paths import ahead_of, frame
from aurora_bench.checker.phases import missions_end_s
from aurora_bench.checker.recording import BoolArray
from aurora_bench.checker.scene import Scene, share


def on_the_way(
    case: Case, requirement: Requirement, body: str, other: str, asked: Wanted | None
) -> Judged:
    """Return whether a relation along the route is kept until the last mission ends.

    For 0.8 of the time in which the one in front is under way. Where somebody follows, and the
    annotation does not say that the distance is told with that, it may be that of the start.
    """
    front = requirement.get('relation') == 'ahead'
    leader, follower = (body, other) if front else (other, body)
    told = bool(requirement.get('kept'))
    if not told and (asked is None or not _follows(case, follower, leader)):
        return holds('')
    scene = case.scene
    ticks = np.arange(0, scene.recording.ticks, max(1, round(STEP_S / scene.dt_s)))
    walks = scene.is_person(leader)
    least_mps = limits.STARTED_MPS if walks else limits.FOLLOW_MOVING_MPS
    under_way = scene.speed(leader)[ticks] > least_mps
    ticks = ticks[under_way & (scene.times[ticks] < missions_end_s(scene))]
    gap, _ = ahead_of(scene, leader, follower, ticks)
    gap = np.where(scene.present(leader)[ticks] & scene.present(follower)[ticks], gap, np.nan)
    good = gap > 0.0 if asked is None else np.array([asked.counts(float(g)) for g in gap])
    kept = share(good)
    far = f'{asked.text()} m ' if asked is not None else ''
    middle = float(np.nanmedian(gap)) if np.isfinite(gap).any() else np.nan
    why = f'{follower} {far}behind {leader} for {kept:.0%} of the way, median {middle:.1f} m'
    return graded(kept >= limits.FOLLOW_SHARE, not told, why)


def abreast(scene: Scene, body: str, other: str, relation: str) -> tuple[BoolArray, BoolArray]:
    """Return (ticks,) whether a body is within 45 degrees of a side of another one, or level."""
    forward, left = frame(scene, body, other)
    side = {'left': left, 'right': -left}.get(relation, np.abs(left))
    angle = np.degrees(np.arctan2(np.abs(forward), side))
    # Side by side also means: overlapping along the way.
    lengths = [scene.bodies[b].length_m for b in (body, other)]
    level = (side > 0.0) & (np.abs(forward) <= sum(lengths) / 2.0)
    return angle <= limits.SIDE_DEG, level


def beside_on_the_way(case: Case, requirement: Requirement, body: str, other: str) -> Judged:
    """Return whether a side that is told with motion is kept until the last mission ends."""
    if not requirement.get('kept'):
        return holds('')
    scene = case.scene
    aside, level = abreast(scene, body, other, str(requirement.get('relation')))
    there = scene.present(body) & scene.present(other)
    asked = scene.times < missions_end_s(scene)
    kept = share(((aside | level) & there)[asked])
    why = f'{body} {requirement.get("relation")} {other} for {kept:.0%} of the time'
    return graded(kept >= limits.FOLLOW_SHARE, False, why)


def stated_between(case: Case, follower: str, leader: str) -> Wanted | None:
    """Return how far one is to be behind another, None where no distance is annotated."""
    for r in case.annotation.flat():
        pairs = {'behind': (follower, leader), 'ahead': (leader, follower)}
        body, other = pairs.get(str(r.get('relation')), ('', ''))
        if r['kind'] != 'placement' or r.get('negate') or not body:
            continue
        if body in case.bodies(r.get('agent')) and other in case.bodies(r.get('of')):
            found = wanted(r, 'distance_m', case.variation, limits.PLACEMENT_VEHICLE)
            if found is not None:
                return found
    return None


def _follows(case: Case, follower: str, leader: str) -> bool:
    return any(
        r['kind'] == 'behavior'
        and r.get('behavior') == 'follow'
        and not r.get('negate')
        and follower in case.bodies(r.get('agent'))
        and leader in case.bodies(r.get('target'))
        for r in case.annotation.flat()
    )
