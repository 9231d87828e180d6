# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The `Stages` protocol: what the pipeline asks of an engine, one blocking call per stage.

Implemented twice: by plain functions in one process (local engine, bench, tests) and by clients of
the ROS services (orchestrator, in a worker thread).
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Annotated, Any, Literal, Protocol

from pydantic import AfterValidator, ConfigDict, Field, ValidationError

from aurora_core.document import Document, omitted
from aurora_core.errors import SpecError
from aurora_core.execution.faults import Fault
from aurora_core.outcomes.agsg import Agsg
from aurora_core.outcomes.feasibility import FeasibilityVerdict
from aurora_core.outcomes.grounding import GroundingOutcome
from aurora_core.outcomes.parse import ParseOutcome
from aurora_core.outcomes.repair import Attempt, Proposal, RepairPlan
from aurora_core.outcomes.verdict import Verdict
from aurora_core.ports.model_name import check_no_secret
from aurora_core.spec.seed import Seed


class RunRequest(Document):
    """What the user asked for, beside the prompt itself.

    Attributes:
        prompt: Byte-identical to what was typed.
        model: `offline`, or language models as `config/models.yaml` says; it is recorded, and
            holds no secret.
        allow_relax: Of a violated run, tell with which stated numbers it would hold.
        repair: Co-simulations that repair may spend after a violation; None: as many as
            `config/repair.yaml` says, and none where faults are injected.
        faults: Injected run-time faults; invisible to feasibility and monitor.
        history: Folder of past episodes that a language model may be shown, and that takes the run
            in when it is verified; None without one.
        history_frozen: The history takes nothing in.
        transcripts: Folder of recorded replies that stand for every named model; None asks them.
        autopilot: `udp://HOST:PORT` of autopilots that keep their own time; '' flies the
            simulated ones in lockstep.
    """

    # An error that quotes its input would tell the secret that it refuses.
    model_config = ConfigDict(hide_input_in_errors=True)

    prompt: str
    map_name: str = 'downtown'
    seed: Seed = 1
    engine: Literal['local', 'ros'] = 'local'
    model: Annotated[str, AfterValidator(check_no_secret)] = 'offline'
    allow_relax: bool = False
    repair: Annotated[int, Field(ge=0)] | None = None
    faults: tuple[Fault, ...] = ()
    history: Path | None = None
    history_frozen: bool = False
    transcripts: Path | None = None
    autopilot: str = omitted('')


def request_of(values: Mapping[str, Any], where: str = 'the request') -> RunRequest:
    """Return the request of named values that somebody gave.

    Args:
        values: By name of the field.
        where: What holds them, for the message.

    Raises:
        SpecError: A name is not known, or a value is not one that it may have.
    """
    try:
        return RunRequest.model_validate(values)
    except ValidationError as err:
        errors = err.errors(include_input=False, include_url=False)
        told = '; '.join(f'{".".join(map(str, e["loc"]))}: {e["msg"]}' for e in errors)
        known = ', '.join(name for name in RunRequest.model_fields if name != 'prompt')
        raise SpecError(
            f'{where} is not valid: {told}', hint=f'beside the prompt there can be: {known}'
        ) from err


class ExecutionResult(Document):
    """What the execution left behind.

    Attributes:
        bag: Folder of the rosbag2 bag.
        ticks: Number of recorded ticks.
        trace_sha256: Trace hash (hex).
        motion_sha256: The same without the world and its conditions (hex).
        outcome: finished, horizon or cancelled.
    """

    bag: Path
    ticks: int
    trace_sha256: str
    motion_sha256: str
    outcome: Literal['finished', 'horizon', 'cancelled']


@dataclass(slots=True)
class RunControl:
    """Progress out, cancel in.

    Attributes:
        progress: Called with stage, fraction of the run in 0..1 and simulated seconds.
        cancelled: Asked between stages and at every tick.
    """

    progress: Callable[[str, float, float], None] = field(default=lambda _s, _f, _t: None)
    cancelled: Callable[[], bool] = field(default=lambda: False)


class Stages(Protocol):
    """One engine; every call blocks and raises `AuroraError` when something breaks."""

    def parse(self, request: RunRequest) -> ParseOutcome:
        """Read the prompt."""

    def ground(
        self, agsg: Agsg, request: RunRequest, plan: RepairPlan | None = None
    ) -> GroundingOutcome:
        """Find places, routes, a schedule and the conditions; with a plan, otherwise than before.

        The graph's iteration is that of the realisation.
        """

    def check(self, agsg: Agsg, request: RunRequest) -> FeasibilityVerdict:
        """Judge feasibility; called before grounding and again after it."""

    def execute(
        self, agsg: Agsg, bag_directory: Path, request: RunRequest, control: RunControl
    ) -> ExecutionResult:
        """Run the grounded scenario in lockstep and record it into `bag_directory`."""

    def verify(self, agsg: Agsg, bag: Path) -> Verdict:
        """Recompute every margin from the bag."""

    def propose(
        self, agsg: Agsg, verdict: Verdict, bag: Path, past: tuple[Attempt, ...]
    ) -> Proposal:
        """Localize the faults of a violated run and propose how to realise it otherwise.

        Args:
            agsg: The best realisation so far.
            verdict: Of its trace.
            bag: Its recording.
            past: Everything that was tried, in order.
        """
