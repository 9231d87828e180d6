# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Alterations of the commanded phases, with the claims beside them adapted or not."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from random import Random

import numpy as np

from aurora_bench.mutation.mutant import Mutant, mutant
from aurora_bench.mutation.recording import Recording, Span
from aurora_core.trace.layout import UavCommandColumn, UavPhase
from aurora_core.trace.records import EventRecord, ScenarioEventKind
from aurora_core.trace.trace import Trace

_PHASE = int(UavCommandColumn.PHASE)


def command_mutants(base: Recording, random: Random) -> Iterator[Mutant]:
    """Yield alterations of the phases of the first mission of each UAV and of its landing."""
    for span in base.spans:
        yield from _one(base, span, random)


def _one(base: Recording, span: Span, random: Random) -> Iterator[Mutant]:
    trace, mission = base.trace, span.mission.id
    phase = trace.uav_commands[:, span.row, _PHASE]
    own = [s for s in base.spans if s.row == span.row]
    after = phase[span.stop] if span.stop < trace.ticks else UavPhase.LANDING
    skipped = {f'condition:{mission}.{what}' for what in ('order', 'capture', 'completed')}
    middle = (span.first + span.stop) // 2
    cases: list[tuple[str, int, int, float, set[str]]] = [
        ('mission skipped', span.first, span.stop, float(after), skipped),
        # Half of the phase is missing: far more than its tolerance.
        (
            'mission left early',
            middle,
            span.stop,
            float(after),
            {f'condition:{mission}.completed', f'condition:{mission}.duration'},
        ),
    ]
    if span is own[0]:
        begin = int(np.flatnonzero(phase == UavPhase.ASCENT)[0])
        cut = random.randint(30, 80)
        cases += [
            (
                'ascent skipped',
                begin,
                span.first,
                float(UavPhase.MISSION),
                {f'condition:{mission}.order'},
            ),
            (
                'mission before the altitude',
                span.first - cut,
                span.first,
                float(UavPhase.MISSION),
                {f'condition:{mission}.order'},
            ),
        ]
    if span is own[-1] and span.stop < trace.ticks:
        cases.append(
            (
                'landing skipped',
                span.stop,
                trace.ticks,
                float(phase[span.first]),
                {f'condition:{span.mission.uav}.landed'},
            )
        )
    for name, first, stop, value, names in cases:
        altered = _phase(trace, span.row, first, stop, value)
        yield mutant(
            'phase skipped',
            f'{name} ({mission})',
            base,
            {*names, 'finding:phase'},
            trace=altered,
        )
        yield mutant(
            'phase skipped',
            f'{name} ({mission}), claims adapted',
            base,
            names,
            trace=_claimed(base, altered),
        )


def _phase(trace: Trace, row: int, first: int, stop: int, value: float) -> Trace:
    commands = trace.uav_commands.copy()
    commands[first:stop, row, _PHASE] = value
    return replace(trace, uav_commands=commands)


def _claimed(base: Recording, trace: Trace) -> Trace:
    """Return the trace with the phases claimed as they are commanded."""
    records = [r for r in trace.events if r.kind is not ScenarioEventKind.PHASE]
    for row, uav in enumerate(trace.roster.uavs):
        missions = [m.id for m in base.agsg.spec.missions if m.uav == uav.body_id]
        phase = trace.uav_commands[:, row, _PHASE].astype(int)
        for tick in np.flatnonzero(phase[1:] != phase[:-1]).tolist():
            number = int(phase[tick + 1])
            index = number - UavPhase.MISSION
            name = missions[index] if 0 <= index < len(missions) else UavPhase(number).name.lower()
            records.append(
                EventRecord(
                    tick=tick,
                    sequence=0,
                    kind=ScenarioEventKind.PHASE,
                    subject=uav.body_id,
                    detail=name,
                )
            )
    return replace(trace, events=tuple(records))
