# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""A recorded run, and what this campaign reads off it without the verifier."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

import numpy as np

from aurora_cli.installed import installed
from aurora_cli.local_engine import LocalStages
from aurora_core.errors import AuroraError
from aurora_core.knowledge.world import WorldModel
from aurora_core.outcomes.agsg import Agsg
from aurora_core.pipeline.stages import Stages
from aurora_core.pipeline.verification import load_bag
from aurora_core.report.run_report import TraceReport
from aurora_core.spec.scenario import UavMission
from aurora_core.trace.layout import UavCommandColumn, UavPhase
from aurora_core.trace.records import LinkRecord
from aurora_core.trace.trace import Trace
from aurora_system_tests.local_runs import run_prompt


@dataclass(frozen=True, kw_only=True)
class Span:
    """The ticks at which a mission is commanded.

    Attributes:
        row: Of the UAV.
        first: First tick.
        stop: One after the last.
    """

    mission: UavMission
    row: int
    first: int
    stop: int


@dataclass(frozen=True, kw_only=True)
class Recording:
    """One run as it was recorded.

    Attributes:
        name: Of the prompt.
        seed: Of the run.
        bag: Its folder.
        status: That the run ended with.
        reported: Hash of the trace in the run's report.
    """

    name: str
    seed: int
    bag: Path
    status: str
    reported: TraceReport
    trace: Trace
    world: WorldModel
    agsg: Agsg

    @cached_property
    def conditions(self) -> frozenset[str]:
        """Ids of the recorded conditions."""
        return frozenset(row['id'] for row in json.loads(self.world.conditions_json))

    @cached_property
    def spans(self) -> tuple[Span, ...]:
        """Missions with their ticks, from the commands."""
        spec, trace = self.agsg.spec, self.trace
        found = []
        for mission in spec.missions:
            row = trace.roster.uav_index(mission.uav)
            own = [m.id for m in spec.missions if m.uav == mission.uav]
            assert row is not None
            phase = trace.uav_commands[:, row, UavCommandColumn.PHASE]
            ticks = np.flatnonzero(phase == UavPhase.MISSION + own.index(mission.id))
            if len(ticks):
                first, stop = int(ticks[0]), int(ticks[-1]) + 1
                found.append(Span(mission=mission, row=row, first=first, stop=stop))
        return tuple(found)

    @cached_property
    def messages(self) -> Mapping[int, tuple[LinkRecord, ...]]:
        """Ledger entries by number of the message."""
        grouped: dict[int, list[LinkRecord]] = {}
        for record in self.trace.links:
            grouped.setdefault(record.message, []).append(record)
        return {number: tuple(records) for number, records in grouped.items()}


def record(
    name: str, prompt: str, seed: int, folder: Path, stages: Stages | None = None
) -> Recording:
    """Run a prompt with the local engine and read its bag.

    Raises:
        AuroraError: The run ended without a bag.
    """
    report, bag = run_prompt(
        name, prompt, seed, folder, LocalStages(installed()) if stages is None else stages
    )
    if report.trace is None:
        raise AuroraError(f'{name}: the run ended as {report.status}, without a trace')
    content, agsg = load_bag(bag)
    return Recording(
        name=name,
        seed=seed,
        bag=bag,
        status=report.status,
        reported=report.trace,
        trace=content.trace,
        world=content.world,
        agsg=agsg,
    )
