# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Alterations just inside and just outside of a tolerance, speeds and claims adapted.

The tolerances stand here a second time, as the contract states them: a verifier with other ones
shows on one of the two sides.
"""

from __future__ import annotations

from collections.abc import Iterator
from random import Random

import numpy as np

from aurora_bench.mutation.ledger import shifted
from aurora_bench.mutation.mutant import Mutant, mutant
from aurora_bench.mutation.recording import Recording, Span
from aurora_bench.mutation.states import told
from aurora_core.spec.scenario import TimeTrigger
from aurora_core.spec.vocabulary import MissionMode
from aurora_core.trace.layout import GroundColumn, UavColumn
from aurora_core.trace.records import LinkEventKind
from aurora_core.trace.trace import Trace

_GX, _GY = int(GroundColumn.X), int(GroundColumn.Y)
_UX, _UZ, _VZ = int(UavColumn.X), int(UavColumn.Z), int(UavColumn.VZ)

# An altitude is kept within 2 m or 3 % for 95 % of the phase.
_ALTITUDE_M, _ALTITUDE_SHARE, _KEPT = 2.0, 0.03, 0.95
# An excursion goes up and down with less than any limit (m/s).
_CLIMB_MPS = 2.0
# And so far beyond the tolerance (m).
_OVER_M = 0.3
# A hover drifts by at most 2 m in calm air, a vehicle is placed within 1 m or 2 %.
_DRIFT_M, _PLACED_M, _PLACED_SHARE = 2.0, 1.0, 0.02
# An event happens within a second of its trigger, and within half a second of a stated time.
_EVENT_S, _TIME_S = 1.0, 0.5


def outside_mutants(base: Recording, random: Random) -> Iterator[Mutant]:
    """Yield alterations that leave a tolerance by little."""
    yield from _altitude(base, random, outside=True)
    yield from _drift(base, random, outside=True)
    yield from _placed(base, random, outside=True)
    yield from _delayed(base, outside=True)


def inside_mutants(base: Recording, random: Random) -> Iterator[Mutant]:
    """Yield alterations that stay within a tolerance."""
    yield from _altitude(base, random, outside=False)
    yield from _drift(base, random, outside=False)
    yield from _placed(base, random, outside=False)
    yield from _delayed(base, outside=False)


def _altitude(base: Recording, random: Random, *, outside: bool) -> Iterator[Mutant]:
    """The UAV climbs out of its tolerance and comes back, for a share of the phase."""
    trace = base.trace
    for span in base.spans:
        name = f'{span.mission.id}.altitude'
        if name not in base.conditions or _hidden(trace):
            continue
        tolerance = max(_ALTITUDE_M, _ALTITUDE_SHARE * span.mission.altitude_m.value)
        # The phase counts from capture on; the way to it is commanded too.
        length = span.stop - span.first
        if span.mission.duration_s is not None:
            length = min(length, round(span.mission.duration_s.value / trace.roster.dt_s))
        allowed = (1.0 - _KEPT) * length
        wanted = (1.4 if outside else 0.6) * allowed
        first = (span.first + span.stop) // 2 - random.randint(0, 10)
        found = _excursion(base, span, first, tolerance, round(wanted))
        if found is None:
            continue
        altered, off = found
        if (off >= 1.2 * allowed) if outside else (0 < off <= 0.8 * allowed):
            yield mutant(
                'tolerance of an altitude',
                f'{off} ticks of {length} outside ({span.mission.id})',
                base,
                {f'condition:{name}'} if outside else (),
                trace=altered,
            )


def _excursion(
    base: Recording, span: Span, first: int, tolerance_m: float, wanted: int
) -> tuple[Trace, int] | None:
    """Climb out of a tolerance and come back.

    Returns:
        The trace and the ticks that it is outside, about as many as wanted; None when the phase
        is too short for it.
    """
    dt_s = base.trace.roster.dt_s
    height_m = tolerance_m + _OVER_M
    ramp = int(np.ceil(height_m / (_CLIMB_MPS * dt_s)))
    rise = np.linspace(0.0, height_m, ramp + 1)
    beyond = 2 * int(np.count_nonzero(rise > tolerance_m))
    shape = np.concatenate((rise, np.full(max(0, wanted - beyond), height_m), rise[::-1]))
    part = slice(first, first + len(shape))
    if part.stop >= span.stop:
        return None
    uav = base.trace.uav.copy()
    uav[part, span.row, _UZ] += shape
    uav[part, span.row, _VZ] += np.gradient(shape, dt_s)
    away = np.abs(uav[part, span.row, _UZ] - span.mission.altitude_m.value)
    return told(base, uav=uav), int(np.count_nonzero(away > tolerance_m))


def _hidden(trace: Trace) -> bool:
    """Whether a target was out of sight at some time: a few metres up may change when."""
    return any(not record.visible for record in trace.sights)


def _drift(base: Recording, random: Random, *, outside: bool) -> Iterator[Mutant]:
    trace = base.trace
    hovers = [span for span in base.spans if span.mission.mode is MissionMode.HOVER]
    if not hovers or base.world.weather != 'clear' or _hidden(trace):
        return
    ids = [span.mission.id for span in hovers]
    metres = random.uniform(1.2, 1.4) * _DRIFT_M if outside else random.uniform(0.3, 0.6)
    uav = trace.uav.copy()
    uav[:, :, _UX] += metres
    names = {f'condition:{m}.{what}' for m in ids for what in ('drift', 'capture')}
    yield mutant(
        'tolerance of a hover',
        f'{metres:.2f} m beside it all along',
        base,
        names if outside else (),
        trace=told(base, uav=uav),
    )


def _placed(base: Recording, random: Random, *, outside: bool) -> Iterator[Mutant]:
    trace = base.trace
    spec = base.agsg.spec
    # A distance that triggers something would be reached at another tick.
    if any(e.trigger is not None and e.trigger.on.startswith('distance') for e in spec.events):
        return
    for agent in spec.agents:
        row = trace.roster.agent_index(agent.id)
        stated = [p.distance_m.value for p in agent.placements if p.distance_m is not None]
        if row is None or not stated or f'{agent.id}.placed.distance' not in base.conditions:
            continue
        tolerance = max(_PLACED_M, _PLACED_SHARE * stated[0])
        metres = tolerance * (random.uniform(1.2, 1.5) if outside else random.uniform(0.3, 0.6))
        ground = trace.ground.copy()
        heading = ground[0, row, GroundColumn.HEADING_X : GroundColumn.HEADING_Y + 1].copy()
        ground[:, row, _GX : _GY + 1] += metres * heading
        yield mutant(
            'tolerance of a placement',
            f'{agent.id} {metres:+.2f} m',
            base,
            {f'condition:{agent.id}.placed.distance'} if outside else (),
            trace=told(base, ground=ground),
        )


def _delayed(base: Recording, *, outside: bool) -> Iterator[Mutant]:
    """A message with the claim that it was sent, later by less or more than is allowed."""
    dt_s = base.trace.roster.dt_s
    for records in base.messages.values():
        if records[-1].kind is not LinkEventKind.DELIVERED:
            continue
        event = next(e for e in base.agsg.spec.events if e.id == records[0].event)
        timed = isinstance(event.trigger, TimeTrigger)
        allowed = round((_TIME_S if timed else _EVENT_S) / dt_s)
        names = {f'condition:{event.id}.{"time" if timed else "within"}'}
        for ticks in (allowed + 1, allowed + 3) if outside else (1, allowed // 2, allowed - 1):
            yield mutant(
                'tolerance of an event',
                f'{event.id} {ticks} ticks later',
                base,
                names if outside else (),
                trace=shifted(base, records, ticks),
            )
        break
