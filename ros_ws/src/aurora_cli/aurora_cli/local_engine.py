# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The local engine: every stage as a plain function call in this process."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from aurora_cli.collector import no_collection
from aurora_core.execution.plan import Execution
from aurora_core.outcomes.agsg import Agsg
from aurora_core.outcomes.feasibility import CheckStage, FeasibilityVerdict
from aurora_core.outcomes.grounding import GroundingOutcome
from aurora_core.outcomes.parse import ParseOutcome
from aurora_core.outcomes.repair import Attempt, Proposal, RepairPlan
from aurora_core.outcomes.verdict import Verdict
from aurora_core.pipeline import functions
from aurora_core.pipeline.knowledge import Knowledge
from aurora_core.pipeline.stages import ExecutionResult, RunControl, RunRequest
from aurora_core.pipeline.verification import Judged, judge_content, load_bag
from aurora_core.ports.simulators import AirSimulator
from aurora_core.trace.air_clock import AirClock
from aurora_core.trace.bag_reader import BagContent
from aurora_core.trace.definitions import message_definitions
from aurora_llm.parse import read_prompt
from aurora_llm.revise import revised_by_models

# What an execution imports; whoever stays warm imports it before.
ENGINE = (
    'aurora_cli.local_run',
    'aurora_sumo_bridge.sumo_client',
    'aurora_uav_bridge.mavlink_client',
    'aurora_uav_sim.mavlink_server',
)


class LocalStages:
    """`Stages` in one process: the clients of the bridges, the simulator's bytes in memory.

    Args:
        known: What the stages work with.
        without: Levels of the check that are left out, for a benchmark that asks what they are
            worth; all else is as it is.

    Attributes:
        verified: The bag that the last verdict is about, as it was read back; None before.
        judged: That verdict with what was measured for it.
        verified_bag: Where that bag lies.
    """

    def __init__(self, known: Knowledge, without: frozenset[CheckStage] = frozenset()) -> None:
        self.known = known
        self.without = without
        self.verified: BagContent | None = None
        self.verified_bag: Path | None = None
        self.judged: Judged | None = None
        # Names the models that may revise what was grounded for it.
        self._request: RunRequest | None = None

    def parse(self, request: RunRequest) -> ParseOutcome:
        """Read the prompt."""
        return read_prompt(self.known, request)

    def ground(
        self, agsg: Agsg, request: RunRequest, plan: RepairPlan | None = None
    ) -> GroundingOutcome:
        """Ground the graph."""
        self._request = request
        return functions.ground_stage(self.known, agsg, request.seed, plan)

    def check(self, agsg: Agsg, request: RunRequest) -> FeasibilityVerdict:
        """Judge feasibility."""
        return functions.check_stage(self.known, agsg, self.without)

    def execution(self, agsg: Agsg, request: RunRequest) -> Execution:
        """Return what is run: loads, roster, world and the executor."""
        return functions.execution_stage(self.known, agsg, request.seed, request.faults)

    def execute(
        self, agsg: Agsg, bag_directory: Path, request: RunRequest, control: RunControl
    ) -> ExecutionResult:
        """Run in lockstep and record."""
        # Imported here: `aurora check` and `aurora verify` need no simulator.
        from aurora_sumo_bridge.room import check_room

        check_room()
        from aurora_cli.local_run import run_lockstep
        from aurora_sumo_bridge.sumo_client import SumoClient

        execution = self.execution(agsg, request)
        system_ids = tuple(entry.system_id for entry in execution.roster.uavs)
        air, clocks = self.air(request, system_ids or (1,))
        return run_lockstep(
            run_id=bag_directory.parent.name,
            agsg=agsg,
            execution=execution,
            ground=SumoClient(),
            air=air,
            bag_directory=bag_directory,
            definitions=message_definitions(),
            control=control,
            clocks=clocks,
        )

    def air(
        self, request: RunRequest, system_ids: tuple[int, ...]
    ) -> tuple[AirSimulator, Callable[[], tuple[AirClock, ...]] | None]:
        """Return what flies, and what tells its clocks where it keeps its own time."""
        if request.autopilot:
            from aurora_uav_bridge.paced_client import PacedClient
            from aurora_uav_bridge.transports import autopilot_transport

            paced = PacedClient(autopilot_transport(request.autopilot))
            return paced, paced.clocks
        from aurora_uav_bridge.mavlink_client import MavlinkClient
        from aurora_uav_bridge.transports import LoopbackTransport
        from aurora_uav_sim.mavlink_server import SimServer

        return MavlinkClient(LoopbackTransport(SimServer(system_ids))), None

    def verify(self, agsg: Agsg, bag: Path) -> Verdict:
        """Recompute every margin from the bag."""
        with no_collection():
            self.verified, recorded = load_bag(bag)
            self.verified_bag = bag
            self.judged = judge_content(self.known, self.verified, recorded)
            return self.judged.verdict

    def propose(
        self, agsg: Agsg, verdict: Verdict, bag: Path, past: tuple[Attempt, ...]
    ) -> Proposal:
        """Propose how to realise a violated request otherwise."""
        content = self.verified if self.verified_bag == bag else load_bag(bag)[0]
        proposal = functions.repair_stage(self.known, agsg, verdict, past, content)
        if self._request is None:
            return proposal
        return revised_by_models(self.known, self._request, agsg, past, proposal)
