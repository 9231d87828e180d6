# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Whether an action set in after a time, and when it was complete."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from aurora_bench.checker import limits
from aurora_bench.checker.answers import Judged, cannot_tell, does_not, graded, holds
from aurora_bench.checker.case import Case
from aurora_bench.checker.recording import BoolArray
from aurora_bench.checker.roads import crossings_of, lane_changes, passed_first
from aurora_bench.checker.scene import runs_of

# A time step of the action's own: what is commanded at a tick shows one or two ticks later.
STEPS = 2
# The least that shows: a change of speed, or a movement.
SHOWS_MPS = 0.2
# What a type can do in the weather is not recorded; who brakes less than this brakes too little.
LEAST_BRAKE_MPS2 = 1.5
# Who brakes already, and then brakes so much harder, has begun anew.
HARDER_MPS2 = 1.0
# What time steps and the averaging of speeds may add to a time in which nothing changes.
IDLE_DOUBT_S = 0.5
# A body or junction so near may be why somebody slows down.
CAUSE_M = 60.0


@dataclass(frozen=True, slots=True)
class Acted:
    """What became of an action: `start_s` and `done_s` where they are known.

    `done_from_s`: from then on it may be said to be done, where that is not one moment.
    """

    judged: Judged
    start_s: float | None = None
    done_s: float | None = None
    done_from_s: float | None = None


@dataclass(frozen=True, slots=True)
class Window:
    """When an action has to set in: the trigger lies between two times (delay included).

    Attributes:
        free: No trigger is stated: it may set in at any time.
        told_s: Where a wait is stated, when that began: the action is not to come in it.
    """

    early_s: float
    late_s: float
    free: bool = False
    told_s: float | None = None

    @property
    def last_s(self) -> float:
        """Return the latest time of an onset."""
        return np.inf if self.free else self.late_s + limits.ONSET_S


GROUND_ACTIONS = ('brake', 'stop', 'slow', 'accelerate', 'change_lane', 'yield', 'start', 'cross')


def ground_action(
    case: Case, action: Mapping[str, Any], agent: str, window: Window, others: tuple[str, ...]
) -> Acted:
    """Return what became of an action of a ground body.

    Args:
        others: Bodies to whom it may have to yield.
    """
    value = action.get('value_mps')
    speed = None if value is None else float(value)
    match action.get('do'):
        case 'stop':
            return _stop(case, agent, window)
        case 'slow':
            return _slow(case, agent, window, speed)
        case 'accelerate':
            return _accelerate(case, agent, window, speed)
        case 'brake':
            return _brake(case, agent, window, speed, _least(action))
        case 'start':
            return _start(case, agent, window, speed)
        case 'change_lane':
            return _change_lane(case, agent, window, action.get('side'))
        case 'cross':
            return _cross(case, agent, window)
        case 'yield':
            return _yield(case, agent, window, others)
        case other:
            return Acted(cannot_tell(f'action {other!r} is not known'))


def _ticks(case: Case, window: Window) -> tuple[int, int]:
    """Return the first tick and the one past the last of the time in which it may set in."""
    scene = case.scene
    first = scene.tick(window.early_s)
    last = scene.recording.ticks if window.free else scene.tick(window.last_s) + 1 + STEPS
    return first, min(last, scene.recording.ticks)


def _onset(case: Case, shows: BoolArray, window: Window) -> int | None:
    """Return the first tick of the window at which something shows."""
    first, last = _ticks(case, window)
    ticks = np.flatnonzero(shows[first:last])
    return first + int(ticks[0]) if len(ticks) else None


def _too_late(case: Case, window: Window) -> bool:
    """Return whether the recording ends before the action has to show."""
    return not window.free and window.late_s + limits.ONSET_S > case.scene.end_s


def _never(case: Case, window: Window, what: str) -> Acted:
    if _too_late(case, window):
        return Acted(cannot_tell(f'{what}, but the recording ends at {case.scene.end_s:.1f} s'))
    when = 'at any time' if window.free else f'from {window.early_s:.2f} to {window.last_s:.2f} s'
    return Acted(does_not(f'{what} {when}'))


def _slowing(case: Case, agent: str) -> BoolArray:
    return np.asarray(case.scene.acceleration(agent) < -SHOWS_MPS)


def _idle_too_long(case: Case, slowing: BoolArray, onset: int, done: int) -> bool:
    """Return whether an action that slows somebody down is late whatever his type can do.

    A type needs no longer for it than he was slowing down: all other time is over and above that.
    """
    idle_s = float(np.count_nonzero(~slowing[onset:done])) * case.scene.dt_s
    return idle_s > limits.ACTION_DONE_S + IDLE_DOUBT_S


def _comes_early(case: Case, agent: str, window: Window, tick: int) -> bool:
    """Return whether something begins in a stated wait, with nothing near to cause it."""
    scene = case.scene
    if window.told_s is None or not scene.tick(window.told_s) < tick < scene.tick(window.early_s):
        return False
    own = scene.xy(agent)[tick]
    away = [
        float(np.linalg.norm(scene.xy(b.body_id)[tick] - own))
        for b in scene.bodies.values()
        if b.body_id != agent and not b.is_uav and scene.present(b.body_id)[tick]
    ]
    spots = (*scene.places.spots('intersection'), *scene.places.spots('crosswalk'))
    away += [float(np.linalg.norm(s.xy - own)) for s in spots]
    return min(away, default=np.inf) > CAUSE_M


def _stop(case: Case, agent: str, window: Window) -> Acted:
    scene = case.scene
    still = (scene.speed(agent) < limits.STOPPED_MPS) & scene.present(agent)
    stops = [
        (a, b) for a, b in runs_of(still) if (b - 1 - a) * scene.dt_s >= limits.STOPPED_S - 1e-9
    ]
    if window.free:
        # Standing from the start is no stop; coming to rest is.
        later = [a for a, _ in stops if a > _ticks(case, window)[0]]
        if later:
            time = float(scene.times[later[0]])
            return Acted(holds(f'{agent} stops at {time:.2f} s'), time, time + limits.STOPPED_S)
        return Acted(does_not(f'{agent} never comes to rest for 2 s'))
    first, last = _ticks(case, window)
    for a, b in stops:
        if a <= last and b > first and a <= scene.tick(window.late_s):
            if _comes_early(case, agent, window, a):
                return Acted(does_not(f'{agent} stands from {scene.times[a]:.2f} s, too early'))
            if _never_moved(case, agent, window):
                return Acted(does_not(f'{agent} has not moved before {window.late_s:.2f} s'))
            done = max(float(scene.times[a]), window.late_s)
            stands = holds(f'{agent} stands at {done:.2f} s already')
            # Who arrives may have done so, and come to rest, before it is there for sure.
            rests = [c for c, _ in stops if first <= c <= scene.tick(window.late_s)]
            if not rests:
                return Acted(stands, done, done)
            since, done = float(scene.times[rests[0]]), float(scene.times[rests[-1]])
            return Acted(stands, done, done, done_from_s=since)
    onset = _onset(case, _slowing(case, agent), window)
    if onset is None:
        return _never(case, window, f'{agent} does not slow down')
    after = [a for a, _ in stops if a >= onset]
    if not after:
        least = float(scene.speed(agent)[onset:].min())
        rest = (runs_of(still) or [(0, 0)])[-1]
        if rest[1] == len(still) and rest[0] >= onset:
            return Acted(cannot_tell(f'{agent} comes to rest as the recording ends'))
        why = f'{agent} slows down at {scene.times[onset]:.2f} s but does not stop'
        return Acted(does_not(f'{why}: least {least:.2f} m/s'))
    # The way and the type bound the time; 1 m/s^2 is slower than any vehicle brakes.
    took = (after[0] - onset) * scene.dt_s
    bound = float(scene.speed(agent)[onset]) / 1.0 + 2.0
    start, end = float(scene.times[onset]), float(scene.times[after[0]])
    gap = scene.speed(agent)[onset : after[0]]
    again = bool(len(gap)) and bool((gap > gap[0] + 2.0).any())
    why = f'{agent} slows down at {start:.2f} s and stands from {end:.2f} s'
    possibly = not again and not _idle_too_long(case, _slowing(case, agent), onset, after[0])
    return Acted(graded(took <= bound and possibly, possibly, why), start, end)


def _reach(
    case: Case,
    agent: str,
    window: Window,
    shows: BoolArray,
    there: BoolArray,
    what: str,
    *,
    slows: bool = False,
) -> Acted:
    """Return whether something sets in within the window and a speed is reached after it.

    Args:
        slows: Nothing ahead can hold it up, as it can who is to gain speed.
    """
    scene = case.scene
    onset = _onset(case, shows, window)
    if onset is None:
        return _never(case, window, f'{agent} does not begin to {what}')
    reached = np.flatnonzero(there[onset:])
    start = float(scene.times[onset])
    if not len(reached):
        return Acted(does_not(f'{agent} begins at {start:.2f} s but does not {what}'), start)
    done = float(scene.times[onset + reached[0]])
    why = f'{agent} begins at {start:.2f} s, {what} by {done:.2f} s'
    # The type's acceleration is not recorded: 0.5 m/s^2 is the slowest that counts.
    change = abs(float(scene.speed(agent)[onset + reached[0]] - scene.speed(agent)[onset]))
    soon = done - start <= change / 0.5 + limits.ACTION_DONE_S
    late = slows and _idle_too_long(case, shows, onset, onset + int(reached[0]))
    return Acted(graded(soon and not late, not late, why), start, done)


def _never_moved(case: Case, agent: str, window: Window) -> bool:
    """Return whether somebody has stood from t = 0 on: who stands has nothing to stop."""
    before = case.scene.speed(agent)[: case.scene.tick(window.late_s) + 1]
    return bool((before < limits.STARTED_MPS).all())


def _slow(case: Case, agent: str, window: Window, value: float | None) -> Acted:
    scene, speed = case.scene, case.scene.speed(agent)
    at = scene.tick(window.late_s)
    if value is not None:
        slack = limits.tolerance(limits.SPEED, value)
        there = np.abs(speed - value) <= slack
        if not window.free and speed[at] <= value + slack:
            since = np.flatnonzero(speed[: at + 1] > value + slack)
            begun = int(since[-1]) + 1 if len(since) else 0
            if _comes_early(case, agent, window, begun):
                return Acted(does_not(f'{agent} is as slow from {scene.times[begun]:.2f} s'))
            if _never_moved(case, agent, window):
                return Acted(does_not(f'{agent} has not moved before {window.late_s:.2f} s'))
            time = window.late_s
            return Acted(holds(f'{agent} goes at {speed[at]:.2f} m/s already'), time, time)
        what = f'slow to {value:g} m/s'
    elif window.free:
        first, _ = _ticks(case, window)
        if _onset(case, _slowing(case, agent), window) is None:
            return Acted(does_not(f'{agent} never slows down'))
        before = np.maximum.accumulate(speed[first:])
        half = np.flatnonzero(speed[first:] <= before / 2.0 + 1e-9)
        half = half[before[half] > 1.0]
        if not len(half):
            return Acted(does_not(f'{agent} never slows to half of its speed'))
        time = float(scene.times[first + half[0]])
        return Acted(holds(f'{agent} at half of its speed at {time:.2f} s'), time, time)
    else:
        # Within a step of the trigger either speed is the one that it had then.
        base = float(speed[scene.tick(window.early_s) : at + 1].max())
        there = speed <= base / 2.0 + 1e-9
        what = f'slow to half of {base:.2f} m/s'
    return _reach(case, agent, window, _slowing(case, agent), there, what, slows=True)


def _accelerate(case: Case, agent: str, window: Window, value: float | None) -> Acted:
    scene, speed = case.scene, case.scene.speed(agent)
    gaining = scene.acceleration(agent) > SHOWS_MPS
    if value is not None:
        slack = limits.tolerance(limits.SPEED, value)
        return _reach(
            case, agent, window, gaining, np.abs(speed - value) <= slack, f'reach {value:g} m/s'
        )
    base = float(speed[scene.tick(window.early_s)]) if not window.free else float(speed.min())
    goal = base + limits.ACCELERATE_BY_MPS
    return _reach(case, agent, window, gaining, speed >= goal - 0.05, f'reach {goal:.2f} m/s')


def _hardest(case: Case, agent: str, first: int, stop: int) -> float:
    """Return the hardest deceleration of some ticks, m/s^2: of the speeds or as recorded."""
    recorded = -case.scene.recording.ground[:, case.scene.bodies[agent].row, 5]
    shown = -case.scene.acceleration(agent)
    return float(max(shown[first:stop].max(initial=0.0), recorded[first:stop].max(initial=0.0)))


def _braking_anew(case: Case, agent: str, window: Window) -> BoolArray:
    """Return when somebody slows down, without what only goes on when the window begins."""
    slowing = _slowing(case, agent)
    first, _ = _ticks(case, window)
    for a, b in runs_of(slowing):
        before, inside = _hardest(case, agent, a, first), _hardest(case, agent, first, b)
        if a < first < b and inside <= before + HARDER_MPS2:
            slowing[a:b] = False
    return slowing


def _least(action: Mapping[str, Any]) -> float:
    """Return how hard somebody slows down at least who brakes: half of a stated number will do."""
    stated = action.get('deceleration_mps2')
    usual = limits.BRAKE_MPS2 * (1.0 - limits.REALISED_SHARE)
    return usual if stated is None else min(usual, float(stated) / 2.0)


def _brake(case: Case, agent: str, window: Window, value: float | None, least: float) -> Acted:
    scene = case.scene
    slowing = _slowing(case, agent) if window.free else _braking_anew(case, agent, window)
    for a, b in runs_of(_slowing(case, agent)):
        if _hardest(case, agent, a, b) >= least and _comes_early(case, agent, window, a):
            return Acted(does_not(f'{agent} brakes at {scene.times[a]:.2f} s, too early'))
    if window.free:
        # Nobody says when: it is the first that is a braking, not what traffic asks for.
        first, _ = _ticks(case, window)
        firm = np.zeros_like(slowing)
        for a, b in runs_of(slowing):
            firm[a:b] = a >= first and _hardest(case, agent, a, b) >= least
        slowing = firm if firm.any() else slowing
    onset = _onset(case, slowing, window)
    if onset is None:
        return _never(case, window, f'{agent} does not begin to brake')
    end = onset
    hardest = 0.0
    runs = [
        (a, b)
        for a, b in runs_of(slowing)
        if b > onset and (window.free or a <= _ticks(case, window)[1])
    ]
    for a, b in runs:
        hard = _hardest(case, agent, max(a, onset), b)
        if hard > hardest:
            hardest, end = hard, b
        if hard >= least:
            break
    start, done = float(scene.times[onset]), float(scene.times[min(end, len(slowing) - 1)])
    why = f'{agent} brakes from {start:.2f} s with up to {hardest:.2f} m/s^2'
    judged = graded(hardest >= least, hardest >= LEAST_BRAKE_MPS2, why)
    if value is not None:
        slack = limits.tolerance(limits.SPEED, value)
        if not (np.abs(scene.speed(agent)[onset:] - value) <= slack).any():
            judged = does_not(f'{why}, but never to {value:g} m/s')
    # Who brakes has done so once he brakes hard enough, and at the latest when he stops doing so.
    enough_at = (t for t in range(onset, end) if _hardest(case, agent, t, t + 1) >= least)
    return Acted(
        judged,
        start,
        done,
        done_from_s=float(scene.times[min(next(enough_at, end), len(slowing) - 1)]),
    )


def _start(case: Case, agent: str, window: Window, value: float | None) -> Acted:
    scene, speed = case.scene, case.scene.speed(agent)
    moving = speed > limits.STARTED_MPS
    first = np.flatnonzero(speed >= limits.STOPPED_MPS)
    if not len(first):
        return _never(case, window, f'{agent} does not start')
    if window.free:
        onset: int | None = int(first[0])
        if onset == 0:
            return Acted(does_not(f'{agent} moves from t = 0'))
    else:
        # Who is told to stop before has driven; it stands for the wait that is stated.
        halts = any(case.does(agent, do) for do in ('stop', 'yield'))
        since_s = window.early_s if window.told_s is None else window.told_s + limits.ONSET_S
        rests = scene.tick(min(since_s, window.early_s)) if halts else 0
        if not halts and case.does(agent, 'brake'):
            # Who is told to brake before comes to rest some time later.
            rests = scene.tick(window.early_s if window.told_s is None else window.told_s)
            at_rest = speed[rests : scene.tick(window.early_s) + 1] < limits.STOPPED_MPS
            rests += int(np.argmax(at_rest))
        before = speed[rests : scene.tick(window.early_s) + 1]
        if (before >= limits.STOPPED_MPS).any():
            at = float(scene.times[rests + np.flatnonzero(before >= limits.STOPPED_MPS)[0]])
            why = f'{agent} moves at {at:.2f} s, before {window.early_s:.2f} s'
            return Acted(does_not(why), at)
        onset = _onset(case, speed >= limits.STOPPED_MPS, window)
    if onset is None:
        return _never(case, window, f'{agent} does not start')
    start = float(scene.times[onset])
    there = moving
    what = 'move'
    if value is not None:
        there = np.abs(speed - value) <= limits.tolerance(limits.SPEED, value)
        what = f'reach {value:g} m/s'
    reached = np.flatnonzero(there[onset:])
    if not len(reached):
        top = float(speed[onset:].max())
        return Acted(does_not(f'{agent} does not {what} (fastest {top:.2f} m/s)'), start)
    # An event that starts somebody is done when he moves: chains count from then.
    done = float(scene.times[onset + reached[0]])
    return Acted(holds(f'{agent} starts at {start:.2f} s, {what} by {done:.2f} s'), start, done)


def _change_lane(case: Case, agent: str, window: Window, side: str | None) -> Acted:
    changes = lane_changes(case, agent, side)
    first, last = _ticks(case, window)
    # The way across the lane takes its time: the onset shows before the body is over the line.
    reach = 0 if window.free else round(5.0 / case.scene.dt_s)
    for tick, held, _ in changes:
        if first <= tick <= last + reach:
            time = float(case.scene.times[tick])
            why = f'{agent} is on another lane at {time:.2f} s'
            # Done when it is there, or when it has been there for as long as that has to last.
            kept = min(time + limits.LANE_HELD_S, case.scene.end_s)
            judged = graded(held, not held and _at_end(case, tick), why)
            return Acted(judged, time, kept, done_from_s=time)
    seen = [f'{case.scene.times[c.tick]:.1f} s {c.side}' for c in lane_changes(case, agent)]
    return _never(case, window, f'{agent} does not change lane as asked (changes: {seen})')


def _at_end(case: Case, tick: int) -> bool:
    return case.scene.end_s - float(case.scene.times[tick]) < limits.LANE_HELD_S


def _cross(case: Case, agent: str, window: Window) -> Acted:
    scene = case.scene
    found = [c for c in crossings_of(case, agent) if c[2] >= 3.0]
    whole = [c for c in found if c[1] < scene.recording.ticks]
    if window.free:
        if whole:
            start, end = float(scene.times[whole[0][0]]), float(scene.times[whole[0][1]])
            why = f'{agent} crosses from {start:.2f} to {end:.2f} s'
            return Acted(holds(why), start, end)
        return Acted(graded(False, bool(found), f'{agent} never crosses a carriageway'))
    early = [c for c in found if scene.times[c[0]] < window.early_s - scene.dt_s]
    later = [c for c in found if scene.times[c[0]] >= window.early_s - scene.dt_s]
    if not later:
        if early:
            at = float(scene.times[early[0][0]])
            why = f'{agent} steps on the carriageway at {at:.2f} s, before {window.early_s:.2f} s'
            return Acted(does_not(why), at)
        return _never(case, window, f'{agent} does not cross')
    a, b, _ = later[0]
    moving = scene.speed(agent) > SHOWS_MPS
    onset = _onset(case, moving, window)
    start, end = float(scene.times[a]), float(scene.times[min(b, len(moving) - 1)])
    why = f'{agent} is on the carriageway from {start:.2f} to {end:.2f} s'
    if early or (onset is None and start > window.last_s):
        return Acted(does_not(f'{why}, asked from {window.early_s:.2f} s'), start, end)
    ended = b < scene.recording.ticks
    if _waits_first(case, agent):
        # Where he has waited he sets off, and gets to the kerb without a stop.
        stood = onset is not None and not (moving[onset:a] == 0).any()
        soon, late = start <= window.last_s or stood, False
    else:
        soon = start <= window.late_s + limits.STEP_S + STEPS * scene.dt_s
        late = start > window.last_s + STEPS * scene.dt_s
    return Acted(graded(soon and ended, not late, why), start, end if ended else None)


def _waits_first(case: Case, agent: str) -> bool:
    """Return whether somebody crosses when his own wait is over."""
    return any(
        r['kind'] == 'event'
        and (r.get('action') or {}).get('do') == 'cross'
        and (r.get('trigger') or {}).get('on') == 'behavior_done'
        and (r.get('trigger') or {}).get('behavior') == 'wait'
        and agent in case.bodies((r.get('trigger') or {}).get('who'))
        for r in case.annotation.flat()
    )


def _yield(case: Case, agent: str, window: Window, others: tuple[str, ...]) -> Acted:
    scene = case.scene
    speed = scene.speed(agent)
    onset = _onset(case, _slowing(case, agent) | (speed < limits.STOPPED_MPS), window)
    firsts = [passed_first(case, other, agent) for other in others]
    known = [f for f in firsts if f is not None]
    if any(not f[0] for f in known):
        return Acted(does_not(f'{agent} passes before {others}'))
    if not known:
        if onset is None:
            return _never(case, window, f'{agent} does not slow down')
        start = float(scene.times[onset])
        why = f'{agent} slows at {start:.2f} s, but to whom it yields is not seen'
        return Acted(cannot_tell(why), start)
    done = max(f[1] for f in known)
    why = f'{others} passed first, at {done:.2f} s'
    apart = min(float(scene.distance(agent, b, True)[scene.tick(done)]) for b in others)
    if apart > limits.YIELDS_WITHIN_M:
        return Acted(does_not(f'{why}, {apart:.0f} m away from {agent}'), None, done)
    if onset is None and not window.free:
        return Acted(cannot_tell(f'{why}; {agent} does not slow down'), None, done)
    return Acted(holds(why), float(scene.times[onset]) if onset is not None else None, done)
