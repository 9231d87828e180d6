# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What is kept of one run of a campaign."""

from __future__ import annotations

from collections.abc import Mapping
from enum import StrEnum
from typing import Any

from pydantic import FiniteFloat

from aurora_bench.campaign.measured import Measured
from aurora_bench.campaign.plan import Configuration, Task
from aurora_bench.prompts.format import Category, Feasibility
from aurora_bench.rulers.checking import Said
from aurora_bench.rulers.trial import Cause
from aurora_core.document import Document
from aurora_core.outcomes.grounded import AnchorScore
from aurora_core.outcomes.verdict import VerdictStatus


class Ending(StrEnum):
    """How far a run got; every run has one."""

    COMPLETED = 'completed'  # it was executed to its end and judged
    DECLINED = 'declined'  # it ended before anything was executed, with a reason
    FAILED = 'failed'  # something broke, or took too long


class Tried(Document):
    """One attempt of repair.

    Attributes:
        kind: Step of the escalation, '' where nothing was left to propose.
        outcome: What came of it.
        edits: Values that were realised otherwise.
        of_conditions: Edits that changed what the run is judged by.
    """

    kind: str
    outcome: str
    edits: int
    of_conditions: int


class CampaignRun(Document):
    """One run; equal for equal requests but for the seconds.

    Attributes:
        key: Of its task.
        status: Of the run's report; `lost` where there is none.
        ending: How far it got.
        why: Of a run that did not complete: the reason, in few words.
        first: What the trace of the first realisation shows, None where nothing was executed.
        final: The same of the realisation that the run is judged by.
        right: The status is the one that the annotation asks for, and nothing contradicts it.
        cause: Why not.
        said: Answers of the independent checker about a completed run of a possible request whose
            conditions all hold.
        met, requirements: Annotated requirements that the specification holds, of all.
        fields_met, fields: The same by annotated field.
        request_kept: Every realisation was of the same specification.
        conditions, satisfied: Monitored conditions, and those that hold.
        margin: Least normalised one.
        margins: Least margin by what is asked, in its own unit.
        tried: Attempts of repair, in order.
        simulations: Executions, the first one included.
        anchor: Terms of the joint anchor score of the final realisation.
        placed_m: Metres from the grounded place at t = 0 of the first realisation, by agent type.
        measured: Missions, events and messages of the final realisation.
        trace_sha256, motion_sha256: '' without a trace.
        simulated_s: Simulated seconds of the final realisation.
        seconds: Wall seconds by stage, and `processor`; `again ...` is the part of a stage that
            came after the first verdict.
    """

    key: str
    configuration: Configuration
    reader: str
    file: str
    id: str
    category: Category
    feasibility: Feasibility
    seed: int
    status: str
    ending: Ending
    why: str = ''
    first: VerdictStatus | None = None
    final: VerdictStatus | None = None
    right: bool = False
    cause: Cause | None = None
    said: tuple[Said, ...] = ()
    met: int = 0
    requirements: int = 0
    fields_met: int = 0
    fields: int = 0
    request_kept: bool = True
    conditions: int = 0
    satisfied: int = 0
    margin: FiniteFloat | None = None
    margins: Mapping[str, FiniteFloat] = {}
    tried: tuple[Tried, ...] = ()
    simulations: int = 0
    anchor: AnchorScore | None = None
    placed_m: Mapping[str, tuple[FiniteFloat, ...]] = {}
    measured: Measured | None = None
    trace_sha256: str = ''
    motion_sha256: str = ''
    simulated_s: FiniteFloat | None = None
    seconds: Mapping[str, FiniteFloat] = {}

    @property
    def passed(self) -> bool:
        """Whether it completed with every monitored condition satisfied (the paper's P)."""
        return self.final is VerdictStatus.VERIFIED

    @property
    def unmet(self) -> bool:
        """Whether it completed with a condition that does not hold (the paper's SF)."""
        return self.final is VerdictStatus.VIOLATED

    @property
    def undecided(self) -> bool:
        """Whether it completed and its trace lacks what is needed to decide."""
        return self.final is VerdictStatus.INCONCLUSIVE

    @property
    def contradicted(self) -> bool:
        """Whether the checker shows that an annotated requirement does not hold."""
        return any(s.outcome == 'does_not' for s in self.said)

    @property
    def silent(self) -> bool:
        """Whether it claims to be verified and the checker shows that it is not."""
        return self.status == 'verified' and self.contradicted


def lost_run(task: Task, why: str) -> CampaignRun:
    """Return the record of a task whose worker gave none."""
    return CampaignRun(
        **identity(task), status='lost', ending=Ending.FAILED, why=why, cause=Cause.ERROR
    )


def identity(task: Task) -> dict[str, Any]:
    """Return the fields that say which run it is."""
    trial = task.trial
    return {
        'key': task.key,
        'configuration': task.configuration,
        'reader': task.reader.name,
        'file': trial.file,
        'id': trial.prompt.id,
        'category': trial.prompt.category,
        'feasibility': trial.prompt.feasibility,
        'seed': trial.seed,
    }
