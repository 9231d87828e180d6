# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Run one program in its scene: what it asks goes to the stage, the recording stays outside."""

from __future__ import annotations

from pathlib import Path

from aurora_bench.sandbox.process import ContainedProgram, End
from aurora_bench.sandbox.stage import Stage
from aurora_bench.sandbox.ways import ProgramLimits
from aurora_core.document import Document
from aurora_core.pipeline.knowledge import Knowledge
from aurora_core.ports.simulators import AirSimulator, GroundSimulator


class ProgramRun(Document):
    """What became of a program.

    Attributes:
        end: How it ended.
        told: Last lines of what it printed, its exception among them.
        refused: Why it says that the request cannot be carried out, '' where it does not.
        begun: Whether anything was simulated; then there is a recording.
        simulated_s: Simulated seconds.
        trace_sha256, motion_sha256: '' without a recording.
    """

    end: End
    told: str = ''
    refused: str = ''
    begun: bool = False
    simulated_s: float = 0.0
    trace_sha256: str = ''
    motion_sha256: str = ''

    @property
    def completed(self) -> bool:
        """Whether it came to its own end after something was simulated."""
        return self.end is End.FINISHED and self.begun


def run_program(
    text: str,
    *,
    known: Knowledge,
    map_name: str,
    seed: int,
    bag: Path,
    limits: ProgramLimits | None = None,
) -> ProgramRun:
    """Run a program, contained, against simulators of this process.

    Args:
        text: Python source.
        known: What the stages work with.
        map_name: Map of the run.
        seed: Of simulators and links.
        bag: Folder that the recording becomes.
        limits: What it may use.

    Raises:
        SandboxError: Nothing on this machine contains it.
        AuroraError: A simulator or the recording broke.
    """
    with (
        Stage(known, map_name, seed, bag, _simulators) as stage,
        ContainedProgram(text, limits) as program,
    ):
        while (request := program.receive()) is not None:
            program.send(stage.answer(request))
        ended = program.ended()
        hashes = stage.end()
        return ProgramRun(
            end=ended.end,
            told=ended.told,
            refused=stage.refused,
            begun=stage.begun,
            simulated_s=stage.time_s,
            trace_sha256='' if hashes is None else hashes.trace_sha256,
            motion_sha256='' if hashes is None else hashes.motion_sha256,
        )


def _simulators(system_ids: tuple[int, ...]) -> tuple[GroundSimulator, AirSimulator]:
    # Imported here: libsumo takes seconds, and reading a program needs none of it.
    from aurora_sumo_bridge.sumo_client import SumoClient
    from aurora_uav_bridge.mavlink_client import MavlinkClient
    from aurora_uav_bridge.transports import LoopbackTransport
    from aurora_uav_sim.mavlink_server import SimServer

    return SumoClient(), MavlinkClient(LoopbackTransport(SimServer(system_ids or (1,))))
